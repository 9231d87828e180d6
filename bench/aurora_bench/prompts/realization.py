# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.prompts.realization FILE…`: run the references of what is executed.

The reference of every prompt that is marked `end_to_end` and can be realised runs in the local
engine. When the run is verified, its grounded values become the prompt's `realization`: values
that are known to work. The others are printed with what the report says.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
from collections.abc import Mapping, Sequence
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from aurora_bench.prompts.documents import Doc, read_documents, write_documents
from aurora_bench.prompts.format import AnnotatedPrompt
from aurora_bench.rulers.watched import WatchedStages
from aurora_cli.clock import MonotonicClock
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder, StageFile, new_run_id
from aurora_core.report.run_report import RunReport
from aurora_core.spec.scenario import ScenarioSpec

SEED = 1
_AGENT = ('lane_id', 'lane_position_m', 'x_m', 'y_m', 'speed_mps')
_MISSION = (
    'altitude_m', 'standoff_m', 'offset_m', 'duration_s', 'speed_mps', 'hover_point', 'waypoints',
)  # fmt: skip


def realized(prompt: AnnotatedPrompt, folder: Path) -> tuple[Doc | None, RunReport]:
    """Run the reference of a prompt.

    Args:
        prompt: With a reference.
        folder: For the run's own folder.

    Returns:
        The realisation, None when the run is not verified, and the run's report.
    """
    run_folder = RunFolder(folder, new_run_id(datetime.now(UTC), b'ref'))
    request = RunRequest(prompt=prompt.prompt, seed=SEED, repair=0)
    stages = WatchedStages(_with_clause(prompt.reference or {}))
    report = run(request, stages, stages.known, run_folder, RunControl(), MonotonicClock())
    if report.status != 'verified':
        return None, report
    grounding, schedule = (
        json.loads(run_folder.file(kind.name_at(0)).read_text(encoding='utf-8'))
        for kind in (StageFile.GROUNDING, StageFile.SCHEDULE)
    )
    return realization(grounding, schedule), report


def _with_clause(reference: Mapping[str, Any]) -> ScenarioSpec:
    """Return a stored reference as a specification.

    A run whose prompt is not divided into clauses counts as incomplete. The reference is built
    from all requirements, so that the prompt as a whole became every element.
    """
    prompt = reference['prompt']
    elements = [e['id'] for part in reference.values() if isinstance(part, list) for e in part]
    clause = {
        'text': prompt, 'span': {'start': 0, 'end': len(prompt)}, 'status': 'encoded',
        'ids': sorted(elements),
    }  # fmt: skip
    return ScenarioSpec.model_validate({**reference, 'clauses': [clause]})


def realization(grounding: Doc, schedule: Doc) -> Doc:
    """Return the values of a grounded scenario: who starts where, who flies how.

    Args:
        grounding: Document of the grounding.
        schedule: Document of the schedule.
    """
    agents = {a['id']: _picked(a, _AGENT) for a in grounding['agents']}
    uavs = {
        u['id']: {
            'home_m': [u['home_x_m'], u['home_y_m']],
            'missions': {m['id']: _picked(m, _MISSION) for m in u['missions']},
        }
        for u in grounding['uavs']
    }
    return {
        'map': grounding['map_name'],
        'map_digest': grounding['map_digest'],
        'seed': grounding['seed'],
        'horizon_s': schedule['horizon_s'],
        'agents': agents,
        'uavs': uavs,
    }


def _picked(document: Doc, names: Sequence[str]) -> Doc:
    values = {name: _rounded(document.get(name)) for name in names}
    return {name: value for name, value in values.items() if value not in (None, [])}


def _rounded(value: Any) -> Any:
    """Round to a millimetre: files are read by people."""
    if isinstance(value, float):
        return round(value, 3) + 0.0
    if isinstance(value, list):
        return [_rounded(item) for item in value]
    return value


def main(arguments: Sequence[str] | None = None) -> int:
    """Run and write; return 1 when a prompt has no realisation."""
    parser = argparse.ArgumentParser(prog='aurora_bench.prompts.realization')
    parser.add_argument('files', nargs='+', type=Path, metavar='FILE')
    failed = 0
    for path in parser.parse_args(arguments).files:
        documents = read_documents(path)
        for document in documents:
            document.pop('realization', None)
            prompt = AnnotatedPrompt.model_validate(document)
            if not prompt.end_to_end or prompt.reference is None:
                continue
            with tempfile.TemporaryDirectory(prefix='aurora_realization_') as folder:
                found, report = realized(prompt, Path(folder))
            if found is not None:
                document['realization'] = found
            failed += found is None
            # After every run: minutes of work are not lost when the next one is stopped.
            write_documents(path, documents)
            sys.stdout.write(f'{prompt.id}: {report.status}: {report.summary}\n')
            sys.stdout.flush()
    return int(failed > 0)


if __name__ == '__main__':
    sys.exit(main())
