# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pure geometry of a lane's centre line (ENU, m)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Polyline:
    """A centre line with its arc lengths.

    Attributes:
        points: Vertices (x, y), at least two, no two neighbours equal.
        arc_m: Arc length at each vertex.
    """

    points: tuple[Point, ...]
    arc_m: tuple[float, ...]

    @property
    def length_m(self) -> float:
        return self.arc_m[-1]

    def at(self, arc_m: float) -> tuple[Point, Point]:
        """Return the point and the unit tangent at an arc length, clamped to the line."""
        index = 0
        last = len(self.points) - 2
        while index < last and self.arc_m[index + 1] <= arc_m:
            index += 1
        (x0, y0), (x1, y1) = self.points[index], self.points[index + 1]
        piece_m = self.arc_m[index + 1] - self.arc_m[index]
        along_m = min(max(arc_m - self.arc_m[index], 0.0), piece_m)
        tangent = ((x1 - x0) / piece_m, (y1 - y0) / piece_m)
        return (x0 + along_m * tangent[0], y0 + along_m * tangent[1]), tangent

    def left_offset_m(self, point: Point, arc_m: float) -> float:
        """Return how far left (positive) of the line's point at `arc_m` a point lies."""
        (x, y), (tx, ty) = self.at(arc_m)
        return (point[1] - y) * tx - (point[0] - x) * ty

    def bend_m(self, arc_m: float, half_span_m: float) -> float:
        """Return the gap between the line and the chord over `arc_m` ± `half_span_m`.

        A rigid box whose ends follow the line has its middle this far off it; 0 where straight.
        """
        (ax, ay), _ = self.at(arc_m - half_span_m)
        (bx, by), _ = self.at(arc_m + half_span_m)
        before_m = min(half_span_m, max(arc_m, 0.0))
        after_m = min(half_span_m, max(self.length_m - arc_m, 0.0))
        span_m = before_m + after_m
        share = before_m / span_m if span_m > 0.0 else 0.0
        (x, y), _ = self.at(arc_m)
        return distance_m((x, y), (ax + share * (bx - ax), ay + share * (by - ay)))


def polyline(points: tuple[Point, ...]) -> Polyline:
    """Build a centre line, dropping repeated vertices.

    Raises:
        ValueError: Fewer than two different points.
    """
    kept: list[Point] = []
    for point in points:
        if not kept or distance_m(kept[-1], point) > 0.0:
            kept.append(point)
    if len(kept) < 2:
        raise ValueError(f'a centre line needs two different points, got {points}')
    arc = [0.0]
    for a, b in pairwise(kept):
        arc.append(arc[-1] + distance_m(a, b))
    return Polyline(points=tuple(kept), arc_m=tuple(arc))


def distance_m(a: Point, b: Point) -> float:
    return math.sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]))


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A body's footprint: centre, unit heading (ENU) and size."""

    x_m: float
    y_m: float
    heading_x: float
    heading_y: float
    length_m: float
    width_m: float


def boxes_overlap(a: Box, b: Box) -> bool:
    """Tell whether two footprints share area (touching does not count); separating axes."""
    dx, dy = b.x_m - a.x_m, b.y_m - a.y_m
    for axis in (a, b):
        for ux, uy in (
            (axis.heading_x, axis.heading_y),
            (-axis.heading_y, axis.heading_x),
        ):
            reach_m = _half_extent_m(a, ux, uy) + _half_extent_m(b, ux, uy)
            if abs(dx * ux + dy * uy) >= reach_m:
                return False
    return True


def _half_extent_m(box: Box, ux: float, uy: float) -> float:
    along = abs(box.heading_x * ux + box.heading_y * uy)
    across = abs(-box.heading_y * ux + box.heading_x * uy)
    return 0.5 * (box.length_m * along + box.width_m * across)
