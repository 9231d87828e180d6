# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""python -m aurora_bench.graphs --results docs/bench [--graphs 4 --rounds 10]"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

from aurora_bench.graphs.campaign import PROMPTS, Outcome, campaign
from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, write_results
from aurora_core.errors import AuroraError

NAME = 'graphs'


def main() -> int:
    """Run the campaign; return 0 when nothing crossed, leaked or was left behind."""
    stop_on_sigterm()
    parser = argparse.ArgumentParser(prog=f'aurora_bench.{NAME}', description=__doc__)
    parser.add_argument('--results', type=Path, default=Path('docs/bench'), metavar='DIR')
    parser.add_argument('--graphs', type=int, default=4, help='graphs at once')
    parser.add_argument('--rounds', type=int, default=10, help='prompts for each')
    parser.add_argument(
        '--domain', type=int, default=int(os.environ.get('ROS_DOMAIN_ID') or 0),
        help='ROS domain of the first graph; the others take the next ones',
    )  # fmt: skip
    parser.add_argument('--keep', type=Path, metavar='DIR', help='folder for runs and logs')
    options = parser.parse_args()
    if options.graphs < 1 or options.rounds < 1:
        parser.error('--graphs and --rounds count from 1')
    machine = machine_facts()
    local = min(len(PROMPTS), options.rounds) * options.graphs
    progress = Progress(NAME, local + options.rounds)
    try:
        with tempfile.TemporaryDirectory(prefix='aurora-graphs-') as temporary:
            folder = (options.keep or Path(temporary)).absolute()
            outcome = campaign(folder, options.domain, options.graphs, options.rounds, progress)
        goals = goals_of(outcome, options.graphs * options.rounds)
        files = write_results(
            options.results, NAME,
            {'graphs': options.graphs, 'rounds': options.rounds, **outcome.as_results()},
            title=f'{options.graphs} graphs at once for {options.rounds} rounds',
            goals=goals, tables=(table_of(outcome),),
            notes=[f'- {problem}' for problem in outcome.problems], machine=machine,
        )  # fmt: skip
    except AuroraError as err:
        sys.stderr.write(f'{NAME}: {err.component}: {err}\n')
        return 1
    for problem in [*outcome.problems, *(row.problem for row in outcome.rows if row.problem)]:
        sys.stderr.write(f'{NAME}: {problem}\n')
    for goal in goals:
        sys.stdout.write(f'{"met" if goal.met else "NOT MET":<8}{goal.name}: {goal.figure}\n')
    sys.stdout.write(f'{files[0]} {files[1]}\n')
    return int(any(goal.met is False for goal in goals))


def goals_of(outcome: Outcome, runs: int) -> tuple[Goal, ...]:
    """Return what must hold."""
    equal = sum(row.is_equal for row in outcome.rows)
    hashes = len({row.expected_sha256 for row in outcome.rows})
    sockets = sum(count for nodes in outcome.sockets.values() for count in nodes.values())
    ids = [row.run_id for row in outcome.rows]
    problems = len(outcome.problems)
    return (
        Goal(
            name='runs with the status and the trace hash of the local engine',
            target=f'{runs}',
            figure=f'{equal} ({hashes} different hashes)',
            met=equal == runs and hashes > 1,
        ),
        Goal(
            name='run ids',
            target=f'{runs} different',
            figure=f'{len(set(ids))}',
            met=len(set(ids)) == runs,
        ),
        Goal(
            name='sockets that take something in, all on 127.0.0.1; nodes, ports and runs of a '
            'domain its own; nothing left after down',
            target='no problem',
            figure=f'{problems} problems, {sockets} sockets',
            met=problems == 0 and sockets > 0,
        ),
    )


def table_of(outcome: Outcome) -> Table:
    """Return a row per domain."""
    rows = []
    for domain, nodes in sorted(outcome.sockets.items()):
        runs = [row for row in outcome.rows if row.domain == int(domain)]
        ports = outcome.ports[domain]
        slowest = max((row.wall_s for row in runs), default=0.0)
        rows.append(
            (
                domain,
                len(nodes),
                sum(nodes.values()),
                f'{ports[0]} to {ports[-1]}',
                len(runs),
                sum(row.is_equal for row in runs),
                slowest,
            )
        )
    headings = (
        'domain', 'processes', 'sockets', 'ports', 'runs', 'equal to local', 'slowest run [s]'
    )  # fmt: skip
    return Table(headings=headings, rows=rows, caption=f'All up after {outcome.up_s:.1f} s.')


if __name__ == '__main__':
    sys.exit(main())
