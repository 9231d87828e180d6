# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What an event waits for comes about: not from the start on, in reach of who reports it."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest

from aurora_core.execution.plan import plans_with_events
from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.places import MapPlaces
from aurora_core.grounding.time_need import horizon_s, patience_s
from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario, ReleaseOn
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]

PATROL = 'A drone patrols a 120 by 80 m rectangle over Harbor Market at 40 m. '


def _agent(found: GroundedScenario, agent_type: str) -> GroundedAgent:
    return next(a for a in found.agents if a.type_name == agent_type)


@pytest.mark.parametrize('within_m', [25.0, 40.0])
def test_a_person_who_is_met_is_ahead_and_not_near_yet(
    within_m: float, read_prompt: Read, ground: Ground
) -> None:
    spec = read_prompt(
        'My car drives at 8 m/s. A drone hovers 35 m above the crosswalk. When my car is within '
        f'{within_m:g} m of a pedestrian at the crosswalk, the drone alerts my car.',
        'downtown',
    )
    found = ground(spec, 'downtown')
    car, person = _agent(found, 'car'), _agent(found, 'pedestrian')
    here = (person.x_m, person.y_m)
    assert dist((car.x_m, car.y_m), here) > within_m
    line = Polyline(car.route_xy_m)
    arc_m, _ = line.project(*here, near_s=100.0, window_m=100.0)
    assert dist(line.at(arc_m)[:2], here) < within_m
    assert car.release is ReleaseOn.CAPTURED


def test_who_ends_a_route_by_coming_into_view_starts_out_of_it(
    read_prompt: Read, ground: Ground, limits: Limits
) -> None:
    prompt = (
        'A UAV patrols a 140 by 90 m rectangle at 50 m until it sees a bus. Then it follows it.'
    )
    spec = read_prompt(prompt, 'downtown')
    found = ground(spec, 'downtown')
    bus = _agent(found, 'bus')
    corners = found.uavs[0].missions[0].waypoints
    range_m = limits.sensing_range('clear', 'noon')
    assert min(dist((bus.x_m, bus.y_m, 0.0), corner) for corner in corners) > range_m
    assert bus.release is ReleaseOn.LAPPED


def test_who_is_to_be_met_on_a_route_waits_within_its_reach(
    read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    spec = read_prompt(
        PATROL + 'It tells the police car when a truck is within 60 m of the drone.', 'downtown'
    )
    found = ground(spec, 'downtown')
    truck = _agent(found, 'truck')
    assert truck.stop_lane_id
    x, y, *_ = map_of('downtown').network.position_on_lane(
        truck.stop_lane_id, truck.stop_position_m
    )
    route = Polyline([p[:2] for p in found.uavs[0].missions[0].waypoints])
    arc_m, _ = route.project(x, y)
    assert dist((*route.at(arc_m)[:2], 40.0), (x, y, 0.0)) < 60.0


def test_who_is_told_by_a_uav_at_a_place_is_in_reach_of_it(
    read_prompt: Read, ground: Ground, map_of: Maps, limits: Limits
) -> None:
    prompt = 'A drone hovers over City Hall at 70 m. When it sees a truck, it warns a police car.'
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    police = _agent(found, 'police')
    hall = MapPlaces(map_of('downtown')).itself('landmark:City Hall', (0.0, 0.0))
    assert dist((police.x_m, police.y_m), hall) < limits.link_range_sight_m


def test_a_uav_stays_up_until_it_has_reported(read_prompt: Read, ground: Ground) -> None:
    told = read_prompt(
        'A drone hovers over Union Station at 40 m. When a bus comes within 70 m of it, '
        'the drone tells an RSU.',
        'downtown',
    )
    timed = read_prompt(
        'A drone hovers over Union Station at 40 m for 20 s. When a bus comes within 70 m of it, '
        'the drone tells an RSU.',
        'downtown',
    )
    events = [e.id for e in told.events if getattr(e.action, 'do', '') == 'send_message']
    assert events
    for spec, stays in ((told, True), (timed, False)):
        (plan,) = plans_with_events(spec, ground(spec, 'downtown').uavs, ())
        assert (events[0] in plan.lands_after) is stays


def test_a_hover_lasts_until_somebody_has_got_far_enough(
    read_prompt: Read, ground: Ground
) -> None:
    far = 'is more than 180 m away from the drone, the drone sends a message to a roadside unit.'
    leaves = f'A drone hovers over Ridge School at 60 m. When a van {far}'
    stands = (
        f'A van is parked at Ridge School. A drone hovers over Ridge School. When the van {far}'
    )
    for prompt, stays in ((leaves, True), (stands, False)):
        spec = read_prompt(prompt, 'downtown')
        (plan,) = plans_with_events(spec, ground(spec, 'downtown').uavs, ())
        assert bool(plan.lands_after) is stays


def test_a_route_is_flown_until_its_uav_has_reported(read_prompt: Read, ground: Ground) -> None:
    report = read_prompt(
        PATROL + 'It tells the police car when a truck is within 60 m of the drone.', 'downtown'
    )
    alone = read_prompt(PATROL, 'downtown')
    for spec, again in ((report, True), (alone, False)):
        (plan,) = plans_with_events(spec, ground(spec, 'downtown').uavs, ())
        assert plan.missions[0].until_event is again


def test_who_waits_for_traffic_has_time_where_nobody_flies(
    read_prompt: Read, limits: Limits
) -> None:
    alone = read_prompt('A car drives. When it reaches Union Station, a bus starts.', 'downtown')
    assert patience_s(alone) > 0.0
    assert horizon_s(alone, limits) > limits.horizon_inferred_min_s + patience_s(alone) - 1.0
    assert patience_s(read_prompt('A car drives. A bus stops at 20 s.', 'downtown')) == 0.0


@pytest.mark.parametrize(('at_s', 'least_m'), [(10, 0.0), (40, 100.0)])
def test_who_is_told_something_later_finds_the_drone_on_its_way(
    at_s: float, least_m: float, read_prompt: Read, ground: Ground
) -> None:
    spec = read_prompt(
        f'My car drives. A drone hovers at 30 m. At {at_s:g} s the drone sends a message to my '
        'car.',
        'downtown',
    )
    found = ground(spec, 'downtown')
    point, car = found.uavs[0].missions[0].hover_point, _agent(found, 'car')
    assert point is not None
    ahead_m = (point[0] - car.x_m) * car.heading_x + (point[1] - car.y_m) * car.heading_y
    assert ahead_m > least_m if least_m else abs(ahead_m) < 50.0
