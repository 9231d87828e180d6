# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which sample and which predicate decide the robustness of a formula."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.stl.formula import (
    Always,
    And,
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
from aurora_core.stl.robustness import SampledSignals, ValidSeries, robustness
from aurora_core.stl.windows import FloatArray


@dataclass(frozen=True, slots=True, kw_only=True)
class Critical:
    """The sample whose value is the robustness, and the predicate that has it there."""

    sample: int
    predicate: Predicate


def critical_sample(formula: Formula, signals: SampledSignals, sample: int = 0) -> Critical:
    """Return what decides the robustness at `sample`; of equals the earliest.

    Raises:
        VerificationError: The formula has no value there.
    """
    if robustness(formula, signals).at(sample) is None:
        raise VerificationError(f'the STL formula has no value at sample {sample}')
    return _descend(formula, signals, sample)


def _descend(formula: Formula, signals: SampledSignals, sample: int) -> Critical:
    match formula:
        case Predicate():
            return Critical(sample=sample, predicate=formula)
        case Not():
            return _descend(formula.operand, signals, sample)
        case And():
            return _branch(formula.left, formula.right, signals, sample, least=True)
        case Or():
            return _branch(formula.left, formula.right, signals, sample, least=False)
        case Implies():
            negated = Not(operand=formula.left)
            return _branch(negated, formula.right, signals, sample, least=False)
        case Always() | Historically():
            return _extreme(formula, signals, sample, np.argmin)
        case Eventually() | Once():
            return _extreme(formula, signals, sample, np.argmax)
        case Until():
            return _witness(formula, signals, sample, step=1)
        case Since():
            return _witness(formula, signals, sample, step=-1)


def _value(series: ValidSeries, sample: int) -> float:
    value = series.at(sample)
    assert value is not None  # the whole formula has a value, so its operands have
    return value


def _branch(
    left: Formula, right: Formula, signals: SampledSignals, sample: int, *, least: bool
) -> Critical:
    a = _value(robustness(left, signals), sample)
    b = _value(robustness(right, signals), sample)
    take_left = a <= b if least else a >= b
    return _descend(left if take_left else right, signals, sample)


def _reach(
    interval: Interval, series: ValidSeries, signals: SampledSignals, sample: int, step: int
) -> list[int]:
    """Return the samples of the interval seen from `sample` that have a value, nearest first."""
    low, high = interval.ticks(signals.dt_s)
    end = series.stop - 1 if step > 0 else series.start
    last = end if high is None else sample + step * high
    last = min(last, end) if step > 0 else max(last, end)
    return list(range(sample + step * low, last + step, step))


def _extreme(
    formula: Always | Eventually | Historically | Once,
    signals: SampledSignals,
    sample: int,
    pick: Callable[[FloatArray], np.intp],
) -> Critical:
    operand = robustness(formula.operand, signals)
    step = 1 if isinstance(formula, Always | Eventually) else -1
    reach = sorted(_reach(formula.interval, operand, signals, sample, step))
    values = operand.values[reach[0] - operand.start : reach[-1] + 1 - operand.start]
    return _descend(formula.operand, signals, reach[0] + int(pick(values)))


def _witness(formula: Until | Since, signals: SampledSignals, sample: int, step: int) -> Critical:
    left = robustness(formula.left, signals)
    right = robustness(formula.right, signals)
    start, stop = max(left.start, right.start), min(left.stop, right.stop)
    shared = ValidSeries(start=start, values=left.values[start - left.start : stop - left.start])
    best: tuple[float, Formula, int] | None = None
    held, held_at = float('inf'), sample
    walked = sample
    for j in _reach(formula.interval, shared, signals, sample, step):
        while walked != j:
            # until: left at sample..j-1; since: left at j+1..sample.
            value = _value(left, walked)
            if value < held:
                held, held_at = value, walked
            walked += step
        here = _value(right, j)
        value, part, at = (
            (here, formula.right, j) if here <= held else (held, formula.left, held_at)
        )
        if best is None or value > best[0]:
            best = (value, part, at)
    assert best is not None  # the formula has a value, so the interval has a sample
    return _descend(best[1], signals, best[2])
