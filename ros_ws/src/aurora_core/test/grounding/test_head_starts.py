# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who sets off when, where somebody slower is ahead, or one is watched who does not move."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.knowledge.agent_types import load_agent_types
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn

Agents = Callable[[str], dict[str, GroundedAgent]]


SLOW = 'A bus drives at 6 m/s, 35 m ahead of my car. '


def test_who_would_catch_up_too_soon_waits_until_the_slower_one_has_drawn_away(
    agents: Agents,
) -> None:
    found = agents(f'{SLOW}My car drives at 10 m/s. A drone tracks the bus at 30 m.')
    rear = found['ego']
    assert (rear.release, rear.release_agent) == (ReleaseOn.PARTED, 'bus1')
    assert rear.release_beyond_m > 35.0
    assert found['bus1'].release is ReleaseOn.CAPTURED


def test_an_emergency_run_waits_until_it_can_be_faster_than_its_street_allows(
    agents: Agents,
) -> None:
    behind = 'An ambulance on an emergency run is 30 m behind my car on the main road. '
    rear = agents(f'{behind}My car drives at 6 m/s. A drone tracks my car at 35 m.')['ambulance1']
    assert (rear.release, rear.release_agent) == (ReleaseOn.PARTED, 'ego')


@pytest.mark.parametrize(
    'prompt',
    [
        'A bus drives at 9.5 m/s, 80 m ahead of my car. My car drives at 10 m/s.',
        f'{SLOW}My car drives at 10 m/s and follows the bus.',
        f'{SLOW}My car drives at 10 m/s. At 20 s my car stops.',
        'A bus stands 60 m ahead of my car. My car drives at 10 m/s.',
    ],
    ids=['there is time', 'it follows', 'it does something at a stated time', 'one stands'],
)
def test_nobody_waits_otherwise(agents: Agents, prompt: str) -> None:
    assert agents(prompt)['ego'].release is not ReleaseOn.PARTED


def test_who_is_to_drive_does_so_while_somebody_is_watched_who_stands(agents: Agents) -> None:
    hover = 'A drone hovers over the van at 30 m for 40 s. '
    found = agents(f'{hover}The van is parked at the roadside. My car drives at 8 m/s.')
    assert found['ego'].release in (ReleaseOn.START, ReleaseOn.CAPTURED)


def test_a_cyclist_does_not_hold_up_who_has_a_stated_speed_behind(agents: Agents) -> None:
    alone = agents('A cyclist is ahead of my car. A drone tracks the cyclist.')
    hurried = agents(
        'A cyclist is 20 m ahead of my car. My car drives at 8 m/s. A drone tracks the cyclist.'
    )
    desired_mps = load_agent_types()['bicycle'].desired_speed_mps
    assert desired_mps is not None
    assert desired_mps < 8.0
    assert hurried['bicycle1'].speed_factor * desired_mps == pytest.approx(8.0, abs=0.1)
    assert alone['bicycle1'].speed_factor <= 1.0


def test_who_is_followed_starts_no_harder_than_its_follower_can(agents: Agents) -> None:
    found = agents('A truck tailgates my car. A drone tracks the truck at 40 m.')
    assert found['ego'].gentle_mps2 == load_agent_types()['truck'].accel_mps2


def test_a_parked_one_stands_beside_one_in_the_lane(agents: Agents) -> None:
    found = agents('A van waits on the main road. A car is parked beside the van.')
    car, van = found['car1'], found['van1']
    assert car.parked
    assert not van.parked
    assert 1.5 < ((car.x_m - van.x_m) ** 2 + (car.y_m - van.y_m) ** 2) ** 0.5 < 5.0


def test_at_its_time_one_is_where_there_is_another_lane(
    agents: Agents, map_of: Callable[[str], MapModel]
) -> None:
    car = agents('A car drives at 10 m/s. At 20 s the car changes lanes.')['car1']
    network = map_of('downtown').network
    path = network.route_path(car.edges, 'passenger', start_lane_id=car.lane_id)
    at_m = path.arc_of(car.lane_id, car.lane_position_m) + 20.0 * 10.0 - 10.0 * 10.0 / (2.0 * 2.6)
    (street,) = (s for s in path.segments if s.start_m <= at_m < s.end_m)
    assert not street.is_internal
    assert street.end_m - at_m > 30.0  # room for the change
    lane = network.lane(street.lane_id)
    assert lane.left_lane_id is not None or lane.right_lane_id is not None


@pytest.mark.parametrize(
    ('start', 'goal'), [('Meadow Park', 'Eastgate Stadium'), ('Eastgate Stadium', 'Meadow Park')]
)
def test_a_vehicle_drives_from_one_end_of_the_town_to_the_other(
    agents: Agents, start: str, goal: str
) -> None:
    van = agents(f'A van is at {start}. The van drives to {goal}.')['van1']
    assert len(van.edges) > 3


@pytest.mark.parametrize(('speed_mps', 'least_m'), [(None, 55.0), (8.0, 95.0), (12.0, 175.0)])
def test_who_stops_drives_far_enough_for_its_stated_speed_to_show(
    agents: Agents, map_of: Callable[[str], MapModel], speed_mps: float | None, least_m: float
) -> None:
    said = '' if speed_mps is None else f' at {speed_mps:g} m/s'
    car = agents(f'A car drives{said} and stops.')['car1']
    network = map_of('downtown').network
    path = network.route_path(car.edges, 'passenger', start_lane_id=car.lane_id)
    begin_m = path.arc_of(car.lane_id, car.lane_position_m)
    assert path.arc_of(car.stop_lane_id, car.stop_position_m) - begin_m >= least_m
