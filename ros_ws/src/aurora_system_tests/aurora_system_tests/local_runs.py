# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run with the local engine, and what its verdict complains of, in a few words."""

from __future__ import annotations

import os
from datetime import UTC, datetime
from pathlib import Path

from aurora_cli.clock import MonotonicClock
from aurora_cli.installed import installed
from aurora_core.outcomes.verdict import Verdict
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest, Stages
from aurora_core.report.outputs import write_report
from aurora_core.report.run_folder import RunFolder, new_run_id
from aurora_core.report.run_report import RunReport


def run_prompt(
    name: str,
    prompt: str,
    seed: int,
    folder: Path,
    stages: Stages,
    faults: tuple[dict[str, object], ...] = (),
) -> tuple[RunReport, Path]:
    """Run a prompt once, without repair; return its report and the folder of its bag."""
    asked = {'prompt': prompt, 'seed': seed, 'faults': faults, 'repair': 0}
    request = RunRequest.model_validate(asked)
    run_id = new_run_id(datetime.now(UTC), os.urandom(3))
    run_folder = RunFolder(folder / f'{name.replace(" ", "_")}_{seed}', run_id)
    report = run(
        request,
        stages,
        installed(),
        run_folder,
        RunControl(),
        MonotonicClock(),
        outputs=write_report,  # nobody looks at the page
    )
    return report, run_folder.bag_path(0)


def names_of(verdict: Verdict) -> frozenset[str]:
    """Return what a verdict complains of.

    `condition:ID` for each that is not satisfied, `reason:REASON` for each without a margin,
    `finding:KIND` for each claim that is not borne out, `integrity:STATE` when not intact.
    """
    found = {f'condition:{r.id}' for r in verdict.results if not r.satisfied}
    found |= {f'reason:{r.reason.value}' for r in verdict.results if r.reason is not None}
    found |= {f'finding:{f.kind}' for f in verdict.cross_check}
    if verdict.integrity.value != 'intact':
        found.add(f'integrity:{verdict.integrity.value}')
    return frozenset(found)
