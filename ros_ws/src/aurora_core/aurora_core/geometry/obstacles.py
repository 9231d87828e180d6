# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clearance in space: of UAV centres and flight paths to buildings, of UAVs to vehicles."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from aurora_core.geometry.arrays import (
    FloatArray,
    FloatLike,
    FloatOrArray,
    IntArray,
    as_point,
    as_rows,
    finite_rows,
    same_length,
    spread_rows,
)
from aurora_core.geometry.kernel import norm2_array, norm3_array
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.prisms import PrismTable
from aurora_core.geometry.segment_distance import pair_distance

DEFAULT_CUTOFF_M = 50.0
_DEPTH_SAMPLES = 9  # places along an entering segment at which its depth is looked at


class ObstacleField:
    """Upright prisms as obstacles.

    Distances are Euclidean in space, positive outside, 0 on a face, negative inside: then the
    depth to the nearest face of the prism in which the point is deepest.
    """

    def __init__(self, prisms: Iterable[Prism]) -> None:
        self._table = PrismTable(prisms)

    def clearance_series(
        self, points: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M
    ) -> FloatArray:
        """Return the least signed distance of each point to any prism.

        Args:
            points: (T, 3) ENU metres.
            cutoff_m: Greatest distance that is told apart; a small one is fast.

        Returns:
            (T,) metres, at most the cutoff. NaN where the point is not finite.
        """
        return self._clearance(as_rows('points', points, 3), cutoff_m)

    def segment_clearance(
        self, p_xyz: FloatLike, q_xyz: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M
    ) -> float:
        """Return the least distance of a straight segment to any prism.

        Args:
            p_xyz: (3,) ENU metres.
            q_xyz: (3,) ENU metres; may equal `p_xyz`.
            cutoff_m: Greatest distance that is told apart.

        Returns:
            Metres, exact (up to rounding) and at most the cutoff. At most 0 if and only if the
            segment touches or enters a prism; the size of a negative value is a depth on the
            way, the greatest of a few places, which serves as a direction and not as a measure.
        """
        p, q = as_point('p_xyz', p_xyz, 3), as_point('q_xyz', q_xyz, 3)
        return float(self._segments(p, q, cutoff_m)[0])

    def _clearance(self, points: FloatArray, cutoff_m: float) -> FloatArray:
        finite = finite_rows(points)
        if not finite.all():
            return spread_rows(self._clearance(points[finite], cutoff_m), finite)
        x, y = points[:, 0], points[:, 1]
        out = np.full(len(points), float(cutoff_m))
        for rows, row, item in self._table.footprints.near(x, y, x, y, cutoff_m):
            np.minimum.at(out[rows], row, self._pair_clearance(points[rows][row], item))
        return out

    def _pair_clearance(self, points: FloatArray, item: IntArray) -> FloatArray:
        edges = self._table.footprints.edges
        aside = edges.signed_distance(points[:, 0], points[:, 1], item)
        z = points[:, 2]
        beyond = np.maximum(z - self._table.top[item], self._table.base[item] - z)
        corner = norm2_array(np.maximum(aside, 0.0), np.maximum(beyond, 0.0))
        return np.where((aside > 0.0) & (beyond > 0.0), corner, np.maximum(aside, beyond))

    def _segments(self, p: FloatArray, q: FloatArray, cutoff_m: float) -> FloatArray:
        finite = finite_rows(p, q)
        if not finite.all():
            return spread_rows(self._segments(p[finite], q[finite], cutoff_m), finite)
        out = np.full(len(p), float(cutoff_m))
        low, high = np.minimum(p, q), np.maximum(p, q)
        near = self._table.footprints.near(low[:, 0], low[:, 1], high[:, 0], high[:, 1], cutoff_m)
        for rows, row, item in near:
            start, end = p[rows][row], q[rows][row]
            distance, contact = pair_distance(self._table, start, end, item)
            for k in np.flatnonzero(contact):  # rare: routes are made to keep clear
                distance[k] = self._depth(start[k], end[k], item[k : k + 1])
            np.minimum.at(out[rows], row, distance)
        return out

    def _depth(self, p: FloatArray, q: FloatArray, item: IntArray) -> float:
        share = np.arange(_DEPTH_SAMPLES) / (_DEPTH_SAMPLES - 1.0)
        places = p + share[:, None] * (q - p)
        signed = self._pair_clearance(places, item.repeat(_DEPTH_SAMPLES))
        return min(float(signed.min()), 0.0)


def point_box_distance(
    points: FloatLike,
    centres: FloatLike,
    headings: FloatLike,
    length_m: FloatOrArray,
    width_m: FloatOrArray,
    height_m: FloatOrArray,
) -> FloatArray:
    """Return the signed space distance of points to a box that stands on the ground.

    Args:
        points: (T, 3) ENU metres, such as the centre of a UAV.
        centres: (T, 2) centre of the box in the plane, metres.
        headings: (T, 2) unit vector of the box's heading.
        length_m: Extent along the heading; one number or (T,), like the next two.
        width_m: Extent across it.
        height_m: Height of its top above ground.

    Returns:
        (T,) metres, positive outside; negative inside: the depth to the nearest side or the top
        (the ground is no way out). NaN where an argument is not finite.
    """
    place = as_rows('points', points, 3)
    centre, heading = as_rows('centres', centres, 2), as_rows('headings', headings, 2)
    same_length(points=place, centres=centre, headings=heading)
    dx, dy = place[:, 0] - centre[:, 0], place[:, 1] - centre[:, 1]
    hx, hy = heading[:, 0], heading[:, 1]
    along = np.abs(dx * hx + dy * hy) - length_m / 2.0
    across = np.abs(dy * hx - dx * hy) - width_m / 2.0
    above = place[:, 2] - height_m
    outside = norm3_array(np.maximum(along, 0.0), np.maximum(across, 0.0), np.maximum(above, 0.0))
    inside = np.maximum(np.maximum(along, across), above)
    return np.where(inside > 0.0, outside, inside + 0.0)
