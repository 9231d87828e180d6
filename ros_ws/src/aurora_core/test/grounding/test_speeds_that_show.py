# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who has a stated speed begins where it can show: far from junctions, before it stops."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import pytest

from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.outcomes.grounded import GroundedAgent

Agents = Callable[[str], dict[str, GroundedAgent]]
Open = Callable[[GroundedAgent, float, float], float]


@pytest.fixture
def open_m(map_of: Callable[[str], MapModel], tolerances: Tolerances) -> Open:
    """Return how much of a stretch of an agent's way is far from the ends of its streets."""
    network = map_of('downtown').network

    def of(agent: GroundedAgent, low_m: float, high_m: float) -> float:
        line = Polyline(agent.route_xy_m)
        ends = [
            network.lane(lane).polyline[k]
            for edge in agent.edges[:4]
            for lane in network.edge(edge).lane_ids
            for k in (0, -1)
        ]
        steps = range(int(low_m), int(high_m))
        points = [line.at(float(k))[:2] for k in steps]
        return sum(
            min(dist(point, end) for end in ends) > tolerances.free_road_m for point in points
        )

    return of


def test_who_stops_for_somebody_who_crosses_comes_in_with_its_speed_before(
    agents: Agents, open_m: Open
) -> None:
    ego = agents(
        'The ego car drives on the main road at 8 m/s and stops. When the ego is within 25 m of a '
        'pedestrian on the sidewalk, the pedestrian crosses.'
    )['ego']
    assert ego.speed_mps == pytest.approx(8.0)
    assert open_m(ego, 0.0, 60.0) >= 2.0 * 8.0


def test_who_stops_at_a_stated_time_shows_its_speed_before(agents: Agents, open_m: Open) -> None:
    ego = agents(
        'A pedestrian waits at the crosswalk. The ego car drives at 8 m/s and stops after 8 '
        'seconds. A drone hovers over the crosswalk at 20 m and messages the pedestrian when the '
        'ego has stopped. When it gets the message the pedestrian crosses.'
    )['ego']
    assert ego.speed_mps == pytest.approx(8.0)
    assert open_m(ego, 0.0, 8.0 * 8.0) >= 2.0 * 8.0


def test_who_is_oncoming_has_a_way_on_which_its_speed_shows(agents: Agents, open_m: Open) -> None:
    found = agents('The ego car follows a bus. An oncoming motorcycle drives at 13 m/s.')
    assert open_m(found['motorcycle1'], 57.0, 250.0) >= 2.0 * 13.0


def test_who_stops_for_somebody_who_crosses_stops_before_the_crosswalk(
    agents: Agents, map_of: Callable[[str], MapModel]
) -> None:
    found = agents(
        'The ego car drives at 8 m/s and stops. When the ego is within 25 m of a pedestrian, the '
        'pedestrian crosses at the crosswalk. A drone hovers over the crosswalk at 40 m.'
    )
    ego, person = found['ego'], found['pedestrian1']
    lane = map_of('downtown').network.lane(ego.stop_lane_id)
    x, y, hx, hy = lane.line.at(ego.stop_position_m)
    way = Polyline(person.route_xy_m)
    ahead_m = [
        (px - x) * hx + (py - y) * hy
        for px, py in (way.at(float(k))[:2] for k in range(int(way.length_m)))
        if abs((py - y) * hx - (px - x) * hy) < 1.5
    ]
    assert ahead_m
    assert ego.length_m / 2.0 < min(ahead_m) < 20.0


def test_who_is_to_set_off_to_a_speed_stands_where_so_much_is_allowed(
    agents: Agents, map_of: Callable[[str], MapModel]
) -> None:
    truck = agents('A truck waits. After 10 seconds the truck sets off with 12 m/s.')['truck1']
    assert map_of('downtown').network.lane(truck.lane_id).speed_limit_mps >= 12.0
