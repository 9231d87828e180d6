# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.lockstep --results docs/bench`: the speed of both engines.

Exit code: 0; 1 when runs of one configuration have different trace hashes; 4 when a run broke;
64 when an option is out of range. Goals of speed are stated as met or not and do not fail: they
are meant for a quiet machine with 2 cores.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.lockstep.campaign import Campaign, Plan
from aurora_bench.lockstep.figure import draw
from aurora_bench.lockstep.goals import goals, one_hash_each
from aurora_bench.lockstep.scenarios import Configuration, ScenarioRefusedError
from aurora_bench.lockstep.summary import document, notes, tables
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import goal_table, markdown_table, write_results
from aurora_core.errors import AuroraError

_BROKEN, _USAGE = 4, 64


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, write the results, print goals and table; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    try:
        plan = _plan(options)
    except ScenarioRefusedError as err:
        sys.stderr.write(f'lockstep: {err}\n')
        return _USAGE
    machine = machine_facts()
    progress = Progress('lockstep', plan.steps())
    campaign = Campaign(plan, progress)
    try:
        campaign.run()
        found, shown = goals(campaign, plan), tables(campaign, plan)
        files = write_results(
            options.results,
            'lockstep',
            document(campaign, plan),
            title='Speed of the lockstep',
            goals=found,
            tables=shown,
            notes=notes(campaign),
            machine=machine,
        )
        pictures = draw(campaign.measured, options.results)
    except AuroraError as err:
        sys.stderr.write(f'lockstep: {err.component}: {err}\n')
        return _BROKEN
    for table in (goal_table(found), *shown):
        sys.stdout.write(markdown_table(table) + '\n\n')
    progress.note('written: ' + ', '.join(str(path) for path in (*files, *pictures)))
    equal, count = one_hash_each(campaign.measured)
    return 0 if equal == count else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.lockstep', description=__doc__)
    add = parser.add_argument
    add('--results', type=Path, default=Path('docs/bench'), help='folder for the results')
    add('--quick', action='store_true', help='10 and 30 agents, 1 UAV, 60 s, 2 repetitions')
    add('--engines', nargs='+', choices=('local', 'ros'), default=['local', 'ros'])
    add('--agents', nargs='+', type=int, help='ground agents, with 1 UAV (10 30 100 200)')
    add('--uavs', nargs='+', type=int, help='UAVs, with the fewest agents (1 2 4 8)')
    add('--seconds', nargs='+', type=int, help='simulated durations (60 300)')
    add('--repetitions', type=_count, help='of each configuration (5; above 100 s at most 2)')
    return parser


def _count(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f'expected a count from 1 on, found {text!r}')
    return int(text)


def _plan(options: argparse.Namespace) -> Plan:
    quick = options.quick
    agents = sorted(set(options.agents or ([10, 30] if quick else [10, 30, 100, 200])))
    uavs = sorted(set(options.uavs or ([1] if quick else [1, 2, 4, 8])))
    seconds = sorted(set(options.seconds or ([60] if quick else [60, 300])))
    pairs = dict.fromkeys([*((n, 1) for n in agents), *((agents[0], u) for u in uavs)])
    return Plan(
        engines=tuple(dict.fromkeys(options.engines)),
        configurations=tuple(
            Configuration(agents=n, uavs=u, seconds=s) for s in seconds for n, u in pairs
        ),
        repetitions=options.repetitions or (2 if quick else 5),
        barrier_ticks=1500 if quick else 3000,
        cold_starts=1 if quick else 3,
    )


if __name__ == '__main__':
    sys.exit(main())
