# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""While a run goes on: what can still become of it, and at its end the margins of `verify`."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.conditions.derive import derive_conditions
from aurora_core.monitor.online import OnlineMonitor, Outlook
from aurora_core.monitor.verify import verify
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.stl.online import OnlineVerdict
from aurora_core.trace.trace import Trace


def _part(trace: Trace, start: int, stop: int) -> Trace:
    """Return the ticks [start, stop) with their claims."""
    return replace(
        trace.states(start, stop),
        links=tuple(r for r in trace.links if start <= r.tick < stop),
        sights=tuple(r for r in trace.sights if start <= r.tick < stop),
        events=tuple(r for r in trace.events if start <= r.tick < stop),
    )


def _conditions(tb: ModuleType, case: Any) -> tuple[Condition, ...]:
    derived = derive_conditions(case.spec, case.facts, tb.LIMITS, tb.TOLERANCES)
    return tuple(derived.conditions)


def _follow(
    case: Any, conditions: tuple[Condition, ...], cuts: list[int]
) -> list[dict[str, Outlook]]:
    trace = case.run.trace()
    marks = [0, *cuts, trace.ticks]
    monitor = OnlineMonitor(case.world, case.spec, conditions, _part(trace, 0, marks[1]))
    looks = [monitor.outlooks()]
    for start, stop in pairwise(marks[1:]):
        monitor.extend(_part(trace, start, stop))
        looks.append(monitor.outlooks())
    return [{outlook.condition_id: outlook for outlook in look} for look in looks]


CASES: dict[str, tuple[str, dict[str, Any]]] = {
    'alert in time': ('tailgate_case', {}),
    'two attempts lost': ('tailgate_case', {'lost': 2}),
    'never delivered': ('tailgate_case', {'lost': 9}),
    'never alerted': ('tailgate_case', {'alert': False}),
    'never close': ('tailgate_case', {'keeps_away': True}),
    'hover': ('hover_case', {}),
    'hover drifts': ('hover_case', {'drift': 4.0}),
    'hover too low': ('hover_case', {'altitude_error': -8.0}),
    'hover too long': ('hover_case', {'explicit_s': 12.0}),
    'never lands': ('hover_case', {'landing': None}),
    'survey': ('survey_case', {}),
    'survey misses a waypoint': ('survey_case', {'skip': 2}),
    'survey beside the route': ('survey_case', {'shift': 9.0}),
    'survey stops': ('survey_case', {'stop_after': 700}),
    'convoy': ('convoy_case', {}),
}


@pytest.mark.parametrize('name', CASES)
def test_intervals_narrow_down_to_the_margins_of_the_whole_run(tb: ModuleType, name: str) -> None:
    make, options = CASES[name]
    case = getattr(tb, make)(**options)
    conditions = _conditions(tb, case)
    final = verify(case.run.trace(), case.world, conditions, case.spec)
    margins = {result.id: result.margin for result in final.results}
    rng = np.random.default_rng(7)
    cuts = sorted(rng.choice(np.arange(1, case.run.ticks), 25, replace=False).tolist())
    looks = _follow(case, conditions, cuts)
    for condition in conditions:
        seen = [look[condition.id] for look in looks]
        margin = margins[condition.id]
        for before, after in pairwise(seen):
            assert before.low <= after.low, condition.id
            assert after.high <= before.high, condition.id
        if margin is None:
            assert seen[-1].verdict in (OnlineVerdict.UNKNOWN, OnlineVerdict.FALSE), condition.id
            continue
        for outlook in seen:
            assert outlook.low <= margin <= outlook.high, (condition.id, outlook, margin)
            if outlook.verdict in (OnlineVerdict.TRUE, OnlineVerdict.FALSE):
                right = condition.satisfied(margin)
                assert (outlook.verdict is OnlineVerdict.TRUE) is right, (condition.id, outlook)
        assert seen[-1].low == seen[-1].high == margin, condition.id
        assert float(seen[-1].now or 0.0).hex() == float(margin).hex(), condition.id


def test_a_violation_is_final_when_it_happens(tb: ModuleType) -> None:
    case = tb.hover_case(drift=4.0)  # from tick 601 on
    before, after, *_ = _follow(case, _conditions(tb, case), [590, 640])
    drift = 'm1.drift'
    assert before[drift].verdict is OnlineVerdict.CURRENTLY_TRUE
    assert after[drift].verdict is OnlineVerdict.FALSE
    assert after[drift].high < 0.0


def test_a_share_that_cannot_be_reached_any_more_is_false_early(tb: ModuleType) -> None:
    case = tb.convoy_case(ambulance1=np.zeros(1401))  # the ambulance stays where it is
    conditions = _conditions(tb, case)
    looks = _follow(case, conditions, [300, 700, 1000, 1300])
    follow = next(c.id for c in conditions if c.quantity == 'follow_fraction')
    verdicts = [look[follow].verdict for look in looks]
    assert verdicts[0] is not OnlineVerdict.FALSE
    assert verdicts[2] is OnlineVerdict.FALSE, 'of 1201 samples 900 are lost'


def test_an_alert_that_is_overdue_is_false_before_it_comes(tb: ModuleType) -> None:
    case = tb.tailgate_case(alert=False)
    near = int(np.flatnonzero(case.run.agents[0].x - case.run.agents[1].x <= 20.0)[0])
    before, in_time, late, *_ = _follow(
        case, _conditions(tb, case), [near, near + 10, near + 40, near + 60]
    )
    assert before['e1.within'].verdict is OnlineVerdict.UNKNOWN
    assert in_time['e1.within'].verdict is OnlineVerdict.UNKNOWN
    assert late['e1.within'].verdict is OnlineVerdict.FALSE


def test_a_run_without_uavs(tb: ModuleType) -> None:
    case = tb.ground_case(Behavior(kind=BehaviorKind.DRIVE), np.full(401, 8.0))
    conditions = _conditions(tb, case)
    final = verify(case.run.trace(), case.world, conditions, case.spec)
    last = _follow(case, conditions, [100, 250])[-1]
    for result in final.results:
        assert last[result.id].now == result.margin
