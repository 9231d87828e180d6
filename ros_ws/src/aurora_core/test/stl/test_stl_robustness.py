# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Robustness against a brute-force reading of the definitions."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import VerificationError
from aurora_core.stl.critical import critical_sample
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
    TimeUnit,
    Until,
    predicates,
)
from aurora_core.stl.robustness import SampledSignals, predicate_robustness, robustness
from aurora_core.stl.syntax import parse_formula

DT_S = 0.05


def brute(formula: Formula, signals: SampledSignals, i: int) -> float | None:
    """The definitions, sample by sample; None where a window reaches beyond the trace."""
    if not 0 <= i < signals.samples:
        return None
    match formula:
        case Predicate():
            samples = signals.values[formula.signal][i : i + 1]
            return float(predicate_robustness(formula, samples)[0])
        case Not():
            value = brute(formula.operand, signals, i)
            return None if value is None else -value
        case And() | Or() | Implies():
            left, right = brute(formula.left, signals, i), brute(formula.right, signals, i)
            if left is None or right is None:
                return None
            if isinstance(formula, And):
                return min(left, right)
            return max(-left if isinstance(formula, Implies) else left, right)
        case Always() | Eventually() | Historically() | Once():
            step = 1 if isinstance(formula, Always | Eventually) else -1
            values = brute_window(formula.operand, formula.interval, signals, i, step)
            if not values:
                return None
            return (min if isinstance(formula, Always | Historically) else max)(values)
        case Until() | Since():
            step = 1 if isinstance(formula, Until) else -1
            low, high = formula.interval.ticks(signals.dt_s)
            best = None
            j, held = i, math.inf
            while True:
                distance = abs(j - i)
                left, right = brute(formula.left, signals, j), brute(formula.right, signals, j)
                if left is None or right is None:
                    if high is not None and not signals.clip:
                        return None
                    return best
                if distance >= low:
                    value = min(right, held)
                    best = value if best is None else max(best, value)
                if high is not None and distance == high:
                    return best
                held = min(held, left)
                j += step


def brute_window(
    operand: Formula, interval: Interval, signals: SampledSignals, i: int, step: int
) -> list[float]:
    low, high = interval.ticks(signals.dt_s)
    values = []
    reach = signals.samples if high is None else high
    for k in range(low, reach + 1):
        value = brute(operand, signals, i + step * k)
        if value is None:
            if k == low or (high is not None and not signals.clip):
                return []
            break
        values.append(value)
    return values


intervals = st.one_of(
    st.just(Interval()),
    st.builds(
        lambda low, width: Interval(
            low=low, high=None if width is None else low + width, unit=TimeUnit.TICKS
        ),
        st.integers(0, 4),
        st.one_of(st.none(), st.integers(0, 6)),
    ),
)
leaves = st.builds(
    Predicate,
    signal=st.sampled_from(['x', 'y']),
    op=st.sampled_from(list(Comparison)),
    threshold=st.integers(-3, 3).map(float),
    tolerance=st.integers(0, 2).map(float),
)


