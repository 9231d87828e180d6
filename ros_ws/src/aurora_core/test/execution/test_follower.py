# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who follows another one that has changed lane changes after it, and does not pass it before."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from aurora_core.knowledge.world import CentreLine
from aurora_core.outcomes.grounded import ReleaseOn
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, Behavior, Event, Placement, TimeTrigger
from aurora_core.spec.vocabulary import BehaviorKind, Relation
from aurora_core.trace.layout import GroundCommandKind

Build = Callable[..., Any]
LANE = int(GroundCommandKind.CHANGE_LANE)
SPEED = int(GroundCommandKind.SET_SPEED)
FREE = int(GroundCommandKind.RELEASE_SPEED)

STREET = tuple(
    CentreLine(
        lane_id=f'a_{index}',
        street_name='',
        points=np.array([(0.0, 3.3 * index), (600.0, 3.3 * index)]),
        width_m=3.3,
        speed_limit_mps=14.0,
    )
    for index in range(2)
)


def _scene(stage: Build, *behaviors: Behavior, **fields: Any) -> Any:
    follows = Behavior(kind=BehaviorKind.FOLLOW, target='van1')
    return stage(tracks={}, behaviors={'ego': (follows, *behaviors)}, lanes=STREET, **fields)


def _of_ego(scene: Any, kind: int) -> list[float]:
    return [value for _, agent, k, value in scene.commands() if agent == 'ego' and k == kind]


def test_behind_on_one_lane_it_is_left_to_the_simulator(stage: Build) -> None:
    scene = _scene(stage).put('van1', 200.0, speed=8.0).put('ego', 180.0, speed=8.0)
    scene.step(3)
    assert _of_ego(scene, LANE) == _of_ego(scene, SPEED) == []


def test_it_changes_lane_after_the_other_one_once(stage: Build) -> None:
    scene = _scene(stage).put('van1', 200.0, 3.3, 8.0).put('ego', 180.0, speed=8.0)
    scene.step(5)
    assert _of_ego(scene, LANE) == [1.0]
    scene.put('ego', 180.0, 3.3, 8.0).step(3)
    assert _of_ego(scene, LANE) == [1.0]
    assert len(_of_ego(scene, FREE)) == 2, 'at the start, and once it is behind again'


@pytest.mark.parametrize(
    ('gap_m', 'slower'), [(19.0, 0.0), (9.0, 0.4 * 10.0), (-5.0, 0.4 * 24.0), (29.0, -0.4 * 10.0)]
)
def test_beside_it_keeps_a_gap(gap_m: float, slower: float, stage: Build) -> None:
    """Two seconds and 3 m are kept at 8 m/s; nobody drives backwards."""
    scene = _scene(stage).put('van1', 200.0, 3.3, 8.0)
    scene.put('ego', 200.0 - 4.5 - gap_m, speed=8.0).step()
    assert _of_ego(scene, SPEED) == [pytest.approx(max(0.0, 8.0 - slower))]


def test_who_is_told_to_change_lane_does_not_change_back(
    stage: Build, parameter: Callable[..., Parameter]
) -> None:
    later = TimeTrigger(on='time', at_s=parameter(100.0, 's'))
    change = Event(id='e1', trigger=later, action=AgentAction(do='change_lane', agent='ego'))
    scene = _scene(stage, events=(change,))
    scene.put('van1', 200.0, speed=8.0).put('ego', 180.0, 3.3, 8.0).step(5)
    assert _of_ego(scene, LANE) == []
    assert _of_ego(scene, SPEED) != [], 'it stays behind all the same'


def test_whose_speed_is_told_is_not_paced(stage: Build) -> None:
    scene = _scene(stage, Behavior(kind=BehaviorKind.SLOW))
    scene.put('van1', 200.0, 3.3, 4.0).put('ego', 180.0, speed=4.0).step(3)
    assert _of_ego(scene, SPEED) == []


