# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Level ways: straight where nothing stands, short and clear round what does, else none."""

from __future__ import annotations

import random
from itertools import pairwise
from math import dist

import pytest
import shapely

from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.ways_round import way_round
from aurora_core.knowledge.map_types import Building

CLEARANCE_M = 4.0
START, END = (0.0, 0.0), (300.0, 0.0)


def _length_m(way: tuple[tuple[float, float], ...]) -> float:
    return sum(dist(a, b) for a, b in pairwise(way))


def test_nothing_in_the_way_leaves_it_straight() -> None:
    aside = shapely.box(100.0, 20.0, 120.0, 60.0)
    assert way_round(START, END, [aside], CLEARANCE_M) == (START, END)
    assert way_round(START, END, [], CLEARANCE_M) == (START, END)


def test_a_wall_is_gone_round_on_its_short_side() -> None:
    wall = shapely.box(140.0, -200.0, 160.0, 30.0)
    way = way_round(START, END, [wall], CLEARANCE_M)
    assert way is not None
    assert (way[0], way[-1]) == (START, END)
    assert all(y >= 0.0 for _, y in way)
    assert wall.distance(shapely.LineString(way)) >= CLEARANCE_M
    # Both corners, 5 m outside of them, and no detour.
    assert _length_m(way) <= _length_m((START, (135.0, 35.0), (165.0, 35.0), END)) + 0.1


@pytest.mark.parametrize('seed', range(20))
def test_a_way_among_many_keeps_its_clearance_and_is_as_short_as_can_be(seed: int) -> None:
    draw = random.Random(seed)
    boxes = []
    for _ in range(25):
        x, y = draw.uniform(20.0, 270.0), draw.uniform(-80.0, 80.0)
        box = shapely.box(x, y, x + draw.uniform(3.0, 25.0), y + draw.uniform(3.0, 25.0))
        boxes.append(shapely.affinity.rotate(box, draw.uniform(0.0, 90.0)))
    way = way_round(START, END, boxes, CLEARANCE_M)
    assert way is not None
    assert shapely.union_all(boxes).distance(shapely.LineString(way)) >= CLEARANCE_M
    # Whoever leaves out a bend comes too near.
    for k in range(1, len(way) - 1):
        short = shapely.LineString((*way[:k], *way[k + 1 :]))
        assert shapely.union_all(boxes).distance(short) < CLEARANCE_M + 2.0


def test_ends_in_a_building_are_moved_out_of_it() -> None:
    house = shapely.box(-10.0, -40.0, 10.0, 5.0)
    way = way_round(START, END, [house], CLEARANCE_M)
    assert way is not None
    assert house.distance(shapely.Point(way[0])) == pytest.approx(CLEARANCE_M + 1.0, abs=0.1)


def test_a_courtyard_has_no_way_out() -> None:
    yard = shapely.box(-60.0, -60.0, 60.0, 60.0) - shapely.box(-40.0, -40.0, 40.0, 40.0)
    assert way_round(START, END, [yard], CLEARANCE_M) is None


def test_only_what_reaches_the_height_is_in_the_way() -> None:
    ring = ((140.0, -50.0), (160.0, -50.0), (160.0, 30.0), (140.0, 30.0))
    block = Building(
        id='b1', ring=ring, holes=(), height_m=40.0, height_source='', kind='block', name=''
    )
    air = Airspace((block,), ())
    assert air.level_way(START, END, 45.0, CLEARANCE_M) == (START, END)
    low = air.level_way(START, END, 42.0, CLEARANCE_M)
    assert low is not None
    assert len(low) > 2
    assert air.way_clearance_m([(x, y, 42.0) for x, y in low]) >= CLEARANCE_M
