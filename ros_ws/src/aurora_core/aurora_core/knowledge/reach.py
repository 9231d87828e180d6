# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which lanes a vehicle can reach and leave again: the largest part of a network that is whole."""

from __future__ import annotations

from dataclasses import dataclass

import networkx
import shapely

from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork


@dataclass(frozen=True, slots=True)
class NearestLane:
    """The lane nearest to a point, the simulator position on it, its length, how far it is."""

    lane_id: str
    pos_m: float
    length_m: float
    distance_m: float


def edge_parts(network: RoadNetwork, vclass: str) -> tuple[frozenset[str], ...]:
    """Return the sets of edges within which each leads to each, the longest first.

    Args:
        network: Network.
        vclass: Vehicle class that drives.
    """
    edges = {lane.edge_id for lane in network.driving_lanes(vclass)}
    graph = networkx.DiGraph()
    graph.add_nodes_from(sorted(edges))
    for edge in sorted(edges):
        graph.add_edges_from((edge, after) for after in network.successors(edge, vclass))
    parts = [frozenset(part) for part in networkx.strongly_connected_components(graph)]
    lengths_m = {part: sum(network.edge(edge).length_m for edge in part) for part in parts}
    return tuple(sorted(parts, key=lambda part: (-lengths_m[part], min(part))))


class Reach:
    """Lanes of the largest part of a network.

    Args:
        network: Network.
        vclass: Vehicle class that drives.
    """

    def __init__(self, network: RoadNetwork, vclass: str = 'passenger') -> None:
        parts = edge_parts(network, vclass)
        main = parts[0] if parts else frozenset()
        self._lanes: tuple[Lane, ...] = tuple(
            lane for lane in network.driving_lanes(vclass) if lane.edge_id in main
        )
        lines = [shapely.LineString(lane.polyline) for lane in self._lanes]
        self._tree = shapely.STRtree(lines)

    def nearest(self, x_m: float, y_m: float) -> NearestLane | None:
        """Return the lane nearest to a point (ENU map frame); None where there is no lane."""
        if not self._lanes:
            return None
        hits = self._tree.query_nearest(shapely.Point(x_m, y_m))
        options = []
        for i in hits:
            lane = self._lanes[int(i)]
            arc_m, offset_m = lane.line.project(x_m, y_m)
            pos_m = min(max(arc_m / lane.arc_length_m, 0.0), 1.0) * lane.length_m
            options.append((abs(offset_m), lane.id, pos_m, lane.length_m))
        distance_m, lane_id, pos_m, length_m = min(options)
        return NearestLane(lane_id, pos_m, length_m, distance_m)
