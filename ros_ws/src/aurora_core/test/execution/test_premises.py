# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A low speed that an event waits for comes about while everybody watches and drives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, Behavior, Event, SpeedTrigger
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]
SLOWED = int(GroundCommandKind.SET_SPEED)


def _waits(make: Make, on: str = 'speed_below') -> Event:
    trigger = SpeedTrigger.model_validate({'on': on, 'who': 'van1', 'value_mps': make(3.0, 'm/s')})
    return Event(id='e1', trigger=trigger, action=AgentAction(do='brake', agent='ego'))


def _slowed(scene: Any) -> list[tuple[int, str, int, float]]:
    return [c for c in scene.commands() if c[:3][1:] == ('van1', SLOWED)]


def _drive(scene: Any, van_mps: float, ego_mps: float, ticks: int) -> None:
    scene.put('van1', 40.0, speed=van_mps).put('ego', 0.0, speed=ego_mps)
    scene.follow(ticks)


def test_it_slows_down_once_it_was_driven_for_a_while(stage: Build, parameter: Make) -> None:
    scene = stage(events=(_waits(parameter),))
    _drive(scene, 10.0, 10.0, 400)
    ((tick, _, _, value),) = _slowed(scene)
    assert value == pytest.approx(2.0)
    captured = scene.machines[0].capture_tick
    assert captured is not None
    assert tick >= captured + 80


@pytest.mark.parametrize('waits', [True, False])
def test_nobody_stops_before_those_who_are_to_drive_have_driven(
    stage: Build, parameter: Make, waits: bool
) -> None:
    drives = (Behavior(kind=BehaviorKind.DRIVE),)
    stops = Event(id='e1', action=AgentAction(do='stop', agent='van1'))
    scene = stage(
        events=(_waits(parameter) if waits else stops,),
        behaviors={'van1': drives, 'ego': drives},
        drive_m=90.0,
    )
    _drive(scene, 6.0, 8.0, 400)
    ((tick, *_),) = _slowed(scene)
    assert tick * 0.05 * 6.0 == pytest.approx(90.0, abs=1.0)


@pytest.mark.parametrize(('van_mps', 'ego_mps'), [(2.0, 10.0), (10.0, 1.0)])
def test_it_waits_for_those_who_do_not_drive(
    stage: Build, parameter: Make, van_mps: float, ego_mps: float
) -> None:
    scene = stage(events=(_waits(parameter),))
    _drive(scene, van_mps, ego_mps, 400)
    assert _slowed(scene) == []


def test_what_something_else_decides_is_left_to_it(stage: Build, parameter: Make) -> None:
    stops = Event(id='e2', action=AgentAction(do='stop', agent='van1'))
    scene = stage(events=(_waits(parameter), stops))
    _drive(scene, 10.0, 10.0, 400)
    assert [value for *_, value in _slowed(scene)] == [0.0]  # the stop that is asked for
    scene = stage(events=(_waits(parameter, 'speed_above'),))
    _drive(scene, 10.0, 10.0, 400)
    assert _slowed(scene) == []


def test_who_has_a_stated_speed_slows_down_once_it_has_shown(
    stage: Build, parameter: Make
) -> None:
    drives = Behavior(kind=BehaviorKind.DRIVE, speed_mps=parameter(12.0, 'm/s', explicit=True))
    scene = stage(events=(_waits(parameter),), behaviors={'van1': (drives,)})
    _drive(scene, 10.0, 10.0, 600)
    assert _slowed(scene) == []  # it is not as fast as it is to be
    _drive(scene, 12.0, 10.0, 380)
    assert _slowed(scene) == []
    _drive(scene, 12.0, 10.0, 40)
    ((_, _, _, value),) = _slowed(scene)
    assert value == pytest.approx(2.0)


def _outruns(make: Make, value_mps: float = 20.0) -> Event:
    values = {'on': 'speed_above', 'who': 'van1', 'value_mps': make(value_mps, 'm/s')}
    trigger = SpeedTrigger.model_validate(values)
    return Event(id='e1', trigger=trigger, action=AgentAction(do='start', agent='ego'))


def test_who_was_as_fast_as_is_waited_for_lets_its_uav_catch_up(
    stage: Build, parameter: Make
) -> None:
    scene = stage(events=(_outruns(parameter),))
    _drive(scene, 19.0, 0.0, 40)
    assert _slowed(scene) == []
    _drive(scene, 20.5, 0.0, 40)
    ((tick, _, _, value),) = _slowed(scene)
    assert 40 < tick < 60
    assert value == pytest.approx(0.75 * 18.0)


@pytest.mark.parametrize('why', ['it is slow enough', 'its speed is stated', 'nobody tracks it'])
def test_who_is_not_outrun_keeps_its_speed(stage: Build, parameter: Make, why: str) -> None:
    fast = Behavior(kind=BehaviorKind.DRIVE, speed_mps=parameter(20.5, 'm/s'))
    scene = stage(
        events=(_outruns(parameter, 12.0 if why == 'it is slow enough' else 20.0),),
        behaviors={'van1': (fast,)} if why == 'its speed is stated' else {},
        **({'tracks': {}} if why == 'nobody tracks it' else {}),
    )
    _drive(scene, 20.5, 0.0, 80)
    assert _slowed(scene) == []
