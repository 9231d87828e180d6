# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flights that are asked for where the plain plan has no room: from above, beside, in time."""

from __future__ import annotations

from collections.abc import Callable
from itertools import pairwise
from math import dist

import numpy as np
import pytest

from aurora_core.geometry.polyline import Polyline
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.come_upon import lap_points
from aurora_core.grounding.places import MapPlaces, place_positions
from aurora_core.knowledge.limits import Limits, Tolerances, pattern_off_m
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedScenario, ReleaseOn
from aurora_core.outcomes.grounding import GroundingFailure
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]


@pytest.fixture
def air(map_of: Maps) -> Airspace:
    model = map_of('downtown')
    return Airspace(model.buildings, model.zones)


def test_a_low_hover_inside_a_stadium_is_come_to_from_above(
    read_prompt: Read, ground: Ground, air: Airspace, limits: Limits
) -> None:
    spec = read_prompt('A drone hovers over Eastgate Stadium at 15 m for 20 s.', 'downtown')
    (uav,) = ground(spec, 'downtown').uavs
    (mission,) = uav.missions
    assert mission.hover_point is not None
    assert mission.altitude_m == 15.0
    x, y, z = mission.hover_point
    assert air.way_clearance_m(((uav.home_x_m, uav.home_y_m, z), (x, y, z))) <= 0.0
    over_m = mission.over_m
    assert over_m is not None
    way = ((uav.home_x_m, uav.home_y_m, z), (uav.home_x_m, uav.home_y_m, over_m))
    assert air.way_clearance_m((*way, (x, y, over_m), (x, y, z))) >= limits.clearance_min_m


def test_an_orbit_keeps_its_radius_from_the_landmark_or_has_no_place(
    read_prompt: Read, ground: Ground, map_of: Maps, tolerances: Tolerances
) -> None:
    prompt = 'A drone orbits City Hall with a radius of 40 m at {} m altitude.'
    low, high = (read_prompt(prompt.format(z), 'downtown') for z in (70, 80))
    (uav,) = ground(high, 'downtown').uavs
    hall = MapPlaces(map_of('downtown')).itself('landmark:City Hall', (0.0, 0.0))
    away_m = [dist(p[:2], hall) for p in uav.missions[0].waypoints]
    off_m = pattern_off_m(high.missions[0], tolerances)
    assert off_m == tolerances.standoff_m.of(40.0) == 5.0
    assert max(abs(d - 40.0) for d in away_m) <= off_m
    # Beside the landmark it would be free of the roofs, and 31 to 49 m away.
    found = ground(low, 'downtown')
    assert isinstance(found, GroundingFailure)
    assert found.reason == 'clearance'


@pytest.mark.parametrize(
    ('route', 'off_m'),
    [
        ('orbits City Hall with a radius of 80 m', 8.0),
        ('orbits City Hall with a radius of 200 m', 10.0),
        ('flies a 100 m by 60 m rectangle around City Hall', 10.0),
    ],
)
def test_how_far_the_middle_of_a_pattern_may_be_from_its_target(
    read_prompt: Read, tolerances: Tolerances, route: str, off_m: float
) -> None:
    (mission,) = read_prompt(f'A drone {route} at 90 m altitude.', 'downtown').missions
    assert pattern_off_m(mission, tolerances) == pytest.approx(off_m)


@pytest.mark.parametrize(
    ('ends', 'range_m'),
    [('As soon as it sees an ambulance', 250.0), ('When an ambulance is within 60 m of it', 60.0)],
)
def test_who_ends_a_patrol_of_the_street_is_out_of_reach_until_one_lap_is_flown(
    ends: str, range_m: float, read_prompt: Read, ground: Ground, map_of: Maps
) -> None:
    prompt = f'A drone patrols a 200 m line along the main road at 30 m. {ends}, it tracks it.'
    spec = read_prompt(prompt, 'downtown')
    found = ground(spec, 'downtown')
    (ambulance,) = found.agents
    line = found.uavs[0].missions[0].waypoints
    assert sum(dist(a, b) for a, b in pairwise(line)) == pytest.approx(200.0)
    assert min(dist((ambulance.x_m, ambulance.y_m, 0.0), p) for p in line) > range_m
    assert ambulance.release is ReleaseOn.LAPPED
    # Its way leads there, and the road that is meant is there as well.
    middle = ((line[0][0] + line[1][0]) / 2.0, (line[0][1] + line[1][1]) / 2.0)
    way = Polyline(ambulance.route_xy_m)
    assert dist(way.at(way.project(*middle)[0])[:2], middle) < 10.0
    assert dist(place_positions(spec, map_of('downtown'), found)['main_road'], middle) < 10.0


