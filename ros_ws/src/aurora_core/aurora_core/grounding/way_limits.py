# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a stretch of a way allows: its limits, how much is far from junctions, and its lane."""

from __future__ import annotations

import contextlib

from aurora_core.errors import MapError
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.route_path import RoutePath


def open_way_m(path: RoutePath, low_m: float, high_m: float, apart_m: float) -> float:
    """Return how much of a stretch of a path is farther than `apart_m` from every junction.

    Args:
        path: The path.
        low_m: Where the stretch begins, arc length.
        high_m: Where it ends.
        apart_m: Distance from the ends of streets, metres.
    """
    streets = (s for s in path.segments if not s.is_internal)
    return sum(
        max(0.0, min(high_m, s.end_m - apart_m) - max(low_m, s.start_m + apart_m)) for s in streets
    )


def limits_mps(
    network: RoadNetwork, path: RoutePath, start_m: float, way_m: float, *, longer_m: float = 0.0
) -> tuple[float, ...]:
    """Return the speed limits of the streets on a stretch of a path.

    Args:
        network: Road network.
        path: The path.
        start_m: Where the stretch begins, arc length.
        way_m: Its length.
        longer_m: Only of streets that are longer.
    """
    return tuple(
        network.lane(s.lane_id).speed_limit_mps
        for s in path.segments
        if s.end_m > start_m
        and s.start_m < start_m + way_m
        and s.end_m - s.start_m > longer_m
        and not s.is_internal
    )


def kept_lane(network: RoadNetwork, path: RoutePath, arc_m: float, vclass: str) -> RoutePath:
    """Return a path that keeps to its first lane up to an arc length (m), where it can.

    Who is beside somebody is there in the lane beside, whatever lane its way leads to later.
    """
    lane = network.lane(path.segments[0].from_lane_id)
    early = any(c.start_m < arc_m for c in path.lane_changes)
    if not early or arc_m > lane.arc_length_m:
        return path
    sumo_m = arc_m / lane.arc_length_m * lane.length_m
    with contextlib.suppress(MapError):
        edges, start = path.edge_ids, lane.id
        return network.route_path(edges, vclass, start_lane_id=start, start_pos_m=sumo_m)
    return path