def _grow(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
    return st.one_of(
        st.builds(Not, operand=inner),
        *(st.builds(kind, left=inner, right=inner) for kind in (And, Or, Implies)),
        *(
            st.builds(kind, operand=inner, interval=intervals)
            for kind in (Always, Eventually, Historically, Once)
        ),
        *(st.builds(kind, left=inner, right=inner, interval=intervals) for kind in (Until, Since)),
    )


formulas = st.recursive(leaves, _grow, max_leaves=4)
samples = st.integers(1, 14).flatmap(
    lambda n: st.tuples(
        *(
            st.lists(st.integers(-5, 5).map(float), min_size=n, max_size=n).map(np.array)
            for _ in range(2)
        )
    )
)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(formulas, samples, st.booleans())
def test_robustness_is_the_definition(
    formula: Formula, pair: tuple[np.ndarray, np.ndarray], clip: bool
) -> None:
    signals = SampledSignals(values={'x': pair[0], 'y': pair[1]}, dt_s=DT_S, clip=clip)
    series = robustness(formula, signals)
    for i in range(signals.samples):
        assert series.at(i) == brute(formula, signals, i), i


@settings(max_examples=100, deadline=None, derandomize=True)
@given(formulas, samples)
def test_the_critical_sample_has_the_robustness(
    formula: Formula, pair: tuple[np.ndarray, np.ndarray]
) -> None:
    signals = SampledSignals(values={'x': pair[0], 'y': pair[1]}, dt_s=DT_S)
    series = robustness(formula, signals)
    for i in range(series.start, series.stop):
        found = critical_sample(formula, signals, i)
        assert found.predicate in set(predicates(formula))
        samples_there = signals.values[found.predicate.signal][found.sample : found.sample + 1]
        value = predicate_robustness(found.predicate, samples_there)[0]
        assert abs(value) == abs(series.values[i - series.start])


def rho(text: str, clip: bool = False, **signals: list[float]) -> float | None:
    values = {name: np.array(samples, dtype=float) for name, samples in signals.items()}
    trace = SampledSignals(values=values, dt_s=1.0, clip=clip)
    return robustness(parse_formula(text), trace).at(0)


def test_margins_by_hand() -> None:
    assert rho('always (x >= 2)', x=[5, 3, 4]) == 1
    assert rho('always (x <= 2)', x=[1, 3, 2]) == -1
    assert rho('eventually [1, 2] s (x >= 2)', x=[9, 3, 1]) == 1
    assert rho('x == 40 +- 2 m', x=[41.5]) == 0.5
    assert rho('(x >= 0) until (y >= 1)', x=[2, 1, -9], y=[0, 0, 4]) == 1
    assert rho('eventually (always [0, 1] s (x < 1))', x=[3, 0.5, 0.25, 2]) == 0.5


def test_a_bounded_window_beyond_the_end_has_no_value_unless_declared() -> None:
    assert rho('always [0, 3] s (x >= 2)', x=[5, 3, 4]) is None
    assert rho('always [0, 3] s (x >= 2)', clip=True, x=[5, 3, 4]) == 1
    assert rho('eventually [3, 4] s (x >= 2)', clip=True, x=[5, 3, 4]) is None


def test_zero_has_no_sign() -> None:
    assert math.copysign(1.0, rho('not (x >= 2)', x=[2]) or 0.0) == 1.0


def test_seconds_become_the_ticks_inside() -> None:
    assert Interval(low=0.15, high=0.35).ticks(0.05) == (3, 7)
    assert Interval(low=0.01, high=0.12).ticks(0.05) == (1, 2)


def test_broken_input_is_refused() -> None:
    one = np.zeros(1)
    with pytest.raises(VerificationError, match='holds no sample'):
        Interval(low=0.01, high=0.02).ticks(0.05)
    with pytest.raises(VerificationError, match='0 <= low <= high'):
        Interval(low=2.0, high=1.0)
    with pytest.raises(VerificationError, match='not finite'):
        SampledSignals(values={'x': np.array([0.0, np.nan])}, dt_s=DT_S)
    with pytest.raises(VerificationError, match='one length'):
        SampledSignals(values={'x': one, 'y': np.zeros(2)}, dt_s=DT_S)
    with pytest.raises(VerificationError, match='time step'):
        SampledSignals(values={'x': one}, dt_s=0.0)
    with pytest.raises(VerificationError, match='finite threshold'):
        Predicate(signal='x', op=Comparison.GE, threshold=math.nan)
    signals = SampledSignals(values={'x': one}, dt_s=DT_S)
    with pytest.raises(VerificationError, match="names 'z'"):
        robustness(Predicate(signal='z', op=Comparison.GE, threshold=0.0), signals)
    with pytest.raises(VerificationError, match='no value at sample 3'):
        critical_sample(Predicate(signal='x', op=Comparison.GE, threshold=0.0), signals, 3)


def test_window_cost_does_not_grow_with_the_window(
    steps_of: Callable[[Callable[[], object]], int],
) -> None:
    signals = SampledSignals(values={'x': np.sin(np.arange(200_000.0))}, dt_s=1.0)

    def cost(width: int) -> int:
        formula = parse_formula(f'always [0, {width}] s (x >= 0)')
        return steps_of(lambda: robustness(formula, signals))

    assert cost(50_000) < 4 * cost(10)
