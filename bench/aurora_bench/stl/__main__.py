# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`python -m aurora_bench.stl --results docs/bench`: the STL core beside other libraries.

Exit code: 0; 1 when a value differs from RTAMT's; 4 when the campaign broke. Goals of speed are
stated as met or not and do not fail.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from aurora_bench.interrupt import stop_on_sigterm
from aurora_bench.machine import busy_share, machine_facts
from aurora_bench.progress import Progress
from aurora_bench.results import goal_table, markdown_table, write_results
from aurora_bench.stl.agreement import Comparison
from aurora_bench.stl.cells import LENGTHS, all_cells
from aurora_bench.stl.figure import draw
from aurora_bench.stl.goals import RATIO_GOALS, goal_cell, goals
from aurora_bench.stl.pairs import pair
from aurora_bench.stl.report import document, notes, tables
from aurora_bench.stl.rivals import rivals_python
from aurora_bench.stl.speed import Measured, Speed, run_all
from aurora_bench.stl.tools import TOOLS
from aurora_core.errors import AuroraError

_BROKEN = 4
_ROOT = Path(__file__).resolve().parents[3]
_PAIRS_A_STEP = 1_000


def main(arguments: Sequence[str] | None = None) -> int:
    """Compare, measure, write the results; return the exit code."""
    stop_on_sigterm()
    options = _parser().parse_args(arguments)
    machine, busy = machine_facts(), busy_share(3.0)
    cells = all_cells(options.longest)
    patient = frozenset((tool, goal_cell(kind)) for tool, kind, _ in RATIO_GOALS)
    progress = Progress('stl', -(-options.pairs // _PAIRS_A_STEP) + len(cells) * len(TOOLS))
    try:
        rivals = rivals_python(_ROOT)
        comparison = _compare(options.seed, options.pairs, progress)
        with tempfile.TemporaryDirectory(prefix='aurora_stl_') as folder:
            speed = Speed(rivals, Path(folder), options.limit, patient)
            run_all(speed, cells, lambda found: progress.step(_line(found)))
        measured = speed.measured
        found = goals(comparison, measured)
        files = write_results(
            options.results,
            'stl',
            document(comparison, measured, options.seed, options.pairs, busy),
            title='Signal temporal logic: values and speed beside other libraries',
            tables=tables(comparison, measured),
            goals=found,
            notes=notes(comparison, busy),
            machine=machine,
        )
        pictures = draw(measured, options.results)
    except AuroraError as err:
        sys.stderr.write(f'stl: {err.component}: {err}\n')
        return _BROKEN
    sys.stdout.write(markdown_table(goal_table(found)) + '\n')
    progress.note('written: ' + ', '.join(str(path) for path in (*files, *pictures)))
    return int(bool(comparison.unequal))


def _compare(seed: int, pairs: int, progress: Progress) -> Comparison:
    comparison = Comparison()
    for number in range(pairs):
        comparison.compare(pair(seed, number))
        if (number + 1) % _PAIRS_A_STEP == 0 or number + 1 == pairs:
            progress.step(f'{number + 1} pairs, unequal to RTAMT: {len(comparison.unequal)}')
    return comparison


def _line(found: Measured) -> str:
    cell = found.cell
    what = f'{cell.kind} n={cell.samples} w={cell.window} {found.tool}: '
    if found.median_s is None:
        return what + (found.note if found.tried else 'not tried')
    return what + f'{found.median_s * 1e3:.4g} ms, {found.values}'


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog='python -m aurora_bench.stl', description=__doc__)
    add = parser.add_argument
    add('--results', type=Path, default=Path('docs/bench'), help='folder for the results')
    add('--seed', type=int, default=20_260, help='of the random formulas and traces')
    add('--pairs', type=int, default=24_000, help='formulas and traces to compare with RTAMT')
    add('--longest', type=int, choices=LENGTHS, default=LENGTHS[-1], help='samples of a trace')
    add('--limit', type=float, default=10.0, help='seconds that one tool may take for one cell')
    return parser


if __name__ == '__main__':
    sys.exit(main())
