# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is told something is in reach when that is sent, and can do then what it is to do."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest

from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.places import MapPlaces
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import ScenarioSpec

Agents = Callable[[str], dict[str, GroundedAgent]]
Maps = Callable[[str], MapModel]

TRACKING = 'My car drives. A drone tracks a motorcycle. When it sees the motorcycle, it alerts my '


@pytest.mark.parametrize(
    'prompt',
    [
        'A bus drives. A drone hovers over Mercy Hospital at 50 m. When it sees the bus, the '
        'drone sends a message to a roadside unit.',
        'A drone tracks a car. When the car arrives at Mercy Hospital, the drone sends a message '
        'to a roadside unit.',
    ],
)
def test_a_roadside_unit_is_where_it_hears_what_it_is_told(
    prompt: str, agents: Agents, map_of: Maps
) -> None:
    unit = agents(prompt)['rsu1']
    hospital = MapPlaces(map_of('downtown')).itself('landmark:Mercy Hospital', (0.0, 0.0))
    assert dist((unit.x_m, unit.y_m), hospital) < 100.0


def test_a_roadside_unit_stays_where_it_is_said_to_be(agents: Agents, map_of: Maps) -> None:
    unit = agents(
        'A roadside unit is at City Hall. A drone hovers over Mercy Hospital at 50 m. At 20 s the '
        'drone sends a message to the roadside unit.'
    )['rsu1']
    hall = MapPlaces(map_of('downtown')).itself('landmark:City Hall', (0.0, 0.0))
    assert dist((unit.x_m, unit.y_m), hall) < 100.0


@pytest.mark.parametrize('place', ['Union Station', 'Mercy Hospital'])
@pytest.mark.parametrize('who', ['pedestrian', 'car'])
def test_whom_a_drone_over_a_landmark_tells_something_is_near_it(
    agents: Agents, map_of: Maps, limits: Limits, who: str, place: str
) -> None:
    does = 'walks' if who == 'pedestrian' else 'drives'
    found = agents(
        f'A {who} {does}. A drone hovers over {place} at 60 m for 40 s. At 16 s the drone sends a '
        f'message to the {who}.'
    )
    told = found[f'{who}1']
    there = MapPlaces(map_of('downtown')).itself(f'landmark:{place}', (0.0, 0.0))
    assert dist((told.x_m, told.y_m), there) < limits.link_range_blocked_m


def test_who_slows_down_at_the_first_sight_is_on_the_move_by_then(agents: Agents) -> None:
    found = agents(f'{TRACKING}car. When my car gets the message, it slows down.')
    assert found['ego'].release is ReleaseOn.START
    assert found['motorcycle1'].release is ReleaseOn.CAPTURED


def test_who_stops_at_the_first_sight_of_a_drone_over_a_place_is_on_the_move(
    agents: Agents,
) -> None:
    found = agents(
        'A drone hovers over the intersection at 40 m. An ambulance drives. My car drives. When '
        'the drone sees the ambulance, it sends a message to my car. When my car gets the '
        'message, it stops.'
    )
    assert found['ego'].release is ReleaseOn.START
    assert found['ambulance1'].release is ReleaseOn.CAPTURED


def test_who_speeds_up_then_waits_with_the_others(agents: Agents) -> None:
    found = agents(f'{TRACKING}car. When my car gets the message, it accelerates.')
    assert found['ego'].release is ReleaseOn.CAPTURED


def test_who_hears_of_the_end_of_a_route_does_not_leave_before_it(agents: Agents) -> None:
    found = agents(
        'My car drives. A drone flies a line of 100 m at 60 m. When the drone has finished, it '
        'sends my car a message. When my car gets the message, it brakes.'
    )
    assert (found['ego'].release, found['ego'].release_uav) == (ReleaseOn.CAPTURED, 'uav1')


def test_who_ends_a_route_by_its_arrival_waits_until_that_has_shown(agents: Agents) -> None:
    found = agents(
        'A car drives. A drone patrols a 100 m by 60 m rectangle at 40 m. When the car arrives at '
        'the crosswalk, the drone tracks the car.'
    )
    assert found['car1'].release is ReleaseOn.LAPPED


def test_a_uav_is_there_before_what_changes_its_flight(agents: Agents) -> None:
    found = agents(
        'A pedestrian walks on the sidewalk. A drone tracks the pedestrian. When my car comes '
        'within 20 m of the pedestrian, the drone lands.'
    )
    assert (found['ego'].release, found['ego'].release_uav) == (ReleaseOn.CAPTURED, 'uav1')


def test_whom_a_uav_hovers_over_and_then_follows_sets_off_with_that(agents: Agents) -> None:
    found = agents('A drone hovers over my car at 30 m for 20 s and then follows it for 30 s.')
    assert found['ego'].release is ReleaseOn.CAPTURED


def test_whom_a_uav_reports_is_on_its_street(agents: Agents) -> None:
    found = agents(
        'My car drives. A drone hovers over the intersection at 40 m. When a van exceeds 7 m/s, '
        'the drone alerts my car.'
    )
    van, ego = found['van1'], found['ego']
    assert dist((van.x_m, van.y_m), (ego.x_m, ego.y_m)) < 100.0
    assert van.release is ReleaseOn.CAPTURED


