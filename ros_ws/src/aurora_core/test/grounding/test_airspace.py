# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ways that walls bar are told at little cost, and no way that is free is held to be barred."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from math import cos, sin

import pytest
import shapely

from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

Point3 = tuple[float, float, float]

CLEARANCE_M = 5.0


@pytest.mark.parametrize('name', ['downtown', 'helsinki'])
def test_a_way_held_to_be_barred_has_no_clearance(
    name: str, map_of: Callable[[str], MapModel]
) -> None:
    the_map = map_of(name)
    air = Airspace(the_map.buildings, the_map.zones)
    west, south, east, north = shapely.union_all(
        [shapely.Polygon(b.ring) for b in the_map.buildings]
    ).bounds
    draw = random.Random(7)
    barred = close = 0
    for _ in range(300):
        x, y, z = draw.uniform(west, east), draw.uniform(south, north), draw.uniform(4.0, 70.0)
        angle, far_m = draw.uniform(0.0, 6.3), draw.uniform(5.0, 80.0)
        way = ((x, y), (x + far_m * cos(angle), y + far_m * sin(angle)))
        least_m = air.way_clearance_m([(*point, z) for point in way])
        close += least_m < CLEARANCE_M
        if air.bars_level(way, z, CLEARANCE_M):
            barred += 1
            assert least_m < CLEARANCE_M
    # What is left to the exact check are the roofs just below a way.
    assert 0.5 * close <= barred <= close < 300


def test_whether_a_point_is_in_a_building_is_what_its_outline_says(
    map_of: Callable[[str], MapModel],
) -> None:
    the_map = map_of('helsinki')
    air = Airspace(the_map.buildings, the_map.zones)
    outlines = [shapely.Polygon(b.ring) for b in the_map.buildings]
    draw = random.Random(3)
    inside = 0
    for outline in draw.sample(outlines, 40):
        west, south, east, north = outline.bounds
        x, y = draw.uniform(west, east), draw.uniform(south, north)
        held = any(o.contains(shapely.Point(x, y)) for o in outlines)
        inside += held
        assert air.is_inside(x, y) == held
    assert 10 < inside < 40


def test_a_low_patrol_over_streets_is_given_up_without_measuring_every_place(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario | GroundingFailure],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """It took 27 s of processor time; of a way that walls bar nothing has to be measured."""
    measured: list[Sequence[Point3]] = []
    exactly = Airspace.way_clearance_m

    def counted(air: Airspace, points: Sequence[Point3]) -> float:
        measured.append(points)
        return exactly(air, points)

    monkeypatch.setattr(Airspace, 'way_clearance_m', counted)
    prompt = 'A drone patrols a rectangle of 120 m by 80 m over the streets at 6 m altitude.'
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundingFailure)
    assert found.reason == 'clearance'
    assert found.tried > 1000
    assert len(measured) < found.tried / 10
