# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Passage of waypoints in order, and what was flown between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.ticks import first_tick
from aurora_core.quantities.view import Body, RunView
from aurora_core.spec.vocabulary import Pattern

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Point3 = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Passage:
    """How a UAV passed one waypoint after the one before it.

    Attributes:
        tick: First sample inside the tolerance, None when it never was.
        nearest_tick: Sample of the closest approach: of this passage, or of the whole rest.
        nearest_m: Closest approach; metres from the point in the plane, or the altitude error
            scaled so that its tolerance is the same number, whichever is more.
    """

    tick: int | None
    nearest_tick: int
    nearest_m: float


def approach(
    point: FloatArray, waypoint: Point3, horizontal_m: float, vertical_m: float
) -> FloatArray:
    """Return how far positions are off a waypoint; visited where at most `horizontal_m`.

    Args:
        point: (T, 3) ENU metres.
        waypoint: ENU metres, z above ground.
        horizontal_m: Tolerance in the plane.
        vertical_m: Tolerance on the altitude.
    """
    plane = distance_2d(point[:, 0] - waypoint[0], point[:, 1] - waypoint[1])
    height = np.abs(point[:, 2] - waypoint[2]) * (horizontal_m / vertical_m)
    result: FloatArray = np.maximum(plane, height)
    return result


def passages(
    view: RunView,
    uav: Body,
    waypoints: Sequence[Point3],
    tolerances_m: tuple[float, float],
    start: int,
    stop: int,
) -> tuple[Passage, ...]:
    """Return the passage of each waypoint in order within the samples [start, stop).

    Args:
        view: The run.
        uav: Which UAV.
        waypoints: In the order in which they have to be visited.
        tolerances_m: In the plane, and on the altitude.
        start: First sample of the phase.
        stop: First sample after it; stop > start.

    A waypoint that is missed does not move the search on: the next one is looked for from the
    last waypoint that was visited.
    """
    point = view.reference(uav.body_id)
    found: list[Passage] = []
    begin = start
    for waypoint in waypoints:
        off = approach(point, waypoint, *tolerances_m)
        if begin >= stop:
            found.append(Passage(tick=None, nearest_tick=stop - 1, nearest_m=float(off[stop - 1])))
            continue
        inside = off <= tolerances_m[0]
        tick = first_tick(inside, begin, stop)
        if tick is None:
            low, high = begin, stop
        else:
            leave = first_tick(~inside, tick, stop)
            low, high = tick, stop if leave is None else leave
            begin = tick + 1
        nearest = low + int(np.argmin(off[low:high]))
        found.append(Passage(tick=tick, nearest_tick=nearest, nearest_m=float(off[nearest])))
    return tuple(found)


@dataclass(frozen=True, slots=True, kw_only=True)
class Leg:
    """The samples [start, stop) between the closest approaches of two waypoints in a row."""

    a: Point3
    b: Point3
    start: int
    stop: int


def legs(waypoints: Sequence[Point3], found: Sequence[Passage]) -> tuple[Leg, ...]:
    """Return the legs whose two ends were visited."""
    return tuple(
        Leg(a=a, b=b, start=before.nearest_tick, stop=after.nearest_tick)
        for (a, b), (before, after) in zip(pairwise(waypoints), pairwise(found), strict=True)
        if before.tick is not None
        and after.tick is not None
        and after.nearest_tick > before.nearest_tick
    )


def cruising(view: RunView, uav: Body, flown: Sequence[Leg], margin_m: float) -> BoolArray:
    """Return where a UAV is on a leg, farther than `margin_m` from both of its ends.

    Args:
        view: The run.
        uav: Which UAV.
        flown: Its legs.
        margin_m: Length of the way that it needs to reach its speed, and to brake.
    """
    point = view.reference(uav.body_id)
    mask = np.zeros(view.ticks, dtype=np.bool_)
    for leg in flown:
        part = point[leg.start : leg.stop]
        from_a = distance_2d(part[:, 0] - leg.a[0], part[:, 1] - leg.a[1])
        from_b = distance_2d(part[:, 0] - leg.b[0], part[:, 1] - leg.b[1])
        mask[leg.start : leg.stop] = (from_a > margin_m) & (from_b > margin_m)
    return mask


def pattern_centre(waypoints: Sequence[Point3]) -> tuple[float, float]:
    """Return the centre of the rectangle (map axes) that holds the waypoints, metres."""
    x = [point[0] for point in waypoints]
    y = [point[1] for point in waypoints]
    return (min(x) + max(x)) / 2.0, (min(y) + max(y)) / 2.0


# Points of a plan are rounded when they are written down, no more.
_SHAPE_M = 1e-3
# An orbit has more points than any other ring.
_ORBIT_POINTS = 12


def has_shape(pattern: Pattern, points: Sequence[Point3]) -> bool:
    """Tell whether planned waypoints have the shape of a pattern.

    Args:
        pattern: Rectangles and orbits are closed, a line has two points, a lawnmower goes to and
            fro on parallel lines; `waypoints` are in any order, and none of these.
        points: (x, y, z) metres, in the order flown.
    """
    closed = len(points) > 2 and points[0] == points[-1]
    if pattern is Pattern.LINE:
        return len(points) == 2
    if pattern is Pattern.RECTANGLE:
        return closed and len(points) == 5 and _turns_square(points)
    if pattern is Pattern.ORBIT:
        return closed and len(points) > _ORBIT_POINTS and _is_ring(points)
    if pattern is Pattern.LAWNMOWER:
        return not closed and len(points) >= 4 and len(points) % 2 == 0 and _turns_square(points)
    return not closed


def _turns_square(points: Sequence[Point3]) -> bool:
    legs = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)]
    return all(abs(a[0] * b[0] + a[1] * b[1]) <= _SHAPE_M * _way(a, b) for a, b in pairwise(legs))


def _way(a: tuple[float, float], b: tuple[float, float]) -> float:
    return max(abs(a[0]) + abs(a[1]), abs(b[0]) + abs(b[1]), 1.0)


def _is_ring(points: Sequence[Point3]) -> bool:
    x = sum(point[0] for point in points[:-1]) / (len(points) - 1)
    y = sum(point[1] for point in points[:-1]) / (len(points) - 1)
    away = [float(distance_2d(point[0] - x, point[1] - y)) for point in points]
    return max(away) - min(away) <= _SHAPE_M * max(max(away), 1.0)


def extent(points: npt.ArrayLike, axis: tuple[float, float]) -> float:
    """Return how far points reach along a direction.

    Args:
        points: (n, 2) or (n, 3) metres, n >= 1; heights do not count.
        axis: Unit vector (x, y).
    """
    rows = np.asarray(points, dtype=np.float64)
    along = rows[:, 0] * axis[0] + rows[:, 1] * axis[1]
    return float(np.max(along) - np.min(along))
