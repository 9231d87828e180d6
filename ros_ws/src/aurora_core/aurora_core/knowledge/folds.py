# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lanes that fold back on themselves: networks have them where short roads were joined."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from itertools import pairwise

from aurora_core.geometry.frames import heading_to_yaw_enu
from aurora_core.knowledge.net_types import Connection, Lane, Point

# From one lane to the next no street turns so sharply.
_FOLD_RAD = math.radians(100.0)
_TURNING_ROUND = 't'


def folds_back_m(link: Connection, lanes: Mapping[str, Lane]) -> float:
    """Return how far one jumps back and forth where a connection folds, metres; 0: it does not.

    Turning round is no fold.
    """
    if link.direction == _TURNING_ROUND:
        return 0.0
    ways = [lanes[name] for name in (link.from_lane_id, *link.via_lane_ids, link.to_lane_id)]
    return max(_backwards_m(ways), default=0.0)


def _backwards_m(ways: list[Lane]) -> Iterator[float]:
    for before, after in pairwise(ways):
        ends, begins = _heading(*before.polyline[-2:]), _heading(*after.polyline[:2])
        if abs((begins - ends + math.pi) % math.tau - math.pi) > _FOLD_RAD:
            # What lies over the other is as long as the shorter of the two, or their junction.
            inside = [lane.arc_length_m for lane in (before, after) if lane.is_internal]
            yield min(inside or [before.arc_length_m, after.arc_length_m])


def _heading(a: Point, b: Point) -> float:
    return heading_to_yaw_enu(b[0] - a[0], b[1] - a[1])
