# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Vehicles stand at, come to and stop at the places that a request names."""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, degrees, dist, hypot

import pytest
import shapely

from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]
First = Callable[[str, str], tuple[GroundedAgent, tuple[float, float], MapModel]]

ARRIVAL_M = 15.0


@pytest.fixture
def first(read_prompt: Read, ground: Ground, map_of: Maps) -> First:
    """The first vehicle of a prompt, the point of a place there, and the map."""

    def of(prompt: str, place: str) -> tuple[GroundedAgent, tuple[float, float], MapModel]:
        found = ground(read_prompt(prompt, 'downtown'), 'downtown')
        assert isinstance(found, GroundedScenario), found
        the_map = map_of('downtown')
        at = the_map.network.position_on_lane(found.anchor_lane, found.anchor_position_m)
        return found.agents[0], MapPlaces(the_map).point(place, at[:2]), the_map

    return of


@pytest.mark.parametrize(
    ('prompt', 'place', 'within_m'),
    [
        ('A car stands near Union Station.', 'landmark:Union Station', 50.0),
        ('A truck is waiting at the intersection.', 'intersection', ARRIVAL_M),
    ],
)
def test_who_stands_at_a_place_is_there(
    first: First, prompt: str, place: str, within_m: float
) -> None:
    agent, point, _ = first(prompt, place)
    assert dist((agent.x_m, agent.y_m), point) <= within_m


@pytest.mark.parametrize(
    ('words', 'nearest_m', 'farthest_m', 'bearing_deg'),
    [
        ('70 m from', 68.6, 71.4, None),
        ('120 m from', 117.6, 122.4, None),
        ('at most 75 m from', 0.0, 75.0, None),
        ('105 m west of', 102.9, 107.1, 270.0),
    ],
)
def test_a_stated_distance_is_from_where_the_landmark_stands(
    first: First, words: str, nearest_m: float, farthest_m: float, bearing_deg: float | None
) -> None:
    agent, _, the_map = first(f'A car stands {words} City Hall.', 'landmark:City Hall')
    hall = the_map.landmark('City Hall')
    east_m, north_m = agent.x_m - hall.x_m, agent.y_m - hall.y_m
    assert nearest_m <= hypot(east_m, north_m) <= farthest_m
    if bearing_deg is not None:
        off_deg = degrees(atan2(east_m, north_m)) - bearing_deg
        assert abs((off_deg + 180.0) % 360.0 - 180.0) <= 15.0


def test_no_car_stands_nearer_to_a_landmark_than_a_street_is(
    read_prompt: Read, ground: Ground
) -> None:
    # The street is 57 m from the hall, the point before it 0 m from the street.
    found = ground(read_prompt('A car stands 15 m from City Hall.', 'downtown'), 'downtown')
    assert isinstance(found, GroundingFailure)


@pytest.mark.parametrize(
    ('prompt', 'place'),
    [
        ('A bus stops at Union Station.', 'landmark:Union Station'),
        ('A bus stops at the intersection.', 'intersection'),
        ('A car stops at the crosswalk.', 'crosswalk'),
    ],
)
def test_who_stops_at_a_place_stops_on_the_way_there(
    first: First, prompt: str, place: str
) -> None:
    agent, point, the_map = first(prompt, place)
    lane = the_map.network.lane(agent.stop_lane_id)
    assert not lane.is_internal
    x, y, _, _ = the_map.network.position_on_lane(agent.stop_lane_id, agent.stop_position_m)
    assert dist((x, y), point) <= ARRIVAL_M + agent.length_m / 2.0
    # Not on top of the place: whoever looks at it could not see it.
    assert dist((x, y), point) > agent.length_m / 2.0
    assert dist((agent.x_m, agent.y_m), (x, y)) > 20.0


def test_a_way_leads_past_the_place_that_it_is_to_come_to(first: First) -> None:
    prompt = 'A drone tracks a firetruck, which drives to Mercy Hospital.'
    agent, point, _ = first(prompt, 'landmark:Mercy Hospital')
    assert shapely.LineString(agent.route_xy_m).distance(shapely.Point(point)) <= ARRIVAL_M
    assert agent.stop_lane_id == ''


def test_who_stops_anywhere_has_driven(first: First) -> None:
    agent, _, the_map = first('A car drives and stops.', 'main_road')
    x, y, _, _ = the_map.network.position_on_lane(agent.stop_lane_id, agent.stop_position_m)
    assert dist((agent.x_m, agent.y_m), (x, y)) > 20.0


def test_who_stands_elsewhere_has_a_road_of_its_own(
    read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    prompt = 'A bus is parked at Eastgate Stadium. A truck is parked at Harbor Market.'
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    assert isinstance(found, GroundedScenario), found
    places = MapPlaces(map_of('downtown'))
    for agent, landmark in zip(found.agents, ('Eastgate Stadium', 'Harbor Market'), strict=True):
        point = places.point(f'landmark:{landmark}', (0.0, 0.0))
        assert dist((agent.x_m, agent.y_m), point) <= ARRIVAL_M
