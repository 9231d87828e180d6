# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The road network: look-up, routes, positions and surfaces."""

from __future__ import annotations

import heapq
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from types import MappingProxyType

import shapely

from aurora_core.errors import MapError
from aurora_core.knowledge.folds import folds_back_m
from aurora_core.knowledge.lane_plan import LanePlanner
from aurora_core.knowledge.net_reader import VEHICLE_CLASSES, read_network
from aurora_core.knowledge.net_types import (
    Connection,
    Crossing,
    Edge,
    Junction,
    Lane,
    NetworkData,
)
from aurora_core.knowledge.route_path import RoutePath, arc_at, build_path
from aurora_core.knowledge.surfaces import carriageway, parking_area, sidewalk_area, union

_PEDESTRIAN = 'pedestrian'
# Paths that are kept: requests of one length look at the same ones of all lanes again.
_PATHS = 384

# A vehicle that jumps no farther moves as its speed says, to a record's accuracy.
_JUMP_M = 1.0

# Beyond rounding: candidates this much farther than the nearest are compared exactly.
_TIE_M = 0.01


class RoadNetwork:
    """An immutable road network in ENU map metres; every listing is sorted by id.

    Args:
        data: What was read from a network file.
    """

    def __init__(self, data: NetworkData) -> None:
        self._data = data
        self._lanes = MappingProxyType({lane.id: lane for lane in data.lanes})
        self._edges = MappingProxyType({edge.id: edge for edge in data.edges})
        self._junctions = MappingProxyType({j.id: j for j in data.junctions})
        links: dict[str, list[Connection]] = {}
        for connection in data.connections:
            links.setdefault(connection.from_lane_id, []).append(connection)
        self._links = MappingProxyType({k: tuple(v) for k, v in links.items()})
        self._planner = LanePlanner(self._lanes, self._links)
        self._driving_lanes: dict[str, tuple[Lane, ...]] = {}
        self._paths: dict[tuple[tuple[str, ...], str, str | None], RoutePath] = {}
        self._successors: dict[tuple[str, str], tuple[str, ...]] = {}
        self._trees: dict[str, tuple[shapely.STRtree, tuple[Lane, ...]]] = {}

    @classmethod
    def from_file(cls, path: Path) -> RoadNetwork:
        """Read a `.net.xml` or `.net.xml.gz` file.

        Raises:
            MapError: When the file is missing, damaged or not a network.
        """
        return cls(read_network(path))

    @property
    def projection(self) -> str:
        """PROJ string that turns longitude and latitude into map metres."""
        return self._data.projection

    @property
    def lanes(self) -> Mapping[str, Lane]:
        """All lanes by id, also those inside junctions."""
        return self._lanes

    @property
    def edges(self) -> Mapping[str, Edge]:
        """All edges by id, also those inside junctions."""
        return self._edges

    @property
    def junctions(self) -> Mapping[str, Junction]:
        """All junctions by id."""
        return self._junctions

    @property
    def crossings(self) -> tuple[Crossing, ...]:
        """All pedestrian crossings."""
        return self._data.crossings

    @property
    def connections(self) -> tuple[Connection, ...]:
        """All lane-to-lane connections."""
        return self._data.connections

    def lane(self, lane_id: str) -> Lane:
        """Return a lane.

        Raises:
            MapError: When the network has no such lane.
        """
        found = self._lanes.get(lane_id)
        if found is None:
            raise MapError(f'the network has no lane {lane_id!r}', hint='choose a lane of the map')
        return found

    def edge(self, edge_id: str) -> Edge:
        """Return an edge.

        Raises:
            MapError: When the network has no such edge.
        """
        found = self._edges.get(edge_id)
        if found is None:
            raise MapError(
                f'the network has no edge {edge_id!r}', hint='choose an edge of the map'
            )
        return found

    def junction(self, junction_id: str) -> Junction:
        """Return a junction.

        Raises:
            MapError: When the network has no such junction.
        """
        found = self._junctions.get(junction_id)
        if found is None:
            raise MapError(
                f'the network has no junction {junction_id!r}', hint='choose a junction of the map'
            )
        return found

    def driving_lanes(self, vclass: str) -> tuple[Lane, ...]:
        """Return the lanes outside junctions that a vehicle class may use.

        Raises:
            MapError: When the network format knows no such class.
        """
        if vclass not in self._driving_lanes:
            _check_class(vclass)
            self._driving_lanes[vclass] = tuple(
                lane for lane in self._data.lanes if not lane.is_internal and vclass in lane.allows
            )
        return self._driving_lanes[vclass]

    @cached_property
    def sidewalks(self) -> tuple[Lane, ...]:
        """Lanes for pedestrians only."""
        return tuple(
            lane for lane in self.driving_lanes(_PEDESTRIAN) if lane.allows == {_PEDESTRIAN}
        )

    @cached_property
    def street_names(self) -> tuple[str, ...]:
        """Names of all streets, sorted."""
        return tuple(sorted({e.street_name for e in self._data.edges if e.street_name}))

    def connections_from(self, lane_id: str) -> tuple[Connection, ...]:
        """Return the connections that leave a lane, sorted by target lane."""
        return self._links.get(lane_id, ())

    @cached_property
    def _between(self) -> Mapping[tuple[str, str, str], Sequence[str]]:
        """Edges from one junction to another that are of one street, in the network's order."""
        found: dict[tuple[str, str, str], list[str]] = {}
        for edge in self._data.edges:
            if not edge.is_internal:
                ends = edge.from_junction, edge.to_junction, edge.street_name
                found.setdefault(ends, []).append(edge.id)
        return found

    def opposite_edge(self, edge_id: str) -> str | None:
        """Return the edge of the same street in the other direction; None on a one-way street."""
        edge = self.edge(edge_id)
        back = self._between.get((edge.to_junction, edge.from_junction, edge.street_name), ())
        return next((other for other in back if other != edge_id), None)

    def successors(self, edge_id: str, vclass: str) -> tuple[str, ...]:
        """Return the edges that a vehicle class can drive into from the end of an edge.

        None over lanes that fold back on themselves: who passes there jumps.
        """
        key = (edge_id, vclass)
        if key not in self._successors:
            _check_class(vclass)
            found = {
                self._lanes[link.to_lane_id].edge_id
                for lane_id in self.edge(edge_id).lane_ids
                if vclass in self._lanes[lane_id].allows
                for link in self._links.get(lane_id, ())
                if vclass in self._lanes[link.to_lane_id].allows
                and folds_back_m(link, self._lanes) <= _JUMP_M
            }
            self._successors[key] = tuple(sorted(found))
        return self._successors[key]

    def shortest_route(self, edge_a: str, edge_b: str, vclass: str) -> tuple[str, ...] | None:
        """Return the shortest route by edge lengths, both ends included.

        Args:
            edge_a: First edge.
            edge_b: Last edge; equal to the first one it is the whole route.
            vclass: Vehicle class that drives it.

        Returns:
            Edge ids, or None when the class cannot get there. Of equally long routes the one
            whose edge ids come first.
        """
        self.edge(edge_b)
        if not any(vclass in self._lanes[i].allows for i in self.edge(edge_a).lane_ids):
            return None
        queue: list[tuple[float, tuple[str, ...]]] = [(0.0, (edge_a,))]
        done: set[str] = set()
        while queue:
            length_m, route = heapq.heappop(queue)
            last = route[-1]
            if last == edge_b:
                return route
            if last in done:
                continue
            done.add(last)
            for following in self.successors(last, vclass):
                if following not in done:
                    onward = length_m + self._edges[following].length_m
                    heapq.heappush(queue, (onward, (*route, following)))
        return None

    def route_path(
        self,
        edge_ids: tuple[str, ...],
        vclass: str,
        *,
        start_lane_id: str | None = None,
        start_pos_m: float = 0.0,
    ) -> RoutePath:
        """Return the line that a vehicle drives along a route.

        It starts at the beginning of the first lane (not at `start_pos_m`) and ends at the end of
        the last one; between lanes it runs through the junctions' own lanes.

        Args:
            edge_ids: Connected edges.
            vclass: Vehicle class.
            start_lane_id: Lane on the first edge; by default the one that needs the fewest lane
                changes, of equal ones the rightmost.
            start_pos_m: Simulator position on the first lane before which no lane change happens.

        Raises:
            MapError: When the route is empty or not connected for the class.
        """
        key = edge_ids, vclass, start_lane_id
        if start_pos_m > 0.0:
            return self._built_path(*key, start_pos_m)
        if key not in self._paths:
            if len(self._paths) >= _PATHS:
                del self._paths[next(iter(self._paths))]
            self._paths[key] = self._built_path(*key, 0.0)
        return self._paths[key]

    def _built_path(
        self,
        edge_ids: tuple[str, ...],
        vclass: str,
        start_lane_id: str | None,
        start_pos_m: float,
    ) -> RoutePath:
        _check_class(vclass)
        edges = tuple(self.edge(edge_id) for edge_id in edge_ids)
        if not edges:
            raise MapError('a route needs at least one edge', hint='name the first edge')
        plan = self._planner.plan(edges, vclass, start_lane_id)
        if plan is None:
            start = f' from lane {start_lane_id}' if start_lane_id else ''
            raise MapError(
                f'a {vclass} cannot drive the route {" ".join(edge_ids)}{start}',
                hint='use shortest_route to get a connected route',
            )
        return build_path(edges, self._lanes, plan, start_pos_m)

    def position_on_lane(self, lane_id: str, pos_m: float) -> tuple[float, float, float, float]:
        """Return x, y (m) and the unit heading (east, north) at a simulator position of a lane.

        Args:
            lane_id: Lane, also inside a junction.
            pos_m: Distance from its start as the simulator counts it, metres.

        Raises:
            MapError: When the position is not on the lane.
        """
        lane = self.lane(lane_id)
        if not 0.0 <= pos_m <= lane.length_m:
            raise MapError(
                f'position {pos_m} m is not on lane {lane_id} of {lane.length_m} m',
                hint='stay between 0 and the length of the lane',
            )
        return lane.line.at(arc_at(lane, pos_m))

    def nearest_lane(self, x: float, y: float, vclass: str) -> tuple[str, float, float]:
        """Return lane id, simulator position (m) and distance (m) of the nearest centre line.

        Only lanes outside junctions count; of equally near ones the first id wins.

        Raises:
            MapError: When no lane of the map is open to the class.
        """
        if vclass not in self._trees:
            lanes = self.driving_lanes(vclass)
            tree = shapely.STRtree([shapely.LineString(lane.polyline) for lane in lanes])
            self._trees[vclass] = (tree, lanes)
        tree, lanes = self._trees[vclass]
        if not lanes:
            raise MapError(
                f'the map has no lane for {vclass}', hint='choose another vehicle class'
            )
        point = shapely.Point(x, y)
        _, distances = tree.query_nearest(point, return_distance=True)
        hits = tree.query(point, predicate='dwithin', distance=float(distances[0]) + _TIE_M)
        options = []
        for i in hits:
            lane = lanes[int(i)]
            arc_m, offset_m = lane.line.project(x, y)
            options.append((abs(offset_m), lane.id, arc_m / lane.arc_length_m * lane.length_m))
        distance_m, lane_id, pos_m = min(options)
        return lane_id, pos_m, distance_m

    @cached_property
    def carriageway(self) -> shapely.MultiPolygon:
        """Surface of all lanes but sidewalks and parking strips, with the junction areas.

        Crossings belong to it; the corners where walkers wait do not.
        """
        return carriageway(self._data)

    @cached_property
    def sidewalk_area(self) -> shapely.MultiPolygon:
        """Surface of the sidewalks and of the walking areas at junctions, without crossings."""
        return sidewalk_area(self._data)

    @cached_property
    def parking_area(self) -> shapely.MultiPolygon:
        """Surface of the parking strips."""
        return parking_area(self._data)

    @cached_property
    def street_surface(self) -> shapely.MultiPolygon:
        """Everything from house line to house line: carriageway, parking strips, sidewalks."""
        return union([self.carriageway, self.sidewalk_area, self.parking_area])


def _check_class(vclass: str) -> None:
    if vclass not in VEHICLE_CLASSES:
        raise MapError(
            f'{vclass!r} is not a vehicle class of the network format',
            hint='use one of: ' + ', '.join(sorted(VEHICLE_CLASSES)),
        )
