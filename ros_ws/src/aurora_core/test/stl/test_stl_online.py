# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The online monitor against the offline robustness of every prefix and continuation."""

from __future__ import annotations

import math
import tracemalloc
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import VerificationError
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
from aurora_core.stl.online import OnlineRobustness, OnlineVerdict, verdict
from aurora_core.stl.robustness import SampledSignals, robustness
from aurora_core.stl.syntax import parse_formula
from aurora_core.stl.windows import FloatArray

DT_S = 0.05
INF = math.inf
HUGE = 1e9  # stands for a sample without limit
HORIZON = 60  # ticks, above four nested intervals
Trace = dict[str, FloatArray]

bounded = st.builds(
    lambda low, width: Interval(low=low, high=low + width, unit=TimeUnit.TICKS),
    st.integers(0, 3),
    st.integers(0, 5),
)
intervals = st.one_of(
    bounded,
    st.integers(0, 3).map(lambda low: Interval(low=low, unit=TimeUnit.TICKS)),
)


def late(formula: Formula, ticks: int) -> Formula:
    """The same value at every sample, but only if the trace goes on for some ticks."""
    shift = Interval(low=ticks, high=ticks, unit=TimeUnit.TICKS)
    return Eventually(operand=Once(operand=formula, interval=shift), interval=shift)


def leaves(ops: list[Comparison]) -> st.SearchStrategy[Formula]:
    predicate = st.builds(
        Predicate,
        signal=st.sampled_from(['x', 'y']),
        op=st.sampled_from(ops),
        threshold=st.integers(-3, 3).map(float),
        tolerance=st.integers(0, 2).map(float),
    )
    return st.one_of(predicate, st.builds(late, predicate, st.integers(1, 2)))


def positive(
    leaf: st.SearchStrategy[Formula], interval: st.SearchStrategy[Interval], depth: int
) -> st.SearchStrategy[Formula]:
    """Formulas of at most a depth whose robustness grows with that of every leaf."""
    if depth == 0:
        return leaf
    inner = positive(leaf, interval, depth - 1)
    return st.one_of(
        leaf,
        *(st.builds(kind, left=inner, right=inner) for kind in (And, Or)),
        *(
            st.builds(kind, operand=inner, interval=interval)
            for kind in (Always, Eventually, Historically, Once)
        ),
        *(st.builds(kind, left=inner, right=inner, interval=interval) for kind in (Until, Since)),
    )


def any_formula(depth: int) -> st.SearchStrategy[Formula]:
    if depth == 0:
        return leaves(list(Comparison))
    inner = any_formula(depth - 1)
    return st.one_of(
        positive(inner, intervals, 1),
        st.builds(Not, operand=inner),
        st.builds(Implies, left=inner, right=inner),
    )


formulas = st.one_of(*(any_formula(depth) for depth in range(1, 5)))
monotone = st.one_of(*(positive(leaves([Comparison.GE]), bounded, depth) for depth in range(1, 5)))


def traces(longest: int) -> st.SearchStrategy[Trace]:
    return st.integers(0, longest).flatmap(
        lambda n: st.fixed_dictionaries(
            {
                name: st.lists(st.integers(-5, 5).map(float), min_size=n, max_size=n).map(np.array)
                for name in 'xy'
            }
        )
    )


cuts = st.lists(st.integers(0, 5), max_size=12)


def named(formula: Formula, trace: Trace) -> Trace:
    """The signals that the formula names: the monitor refuses others."""
    return {predicate.signal: trace[predicate.signal] for predicate in predicates(formula)}


def offline(formula: Formula, trace: Trace, *, clip: bool) -> float | None:
    values = {name: np.asarray(samples, float) for name, samples in trace.items()}
    return robustness(formula, SampledSignals(values=values, dt_s=DT_S, clip=clip)).at(0)


def prefix(trace: Trace, stop: int) -> Trace:
    return {name: samples[:stop] for name, samples in trace.items()}


def followed_by(trace: Trace, rest: Trace) -> Trace:
    return {name: np.concatenate((samples, rest[name])) for name, samples in trace.items()}


def pushed(monitor: OnlineRobustness, trace: Trace, sizes: list[int]) -> Iterator[int]:
    """Push a trace in pieces; yield the number of samples before the first and after each."""
    at, n = 0, len(next(iter(trace.values())))
    yield at
    for size in (*sizes, n):
        monitor.push({name: samples[at : at + size] for name, samples in trace.items()})
        at = min(at + size, n)
        yield at


