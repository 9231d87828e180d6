# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes that leave open what would make them impossible: who waits, who makes room."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from math import inf

import numpy as np
import pytest
import shapely

from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.places import place_positions
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]


@pytest.fixture
def grounded(read_prompt: Read, ground: Ground) -> Callable[[str], GroundedScenario]:
    return lambda prompt: ground(read_prompt(prompt, 'downtown'), 'downtown')


def test_drones_over_one_point_at_one_height_hover_beside_each_other(
    grounded: Callable[[str], GroundedScenario], limits: Limits
) -> None:
    found = grounded('Three drones hover over City Hall at 50 m.')
    points = [np.array(uav.missions[0].hover_point) for uav in found.uavs]
    assert [point[2] for point in points] == [50.0, 50.0, 50.0]
    apart = [float(np.linalg.norm(a - b)) for a, b in combinations(points, 2)]
    assert min(apart) >= 2.0 * limits.separation_min_m - 1e-6
    assert max(apart) <= 4.0 * limits.separation_min_m


def test_who_climbs_past_another_one_hovers_beside_it(
    grounded: Callable[[str], GroundedScenario], limits: Limits
) -> None:
    over = 'Drone 1 hovers over City Hall at 60 m. Drone 2 hovers over City Hall at 40 m.'
    apart = []
    for more in ('', ' After 20 s drone 2 climbs to 80 m.'):
        first, second = (np.array(u.missions[0].hover_point) for u in grounded(over + more).uavs)
        apart.append(float(np.linalg.norm((first - second)[:2])))
    assert apart[0] == 0.0
    assert apart[1] >= 2.0 * limits.separation_min_m - 1e-6


@pytest.mark.parametrize('where', ['', ' from 35 m'])
def test_drones_that_track_one_target_at_one_height_keep_apart(
    grounded: Callable[[str], GroundedScenario], limits: Limits, where: str
) -> None:
    found = grounded(f'Two drones track a bus{where} at 40 m altitude.')
    a, b = (np.array(uav.missions[0].offset_m) for uav in found.uavs)
    assert float(np.linalg.norm(a - b)) >= 1.5 * limits.separation_min_m
    asked = 35.0 if where else 0.0
    off = [abs(float(np.linalg.norm(offset)) - asked) for offset in (a, b)]
    assert max(off) <= limits.tracking_horizontal_m / 2.0


