# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs fly below a stated bound, their targets too; after a fast target as fast as they may."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.grounding.pace import convoy_pace_mps
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.settings import Settings
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]

TRACKS = 'A UAV tracks a motorcycle at 40 m altitude.'
SLOWLY = ' The speed of the UAV stays below 12 m/s.'


def test_a_bound_on_a_uav_holds_for_its_reference_and_slows_its_target(
    read_prompt: Read, ground: Ground, limits: Limits, settings: Settings
) -> None:
    free, bound = (read_prompt(TRACKS + more, 'downtown') for more in ('', SLOWLY))
    assert bound.conditions
    (uav,) = ground(bound, 'downtown').uavs
    assert uav.speed_max_mps == pytest.approx(11.0)
    assert ground(free, 'downtown').uavs[0].speed_max_mps is None
    pace_mps = convoy_pace_mps(bound, limits, settings.grounding)
    assert pace_mps < 11.0 < convoy_pace_mps(free, limits, settings.grounding)


def test_a_route_is_flown_below_a_bound_that_its_stated_speed_may_miss(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = 'A UAV flies a 400 by 200 m rectangle at 100 m and 18 m/s.'
    bound = ' The speed of the UAV stays below 18 m/s.'
    plain, (capped,) = (
        ground(read_prompt(prompt + more, 'downtown'), 'downtown').uavs for more in ('', bound)
    )
    assert plain[0].missions[0].speed_mps == pytest.approx(18.0)
    assert capped.missions[0].speed_mps == pytest.approx(17.0)


def test_after_a_fast_target_a_uav_flies_as_fast_as_it_may(
    read_prompt: Read, ground: Ground, limits: Limits
) -> None:
    fast = ' The motorcycle drives at 18 m/s.'
    (uav,) = ground(read_prompt(TRACKS + fast, 'downtown'), 'downtown').uavs
    assert uav.speed_max_mps == limits.uav_speed_max_mps


def test_a_bound_that_nobody_can_fly_below_turns_no_flight_round(
    read_prompt: Read, ground: Ground, limits: Limits, settings: Settings
) -> None:
    none = read_prompt(TRACKS + ' The speed of the UAV stays below 0 m/s.', 'downtown')
    assert none.conditions
    (uav,) = ground(none, 'downtown').uavs
    assert uav.speed_max_mps is not None
    assert uav.speed_max_mps > 0.0
    assert convoy_pace_mps(none, limits, settings.grounding) >= 0.0
