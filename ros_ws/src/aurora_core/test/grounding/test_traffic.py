# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Traffic by density: near, as much as asked, off the streets of the actors, drawn by the seed."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from math import dist

import pytest

from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.street_length import street_length_m
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.spec.scenario import ScenarioSpec

Read = Callable[..., ScenarioSpec]
Ground = Callable[..., GroundedScenario]
Maps = Callable[[str], MapModel]
Traffic = Callable[..., tuple[list[GroundedAgent], list[GroundedAgent]]]


@pytest.fixture
def traffic(read_prompt: Read, ground: Ground) -> Traffic:
    """The actors and the traffic of a prompt."""

    def of(prompt: str, **more: int) -> tuple[list[GroundedAgent], list[GroundedAgent]]:
        agents = ground(read_prompt(prompt), **more).agents
        cars = [a for a in agents if a.role == 'background']
        return [a for a in agents if a not in cars], cars

    return of


@pytest.mark.parametrize(('word', 'density'), [('light', 'low'), ('heavy', 'high')])
def test_there_is_as_much_as_the_street_asks_for(
    word: str, density: str, traffic: Traffic, map_of: Maps, tolerances: Tolerances
) -> None:
    actors, cars = traffic(f'A drone tracks a bus in {word} traffic.')
    (bus,) = actors
    network = map_of('downtown').network
    lanes = [
        (network.edge(lane.edge_id).street_name, lane.polyline)
        for lane in network.driving_lanes('passenger')
    ]
    length_m = street_length_m(lanes, (bus.x_m, bus.y_m), tolerances.traffic_radius_m)
    due = tolerances.traffic_per_km[density] * length_m / 1000.0
    low, high = tolerances.traffic_share
    assert low * due <= len(cars) <= high * max(due, tolerances.traffic_least)
    assert all(dist((c.x_m, c.y_m), (bus.x_m, bus.y_m)) <= 300.0 for c in cars)


def test_it_stays_on_a_map_whose_streets_end_at_its_border(
    read_prompt: Read, ground: Ground, map_of: Maps, tolerances: Tolerances
) -> None:
    network = map_of('helsinki').network
    agents = ground(read_prompt('A drone tracks a bus in heavy traffic.', 'helsinki'), 'helsinki')
    cars = [a for a in agents.agents if a.role == 'background']
    (bus,) = (a for a in agents.agents if a.role != 'background')
    lanes = [
        (network.edge(lane.edge_id).street_name, lane.polyline)
        for lane in network.driving_lanes('passenger')
    ]
    length_m = street_length_m(lanes, (bus.x_m, bus.y_m), tolerances.traffic_radius_m)
    due = tolerances.traffic_per_km['high'] * length_m / 1000.0
    assert len(cars) >= tolerances.traffic_share[0] * due


def test_it_turns_round_where_every_road_ends(
    read_prompt: Read, ground: Ground, map_of: Maps, tolerances: Tolerances
) -> None:
    """Four roads that end: who may never turn round gets nowhere, and nobody would be there."""
    prompt = 'A drone hovers over the intersection at 50 m for 20 seconds in heavy traffic.'
    cars = ground(read_prompt(prompt, 'junction'), 'junction').agents
    assert all(c.role == 'background' for c in cars)
    network = map_of('junction').network
    lanes = [
        (network.edge(lane.edge_id).street_name, lane.polyline)
        for lane in network.driving_lanes('passenger')
    ]
    length_m = street_length_m(lanes, (0.0, 0.0), tolerances.traffic_radius_m)
    due = tolerances.traffic_per_km['high'] * length_m / 1000.0
    low, high = tolerances.traffic_share
    assert low * due <= len(cars) <= high * due


def test_it_keeps_off_the_actors_and_apart(traffic: Traffic) -> None:
    actors, cars = traffic('A van tailgates the ego car in heavy traffic; a drone tracks the van.')
    streets = {edge for a in actors for edge in a.edges[:8]}
    assert not any(c.lane_id.rpartition('_')[0] in streets for c in cars)
    assert len({c.id for c in (*actors, *cars)}) == len(actors) + len(cars)
    places = [(c.x_m, c.y_m) for c in cars]
    assert all(dist(a, b) >= 25.0 for a, b in combinations(places, 2))


def test_it_stands_where_its_lane_is_drawn(traffic: Traffic, map_of: Maps) -> None:
    network = map_of('downtown').network
    curved = 0
    for seed in range(1, 40):
        _, cars = traffic('A drone tracks a bus for 90 s in heavy traffic.', seed=seed)
        for car in cars:
            lane = network.lane(car.lane_id)
            # SUMO counts the lane of a curve longer than it is.
            curved += lane.arc_length_m < lane.length_m - 1.0
            # Its front is on the line: in a bend its middle is beside it.
            half_m = car.length_m / 2.0
            x, y, _, _ = lane.line.at(car.lane_position_m + half_m)
            front = (car.x_m + half_m * car.heading_x, car.y_m + half_m * car.heading_y)
            assert dist((x, y), front) < 1e-6
        if curved:
            break
    assert curved


def test_the_seed_draws_it_and_nothing_else(traffic: Traffic) -> None:
    prompt = 'A drone tracks a bus in heavy traffic.'
    first, again, other = (traffic(prompt, seed=k) for k in (1, 1, 2))
    assert first == again
    assert first[1] != other[1]
    calm, none = traffic('A drone tracks a bus.')
    assert calm == first[0]
    assert none == []


def test_a_counted_scene_has_none(traffic: Traffic) -> None:
    assert traffic('In dense traffic a drone tracks a bus; there is exactly one car.')[1] == []
