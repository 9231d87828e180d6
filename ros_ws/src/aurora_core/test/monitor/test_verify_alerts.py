# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events, alerts and messages: satisfied, violated, without their premise."""

from __future__ import annotations

from dataclasses import replace
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.outcomes.verdict import Reason, VerdictStatus
from aurora_core.spec.parameter import Unit
from aurora_core.trace.records import ScenarioEventKind

TRIGGER_S = 32.25  # the van, 14 m/s against 10 m/s, is 20 m from the ego


def _results(tb: ModuleType, case: Any) -> dict[str, Any]:
    return {r.id: r for r in tb.judge(case).results}


def test_a_tailgating_van_and_its_alert_are_verified(tb: ModuleType) -> None:
    verdict = tb.judge(tb.tailgate_case())
    assert verdict.status is VerdictStatus.VERIFIED, [
        r.explanation for r in verdict.results if not r.satisfied
    ]
    found = {r.id: r for r in verdict.results}
    # 12 m between centres are 7 m between bumpers, at 10 m/s 0.7 s.
    assert found['van1.tailgate'].margin == pytest.approx(0.3, abs=0.02)
    assert found['van1.tailgate.from_start'].margin == pytest.approx(1.0)  # 45 m, 1 m allowed
    assert found['van1.tailgate.from_closing'].margin == pytest.approx(1.0)
    assert found['van1.tailgate.from_closing'].worst_time_s == pytest.approx(20.05, abs=0.06)
    assert found['e1.within'].margin == 1.0
    assert found['e1.not_before'].margin == 0.0
    assert found['e1.delivered'].margin == pytest.approx(1.9)
    assert found['e1.delivered'].normalised == pytest.approx(1.9 / 0.2)
    assert found['e1.delivered'].explanation == (
        f'Van1 came within 20 m of ego at {TRIGGER_S} s; the message reached ego 0.10 s later; '
        'margin 1.90 s.'
    )
    assert found['e1.actor_visible'].satisfied


def test_a_message_from_the_ground_is_no_report_of_a_flight(tb: ModuleType) -> None:
    """It has landed, down from 30 m since 15 s, when it says what it was to see."""
    case = tb.tailgate_case()
    van = case.run.agents[1]
    case.run.flights[0] = tb.flight(
        1401, (0.0, 20.0), 30.0, lambda k: (float(van.x[k]), float(van.y[k]), 30.0), landing=300
    )
    found = _results(tb, case)['e1.after_capture']
    assert not found.satisfied
    assert 'from the ground' in found.explanation


def test_retransmissions_take_time(tb: ModuleType) -> None:
    found = _results(tb, tb.tailgate_case(lost=2))['e1.delivered']
    assert found.margin == pytest.approx(2.0 - (2 * 0.2 + 0.1))


def test_a_message_that_is_given_up_is_not_delivered(tb: ModuleType) -> None:
    verdict = tb.judge(tb.tailgate_case(lost=9))
    found = {r.id: r for r in verdict.results}['e1.delivered']
    assert verdict.status is VerdictStatus.VIOLATED
    # At the earliest after the end of the record: tick 1401 minus the tick of sending.
    assert found.margin == pytest.approx(2.0 - (1401 * 0.05 - TRIGGER_S))
    assert '4 attempts were lost' in found.explanation


def test_a_van_that_keeps_away_leaves_the_premise_open(tb: ModuleType) -> None:
    verdict = tb.judge(tb.tailgate_case(keeps_away=True))
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.VIOLATED
    for name in ('within', 'not_before', 'after_capture', 'actor_visible', 'delivered'):
        assert found[f'e1.{name}'].reason is Reason.PREMISE_NEVER, name
        assert not found[f'e1.{name}'].exercised
    # 45 m between centres are 40 m between bumpers: 4 s at 10 m/s.
    assert found['van1.tailgate'].margin == pytest.approx(1.0 - 4.0, abs=0.01)


def test_a_van_that_never_moves_never_closes(tb: ModuleType) -> None:
    case = tb.tailgate_case(keeps_away=True)
    van = case.run.agents[1]
    van.x[:], van.speed[:] = -45.0, 0.0
    found = _results(tb, case)
    assert found['van1.tailgate.from_closing'].reason is Reason.PREMISE_NEVER
    assert found['van1.tailgate.from_start'].margin == pytest.approx(1.0)
    assert found['van1.tailgate'].margin == pytest.approx(1.0 - 100.0)


