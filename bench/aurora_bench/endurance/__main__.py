# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.endurance --results docs/bench` (also: `make bench-endurance`).

Runs prompts of different kinds one after the other with the local engine in this process, from
the prompt to the report.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from datetime import UTC, datetime
from pathlib import Path

from aurora_bench.endurance.cases import cases
from aurora_bench.endurance.holdings import Holdings, growth_goals, holdings
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, told_goals, write_results
from aurora_cli.clock import MonotonicClock
from aurora_cli.installed import installed
from aurora_cli.local_engine import LocalStages
from aurora_core.pipeline.run import run
from aurora_core.pipeline.stages import RunControl, RunRequest
from aurora_core.report.run_folder import RunFolder, new_run_id

# Fewer runs would meet some lazily built table for the first time after the early sample.
_EARLY_RUNS = 10

# What a run gave: its status and its trace hash ('' when nothing was flown).
Outcome = tuple[str, str]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the campaign; return 1 when something that must hold does not."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog='aurora_bench.endurance', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='FOLDER')
    parser.add_argument('--runs', type=int, default=100)
    options = parser.parse_args(arguments)
    if options.runs <= _EARLY_RUNS:
        parser.error(f'--runs: expected more than {_EARLY_RUNS}, found {options.runs}')
    machine = machine_facts()
    progress = Progress('endurance', options.runs)
    requests = cases()
    outcomes: list[list[Outcome]] = [[] for _ in requests]
    samples: list[Holdings] = []
    for index in range(options.runs):
        which = index % len(requests)
        outcome = _run(requests[which], index)
        outcomes[which].append(outcome)
        samples.append(holdings())
        now = samples[-1]
        progress.step(
            f'{outcome[0]} {outcome[1][:12] or "-"}  {now.memory_mib:.0f} MiB, '
            f'{now.descriptors} descriptors, {now.threads} threads'
        )
    early, late = samples[_EARLY_RUNS - 1], samples[-1]
    goals = (*growth_goals(early, late, _EARLY_RUNS, options.runs), *sameness_goals(outcomes))
    write_results(
        options.results,
        'endurance',
        {
            'runs': options.runs,
            'early_runs': _EARLY_RUNS,
            'memory_mib': [round(s.memory_mib, 2) for s in samples],
            'descriptors': [s.descriptors for s in samples],
            'threads': [s.threads for s in samples],
            'cases': [
                {'prompt': r.prompt, 'runs': len(o), 'outcomes': sorted({' '.join(x) for x in o})}
                for r, o in zip(requests, outcomes, strict=True)
            ],
        },
        title='Endurance of the local engine',
        goals=goals,
        tables=(_table(samples, options.runs),),
        notes=(
            'Prompts of different kinds, some with faults, one refused and one not understood, '
            'run in turn in one process, each from the prompt to the report.',
        ),
        machine=machine,
    )
    return told_goals(goals)


def sameness_goals(outcomes: Sequence[Sequence[Outcome]]) -> tuple[Goal, ...]:
    """Return what must hold between the repetitions of each case."""
    several = sum(len(set(repeated)) > 1 for repeated in outcomes)
    broken = sum(status == 'error' for repeated in outcomes for status, _ in repeated)
    return (
        Goal(
            name='cases whose repetitions differ in status or trace hash',
            target='0',
            figure=str(several),
            met=several == 0,
        ),
        Goal(name='runs that ended in error', target='0', figure=str(broken), met=broken == 0),
    )


def _run(request: RunRequest, index: int) -> Outcome:
    with tempfile.TemporaryDirectory(prefix='aurora_endurance_') as name:
        run_id = new_run_id(datetime.now(UTC), index.to_bytes(3, 'big'))
        folder = RunFolder(Path(name), run_id)
        report = run(
            request, LocalStages(installed()), installed(), folder, RunControl(), MonotonicClock()
        )
    return report.status, '' if report.trace is None else report.trace.sha256


def _table(samples: Sequence[Holdings], runs: int) -> Table:
    shown = sorted({1, _EARLY_RUNS, *range(25, runs, 25), runs})
    return Table(
        headings=('runs', 'memory [MiB]', 'descriptors', 'threads', '/dev/shm'),
        rows=tuple(
            (
                count,
                round(samples[count - 1].memory_mib, 1),
                samples[count - 1].descriptors,
                samples[count - 1].threads,
                len(samples[count - 1].shared_memory),
            )
            for count in shown
            if count <= runs
        ),
    )


if __name__ == '__main__':
    sys.exit(main())
