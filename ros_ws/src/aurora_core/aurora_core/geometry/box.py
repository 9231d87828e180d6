# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Oriented rectangles in the plane: bodies of vehicles and persons, and the gap between two."""

from __future__ import annotations

import numpy as np

from aurora_core.geometry.arrays import FloatArray, FloatOrArray
from aurora_core.geometry.kernel import norm2, norm2_array


def chord_pose(
    front: tuple[float, float], back: tuple[float, float], length_m: float
) -> tuple[float, float, float, float]:
    """Return centre (m) and unit heading of a body that has both ends on a line.

    In a bend it stands on the chord, beside the line; so SUMO does (`MSVehicle::computeAngle`).

    Args:
        front: x, y of its front, metres.
        back: Where its back lies on the line.
        length_m: Its length, metres.
    """
    dx, dy = front[0] - back[0], front[1] - back[1]
    size = norm2(dx, dy)
    hx, hy = dx / size, dy / size
    half_m = 0.5 * length_m
    return front[0] - half_m * hx, front[1] - half_m * hy, hx, hy


def box_gap_series(
    a_x: FloatArray,
    a_y: FloatArray,
    a_hx: FloatArray,
    a_hy: FloatArray,
    a_length: FloatOrArray,
    a_width: FloatOrArray,
    b_x: FloatArray,
    b_y: FloatArray,
    b_hx: FloatArray,
    b_hy: FloatArray,
    b_length: FloatOrArray,
    b_width: FloatOrArray,
) -> FloatArray:
    """Return the signed gap of two moving rectangles.

    Args:
        a_x: (T,) centre of the first one, metres east.
        a_y: (T,) metres north.
        a_hx: (T,) unit vector of its heading, east component.
        a_hy: (T,) north component.
        a_length: Its extent along the heading, metres; a scalar or (T,).
        a_width: Its extent across.
        b_x: The same for the second one, to `b_width`.
        b_y: (T,).
        b_hx: (T,).
        b_hy: (T,).
        b_length: Metres.
        b_width: Metres.

    Returns:
        (T,) metres: above 0 the least distance; 0 on touch; below 0 the least shift along a side
        of either rectangle that would part them (separating axes). Any shapes that broadcast.
    """
    half_al, half_aw = np.asarray(a_length) / 2.0, np.asarray(a_width) / 2.0
    half_bl, half_bw = np.asarray(b_length) / 2.0, np.asarray(b_width) / 2.0
    dx, dy = b_x - a_x, b_y - a_y
    cos = a_hx * b_hx + a_hy * b_hy
    sin = a_hx * b_hy - a_hy * b_hx
    abs_cos, abs_sin = np.abs(cos), np.abs(sin)
    # centre of the other rectangle along and across each one's heading
    a_along, a_across = dx * a_hx + dy * a_hy, dy * a_hx - dx * a_hy
    b_along, b_across = dx * b_hx + dy * b_hy, dy * b_hx - dx * b_hy
    axes = (
        np.abs(a_along) - (half_al + half_bl * abs_cos + half_bw * abs_sin),
        np.abs(a_across) - (half_aw + half_bl * abs_sin + half_bw * abs_cos),
        np.abs(b_along) - (half_bl + half_al * abs_cos + half_aw * abs_sin),
        np.abs(b_across) - (half_bw + half_al * abs_sin + half_aw * abs_cos),
    )
    overlap = np.maximum(np.maximum(axes[0], axes[1]), np.maximum(axes[2], axes[3]))

    # Two rectangles that do not overlap are closest at a corner of one of them.
    corners = []
    for sl, sw in ((1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)):
        al, aw, bl, bw = sl * half_al, sw * half_aw, sl * half_bl, sw * half_bw
        b_along_a, b_across_a = bl * cos - bw * sin, bl * sin + bw * cos
        corners.append(_outside(a_along + b_along_a, a_across + b_across_a, half_al, half_aw))
        a_along_b, a_across_b = al * cos + aw * sin, aw * cos - al * sin
        corners.append(_outside(a_along_b - b_along, a_across_b - b_across, half_bl, half_bw))
    least = corners[0]
    for distance in corners[1:]:
        least = np.minimum(least, distance)
    gap: FloatArray = np.where(overlap > 0.0, least, overlap + 0.0)
    return gap


def _outside(
    along: FloatArray, across: FloatArray, half_length: FloatArray, half_width: FloatArray
) -> FloatArray:
    """Return the distance of a point to a rectangle about the origin, 0 inside."""
    return norm2_array(
        np.maximum(np.abs(along) - half_length, 0.0), np.maximum(np.abs(across) - half_width, 0.0)
    )
