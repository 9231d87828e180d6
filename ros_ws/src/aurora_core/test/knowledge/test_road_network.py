# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Look-up, routes and positions on the shipped maps, against numbers worked out by hand."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from aurora_core.errors import MapError
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.folds import folds_back_m
from aurora_core.knowledge.map_model import MapModel, load_map
from aurora_core.knowledge.net_reader import read_network
from aurora_core.knowledge.net_types import NetworkData
from aurora_core.knowledge.road_network import RoadNetwork


def test_lanes_of_a_street_from_kerb_to_middle(junction: MapModel) -> None:
    edge = junction.network.edge('long_street_1_eb')
    assert edge.street_name == 'Long Street'
    assert (edge.from_junction, edge.to_junction) == ('west', 'centre')
    sidewalk, right, left = (junction.network.lane(i) for i in edge.lane_ids)
    assert sidewalk.allows == {'pedestrian'}
    assert (sidewalk.width_m, right.width_m) == (3.0, 3.3)
    # Driving on the right: eastbound lanes lie south of the centre line.
    assert left.polyline[0] == pytest.approx((-150.0, -1.65))
    assert right.polyline[0] == pytest.approx((-150.0, -4.95))
    assert right.left_lane_id == left.id
    assert left.right_lane_id == right.id
    assert right.right_lane_id == sidewalk.id
    assert left.left_lane_id is None


def test_driving_lanes_leave_out_sidewalks_and_bike_lanes(downtown: MapModel) -> None:
    network = downtown.network
    cars = network.driving_lanes('passenger')
    assert [lane.id for lane in cars] == sorted(lane.id for lane in cars)
    assert not any(lane.is_internal for lane in cars)
    assert not any('pedestrian' in lane.allows for lane in cars)
    bikes = [lane for lane in network.driving_lanes('bicycle') if lane not in cars]
    assert {lane.index for lane in bikes} == {1}
    assert {network.edge(lane.edge_id).street_name for lane in bikes} == {
        'Market Street',
        'Northgate Street',
    }


def test_successors_respect_class_and_forbidden_turns(downtown: MapModel) -> None:
    network = downtown.network
    assert network.successors('quarry_avenue_7_sb', 'passenger') == ('meridian_parkway_4_wb',)
    assert network.successors('meridian_parkway_2_eb', 'passenger') == ('meridian_parkway_3_eb',)
    assert network.successors('smithy_court_1_nb', 'passenger') == ('smithy_court_1_sb',)
    assert network.successors('quarry_avenue_7_sb', 'pedestrian') == ()


def test_shortest_route_is_shortest_and_repeatable(junction: MapModel) -> None:
    route = junction.network.shortest_route('long_street_1_eb', 'cross_street_2_nb', 'passenger')
    assert route == ('long_street_1_eb', 'cross_street_2_nb')
    loop = junction.network.shortest_route('long_street_1_eb', 'long_street_1_wb', 'passenger')
    # No U-turn at the signal: to the nearest dead end and back; both side arms are equally long.
    assert loop == (
        'long_street_1_eb',
        'cross_street_1_sb',
        'cross_street_1_nb',
        'long_street_1_wb',
    )
    same = junction.network.shortest_route('long_street_1_eb', 'long_street_1_eb', 'passenger')
    assert same == ('long_street_1_eb',)


def test_no_route_is_none_not_an_error(junction: MapModel) -> None:
    network = junction.network
    assert network.shortest_route('long_street_1_eb', 'cross_street_2_nb', 'pedestrian') is None


def test_opposite_edge(downtown: MapModel) -> None:
    network = downtown.network
    assert network.opposite_edge('market_street_4_eb') == 'market_street_4_wb'
    assert network.opposite_edge('foundry_avenue_3_nb') is None


def test_position_on_a_straight_lane(junction: MapModel) -> None:
    x, y, east, north = junction.network.position_on_lane('long_street_1_eb_2', 40.0)
    assert (x, y, east, north) == pytest.approx((-110.0, -1.65, 1.0, 0.0))


