# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where the lanes of a recorded world meet: from their ends and the ground between them."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from aurora_bench.checker.recording import FloatArray, Lane

# Ends of lanes that are so near belong to one junction.
JUNCTION_LINK_M = 23.0
# Lanes that meet come from so many sides.
ARMS = 3
# Ground that no lane covers: so much of it (m^2), so near to the ends of its lanes (m).
_LEAST_M2 = 20.0
_SEAM_M = 0.3
_TOUCHES_M = 1.5
# Ways that differ by less are one side.
_SIDE_RAD = np.pi / 6.0

Place = tuple[float, float, Any]


def junctions(lanes: tuple[Lane, ...], carriageway: Any) -> list[Place]:
    """Return middle and outline of every place where lanes of three or more sides meet.

    Ends of lanes near each other are one, unless short streets link several: then the ground
    between the lanes tells them apart.

    Args:
        lanes: Outside junctions.
        carriageway: All ground that vehicles drive on.
    """
    ends, angles = _lane_ends(lanes)
    grounds = _meeting_grounds(lanes, carriageway, ends, angles)
    found: list[Place] = []
    for members in _clusters(ends):
        if len({round(angles[i] / (np.pi / 4.0)) % 8 for i in members}) < ARMS:
            continue
        hull = shapely.MultiPoint(ends[members]).convex_hull
        parts = [ground for ground, met in grounds if met & set(members)]
        found += [_place(g) for g in parts] if len(parts) > 1 else [_place(hull)]
    apart = [g for g, _ in grounds if not any(g.intersects(outline) for _, _, outline in found)]
    return [*found, *map(_place, apart)]


def _place(outline: Any) -> Place:
    west, south, east, north = outline.bounds
    return (west + east) / 2.0, (south + north) / 2.0, outline


def _lane_ends(lanes: tuple[Lane, ...]) -> tuple[FloatArray, FloatArray]:
    """Return the ends of all lanes and, for each, the direction in which its lane lies."""
    ends, angles = [], []
    for lane in lanes:
        for here, away in ((lane.xy_m[0], lane.xy_m[1]), (lane.xy_m[-1], lane.xy_m[-2])):
            ends.append(here)
            angles.append(float(np.arctan2(*(away - here)[::-1])))
    return np.array(ends).reshape(-1, 2), np.array(angles)


def _meeting_grounds(
    lanes: tuple[Lane, ...], carriageway: Any, ends: FloatArray, angles: FloatArray
) -> list[tuple[Any, set[int]]]:
    """Return the ground between lanes to which some of three sides come, and their ends."""
    covered = shapely.union_all(
        [
            shapely.LineString(lane.xy_m).buffer(lane.width_m / 2.0 + _SEAM_M, cap_style='flat')
            for lane in lanes
        ]
    )
    between = carriageway.difference(covered).buffer(-_SEAM_M).buffer(_SEAM_M)
    found = []
    for part in getattr(between, 'geoms', [between]):
        if part.area < _LEAST_M2:
            continue
        here = shapely.distance(part, shapely.points(ends)) <= _TOUCHES_M
        if _sides(angles[here]) >= ARMS:
            found.append((part, set(np.flatnonzero(here).tolist())))
    return found


def _sides(angles: FloatArray) -> int:
    """Return from how many sides lanes come."""
    if len(angles) < ARMS:
        return len(angles)
    turned = np.sort(angles)
    gaps = np.diff(np.append(turned, turned[0] + 2.0 * np.pi))
    return int((gaps > _SIDE_RAD).sum())


def _clusters(points: FloatArray) -> list[list[int]]:
    """Return groups of points that are linked by short distances, in order of first member."""
    left = list(range(len(points)))
    groups = []
    while left:
        group, front = [], [left.pop(0)]
        while front:
            i = front.pop()
            group.append(i)
            near = [j for j in left if np.hypot(*(points[i] - points[j])) <= JUNCTION_LINK_M]
            front.extend(near)
            left = [j for j in left if j not in near]
        groups.append(sorted(group))
    return groups
