# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an order alone times waits for what comes before it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.planning.orders import following, waiting
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import ScenarioSpec

Make = Callable[..., Parameter]
LANDS = {'do': 'land', 'uav': 'uav1'}


def _spec(make: Make, *orders: tuple[str, str], **events: Any) -> ScenarioSpec:
    hover = {'mode': 'hover', 'altitude_m': make(50.0), 'duration_s': make(30.0, 's')}
    flown = (('m1', 'uav1'), ('m2', 'uav1'), ('m3', 'uav2'), ('m4', 'uav2'))
    return ScenarioSpec.model_validate(
        {
            'prompt': 'x',
            'agents': [{'id': 'car1', 'type': 'car'}, {'id': 'bus1', 'type': 'bus'}],
            'uavs': [{'id': 'uav1'}, {'id': 'uav2'}],
            'missions': [{'id': m, 'uav': uav} | hover for m, uav in flown],
            'events': [{'id': name} | event for name, event in events.items()],
            'orders': [{'id': f'o{k}', 'first': a, 'then': b} for k, (a, b) in enumerate(orders)],
        }
    )


def _stops(agent: str, **trigger: Any) -> dict[str, Any]:
    return {'action': {'do': 'stop', 'agent': agent}} | ({'trigger': trigger} if trigger else {})


def _triggers(spec: ScenarioSpec) -> dict[str, Any]:
    found = {e.id: e.trigger for e in waiting(spec).events}
    return {
        name: t and (t.on, getattr(t, 'event', getattr(t, 'uav', ''))) for name, t in found.items()
    }


def test_an_agent_waits_for_the_event_before(parameter: Make) -> None:
    spec = _spec(parameter, ('e1', 'e2'), e1=_stops('bus1'), e2=_stops('car1'))
    assert _triggers(spec) == {'e1': None, 'e2': ('event_done', 'e1')}


@pytest.mark.parametrize(('told', 'on'), [('car1', 'message_received'), ('bus1', 'event_done')])
def test_who_is_told_waits_until_the_message_is_there(parameter: Make, told: str, on: str) -> None:
    says = {'action': {'do': 'send_message', 'sender': 'uav1', 'receiver': told}}
    spec = _spec(parameter, ('e1', 'e2'), e1=says, e2=_stops('car1'))
    made = waiting(spec)
    later = next(e.trigger for e in made.events if e.id == 'e2')
    assert later is not None
    assert later.on == on
    if on == 'message_received':
        assert (later.by, later.sender) == ('car1', 'uav1')  # type: ignore[union-attr]
    assert waiting(made) == made


def test_a_landing_waits_for_the_last_mission(parameter: Make) -> None:
    assert _triggers(_spec(parameter, ('m2', 'e1'), e1={'action': LANDS})) == {
        'e1': ('mission_done', 'uav1')
    }


def test_a_uav_waits_on_the_ground_for_the_flight_of_another(parameter: Make) -> None:
    found = waiting(_spec(parameter, ('m2', 'm3')))
    (takeoff,) = found.events
    assert (takeoff.action.uav, takeoff.action.mission) == ('uav2', 'm3')  # type: ignore[union-attr]
    assert takeoff.trigger.uav == 'uav1'  # type: ignore[union-attr]
    assert waiting(found) == found


@pytest.mark.parametrize(
    ('order', 'events'),
    [
        (('m1', 'e1'), {'e1': {'action': LANDS}}),  # goes on to m2: nothing tells that end
        (('m1', 'm2'), {}),  # flown in that order anyway
        (('m2', 'm4'), {}),  # in the air already
        (('e1', 'e2'), {'e1': _stops('bus1'), 'e2': {'action': LANDS}}),  # has its own moment
        (('e1', 'e2'), {'e1': {}, 'e2': _stops('car1')}),  # a milestone is never done
        (
            ('e1', 'e2'),
            {'e1': _stops('bus1', on='event_done', event='e2'), 'e2': _stops('car1')},
        ),  # they would wait for each other
    ],
)
def test_what_is_timed_otherwise_stays(
    parameter: Make, order: tuple[str, str], events: dict[str, Any]
) -> None:
    spec = _spec(parameter, order, **events)
    assert waiting(spec) is spec


def _drives_on(make: Make, told_s: Parameter, *, asked: int = 1, **event: Any) -> ScenarioSpec:
    """car1 drives for a time, then accelerates, then stops."""
    drives = {'kind': 'drive', 'duration_s': told_s}
    does = ({'do': 'accelerate', 'agent': 'car1'}, {'do': 'stop', 'agent': 'car1'})
    events = [
        {'id': f'e{k}', 'action': action, 'span': {'start': 60 + k, 'end': 61 + k}} | event
        for k, action in enumerate(does)
    ]
    agents = [{'id': 'car1', 'type': 'car', 'behaviors': [drives] * asked}]
    return ScenarioSpec.model_validate({'prompt': 'x' * 80, 'agents': agents, 'events': events})


def test_what_nobody_dates_follows_the_stated_time_of_what_its_agent_does(
    parameter: Make,
) -> None:
    spec = following(_drives_on(parameter, parameter(20.0, 's')))
    first, second = (e.trigger for e in spec.events)
    assert first is not None
    assert (first.on, first.who, first.behavior) == ('behavior_done', 'car1', 'drive')  # type: ignore[union-attr]
    assert second is None
    assert following(spec) == spec


@pytest.mark.parametrize(
    ('asked', 'event'),
    [
        (2, {}),  # which of the two times?
        (0, {}),
        (1, {'trigger': {'on': 'message_received', 'by': 'car1'}}),
        (1, {'span': None}),  # nobody knows what is said first
    ],
)
def test_what_follows_no_stated_time_stays(
    parameter: Make, asked: int, event: dict[str, Any]
) -> None:
    spec = _drives_on(parameter, parameter(20.0, 's'), asked=asked, **event)
    assert following(spec) is spec
