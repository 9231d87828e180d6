# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signal temporal logic: the frozen syntax tree.

Time is discrete: sample i of every signal lies at i * dt. Predicates compare one named signal
with a constant. Intervals are closed and count from the sample at which the operator is
evaluated, into the future (always, eventually, until) or into the past (historically, once,
since).

Source: Maler and Nickovic 2004; Donzé and Maler 2010.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from math import ceil, floor, isfinite

from aurora_core.errors import VerificationError

# A bound in seconds that is this close to a whole tick is that tick: 0.15 / 0.05 is above 3.
TICK_GUARD = 1e-9


class Comparison(StrEnum):
    """Comparison of a predicate; `WITHIN` holds inside threshold +- tolerance."""

    GE = '>='
    GT = '>'
    LE = '<='
    LT = '<'
    WITHIN = '=='


class TimeUnit(StrEnum):
    """Unit of an interval."""

    SECONDS = 's'
    TICKS = 'ticks'


@dataclass(frozen=True, slots=True, kw_only=True)
class Interval:
    """Closed interval [low, high] of time; `high` None means without end."""

    low: float = 0.0
    high: float | None = None
    unit: TimeUnit = TimeUnit.SECONDS

    def __post_init__(self) -> None:
        """Refuse intervals that contain nothing.

        Raises:
            VerificationError: Unless 0 <= low <= high, both finite.
        """
        ordered = self.low >= 0.0 and (self.high is None or self.high >= self.low)
        if not ordered or not isfinite(self.low) or not isfinite(self.high or 0.0):
            raise VerificationError(
                f'STL interval needs 0 <= low <= high, found [{self.low}, {self.high}]'
            )

    def ticks(self, dt_s: float) -> tuple[int, int | None]:
        """Return the interval in whole ticks: the samples that lie inside it.

        Args:
            dt_s: Time step.

        Raises:
            VerificationError: No sample lies inside.
        """
        step = dt_s if self.unit is TimeUnit.SECONDS else 1.0
        low = ceil(self.low / step - TICK_GUARD)
        if self.high is None:
            return low, None
        high = floor(self.high / step + TICK_GUARD)
        if high < low:
            raise VerificationError(
                f'STL interval [{self.low}, {self.high}] {self.unit} holds no sample at {dt_s} s'
            )
        return low, high


WHOLE = Interval()


@dataclass(frozen=True, slots=True, kw_only=True)
class Predicate:
    """`signal op threshold`.

    Robustness: signal - threshold (>=, >), threshold - signal (<=, <), tolerance - |signal -
    threshold| (==). At zero the strict comparisons do not hold.
    """

    signal: str
    op: Comparison
    threshold: float
    tolerance: float = 0.0
    unit: str = ''

    def __post_init__(self) -> None:
        """Refuse thresholds without meaning.

        Raises:
            VerificationError: A number is not finite, or the tolerance is negative.
        """
        if not isfinite(self.threshold) or not isfinite(self.tolerance) or self.tolerance < 0.0:
            raise VerificationError(
                f'STL predicate on {self.signal!r} needs a finite threshold and a tolerance >= 0, '
                f'found {self.threshold} +- {self.tolerance}'
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Not:
    """Negation."""

    operand: Formula


@dataclass(frozen=True, slots=True, kw_only=True)
class And:
    """Conjunction: the lesser robustness."""

    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True, kw_only=True)
class Or:
    """Disjunction: the greater robustness."""

    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True, kw_only=True)
class Implies:
    """`left -> right`, that is `not left or right`."""

    left: Formula
    right: Formula


@dataclass(frozen=True, slots=True, kw_only=True)
class Always:
    """At every sample of the interval ahead."""

    operand: Formula
    interval: Interval = WHOLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Eventually:
    """At some sample of the interval ahead."""

    operand: Formula
    interval: Interval = WHOLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Until:
    """`right` at some sample j of the interval ahead and `left` from now up to before j."""

    left: Formula
    right: Formula
    interval: Interval = WHOLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Historically:
    """At every sample of the interval behind."""

    operand: Formula
    interval: Interval = WHOLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Once:
    """At some sample of the interval behind."""

    operand: Formula
    interval: Interval = WHOLE


@dataclass(frozen=True, slots=True, kw_only=True)
class Since:
    """`right` at some sample j of the interval behind and `left` from after j up to now."""

    left: Formula
    right: Formula
    interval: Interval = WHOLE


Formula = (
    Predicate
    | Not
    | And
    | Or
    | Implies
    | Always
    | Eventually
    | Until
    | Historically
    | Once
    | Since
)


def children(formula: Formula) -> tuple[Formula, ...]:
    """Return the direct operands, left to right."""
    match formula:
        case Predicate():
            return ()
        case And() | Or() | Implies() | Until() | Since():
            return (formula.left, formula.right)
        case Not() | Always() | Eventually() | Historically() | Once():
            return (formula.operand,)


def predicates(formula: Formula) -> Iterator[Predicate]:
    """Yield the predicates, left to right."""
    if isinstance(formula, Predicate):
        yield formula
    for child in children(formula):
        yield from predicates(child)
