# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the client asks the loaded net: lanes, classes, connections; cached per run."""

from __future__ import annotations

from itertools import pairwise

import libsumo

from aurora_core.errors import GroundSimulatorError
from aurora_sumo_bridge.polyline import Polyline, polyline

PEDESTRIAN = 'pedestrian'


class Network:
    """Read-only view of the net of the running simulation."""

    def __init__(self) -> None:
        self._edges = frozenset(libsumo.edge.getIDList())
        self._lanes = frozenset(libsumo.lane.getIDList())
        self._shapes: dict[str, Polyline] = {}
        self._forbidden: dict[str, frozenset[str]] = {}
        self._next: dict[tuple[str, str], frozenset[str]] = {}

    def edge_ids(self) -> tuple[str, ...]:
        """Return the street edges, sorted."""
        return tuple(sorted(edge for edge in self._edges if not edge.startswith(':')))

    def has_edge(self, edge_id: str) -> bool:
        """Tell whether a street edge (no junction-internal one) exists."""
        return edge_id in self._edges and not edge_id.startswith(':')

    def has_lane(self, lane_id: str) -> bool:
        return lane_id in self._lanes

    def edge_of(self, lane_id: str) -> str:
        return str(libsumo.lane.getEdgeID(lane_id))

    def lanes_of(self, edge_id: str) -> tuple[str, ...]:
        count = int(libsumo.edge.getLaneNumber(edge_id))
        return tuple(f'{edge_id}_{index}' for index in range(count))

    def shape(self, lane_id: str) -> Polyline:
        """Return the centre line in the ENU map frame."""
        line = self._shapes.get(lane_id)
        if line is None:
            line = polyline(tuple((float(p[0]), float(p[1])) for p in self._raw_shape(lane_id)))
            self._shapes[lane_id] = line
        return line

    def arc_length_m(self, lane_id: str) -> float:
        """Return the length of the centre line."""
        return self.shape(lane_id).length_m

    def sumo_position_m(self, lane_id: str, arc_m: float) -> float:
        """Return SUMO's lane position of an arc length.

        The two differ on curves: SUMO gives the lanes of a street one common length.
        """
        return arc_m * float(libsumo.lane.getLength(lane_id)) / self.arc_length_m(lane_id)

    def arc_position_m(self, lane_id: str, sumo_position_m: float) -> float:
        """Return the arc length of SUMO's lane position."""
        return (
            sumo_position_m * self.arc_length_m(lane_id) / float(libsumo.lane.getLength(lane_id))
        )

    def allows(self, lane_id: str, vehicle_class: str) -> bool:
        """Tell whether a vehicle class may use a lane."""
        forbidden = self._forbidden.get(lane_id)
        if forbidden is None:
            # Not getAllowed: that is empty both for "every class" and for "none" (parking lanes).
            forbidden = frozenset(libsumo.lane.getDisallowed(lane_id))
            self._forbidden[lane_id] = forbidden
        return vehicle_class not in forbidden

    def lane_for(self, edge_id: str, vehicle_class: str) -> str:
        """Return the rightmost lane of an edge that allows the class, '' when there is none."""
        for lane_id in self.lanes_of(edge_id):
            if self.allows(lane_id, vehicle_class):
                return lane_id
        return ''

    def next_lane(self, lane_id: str, towards_edge: str, vehicle_class: str) -> str:
        """Return the lane that follows `lane_id` for a class on the way to an edge, or ''.

        Junction-internal lanes count: they come between the two streets.
        """
        for link in libsumo.lane.getLinks(lane_id):
            if self.edge_of(link[0]) == towards_edge and self.allows(link[0], vehicle_class):
                return str(link[4] or link[0])
        return ''

    def reachable(self, edge_id: str, vehicle_class: str) -> frozenset[str]:
        """Return the edges that a class can drive to from an edge, across one junction."""
        key = (edge_id, vehicle_class)
        found = self._next.get(key)
        if found is None:
            found = frozenset(
                self.edge_of(link[0])
                for lane_id in self.lanes_of(edge_id)
                if self.allows(lane_id, vehicle_class)
                for link in libsumo.lane.getLinks(lane_id)
                if self.allows(link[0], vehicle_class)
            )
            self._next[key] = found
        return found

    def check_drivable(self, edges: tuple[str, ...], vehicle_class: str) -> str:
        """Return '' when the class can drive the edges in order, else what is wrong."""
        if not edges:
            return 'the route is empty'
        for edge_id in edges:
            if not self.has_edge(edge_id):
                return f"the map has no edge '{edge_id}'"
            if not self.lane_for(edge_id, vehicle_class):
                return f"no lane of edge '{edge_id}' allows {vehicle_class}"
        for a, b in pairwise(edges):
            if b not in self.reachable(a, vehicle_class):
                return f"the route is not connected: {vehicle_class} cannot go from '{a}' to '{b}'"
        return ''

    def check_walkable(self, edges: tuple[str, ...]) -> str:
        """Return '' when every edge has a lane for walkers and neighbours meet, else why not."""
        if not edges:
            return 'the walk is empty'
        for edge_id in edges:
            if not self.has_edge(edge_id):
                return f"the map has no edge '{edge_id}'"
            if not self.lane_for(edge_id, PEDESTRIAN):
                return f"edge '{edge_id}' has no lane for walkers"
        for a, b in pairwise(edges):
            if not self._ends(a) & self._ends(b):
                return f"the walk is not connected: '{a}' and '{b}' share no junction"
        return ''

    def _ends(self, edge_id: str) -> set[str]:
        return {
            str(libsumo.edge.getFromJunction(edge_id)),
            str(libsumo.edge.getToJunction(edge_id)),
        }

    def _raw_shape(self, lane_id: str) -> tuple[tuple[float, float], ...]:
        if not self.has_lane(lane_id):
            raise GroundSimulatorError(f"the map has no lane '{lane_id}'")
        return tuple(libsumo.lane.getShape(lane_id))
