# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes whose bodies stand at, beside or before places: each where the request says."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from math import dist
from typing import Any

import numpy as np
import pytest

from aurora_core.conditions.capabilities import unsupported
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

CITY_HALL = 'landmark:City Hall'
Placed = Mapping[str, Sequence[Mapping[str, Any]]]


class Scenes:
    """Grounds requests on the downtown map, with placements as a model may state them."""

    def __init__(self, read: Callable[..., ScenarioSpec], ground: Callable[..., Any]) -> None:
        self._read = read
        self._ground = ground

    def spec(self, prompt: str, placed: Placed) -> ScenarioSpec:
        spec = self._read(prompt, 'downtown')
        agents = [
            a.model_dump() | ({'placements': placed[a.id]} if a.id in placed else {})
            for a in spec.agents
        ]
        return ScenarioSpec.model_validate({**spec.model_dump(), 'agents': agents})

    def failure(self, prompt: str, placed: Placed) -> GroundingFailure:
        found = self._ground(self.spec(prompt, placed), 'downtown')
        assert isinstance(found, GroundingFailure), found
        return found

    def grounded(self, spec: ScenarioSpec) -> GroundedScenario:
        found = self._ground(spec, 'downtown')
        assert isinstance(found, GroundedScenario), found
        assert unsupported(spec, found) == ()
        return found

    def agents(self, prompt: str, placed: Placed) -> dict[str, GroundedAgent]:
        found = self.grounded(self.spec(prompt, placed))
        return {agent.id: agent for agent in found.agents}


@pytest.fixture
def scenes(read_prompt: Callable[..., ScenarioSpec], ground: Callable[..., Any]) -> Scenes:
    return Scenes(read_prompt, ground)


def xy(agent: GroundedAgent) -> tuple[float, float]:
    return agent.x_m, agent.y_m


@pytest.mark.parametrize(
    'prompt', ['A van waits. A drone hovers at 40 m.', 'A pedestrian waits while a bus drives.']
)
def test_who_is_beside_a_landmark_is_at_it(
    scenes: Scenes, map_of: Callable[[str], MapModel], tolerances: Tolerances, prompt: str
) -> None:
    who = 'van1' if 'van' in prompt else 'pedestrian1'
    found = scenes.agents(prompt, {who: [{'relation': 'beside', 'of': CITY_HALL}]})
    street = MapPlaces(map_of('downtown')).point(CITY_HALL, (0.0, 0.0))
    assert dist(xy(found[who]), street) <= tolerances.arrival_m


def test_two_that_are_longer_than_their_distance_get_room_inside_its_tolerance(
    scenes: Scenes, tolerances: Tolerances
) -> None:
    prompt = 'A bus waits at the crosswalk. A car waits 8 m behind the bus. A drone hovers.'
    found = scenes.agents(prompt, {})
    bus, car = found['bus1'], found['car1']
    apart_m = dist(xy(bus), xy(car))
    assert apart_m >= (bus.length_m + car.length_m) / 2.0
    assert apart_m <= 8.0 + tolerances.placement_vehicle_m.of(8.0)


def test_of_two_that_would_stand_in_each_other_the_distance_that_fits_is_told(
    scenes: Scenes,
) -> None:
    failure = scenes.failure('A bus waits. A car waits 7 m behind the bus. A drone hovers.', {})
    assert failure.words == (
        'bus1 (bus, 12 m long) and car1 (car, 4.6 m) would stand in each other at 7 m from '
        'middle to middle; 8.6 m would fit'
    )


def test_who_is_parked_is_passed_in_one_lane_where_the_place_has_no_other(
    scenes: Scenes, map_of: Callable[[str], MapModel]
) -> None:
    network = map_of('downtown').network

    def lanes_beside(placed: Placed) -> int:
        bus = scenes.agents(
            'A bus is parked. A car overtakes the bus. A drone tracks the car.', placed
        )['bus1']
        assert bus.parked
        edge = network.edge(network.lane(bus.lane_id).edge_id)
        return sum('passenger' in network.lane(name).allows for name in edge.lane_ids)

    assert lanes_beside({'bus1': [{'relation': 'parked_at', 'of': CITY_HALL}]}) == 1
    assert lanes_beside({}) > 1


def test_a_stated_speed_is_kept_where_the_way_comes_to_a_slower_street(
    scenes: Scenes, map_of: Callable[[str], MapModel]
) -> None:
    at_hall = {'truck1': [{'relation': 'near', 'of': CITY_HALL}]}
    prompt = 'A truck drives at {} m/s. A drone tracks the truck at 50 m for 90 seconds.'
    truck = scenes.agents(prompt.format('13.5'), at_hall)['truck1']
    network = map_of('downtown').network
    limits = [
        network.lane(lane).speed_limit_mps
        for edge in truck.edges
        for lane in network.edge(edge).lane_ids
        if 'truck' in network.lane(lane).allows
    ]
    assert network.lane(truck.lane_id).speed_limit_mps > 13.5 > min(limits)
    assert truck.speed_factor * min(limits) >= 13.5
    at_most = scenes.agents(prompt.format('at most 13.5'), at_hall)['truck1']
    assert at_most.speed_factor * min(limits) < 13.5


