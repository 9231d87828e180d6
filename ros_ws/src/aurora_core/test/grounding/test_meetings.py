# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two who are to come near each other start apart, and one of them can catch up."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn

Agents = Callable[[str], dict[str, GroundedAgent]]
NETWORK_LIMIT_MPS = 19.44
ALERT = 'When the {who} comes within 30 m of my car, a drone that tracks my car alerts it.'


def ahead_m(one: GroundedAgent, other: GroundedAgent) -> float:
    """Return how far one is ahead of another in whose direction it heads."""
    dx, dy = one.x_m - other.x_m, one.y_m - other.y_m
    return dx * other.heading_x + dy * other.heading_y


@pytest.mark.parametrize(
    ('scene', 'who'),
    [
        ('A van is parked at the roadside. My car drives. ', 'van'),
        ('A bus waits. My car drives. ', 'bus'),
    ],
)
def test_who_stands_is_ahead_of_who_comes_near(agents: Agents, scene: str, who: str) -> None:
    found = agents(scene + ALERT.format(who=who))
    assert ahead_m(found[f'{who}1'], found['ego']) > 30.0


@pytest.mark.parametrize(
    'scene', ['A van drives. My car drives. ', 'A van drives in the lane next to my car. ']
)
def test_who_drives_comes_from_behind(agents: Agents, scene: str) -> None:
    found = agents(scene + ALERT.format(who='van'))
    assert ahead_m(found['ego'], found['van1']) > 30.0


def test_nobody_flees_from_a_cyclist_who_is_to_come_near(agents: Agents) -> None:
    found = agents('A cyclist rides. My car drives. ' + ALERT.format(who='cyclist'))
    desired_mps = load_agent_types()['bicycle'].desired_speed_mps
    assert desired_mps is not None
    assert found['ego'].speed_factor * NETWORK_LIMIT_MPS < 0.8 * desired_mps


@pytest.mark.parametrize(
    'person', ['A pedestrian walks on the sidewalk', 'A pedestrian is ahead of my car']
)
def test_a_person_who_is_met_is_farther_ahead_than_that(agents: Agents, person: str) -> None:
    alert = 'a drone that tracks my car alerts it.'
    found = agents(f'{person}. When my car comes within 50 m of the pedestrian, {alert}')
    assert ahead_m(found['pedestrian1'], found['ego']) > 50.0


@pytest.mark.parametrize(
    'scene',
    ['A van is parked at the roadside. My car drives. ', 'A van comes towards my car. '],
)
def test_nobody_hurries_to_who_does_not_get_away(
    agents: Agents, map_of: Callable[[str], MapModel], scene: str
) -> None:
    ego = agents(scene + ALERT.format(who='van').replace('30', '15'))['ego']
    limit_mps = map_of('downtown').network.lane(ego.lane_id).speed_limit_mps
    assert ego.speed_factor * limit_mps < 15.0  # a UAV keeps up with it


def test_who_is_to_come_near_a_place_sets_off_while_a_uav_hovers_over_it(agents: Agents) -> None:
    hover = 'A drone hovers over a bus at 40 m. My car drives. '
    alert = 'the drone alerts my car.'
    found = agents(f'{hover}When the bus comes within 60 m of the intersection, {alert}')
    assert found['bus1'].release is ReleaseOn.CAPTURED


def test_who_comes_near_a_uav_starts_that_far_from_whom_it_tracks(agents: Agents) -> None:
    alert = 'When a van comes within 60 m of the drone, the drone alerts my car.'
    found = agents(f'My car drives. A drone tracks my car at 30 m. {alert}')
    assert abs(ahead_m(found['ego'], found['van1'])) > 60.0


def test_a_vehicle_comes_past_the_roadside_unit_that_it_is_to_come_near(agents: Agents) -> None:
    unit = 'A roadside unit is at City Hall. My car drives. A drone tracks my car. '
    found = agents(f'{unit}When my car comes within 50 m of the roadside unit, my car brakes.')
    ego, rsu = found['ego'], found['rsu1']
    way = Polyline(ego.route_xy_m)
    assert abs(way.project(rsu.x_m, rsu.y_m)[1]) < 30.0


def test_who_is_to_meet_a_person_does_not_wait_until_the_uav_has_landed(agents: Agents) -> None:
    scene = 'A drone hovers over the intersection at 30 m. A pedestrian walks on the sidewalk. '
    found = agents(
        f'{scene}When the pedestrian is within 30 m of my car, the drone alerts my car.'
    )
    assert found['ego'].release is ReleaseOn.CAPTURED


def test_who_comes_near_a_uav_starts_that_far_from_whom_it_hovers_over(agents: Agents) -> None:
    alert = 'When a van comes within 70 m of the drone, the drone alerts my car.'
    found = agents(f'A drone hovers over my car at 30 m. {alert}')
    assert abs(ahead_m(found['ego'], found['van1'])) > 70.0