def test_who_is_tracked_second_waits_for_that_mission(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    found = grounded('A drone hovers and then tracks a bus from 60 m.')
    (bus,) = found.agents
    assert (bus.release, bus.release_mission) == (ReleaseOn.CAPTURED, 'm2')


def test_who_ends_a_patrol_by_arriving_waits_for_its_first_lap(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    around = 'A drone orbits Harbor Market with a 70 m radius at 50 m'
    (bus,) = grounded(f'{around}; when a bus arrives at Union Station the drone lands.').agents
    assert (bus.release, bus.release_mission) == (ReleaseOn.LAPPED, 'm1')
    over = 'A drone hovers over Harbor Market at 50 m'
    (bus,) = grounded(f'{over}; when a bus arrives at Union Station the drone lands.').agents
    assert bus.release is not ReleaseOn.LAPPED


@pytest.mark.parametrize('drift_m', [1.5, 5.0])
def test_a_hover_begins_no_farther_away_than_it_may_drift(
    grounded: Callable[[str], GroundedScenario], drift_m: float
) -> None:
    over = 'A drone hovers over City Hall at 50 m.'
    default_m = grounded(over).uavs[0].missions[0].capture_horizontal_m
    found = grounded(f'{over} The hover drift stays at most {drift_m} m.')
    assert found.uavs[0].missions[0].capture_horizontal_m == min(drift_m, default_m)


def test_streets_on_the_way_allow_a_stated_speed(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    network = map_of('downtown').network
    for car in grounded('Three cars drive 50 km/h.').agents:
        limits_mps = [
            max(network.lane(name).speed_limit_mps for name in network.edge(edge).lane_ids)
            for edge in car.edges
        ]
        assert limits_mps[0] >= 13.8
        assert sum(limit >= 13.8 for limit in limits_mps) >= 0.6 * len(limits_mps)


def test_a_stated_speed_stays_when_somebody_is_to_come_up_from_behind(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    warns = 'A drone hovers over the intersection at 40 m and warns the ego car when a truck comes'
    found = grounded(f'{warns} within 30 m of it. The ego car drives 12 m/s.')
    lane = map_of('downtown').network.lane
    able = {
        a.id: min(
            lane(a.lane_id).speed_limit_mps * a.speed_factor,
            inf if a.drive_speed_mps is None else a.drive_speed_mps,
        )
        for a in found.agents
    }
    assert able['ego'] == pytest.approx(12.0)
    assert able['truck1'] > able['ego']


def test_who_catches_up_has_open_road_before_it_has(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    found = grounded(
        'The ego car drives at 5 m/s. A van drives at 10 m/s, 45 m behind the ego. '
        'A drone hovers over the ego.'
    )
    ego, van = found.agents
    # It reaches its speed on 25 m, and is 20 m behind, bumper to bumper, after about 50 m more.
    way = Polyline(van.route_xy_m)
    network = map_of('downtown').network
    drawn = (lane.polyline for lane in network.driving_lanes('passenger'))
    ends = [np.array(points[k]) for points in drawn for k in (0, -1)]
    open_m = [
        s
        for s in range(25, 50)
        if min(np.hypot(*(np.array(way.at(float(s))[:2]) - end)) for end in ends) > 50.0
    ]
    assert (ego.drive_speed_mps, van.drive_speed_mps) == (5.0, 10.0)
    assert len(open_m) >= 15


def test_a_leader_drives_as_fast_as_its_follower_is_asked_to(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    found = grounded('A van follows the ego car at 8 m/s. A drone tracks the van.')
    assert {a.id: a.drive_speed_mps for a in found.agents} == {'ego': 8.0, 'van1': 8.0}


def test_a_car_on_the_main_road_has_another_lane_beside_it(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    network = map_of('downtown').network
    found = grounded('A car drives on the main road. A drone tracks it.')
    (car,) = found.agents
    edge = network.lane(car.lane_id).edge_id
    assert sum(lane.edge_id == edge for lane in network.driving_lanes('passenger')) > 1


@pytest.mark.parametrize(
    'prompt',
    [
        'A drone tracks a car. When the car drives faster than 8 m/s it changes lanes.',
        'A drone tracks a bus. After 10 s the bus changes lane.',
        'A van follows a truck. A drone tracks the van. After 15 s the truck changes lane.',
    ],
)
def test_who_is_to_change_lane_keeps_to_a_straight_street_with_several_lanes_until_then(
    prompt: str, grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    network = map_of('downtown').network
    found = grounded(prompt)
    changes = next(a for a in found.agents if a.id in ('car1', 'bus1', 'truck1'))
    assert changes.lane_change_mode == 512
    lane = network.lane(changes.lane_id)
    assert sum(other.edge_id == lane.edge_id for other in network.driving_lanes('passenger')) > 1
    ahead = Polyline(changes.route_xy_m)
    (_, _, hx, hy), (_, _, there_x, there_y) = ahead.at(0.0), ahead.at(60.0)
    assert hx * there_x + hy * there_y > 0.99


@pytest.mark.parametrize(
    ('prompt', 'place'),
    [
        ('A drone tracks a bus. After 10 s the bus changes to the left lane.', 0),
        ('A drone tracks a bus. After 10 s the bus changes to the right lane.', 1),
        ('A van follows a truck. A drone tracks the van. The truck moves into the right lane.', 1),
    ],
)
def test_who_is_to_go_to_a_side_has_a_lane_there(
    prompt: str, place: int, grounded: Callable[[str], GroundedScenario]
) -> None:
    lanes = {a.id: int(a.lane_id.rpartition('_')[2]) for a in grounded(prompt).agents}
    changes = lanes.get('bus1', lanes.get('truck1'))
    assert changes is not None
    assert changes >= place
    assert lanes.get('van1', changes) == changes, 'who follows is in the same lane'


def test_nobody_passes_who_changes_lane(grounded: Callable[[str], GroundedScenario]) -> None:
    prompt = 'A van and a truck drive in a row. A drone tracks the truck.'
    factors = [a.speed_factor for a in grounded(prompt).agents]
    assert factors[0] < factors[1]
    factors = [
        a.speed_factor for a in grounded(f'{prompt} The truck changes lanes after 15 s.').agents
    ]
    assert factors[0] == factors[1]


@pytest.mark.parametrize(
    'prompt',
    [
        'A car yields to a bus. A drone tracks the car.',
        'A drone tracks the car. When the bus is within 30 m of the car, the car yields.',
    ],
)
def test_who_is_yielded_to_comes_from_behind_in_the_lane_to_the_left(
    prompt: str, grounded: Callable[[str], GroundedScenario]
) -> None:
    found = {a.id: a for a in grounded(prompt).agents}
    car, bus = found['car1'], found['bus1']
    dx, dy = bus.x_m - car.x_m, bus.y_m - car.y_m
    assert dx * car.heading_x + dy * car.heading_y < -30.0
    assert 2.5 < dy * car.heading_x - dx * car.heading_y < 4.5


def test_who_slows_down_to_a_speed_drives_faster_before(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    found = grounded('A drone tracks a car. The car slows to 12 m/s.')
    (car,) = found.agents
    assert car.drive_speed_mps is None
    limit_mps = map_of('downtown').network.lane(car.lane_id).speed_limit_mps
    assert limit_mps * car.speed_factor >= 15.0


@pytest.mark.parametrize('distance_m', [30.0, 50.0])
def test_a_bus_stands_at_its_distance_before_the_intersection(
    distance_m: float, read_prompt: Read, ground: Ground, map_of: Callable[[str], MapModel]
) -> None:
    spec = read_prompt(f'A bus stands {distance_m:g} m before the intersection.')
    found = ground(spec)
    assert found.unsupported == ()
    [bus] = found.agents
    centre = place_positions(spec, map_of('downtown'), found)['intersection']
    along_m, aside_m = Polyline(bus.route_xy_m).project(*centre)
    assert along_m == pytest.approx(distance_m, abs=0.01)
    assert abs(aside_m) <= 8.0


@pytest.mark.parametrize('length_m', [120, 600])
def test_a_line_over_the_main_road_lies_over_a_carriageway(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel], length_m: int
) -> None:
    found = grounded(f'A drone patrols a {length_m} m line over the main road at 50 m.')
    start, end = (point[:2] for point in found.uavs[0].missions[0].waypoints)
    leg = shapely.LineString([start, end])
    surface = map_of('downtown').network.carriageway
    assert float(leg.intersection(surface).length) >= 0.8 * length_m


def test_who_overtakes_is_faster_and_has_a_second_lane(
    grounded: Callable[[str], GroundedScenario], map_of: Callable[[str], MapModel]
) -> None:
    found = grounded('A drone tracks a bus. A car behind the bus overtakes it.')
    car, bus = (next(a for a in found.agents if a.type_name == kind) for kind in ('car', 'bus'))
    assert car.speed_factor > 1.5 * bus.speed_factor
    assert car.lane_change_mode == 512, 'only when it is ordered to'
    network = map_of('downtown').network
    street = network.edge(network.lane(car.lane_id).edge_id)
    lanes = [network.lane(name) for name in street.lane_ids]
    assert len([lane for lane in lanes if 'passenger' in lane.allows]) > 1


def test_who_is_to_gain_speed_drives_slower_before(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    found = grounded('A car drives along the road. After 20 s the car accelerates to 13 m/s.')
    assert found.agents[0].drive_speed_mps == 8.0


def test_who_is_to_slow_down_first_does_not_crawl_before(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    prompt = 'A bus slows to 4 m/s at 20 s and accelerates to 9 m/s at 40 s.'
    assert (grounded(prompt).agents[0].drive_speed_mps or 99.0) > 6.0


def test_who_is_to_fall_back_is_slower_than_the_one_ahead(
    grounded: Callable[[str], GroundedScenario],
) -> None:
    found = grounded(
        'A drone tracks a van. A car drives 20 m behind the van. When the distance between the '
        'car and the van exceeds 60 m, the drone lands.'
    )
    van, car = (next(a for a in found.agents if a.type_name == kind) for kind in ('van', 'car'))
    assert car.speed_factor < 0.8 * van.speed_factor


@pytest.mark.parametrize(
    ('place', 'altitude_m'), [('City Hall', 40.0), ('Eastgate Stadium', 80.0)]
)
def test_a_hover_over_a_building_is_over_its_roof(
    grounded: Callable[[str], GroundedScenario],
    map_of: Callable[[str], MapModel],
    place: str,
    altitude_m: float,
) -> None:
    """Over a wide roof, from where the street before it is still seen."""
    found = grounded(f'A drone hovers over {place} at {altitude_m:g} m.')
    x, y, z = found.uavs[0].missions[0].hover_point or (0.0, 0.0, 0.0)
    building = next(b for b in map_of('downtown').buildings if b.name == place)
    assert building.is_below(x, y)
    assert z == altitude_m


@pytest.mark.parametrize(('side', 'sign'), [('left', 1.0), ('right', -1.0)])
def test_who_comes_from_a_side_to_a_place_is_on_another_street(
    grounded: Callable[[str], GroundedScenario], side: str, sign: float
) -> None:
    waits = 'My car waits at the intersection. '
    found = grounded(f'{waits}A truck is to the {side} of my car and approaches the intersection.')
    agents = {agent.id: agent for agent in found.agents}
    ego, truck = agents['ego'], agents['truck1']
    assert truck.edges[0] != ego.edges[0]
    x, y = truck.x_m - ego.x_m, truck.y_m - ego.y_m
    assert sign * (y * ego.heading_x - x * ego.heading_y) >= 10.0
