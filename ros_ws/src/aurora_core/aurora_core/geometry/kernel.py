# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Arithmetic that decides verdicts: + - * / sqrt and comparisons only.

IEEE 754 fixes the last bit of these five operations. It does not fix it for `hypot`, `atan2`,
`exp` or sums whose order a library chooses, so none of them occurs here. numpy evaluates one
operation per call (no fused multiply-add), hence scalar and array versions agree to the bit.
"""

from __future__ import annotations

import math

import numpy as np

from aurora_core.geometry.arrays import BoolArray, FloatArray

# A segment's end counts as touching an edge that the segment would reach if it were longer by
# this share of its length: a crossing is then never lost between two roundings.
TOUCH_SHARE = 1e-9


def norm2(dx: float, dy: float) -> float:
    """Return the length of a plane vector."""
    return math.sqrt(dx * dx + dy * dy)


def norm3(dx: float, dy: float, dz: float) -> float:
    """Return the length of a space vector."""
    return math.sqrt(dx * dx + dy * dy + dz * dz)


def norm2_array(dx: FloatArray, dy: FloatArray) -> FloatArray:
    """Return the lengths of plane vectors, bit for bit those of `norm2`."""
    length: FloatArray = np.sqrt(dx * dx + dy * dy)
    return length


def norm3_array(dx: FloatArray, dy: FloatArray, dz: FloatArray) -> FloatArray:
    """Return the lengths of space vectors, bit for bit those of `norm3`."""
    length: FloatArray = np.sqrt(dx * dx + dy * dy + dz * dz)
    return length


def nonzero(divisor: FloatArray) -> FloatArray:
    """Return the divisor with 1 in place of 0 (for quotients whose dividend is 0 then)."""
    safe: FloatArray = np.where(divisor == 0.0, 1.0, divisor)
    return safe


def clamp01(value: FloatArray) -> FloatArray:
    """Return the value limited to [0, 1]."""
    limited: FloatArray = np.minimum(np.maximum(value, 0.0), 1.0)
    return limited


def point_segment_sq(
    wx: FloatArray, wy: FloatArray, ex: FloatArray, ey: FloatArray, ee: FloatArray
) -> FloatArray:
    """Return the squared plane distance of points to segments.

    Args:
        wx: Point minus start of the segment, x.
        wy: The same, y.
        ex: End minus start of the segment, x.
        ey: The same, y.
        ee: Squared length of the segment, 1 for a segment of length 0 (see `nonzero`).
    """
    t = clamp01((wx * ex + wy * ey) / ee)
    rx = wx - t * ex
    ry = wy - t * ey
    return rx * rx + ry * ry


def upward_crossing(
    point_y: FloatArray,
    wx: FloatArray,
    wy: FloatArray,
    ex: FloatArray,
    ey: FloatArray,
    end_y: FloatArray,
    start_y: FloatArray,
) -> BoolArray:
    """Tell for which edges a ray from the point towards +x crosses the edge (half-open rule).

    An odd number of crossings over all edges of a polygon's rings means that the point is inside.
    Points on the boundary belong to exactly one of two polygons that share it.
    """
    side = ex * wy - ey * wx
    upwards = (start_y <= point_y) & (end_y > point_y) & (side > 0.0)
    downwards = (end_y <= point_y) & (start_y > point_y) & (side < 0.0)
    crossing: BoolArray = upwards | downwards
    return crossing
