# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.stn --results docs/bench`: Simple Temporal Networks beside SciPy.

Exit code: 0; 1 when a network differs from SciPy's or a circle is none; 4 when the campaign broke.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import Goal, Table, goal_table, markdown_table, write_results
from aurora_bench.stn.agreement import Comparison
from aurora_bench.stn.networks import MAX_POINTS, Kind, network
from aurora_core.errors import AuroraError

NETWORKS_GOAL = 10_000
_BROKEN = 4
_A_STEP = 500


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, write the results; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    machine = machine_facts()
    progress = Progress('stn', -(-options.networks // _A_STEP))
    comparison = Comparison()
    for number in range(options.networks):
        comparison.compare(network(options.seed, number))
        if (number + 1) % _A_STEP == 0 or number + 1 == options.networks:
            progress.step(f'{number + 1} networks, unequal: {len(comparison.unequal)}')
    found = goals(comparison)
    try:
        files = write_results(
            options.results,
            'stn',
            document(comparison, options.seed),
            title='Simple Temporal Networks beside Bellman-Ford of SciPy',
            tables=(_table(comparison),),
            goals=found,
            notes=_notes(comparison),
            machine=machine,
        )
    except AuroraError as err:
        sys.stderr.write(f'stn: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(markdown_table(goal_table(found)) + '\n')
    progress.note('written: ' + ', '.join(str(path) for path in files))
    return int(bool(comparison.unequal or comparison.broken))


def goals(comparison: Comparison) -> tuple[Goal, ...]:
    """Return what is asked, with what was found."""
    count = sum(comparison.networks.values())
    enough = count >= NETWORKS_GOAL
    least, most = comparison.sizes
    equal, whole = not comparison.unequal, not comparison.broken
    return (
        Goal(
            name='consistency and every value of the minimal network as SciPy has it',
            target=f'all of at least {NETWORKS_GOAL} networks, exactly',
            figure=f'{count - len(set(comparison.unequal))} of {count} '
            f'({comparison.values} values)',
            met=(enough and equal) if enough or not equal else None,
        ),
        Goal(
            name='negative circles added up again',
            target='all negative, closed, no point twice, of bounds of the network',
            figure=f'{comparison.circles - len(comparison.broken)} of {comparison.circles}, '
            f'the longest of {comparison.longest} bounds',
            met=whole if comparison.circles else None,
        ),
        Goal(
            name='points of a network',
            target=f'from 1 to {MAX_POINTS}',
            figure=f'from {least} to {most}',
            met=(least, most) == (1, MAX_POINTS) if enough else None,
        ),
    )


def document(comparison: Comparison, seed: int) -> dict[str, Any]:
    """Return everything as plain JSON values."""
    return {
        'seed': seed,
        'networks': {str(kind): comparison.networks[kind] for kind in Kind},
        'inconsistent': {str(kind): comparison.inconsistent[kind] for kind in Kind},
        'values': comparison.values,
        'unequal': comparison.unequal,
        'circles': comparison.circles,
        'broken': comparison.broken,
        'longest_circle': comparison.longest,
        'points': list(comparison.sizes),
        'seconds': {name: round(value, 2) for name, value in comparison.seconds.items()},
    }


def _table(comparison: Comparison) -> Table:
    return Table(
        headings=('networks', 'drawn', 'consistent', 'inconsistent'),
        rows=[
            (
                kind.value,
                comparison.networks[kind],
                comparison.networks[kind] - comparison.inconsistent[kind],
                comparison.inconsistent[kind],
            )
            for kind in Kind
        ],
        caption='Met: by times that were drawn first. Tightened: the same with one bound too '
        'tight. Free: bounds drawn freely.',
    )


def _notes(comparison: Comparison) -> tuple[str, ...]:
    mine, theirs = comparison.seconds['AURORA'], comparison.seconds['SciPy']
    return (
        'Values are whole microseconds in both; a double holds each sum exactly, so equal means '
        f'equal. Seconds for all networks: AURORA {mine:.1f} (circle and minimal network), SciPy '
        f'{theirs:.1f} (`scipy.sparse.csgraph.bellman_ford`, all pairs).',
    )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.stn', description=__doc__)
    add = parser.add_argument
    add('--results', type=Path, default=Path('docs/bench'), help='folder for the results')
    add('--seed', type=int, default=20_260, help='of the random networks')
    add('--networks', type=int, default=NETWORKS_GOAL, help='how many to compare')
    return parser


if __name__ == '__main__':
    sys.exit(main())