def test_a_van_that_starts_elsewhere_does_not_close_from_45_metres(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.agents[1].x -= 3.0
    found = _results(tb, case)
    assert found['van1.tailgate.from_start'].margin == pytest.approx(1.0 - 3.0)
    assert found['van1.placed.distance'].margin == pytest.approx(1.0 - 3.0)


def test_an_alert_that_never_comes_is_late(tb: ModuleType) -> None:
    case = tb.tailgate_case(alert=False)
    case.run.claim(round(TRIGGER_S / 0.05), ScenarioEventKind.TRIGGERED, 'e1')
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.VIOLATED
    assert found['e1.within'].margin == pytest.approx(1.0 - (1401 * 0.05 - TRIGGER_S))
    assert found['e1.delivered'].reason is Reason.PREMISE_NEVER


def _shift_alert(case: Any, ticks: int) -> None:
    case.run.links[:] = [replace(r, tick=r.tick + ticks) for r in case.run.links]


def test_a_late_alert_is_violated_and_an_early_one_too(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    _shift_alert(case, 30)
    assert _results(tb, case)['e1.within'].margin == pytest.approx(1.0 - 1.5)
    case = tb.tailgate_case()
    _shift_alert(case, -30)
    early = _results(tb, case)
    assert early['e1.not_before'].margin == pytest.approx(-1.5)


def test_an_alert_before_capture_is_violated(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    _shift_alert(case, -round(TRIGGER_S / 0.05) + 150)  # 7.5 s, the capture is at 9.7 s
    found = _results(tb, case)['e1.after_capture']
    assert found.margin == pytest.approx(7.5 - 9.7, abs=0.1)


def test_an_alert_without_sight_of_the_actor_is_violated(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.world = tb.world(weather='fog')
    case.run.flights[0].states[400:1050, 1] += 80.0  # 85.6 m away, fog ends at 75 m
    found = _results(tb, case)['e1.actor_visible']
    assert found.margin == pytest.approx(75.0 - np.sqrt(80.0**2 + (30.0 - 1.1) ** 2), abs=1e-6)
    assert found.worst_time_s == pytest.approx(TRIGGER_S)


def test_a_stated_delay_moves_both_bounds(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (event,) = case.spec.events
    late = dict(event) | {'delay_s': tb.number(2.0, Unit.SECOND, explicit=True)}
    case.spec = tb.spec(**{**dict(case.spec), 'events': (late,)})
    found = _results(tb, case)
    assert found['e1.not_before'].margin == pytest.approx(0.0 - 1.5)  # 2 s less 0.5 s
    assert found['e1.within'].margin == pytest.approx(3.0)


def test_a_stated_latency_bounds_delivery_and_receipt(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (link,) = case.spec.links
    stated = dict(link) | {'latency_s': tb.number(0.1, Unit.SECOND, explicit=True)}
    case.spec = tb.spec(**{**dict(case.spec), 'links': (stated,)})
    found = _results(tb, case)
    assert found['e1.delivered'].margin == pytest.approx(0.1 + 3 * 0.2 - 0.1)
    assert found['e1.latency'].margin == pytest.approx(2.0)  # steps


def test_a_record_that_ends_before_the_receipt_is_too_short(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    case.run.finished = False
    stop = round(TRIGGER_S / 0.05) + 2
    _cut(case, stop)
    verdict = tb.judge(case)
    found = {r.id: r for r in verdict.results}
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    assert found['e1.delivered'].reason is Reason.TRACE_SHORT
    assert found['van1.placed'].satisfied  # decided at t = 0


def _cut(case: Any, stop: int) -> None:
    run = case.run
    run.ticks = stop
    for one in run.agents:
        one.x, one.y, one.speed = one.x[:stop], one.y[:stop], one.speed[:stop]
    for one in run.flights:
        one.states, one.commands = one.states[:stop], one.commands[:stop]
    run.links[:] = [r for r in run.links if r.tick < stop]


def test_milestones_have_to_happen(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    event = {
        'id': 'e2',
        'trigger': {'on': 'altitude_reached', 'uav': 'uav1', 'value_m': tb.number(29.0)},
    }
    case.spec = tb.spec(**{**dict(case.spec), 'events': (*case.spec.events, event)})
    case.run.claim(145, ScenarioEventKind.TRIGGERED, 'e2')
    found = _results(tb, case)['e2.happens']
    assert found.margin == pytest.approx(70.0 - 7.05, abs=0.06)
    event['trigger']['value_m'] = tb.number(99.0)  # type: ignore[index]
    case.spec = tb.spec(**{**dict(case.spec), 'events': (case.spec.events[0], event)})
    assert _results(tb, case)['e2.happens'].reason is Reason.PREMISE_NEVER


def test_a_message_that_waits_for_the_ascent_says_from_when_on_it_can_be(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (event,) = case.spec.events
    at = {'on': 'time', 'at_s': tb.number(3.0, Unit.SECOND, explicit=True)}
    case.spec = tb.spec(**{**dict(case.spec), 'events': (dict(event) | {'trigger': at},)})
    found = _results(tb, case)['e1.time']
    assert not found.satisfied
    assert 'uav1 was still climbing at 3.00 s' in found.explanation
    assert 'it can send from 9.70 s on' in found.explanation


def test_an_event_at_a_stated_time(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    (event,) = case.spec.events
    at = {'on': 'time', 'at_s': tb.number(32.0, Unit.SECOND, explicit=True)}
    case.spec = tb.spec(**{**dict(case.spec), 'events': (dict(event) | {'trigger': at},)})
    found = _results(tb, case)['e1.time']
    assert found.margin == pytest.approx(0.02 * 32.0 - 0.25)
