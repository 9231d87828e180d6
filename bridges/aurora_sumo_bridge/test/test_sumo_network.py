# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the client reads from the net, on the downtown map."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from aurora_core.errors import GroundSimulatorError
from aurora_core.ports.simulators import GroundLoad
from aurora_sumo_bridge.network import Network
from aurora_sumo_bridge.sumo_client import SumoClient

# A one-way avenue and the street with bicycle lanes that it meets.
AVENUE = 'foundry_avenue_2_nb'
WITH_BICYCLE_LANE = 'market_street_4_eb'


@pytest.fixture
def network(client: SumoClient, scene: Callable[..., GroundLoad]) -> Network:
    client.load(scene())
    return Network()


def test_a_car_is_never_led_onto_a_bicycle_lane(network: Network) -> None:
    ways = 0
    for lane_id in network.lanes_of(AVENUE):
        if not network.allows(lane_id, 'passenger'):
            continue
        following = network.next_lane(lane_id, WITH_BICYCLE_LANE, 'passenger')
        while following.startswith(':'):
            following = network.next_lane(following, WITH_BICYCLE_LANE, 'passenger')
        if following:
            ways += 1
            assert network.allows(following, 'passenger')
    assert ways >= 1


def test_classes_of_sidewalk_parking_lane_and_street(network: Network) -> None:
    sidewalk, parking, street = network.lanes_of('cannery_street_6_eb')
    assert [network.allows(lane, 'pedestrian') for lane in (sidewalk, parking, street)] == [
        True,
        False,
        False,
    ]
    assert [network.allows(lane, 'passenger') for lane in (sidewalk, parking, street)] == [
        False,
        False,
        True,
    ]
    assert network.lane_for('cannery_street_6_eb', 'passenger') == street


def test_arc_lengths_and_sumos_positions_turn_into_each_other(network: Network) -> None:
    lane_id = 'east_loop_1_eb_1'
    there = network.sumo_position_m(lane_id, 30.0)
    # On a curve the two differ: that is why they are converted.
    assert abs(there - 30.0) > 0.05
    assert network.arc_position_m(lane_id, there) == pytest.approx(30.0, abs=1e-9)


def test_internal_edges_are_no_streets(network: Network) -> None:
    assert not any(edge.startswith(':') for edge in network.edge_ids())
    assert list(network.edge_ids()) == sorted(network.edge_ids())
    assert not network.has_edge(':east_loop_0')


def test_a_lane_that_does_not_exist_is_named(network: Network) -> None:
    with pytest.raises(GroundSimulatorError, match="no lane 'nowhere_3'"):
        network.shape('nowhere_3')
