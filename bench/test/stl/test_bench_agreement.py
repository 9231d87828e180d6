# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A sample of the comparison with RTAMT, and every reason for leaving something out."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from aurora_bench.stl.agreement import EXPLANATIONS, TOLERANCE, Comparison, Mode, Reason
from aurora_bench.stl.pairs import Pair, pair
from aurora_bench.stl.rtamt_oracle import (
    delay,
    offline_values,
    online_monitor,
    online_values,
    rtamt_text,
    shares_state,
)
from aurora_core.stl.formula import Always, Historically, Interval, Once, Or, TimeUnit
from aurora_core.stl.robustness import SampledSignals, robustness
from aurora_core.stl.syntax import parse_formula

SEED = 20_260
RAMP = np.arange(8.0)


def of(text: str, **trace: list[float]) -> Pair:
    signals = {'x': RAMP, 'y': -RAMP, **{name: np.array(v) for name, v in trace.items()}}
    return Pair(number=0, formula=parse_formula(text), trace=signals)


def ours(given: Pair, *, clip: bool) -> dict[int, float]:
    found = robustness(given.formula, SampledSignals(values=given.trace, dt_s=1.0, clip=clip))
    return {found.start + k: float(value) for k, value in enumerate(found.values)}


def reasons(given: Pair) -> dict[Mode, set[Reason]]:
    compared = Comparison()
    compared.compare(given)
    assert compared.unequal == []
    return {
        mode: {*found.pairs_left_out, *(+found.samples_left_out)}
        for mode, found in compared.modes.items()
    }


def test_a_seeded_sample_agrees_with_rtamt() -> None:
    compared = Comparison()
    for number in range(300):
        compared.compare(pair(SEED, number))
    assert compared.unequal == []
    for mode, least in ((Mode.OFFLINE, 180), (Mode.FULL, 100), (Mode.ONLINE, 100)):
        found = compared.modes[mode]
        assert found.greatest <= TOLERANCE
        assert found.pairs >= least, mode
        assert found.pairs + found.pairs_left_out.total() == 300


def test_pairs_are_repeatable_and_cover_the_language() -> None:
    first, again = pair(SEED, 5), pair(SEED, 5)
    assert first.formula == again.formula
    assert np.array_equal(first.trace['x'], again.trace['x'])
    many = [pair(SEED, number) for number in range(200)]
    assert len(Counter(type(each.formula) for each in many)) == 10
    lengths = {each.samples for each in many}
    assert min(lengths) == 1
    assert max(lengths) > 150
    assert len({rtamt_text(each.formula) for each in many}) > 190


def test_a_wrong_value_is_noticed(monkeypatch: pytest.MonkeyPatch) -> None:
    good = Comparison()
    good.compare(of('always [0, 2] s (x >= 3)'))
    assert good.unequal == []
    monkeypatch.setattr(
        'aurora_bench.stl.agreement.offline_values', lambda given: [0.0] * given.samples
    )
    bad = Comparison()
    bad.compare(replace(of('always [0, 2] s (x >= 3)'), number=7))
    assert bad.unequal == [7]


def test_every_reason_has_an_explanation() -> None:
    assert set(EXPLANATIONS) == set(Reason)


def test_rtamt_takes_infinity_where_a_window_has_no_sample() -> None:
    given = of('eventually (always [5, 6] s (x >= 0))')
    assert offline_values(given)[0] == np.inf
    assert ours(given, clip=True)[0] == 7.0
    assert reasons(given)[Mode.OFFLINE] == {Reason.EMPTY}


def test_rtamt_cuts_windows_that_reach_beyond_the_trace() -> None:
    given = of('always [0, 5] s (y >= 0)')
    assert offline_values(given)[7] == ours(given, clip=True)[7] == -7.0
    assert 7 not in ours(given, clip=False)
    assert reasons(given)[Mode.FULL] == {Reason.CUT}


def test_rtamt_takes_cut_windows_into_one_without_end() -> None:
    given = of('always (eventually [0, 2] s (y >= 0))')
    assert offline_values(given)[0] == ours(given, clip=True)[0] == -7.0
    assert ours(given, clip=False)[0] == -5.0
    assert reasons(given)[Mode.FULL] == {Reason.ENDLESS}


def test_rtamt_refuses_one_sample_offline() -> None:
    given = of('x >= 0', x=[2.0], y=[0.0])
    with pytest.raises(UnboundLocalError):
        offline_values(given)
    found = reasons(given)
    assert found[Mode.OFFLINE] == {Reason.SINGLE}
    assert found[Mode.ONLINE] == set()


def test_what_rtamt_cannot_do_online() -> None:
    assert reasons(of('always (x >= 0)'))[Mode.ONLINE] == {Reason.UNBOUNDED}
    assert reasons(of('always [0, 9] s (x >= 0)'))[Mode.ONLINE] == {Reason.LATE}


def test_rtamt_online_sees_windows_before_the_first_sample() -> None:
    given = of('historically (eventually [2, 3] s (x >= 5))', x=[1.0, 1, 9, 9, 9, 9, 9, 9])
    assert delay(given.formula) == 3
    assert online_values(online_monitor(given.formula), given)[3] == -4.0
    assert ours(given, clip=True)[0] == 4.0
    assert reasons(given)[Mode.ONLINE] == {Reason.PAST}


def test_rtamt_online_delays_predicates_twice() -> None:
    given = of('(y >= 0) or (eventually [0, 2] s (y >= 1))')
    found = online_values(online_monitor(given.formula), given)[2:]
    assert found != list(ours(given, clip=True).values())[:6]
    assert reasons(given)[Mode.ONLINE] == {Reason.UNEVEN}


def test_rtamt_online_fills_a_shared_memory_twice() -> None:
    two = Interval(low=2, high=2, unit=TimeUnit.TICKS)
    inner = Once(operand=of('x >= 0').formula, interval=two)
    now = Interval(low=0, high=0, unit=TimeUnit.TICKS)
    given = replace(
        of('x >= 0'),
        formula=Or(left=inner, right=Historically(operand=inner, interval=now)),
    )
    monitor = online_monitor(given.formula)
    assert shares_state(monitor)
    assert online_values(monitor, given)[2:4] == [1.0, 2.0]
    assert ours(given, clip=True)[2] == 0.0
    assert reasons(given)[Mode.ONLINE] == {Reason.TWICE}
    assert not shares_state(online_monitor(Always(operand=inner, interval=two)))
