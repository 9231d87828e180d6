# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Behaviours that are one action at some time: when it is taken, and what is commanded."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aurora_core.knowledge.world import CentreLine
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, Behavior, Event, TimeTrigger
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import ScenarioEventKind

Make = Callable[..., Parameter]
Build = Callable[..., Any]

SPEED, RELEASE = int(GroundCommandKind.SET_SPEED), int(GroundCommandKind.RELEASE_SPEED)
LANE = int(GroundCommandKind.CHANGE_LANE)


def _scene(stage: Build, behavior: Behavior, **fields: Any) -> Any:
    return stage(tracks={}, behaviors={'ego': (behavior,)}, **fields)


def _told(scene: Any) -> list[tuple[int, int, float]]:
    """Return what the ego is told after the beginning."""
    return [(t, kind, v) for t, who, kind, v in scene.commands() if who == 'ego' and t > 0]


def test_who_slows_down_gets_to_half_its_speed(stage: Build) -> None:
    scene = _scene(stage, Behavior(kind=BehaviorKind.SLOW))
    for speed in (0.0, 4.9, 6.0, 6.0):
        scene.put('ego', 0.0, speed=speed).step()
    assert _told(scene) == [(2, SPEED, 2.7)]


@pytest.mark.parametrize(('goal', 'tick'), [(2.0, 1), (5.0, 2), (9.0, 3)])
def test_who_slows_down_to_a_speed_is_faster_before(
    goal: float, tick: int, stage: Build, parameter: Make
) -> None:
    behavior = Behavior(kind=BehaviorKind.SLOW, speed_mps=parameter(goal, 'm/s', explicit=True))
    scene = _scene(stage, behavior)
    for speed in (1.0, 5.0, 7.5, 11.5, 11.5):
        scene.put('ego', 0.0, speed=speed).step()
    assert _told(scene) == [(tick, SPEED, goal)]


def test_what_an_event_lets_one_do_is_not_done_before(stage: Build, parameter: Make) -> None:
    """ "The truck changes lane. At 0.2 s it changes lane": once, and then."""
    changes = AgentAction(do='slow', agent='ego')
    at = Event(id='e1', trigger=TimeTrigger(on='time', at_s=parameter(0.2, 's')), action=changes)
    scene = _scene(stage, Behavior(kind=BehaviorKind.SLOW), events=(at,))
    for _ in range(6):
        scene.put('ego', 0.0, speed=8.0).step()
    [(tick, kind, goal)] = _told(scene)
    assert (tick, kind) == (4, SPEED)
    assert goal == pytest.approx(0.45 * 8.0)
    assert {event for _, event, _ in scene.notes(ScenarioEventKind.ACTION)} == {'e1'}


def test_the_run_waits_until_a_behaviour_was_shown(stage: Build) -> None:
    scene = _scene(stage, Behavior(kind=BehaviorKind.SLOW))
    scene.put('ego', 0.0, speed=8.0).step(2)
    assert scene.notes(ScenarioEventKind.ACTION) == [(0, 'own1', '')]
    assert not scene.stepper._runner.done
    scene.put('ego', 0.0, speed=4.0).step()
    assert scene.stepper._runner.done


def test_who_changes_lane_does_so_once_it_drives(stage: Build) -> None:
    lanes = tuple(
        CentreLine(
            lane_id=f'a_{k}',
            street_name='',
            points=np.array([(0.0, 3.3 * k), (200.0, 3.3 * k)]),
            width_m=3.3,
            speed_limit_mps=14.0,
        )
        for k in (0, 1)
    )
    scene = _scene(stage, Behavior(kind=BehaviorKind.CHANGE_LANE), lanes=lanes)
    for speed in (0.0, 4.0, 6.0, 6.0):
        scene.put('ego', 20.0, speed=speed).put('van1', 500.0).step()
    assert [(t, v) for t, kind, v in _told(scene) if kind == LANE] == [(2, 1.0)]


def _yields(stage: Build, **fields: Any) -> Any:
    scene = _scene(stage, Behavior(kind=BehaviorKind.YIELD, target='van1'), **fields)
    for x in (-40.0, -29.0, 0.0, 9.4, 9.5, 20.0):
        scene.put('ego', 0.0, speed=8.0).put('van1', x, 3.3).step()
    return scene


def test_who_yields_stops_and_drives_on_when_the_other_one_has_passed(stage: Build) -> None:
    # Both are 4.5 m long; 5 m are left between them.
    assert _told(_yields(stage)) == [(1, SPEED, 0.0), (4, RELEASE, 0.0)]


def test_who_is_to_do_something_after_yielding_waits_for_that(
    stage: Build, parameter: Make
) -> None:
    later = Event(
        id='own1',
        trigger=TimeTrigger(on='time', at_s=parameter(99.0, 's')),
        action=AgentAction(do='start', agent='ego'),
    )
    scene = _yields(stage, events=(later,))
    assert _told(scene) == [(1, SPEED, 0.0)]
    # The listed event keeps its name.
    assert scene.notes(ScenarioEventKind.ACTION) == [(1, 'own2', '')]
