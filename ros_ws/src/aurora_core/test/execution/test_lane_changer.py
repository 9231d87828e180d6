# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ordered changes of lane: where they are possible, to which lane, and when they are over."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aurora_core.knowledge.world import CentreLine
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, Event, EventDoneTrigger, TimeTrigger
from aurora_core.spec.vocabulary import LaneSide
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import ScenarioEventKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]

CHANGE = AgentAction(do='change_lane', agent='ego')
MODE, LANE = int(GroundCommandKind.SET_LANE_CHANGE_MODE), int(GroundCommandKind.CHANGE_LANE)


def _street(*indices: int) -> tuple[CentreLine, ...]:
    """Return the lanes of a street of 200 m along +x, each 3.3 m left of the one before."""
    return tuple(
        CentreLine(
            lane_id=f'a_{index}',
            street_name='',
            points=np.array([(0.0, 3.3 * index), (200.0, 3.3 * index)]),
            width_m=3.3,
            speed_limit_mps=14.0,
        )
        for index in indices
    )


def _at_once(make: Make, **fields: Any) -> Event:
    return Event(id='e1', trigger=TimeTrigger(on='time', at_s=make(0.0, 's')), action=CHANGE)


def _orders(scene: Any) -> list[tuple[int, int, float]]:
    return [(t, kind, value) for t, _, kind, value in scene.commands() if kind in (MODE, LANE)]


def test_the_left_lane_is_the_first_choice(stage: Build, parameter: Make) -> None:
    scene = stage(tracks={}, events=(_at_once(parameter),), lanes=_street(1, 2, 3))
    scene.put('van1', 500.0).put('ego', 20.0, 6.6, 10.0).step(3)
    assert _orders(scene) == [(0, MODE, 257.0), (0, LANE, 3.0)]
    assert [t for t, _, _ in scene.notes(ScenarioEventKind.ACTION)] == [0]


def _to_side(make: Make, side: str) -> Event:
    change = AgentAction(do='change_lane', agent='ego', side=LaneSide(side))
    return _at_once(make).model_copy(update={'action': change})


@pytest.mark.parametrize(('side', 'lane'), [('left', 3.0), ('right', 1.0)])
def test_a_stated_side_is_the_only_choice(
    side: str, lane: float, stage: Build, parameter: Make
) -> None:
    scene = stage(tracks={}, events=(_to_side(parameter, side),), lanes=_street(1, 2, 3))
    scene.put('van1', 500.0).put('ego', 20.0, 6.6, 10.0).step()
    assert _orders(scene)[-1] == (0, LANE, lane)
    # A bag keeps floats, and its hash tells them from integers.
    assert all(type(value) is float for _, _, value in _orders(scene))


def test_where_the_stated_side_has_no_lane_it_waits(stage: Build, parameter: Make) -> None:
    scene = stage(tracks={}, events=(_to_side(parameter, 'right'),), lanes=_street(1, 2))
    scene.put('van1', 500.0).put('ego', 20.0, 3.3, 10.0).step(5)
    assert _orders(scene) == []


@pytest.mark.parametrize(
    ('van_x', 'van_speed', 'lane'),
    [
        (20.0, 10.0, 1.0),
        (29.0, 10.0, 1.0),
        (29.6, 10.0, 3.0),
        (40.0, 4.0, 1.0),
        (11.0, 10.0, 1.0),
        (1.0, 14.0, 3.0),
        (1.0, 22.0, 1.0),
    ],
)
def test_who_is_beside_leaves_the_other_side(
    van_x: float, van_speed: float, lane: float, stage: Build, parameter: Make
) -> None:
    scene = stage(tracks={}, events=(_at_once(parameter),), lanes=_street(1, 2, 3))
    scene.put('van1', van_x, 9.9, van_speed).put('ego', 20.0, 6.6, 10.0).step()
    assert _orders(scene)[-1] == (0, LANE, lane)


@pytest.mark.parametrize(
    ('x', 'speed'),
    [(20.0, 0.0), (180.0, 10.0), (250.0, 10.0)],
    ids=['stands', 'end-of-street', 'junction'],
)
def test_it_waits_until_there_is_room(
    x: float, speed: float, stage: Build, parameter: Make
) -> None:
    scene = stage(tracks={}, events=(_at_once(parameter),), lanes=_street(1, 2))
    scene.put('van1', 500.0).put('ego', x, 3.3, speed).step(5)
    assert _orders(scene) == []
    scene.put('ego', 30.0, 3.3, 10.0).step(2)
    assert _orders(scene) == [(5, MODE, 257.0), (5, LANE, 2.0)]


def test_on_a_street_with_one_lane_nothing_is_ordered(stage: Build, parameter: Make) -> None:
    scene = stage(tracks={}, events=(_at_once(parameter),), lanes=_street(1))
    scene.put('ego', 30.0, 3.3, 10.0).step(20)
    assert _orders(scene) == []
    assert scene.notes(ScenarioEventKind.ACTION) == []


def test_what_follows_waits_for_the_middle_of_the_other_lane(
    stage: Build, parameter: Make
) -> None:
    then = Event(
        id='e2',
        trigger=EventDoneTrigger(on='event_done', event='e1'),
        action=AgentAction(do='stop', agent='ego'),
    )
    scene = stage(tracks={}, events=(_at_once(parameter), then), lanes=_street(1, 2))
    scene.put('van1', 500.0)
    for y in (3.3, 3.3, 4.0, 5.2, 6.2, 6.5, 6.6):
        scene.put('ego', 30.0, y, 10.0).step()
    assert [(t, e) for t, e, _ in scene.notes(ScenarioEventKind.TRIGGERED)] == [
        (0, 'e1'),
        (5, 'e2'),
    ]


def test_an_event_without_a_trigger_waits_for_who_is_to_drive(
    stage: Build, parameter: Make
) -> None:
    event = Event(id='e1', trigger=None, action=CHANGE)
    scene = stage(tracks={}, events=(event,), lanes=_street(1, 2))
    scene.put('van1', 500.0).put('ego', 30.0, 3.3, 4.0).step(2)
    scene.put('ego', 31.0, 3.3, 6.0).step()
    assert _orders(scene) == [(2, MODE, 257.0), (2, LANE, 2.0)]


@pytest.mark.parametrize(('do', 'driven_at'), [('brake', 10), ('stop', 43)])
def test_who_was_to_brake_or_stop_before_drives_on_to_change_lane(
    do: str, driven_at: int, stage: Build, parameter: Make
) -> None:
    """It brakes for ten ticks; a stop is one once it has stood for 2 s, or 40 ticks."""
    halts = Event(
        id='e1',
        trigger=TimeTrigger(on='time', at_s=parameter(0.0, 's')),
        action=AgentAction(do=do, agent='ego'),  # type: ignore[arg-type]
    )
    then = Event(id='e2', trigger=EventDoneTrigger(on='event_done', event='e1'), action=CHANGE)
    scene = stage(tracks={}, events=(halts, then), lanes=_street(1, 2))
    scene.put('van1', 500.0).put('ego', 30.0, 3.3, 8.0).step(10 if do == 'brake' else 3)
    scene.put('ego', 30.0, 3.3, 0.0).step(60)
    driven = [
        t
        for t, _, kind, value in scene.commands()
        if t > 3 and not (kind == GroundCommandKind.SET_SPEED and value == 0.0)
    ]
    assert driven[0] == driven_at
