# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a tool's values are ours; where not, whether its `until` means something else."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from aurora_bench.stl.cells import Cell, Kind
from aurora_bench.stl.tools import Floats
from aurora_bench.stl.worker import trace
from aurora_core.stl.formula import (
    And,
    Comparison,
    Eventually,
    Formula,
    Interval,
    Predicate,
    TimeUnit,
    Until,
)
from aurora_core.stl.robustness import SampledSignals, robustness

TOLERANCE = 1e-9


def same_values(cell: Cell, ours: Floats, theirs: Floats) -> tuple[bool, str]:
    """Compare values from the first sample on, as far as both have some.

    Returns:
        Whether they are ours, and in words what was compared and what differs.
    """
    if len(theirs) == 0:
        return False, 'no values'
    common = min(len(ours), len(theirs))
    span = f'{common} values' if common > 1 else 'first value'
    unequal = np.flatnonzero(~(np.abs(ours[:common] - theirs[:common]) <= TOLERANCE))
    if len(unequal) == 0:
        return True, f'{span} equal'
    for words, variant in _variants(cell).items():
        other = variant()[:common]
        if np.all(np.abs(other - theirs[: len(other)]) <= TOLERANCE):
            return False, f'{span} equal to ours for "{words}"'
    return False, f'{len(unequal)} of {span} differ, first at sample {unequal[0]}'


def _variants(cell: Cell) -> dict[str, Callable[[], Floats]]:
    """Return other readings of until that libraries have, written in our own operators."""
    if cell.kind not in (Kind.UNTIL, Kind.UNTIL_END):
        return {}
    x, y = (Predicate(signal=name, op=Comparison.GE, threshold=0.0) for name in ('x', 'y'))
    low, high = cell.until
    whole = cell.kind is Kind.UNTIL_END
    interval = Interval() if whole else _ticks(low, high)
    both = And(left=x, right=y)
    found: dict[str, Formula] = {'x U (x and y)': Until(left=x, right=both, interval=interval)}
    if not whole:
        late = Until(left=x, right=y, interval=_ticks(0, high - low))
        found['F[a,a] (x U[0,b-a] y)'] = Eventually(operand=late, interval=_ticks(low, low))
        late = Until(left=x, right=both, interval=_ticks(0, high - low))
        found['F[a,a] (x U[0,b-a] (x and y))'] = Eventually(
            operand=late, interval=_ticks(low, low)
        )
    return {words: lambda f=formula: _values(f, cell) for words, formula in found.items()}  # type: ignore[misc]


def _values(formula: Formula, cell: Cell) -> Floats:
    x, y = trace(cell.samples)
    return robustness(formula, SampledSignals(values={'x': x, 'y': y}, dt_s=1.0)).values


def _ticks(low: int, high: int) -> Interval:
    return Interval(low=low, high=high, unit=TimeUnit.TICKS)
