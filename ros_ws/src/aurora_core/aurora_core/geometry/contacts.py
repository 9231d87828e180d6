# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a plane segment meets the boundary of a polygon, and which of its ends lie inside.

Only the line parameters of the boundary contacts and the two ends matter to the callers: a
quantity that is linear along the segment takes its extremes over the part inside a polygon at
exactly these places, so no interval has to be built.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from aurora_core.geometry.arrays import BoolArray, FloatArray, IntArray
from aurora_core.geometry.edges import EdgeRows, odd_count
from aurora_core.geometry.kernel import TOUCH_SHARE, clamp01, nonzero

STILL_SQ = 1e-12  # m^2: a shorter segment (1 um) is a point in the plane


@dataclass(frozen=True, slots=True, kw_only=True)
class Contacts:
    """Contacts of P segments with one polygon each.

    Attributes:
        pair: (H,) segment that each contact belongs to, in no particular order.
        t: (H,) share of the way from the segment's start, 0 to 1.
        start_inside: (P,) the segment starts inside (undefined on the boundary: a contact then).
        end_inside: (P,) the same for its end.
    """

    pair: IntArray
    t: FloatArray
    start_inside: BoolArray
    end_inside: BoolArray


def find_contacts(
    px: FloatArray, py: FloatArray, dx: FloatArray, dy: FloatArray, edges: EdgeRows
) -> Contacts:
    """Return where P segments meet the boundary of their polygons.

    The boundary counts (closed polygons): touching a corner or running along a wall is contact.

    Args:
        px: (P,) start of each segment, metres.
        py: (P,) the same, north.
        dx: (P,) end minus start; both 0 for a segment that is vertical in space.
        dy: (P,) the same, north.
        edges: All edges of each pair's polygon.
    """
    dd = dx * dx + dy * dy
    still = dd < STILL_SQ
    # A point still needs a direction in which to count crossings: east, in metres.
    ux = np.where(still, 1.0, dx)
    uy = np.where(still, 0.0, dy)
    dd = np.where(still, 1.0, dd)
    last = np.where(still, 0.0, 1.0)

    pair = edges.pair
    gx, gy = ux[pair], uy[pair]
    origin_x, origin_y = px[pair], py[pair]
    from_x, from_y = edges.ax - origin_x, edges.ay - origin_y
    to_x, to_y = edges.bx - origin_x, edges.by - origin_y
    side_a = gx * from_y - gy * from_x
    side_b = gx * to_y - gy * to_x
    # Both edges at a corner compute the same side for it, so a line cannot slip between them.
    k = np.flatnonzero(((side_a <= 0.0) & (side_b >= 0.0)) | ((side_a >= 0.0) & (side_b <= 0.0)))
    side_a, side_b = side_a[k], side_b[k]
    from_x, from_y, to_x, to_y = from_x[k], from_y[k], to_x[k], to_y[k]
    gx, gy, pair = gx[k], gy[k], pair[k]
    length_sq, end = dd[pair], last[pair]

    spread = side_a - side_b
    u = side_a / nonzero(spread)
    t = ((from_x + u * (to_x - from_x)) * gx + (from_y + u * (to_y - from_y)) * gy) / length_sq
    half_open = (side_a > 0.0) != (side_b > 0.0)
    along = spread == 0.0
    hit = (t >= -TOUCH_SHARE) & (t <= end + TOUCH_SHARE) & ~along
    hit_pair, hit_t = pair[hit], t[hit]
    if along.any():
        t_b = (to_x * gx + to_y * gy) / length_sq
        low, high = np.minimum(t, t_b), np.maximum(t, t_b)
        overlap = along & (high >= -TOUCH_SHARE) & (low <= end + TOUCH_SHARE)
        hit_pair = np.concatenate((hit_pair, pair[overlap], pair[overlap]))
        hit_t = np.concatenate((hit_t, low[overlap], high[overlap]))
    upright = hit_pair[last[hit_pair] == 0.0]
    if len(upright) > 0:  # all of a vertical segment meets the boundary: both its ends do
        hit_t = np.concatenate((hit_t * last[hit_pair], np.ones(len(upright))))
        hit_pair = np.concatenate((hit_pair, upright))
    return Contacts(
        pair=hit_pair,
        t=clamp01(hit_t),
        start_inside=odd_count(pair[half_open & (t < 0.0)], len(px)),
        end_inside=odd_count(pair[half_open & (t > end)], len(px)),
    )


def least_height(contacts: Contacts, start_z: FloatArray, end_z: FloatArray) -> FloatArray:
    """Return the least height of P segments over their polygons.

    Args:
        contacts: Contacts of the segments.
        start_z: (P,) height of each segment's start, metres.
        end_z: (P,) height of its end.

    Returns:
        (P,) metres, infinite where the segment does not meet the polygon.
    """
    least = np.where(contacts.start_inside, start_z, np.inf)
    least = np.where(contacts.end_inside, np.minimum(least, end_z), least)
    first = start_z[contacts.pair]
    np.minimum.at(least, contacts.pair, first + contacts.t * (end_z[contacts.pair] - first))
    return least
