# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Random formulas and traces, one pair per seed and number.

Only what AURORA and RTAMT both can say: a window that begins later and has no end (`always [2,
inf]`) is not in RTAMT's grammar. Half of the traces hold small whole numbers, so that many values
are equal and comparisons meet zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aurora_core.stl.formula import (
    WHOLE,
    Always,
    And,
    Comparison,
    Eventually,
    Formula,
    Historically,
    Implies,
    Interval,
    Not,
    Once,
    Or,
    Predicate,
    Since,
    TimeUnit,
    Until,
)
from aurora_core.stl.windows import FloatArray

MAX_DEPTH = 4
MAX_SAMPLES = 200
SIGNALS = ('x', 'y')

_BOOLEAN = (Not, And, Or, Implies)
_TEMPORAL = (Always, Eventually, Historically, Once, Until, Since)
_WITHOUT_END = 0.2  # share of the temporal operators
_LATE = 0.4  # share of the bounded ones whose window begins later than now
_MAX_LOW, _MAX_WIDTH = 10, 25


@dataclass(frozen=True, kw_only=True)
class Pair:
    """A formula over x and y, and a trace of both, one tick apart.

    Attributes:
        number: Which one of its seed.
    """

    number: int
    formula: Formula
    trace: dict[str, FloatArray]

    @property
    def samples(self) -> int:
        """Length of the trace."""
        return len(self.trace[SIGNALS[0]])


def pair(seed: int, number: int) -> Pair:
    """Return a pair; equal arguments give equal pairs.

    The outermost operator takes turns, so that every one is there equally often.
    """
    chance = np.random.default_rng((seed, number))
    depth = int(chance.integers(1, MAX_DEPTH + 1))
    kinds = _TEMPORAL + _BOOLEAN
    formula = _operator(chance, depth, kinds[number % len(kinds)])
    # Lengths from 1 to 200, short ones, where the edges are, as often as long ones.
    n = int(np.exp(chance.uniform(0.0, np.log(MAX_SAMPLES + 1))))
    whole = chance.random() < 0.5
    trace = {
        name: chance.integers(-4, 5, n).astype(float) if whole else chance.normal(0.0, 3.0, n)
        for name in SIGNALS
    }
    return Pair(number=number, formula=formula, trace=trace)


def _formula(chance: np.random.Generator, depth: int) -> Formula:
    if depth == 0 or chance.random() < 0.15:
        return _predicate(chance)
    kinds = _TEMPORAL if chance.random() < 0.6 else _BOOLEAN
    return _operator(chance, depth, kinds[chance.integers(len(kinds))])


def _operator(chance: np.random.Generator, depth: int, kind: type[Formula]) -> Formula:
    first = _formula(chance, depth - 1)
    if kind is Not:
        return Not(operand=first)
    for boolean in (And, Or, Implies):
        if kind is boolean:
            return boolean(left=first, right=_formula(chance, depth - 1))
    for binary in (Until, Since):
        if kind is binary:
            second = _formula(chance, depth - 1)
            return binary(left=first, right=second, interval=_interval(chance))
    (unary,) = (each for each in (Always, Eventually, Historically, Once) if kind is each)
    return unary(operand=first, interval=_interval(chance))


def _predicate(chance: np.random.Generator) -> Predicate:
    comparisons = list(Comparison)
    return Predicate(
        signal=SIGNALS[chance.integers(len(SIGNALS))],
        op=comparisons[chance.integers(len(comparisons))],
        threshold=int(chance.integers(-16, 17)) / 4,
        tolerance=int(chance.integers(0, 9)) / 4,
    )


def _interval(chance: np.random.Generator) -> Interval:
    if chance.random() < _WITHOUT_END:
        return WHOLE
    low = int(chance.integers(1, _MAX_LOW + 1)) if chance.random() < _LATE else 0
    width = int(chance.integers(0, _MAX_WIDTH + 1))
    return Interval(low=low, high=low + width, unit=TimeUnit.TICKS)