@settings(max_examples=150, deadline=None, derandomize=True)
@given(formulas, traces(20), cuts, st.booleans())
def test_close_and_now_are_the_offline_robustness(
    formula: Formula, trace: Trace, sizes: list[int], clip: bool
) -> None:
    trace = named(formula, trace)
    monitor = OnlineRobustness(formula, dt_s=DT_S, clip=clip)
    for at in pushed(monitor, trace, sizes):
        assert monitor.samples == at
        assert monitor.now() == offline(formula, prefix(trace, at), clip=clip), at
    found, expected = monitor.close(), offline(formula, trace, clip=clip)
    assert (found is None) == (expected is None)
    if found is not None and expected is not None:
        assert np.float64(found).tobytes() == np.float64(expected).tobytes()
        assert monitor.bounds() == (expected, expected)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(formulas, traces(12), cuts, st.lists(traces(12), min_size=1, max_size=3), st.booleans())
def test_bounds_hold_for_every_continuation_and_never_widen(
    formula: Formula, trace: Trace, sizes: list[int], rests: list[Trace], clip: bool
) -> None:
    trace = named(formula, trace)
    monitor = OnlineRobustness(formula, dt_s=DT_S, clip=clip)
    before = (-INF, INF)
    for at in pushed(monitor, trace, sizes):
        low, high = monitor.bounds()
        assert before[0] <= low <= high <= before[1]
        before = (low, high)
        for rest in (prefix(trace, 0), *rests):
            value = offline(formula, followed_by(prefix(trace, at), rest), clip=clip)
            assert value is None or low <= value <= high, at


@settings(max_examples=100, deadline=None, derandomize=True)
@given(formulas, traces(20), cuts, st.booleans())
def test_it_does_not_matter_in_which_pieces_the_samples_come(
    formula: Formula, trace: Trace, sizes: list[int], clip: bool
) -> None:
    trace = named(formula, trace)
    single = OnlineRobustness(formula, dt_s=DT_S, clip=clip)
    known = [(single.bounds(), single.now()) for _ in pushed(single, trace, [1] * 20)]
    pieces = OnlineRobustness(formula, dt_s=DT_S, clip=clip)
    for at in pushed(pieces, trace, sizes):
        assert (pieces.bounds(), pieces.now()) == known[at], at


@settings(max_examples=100, deadline=None, derandomize=True)
@given(monotone, traces(10))
def test_bounds_are_reached_by_the_worst_and_the_best_continuation(
    formula: Formula, trace: Trace
) -> None:
    trace = named(formula, trace)
    monitor = OnlineRobustness(formula, dt_s=DT_S)
    monitor.push(trace)
    for fill, bound in zip((-HUGE, HUGE), monitor.bounds(), strict=True):
        rest = {name: np.full(HORIZON, fill) for name in trace}
        value = offline(formula, followed_by(trace, rest), clip=False)
        # Looking back beyond sample 0 there is no value, whatever follows.
        if value is not None:
            assert bound == (math.copysign(INF, value) if abs(value) > HUGE / 2 else value)


def after(text: str, **signals: list[float]) -> OnlineRobustness:
    return _after(text, signals, clip=False)


def clipped(text: str, **signals: list[float]) -> OnlineRobustness:
    return _after(text, signals, clip=True)


def _after(text: str, signals: dict[str, list[float]], *, clip: bool) -> OnlineRobustness:
    monitor = OnlineRobustness(parse_formula(text), dt_s=1.0, clip=clip)
    monitor.push({name: np.array(samples, dtype=float) for name, samples in signals.items()})
    return monitor


@pytest.mark.parametrize(
    ('text', 'signals', 'expected'),
    [
        ('always (x >= 0)', {'x': [5, 3, 4]}, (-INF, 3)),
        ('always (x >= 0)', {'x': [5, -3]}, (-INF, -3)),
        ('eventually (x >= 0)', {'x': [-5, 3]}, (3, INF)),
        ('not (eventually (x >= 0))', {'x': [-5, 3]}, (-INF, -3)),
        # A full window is a point.
        ('always [0, 2] s (x >= 0)', {'x': [5, 3, 4]}, (3, 3)),
        ('eventually [1, 2] s (x >= 0)', {'x': [9, 3, 4]}, (4, 4)),
        ('eventually [1, 2] s (x >= 0)', {'x': [9, 3]}, (3, INF)),
        ('eventually [1, 2] s (x >= 0)', {'x': [9]}, (-INF, INF)),
        # A witness cannot be better than what was held before it; none can help any more.
        ('(x >= 0) until (y >= 0)', {'x': [2, 1], 'y': [-3, -4]}, (-3, 1)),
        ('(x >= 0) until (y >= 0)', {'x': [2, 1, -9], 'y': [0, 5, 1]}, (2, 2)),
        ('(x >= 0) until (y >= 0)', {'x': [-1], 'y': [-2]}, (-2, -1)),
        ('(x >= 0) until [1, 2] s (y >= 0)', {'x': [4, 3], 'y': [9, 2]}, (2, 3)),
        # Known beyond the last sample: once has it for ever.
        ('always (once (x >= 0))', {'x': [2, -1]}, (2, 2)),
        ('eventually (historically (x >= 0))', {'x': [2, -1]}, (2, 2)),
        ('always [0, 3] s ((y >= 0) since (x >= 0))', {'x': [2], 'y': [0]}, (-INF, 2)),
        # One response too late decides; the next is still open.
        ('always ((x < 0) or (eventually [0, 1] s (y >= 0)))', {'x': [1, 0], 'y': [-2, -3]},
         (-INF, -1)),
        ('(always (x >= 0)) and (eventually (y >= 0))', {'x': [1], 'y': [-2]}, (-INF, 1)),
    ],
)  # fmt: skip
def test_bounds_by_hand(
    text: str, signals: dict[str, list[float]], expected: tuple[float, float]
) -> None:
    assert after(text, **signals).bounds() == expected


