# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much street there is around a point."""

from __future__ import annotations

from collections.abc import Iterable

import numpy.typing as npt
import shapely

# Lanes of one street that are no farther apart than this are one street (m).
_STREET_M = 14.0


def street_length_m(
    lanes: Iterable[tuple[str, npt.ArrayLike]], centre: tuple[float, float], radius_m: float
) -> float:
    """Return the metres of street within a circle, each counted once whatever its carriageways.

    Args:
        lanes: Name of the street and centre line (K, 2) of each driving lane, ENU metres.
        centre: Of the circle (x, y in m).
        radius_m: Of the circle.
    """
    circle = shapely.Point(centre).buffer(radius_m)
    counted: dict[str, shapely.Geometry] = {}
    total_m = 0.0
    for name, points in lanes:
        inside = shapely.LineString(points).intersection(circle)
        if inside.is_empty:
            continue
        before = counted.get(name, shapely.Polygon())
        total_m += float(inside.difference(before).length)
        counted[name] = before.union(inside.buffer(_STREET_M, cap_style='flat'))
    return total_m
