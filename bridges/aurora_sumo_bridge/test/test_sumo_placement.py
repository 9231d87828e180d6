# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Agents stand exactly where asked at tick 0, or the load fails and says why."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundAgentLoad, GroundLoad
from aurora_core.trace.layout import GroundColumn
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.placement import Body, check_places
from aurora_sumo_bridge.polyline import Box
from aurora_sumo_bridge.sumo_client import SumoClient
from aurora_sumo_bridge.vehicles import EXACT_M, VehiclePlace

Scene = Callable[..., GroundLoad]
Build = Callable[..., GroundAgentLoad]

# Junction map: Long Street runs east, its lane 1 from x = -150 to -10.8 at y = -4.95.
LANE = 'long_street_1_eb_1'
EDGES = ('long_street_1_eb', 'long_street_2_eb')
START_X_M, LANE_Y_M, LANE_M = -150.0, -4.95, 139.2


def test_centres_headings_and_speeds_are_exact(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    client.load(
        scene(
            vehicle('bus', 'bus', edges=EDGES, lane_id=LANE, lane_position_m=70.0, speed_mps=9.0),
            vehicle('ego', edges=EDGES, lane_id=LANE, lane_position_m=25.0, speed_mps=13.89),
            vehicle('van', 'van', edges=EDGES, lane_id='long_street_1_eb_2', lane_position_m=25.0),
            map_name='junction',
        )
    )
    assert client.tick == 0
    assert client.state().tolist() == [
        pytest.approx([START_X_M + 70.0, LANE_Y_M, 1.0, 0.0, 9.0, 0.0, 1.0], abs=1e-9),
        pytest.approx([START_X_M + 25.0, LANE_Y_M, 1.0, 0.0, 13.89, 0.0, 1.0], abs=1e-9),
        pytest.approx([START_X_M + 25.0, -1.65, 1.0, 0.0, 0.0, 0.0, 1.0], abs=1e-9),
    ]


def test_the_other_three_directions(client: SumoClient, scene: Scene, vehicle: Build) -> None:
    def at(name: str, street: str) -> GroundAgentLoad:
        return vehicle(name, edges=(street,), lane_id=f'{street}_1', lane_position_m=40.0)

    client.load(
        scene(
            at('west', 'long_street_2_wb'),
            at('north', 'cross_street_1_nb'),
            at('south', 'cross_street_2_sb'),
            map_name='junction',
        )
    )
    poses = client.state()[:, : GroundColumn.SPEED]
    np.testing.assert_allclose(
        poses,
        [[110.0, 4.95, -1.0, 0.0], [1.65, -110.0, 0.0, 1.0], [-1.65, 110.0, 0.0, -1.0]],
        atol=1e-9,
    )


def test_ten_vehicles_in_a_tight_queue_are_all_in_at_once(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    agents = [
        vehicle(f'car_{i}', edges=EDGES, lane_id=LANE, lane_position_m=5.0 + 5.0 * i)
        for i in range(10)
    ]
    client.load(scene(*agents, map_name='junction'))
    xs = client.state()[:, GroundColumn.X]
    np.testing.assert_allclose(xs, START_X_M + 5.0 + 5.0 * np.arange(10), atol=1e-9)


def test_nothing_moves_before_tick_1(
    client: SumoClient, scene: Scene, vehicle: Build, walker: Build
) -> None:
    client.load(
        scene(
            vehicle('ego', edges=EDGES, lane_id=LANE, lane_position_m=50.0, speed_mps=10.0),
            walker('ann', edges=EDGES[:1], lane_position_m=40.0, arrival_position_m=90.0),
            map_name='junction',
        )
    )
    before = client.state()
    after = client.advance(1, ())
    # One step of driving: the speed at its end times the step (SUMO's Euler rule).
    travelled_m = after[0, GroundColumn.X] - before[0, GroundColumn.X]
    assert travelled_m == pytest.approx(0.05 * after[0, GroundColumn.SPEED], abs=1e-9)
    assert after[1, GroundColumn.X] - before[1, GroundColumn.X] == pytest.approx(0.07, abs=1e-9)


def test_the_rear_may_hang_over_the_start_of_the_lane(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    client.load(
        scene(
            vehicle('bus', 'bus', edges=EDGES, lane_id=LANE, lane_position_m=1.5),
            map_name='junction',
        )
    )
    np.testing.assert_allclose(
        client.state()[0, :4], [START_X_M + 1.5, LANE_Y_M, 1.0, 0.0], atol=1e-9
    )


def test_the_front_may_reach_onto_the_junction(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    client.load(
        scene(
            vehicle('bus', 'bus', edges=EDGES, lane_id=LANE, lane_position_m=LANE_M - 2.0),
            map_name='junction',
        )
    )
    np.testing.assert_allclose(
        client.state()[0, :4], [START_X_M + LANE_M - 2.0, LANE_Y_M, 1.0, 0.0], atol=1e-6
    )


def test_on_a_curve_the_centre_is_off_by_no_more_than_the_bend(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    lane = 'east_loop_1_eb_1'
    client.load(
        scene(
            vehicle('bus', 'bus', edges=(lane[:-2],), lane_id=lane, lane_position_m=40.0),
        )
    )
    line = Network().shape(lane)
    (x_m, y_m), _ = line.at(40.0)
    state = client.state()[0]
    off_m = math.dist(state[:2], (x_m, y_m))
    assert 0.01 < off_m <= line.bend_m(40.0, 6.0) + EXACT_M


def test_on_a_curve_that_is_drawn_longer_than_it_counts_a_car_can_stand(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    lane = '26431226_1'
    car = vehicle('car', edges=(lane[:-2],), lane_id=lane, lane_position_m=9.68723)
    client.load(scene(car, map_name='helsinki'))
    line = Network().shape(lane)
    (x_m, y_m), _ = line.at(9.68723)
    off_m = math.dist(client.state()[0, :2], (x_m, y_m))
    assert line.bend_m(9.68723, 2.3) + EXACT_M < off_m < 0.2


def test_an_empty_roster_is_a_scene_too(client: SumoClient, scene: Scene) -> None:
    client.load(scene(map_name='junction'))
    assert client.state().shape == (0, 7)
    assert client.advance(1, ()).shape == (0, 7)


def test_walkers_stand_in_the_middle_of_the_sidewalk_facing_their_way(
    client: SumoClient, scene: Scene, walker: Build
) -> None:
    client.load(
        scene(
            walker('on', edges=EDGES[:1], lane_position_m=40.0, arrival_position_m=90.0),
            walker('back', edges=EDGES[:1], lane_position_m=60.0, arrival_position_m=20.0),
            walker('there', edges=EDGES[:1], lane_position_m=50.0, speed_mps=0.0),
            map_name='junction',
        )
    )
    np.testing.assert_allclose(
        client.state(),
        [
            [-110.0, -8.1, 1.0, 0.0, 0.0, 0.0, 1.0],
            [-90.0, -8.1, -1.0, 0.0, 0.0, 0.0, 1.0],
            [-100.0, -8.1, 1.0, 0.0, 0.0, 0.0, 1.0],
        ],
        atol=1e-9,
    )


def test_a_parked_vehicle_stands_beside_the_traffic_for_ever(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    lane = 'cross_street_1_nb_1'
    edges = ('cross_street_1_nb', 'cross_street_2_nb')
    client.load(
        scene(
            vehicle(
                'truck', 'truck', edges=edges[:1], lane_id=lane, lane_position_m=60.0, parked=True
            ),
            vehicle('ego', edges=edges, lane_id=lane, lane_position_m=20.0, speed_mps=10.0),
            map_name='junction',
        )
    )
    start = client.state()
    # Lane centre 1.65, half a lane 1.65, half a truck 1.25, clearance 0.3.
    np.testing.assert_allclose(start[0, :4], [4.85, -90.0, 0.0, 1.0], atol=1e-9)
    for tick in range(1, 121):
        state = client.advance(tick, ())
        assert state[0].tolist() == start[0].tolist()
    # The lane stayed free: the car passed at full speed.
    assert state[1, GroundColumn.Y] > -60.0
    assert state[1, GroundColumn.SPEED] > 10.0


def test_on_a_parking_lane_a_parked_vehicle_stands_in_the_middle(
    client: SumoClient, scene: Scene, vehicle: Build
) -> None:
    client.load(
        scene(
            vehicle(
                'truck',
                'truck',
                edges=('cannery_street_6_eb',),
                lane_id='cannery_street_6_eb_1',
                lane_position_m=50.0,
                parked=True,
            ),
        )
    )
    middle, _ = Network().shape('cannery_street_6_eb_1').at(50.0)
    np.testing.assert_allclose(client.state()[0, :4], [*middle, 1.0, 0.0], atol=1e-9)


def _car(vehicle: Build, **fields: Any) -> GroundAgentLoad:
    settings: dict[str, Any] = {'edges': EDGES, 'lane_id': LANE, 'lane_position_m': 50.0}
    return vehicle('ego', **(settings | fields))


@pytest.mark.parametrize(
    ('fields', 'why'),
    [
        ({'type_name': 'zeppelin'}, "no vType 'zeppelin'"),
        ({'type_name': 'pedestrian'}, 'not one of a vehicle'),
        ({'lane_id': 'nowhere_1'}, "no lane 'nowhere_1'"),
        ({'lane_id': ''}, "no lane ''"),
        ({'lane_id': 'long_street_2_eb_1'}, "not on the first edge 'long_street_1_eb'"),
        ({'lane_id': 'long_street_1_eb_0'}, 'does not allow passenger'),
        ({'lane_position_m': 140.0}, 'ends at 139.20 m'),
        ({'speed_mps': 14.5}, 'speed_mps 14.5 is above the 13.89 m/s'),
        ({'speed_mps': 10.0, 'speed_factor': 0.5}, 'above the 6.945 m/s'),
        ({'edges': ()}, 'not on the first edge'),
        ({'edges': (*EDGES, 'nowhere')}, "no edge 'nowhere'"),
        ({'edges': ('long_street_1_eb', 'long_street_1_wb', 'long_street_2_eb')}, 'not connected'),
        ({'edges': EDGES[:1], 'lane_position_m': 138.0}, 'front bumper reaches 1.10 m past'),
        ({'lane_position_m': float('nan')}, 'lane_position_m nan'),
        ({'parked': True, 'speed_mps': 1.0}, 'parked vehicle has no speed_mps'),
    ],
)
def test_vehicles_that_cannot_be_placed(
    client: SumoClient, scene: Scene, vehicle: Build, fields: dict[str, Any], why: str
) -> None:
    with pytest.raises(GroundSimulatorError, match=f"'ego'.*{why}"):
        client.load(scene(_car(vehicle, **fields), map_name='junction'))
    # The failed load left nothing behind.
    client.load(scene(_car(vehicle), map_name='junction'))
    assert client.state()[0, GroundColumn.X] == pytest.approx(-100.0)


@pytest.mark.parametrize(
    ('fields', 'why'),
    [
        ({'type_name': 'car'}, 'not one of a person'),
        ({'edges': ()}, 'walk is empty'),
        ({'edges': ('nowhere',)}, "no edge 'nowhere'"),
        ({'edges': ('long_street_1_eb', 'meadow')}, "no edge 'meadow'"),
        ({'lane_id': 'long_street_1_eb_1'}, 'does not allow walkers'),
        ({'lane_id': 'long_street_2_eb_0'}, 'not on the first edge'),
        ({'lane_id': 'long_street_1_eb_9'}, "no lane 'long_street_1_eb_9'"),
        ({'lane_position_m': 140.0}, 'ends at 139.20 m'),
        ({'arrival_position_m': 140.0}, 'arrival_position_m 140.* ends at 139.20 m'),
        ({'time_gap_s': 1.0}, 'a walker has no time_gap_s'),
        ({'min_gap_m': 1.0}, 'a walker has no min_gap_m'),
    ],
)
def test_walkers_that_cannot_be_placed(
    client: SumoClient, scene: Scene, walker: Build, fields: dict[str, Any], why: str
) -> None:
    settings: dict[str, Any] = {'edges': EDGES[:1], 'lane_position_m': 40.0}
    with pytest.raises(GroundSimulatorError, match=f"'ann'.*{why}"):
        client.load(scene(walker('ann', **(settings | fields)), map_name='junction'))


def test_walk_edges_must_meet(client: SumoClient, scene: Scene, walker: Build) -> None:
    edges = ('meridian_parkway_1_eb', 'meridian_parkway_5_eb')
    with pytest.raises(GroundSimulatorError, match='share no junction'):
        client.load(scene(walker('ann', edges=edges, lane_position_m=5.0)))


def test_a_body_that_came_out_elsewhere_is_refused(vehicle: Build) -> None:
    body = Body(agent=_car(vehicle), length_m=4.6, width_m=1.8, vehicle_class='passenger')
    place = VehiclePlace(centre=(0.0, 0.0), tolerance_m=EXACT_M)
    box = Box(x_m=0.0, y_m=0.0, heading_x=1.0, heading_y=0.0, length_m=4.6, width_m=1.8)
    check_places((body,), (place,), (box,))
    for wrong_m in (0.011, float('nan')):
        with pytest.raises(GroundSimulatorError, match=r"'ego'.*SUMO puts it"):
            check_places((body,), (place,), (replace(box, y_m=wrong_m),))


def test_overlapping_agents_are_refused(client: SumoClient, scene: Scene, vehicle: Build) -> None:
    rear = vehicle('van', 'van', edges=EDGES, lane_id=LANE, lane_position_m=45.0)
    with pytest.raises(GroundSimulatorError, match=r"'van' .* overlaps agent 'ego'"):
        client.load(scene(_car(vehicle), rear, map_name='junction'))


def test_a_walker_under_a_parked_car_is_refused(
    client: SumoClient, scene: Scene, vehicle: Build, walker: Build
) -> None:
    car = _car(vehicle, lane_id='long_street_1_eb_0', parked=True)
    ann = walker('ann', edges=EDGES[:1], lane_position_m=50.0)
    with pytest.raises(GroundSimulatorError, match=r"'ann' .* overlaps agent 'ego'"):
        client.load(scene(car, ann, map_name='junction'))


@pytest.mark.parametrize(('second', 'why'), [('ego', 'occurs twice'), ('', 'is empty')])
def test_ids_must_be_names(
    client: SumoClient, scene: Scene, vehicle: Build, second: str, why: str
) -> None:
    other = vehicle(second, edges=EDGES, lane_id=LANE, lane_position_m=80.0)
    with pytest.raises(GroundSimulatorError, match=why):
        client.load(scene(_car(vehicle), other, map_name='junction'))