def test_who_begins_on_a_slow_street_with_a_fast_speed_is_at_its_place(
    scenes: Scenes, map_of: Callable[[str], MapModel], tolerances: Tolerances
) -> None:
    station = 'landmark:Foundry Fire Station'
    found = scenes.agents(
        'A truck waits near Harbor Market. A fire truck drives at 16.7 m/s. A drone hovers over '
        'Harbor Market.',
        {'firetruck1': [{'relation': 'at', 'of': station}]},
    )
    fire = found['firetruck1']
    assert map_of('downtown').network.lane(fire.lane_id).speed_limit_mps < 16.7
    street = MapPlaces(map_of('downtown')).point(station, (0.0, 0.0))
    assert dist(xy(fire), street) <= tolerances.arrival_m


def metres(value: float) -> dict[str, Any]:
    span = {'start': 0, 'end': 1}
    known = {'value': value, 'unit': 'm', 'low': value, 'high': value}
    return {**known, 'provenance': 'explicit', 'span': span}


def test_two_before_one_crosswalk_stand_as_far_before_it_as_each_is_to(
    scenes: Scenes, map_of: Callable[[str], MapModel]
) -> None:
    before = {'relation': 'before', 'of': 'crosswalk'}
    found = scenes.agents(
        'A pedestrian crosses at the crosswalk. A van is parked. The ego car drives 40 km/h. A '
        'drone hovers over the crosswalk at 15 m.',
        {
            'van1': [{**before, 'distance_m': metres(6.0)}],
            'ego': [{**before, 'distance_m': metres(30.0)}],
        },
    )
    ego, van = found['ego'], found['van1']
    crosswalks = MapPlaces(map_of('downtown')).crosswalks
    middle = min(crosswalks, key=lambda point: dist(point, xy(van)))
    along_m = {
        agent.id: (middle[0] - agent.x_m) * agent.heading_x
        + (middle[1] - agent.y_m) * agent.heading_y
        for agent in (ego, van)
    }
    assert along_m == pytest.approx({'ego': 30.0, 'van1': 6.0}, abs=0.5)
    # The parked one is in nobody's way: the ego comes in with its speed.
    assert ego.speed_mps == pytest.approx(11.11, abs=0.01)


def test_who_is_at_the_intersection_is_ahead_of_who_stands_before_it(scenes: Scenes) -> None:
    before = {'relation': 'before', 'of': 'intersection', 'distance_m': metres(80.0)}
    found = scenes.agents(
        'A fire truck waits. The ego car drives. A drone hovers over the fire truck at 35 m.',
        {'firetruck1': [{'relation': 'at', 'of': 'intersection'}], 'ego': [before]},
    )
    ego, fire = found['ego'], found['firetruck1']
    assert (ego.heading_x, ego.heading_y) == pytest.approx((fire.heading_x, fire.heading_y))
    assert 60.0 < dist(xy(ego), xy(fire)) < 75.0


def test_a_bicycle_beside_a_vehicle_rides_in_its_own_lane_where_the_street_has_one(
    scenes: Scenes, map_of: Callable[[str], MapModel]
) -> None:
    station = 'landmark:Union Station'
    found = scenes.agents(
        'A van waits near Union Station. A truck drives 30 m ahead of the van. A bicycle is '
        'beside the truck. A drone hovers over Union Station at 100 m.',
        {},
    )
    truck, bicycle = found['truck1'], found['bicycle1']
    lane = map_of('downtown').network.lane(bicycle.lane_id)
    assert lane.allows == {'bicycle'}
    dx, dy = bicycle.x_m - truck.x_m, bicycle.y_m - truck.y_m
    right_m = dx * truck.heading_y - dy * truck.heading_x
    assert dx * truck.heading_x + dy * truck.heading_y == pytest.approx(0.0, abs=0.5)
    assert (truck.width_m + bicycle.width_m) / 2.0 < right_m < 4.0
    street = MapPlaces(map_of('downtown')).point(station, (0.0, 0.0))
    assert dist(xy(found['van1']), street) <= 50.0


def test_two_abreast_find_room_where_one_of_their_lanes_turns_off_later(
    scenes: Scenes, map_of: Callable[[str], MapModel], tolerances: Tolerances
) -> None:
    market = {'ego': [{'relation': 'at', 'of': 'landmark:Harbor Market'}]}
    prompt = 'The ego car drives. A van drives in the lane to the left of the ego car.'
    found = scenes.agents(prompt, market)
    ego, van = found['ego'], found['van1']
    assert map_of('downtown').network.lane(ego.lane_id).left_lane_id == van.lane_id
    street = MapPlaces(map_of('downtown')).point('landmark:Harbor Market', (0.0, 0.0))
    assert dist(xy(ego), street) <= tolerances.arrival_m


