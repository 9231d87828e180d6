# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is to overtake pulls out behind the other one, passes it, and pulls in ahead of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.knowledge.world import CentreLine
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import GroundCommandKind

Build = Callable[..., Any]
LANE = int(GroundCommandKind.CHANGE_LANE)


def _street(count: int) -> tuple[CentreLine, ...]:
    """Return the lanes of a street of 600 m along +x, each 3.3 m left of the one before."""
    return tuple(
        CentreLine(
            lane_id=f'a_{index}',
            street_name='',
            points=np.array([(0.0, 3.3 * index), (600.0, 3.3 * index)]),
            width_m=3.3,
            speed_limit_mps=14.0,
        )
        for index in range(count)
    )


def _scene(stage: Build, lanes: int = 2, **fields: Any) -> Any:
    overtakes = Behavior(kind=BehaviorKind.OVERTAKE, target='van1')
    return stage(tracks={}, behaviors={'ego': (overtakes,)}, lanes=_street(lanes), **fields)


def _orders(scene: Any) -> list[tuple[str, float]]:
    return [(agent, value) for _, agent, kind, value in scene.commands() if kind == LANE]


def test_it_pulls_out_passes_and_pulls_in_again(stage: Build) -> None:
    scene = _scene(stage)
    scene.put('van1', 200.0, speed=6.0).put('ego', 100.0, speed=13.0).step(3)
    assert _orders(scene) == [], 'far behind'
    scene.put('ego', 170.0, speed=13.0).step(3)
    assert _orders(scene) == [('ego', 1.0)]
    scene.put('ego', 205.0, 3.3, 13.0).step(3)
    assert _orders(scene) == [('ego', 1.0)], 'beside it'
    scene.put('ego', 230.0, 3.3, 13.0).step(3)
    assert _orders(scene) == [('ego', 1.0), ('ego', 0.0)]
    scene.put('ego', 260.0, speed=13.0).step(3)
    assert len(_orders(scene)) == 2, 'once'


def test_who_drives_close_ahead_of_the_other_one_is_passed_too(stage: Build) -> None:
    scene = _scene(stage, agents=('van1', 'ego', 'bus1'))
    scene.put('bus1', 235.0, speed=6.0)
    scene.put('van1', 200.0, speed=6.0).put('ego', 170.0, speed=13.0).step(3)
    assert _orders(scene) == [('ego', 1.0)]
    scene.put('bus1', 235.0, speed=6.0).put('ego', 225.0, 3.3, 13.0).step(3)
    assert _orders(scene) == [('ego', 1.0)], 'no room between the two'
    scene.put('ego', 265.0, 3.3, 13.0).step(3)
    assert _orders(scene) == [('ego', 1.0), ('ego', 0.0)]


def test_it_waits_for_a_free_lane(stage: Build) -> None:
    scene = _scene(stage, lanes=1)
    scene.put('van1', 200.0, speed=6.0).put('ego', 180.0, speed=6.0).step(5)
    assert _orders(scene) == []


def test_who_is_ahead_already_does_nothing(stage: Build) -> None:
    scene = _scene(stage)
    scene.put('van1', 200.0, speed=6.0).put('ego', 230.0, speed=13.0).step(5)
    assert _orders(scene) == []


def test_a_site_says_how_close_it_pulls_out(stage: Build) -> None:
    scene = _scene(stage, driving=DrivingStyle(overtake_out_m=10.0))
    scene.put('van1', 200.0, speed=6.0).put('ego', 175.0, speed=13.0).step(3)
    assert _orders(scene) == [], 'close enough for the shipped distance only'
    scene.put('ego', 190.0, speed=13.0).step(3)
    assert _orders(scene) == [('ego', 1.0)]