def test_who_is_held_does_not_set_off(stage: Build) -> None:
    scene = _scene(stage, releases={'ego': (ReleaseOn.NEVER, '')})
    scene.put('van1', 200.0, 3.3, 8.0).put('ego', 180.0).step(3)
    assert _of_ego(scene, SPEED) == [0.0]


def test_far_away_it_is_left_to_itself(stage: Build) -> None:
    scene = _scene(stage).put('van1', 200.0, 3.3, 8.0).put('ego', 180.0, speed=8.0)
    scene.step()
    scene.put('van1', 300.0, 3.3, 8.0).step()
    assert len(_of_ego(scene, FREE)) == 2


def _abreast(stage: Build, relation: Relation, **fields: Any) -> Any:
    beside = Placement(relation=relation, of='van1', kept_in_motion=True)
    return stage(tracks={}, placements={'ego': (beside,)}, lanes=STREET, **fields)


@pytest.mark.parametrize('relation', [Relation.BESIDE, Relation.LEFT, Relation.RIGHT])
@pytest.mark.parametrize('behind_m', [-10.0, 0.0, 10.0])
def test_beside_one_keeps_level(relation: Relation, behind_m: float, stage: Build) -> None:
    """Centre beside centre, whichever side it is."""
    scene = _abreast(stage, relation).put('van1', 200.0, 3.3, 8.0)
    scene.put('ego', 200.0 - behind_m, speed=8.0).step()
    assert _of_ego(scene, SPEED) == [pytest.approx(8.0 + 0.4 * behind_m)]


def test_a_vehicle_keeps_level_with_who_walks_beside_it(stage: Build) -> None:
    """The person walks as he does; every one of them stands at first."""
    scene = _abreast(stage, Relation.BESIDE, halts={'van1': (900.0, 0.0)}, speeds={'van1': 1.4})
    scene.put('van1', 200.0, 3.3, 0.0).put('ego', 200.0).step()
    scene.put('van1', 201.0, 3.3, 1.4).step()
    assert _of_ego(scene, SPEED) == [0.0, pytest.approx(1.4 + 0.4 * 1.0)]
    told = [v for _, agent, k, v in scene.commands() if agent == 'van1' and k == SPEED]
    assert told == [1.4]


def test_who_has_lost_the_one_beside_it_drives_on_by_itself(stage: Build) -> None:
    scene = _abreast(stage, Relation.BESIDE).put('van1', 200.0, 3.3, 8.0)
    scene.put('ego', 190.0, speed=8.0).step()
    before = len(_of_ego(scene, FREE))
    scene.put('ego', 60.0, speed=8.0).step(2)
    assert len(_of_ego(scene, FREE)) == before + 1


def test_of_two_beside_one_another_a_told_speed_stays(
    parameter: Callable[..., Parameter], stage: Build
) -> None:
    drives = Behavior(kind=BehaviorKind.DRIVE, speed_mps=parameter(6.0, 'm/s'))
    scene = _abreast(stage, Relation.LEFT, behaviors={'ego': (drives,)})
    scene.put('van1', 200.0, 3.3, 6.0).put('ego', 195.0, speed=6.0).step(3)
    told = [v for _, agent, k, v in scene.commands() if agent == 'van1' and k == SPEED]
    assert told == [pytest.approx(6.0 - 0.4 * 5.0)]
    assert all(v == 6.0 for v in _of_ego(scene, SPEED))


@pytest.mark.parametrize(
    ('tops_mps', 'told'),
    [
        ({'ego': 5.0}, 'van1'),  # however it is called: a cyclist, or a tractor
        ({'van1': 5.0}, 'ego'),
        ({}, 'ego'),
        ({'ego': 20.0, 'van1': 30.0}, 'van1'),
    ],
)
def test_of_two_beside_one_another_the_faster_one_keeps_level(
    tops_mps: dict[str, float], told: str, stage: Build
) -> None:
    """The slower one could not catch up with the other one."""
    scene = _abreast(stage, Relation.BESIDE, tops_mps=tops_mps)
    scene.put('van1', 200.0, 3.3, 4.0).put('ego', 195.0, speed=4.0).step(3)
    assert {agent for _, agent, kind, _ in scene.commands() if kind == SPEED} == {told}


