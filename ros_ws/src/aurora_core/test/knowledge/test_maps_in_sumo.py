# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator agrees with the loader about the shipped maps and agent types."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest
import shapely

from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.map_model import MapModel

libsumo: ModuleType = pytest.importorskip('libsumo')

STEP_S = 0.05
PAIRS = (
    ('meridian_parkway_1_eb', 'grand_boulevard_3_nb'),
    ('ridge_road_1_eb', 'foundry_avenue_2_nb'),
    ('smithy_court_1_sb', 'orchard_street_3_nb'),
    ('needle_lane_1_nb', 'observatory_avenue_1_eb'),
    ('meridian_parkway_7_eb', 'meridian_parkway_2_wb'),
)


@pytest.fixture
def simulation() -> Iterator[Any]:
    """libsumo, closed after the test whatever happens."""
    yield libsumo
    if libsumo.simulation.isLoaded():
        libsumo.close()


def _start(sim: Any, model: MapModel) -> None:
    types = config_path('maps', 'vtypes.add.xml')
    sim.start(
        [
            *('sumo', '-n', str(model.net_path), '-a', f'{types},{model.stops_path}'),
            *('--step-length', str(STEP_S), '--time-to-teleport', '-1', '--seed', '1'),
            *('--collision.action', 'warn', '--collision.check-junctions', 'true'),
            *('--no-step-log', 'true', '--no-warnings', 'true', '--xml-validation', 'never'),
        ]
    )


def _all_green(sim: Any) -> None:
    for signal in sim.trafficlight.getIDList():
        state = sim.trafficlight.getRedYellowGreenState(signal)
        sim.trafficlight.setRedYellowGreenState(signal, 'G' * len(state))


@pytest.mark.parametrize('name', ['downtown', 'junction'])
def test_a_car_stands_exactly_where_the_loader_says(
    simulation: Any, name: str, request: pytest.FixtureRequest
) -> None:
    model: MapModel = request.getfixturevalue(name)
    _start(simulation, model)
    lanes = model.network.driving_lanes('passenger')
    for lane in lanes:
        simulation.route.add(lane.id, [lane.edge_id])
        position = str(lane.length_m / 2.0)
        simulation.vehicle.add(
            lane.id, lane.id, 'car', departLane=str(lane.index), departPos=position
        )
    simulation.simulationStep()
    assert simulation.simulation.getPendingVehicles() == ()
    for lane in lanes:
        x, y, _, _ = model.network.position_on_lane(lane.id, lane.length_m / 2.0)
        assert simulation.vehicle.getPosition(lane.id) == pytest.approx((x, y), abs=1e-6)


def test_a_car_drives_along_the_route_path(simulation: Any, downtown: MapModel) -> None:
    network = downtown.network
    _start(simulation, downtown)
    _all_green(simulation)
    for i, (a, b) in enumerate(PAIRS):
        route = network.shortest_route(a, b, 'passenger')
        assert route is not None
        path = network.route_path(route, 'passenger')
        assert not path.has_lane_change
        car = f'car{i}'
        simulation.route.add(car, route)
        lane = network.lane(path.segments[0].lane_id)
        simulation.vehicle.add(car, car, 'car', departLane=str(lane.index), departPos='5')
        simulation.vehicle.setLaneChangeMode(car, 0)
        simulation.simulationStep()
        arc_m = 0.0
        while car in simulation.vehicle.getIDList():
            x, y = simulation.vehicle.getPosition(car)
            arc_m, offset_m = path.line.project(x, y, arc_m, 20.0)
            assert abs(offset_m) < 0.05, (car, arc_m)
            lane_id, pos_m = path.lane_position_at(arc_m)
            if lane_id == simulation.vehicle.getLaneID(car):
                assert pos_m == pytest.approx(simulation.vehicle.getLanePosition(car), abs=0.05)
            simulation.simulationStep()
        assert arc_m > path.length_m - 5.0


def test_a_parked_truck_is_off_the_street(simulation: Any, downtown: MapModel) -> None:
    network = downtown.network
    _start(simulation, downtown)
    for row in downtown.parking_areas:
        lane = network.lane(row.lane_id)
        simulation.route.add(row.id, [lane.edge_id])
        simulation.vehicle.add(row.id, row.id, 'truck', departLane=str(lane.index), departPos='10')
        simulation.vehicle.setParkingAreaStop(row.id, row.id, duration=1000)
    for _ in range(int(45 / STEP_S)):
        simulation.simulationStep()
    for row in downtown.parking_areas:
        assert simulation.vehicle.isStoppedParking(row.id)
        x, y = simulation.vehicle.getPosition(row.id)
        angle = math.radians(90.0 - simulation.vehicle.getAngle(row.id))
        body = _box(x, y, math.cos(angle), math.sin(angle), 8.5, 2.5)
        assert body.intersection(network.carriageway).area < 0.01
        assert body.intersection(network.sidewalk_area).area < 0.01
        # The loader's place holds the truck.
        place = min(row.places, key=lambda p: math.hypot(p.x_m - x, p.y_m - y))
        east, north = place.heading_east, place.heading_north
        front_x, front_y = (
            place.x_m + east * place.length_m / 2.0,
            place.y_m + north * place.length_m / 2.0,
        )
        assert (x, y) == pytest.approx((front_x, front_y), abs=0.3)


def _box(
    front_x: float, front_y: float, east: float, north: float, length_m: float, width_m: float
) -> shapely.Polygon:
    """Return the outline of a vehicle from its front bumper and heading."""
    half = width_m / 2.0
    back_x, back_y = front_x - east * length_m, front_y - north * length_m
    return shapely.Polygon(
        [
            (front_x - north * half, front_y + east * half),
            (front_x + north * half, front_y - east * half),
            (back_x + north * half, back_y - east * half),
            (back_x - north * half, back_y + east * half),
        ]
    )


def test_walkers_get_from_every_street_to_every_other(simulation: Any, downtown: MapModel) -> None:
    _start(simulation, downtown)
    edges = sorted({lane.edge_id for lane in downtown.network.sidewalks})
    for edge in edges[1:]:
        for a, b in ((edges[0], edge), (edge, edges[0])):
            stages = simulation.simulation.findIntermodalRoute(a, b, modes='')
            assert stages, (a, b)


def test_simulator_has_the_sizes_and_limits_of_the_table(
    simulation: Any, junction: MapModel
) -> None:
    _start(simulation, junction)
    text = config_path('knowledge', 'measured', 'agent_types.json').read_text(encoding='utf-8')
    for row in json.loads(text)['types']:
        types, name = simulation.vehicletype, row['name']
        found = {
            'length_m': types.getLength(name),
            'width_m': types.getWidth(name),
            'height_m': types.getHeight(name),
            'max_speed_mps': types.getMaxSpeed(name),
            'emergency_decel_mps2': types.getEmergencyDecel(name),
            'headway_s': types.getTau(name),
            'min_gap_m': types.getMinGap(name),
        }
        if not row['is_person']:  # walkers change their speed within a step, whatever is declared
            found |= {'accel_mps2': types.getAccel(name), 'decel_mps2': types.getDecel(name)}
        assert found == {field: row[field] for field in found}, name
        assert types.getVehicleClass(name) == row['vclass']
        assert types.getImperfection(name) == 0.0
        assert types.getSpeedDeviation(name) == 0.0
