# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is asked of the STL core, and what was found."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from aurora_bench.results import Goal
from aurora_bench.stl.agreement import TOLERANCE, Comparison
from aurora_bench.stl.cells import GOAL_SAMPLES, GOAL_WINDOW, LENGTHS, SHAPES, Cell, Kind
from aurora_bench.stl.speed import Measured
from aurora_bench.stl.tools import OURS

PAIRS_GOAL = 10_000
# (tool, formula, how many times faster at least), at 10 000 samples and w = 100.
RATIO_GOALS = (
    ('RTAMT', Kind.NESTED, 500.0),
    ('RTAMT', Kind.UNTIL, 100_000.0),
    ('sentil', Kind.ALWAYS, 1.0),
    ('sentil', Kind.ALWAYS_END, 1.0),
    ('sentil', Kind.NESTED, 1.0),
    ('sentil', Kind.UNTIL, 1.0),
)
EXPONENT_GOAL = 1.1


def goals(comparison: Comparison, measured: Sequence[Measured]) -> tuple[Goal, ...]:
    """Return every goal with what was found."""
    return (
        *_equal_to_rtamt(comparison),
        _confirmed(measured),
        *(_faster(measured, *goal) for goal in RATIO_GOALS),
        *(_linear(measured, kind) for kind in Kind),
    )


def goal_cell(kind: Kind, samples: int = GOAL_SAMPLES) -> Cell:
    """Return the cell of a formula at w = 100."""
    endless = kind in (Kind.ALWAYS_END, Kind.UNTIL_END)
    return Cell(kind=kind, samples=samples, window=0 if endless else GOAL_WINDOW)


def seconds(measured: Sequence[Measured], tool: str, cell: Cell) -> float | None:
    """Return the median of a tool on a cell, None when it gave nothing."""
    for each in measured:
        if (each.tool, each.cell) == (tool, cell):
            return each.median_s
    return None


def exponent(measured: Sequence[Measured], kind: Kind) -> float | None:
    """Return the slope of log time over log length of ours, None with fewer than two lengths."""
    found = [(n, seconds(measured, OURS, goal_cell(kind, n))) for n in LENGTHS]
    points = [(n, s) for n, s in found if s is not None]
    if len(points) < 2:
        return None
    lengths, times = (np.log(np.array(column)) for column in zip(*points, strict=True))
    return float(np.polyfit(lengths, times, 1)[0])


def _equal_to_rtamt(comparison: Comparison) -> list[Goal]:
    found = []
    for mode, counts in comparison.modes.items():
        enough = counts.pairs >= PAIRS_GOAL
        equal = not counts.unequal
        found.append(
            Goal(
                name=f'equal to RTAMT, {mode}',
                target=f'all of at least {PAIRS_GOAL} pairs, within {TOLERANCE:g}',
                figure=f'{counts.pairs - len(counts.unequal)} of {counts.pairs} pairs '
                f'({counts.samples} values, greatest difference {counts.greatest:g})',
                met=(enough and equal) if enough or not equal else None,
            )
        )
    return found


def _confirmed(measured: Sequence[Measured]) -> Goal:
    """Count the cells whose values somebody confirms who reads the formula as we do.

    Several libraries read until in other ways. One that has our values in no cell of a formula
    confirms and refutes nothing there; the table of values names it.
    """
    given = [each for each in measured if each.tool != OURS and each.seconds]
    alike = {(each.tool, each.cell.kind) for each in given if each.agrees}
    kinds = {each.cell.kind for each in given}
    cells = {each.cell for each in given if (each.tool, each.cell.kind) in alike}
    confirmed = {each.cell for each in given if each.agrees}
    equal = sum(each.agrees is True for each in given)
    every_kind = {kind for _, kind in alike} == kinds
    others = len({each.cell for each in given} - cells)
    beside = f'; {others} more have values only of who reads it otherwise' if others else ''
    return Goal(
        name='cells whose values another library confirms',
        target=f'all {len(cells)} for which one that reads the formula as we do has values',
        figure=f'{len(confirmed)} ({equal} of {len(given)} results of others are ours; the '
        f'table of values names the rest{beside})',
        met=every_kind and len(confirmed) == len(cells) if given else None,
    )


def _faster(measured: Sequence[Measured], tool: str, kind: Kind, least: float) -> Goal:
    cell = goal_cell(kind)
    ours, theirs = seconds(measured, OURS, cell), seconds(measured, tool, cell)
    name = f'{tool} / AURORA, {kind}, {cell.samples} samples, {shape(cell)}'
    target = f'at least {least:g}'
    if ours is None or theirs is None:
        return Goal(name=name, target=target, figure='not measured', met=None)
    ratio = theirs / ours
    figure = f'{ratio:.4g} ({theirs * 1e3:.4g} ms, {ours * 1e3:.3g} ms)'
    return Goal(name=name, target=target, figure=figure, met=ratio >= least)


def _linear(measured: Sequence[Measured], kind: Kind) -> Goal:
    slope = exponent(measured, kind)
    return Goal(
        name=f'growth with the length, {kind}, up to {LENGTHS[-1]} samples',
        target=f'exponent at most {EXPONENT_GOAL}',
        figure='not measured' if slope is None else f'{slope:.2f}',
        met=None if slope is None else slope <= EXPONENT_GOAL,
    )


def shape(cell: Cell) -> str:
    """Return the formula of a cell with its numbers."""
    low, high = cell.until
    words = SHAPES[cell.kind].replace('w/5', str(low))
    return words.replace('2w', str(high)).replace('w', str(cell.window))
