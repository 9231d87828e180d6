# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Polygons with holes in the plane: signed distance, containment, share of a segment inside."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import (
    BoolArray,
    FloatArray,
    FloatLike,
    as_point,
    as_rows,
    finite_rows,
    frozen,
    spread_rows,
)
from aurora_core.geometry.contacts import find_contacts
from aurora_core.geometry.footprints import FootprintTable


def ring_of(name: str, value: FloatLike) -> FloatArray:
    """Return a ring as a read-only float64 array of its own.

    Args:
        name: What the ring belongs to, for the message.
        value: (K, 2) metres, K >= 3, not closed (the last point is not the first one again).

    Raises:
        MapError: Wrong shape, too few points, closed, or not finite.
    """
    ring: FloatArray = np.array(value, dtype=np.float64)
    if ring.ndim != 2 or ring.shape[1] != 2 or len(ring) < 3:
        raise MapError(f'{name}: a ring of at least 3 points (K, 2) expected, found {ring.shape}')
    if not np.isfinite(ring).all():
        raise MapError(f'{name}: a ring with finite coordinates expected')
    if ring[0, 0] == ring[-1, 0] and ring[0, 1] == ring[-1, 1]:
        raise MapError(
            f'{name}: a ring that is not closed expected', hint='drop the repeated last point'
        )
    return frozen(ring)


def require_simple(name: str, ring: FloatArray, holes: Sequence[FloatArray]) -> None:
    """Check that rings neither cross themselves nor each other and enclose an area.

    Raises:
        MapError: They do not form one polygon.
    """
    polygon = shapely.Polygon(ring, holes)
    if not polygon.is_valid:
        reason = shapely.is_valid_reason(polygon)
        raise MapError(f'{name}: a simple polygon expected, found: {reason}')


@dataclass(frozen=True, slots=True, eq=False)
class Polygon:
    """A polygon with holes.

    Attributes:
        ring_xy: (K, 2) outer ring, metres, either orientation, not closed, read-only.
        holes_xy: Inner rings of the same kind.
    """

    ring_xy: FloatArray
    holes_xy: tuple[FloatArray, ...] = ()

    def __post_init__(self) -> None:
        """Copy, check and freeze the rings.

        Raises:
            MapError: The rings are not those of one polygon.
        """
        object.__setattr__(self, 'ring_xy', ring_of('polygon', self.ring_xy))
        holes = tuple(ring_of(f'hole {k} of polygon', h) for k, h in enumerate(self.holes_xy))
        object.__setattr__(self, 'holes_xy', holes)
        require_simple('polygon', self.ring_xy, holes)

    @property
    def rings(self) -> tuple[FloatArray, ...]:
        """Outer ring first, then the holes."""
        return (self.ring_xy, *self.holes_xy)


class PolygonSet:
    """Polygons that may touch or overlap, taken as their union."""

    def __init__(self, polygons: Iterable[Polygon]) -> None:
        self.polygons = tuple(polygons)
        self._table = FootprintTable([polygon.rings for polygon in self.polygons])

    def signed_distance(self, xy: FloatLike, cutoff_m: float = 50.0) -> FloatArray:
        """Return the distance of points to the nearest polygon.

        Args:
            xy: (T, 2) metres.
            cutoff_m: Greatest distance that is told apart; beyond it the cutoff is returned.

        Returns:
            (T,) metres, positive outside all polygons, negative inside one: then the depth in
            the polygon where it is deepest (in overlapping polygons the depth in their union can
            be greater). NaN where the point is not finite.
        """
        points = as_rows('xy', xy, 2)
        finite = finite_rows(points)
        if not finite.all():
            return spread_rows(self.signed_distance(points[finite], cutoff_m), finite)
        x, y = points[:, 0], points[:, 1]
        out = np.full(len(points), float(cutoff_m))
        for rows, row, item in self._table.near(x, y, x, y, cutoff_m):
            value = self._table.edges.signed_distance(x[rows][row], y[rows][row], item)
            np.minimum.at(out[rows], row, value)
        return out

    def contains(self, xy: FloatLike) -> BoolArray:
        """Tell which points lie in a polygon.

        A point on a boundary that two polygons share belongs to exactly one of them.

        Args:
            xy: (T, 2) metres; a point that is not finite is in none.
        """
        points = as_rows('xy', xy, 2)
        x, y = points[:, 0], points[:, 1]
        out = np.zeros(len(points), dtype=np.bool_)
        for rows, row, item in self._table.near(x, y, x, y, 0.0):
            inside = self._table.edges.contains(x[rows][row], y[rows][row], item)
            out[rows][row[inside]] = True
        return out

    def segment_inside_fraction(self, p_xy: FloatLike, q_xy: FloatLike) -> float:
        """Return the share of a segment that lies in the union of the polygons.

        Args:
            p_xy: (2,) metres.
            q_xy: (2,) metres; equal to `p_xy` for a point, whose share is 0 or 1.

        Returns:
            0 to 1. Along a shared boundary the segment is in exactly one of the polygons.
        """
        p, q = as_point('p_xy', p_xy, 2), as_point('q_xy', q_xy, 2)
        step = q - p
        low, high = np.minimum(p, q), np.maximum(p, q)
        cuts: FloatArray = np.zeros(0)
        for _, row, item in self._table.near(low[:, 0], low[:, 1], high[:, 0], high[:, 1], 0.0):
            start, along = p[row], step[row]
            rows = self._table.edges.rows_of_pairs(item)
            cuts = find_contacts(start[:, 0], start[:, 1], along[:, 0], along[:, 1], rows).t
        marks = np.unique(np.concatenate(([0.0, 1.0], cuts)))
        middle = (marks[:-1] + marks[1:]) / 2.0
        inside = self.contains(p + middle[:, None] * step)
        share = 0.0
        for k in np.flatnonzero(inside):  # one after the other: a fixed order of the sum
            share += float(marks[k + 1] - marks[k])
        return min(share, 1.0)


def segment_inside_fraction(
    p_xy: FloatLike, q_xy: FloatLike, polygons: PolygonSet | Polygon
) -> float:
    """Return the share of a segment inside a polygon; build a PolygonSet once for many calls.

    Args:
        p_xy: (2,) metres.
        q_xy: (2,) metres.
        polygons: One polygon, or a set taken as its union.

    Returns:
        0 to 1, as `PolygonSet.segment_inside_fraction`.
    """
    area = polygons if isinstance(polygons, PolygonSet) else PolygonSet([polygons])
    return area.segment_inside_fraction(p_xy, q_xy)
