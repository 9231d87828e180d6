# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Least distance of straight space segments to upright prisms, exact for any polygon with holes.

A prism's surface is its roof, its underside and its walls. The least distance of a segment that
does not touch the prism is therefore the least of

1. its space distance to the roof's edges (and to the underside's),
2. its height above the roof (below the underside) where it passes over the footprint,
3. the plane distance of its piece between the two heights to the footprint's boundary.

Every term is attained, so their minimum is the distance itself and no bound.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aurora_core.geometry.arrays import BoolArray, FloatArray, IntArray
from aurora_core.geometry.contacts import find_contacts, least_height
from aurora_core.geometry.edges import EdgeRows, PairEdges
from aurora_core.geometry.kernel import clamp01, nonzero, point_segment_sq
from aurora_core.geometry.prisms import NO_UNDERSIDE_M, PrismTable


@dataclass(frozen=True, slots=True, kw_only=True)
class Piece:
    """The part of each of P segments between its prism's two heights.

    Attributes:
        start: (P, 2) plane position of its start, metres.
        step: (P, 2) its end minus its start.
        exists: (P,) false where the segment stays above the roof or below the underside.
    """

    start: FloatArray
    step: FloatArray
    exists: BoolArray


def pair_distance(
    table: PrismTable, p: FloatArray, q: FloatArray, item: IntArray
) -> tuple[FloatArray, BoolArray]:
    """Return the least distance of P segments to one prism each.

    Args:
        table: The prisms.
        p: (P, 3) start of each segment, ENU metres.
        q: (P, 3) its end; may equal the start.
        item: (P,) prism of each segment.

    Returns:
        (P,) metres, 0 on contact; (P,) whether the segment touches or enters the prism.
    """
    edges = table.footprints.edges
    rows = edges.rows_of_pairs(item)
    layout = edges.of_pairs(item)
    base, top = table.base[item], table.top[item]
    step = q - p

    square = _roof_edges_sq(p, step, top, rows, layout)
    raised = base > NO_UNDERSIDE_M
    if raised.any():
        underside = np.where(raised, base, top)
        square = np.minimum(square, _roof_edges_sq(p, step, underside, rows, layout))
    piece = _between(p, step, base, top)
    wall = _plane_sq(piece, rows, layout)
    square = np.where(piece.exists, np.minimum(square, wall), square)
    distance = np.sqrt(square)

    inner = find_contacts(
        piece.start[:, 0], piece.start[:, 1], piece.step[:, 0], piece.step[:, 1], rows
    )
    contact = inner.start_inside | inner.end_inside
    contact[inner.pair] = True
    contact &= piece.exists

    over = find_contacts(p[:, 0], p[:, 1], step[:, 0], step[:, 1], rows)
    above = least_height(over, p[:, 2], q[:, 2]) - top
    distance = np.where(above >= 0.0, np.minimum(distance, above), distance)
    if raised.any():
        below = least_height(over, -p[:, 2], -q[:, 2]) + base
        distance = np.where(below >= 0.0, np.minimum(distance, below), distance)
    return np.where(contact, 0.0, distance), contact


def _between(p: FloatArray, step: FloatArray, base: FloatArray, top: FloatArray) -> Piece:
    """Cut P segments down to the heights of their prisms."""
    dz = step[:, 2]
    level = dz == 0.0
    rise = nonzero(dz)
    t_base, t_top = (base - p[:, 2]) / rise, (top - p[:, 2]) / rise
    enter = np.where(level, 0.0, np.maximum(np.minimum(t_base, t_top), 0.0))
    leave = np.where(level, 1.0, np.minimum(np.maximum(t_base, t_top), 1.0))
    within = (p[:, 2] >= base) & (p[:, 2] <= top)
    exists = np.where(level, within, enter <= leave)
    enter = np.where(exists, enter, 0.0)
    leave = np.where(exists, leave, 0.0)
    return Piece(
        start=p[:, :2] + enter[:, None] * step[:, :2],
        step=(leave - enter)[:, None] * step[:, :2],
        exists=exists,
    )


def _plane_sq(piece: Piece, rows: EdgeRows, layout: PairEdges) -> FloatArray:
    """Return the squared plane distance of P pieces to the boundary, if they do not cross it.

    Two plane segments that do not cross are closest at an end of one of them.
    """
    pair = rows.pair
    dx, dy = piece.step[pair, 0], piece.step[pair, 1]
    dd = nonzero(dx * dx + dy * dy)
    ex, ey = rows.bx - rows.ax, rows.by - rows.ay
    ee = nonzero(ex * ex + ey * ey)
    wx, wy = piece.start[pair, 0] - rows.ax, piece.start[pair, 1] - rows.ay
    best = point_segment_sq(wx, wy, ex, ey, ee)
    best = np.minimum(best, point_segment_sq(wx + dx, wy + dy, ex, ey, ee))
    best = np.minimum(best, point_segment_sq(-wx, -wy, dx, dy, dd))
    best = np.minimum(best, point_segment_sq(ex - wx, ey - wy, dx, dy, dd))
    least: FloatArray = np.minimum.reduceat(best, layout.first)
    return least


def _roof_edges_sq(
    p: FloatArray, step: FloatArray, height: FloatArray, rows: EdgeRows, layout: PairEdges
) -> FloatArray:
    """Return the squared space distance of P segments to the footprint's edges at a height."""
    pair = rows.pair
    dx, dy, dz = step[pair, 0], step[pair, 1], step[pair, 2]
    ex, ey = rows.bx - rows.ax, rows.by - rows.ay
    wx, wy = p[pair, 0] - rows.ax, p[pair, 1] - rows.ay
    wz = p[pair, 2] - height[pair]
    dd = dx * dx + dy * dy + dz * dz
    ee = ex * ex + ey * ey
    de = dx * ex + dy * ey
    dw = dx * wx + dy * wy + dz * wz
    ew = ex * wx + ey * wy
    safe_dd, safe_ee = nonzero(dd), nonzero(ee)

    def at(t: FloatArray | float, u: FloatArray | float) -> FloatArray:
        rx = wx + t * dx - u * ex
        ry = wy + t * dy - u * ey
        rz = wz + t * dz
        square: FloatArray = rx * rx + ry * ry + rz * rz
        return square

    best = at(0.0, clamp01(ew / safe_ee))
    best = np.minimum(best, at(1.0, clamp01((ew + de) / safe_ee)))
    best = np.minimum(best, at(clamp01((0.0 - dw) / safe_dd), 0.0))
    best = np.minimum(best, at(clamp01((de - dw) / safe_dd), 1.0))
    # Both closest places in the open interiors: the common perpendicular of the two lines. Near
    # parallel lines give a poor place, but every place is on both segments: never too small.
    spread = dd * ee - de * de
    skew = nonzero(spread)
    t, u = (de * ew - ee * dw) / skew, (dd * ew - de * dw) / skew
    interior = (spread > 0.0) & (t > 0.0) & (t < 1.0) & (u > 0.0) & (u < 1.0)
    t, u = np.where(interior, t, 0.0), np.where(interior, u, 0.0)
    best = np.where(interior, np.minimum(best, at(t, u)), best)
    least: FloatArray = np.minimum.reduceat(best, layout.first)
    return least
