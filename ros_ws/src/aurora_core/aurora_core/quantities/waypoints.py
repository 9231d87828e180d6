# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Passage of waypoints in order, and what was flown between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.quantities.angle import compass_bearing_deg, turned_deg
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.ticks import first_tick
from aurora_core.quantities.view import Body, RunView
from aurora_core.spec.vocabulary import Pattern

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]
Point3 = tuple[float, float, float]

# A turn sharper than this (cosine of the change of course) is a corner to slow down for.
CORNER_COSINE = 0.94


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
    point: FloatArray,
    waypoints: Sequence[Point3],
    tolerances_m: tuple[float, float],
    start: int,
    stop: int,
) -> tuple[Passage, ...]:
    """Return the passage of each waypoint in order within the samples [start, stop).

    Args:
        point: (T, 3) where the UAV is, ENU metres.
        waypoints: In the order in which they have to be visited.
        tolerances_m: In the plane, and on the altitude.
        start: First sample of the phase.
        stop: First sample after it; stop > start.

    A waypoint that is missed does not move the search on: the next one is looked for from the
    last waypoint that was visited.
    """
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
    """Return where a UAV is on a leg, farther than `margin_m` from where it has to be slow.

    That is at the ends of its route and at corners: the chords of an orbit are one way.

    Args:
        view: The run.
        uav: Which UAV.
        flown: Its legs.
        margin_m: Length of the way that it needs to reach its speed, and to brake.
    """
    point = view.reference(uav.body_id)
    mask = np.zeros(view.ticks, dtype=np.bool_)
    behind = _run_up_m(flown)
    ahead = _run_up_m([replace(leg, a=leg.b, b=leg.a) for leg in reversed(flown)])[::-1]
    for leg, before_m, after_m in zip(flown, behind, ahead, strict=True):
        part = point[leg.start : leg.stop]
        from_a = distance_2d(part[:, 0] - leg.a[0], part[:, 1] - leg.a[1])
        from_b = distance_2d(part[:, 0] - leg.b[0], part[:, 1] - leg.b[1])
        fast = (from_a + before_m > margin_m) & (from_b + after_m > margin_m)
        mask[leg.start : leg.stop] = fast
    return mask


def _run_up_m(flown: Sequence[Leg]) -> list[float]:
    """Return the way without a corner before each leg, metres."""
    found = [0.0] if flown else []
    for before, leg in pairwise(flown):
        smooth = before.b == leg.a and not _is_corner(before, leg)
        found.append(found[-1] + _length_m(before) if smooth else 0.0)
    return found


def _is_corner(one: Leg, other: Leg) -> bool:
    """Tell whether the course changes so much that a UAV slows down for it."""
    (ax, ay), (bx, by) = ((leg.b[0] - leg.a[0], leg.b[1] - leg.a[1]) for leg in (one, other))
    return ax * bx + ay * by < CORNER_COSINE * _length_m(one) * _length_m(other)


def _length_m(leg: Leg) -> float:
    return float(distance_2d(leg.b[0] - leg.a[0], leg.b[1] - leg.a[1]))


def pattern_centre(waypoints: Sequence[Point3]) -> tuple[float, float]:
    """Return the centre of a pattern, metres: of the circle of a part of an orbit.

    Of all others it is that of the rectangle (map axes) that holds the waypoints.
    """
    middle = arc_centre(waypoints)
    if middle is not None:
        return middle
    x = [point[0] for point in waypoints]
    y = [point[1] for point in waypoints]
    return (min(x) + max(x)) / 2.0, (min(y) + max(y)) / 2.0


