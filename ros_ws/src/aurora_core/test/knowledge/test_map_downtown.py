# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The downtown has what scenarios need, and nothing stands where something drives or walks."""

from __future__ import annotations

import math
from itertools import pairwise

import pyproj
import pytest
import shapely

from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.net_types import Edge
from aurora_core.knowledge.road_network import RoadNetwork


def _edges(network: RoadNetwork, street: str) -> list[Edge]:
    return [e for e in network.edges.values() if e.street_name == street and not e.is_internal]


def _cars(network: RoadNetwork, edge: Edge) -> int:
    return sum('passenger' in network.lane(i).allows for i in edge.lane_ids)


def _footprints(model: MapModel) -> list[shapely.Polygon]:
    return [shapely.Polygon(b.ring, b.holes) for b in model.buildings]


@pytest.mark.parametrize('name', ['downtown', 'junction'])
def test_no_building_touches_a_street_or_another_building(
    name: str, request: pytest.FixtureRequest
) -> None:
    model: MapModel = request.getfixturevalue(name)
    shapes = _footprints(model)
    assert all(shape.is_valid for shape in shapes)
    for building, shape in zip(model.buildings, shapes, strict=True):
        assert shape.distance(model.network.street_surface) > 0.0, building.id
    # Attached houses share walls, never ground.
    assert sum(s.area for s in shapes) - shapely.union_all(shapes).area < 1.0


def test_folder_is_small(downtown: MapModel) -> None:
    assert sum(path.stat().st_size for path in downtown.folder.iterdir()) < 300_000


def test_every_pair_of_streets_is_routable(downtown: MapModel) -> None:
    network = downtown.network
    for vclass in ('passenger', 'bus', 'truck', 'emergency', 'motorcycle', 'bicycle'):
        edges = sorted({lane.edge_id for lane in network.driving_lanes(vclass)})
        forward: dict[str, set[str]] = {e: set(network.successors(e, vclass)) for e in edges}
        backward: dict[str, set[str]] = {e: set() for e in edges}
        for edge, following in forward.items():
            for other in following:
                backward[other].add(edge)
        # Strongly connected: from one edge to all, and from all to it.
        assert _reached(forward, edges[0]) == set(edges), vclass
        assert _reached(backward, edges[0]) == set(edges), vclass


def _reached(graph: dict[str, set[str]], start: str) -> set[str]:
    found, open_ = {start}, [start]
    while open_:
        new = graph[open_.pop()] - found
        found |= new
        open_.extend(new)
    return found


def test_every_street_has_a_name_and_a_sidewalk(downtown: MapModel) -> None:
    network = downtown.network
    for edge in network.edges.values():
        if not edge.is_internal:
            assert edge.street_name, edge.id
            assert any('pedestrian' in network.lane(i).allows for i in edge.lane_ids), edge.id
    assert len(network.street_names) >= 20


def test_sidewalks_and_crossings_form_one_network(downtown: MapModel) -> None:
    network = downtown.network
    walkable = [network.sidewalk_area]
    walkable += [shapely.Polygon(c.polygon) for c in network.crossings]
    parts = shapely.get_parts(shapely.union_all(walkable).buffer(0.3))
    # The parkway's far side hangs on the crossings at its three signals.
    assert len(parts) == 1


def test_parkway_is_straight_fast_and_long_without_signals(downtown: MapModel) -> None:
    network = downtown.network
    edges = _edges(network, 'Meridian Parkway')
    assert {_cars(network, e) for e in edges} == {2}
    lanes = [network.lane(e.lane_ids[-1]) for e in edges]
    assert {lane.speed_limit_mps for lane in lanes} == {19.44}
    xs = [x for lane in lanes for x, _ in lane.polyline]
    assert max(xs) - min(xs) >= 1400.0
    assert {round(abs(y + 340.0), 2) for lane in lanes for _, y in lane.polyline} == {1.75}
    for direction in ('eb', 'wb'):
        order = range(1, 8) if direction == 'eb' else range(7, 0, -1)
        route = tuple(f'meridian_parkway_{i}_{direction}' for i in order)
        path = network.route_path(route, 'passenger')
        assert not path.has_lane_change
        stops = [0.0, *(arc_m for arc_m, _, _ in path.signals), path.length_m]
        assert max(b - a for a, b in pairwise(stops)) >= 900.0


def test_one_can_drive_round_for_ever(downtown: MapModel) -> None:
    network = downtown.network
    route = network.shortest_route('meridian_parkway_7_eb', 'meridian_parkway_7_wb', 'bus')
    assert route is not None
    assert {network.edge(e).street_name for e in route} == {'Meridian Parkway', 'East Loop'}
    for lane in network.driving_lanes('passenger'):
        assert network.successors(lane.edge_id, 'passenger'), lane.id


def test_junctions_and_streets_are_varied(downtown: MapModel) -> None:
    network = downtown.network
    kinds = [junction.kind for junction in network.junctions.values()]
    assert kinds.count('traffic_light') >= 10
    assert kinds.count('allway_stop') >= 1
    assert sum(c.has_priority and not c.has_signal for c in network.crossings) >= 2
    assert {_cars(network, e) for e in _edges(network, 'Grand Boulevard')} == {3}
    assert all(network.opposite_edge(e.id) is None for e in _edges(network, 'Quarry Avenue'))
    assert len(network.successors('smithy_court_1_nb', 'passenger')) == 1
    assert {network.lane(e.lane_ids[-1]).speed_limit_mps for e in _school(network)} == {8.33}
    assert len(downtown.bus_stops) >= 6
    assert sum(len(row.places) for row in downtown.parking_areas) >= 20


