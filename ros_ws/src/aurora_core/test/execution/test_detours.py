# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV on its way to what moves flies over what stands between, or round it."""

from __future__ import annotations

from itertools import pairwise

import pytest

from aurora_core.execution.detours import Detours
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.map_types import Building, NoFlyZone

CLEAR_M, TOP_M = 3.0, 120.0
HERE, GOAL = (0.0, 0.0, 30.0), (300.0, 0.0, 30.0)
Ring = tuple[tuple[float, float], ...]
WALL = ((140.0, -50.0), (160.0, -50.0), (160.0, 50.0), (140.0, 50.0))
SHUT = ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))


def _building(height_m: float, ring: Ring = WALL) -> Airspace:
    tower = Building(
        id='b',
        ring=ring,
        holes=(),
        height_m=height_m,
        height_source='design',
        kind='block',
        name='',
    )
    return Airspace((tower,), ())


def _zone(ring: Ring) -> Airspace:
    return Airspace((), (NoFlyZone(id='z', name='', ring=ring, floor_m=0.0, ceiling_m=1e4),))


def test_a_free_way_is_straight() -> None:
    assert Detours(_building(20.0), CLEAR_M, TOP_M).is_straight(HERE, GOAL)


@pytest.mark.parametrize('airspace', [_building(40.0), _building(119.0), _zone(WALL)])
def test_what_stands_between_is_kept_clear_of(airspace: Airspace) -> None:
    detours = Detours(airspace, CLEAR_M, TOP_M)
    assert not detours.is_straight(HERE, GOAL)
    way = detours.way(HERE, GOAL)
    assert way
    for leg in pairwise((HERE, *way, GOAL)):
        assert airspace.way_clearance_m(leg) >= CLEAR_M
    assert max(point[2] for point in way) <= TOP_M


def test_a_long_low_building_is_flown_over_and_a_tall_one_round() -> None:
    long = ((140.0, -150.0), (160.0, -150.0), (160.0, 150.0), (140.0, 150.0))
    low = Detours(_building(32.0, long), CLEAR_M, TOP_M).way(HERE, GOAL)
    tall = Detours(_building(119.0, long), CLEAR_M, TOP_M).way(HERE, GOAL)
    assert {point[2] for point in low} == {40.0}
    assert {point[2] for point in tall} == {30.0}
    assert max(abs(point[1]) for point in tall) > 150.0


def test_before_a_goal_in_a_zone_it_waits_outside() -> None:
    airspace = _zone(SHUT)
    way = Detours(airspace, CLEAR_M, TOP_M).way(GOAL, (0.0, 0.0, 30.0))
    assert way
    for leg in pairwise((GOAL, *way)):
        assert airspace.way_clearance_m(leg) >= CLEAR_M
