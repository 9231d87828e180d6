# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Orders: those of one UAV's phases and of events are judged, the others are named."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import pytest

from aurora_core.conditions.orders import order_conditions
from aurora_core.judging.build import Inputs, Underivable
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Uav
from aurora_core.spec.vocabulary import MissionMode

REACHED = {'on': 'altitude_reached', 'uav': 'uav1'}
BRAKES = {'do': 'brake', 'agent': 'ego'}


def _hover(tb: ModuleType, name: str, uav: str = 'uav1') -> tuple[Any, MissionFacts]:
    facts = MissionFacts(
        mission=name,
        uav=uav,
        mode=MissionMode.HOVER,
        altitude_m=30.0,
        hover_point=(0.0, 0.0, 30.0),
        duration_s=30.0,
    )
    return tb.mission(name, MissionMode.HOVER, uav=uav), facts


def _ordered(
    tb: ModuleType, *, uav_of_last: str = 'uav1', more: tuple[Any, ...] = (), **order: Any
) -> list[Any]:
    """Derive the order of a request with three hovers, an alert, a milestone and two brakes."""
    case = tb.tailgate_case()
    (alert,) = case.spec.events
    flown = [_hover(tb, 'm1'), _hover(tb, 'm2'), _hover(tb, 'm3', uav_of_last)]
    events = (
        alert,
        {'id': 'e2', 'trigger': REACHED | {'value_m': tb.number(29.0)}},
        {'id': 'e3', 'action': BRAKES},
        {'id': 'e4', 'trigger': {'on': 'event_done', 'event': 'e1'}, 'action': BRAKES},
        *more,
    )
    changes = {
        'uavs': (Uav(id='uav1'), Uav(id='uav2')),
        'missions': tuple(m for m, _ in flown),
        'events': events,
        'orders': ({'id': 'o1'} | order,),
    }
    inputs = Inputs(
        spec=tb.spec(**dict(case.spec) | changes),
        facts=tb.facts_of(*(f for _, f in flown), horizon_s=90.0),
        limits=tb.LIMITS,
        tolerances=tb.TOLERANCES,
    )
    return list(order_conditions(inputs))


def test_phases_of_one_uav_follow_each_other(tb: ModuleType) -> None:
    (only,) = _ordered(tb, first='m1', then='m2')
    assert only.id == 'o1.holds'
    assert only.formula == 'phase_order(uav1,m2) >= 0 s'
    assert not only.implied


def test_each_phase_between_the_two_is_in_its_place(tb: ModuleType) -> None:
    found = _ordered(tb, first='m1', then='m3')
    assert [c.id for c in found] == ['o1.holds.m2', 'o1.holds']
    assert [c.arguments.mission.mission for c in found] == ['m2', 'm3']


def test_events_are_compared_by_their_moments(tb: ModuleType) -> None:
    first, second = _ordered(
        tb, first='e2', then='e1', within_s=tb.number(9.0, Unit.SECOND, explicit=True)
    )
    assert first.formula == 'time_between(e2,e1) >= 0 s'
    assert second.formula == 'time_between(e2,e1) <= 9 s'
    assert first.of == ('e2', 'e1')


def test_what_somebody_does_after_a_trigger_has_a_moment(tb: ModuleType) -> None:
    (only,) = _ordered(tb, first='e1', then='e4')
    assert isinstance(only, Condition)


def test_a_flight_that_waits_for_the_end_of_another_has_its_place(tb: ModuleType) -> None:
    waits = {
        'id': 'e5',
        'trigger': {'on': 'mission_done', 'uav': 'uav1'},
        'action': {'do': 'change_mission', 'uav': 'uav2', 'mission': 'm3'},
    }
    (only,) = _ordered(tb, first='m2', then='m3', uav_of_last='uav2', more=(waits,))
    assert only.id == 'o1.holds'
    assert only.formula == 'time_between(m2,m3) >= 0 s'
    assert only.arguments.event == 'e5'
    # The first of two missions is not the end of that flight.
    (only,) = _ordered(tb, first='m1', then='m3', uav_of_last='uav2', more=(waits,))
    assert isinstance(only, Underivable)


def test_what_waits_for_somebody_tells_which_time_is_meant(tb: ModuleType) -> None:
    waits = {'id': 'e5', 'trigger': {'on': 'event_done', 'event': 'e3'}, 'action': BRAKES}
    (only,) = _ordered(tb, first='e3', then='e5', more=(waits,))
    assert only.formula == 'time_between(e3,e5) >= 0 s'


def test_a_flight_after_what_somebody_does_has_its_place(tb: ModuleType) -> None:
    (only,) = _ordered(tb, first='e1', then='m2')
    assert only.formula == 'time_between(e1,m2) >= 0 s'
    assert (only.arguments.event, only.arguments.mission.mission) == ('e1', 'm2')


@pytest.mark.parametrize(('goal_m', 'is_judged'), [(50.0, True), (32.0, False)])
def test_a_climb_after_a_flight_is_told_by_a_height_of_its_own(
    goal_m: float, is_judged: bool, tb: ModuleType
) -> None:
    climbs = {
        'id': 'e5',
        'trigger': {'on': 'mission_done', 'uav': 'uav1'},
        'action': {'do': 'ascend', 'uav': 'uav1', 'altitude_m': tb.number(goal_m)},
    }
    (only,) = _ordered(tb, first='m3', then='e5', more=(climbs,))
    # What is as high as the flight itself tells nothing.
    assert isinstance(only, Condition) is is_judged


@pytest.mark.parametrize(
    'order',
    [
        {'first': 'm2', 'then': 'm1'},  # a UAV flies its missions as listed
        {'first': 'm1', 'then': 'm3', 'uav_of_last': 'uav2'},
        {'first': 'm1', 'then': 'e1'},
        {'first': 'e3', 'then': 'm2'},
        {'first': 'e3', 'then': 'e1'},  # which braking is meant, nothing says
    ],
)
def test_other_orders_are_named(order: dict[str, Any], tb: ModuleType) -> None:
    (only,) = _ordered(tb, **order)
    assert isinstance(only, Underivable)
    assert only.what == f'that {order["first"]} comes before {order["then"]}'


def test_a_limit_on_the_time_between_phases_is_named(tb: ModuleType) -> None:
    (only,) = _ordered(tb, first='m1', then='m2', within_s=tb.number(9.0, Unit.SECOND))
    assert isinstance(only, Underivable)