def _school(network: RoadNetwork) -> list[Edge]:
    names = [f'assembly_street_{i}_{d}' for i in (1, 2) for d in ('eb', 'wb')]
    return [network.edge(name) for name in names]


def test_parking_places_are_off_the_carriageway_and_the_sidewalk(downtown: MapModel) -> None:
    network = downtown.network
    for row in downtown.parking_areas:
        for place in row.places:
            point = shapely.Point(place.x_m, place.y_m)
            # Half a truck (1.25 m) fits on both sides.
            assert network.carriageway.distance(point) >= 1.25
            assert network.sidewalk_area.distance(point) >= 1.25
            assert place.length_m >= 8.5


def test_heights_by_district(downtown: MapModel) -> None:
    by_kind: dict[str, list[float]] = {}
    for building in downtown.buildings:
        assert building.height_source == 'design'
        by_kind.setdefault(building.kind, []).append(building.height_m)
    assert 6.0 <= min(by_kind['house']) <= max(by_kind['house']) <= 10.0
    assert min(by_kind['block']) >= 12.0
    assert max(by_kind['block']) <= 24.0
    assert 35.0 <= min(by_kind['high_rise']) <= max(by_kind['high_rise']) <= 75.0
    assert by_kind['tower'] == [135.0]
    # A patrol at 20, 30 and 40 m meets a different number of obstacles.
    higher = [sum(b.height_m > h for b in downtown.buildings) for h in (10, 20, 30, 40)]
    assert higher == sorted(higher, reverse=True)
    assert len(set(higher)) == 4


def test_air_above_the_parkway_is_free(downtown: MapModel) -> None:
    corridor = shapely.box(-700.0, -375.0, 700.0, -305.0)
    for building, shape in zip(downtown.buildings, _footprints(downtown), strict=True):
        if shape.intersects(corridor):
            assert building.height_m <= 24.0, building.id
        if shape.intersects(shapely.box(-560.0, -375.0, 640.0, -305.0)):
            assert building.height_m <= 12.0, building.id
    assert not any(shapely.Polygon(z.ring).intersects(corridor) for z in downtown.zones)


def test_tower_is_inside_its_no_fly_zone(downtown: MapModel) -> None:
    tower = next(b for b in downtown.buildings if b.kind == 'tower')
    zone = next(z for z in downtown.zones if z.id == 'nofly_signal_tower')
    assert shapely.Polygon(zone.ring).covers(shapely.Polygon(tower.ring).buffer(10.0))
    assert zone.ceiling_m > tower.height_m
    # No street is closed to aircraft by it.
    assert not shapely.Polygon(zone.ring).intersects(downtown.network.carriageway)


def test_park_is_open_ground(downtown: MapModel) -> None:
    park = shapely.Polygon(next(a for a in downtown.areas if a.kind == 'park').ring)
    west, south, east, north = park.bounds
    assert (east - west, north - south) == (300.0, 220.0)
    assert not any(shape.intersects(park) for shape in _footprints(downtown))
    assert not park.intersects(downtown.network.street_surface)


def test_landmarks_are_reached_by_car(downtown: MapModel) -> None:
    kinds = {landmark.kind for landmark in downtown.landmarks}
    assert {'hospital', 'fire_station', 'city_hall', 'school', 'park', 'tower'} <= kinds
    assert {'market', 'stadium', 'station', 'police_station'} <= kinds
    for landmark in downtown.landmarks:
        lane = downtown.network.lane(landmark.approach_lane_id)
        assert 'passenger' in lane.allows
        x, y, _, _ = downtown.network.position_on_lane(lane.id, landmark.approach_pos_m)
        assert math.hypot(x - landmark.x_m, y - landmark.y_m) < 150.0, landmark.name


def test_everything_is_inside_the_bounds(downtown: MapModel) -> None:
    bounds = shapely.box(*downtown.bounds_m)
    assert bounds.covers(downtown.network.street_surface)
    assert all(bounds.covers(shape) for shape in _footprints(downtown))


def test_frame_is_east_north_metres_at_the_origin(downtown: MapModel) -> None:
    to_map = pyproj.Transformer.from_crs('EPSG:4326', downtown.projection, always_xy=True)
    lon, lat = downtown.origin_lon_deg, downtown.origin_lat_deg
    assert to_map.transform(lon, lat) == pytest.approx((0.0, 0.0), abs=1e-6)
    geod = pyproj.Geod(ellps='WGS84')
    # True north and true distance, by an independent computation on the ellipsoid.
    for azimuth_deg, expected in ((0.0, (0.0, 400.0)), (90.0, (400.0, 0.0))):
        there = geod.fwd(lon, lat, azimuth_deg, 400.0)
        assert to_map.transform(there[0], there[1]) == pytest.approx(expected, abs=0.05)