def test_positions_on_a_curve_are_scaled_to_its_geometry(downtown: MapModel) -> None:
    # All lanes of a curve share one simulator length; positions must still end at its end.
    lane = downtown.network.lane('ridge_road_1_eb_1')
    assert abs(lane.length_m - lane.arc_length_m) > 0.005
    x, y, east, north = downtown.network.position_on_lane(lane.id, lane.length_m)
    assert (x, y) == pytest.approx(lane.polyline[-1])
    assert math.sqrt(east * east + north * north) == pytest.approx(1.0)


@pytest.mark.parametrize('pos_m', [-0.1, 1000.0, math.nan])
def test_positions_off_the_lane_are_refused(junction: MapModel, pos_m: float) -> None:
    with pytest.raises(MapError, match='is not on lane long_street_1_eb_2'):
        junction.network.position_on_lane('long_street_1_eb_2', pos_m)


def test_nearest_lane_gives_position_and_distance(junction: MapModel) -> None:
    lane_id, pos_m, distance_m = junction.network.nearest_lane(-110.0, -12.0, 'passenger')
    assert lane_id == 'long_street_1_eb_1'
    assert pos_m == pytest.approx(40.0)
    assert distance_m == pytest.approx(12.0 - 4.95)
    lane_id, _, distance_m = junction.network.nearest_lane(-110.0, -12.0, 'pedestrian')
    assert lane_id == 'long_street_1_eb_0'
    assert distance_m == pytest.approx(12.0 - 6.6 - 1.5)


def test_nearest_lane_between_two_takes_the_first_id(junction: MapModel) -> None:
    lane_id, _, distance_m = junction.network.nearest_lane(-100.0, 0.0, 'passenger')
    assert lane_id == 'long_street_1_eb_2'
    assert distance_m == pytest.approx(1.65)


def test_unknown_names_are_refused(junction: MapModel) -> None:
    network = junction.network
    with pytest.raises(MapError, match="no lane 'x_0'"):
        network.lane('x_0')
    with pytest.raises(MapError, match="no edge 'x'"):
        network.edge('x')
    with pytest.raises(MapError, match="no junction 'x'"):
        network.junction('x')
    with pytest.raises(MapError, match="'spaceship' is not a vehicle class"):
        network.driving_lanes('spaceship')


def test_a_map_without_lanes_for_a_class_has_no_nearest_lane(junction: MapModel) -> None:
    data = NetworkData(
        lanes=junction.network.sidewalks,
        edges=(),
        junctions=(),
        crossings=(),
        walking_areas=(),
        connections=(),
        projection='',
    )
    with pytest.raises(MapError, match='no lane for passenger'):
        RoadNetwork(data).nearest_lane(0.0, 0.0, 'passenger')


def test_no_way_leads_over_a_lane_that_folds_back(junction: MapModel) -> None:
    """As in CARLA's Town03: a lane of its junction runs back over the street that it joins."""
    known = junction.network
    straight = next(
        link for link in known.connections if link.direction == 's' and link.via_lane_ids
    )
    begin, end = (known.lane(i).edge_id for i in (straight.from_lane_id, straight.to_lane_id))
    assert end in known.successors(begin, 'passenger')
    via = known.lane(straight.via_lane_ids[0])
    back = tuple(reversed(via.polyline))
    folded = {
        lane.id: replace(lane, polyline=back, line=Polyline(back)) if lane.id == via.id else lane
        for lane in known.lanes.values()
    }
    assert folds_back_m(straight, known.lanes) == 0.0
    assert folds_back_m(straight, folded) == pytest.approx(via.arc_length_m)
    network = RoadNetwork(replace(read_network(junction.net_path), lanes=tuple(folded.values())))
    assert end not in network.successors(begin, 'passenger')
    others = set(known.successors(begin, 'passenger')) - {end}
    assert others
    assert set(network.successors(begin, 'passenger')) == others


def test_a_fold_that_nobody_notices_leads_on() -> None:
    network = load_map('helsinki').network
    folds = [f for f in network.connections if folds_back_m(f, network.lanes) > 0.0]
    assert folds
    for link in folds:
        begin, end = (network.lane(i).edge_id for i in (link.from_lane_id, link.to_lane_id))
        assert folds_back_m(link, network.lanes) < 1.0
        assert end in network.successors(begin, 'passenger')