def test_of_two_beside_one_another_a_bound_holds(stage: Build) -> None:
    """Who may go no faster than 6 m/s is the one that is kept level with."""
    scene = _abreast(stage, Relation.BESIDE, speeds={'ego': 6.0})
    scene.put('van1', 200.0, 3.3, 6.0).put('ego', 195.0, speed=6.0).step(3)
    told = [v for _, agent, k, v in scene.commands() if agent == 'van1' and k == SPEED]
    assert told == [pytest.approx(6.0 - 0.4 * 5.0)]


@pytest.mark.parametrize(('relation', 'off_m'), [(Relation.AHEAD, 10.0), (Relation.BEHIND, -10.0)])
def test_who_is_ahead_on_the_lane_beside_is_kept_to(
    relation: Relation, off_m: float, parameter: Callable[..., Parameter], stage: Build
) -> None:
    """10 m between their centres, whoever of the two is in front."""
    placements = (
        Placement(relation=Relation.ADJACENT_LANE, of='van1'),
        Placement(
            relation=relation, of='van1', distance_m=parameter(10.0, 'm'), kept_in_motion=True
        ),
    )
    drives = Behavior(kind=BehaviorKind.DRIVE, speed_mps=parameter(9.0, 'm/s'))
    scene = stage(
        tracks={}, placements={'ego': placements}, behaviors={'ego': (drives,)}, lanes=STREET
    )
    scene.put('van1', 200.0, 3.3, 9.0).put('ego', 205.0, speed=9.0).step()
    told = [v for _, agent, k, v in scene.commands() if agent == 'van1' and k == SPEED]
    assert told == [pytest.approx(9.0 + 0.4 * (5.0 - off_m))]


def _braking(stage: Build, parameter: Callable[..., Parameter], *more: Event) -> Any:
    at_once = TimeTrigger(on='time', at_s=parameter(0.0, 's'))
    brakes = Event(id='e1', trigger=at_once, action=AgentAction(do='brake', agent='ego'))
    scene = _scene(stage, events=(brakes, *more))
    scene.put('van1', 200.0, speed=6.0).put('ego', 180.0, speed=8.0).step()
    return scene.put('van1', 205.0, speed=3.0).put('ego', 185.0, speed=0.0)


def test_who_follows_and_has_braked_drives_on_after_the_other_one(
    stage: Build, parameter: Callable[..., Parameter]
) -> None:
    """It stands for as long as a stop is, and goes on once: a braking is no parking."""
    scene = _braking(stage, parameter)
    before = len(_of_ego(scene, FREE))
    scene.step(20)
    assert len(_of_ego(scene, FREE)) == before
    scene.step(60)
    assert len(_of_ego(scene, FREE)) > before


def test_who_has_braked_stands_behind_one_that_stands(
    stage: Build, parameter: Callable[..., Parameter]
) -> None:
    scene = _braking(stage, parameter)
    before = len(_of_ego(scene, FREE))
    scene.put('van1', 205.0, speed=0.0).step(80)
    assert len(_of_ego(scene, FREE)) == before


def test_who_is_told_what_comes_after_braking_waits_for_that(
    stage: Build, parameter: Callable[..., Parameter]
) -> None:
    later = TimeTrigger(on='time', at_s=parameter(100.0, 's'))
    start = Event(id='e2', trigger=later, action=AgentAction(do='start', agent='ego'))
    scene = _braking(stage, parameter, start)
    before = len(_of_ego(scene, FREE))
    scene.step(80)
    assert len(_of_ego(scene, FREE)) == before