def test_a_body_whose_deed_ends_the_hover_of_another_uav_waits_for_both(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = (
        'Drone 1 hovers over Mercy Hospital at 60 m. Drone 2 tracks an ambulance at 40 m. When '
        'the ambulance arrives at Mercy Hospital, drone 2 sends a message to drone 1. When drone '
        '1 receives the message, it lands.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    (ambulance,) = found.agents
    highest = max(found.uavs, key=lambda uav: uav.missions[0].altitude_m)
    assert ambulance.release is ReleaseOn.CAPTURED
    assert ambulance.release_uav == highest.id
    assert ambulance.release_mission == highest.missions[0].id


def test_who_is_to_be_seen_for_a_time_waits_until_somebody_looks(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = 'A drone hovers over Harbor Market at 60 m. A motorcycle circulates near the market.'
    asked = ' The drone sees the motorcycle for at least 10 s.'
    releases = []
    for more in ('', asked):
        spec = read_prompt(prompt + more, 'downtown')
        assert len(spec.conditions) == (1 if more else 0)
        releases.append(ground(spec, 'downtown').agents[0].release)
    assert releases == [ReleaseOn.START, ReleaseOn.CAPTURED]


@pytest.mark.parametrize(
    ('prompt', 'who'),
    [
        (
            'A drone tracks a motorcycle. As soon as it sees a cyclist, the motorcycle brakes.',
            'motorcycle1',
        ),
        (
            'When the drone sees a pedestrian, it alerts the ego car and the ego car stops. The '
            'drone tracks the ego car at 40 m.',
            'ego',
        ),
        ('A pedestrian walks on the sidewalk and stops when the drone sees him.', 'pedestrian1'),
    ],
    ids=['target', 'told', 'on-foot'],
)
def test_who_slows_at_sight_is_on_the_move_by_then(
    prompt: str, who: str, read_prompt: Read, ground: Ground
) -> None:
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    told = next(a for a in found.agents if a.id == who)
    assert told.release is ReleaseOn.START
    # Who is tracked is caught up with.
    assert told.is_person or told.speed_factor < 0.6


def test_who_stops_near_a_hover_begins_out_of_reach(read_prompt: Read, ground: Ground) -> None:
    prompt = 'When the drone is within 50 m of the ego car, the ego car stops.'
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    (ego,), (uav,) = found.agents, found.uavs
    x, y, z = uav.missions[0].hover_point or (0.0, 0.0, 0.0)
    assert np.linalg.norm((x - ego.x_m, y - ego.y_m, z)) > 60.0
    assert np.hypot(uav.home_x_m - ego.x_m, uav.home_y_m - ego.y_m) > 50.0


def test_who_comes_near_a_crosswalk_on_foot_begins_farther_off(
    read_prompt: Read, ground: Ground
) -> None:
    prompt = (
        'A drone hovers over the crosswalk at 35 m. When a pedestrian comes within 20 m of the '
        'crosswalk, the drone alerts the roadside unit.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    person = next(a for a in found.agents if a.type_name == 'pedestrian')
    post = next(a for a in found.agents if a.type_name == 'rsu')
    x, y, _ = found.uavs[0].missions[0].hover_point or (0.0, 0.0, 0.0)
    assert np.hypot(x - person.x_m, y - person.y_m) > 22.0
    # The unit stands off the way of who comes along there.
    assert post.lateral_m < -0.5 < person.lateral_m


@pytest.mark.parametrize('agent', ['cyclist', 'truck'])
def test_who_is_to_get_out_of_sight_does_so_early_on_its_way(
    agent: str, read_prompt: Read, ground: Ground, air: Airspace
) -> None:
    prompt = (
        f'A drone tracks a {agent} at 35 m altitude for 90 s. When it loses sight of the {agent}, '
        'it climbs to 60 m.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    (body,) = found.agents
    offset = found.uavs[0].missions[0].offset_m
    way = Polyline(body.route_xy_m)
    # A cyclist comes no farther than some 250 m in the first half of that time.
    seen = []
    for k in range(50 if agent == 'cyclist' else 120):
        x, y = way.at(5.0 * k)[:2]
        here = np.array([[x + offset[0], y + offset[1], 35.0]])
        seen.append(bool(air.seen(here, np.array([[x, y, 1.0]]), 250.0)[0]))
    assert seen[0]
    assert not all(seen)


@pytest.mark.parametrize(
    ('pattern', 'shown'), [('300 m line', 1.0), ('120 by 80 m rectangle', 0.5)]
)
def test_who_stands_and_ends_a_patrol_comes_into_view_when_it_has_shown_its_size(
    pattern: str, shown: float, read_prompt: Read, ground: Ground, air: Airspace, limits: Limits
) -> None:
    prompt = (
        f'A van is parked at the roadside. A drone patrols a {pattern} at 30 m altitude. When the '
        'drone sees the van, it lands.'
    )
    found = ground(read_prompt(prompt, 'downtown'), 'downtown')
    (van,) = found.agents
    points = lap_points(found.uavs[0].missions[0])
    here = np.repeat([[van.x_m, van.y_m, van.height_m / 2.0]], len(points), axis=0)
    seen = air.seen(points, here, limits.sensing_range('clear', 'noon'))
    assert seen.any()
    assert shown * len(seen) - 6 < int(np.argmax(seen)) < len(seen) - 1


def test_a_uav_starts_ahead_of_a_target_that_cannot_wait_for_it(
    read_prompt: Read, ground: Ground
) -> None:
    ahead_m = []
    for when in ('', ' At 20 s the truck brakes.'):
        prompt = f'A truck drives at 10 m/s. A drone tracks the truck at 40 m altitude.{when}'
        found = ground(read_prompt(prompt, 'downtown'), 'downtown')
        (truck,) = found.agents
        (uav,) = found.uavs
        way = Polyline(truck.route_xy_m)
        ahead_m.append(way.project(uav.home_x_m, uav.home_y_m)[0])
    # It is up after some 11 s: 10 m/s less what it takes to get there.
    assert ahead_m[0] < 60.0 < ahead_m[1] < 140.0
