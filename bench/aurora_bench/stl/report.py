# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Tables, notes and the JSON document of the campaign."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from aurora_bench.results import Cell as TableCell
from aurora_bench.results import Table
from aurora_bench.stl.agreement import EXPLANATIONS, Comparison, Mode, Reason
from aurora_bench.stl.cells import GOAL_WINDOW, SHAPES, Cell, Kind
from aurora_bench.stl.rivals import LEFT_OUT
from aurora_bench.stl.speed import Measured
from aurora_bench.stl.tools import OURS, TOOLS


def tables(comparison: Comparison, measured: Sequence[Measured]) -> tuple[Table, ...]:
    """Return every table, the comparison with RTAMT first."""
    return (
        _reasons(comparison),
        *(table for kind in Kind if (table := _times(measured, kind)) is not None),
        _readings(measured),
        Table(
            headings=('library', 'why it is not here'),
            rows=LEFT_OUT,
            caption='STL libraries that were looked at and left out.',
        ),
    )


def _reasons(comparison: Comparison) -> Table:
    rows: list[tuple[TableCell, ...]] = []
    for mode, counts in comparison.modes.items():
        for reason in Reason:
            pairs = counts.pairs_left_out[reason]
            samples = counts.samples_left_out[reason]
            if pairs or samples:
                rows.append((mode, reason, pairs, samples, EXPLANATIONS[reason]))
    return Table(
        headings=('comparison', 'where', 'pairs', 'samples of other pairs', 'what each tool does'),
        rows=rows,
        caption='Not compared with RTAMT, and why: whole pairs, and single samples of pairs that '
        'were compared.',
    )


def _times(measured: Sequence[Measured], kind: Kind) -> Table | None:
    """Return the times of a formula: one row per tool, one column per cell."""
    cells = sorted({each.cell for each in measured if each.cell.kind is kind})
    if not cells:
        return None
    found = {(each.tool, each.cell): each for each in measured}
    rows = [
        (tool, *(_time(found.get((tool, cell)), found.get((OURS, cell))) for cell in cells))
        for tool in TOOLS
        if any((tool, cell) in found for cell in cells)
    ]
    return Table(
        headings=('tool', *(_heading(cell) for cell in cells)),
        rows=rows,
        caption=f'{kind}, `{SHAPES[kind]}`: milliseconds (median), and how many times as long as '
        'AURORA.',
    )


def _heading(cell: Cell) -> str:
    return f'n={cell.samples}' + (f' w={cell.window}' if cell.window else '')


def _time(found: Measured | None, ours: Measured | None) -> str:
    if found is None:
        return ''
    if found.median_s is None:
        return found.note if found.tried else 'not tried'
    text = f'{found.median_s * 1e3:.3g}'
    if found.tool != OURS and ours is not None and ours.median_s:
        text += f' ({found.median_s / ours.median_s:.3g} x)'
    return text + ('' if found.agrees else ' *')


def _readings(measured: Sequence[Measured]) -> Table:
    """Return per tool and formula how its values compare with ours."""
    rows: list[tuple[TableCell, ...]] = []
    for tool in TOOLS:
        for kind in Kind:
            own = [each for each in measured if (each.tool, each.cell.kind) == (tool, kind)]
            given = [each for each in own if each.seconds]
            if tool == OURS or not own:
                continue
            if not given:
                rows.append((tool, kind, 0, own[0].note))
                continue
            # Equal ones differ in their number only, which the trace length tells.
            words = dict.fromkeys(
                each.values if 'differ' in each.values else each.values.lstrip('0123456789 ')
                for each in given
            )
            rows.append((tool, kind, len(given), '; '.join(words)))
    return Table(
        headings=('tool', 'formula', 'cells', 'its values beside ours'),
        rows=rows,
        caption='Values, compared within 1e-9 at the first sample and at every one where both '
        'have a value (full windows).',
    )


def notes(comparison: Comparison, busy: float) -> tuple[str, ...]:
    """Return the paragraphs below the tables."""
    compared = ', '.join(f'{mode}: {counts.pairs}' for mode, counts in comparison.modes.items())
    return (
        'Times are those of one call in a process of its own: formula read and trace in the '
        "tool's own form before the clock starts; ours includes checking the samples. An asterisk "
        'marks values that are not ours. pybanquo, stlpy and py-signal-temporal-logic give the '
        'first value only, all others the whole signal; reelay has past operators only and reads '
        'the trace backwards.',
        f'w = {GOAL_WINDOW} where no window is given. "Not tried": the tool failed or ran out of '
        'time on a shorter trace or smaller window of the same formula.',
        f'Pairs with at least one value compared with RTAMT: {compared}. '
        f'Cores used by others before the run: {busy:.0%}.',
    )


def document(
    comparison: Comparison, measured: Sequence[Measured], seed: int, pairs: int, busy: float
) -> dict[str, Any]:
    """Return everything as plain JSON values."""
    return {
        'seed': seed,
        'pairs': pairs,
        'busy_share_before': round(busy, 3),
        'rtamt': {mode: _counts(comparison, mode) for mode in comparison.modes},
        'cells': [
            {
                'tool': each.tool,
                'version': each.version,
                'kind': each.cell.kind,
                'samples': each.cell.samples,
                'window': each.cell.window,
                'seconds': [round(value, 7) for value in each.seconds],
                'values': each.values,
                'agrees': each.agrees,
                'note': each.note,
                'tried': each.tried,
            }
            for each in measured
        ],
        'left_out': dict(LEFT_OUT),
    }


def _counts(comparison: Comparison, mode: Mode) -> dict[str, Any]:
    counts = comparison.modes[mode]
    return {
        'pairs': counts.pairs,
        'values': counts.samples,
        'greatest_difference': counts.greatest,
        'unequal_pairs': counts.unequal,
        'pairs_left_out': {str(reason): n for reason, n in counts.pairs_left_out.items()},
        'samples_left_out': {str(reason): n for reason, n in counts.samples_left_out.items()},
    }