LATE = '(eventually [1, 1] s (once [1, 1] s (x >= 0)))'  # x, if one more sample follows


@pytest.mark.parametrize(
    ('text', 'x', 'full', 'cut'),
    [
        # 7 is there, but counts only if the trace does not end here.
        (f'eventually [0, 2] s {LATE}', [-5, 7], (7, INF), (-5, INF)),
        (f'always [0, 2] s {LATE}', [5, -7], (-INF, -7), (-INF, 5)),
        (f'(x >= -9) until [0, 2] s {LATE}', [-5, 7], (4, 4), (-5, 4)),
        # The nearest sample of a window counts in any case, or there is no value.
        (f'eventually [1, 3] s {LATE}', [-5, 7], (7, INF), (7, INF)),
        (f'always [1, 3] s {LATE}', [5, -7], (-INF, -7), (-INF, -7)),
        (f'(x >= -9) until [1, 3] s {LATE}', [-5, 3], (3, 4), (3, 4)),
    ],
)
@pytest.mark.parametrize('inner', [False, True])
def test_what_counts_only_if_the_trace_goes_on(
    text: str, x: list[float], full: tuple[float, float], cut: tuple[float, float], inner: bool
) -> None:
    text = f'always [0, 0] s ({text})' if inner else text
    assert after(text, x=x).bounds() == full
    assert clipped(text, x=x).bounds() == cut


def test_a_full_window_at_the_end_may_not_come() -> None:
    text = 'eventually (always [0, 1] s (once (x >= 0)))'
    assert after(text, x=[-5, 7]).bounds() == (-5, INF)
    assert clipped(text, x=[-5, 7]).bounds() == (7, INF)
    text = 'eventually ((x >= -9) until [0, 1] s (x >= 0))'
    assert after(text, x=[-5, 7]).bounds() == (4, INF)
    assert clipped(text, x=[-5, 7]).bounds() == (7, INF)


@pytest.mark.parametrize('ago', [0, 1])
def test_a_witness_long_gone_is_remembered(ago: int) -> None:
    formula = parse_formula(f'always [1, inf] s ((y >= 0) since [{ago}, inf] s (x >= 0))')
    monitor = OnlineRobustness(formula, dt_s=1.0)
    for x, y in [(4.0, 9.0), (-9.0, 2.0), (-9.0, 1.0), (-9.0, 3.0)]:
        monitor.push({'x': np.array([x]), 'y': np.array([y])})
    assert monitor.bounds() == (-INF, 1.0)
    assert monitor.close() == 1.0


def test_a_window_that_is_not_full_has_a_value_now_only_where_windows_are_cut() -> None:
    formula = parse_formula('always [0, 3] s (x >= 2)')
    values = {}
    for clip in (False, True):
        monitor = OnlineRobustness(formula, dt_s=1.0, clip=clip)
        monitor.push({'x': np.array([5.0, 3.0])})
        values[clip] = (monitor.now(), monitor.bounds(), monitor.close())
    assert values == {False: (None, (-INF, 1.0), None), True: (1.0, (-INF, 1.0), 1.0)}


def test_a_look_back_beyond_sample_0_has_no_value() -> None:
    monitor = after('(x >= 9) and (once [1, 2] s (x >= 0))', x=[1, 2, 3])
    assert monitor.bounds() == (-INF, INF)
    assert monitor.now() is None
    assert monitor.close() is None


def test_zero_has_no_sign() -> None:
    monitor = after('not (x >= 2)', x=[2])
    found = (*monitor.bounds(), monitor.now(), monitor.close())
    assert [math.copysign(1.0, 0.0 if v is None else v) for v in found] == [1.0] * 4


