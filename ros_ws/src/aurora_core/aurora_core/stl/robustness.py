# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Quantitative semantics of STL on sampled signals.

Edges of the trace: a bounded window that reaches beyond the last (for past operators: before the
first) sample has no value there, unless the caller declares `clip`, which takes the samples that
there are. A window without end always takes the samples that there are. A window whose nearest
sample has no value has none either. So a formula is defined on an interval of samples,
`ValidSeries`; whoever needs it elsewhere has a trace that is too short and must say so.

Source: Donzé and Maler 2010, section 2 (robust satisfaction), on discrete time.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import singledispatch
from math import isfinite

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.stl import windows
from aurora_core.stl.formula import (
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
    Until,
)
from aurora_core.stl.windows import Extremum, FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class SampledSignals:
    """Signals on one grid of samples.

    Attributes:
        values: Name to (n,) finite samples, all of one length.
        dt_s: Time between samples.
        clip: Bounded windows take the samples that there are at the ends of the trace.
    """

    values: Mapping[str, FloatArray]
    dt_s: float
    clip: bool = False

    def __post_init__(self) -> None:
        """Check the samples.

        Raises:
            VerificationError: Lengths differ, a sample is not finite, or dt_s is not positive.
        """
        lengths = {len(samples) for samples in self.values.values()}
        if len(lengths) != 1:
            raise VerificationError(
                f'STL signals of one length expected, found lengths {sorted(lengths)}'
            )
        if not self.dt_s > 0.0:
            raise VerificationError(f'STL needs a time step above 0 s, found {self.dt_s}')
        for name, samples in self.values.items():
            if not _finite(samples):
                raise VerificationError(f'STL signal {name!r} has samples that are not finite')

    @property
    def samples(self) -> int:
        """Number of samples n."""
        return len(next(iter(self.values.values())))


def _finite(samples: FloatArray) -> bool:
    if len(samples) == 1:
        return isfinite(samples[0])  # a fraction of the time
    return bool(np.isfinite(samples).all())


@dataclass(frozen=True, slots=True, kw_only=True)
class ValidSeries:
    """Values at samples start, start + 1, ...; elsewhere there is none."""

    start: int
    values: FloatArray

    @property
    def stop(self) -> int:
        """First sample after the last value."""
        return self.start + len(self.values)

    def at(self, sample: int) -> float | None:
        """Return the value at a sample, None where there is none."""
        if not self.start <= sample < self.stop:
            return None
        return float(self.values[sample - self.start]) + 0.0  # -0.0 becomes 0.0


def robustness(formula: Formula, signals: SampledSignals) -> ValidSeries:
    """Return the robustness of a formula at every sample where it is defined.

    Args:
        formula: Over names in `signals`.
        signals: The trace.

    Returns:
        At least 0 where the formula holds, negative where it does not (zero with a strict
        comparison does not hold); in the unit of the deciding predicate.

    Raises:
        VerificationError: The formula names a signal that is not there.
    """
    return _evaluate(formula, signals)


@singledispatch
def _evaluate(formula: object, signals: SampledSignals) -> ValidSeries:
    raise VerificationError(f'not an STL formula: {formula!r}')


@_evaluate.register
def _(formula: Predicate, signals: SampledSignals) -> ValidSeries:
    samples = signals.values.get(formula.signal)
    if samples is None:
        raise VerificationError(
            f'the STL formula names {formula.signal!r}, the signals are '
            f'{", ".join(sorted(signals.values))}'
        )
    return ValidSeries(start=0, values=predicate_robustness(formula, samples))


def predicate_robustness(predicate: Predicate, samples: FloatArray) -> FloatArray:
    """Return the robustness of a predicate, sample by sample."""
    match predicate.op:
        case Comparison.GE | Comparison.GT:
            return samples - predicate.threshold
        case Comparison.LE | Comparison.LT:
            return predicate.threshold - samples
        case Comparison.WITHIN:
            return predicate.tolerance - np.abs(samples - predicate.threshold)


