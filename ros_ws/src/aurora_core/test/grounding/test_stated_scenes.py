# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scenes that leave open what would make them impossible: who waits, who makes room."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations

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
