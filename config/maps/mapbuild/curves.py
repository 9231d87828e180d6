# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Curved street shapes."""

from __future__ import annotations

import math

from mapbuild.streets import Point


def bezier(points: tuple[Point, Point, Point, Point], samples: int) -> tuple[Point, ...]:
    """Return the inner points of a cubic Bezier curve (without its two ends)."""
    result = []
    for i in range(1, samples):
        t = i / samples
        a, b, c, d = (1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t * t * (1 - t), t**3
        x = a * points[0][0] + b * points[1][0] + c * points[2][0] + d * points[3][0]
        y = a * points[0][1] + b * points[1][1] + c * points[2][1] + d * points[3][1]
        result.append((x, y))
    return tuple(result)


def arc(
    centre: Point, radius_m: float, from_deg: float, to_deg: float, samples: int
) -> tuple[Point, ...]:
    """Return points of a circle arc, ends included; angles counter-clockwise from east."""
    result = []
    for i in range(samples + 1):
        angle = math.radians(from_deg + (to_deg - from_deg) * i / samples)
        x, y = centre[0] + radius_m * math.cos(angle), centre[1] + radius_m * math.sin(angle)
        result.append((x, y))
    return tuple(result)
