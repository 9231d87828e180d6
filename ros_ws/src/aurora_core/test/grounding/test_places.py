# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places that a scenario names have one position, for the flight and for the verdict."""

from __future__ import annotations

from collections.abc import Callable
from math import hypot, sqrt

import pytest
import shapely

from aurora_core.errors import MapError
from aurora_core.grounding.places import (
    MapPlaces,
    approach_point,
    place_positions,
    road_point,
)
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Maps = Callable[[str], MapModel]


@pytest.mark.parametrize('anchor', [(0.0, 0.0), (140.0, 0.0), (-160.0, 3.0), (0.0, 150.0)])
def test_the_end_of_a_street_is_no_intersection(anchor: tuple[float, float], map_of: Maps) -> None:
    assert MapPlaces(map_of('junction')).point('intersection', anchor) == (0.0, 0.0)


def test_the_nearest_intersection_is_taken(map_of: Maps) -> None:
    the_map = map_of('downtown')
    signals = [j for j in the_map.network.junctions.values() if j.has_signal]
    assert len(signals) > 5
    for junction in signals:
        here = (junction.x_m + 4.0, junction.y_m - 3.0)
        assert MapPlaces(the_map).point('intersection', here) == (junction.x_m, junction.y_m)


def test_one_comes_to_a_landmark_outside_of_every_building(map_of: Maps) -> None:
    the_map = map_of('downtown')
    moved = 0
    for mark in the_map.landmarks:
        x, y = approach_point(the_map, mark.name)
        point = shapely.Point(x, y)
        assert not any(shapely.Polygon(b.ring).contains(point) for b in the_map.buildings)
        moved += (x, y) != (mark.x_m, mark.y_m)
        assert sqrt((x - mark.x_m) ** 2 + (y - mark.y_m) ** 2) < 150.0
    assert moved > 0
    with pytest.raises(MapError, match='Nowhere'):
        approach_point(the_map, 'Nowhere')


def test_the_flight_and_the_world_mean_the_same_place(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Maps,
) -> None:
    spec = read_prompt('A drone hovers 40 m above the intersection for 20 seconds.')
    found = ground(spec)
    point = found.uavs[0].missions[0].hover_point
    assert point is not None
    places = place_positions(spec, map_of('downtown'), found)
    assert places == {'intersection': (point[0], point[1])}


def test_a_park_is_flown_over_at_its_middle_and_come_to_on_the_street_that_leads_there(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Maps,
) -> None:
    park = map_of('downtown').landmark('Meadow Park')
    spec = read_prompt('A drone hovers over the Meadow Park at 90 m for 20 seconds.')
    assert ground(spec).uavs[0].missions[0].hover_point == (park.x_m, park.y_m, 90.0)
    parked = ground(read_prompt('A bus is parked at Meadow Park.')).agents[0]
    x, y = approach_point(map_of('downtown'), 'Meadow Park')
    assert hypot(parked.x_m - x, parked.y_m - y) < 20.0
    assert hypot(x - park.x_m, y - park.y_m) > 100.0


@pytest.mark.parametrize('doing', ['hovers over', 'orbits'])
def test_a_flight_is_over_the_building_that_a_landmark_is(
    doing: str,
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Maps,
) -> None:
    plan = ground(read_prompt(f'A drone {doing} the City Hall.')).uavs[0].missions[0]
    hall = map_of('downtown').landmark('City Hall')
    if plan.hover_point is not None:
        assert plan.hover_point[:2] == pytest.approx((hall.x_m, hall.y_m), abs=0.1)
    for x, y, _ in plan.waypoints:
        assert sqrt((x - hall.x_m) ** 2 + (y - hall.y_m) ** 2) == pytest.approx(30.0, abs=0.1)
    # Towers of 71 m stand round it: an altitude that nobody states is where the air is free.
    assert plan.altitude_m > 30.0 or plan.hover_point is not None


@pytest.mark.parametrize(
    ('place', 'prompt', 'east_m', 'north_m'),
    [
        ('City Hall', 'A drone hovers 40 m east of City Hall at 40 m.', 40.0, 0.0),
        ('Mercy Hospital', 'A drone hovers 50 m north of Mercy Hospital at 45 m.', 0.0, 50.0),
        ('Eastgate Stadium', 'A drone hovers over Eastgate Stadium.', 0.0, 0.0),
    ],
)
def test_an_offset_is_from_the_landmark_not_from_the_street_before_it(
    place: str,
    prompt: str,
    east_m: float,
    north_m: float,
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Maps,
) -> None:
    point = ground(read_prompt(prompt)).uavs[0].missions[0].hover_point
    mark = map_of('downtown').landmark(place)
    assert point is not None
    assert point[:2] == pytest.approx((mark.x_m + east_m, mark.y_m + north_m), abs=0.1)


def test_the_road_is_looked_at_where_no_vehicle_stands(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    map_of: Maps,
) -> None:
    spec = read_prompt(
        'A bus waits on the main road. A drone hovers over the main road at 50 m for 20 seconds.'
    )
    found = ground(spec)
    x, y = place_positions(spec, map_of('downtown'), found)['main_road']
    [bus] = found.agents
    # In steps of 5 m along its route: the first one that is not less than 12 m away.
    assert 12.0 <= sqrt((x - bus.x_m) ** 2 + (y - bus.y_m) ** 2) <= 17.0
    point = found.uavs[0].missions[0].hover_point
    assert point is not None
    assert sqrt((x - point[0]) ** 2 + (y - point[1]) ** 2) < 1.0


def test_a_free_road_is_looked_at_where_the_scenario_is() -> None:
    way = [(0.0, 0.0), (5.0, 0.0), (10.0, 0.0), (15.0, 0.0)]
    assert road_point(way, [(0.0, 12.0)]) == (0.0, 0.0)
    assert road_point(way, [(0.0, 3.0)]) == (15.0, 0.0)
    assert road_point(way, [(0.0, 0.0), (15.0, 0.0)]) == (15.0, 0.0)
