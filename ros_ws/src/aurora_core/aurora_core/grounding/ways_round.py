# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Level ways from one place to another, round what stands between.

The shortest way among obstacles bends at their corners (visibility graph). Obstacles are taken in
one after the other, as ways meet them.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

Point2 = tuple[float, float]

# Ways keep so much more than has to be kept (m): bends are as far from corners as the legs are.
_SPARE_M = 0.5
# Outlines are as fine as this (m), and more bends than these are not looked at.
_FINE_M = 1.0
_MOST_BENDS = 300
_MOST_ROUNDS = 30


def way_round(
    start: Point2, end: Point2, solids: Sequence[BaseGeometry], clearance_m: float
) -> tuple[Point2, ...] | None:
    """Return the shortest way that keeps a clearance, its ends moved out of what stands there.

    Args:
        start: x, y in m.
        end: The same.
        solids: Outlines of all that reaches the height of the way.
        clearance_m: From them.

    Returns:
        Both ends and the bends between, in order; None when there is no way, or none that is
        found with few bends.
    """
    kept = shapely.buffer(list(solids), clearance_m + _SPARE_M, join_style='mitre')
    parts = list(shapely.get_parts(shapely.union_all(kept)))
    first, last = _outside(start, parts), _outside(end, parts)
    if first == last:
        return None
    met: set[int] = set()
    tree = shapely.STRtree(parts)
    for _ in range(_MOST_ROUNDS):
        way = _shortest(first, last, [parts[k] for k in sorted(met)])
        if way is None:
            return None
        new = {int(k) for k in tree.query(shapely.LineString(way), predicate='intersects')} - met
        if not new:
            return way
        met |= new
    return None


def _outside(point: Point2, parts: Sequence[BaseGeometry]) -> Point2:
    """Return the nearest point that is in none of some areas."""
    for part in parts:
        if part.intersects(shapely.Point(point)):
            ring = shapely.buffer(part, _SPARE_M, join_style='mitre').exterior
            free = ring.interpolate(ring.project(shapely.Point(point)))
            return float(free.x), float(free.y)
    return point


def _shortest(
    start: Point2, end: Point2, parts: Sequence[BaseGeometry]
) -> tuple[Point2, ...] | None:
    """Return the shortest way from corner to corner, None for too many corners or no way."""
    if not parts:
        return start, end
    import networkx as nx

    around = shapely.buffer(list(parts), _SPARE_M, join_style='mitre')
    corners = shapely.get_coordinates(
        shapely.get_exterior_ring(shapely.simplify(around, _FINE_M / 4.0))
    )
    points = np.unique(np.vstack(([start, end], corners)), axis=0)
    if len(points) > _MOST_BENDS:
        return None
    pairs = np.array(list(combinations(range(len(points)), 2)))
    lines = shapely.linestrings(points[pairs])
    area = shapely.union_all(list(parts))
    shapely.prepare(area)
    free = ~shapely.intersects(area, lines)
    graph = nx.Graph()
    graph.add_weighted_edges_from(
        (int(a), int(b), float(length))
        for (a, b), length in zip(pairs[free], shapely.length(lines[free]), strict=True)
    )
    ends = [int(np.flatnonzero((points == p).all(axis=1))[0]) for p in (start, end)]
    try:
        found = nx.dijkstra_path(graph, *ends)
    except (nx.NetworkXNoPath, nx.NodeNotFound):
        return None
    return tuple((float(points[k][0]), float(points[k][1])) for k in found)