def test_who_crosses_where_no_crosswalk_is_goes_straight_over_the_street(scenes: Scenes) -> None:
    prompt = (
        'A bus waits at Union Station. A pedestrian crosses {} 10 m in front of the bus. A drone '
        'hovers over Union Station at 60 m.'
    )
    found = scenes.agents(prompt.format('the street'), {})
    bus, person = found['bus1'], found['pedestrian1']
    way = np.array(person.way_xy_m)
    dx, dy = (way - [bus.x_m, bus.y_m]).T
    # From one side of the bus's way to the other, 10 m before it.
    along_m = dx * bus.heading_x + dy * bus.heading_y
    left_m = dy * bus.heading_x - dx * bus.heading_y
    assert along_m == pytest.approx([10.0] * len(way), abs=1.0)
    assert left_m[0] * left_m[-1] < 0.0
    # Who is to use a crosswalk needs one.
    failure = scenes.failure(prompt.format('at the crosswalk'), {})
    assert 'no crosswalk' in failure.words


@pytest.mark.parametrize(
    ('prompt', 'reason', 'told'),
    [
        (
            'A motorcycle overtakes a bus. A drone hovers over Union Station at 60 m.',
            'road',
            'would need a second lane',
        ),
        (
            'A van is parked near Ridge School. A pedestrian walks beside the van. A drone hovers '
            'over the van at 40 m.',
            'blocked',
            'a parked vehicle takes the sidewalk',
        ),
    ],
)
def test_what_has_no_place_is_told_with_what_would_fit(
    scenes: Scenes, prompt: str, reason: str, told: str
) -> None:
    near = [{'relation': 'near', 'of': 'landmark:Union Station'}]
    failure = scenes.failure(prompt, {} if reason == 'blocked' else {'motorcycle1': near})
    assert failure.reason == reason
    assert told in failure.words


def test_who_is_left_of_a_parked_vehicle_is_on_its_left_or_nowhere(scenes: Scenes) -> None:
    prompt = 'A van is parked 40 m ahead of the ego car. A pedestrian waits. A drone hovers.'
    left = {'relation': 'left', 'of': 'van1'}
    found = scenes.agents(prompt, {'pedestrian1': [left]})
    van, person = found['van1'], found['pedestrian1']
    dx, dy = person.x_m - van.x_m, person.y_m - van.y_m
    assert dy * van.heading_x - dx * van.heading_y > van.width_m / 2.0
    # In the middle of the street nobody waits.
    failure = scenes.failure(prompt, {'pedestrian1': [{**left, 'distance_m': metres(5.0)}]})
    assert failure.reason == 'sidewalk'


def test_who_crosses_where_no_crosswalk_is_stays_in_sight_of_who_tells_of_it(
    scenes: Scenes, map_of: Callable[[str], MapModel], limits: Limits
) -> None:
    spec = scenes.spec(
        'It is raining at dusk. An ambulance drives at 40 km/h. At 15 s a pedestrian crosses. A '
        'drone hovers over City Hall at 60 m. When it sees the pedestrian the drone messages the '
        'ambulance. When it gets the message the ambulance brakes.',
        {},
    )
    found = scenes.grounded(spec)
    (person,) = (a for a in found.agents if a.is_person)
    assert len(person.way_xy_m) > 1
    hover = found.uavs[0].missions[0].hover_point
    model = map_of('downtown')
    air = Airspace(model.buildings, model.zones)
    ends = np.array([(*point, person.height_m / 2.0) for point in person.way_xy_m])
    range_m = limits.sensing_range('rain', 'dusk')
    assert air.seen(np.array([hover] * len(ends)), ends, range_m).all()


def test_one_before_the_intersection_and_another_at_the_crosswalk_are_on_roads_of_their_own(
    scenes: Scenes, map_of: Callable[[str], MapModel]
) -> None:
    before = {'relation': 'before', 'of': 'intersection', 'distance_m': metres(50.0)}
    found = scenes.agents(
        'A police car waits at the crosswalk. A fire truck drives 12 m ahead of the police car. '
        'A bus drives. A drone tracks the bus at 50 m.',
        {'bus1': [before]},
    )
    bus, police = found['bus1'], found['police1']
    middle = MapPlaces(map_of('downtown')).point('intersection', xy(police))
    along_m = (middle[0] - bus.x_m) * bus.heading_x + (middle[1] - bus.y_m) * bus.heading_y
    assert along_m == pytest.approx(50.0, abs=1.0)


def test_a_person_near_a_vehicle_is_as_near_as_is_said(
    scenes: Scenes, tolerances: Tolerances
) -> None:
    near = {'relation': 'near', 'of': 'ego', 'distance_m': metres(10.0)}
    found = scenes.agents(
        'The ego car waits at the crosswalk. A pedestrian waits. A drone hovers at 30 m.',
        {'pedestrian1': [near]},
    )
    away_m = dist(xy(found['ego']), xy(found['pedestrian1']))
    assert away_m == pytest.approx(10.0, abs=tolerances.placement_other_m.of(10.0))