@pytest.mark.parametrize('place', ['the crosswalk', 'the intersection', 'Ridge School'])
def test_who_is_to_arrive_on_foot_walks_there_from_a_little_way_off(
    place: str, agents: Agents, map_of: Maps
) -> None:
    found = agents(
        f'My car drives. A drone hovers over {place} at 40 m. When a pedestrian arrives at '
        f'{place}, the drone alerts my car.'
    )
    walker = found['pedestrian1']
    assert walker.arrival_position_m is not None  # it goes
    name = place.removeprefix('the ')
    known = f'landmark:{name}' if name == 'Ridge School' else name
    here = (walker.x_m, walker.y_m)
    point = MapPlaces(map_of('downtown')).point(known, here)
    assert dist(here, point) > 15.0
    line = Polyline(walker.route_xy_m)
    assert dist(line.at(line.project(*point)[0])[:2], point) < dist(here, point) - 5.0


def test_a_roadside_unit_is_where_a_uav_hears_it(agents: Agents, map_of: Maps) -> None:
    unit = agents(
        'A drone hovers above City Hall at 50 m. 20 s after the start a roadside unit sends a '
        'message to the drone.'
    )['rsu1']
    hall = MapPlaces(map_of('downtown')).itself('landmark:City Hall', (0.0, 0.0))
    assert dist((unit.x_m, unit.y_m), hall) < 100.0


def test_who_circulates_stays_in_reach_of_who_tells_it_something(
    read_prompt: Callable[..., ScenarioSpec],
    ground: Callable[..., GroundedScenario],
    limits: Limits,
) -> None:
    prompt = (
        'A truck is parked at the roadside. A van circulates. A drone hovers over the crosswalk '
        'at 30 m. At 20 s the drone sends a message to the van.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    hover_point = found.uavs[0].missions[0].hover_point
    assert hover_point is not None
    (van,) = (agent for agent in found.agents if agent.id == 'van1')
    way = Polyline(van.route_xy_m)
    for along_m in range(0, 200, 20):  # it drives 20 s until then
        assert dist(way.at(float(along_m))[:2], hover_point[:2]) < limits.link_range_blocked_m


def test_who_waits_for_an_event_stands_in_nobodys_way(agents: Agents) -> None:
    found = agents(
        'A police car is at Assembly Police Station. A drone tracks a motorcycle at 45 m. When '
        'the motorcycle is faster than 15 m/s, the police car starts.'
    )
    police, rider = found['police1'], found['motorcycle1']
    assert police.release is ReleaseOn.EVENT
    ahead = Polyline(rider.route_xy_m).project(police.x_m, police.y_m)
    assert dist((police.x_m, police.y_m), (rider.x_m, rider.y_m)) > 5.0
    assert ahead[0] == 0.0 or abs(ahead[1]) > 3.0


def test_who_is_to_come_near_a_crossing_drives_straight_to_it(
    agents: Agents, map_of: Maps
) -> None:
    bus = agents(
        'A drone hovers over the intersection at 45 m for 70 s. When a bus comes within 60 m of '
        'the intersection, the drone sends a message to my car.'
    )['bus1']
    way, near = Polyline(bus.route_xy_m), False
    place = MapPlaces(map_of('downtown')).itself('intersection', (bus.x_m, bus.y_m))
    for along_m in range(60, 260, 5):
        near = near or dist(way.at(float(along_m))[:2], place) < 60.0
    assert near


def test_who_sets_off_after_a_hover_is_seen_from_it(agents: Agents) -> None:
    engine = agents(
        'A fire engine is at Foundry Fire Station. A drone hovers over the fire engine at 50 m '
        'for 25 s. When the drone has finished its mission, the fire engine starts.'
    )['firetruck1']
    assert engine.release is ReleaseOn.EVENT


def test_who_is_told_once_it_has_got_far_is_not_held(agents: Agents, map_of: Maps) -> None:
    van = agents(
        'A drone hovers over Ridge School at 60 m. When a van is more than 180 m away from the '
        'drone, the drone sends a message to the van.'
    )['van1']
    school = MapPlaces(map_of('downtown')).itself('landmark:Ridge School', (0.0, 0.0))
    assert van.release is ReleaseOn.CAPTURED
    assert dist((van.x_m, van.y_m), school) < 170.0
    way = Polyline(van.route_xy_m)
    assert any(dist(way.at(float(m))[:2], school) > 170.0 for m in range(0, 600, 10))


def test_a_driver_who_is_to_see_somebody_drives_up_to_that_one(agents: Agents) -> None:
    found = agents(
        'A van is parked at the roadside. A pedestrian stands ahead of the van. My car drives at '
        '30 km/h. When my car sees the pedestrian, it brakes.'
    )
    ego, van = found['ego'], found['van1']
    arc_m, _ = Polyline(ego.route_xy_m).project(van.x_m, van.y_m)
    assert arc_m > 30.0
