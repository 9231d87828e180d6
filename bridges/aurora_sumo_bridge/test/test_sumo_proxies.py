# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""UAVs stand in the ground world where they are, and nothing there depends on it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType

import libsumo
import numpy as np
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.knowledge.map_model import load_map
from aurora_core.ports.simulators import FloatArray, GroundAgentLoad, GroundLoad
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import UAV_WIDTH, GroundColumn, UavColumn
from aurora_sumo_bridge.conversions import centre_from_front
from aurora_sumo_bridge.proxies import proxy_id
from aurora_sumo_bridge.sumo_client import SumoClient

MAPS = Path(__file__).resolve().parents[3] / 'config' / 'maps'
QUADRANTS = ((1, 1), (-1, 1), (-1, -1), (1, -1))


def flown(places: FloatArray) -> FloatArray:
    """Return packed states of UAVs 40 m above places (M, 2)."""
    rows = np.zeros((len(places), UAV_WIDTH))
    rows[:, UavColumn.X : UavColumn.Y + 1] = places
    rows[:, UavColumn.Z] = 40.0
    return rows


def lane_in(quadrant: tuple[int, int]) -> tuple[str, str, float]:
    """Return edge, lane and the middle of a long lane in a quadrant of the map."""
    network = load_map('downtown').network
    east, north = quadrant
    for lane in sorted(network.driving_lanes('passenger'), key=lambda one: -one.length_m):
        x, y, *_ = network.position_on_lane(lane.id, lane.length_m / 2.0)
        if x * east > 20.0 and y * north > 20.0:
            return lane.edge_id, lane.id, lane.length_m / 2.0
    raise AssertionError(f'no lane in {quadrant}')


def test_a_uav_above_a_vehicle_stands_on_it_in_every_quadrant(
    client: SumoClient, scene: Callable[..., GroundLoad], vehicle: Callable[..., GroundAgentLoad]
) -> None:
    seats = [lane_in(quadrant) for quadrant in QUADRANTS]
    cars = [
        vehicle(f'car{k}', edges=(edge,), lane_id=lane, lane_position_m=at_m, speed_mps=8.0)
        for k, (edge, lane, at_m) in enumerate(seats)
    ]
    client.load(scene(*cars))
    for tick in range(1, 40):
        rows = client.advance(tick, ())
        client.show_uavs(flown(rows[:, GroundColumn.X : GroundColumn.Y + 1]))
    for k, (car, quadrant) in enumerate(zip(cars, QUADRANTS, strict=True)):
        ahead_x, ahead_y = rows[k, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1].tolist()
        x, y = libsumo.vehicle.getPosition(car.agent_id)
        length_m = libsumo.vehicle.getLength(car.agent_id)
        centre = centre_from_front(x, y, ahead_x, ahead_y, length_m)
        found = libsumo.poi.getPosition(proxy_id(k))
        assert np.hypot(found[0] - centre[0], found[1] - centre[1]) < 0.01
        assert np.sign(found).tolist() == list(quadrant)


def test_no_bit_of_the_traffic_depends_on_what_is_shown(
    client: SumoClient, replay: ModuleType
) -> None:
    load = replay.busy_load(MAPS)
    bare = replay.digest(client, load)
    client.close()

    class Showing(SumoClient):
        """Every UAV is in the way of somebody."""

        def advance(self, tick: int, commands: tuple[GroundCommand, ...]) -> FloatArray:
            self.show_uavs(flown(self.state()[:, GroundColumn.X : GroundColumn.Y + 1] + 1.0))
            return super().advance(tick, commands)

    showing = Showing()
    assert replay.digest(showing, load) == bare
    assert libsumo.poi.getIDCount() == len(load.agents)
    showing.close()


def test_a_new_run_begins_without_those_of_the_last(
    client: SumoClient, scene: Callable[..., GroundLoad]
) -> None:
    with pytest.raises(GroundSimulatorError, match='no scenario is loaded'):
        client.show_uavs(flown(np.zeros((1, 2))))
    client.load(scene())
    client.show_uavs(flown(np.array([[5.0, -3.0], [-700.0, 300.0]])))
    assert sorted(libsumo.poi.getIDList()) == [proxy_id(0), proxy_id(1)]
    client.load(scene())
    assert libsumo.poi.getIDList() == ()
    client.show_uavs(flown(np.array([[-5.0, 3.0]])))
    assert libsumo.poi.getPosition(proxy_id(0)) == pytest.approx((-5.0, 3.0))