def arc_centre(points: Sequence[Point3]) -> tuple[float, float] | None:
    """Return the centre (m) of the circle of which points are a part, None where they are not.

    They are open, and go on in steps of an orbit.
    """
    if len(points) < 3 or points[0] == points[-1]:
        return None
    (ax, ay, _), (bx, by, _), (cx, cy, _) = points[0], points[len(points) // 2], points[-1]
    bx, by, cx, cy = bx - ax, by - ay, cx - ax, cy - ay
    twice = 2.0 * (bx * cy - by * cx)
    if abs(twice) <= _SHAPE_M:
        return None
    b2, c2 = bx * bx + by * by, cx * cx + cy * cy
    x, y = ax + (cy * b2 - by * c2) / twice, ay + (bx * c2 - cx * b2) / twice
    east, north = np.array([p[0] - x for p in points]), np.array([p[1] - y for p in points])
    return (x, y) if _is_even(east, north) and _is_fine(east, north) else None


def longest_leg(waypoints: Sequence[Point3]) -> tuple[Point3, Point3]:
    """Return the two ends of the longest leg between waypoints, the first of equal ones."""
    return max(pairwise(waypoints), key=lambda leg: norm2(*_across(leg)))


def _across(leg: tuple[Point3, Point3]) -> tuple[float, float]:
    a, b = leg
    return b[0] - a[0], b[1] - a[1]


# Points of a plan are rounded when they are written down, no more.
_SHAPE_M = 1e-3
_SHAPE_DEG = 0.1
# The points of an orbit are no farther apart on its circle: its chords keep within 0.4 % of the
# radius.
ORBIT_STEP_DEG = 10.0


def has_shape(pattern: Pattern, points: Sequence[Point3], *, in_part: bool = False) -> bool:
    """Tell whether planned waypoints have the shape of a pattern.

    Args:
        pattern: Rectangles and orbits are closed, a line has two points, a lawnmower goes to and
            fro on parallel lines; `waypoints` are in any order, and none of these.
        points: (x, y, z) metres, in the order flown. Lines, rectangles and orbits may be flown
            several times.
        in_part: There is no time for a whole orbit.
    """
    if in_part and pattern is Pattern.ORBIT and arc_centre(points) is not None:
        return True
    if pattern is Pattern.LINE:
        return len(points) >= 2 and _first_lap(points)[1:-1] in ((), (points[1],))
    if pattern in (Pattern.RECTANGLE, Pattern.ORBIT):
        points = _first_lap(points)
    closed = len(points) > 2 and points[0] == points[-1]
    if pattern is Pattern.RECTANGLE:
        return closed and len(points) == 5 and _turns_square(points)
    if pattern is Pattern.ORBIT:
        return closed and _is_ring(points)
    if pattern is Pattern.LAWNMOWER:
        return not closed and len(points) >= 4 and len(points) % 2 == 0 and _turns_square(points)
    return not closed


def _first_lap(points: Sequence[Point3]) -> Sequence[Point3]:
    """Return the first lap of points that go round again and again; the last lap may be cut."""
    lap = next((k for k, point in enumerate(points) if k > 0 and point == points[0]), None)
    if lap is None:
        return points
    again = [k for k in range(len(points)) if points[k] != points[k % lap]]
    cut = len(points) - 1
    on_its_leg = again == [cut] and _is_between(points[cut], points[cut - 1], points[cut % lap])
    return points[: lap + 1] if not again or on_its_leg else points


def _is_between(point: Point3, a: Point3, b: Point3) -> bool:
    """Tell whether a point is on the leg from a to b."""
    there, onward = (float(distance_2d(point[0] - c[0], point[1] - c[1])) for c in (a, b))
    whole = float(distance_2d(b[0] - a[0], b[1] - a[1]))
    return abs(there + onward - whole) <= _SHAPE_M * max(whole, 1.0)


def _turns_square(points: Sequence[Point3]) -> bool:
    legs = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(points)]
    return all(abs(a[0] * b[0] + a[1] * b[1]) <= _SHAPE_M * _way(a, b) for a, b in pairwise(legs))


def _way(a: tuple[float, float], b: tuple[float, float]) -> float:
    return max(abs(a[0]) + abs(a[1]), abs(b[0]) + abs(b[1]), 1.0)


def _is_ring(points: Sequence[Point3]) -> bool:
    """Tell whether points lie on a circle and go round it once, in steps of an orbit."""
    east, north = _from_middle(points)
    if not _is_even(east, north) or not _is_fine(east, north):
        return False
    turned = turned_deg(compass_bearing_deg(east, north))
    return abs(abs(float(turned[-1])) - 360.0) <= _SHAPE_DEG


def _is_even(east: FloatArray, north: FloatArray) -> bool:
    """Tell whether points are as far from their middle as each other."""
    away = distance_2d(east, north)
    return bool(np.max(away) - np.min(away) <= _SHAPE_M * max(float(np.max(away)), 1.0))


def _is_fine(east: FloatArray, north: FloatArray) -> bool:
    """Tell whether points go round their middle in steps of an orbit."""
    turned = turned_deg(compass_bearing_deg(east, north))
    return bool(np.all(np.abs(np.diff(turned)) <= ORBIT_STEP_DEG + _SHAPE_DEG))


def orbit_radius_m(points: Sequence[Point3]) -> float:
    """Return how far the points of a planned orbit are from their middle, metres."""
    middle = arc_centre(points)
    if middle is not None:
        return float(distance_2d(points[0][0] - middle[0], points[0][1] - middle[1]))
    return float(distance_2d(*_from_middle(_first_lap(points)))[0])


def _from_middle(points: Sequence[Point3]) -> tuple[FloatArray, FloatArray]:
    """Return the points of a closed ring as seen from the mean of all of them (x, y in m)."""
    x = sum(point[0] for point in points[:-1]) / (len(points) - 1)
    y = sum(point[1] for point in points[:-1]) / (len(points) - 1)
    return np.array([p[0] - x for p in points]), np.array([p[1] - y for p in points])


def extent(points: npt.ArrayLike, axis: tuple[float, float]) -> float:
    """Return how far points reach along a direction.

    Args:
        points: (n, 2) or (n, 3) metres, n >= 1; heights do not count.
        axis: Unit vector (x, y).
    """
    rows = np.asarray(points, dtype=np.float64)
    along = rows[:, 0] * axis[0] + rows[:, 1] * axis[1]
    return float(np.max(along) - np.min(along))
