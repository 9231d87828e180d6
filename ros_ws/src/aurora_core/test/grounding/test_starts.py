# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs that set out together do not meet on the way."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

import numpy as np
import pytest

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.starts import uncrossed
from aurora_core.knowledge.map_types import Building
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Point = tuple[float, float, float]

EAST_WEST = [(0.0, 0.0), (20.0, 0.0)]


def _plans(homes: list[tuple[float, float]]) -> list[UavPlan]:
    return [
        UavPlan(
            id=f'uav{k + 1}',
            system_id=k + 1,
            home_x_m=x,
            home_y_m=y,
            landing_spots=((x, y),),
            missions=(),
            safe_altitude_m=60.0,
        )
        for k, (x, y) in enumerate(homes)
    ]


def _homes(
    points: list[Point], airspace: Airspace, homes: list[tuple[float, float]] = EAST_WEST
) -> list[tuple[float, float]]:
    plans = uncrossed(_plans(homes), points, airspace, apart_m=10.0, clearance_m=4.0)
    assert [p.id for p in plans] == [f'uav{k + 1}' for k in range(len(homes))]
    assert all(p.landing_spots == ((p.home_x_m, p.home_y_m),) for p in plans)
    return [(p.home_x_m, p.home_y_m) for p in plans]


def test_crossing_ways_at_one_height_are_exchanged() -> None:
    points = [(20.0, 100.0, 30.0), (0.0, 100.0, 30.0)]
    assert _homes(points, Airspace((), ())) == EAST_WEST[::-1]


def test_ways_that_do_not_cross_stay() -> None:
    points = [(0.0, 100.0, 30.0), (20.0, 100.0, 30.0)]
    assert _homes(points, Airspace((), ())) == EAST_WEST


def test_heights_far_apart_may_cross() -> None:
    points = [(20.0, 100.0, 30.0), (0.0, 100.0, 40.0)]
    assert _homes(points, Airspace((), ())) == EAST_WEST


def test_nothing_is_exchanged_into_a_building() -> None:
    # In the way from (20, 0) to (20, 100), not in those that cross beside it.
    tower = Building(
        id='tower',
        ring=((18.0, 40.0), (22.0, 40.0), (22.0, 44.0), (18.0, 44.0)),
        holes=(),
        height_m=50.0,
        height_source='',
        kind='block',
        name='',
    )
    points = [(20.0, 100.0, 30.0), (0.0, 100.0, 30.0)]
    assert _homes(points, Airspace((tower,), ())) == EAST_WEST


@pytest.mark.parametrize('count', [3, 4, 5])
def test_a_group_keeps_apart_all_the_way(
    count: int, read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., GroundedScenario]
) -> None:
    spec = read_prompt(f'{count} drones track a van at 40 m altitude for 30 s.')
    found = ground(spec)
    homes = np.array([(u.home_x_m, u.home_y_m) for u in found.uavs])
    slots = np.array([u.missions[0].offset_m for u in found.uavs])
    for share in np.linspace(0.0, 1.0, 51):
        places = (1.0 - share) * homes + share * slots
        for a, b in combinations(places, 2):
            assert float(np.hypot(*(a - b))) >= 5.0
