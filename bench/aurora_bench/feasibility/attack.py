# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.feasibility.attack`: try to realise what was proven impossible.

Certified requests of the families run in the local engine as if they had not been refused, with
other seeds and with what nobody states drawn anew from its domain. The independent checker says
whether a run is what was asked, and the product whether it kept what every run has to keep: one
such run refutes a certificate, however often it was checked.

A number beyond a limit is left out: the limit says so, not the world.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.feasibility.families import Case, family_cases
from aurora_bench.feasibility.judge import judged
from aurora_bench.progress import Progress
from aurora_bench.results import Table, markdown_table, write_results
from aurora_bench.rulers.checking import asked_of, independent_checker
from aurora_bench.rulers.runs import on_map, run_into
from aurora_bench.rulers.watched import WatchedStages
from aurora_cli.installed import installed
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.feasibility import Feasibility, FeasibilityVerdict, Rule
from aurora_core.pipeline.stages import RunRequest
from aurora_core.spec.scenario import ScenarioSpec

# A number that nobody states is drawn anew this often; else it stays as it is.
_DRAWN = 0.5
# Certificates of flights that last longer say little about placements and take hours to fly.
_LONGEST_S = 400.0
_MOST_AGENTS = 20
# What every run has to keep and no annotation says: clearance, separation, no-fly zones.
_SAFETY = 'safety.'


class _Unchecked(WatchedStages):
    """The local engine without its feasibility check."""

    def check(self, agsg: Agsg, request: RunRequest) -> FeasibilityVerdict:
        """Let everything pass."""
        return FeasibilityVerdict(result=Feasibility.UNKNOWN)


def main(arguments: Sequence[str] | None = None) -> int:
    """Attack; return 0 when nothing was realised, else 1."""
    parser = argparse.ArgumentParser(prog='aurora_bench.feasibility.attack', description=__doc__)
    parser.add_argument('--map', default='downtown')
    parser.add_argument('--requests', type=int, default=20, help='certified requests, at most')
    parser.add_argument('--runs', type=int, default=20, help='runs of each')
    parser.add_argument('--seed', type=int, default=1, help='of what is drawn')
    parser.add_argument('--only', default='', help='requests whose id begins so')
    parser.add_argument('--results', type=Path, default=None, help='folder for JSON and Markdown')
    parser.add_argument('--name', default='feasibility_attack', help='of the files of results')
    options = parser.parse_args(arguments)
    chosen = _certified(options.map, options.only)
    step = max(1, len(chosen) // options.requests)
    chosen = chosen[::step][: options.requests]
    progress = Progress('attack', len(chosen) * options.runs)
    rows: list[tuple[str, str, int, int, str]] = []
    with tempfile.TemporaryDirectory(prefix='aurora_attack_') as place:
        for case in chosen:
            ends: Counter[str] = Counter()
            realised = 0
            for k in range(options.runs):
                status, holds = _attacked(case, k, options, Path(place))
                ends[status] += 1
                realised += holds
                progress.step(f'{case.id}: {status}{"; REALISED" if holds else ""}')
            told = ', '.join(f'{n} {s}' for s, n in sorted(ends.items()))
            rows.append((case.id, '/'.join(case.because), options.runs, realised, told))
    table = Table(headings=('request', 'reason', 'runs', 'realised', 'ended'), rows=rows)
    found = sum(row[3] for row in rows)
    line = f'attacked {len(rows)} requests, {sum(r[2] for r in rows)} runs; realised {found}'
    sys.stdout.write(f'{markdown_table(table)}\n\n{line}\n')
    if options.results is not None:
        document = {'rows': [list(row) for row in rows], 'last_line': line}
        title = 'What was proven impossible, tried'
        write_results(options.results, options.name, document, title=title, tables=(table,))
    return 1 if found else 0


def _certified(map_name: str, only: str) -> list[Case]:
    """Return annotated requests that are refused and that a run could be long enough for."""
    known = installed()
    found = []
    for case in family_cases():
        if case.spec is None or not case.must_be_refused or not case.id.startswith(only):
            continue
        long = [m.duration_s for m in case.spec.missions if m.duration_s is not None]
        world = case.spec.world.duration_s
        length = sum(d.value for d in long) + (world.value if world is not None else 0.0)
        if length > _LONGEST_S or len(case.spec.agents) > _MOST_AGENTS:
            continue
        proofs = judged(known, map_name, case).certificates
        if any(p.rule not in (Rule.LIMIT, Rule.COUNT, Rule.BATTERY) for p in proofs):
            found.append(case)
    return found


def _attacked(
    case: Case, index: int, options: argparse.Namespace, place: Path
) -> tuple[str, bool]:
    """Run a request once; return its status and whether the checker denies nothing."""
    assert case.spec is not None
    draw = random.Random(f'{options.seed} {case.id} {index}')
    spec = case.spec if index == 0 else varied(case.spec, draw)
    request = RunRequest(prompt=case.prompt, seed=index + 1, map_name=options.map)
    stages = _Unchecked(on_map(spec, options.map))
    report, folder = run_into(place / f'{case.id}-{index}', request, stages)
    if report.trace is None:
        failure = stages.grounding.failure if stages.grounding is not None else None
        why = f' ({failure.reason})' if failure is not None else ''
        return f'{report.status.value}{why}', False
    said = asked_of(independent_checker(), folder.path / report.trace.bag, dict(case.document))
    safe = all(c.satisfied for c in report.conditions if c.id.startswith(_SAFETY))
    holds = bool(said) and all(s.outcome == 'holds' for s in said)
    return report.status.value, holds and safe


def varied(spec: ScenarioSpec, draw: random.Random) -> ScenarioSpec:
    """Return a request with some of what nobody states drawn anew from its domain."""

    def change(value: Any) -> Any:
        if isinstance(value, list):
            return [change(inner) for inner in value]
        if not isinstance(value, dict):
            return value
        if value.get('provenance') == 'default':
            low, high = value['low'], value['high']
            if low < high and draw.random() < _DRAWN:
                return {**value, 'value': round(draw.uniform(low, high), 1)}
            return value
        return {name: change(inner) for name, inner in value.items()}

    return ScenarioSpec.model_validate(change(spec.model_dump(mode='json')))


if __name__ == '__main__':
    sys.exit(main())