def test_verdicts_come_as_early_as_they_are_certain() -> None:
    def seen(text: str, *, strict: bool = False, **signals: list[float]) -> OnlineVerdict:
        monitor = after(text, **signals)
        return verdict(*monitor.bounds(), monitor.now(), strict=strict)

    assert seen('always (x >= 0)', x=[1, 2]) is OnlineVerdict.CURRENTLY_TRUE
    assert seen('always (x >= 0)', x=[1, -1]) is OnlineVerdict.FALSE
    assert seen('always (x >= 0)', x=[]) is OnlineVerdict.UNKNOWN
    assert seen('eventually (x >= 0)', x=[-1]) is OnlineVerdict.CURRENTLY_FALSE
    assert seen('eventually (x >= 0)', x=[-1, 1]) is OnlineVerdict.TRUE
    assert seen('always [0, 1] s (x >= 0)', x=[0, 0]) is OnlineVerdict.TRUE
    assert seen('always [0, 1] s (x > 0)', strict=True, x=[0]) is OnlineVerdict.FALSE
    assert seen('eventually (x > 0)', strict=True, x=[0]) is OnlineVerdict.CURRENTLY_FALSE


# The horizon is 40 ticks or none at all, with a window without end outermost.
LONG = [
    'always (x >= 0)',
    '(always ((x < 2) or (eventually [0, 1] s (y >= 1)))) and (not (eventually (x > 9)))',
    '(x >= -9) until ((y >= 8) and (once [0, 1] s (x >= 8)))',
    'always ((x >= -9) until [0.5, 1] s (y >= 0))',
    'always ((historically (x >= -9)) or (once [0.5, inf] s (y >= 3)))',
    'always (((x >= 0) since (y >= 1)) or ((x >= 0) since [0.1, inf] s (y >= 1)))',
    'eventually ((x >= 0) since [0, 1] s (y >= 1))',
    'always [0, 2000] s ((x >= 0) or (y >= -9))',
]


@pytest.mark.parametrize('clip', [False, True])
@pytest.mark.parametrize('text', LONG)
def test_memory_and_cost_do_not_grow_with_the_trace(
    text: str, clip: bool, steps_of: Callable[[Callable[[], object]], int]
) -> None:
    formula = parse_formula(text)
    random = np.random.default_rng(0)
    pieces = [
        {name: random.uniform(-5.0, 5.0, size) for name in 'xy' if f'{name} ' in text}
        for size in (*[100] * 100, 90_000)
    ]
    monitor = OnlineRobustness(formula, dt_s=DT_S, clip=clip)
    sizes = []
    tracemalloc.start()
    for piece in pieces:
        monitor.push(piece)
        sizes.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    assert sizes[-1] < max(sizes[:10]) + 10_000  # bytes; a kept sample has 8

    single = {name: np.zeros(1) for name in pieces[0]}

    def follow(followed: OnlineRobustness) -> None:
        followed.push(single)
        followed.bounds()
        followed.now()

    def cost(followed: OnlineRobustness) -> int:
        for _ in range(50):  # the windows of a fresh one are full by then
            follow(followed)
        return sum(steps_of(lambda: follow(followed)) for _ in range(50))

    assert cost(monitor) < 2 * cost(OnlineRobustness(formula, dt_s=DT_S, clip=clip))

    whole = {name: np.concatenate([p[name] for p in pieces] + [np.zeros(100)]) for name in single}
    assert monitor.close() == offline(formula, whole, clip=clip)


def test_a_piece_is_copied() -> None:
    monitor = OnlineRobustness(parse_formula('eventually [0, 2] s (x >= 0)'), dt_s=1.0)
    reused = np.array([3.0])
    monitor.push({'x': reused})
    reused[0] = 99.0
    assert monitor.bounds() == (3.0, INF)


def test_broken_input_is_refused_and_changes_nothing() -> None:
    formula = parse_formula('(always (x >= 0)) and (always (y >= 0))')
    one = np.ones(1)
    monitor = OnlineRobustness(formula, dt_s=DT_S)
    monitor.push({'x': one, 'y': one})
    with pytest.raises(VerificationError, match='one length'):
        monitor.push({'x': -one, 'y': np.ones(2)})
    with pytest.raises(VerificationError, match='not finite'):
        monitor.push({'x': -one, 'y': np.array([np.inf])})
    with pytest.raises(VerificationError, match=r'x, y expected, found x$'):
        monitor.push({'x': -one})
    with pytest.raises(VerificationError, match='x, y expected, found x, y, z'):
        monitor.push({'x': -one, 'y': one, 'z': one})
    assert monitor.samples == 1
    assert monitor.close() == 1.0
    assert monitor.close() == 1.0
    with pytest.raises(VerificationError, match='after the end'):
        monitor.push({'x': one, 'y': one})
    with pytest.raises(VerificationError, match='time step'):
        OnlineRobustness(formula, dt_s=0.0)
    with pytest.raises(VerificationError, match='holds no sample'):
        OnlineRobustness(parse_formula('always [0.01, 0.02] s (x >= 0)'), dt_s=DT_S)