@_evaluate.register
def _(formula: Not, signals: SampledSignals) -> ValidSeries:
    operand = _evaluate(formula.operand, signals)
    return ValidSeries(start=operand.start, values=-operand.values)


@_evaluate.register
def _(formula: And, signals: SampledSignals) -> ValidSeries:
    return _both(formula.left, formula.right, signals, Extremum.LEAST)


@_evaluate.register
def _(formula: Or, signals: SampledSignals) -> ValidSeries:
    return _both(formula.left, formula.right, signals, Extremum.GREATEST)


@_evaluate.register
def _(formula: Implies, signals: SampledSignals) -> ValidSeries:
    return _both(Not(operand=formula.left), formula.right, signals, Extremum.GREATEST)


@_evaluate.register
def _(formula: Always, signals: SampledSignals) -> ValidSeries:
    operand = _evaluate(formula.operand, signals)
    return _window(operand, formula.interval, signals, Extremum.LEAST)


@_evaluate.register
def _(formula: Eventually, signals: SampledSignals) -> ValidSeries:
    operand = _evaluate(formula.operand, signals)
    return _window(operand, formula.interval, signals, Extremum.GREATEST)


@_evaluate.register
def _(formula: Historically, signals: SampledSignals) -> ValidSeries:
    operand = _mirror(_evaluate(formula.operand, signals), signals)
    return _mirror(_window(operand, formula.interval, signals, Extremum.LEAST), signals)


@_evaluate.register
def _(formula: Once, signals: SampledSignals) -> ValidSeries:
    operand = _mirror(_evaluate(formula.operand, signals), signals)
    return _mirror(_window(operand, formula.interval, signals, Extremum.GREATEST), signals)


@_evaluate.register
def _(formula: Until, signals: SampledSignals) -> ValidSeries:
    left = _evaluate(formula.left, signals)
    right = _evaluate(formula.right, signals)
    return _until(left, right, formula.interval, signals)


@_evaluate.register
def _(formula: Since, signals: SampledSignals) -> ValidSeries:
    left = _mirror(_evaluate(formula.left, signals), signals)
    right = _mirror(_evaluate(formula.right, signals), signals)
    return _mirror(_until(left, right, formula.interval, signals), signals)


def _common(a: ValidSeries, b: ValidSeries) -> tuple[int, FloatArray, FloatArray]:
    start = max(a.start, b.start)
    stop = max(start, min(a.stop, b.stop))
    return (
        start,
        a.values[start - a.start : stop - a.start],
        b.values[start - b.start : stop - b.start],
    )


def _both(
    left: Formula, right: Formula, signals: SampledSignals, extremum: Extremum
) -> ValidSeries:
    start, a, b = _common(_evaluate(left, signals), _evaluate(right, signals))
    return ValidSeries(start=start, values=extremum.ufunc(a, b))


def _mirror(series: ValidSeries, signals: SampledSignals) -> ValidSeries:
    return ValidSeries(start=signals.samples - series.stop, values=series.values[::-1])


def _ahead(series: ValidSeries, low: int, values: FloatArray) -> ValidSeries:
    """Place values whose windows begin at series.start, series.start + 1, ... `low` earlier."""
    start = series.start - low
    cut = max(0, -start)
    return ValidSeries(start=max(0, start), values=values[cut:])


def _window(
    operand: ValidSeries, interval: Interval, signals: SampledSignals, extremum: Extremum
) -> ValidSeries:
    low, high = interval.ticks(signals.dt_s)
    if high is None:
        values = windows.running_to_end(operand.values, extremum)
    elif signals.clip:
        values = windows.sliding_clipped(operand.values, high - low + 1, extremum)
    else:
        values = windows.sliding(operand.values, high - low + 1, extremum)
    return _ahead(operand, low, values)


def _until(
    left: ValidSeries, right: ValidSeries, interval: Interval, signals: SampledSignals
) -> ValidSeries:
    low, high = interval.ticks(signals.dt_s)
    start, a, b = _common(left, right)
    values = windows.until(a, b, low, high)
    if high is not None and not signals.clip:
        values = values[: max(0, len(a) - high)]
    return ValidSeries(start=start, values=values)
