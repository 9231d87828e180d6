# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Way points of the flight patterns around a centre (ENU map frame, metres)."""

from __future__ import annotations

from math import ceil, cos, pi, sin

from aurora_core.quantities.waypoints import ORBIT_STEP_DEG, pattern_centre
from aurora_core.spec.vocabulary import Pattern

Point2 = tuple[float, float]

# Distance between the lines of a lawnmower pattern.
_LAWNMOWER_SPACING_M = 20.0
# More points than a battery lasts for, one second apart: no site is searched for such a pattern.
MOST_POINTS = 1500


def pattern_points(
    pattern: Pattern,
    *,
    length_m: float,
    width_m: float,
    radius_m: float,
    waypoint_count: int,
) -> tuple[Point2, ...] | None:
    """Return the points of a pattern around (0, 0), its length along +x.

    Args:
        pattern: Kind. Rectangles and orbits are closed (the first point is repeated).
        length_m: Extent along x (rectangle, lawnmower, line).
        width_m: Extent along y (rectangle, lawnmower).
        radius_m: Orbit.
        waypoint_count: `waypoints`: number of points on a ring of `radius_m`; one is its centre.

    Returns:
        Points (x, y) in flight order; None when the numbers give no pattern that can be planned:
        no extent, or more than `MOST_POINTS` points.
    """
    lines = max(2.0, ceil(width_m / _LAWNMOWER_SPACING_M) + 1.0)
    wide = pattern in (Pattern.RECTANGLE, Pattern.LAWNMOWER)
    straight = wide or pattern is Pattern.LINE
    count = 2.0 * lines if pattern is Pattern.LAWNMOWER else float(waypoint_count)
    extents = (length_m, width_m) if wide else (length_m if straight else radius_m,)
    if min(extents) <= 0.0 or count > MOST_POINTS:
        return None
    a, b = length_m / 2.0, width_m / 2.0
    if pattern is Pattern.RECTANGLE:
        return ((-a, -b), (a, -b), (a, b), (-a, b), (-a, -b))
    if pattern is Pattern.LINE:
        return ((-a, 0.0), (a, 0.0))
    if pattern is Pattern.LAWNMOWER:
        points: list[Point2] = []
        for k in range(round(lines)):
            y = -b + k * width_m / (lines - 1.0)
            points += [(-a, y), (a, y)] if k % 2 == 0 else [(a, y), (-a, y)]
        return tuple(points)
    if pattern is Pattern.ORBIT:
        return _ring(radius_m, round(360.0 / ORBIT_STEP_DEG), closed=True)
    return _ring(radius_m, waypoint_count, closed=False) if waypoint_count > 1 else ((0.0, 0.0),)


def place_pattern(
    points: tuple[Point2, ...], centre: Point2, heading: Point2
) -> tuple[Point2, ...]:
    """Turn a pattern so that +x points along `heading` (unit vector) and move it to `centre`."""
    hx, hy = heading
    return tuple((centre[0] + x * hx - y * hy, centre[1] + x * hy + y * hx) for x, y in points)


def centred(points: tuple[Point2, ...], centre: Point2) -> tuple[Point2, ...]:
    """Return points moved so that the rectangle (map axes) that holds them is about a centre."""
    x, y = pattern_centre([(*point, 0.0) for point in points])
    return tuple((px + centre[0] - x, py + centre[1] - y) for px, py in points)


def begun_at(points: tuple[Point2, ...], share: float) -> tuple[Point2, ...]:
    """Return a closed pattern begun at the corner that is nearest to a share of its corners."""
    corners = points[:-1]
    first = round(share * len(corners)) % len(corners)
    turned = corners[first:] + corners[:first]
    return (*turned, turned[0])


def _ring(radius_m: float, count: int, *, closed: bool) -> tuple[Point2, ...]:
    ring = [
        (radius_m * cos(2.0 * pi * k / count), radius_m * sin(2.0 * pi * k / count))
        for k in range(count)
    ]
    return tuple([*ring, ring[0]] if closed else ring)
