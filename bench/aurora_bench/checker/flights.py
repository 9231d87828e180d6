# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shapes of flown routes: rectangles, lines, lawnmowers, orbits, waypoints, streets."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence

import numpy as np
import shapely

from aurora_bench.checker import limits
from aurora_bench.checker.answers import (
    Judged,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
)
from aurora_bench.checker.places import Places
from aurora_bench.checker.recording import FloatArray

# A corner that is rounded is missed by a little; its nominal place is not recorded.
DOUBT_M = 3.0
CORNER_M = 2.0
# A flight to the first waypoint and one back from the last may hang on a pattern.
SPARE_CORNERS = 3
# Points of a route where no number is stated.
USUAL_POINTS = 4
# So much of a circle may be flown on the way to its first point.
ORBIT_DOUBT_DEG = 60.0


def corners(xy: FloatArray, tolerance_m: float = CORNER_M) -> list[int]:
    """Return indices at which a path turns (its ends included), by Douglas and Peucker."""
    if len(xy) < 2 or np.ptp(xy, axis=0).max() < tolerance_m:
        return [0]
    simple = shapely.get_coordinates(
        shapely.LineString(xy).simplify(tolerance_m, preserve_topology=False)
    )
    found: list[int] = []
    at = 0
    for point in simple:
        rest = np.abs(xy[at:] - point).sum(axis=1)
        at += int(rest.argmin()) if not found or found[-1] == at else int((rest < 1e-9).argmax())
        found.append(at)
    return sorted(set(found))


def _parts(xy: FloatArray) -> Iterator[FloatArray]:
    """Yield the path without the ways to and from the pattern."""
    turns = corners(xy)
    for first, last in itertools.product(range(SPARE_CORNERS + 1), range(SPARE_CORNERS)):
        if first + last + 1 < len(turns):
            yield xy[turns[first] : turns[len(turns) - 1 - last] + 1]


def _ring(path: FloatArray) -> FloatArray:
    """Return a path from where it passes its end: a way in may run on as the first side."""
    begin = path[: len(path) // 2 + 1]
    return path[int(np.argmin(np.linalg.norm(begin - path[-1], axis=1))) :]


def _box(path: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, float, float] | None:
    """Return centre, unit vectors and sides (long one first) of the least box round a path."""
    box = shapely.minimum_rotated_rectangle(shapely.MultiPoint(path))
    if box.geom_type != 'Polygon':
        points = shapely.get_coordinates(box)
        span = points[-1] - points[0]
        length = float(np.linalg.norm(span))
        if length < 1e-6:
            return None
        e = span / length
        return points.mean(axis=0), e, np.array([-e[1], e[0]]), length, 0.0
    ring = shapely.get_coordinates(box)[:4]
    u, v = ring[1] - ring[0], ring[2] - ring[1]
    if np.linalg.norm(v) > np.linalg.norm(u):
        u, v = v, u
    a, b = float(np.linalg.norm(u)), float(np.linalg.norm(v))
    return ring.mean(axis=0), u / max(a, 1e-9), v / max(b, 1e-9), a, b


def rectangle(xy: FloatArray, size_m: Sequence[float]) -> tuple[Judged, FloatArray | None]:
    """Return whether a rectangle of this size was flown round, and its centre."""
    long, short = max(size_m), min(size_m)
    line = shapely.LineString(xy) if len(xy) > 1 else shapely.Point(xy[0])
    least, centre, sides = np.inf, None, (0.0, 0.0)
    for path in (part for whole in _parts(xy) for part in (whole, _ring(whole))):
        found = _box(path)
        if found is None:
            continue
        middle, u, v, a, b = found
        signs = np.array([(1, 1), (1, -1), (-1, -1), (-1, 1), (1, 0), (0, 1), (-1, 0), (0, -1)])
        spots = middle + signs[:, :1] * u * long / 2.0 + signs[:, 1:] * v * short / 2.0
        flown = shapely.LineString(path)
        miss = max(flown.distance(shapely.Point(p)) for p in spots)
        miss = max(miss, (abs(a - long) - limits.WAYPOINT_M) / 2.0)
        miss = max(miss, (abs(b - short) - limits.WAYPOINT_M) / 2.0)
        if flown.length < 0.9 * 2.0 * (long + short):
            miss = max(miss, long)
        if miss < least:
            least, centre, sides = float(miss), middle, (a, b)
    why = f'best rectangle {sides[0]:.1f} x {sides[1]:.1f} m, corners missed by {least:.1f} m'
    why += f' (asked {long:g} x {short:g} m, {line.length:.0f} m flown)'
    judged = graded(least <= limits.WAYPOINT_M, least <= limits.WAYPOINT_M + DOUBT_M, why)
    return judged, centre


def lawnmower(xy: FloatArray, size_m: Sequence[float]) -> tuple[Judged, FloatArray | None]:
    """Return whether an area of this size was flown over in parallel legs, and its centre."""
    long, short = max(size_m), min(size_m)
    best, centre, why = 0, None, 'no parallel legs'
    nearest = np.inf
    for path in _parts(xy):
        found = _box(path)
        if found is None:
            continue
        middle, u, v, a, b = found
        off = max(abs(a - long), abs(b - short))
        legs = max(_legs(path, u), _legs(path, v))
        spacing = short / max(legs - 1, 1)
        # Where the outer legs lie (on the edge or half a spacing inside) the contract leaves open.
        sure = off <= 2.0 * limits.WAYPOINT_M
        maybe = a >= long - spacing - 6.0 and b >= short - spacing - 6.0 and off <= spacing + 6.0
        grade = 0 if legs < 3 else 2 if sure else 1 if maybe else 0
        # With a leg less and the way there the box may be as large, but lie elsewhere.
        if grade > best or centre is None or (grade == best and off < nearest):
            best, centre, nearest = grade, middle, off
            why = f'{legs} legs over {a:.1f} x {b:.1f} m (asked {long:g} x {short:g} m)'
    return graded(best == 2, best >= 1, why), centre


def _legs(path: FloatArray, axis: FloatArray) -> int:
    """Return how often a path runs back or forth along an axis (20 m at least)."""
    position = (path - path.mean(axis=0)) @ axis
    legs, low, high, direction = 0, position[0], position[0], 0
    for value in position:
        low, high = min(low, value), max(high, value)
        if direction >= 0 and value < high - 20.0:
            legs, direction, low = legs + 1 if direction else legs, -1, value
        elif direction <= 0 and value > low + 20.0:
            legs, direction, high = legs + 1 if direction else legs, 1, value
    return legs + 1 if direction else 0


def line(xy: FloatArray, length_m: float) -> tuple[Judged, FloatArray | None]:
    """Return whether a straight line of this length was flown, and its centre."""
    turns = corners(xy)
    least, centre, led_in = np.inf, None, None
    for i, j in itertools.combinations(turns, 2):
        chord = xy[j] - xy[i]
        flown = float(np.linalg.norm(chord))
        normal = np.array([-chord[1], chord[0]]) / max(flown, 1e-9)
        bent = float(np.abs((xy[i : j + 1] - xy[i]) @ normal).max()) - 1.0
        miss = max(abs(flown - length_m) / 2.0, bent)
        if miss < least:
            least, centre = miss, (xy[i] + xy[j]) / 2.0
        if i == turns[0] and flown > length_m and bent <= limits.WAYPOINT_M:
            led_in = xy[j] - chord / flown * length_m / 2.0
    why = f'best straight leg misses the ends of {length_m:g} m by {least:.1f} m'
    doubt = least <= limits.WAYPOINT_M + DOUBT_M
    if not doubt and led_in is not None:
        # The way to the first point may lie in line with it: where one ends does not show.
        doubt, centre = True, led_in
        why += ', the way there may be part of it'
    return graded(least <= limits.WAYPOINT_M, doubt, why), centre


def _swept(angle: FloatArray) -> float:
    """Return the greatest change of an angle from some sample to a later one, either way."""
    up = float(np.max(angle - np.minimum.accumulate(angle)))
    down = float(np.max(np.maximum.accumulate(angle) - angle))
    return max(up, down)


def orbit(
    xy: FloatArray,
    centres: Sequence[FloatArray],
    radius_m: float | None,
    turns: float | None,
    most: float = 1.0,
) -> tuple[Judged, FloatArray | None]:
    """Return whether a circle was flown round one of the centres (without one: anywhere).

    Args:
        radius_m: None: any one radius, kept within the tolerance.
        turns: How many times round; None: once at least, or as far as there is time.
        most: For what share of a circle there is time.
    """
    asked = 360.0 * (most if turns is None else turns)
    best, centre, why = -np.inf, None, 'no path'
    for middle in centres or [_fitted_centre(xy)]:
        delta = xy - middle
        away = np.hypot(delta[:, 0], delta[:, 1])
        radius = float(np.median(away[len(away) // 3 :])) if radius_m is None else radius_m
        near = np.abs(away - radius) <= limits.tolerance(limits.STANDOFF, radius)
        angle = np.unwrap(np.arctan2(delta[:, 1], delta[:, 0]))
        swept = 0.0
        edges = np.diff(np.concatenate([[False], near, [False]]).astype(np.int8))
        for a, b in zip(np.flatnonzero(edges == 1), np.flatnonzero(edges == -1), strict=True):
            swept = max(swept, _swept(angle[a:b]))
        if swept > best:
            best, centre = swept, middle
            why = f'{np.degrees(swept):.0f} degrees at {radius:.0f} m'
            why += f' (asked {asked / 360.0:g} turns)'
    over = float(np.degrees(best)) - asked
    enough = over >= -limits.ORBIT_DEG
    if turns is None:
        return decide(enough, why), centre
    # The way to the first point of the circle may lie on it.
    return graded(
        enough and over <= limits.ORBIT_DEG, enough and over <= ORBIT_DOUBT_DEG, why
    ), centre


def _fitted_centre(xy: FloatArray) -> FloatArray:
    """Return the centre of the circle that fits the later two thirds of a path best."""
    path = xy[len(xy) // 3 :]
    middle = path.mean(axis=0)
    x, y = (path - middle).T
    matrix = np.column_stack([2.0 * x, 2.0 * y, np.ones(len(x))])
    solution = np.linalg.lstsq(matrix, x**2 + y**2, rcond=None)[0]
    return np.asarray(middle + solution[:2])


def waypoints(xy: FloatArray, count: int) -> Judged:
    """Return whether at least so many points were flown to; points in line cannot be seen."""
    turns = corners(xy)
    found = len(turns) - 1
    if found >= count:
        return decide(True, f'{found} turning points (asked {count})')
    if found < 1:
        return does_not('the UAV flies nowhere')
    return cannot_tell(f'{found} turning points; {count} waypoints may lie in line')


def middles(xy: FloatArray, count: int | None) -> tuple[list[FloatArray], list[FloatArray]]:
    """Return the middles (m) that a route of points may have: the likely ones, and all others.

    The middle of points is that of their box (map axes), or their mean. Before the first point
    there is a way, after the last there may be one; without a count one leg leads there, or it
    is the usual number.

    Args:
        xy: The path.
        count: How many points are asked; None for any.
    """
    points = xy[corners(xy)]
    fewest = 2 if count is None else count
    likely: list[FloatArray] = []
    others: list[FloatArray] = []
    for first, last in itertools.product(range(len(points)), range(SPARE_CORNERS)):
        part = points[first : len(points) - last]
        if len(part) < min(fewest, len(points)):
            continue
        is_it = len(part) == (count or USUAL_POINTS) or (count is None and first == 1)
        found = [(part.min(axis=0) + part.max(axis=0)) / 2.0, part.mean(axis=0)]
        (likely if is_it and not last else others).extend(found)
    if len(points) > 1 and (count is None or len(points) <= count):
        # The first point may lie in line with the way there.
        way = points[1] - points[0]
        for share in np.linspace(0.0, 1.0, max(2, round(float(np.linalg.norm(way))))):
            part = np.vstack([points[0] + share * way, points[1:]])
            others.append((part.min(axis=0) + part.max(axis=0)) / 2.0)
    return likely, others


def street(xy: FloatArray, places: Places, name: str) -> Judged:
    """Return whether a path leads along a street."""
    lanes = [c for c in places.world.lanes if c.street.casefold() == name.casefold()]
    if not lanes:
        return cannot_tell(f'no street {name!r} in the recorded world')
    lines = shapely.union_all([shapely.LineString(c.xy_m) for c in lanes])
    along = np.asarray(shapely.distance(lines, shapely.points(xy))) <= limits.CENTRED_M
    flown = float(np.linalg.norm(np.diff(xy, axis=0), axis=1)[along[1:]].sum())
    return graded(flown >= 0.8 * lines.length / 2, flown >= 50.0, f'{flown:.0f} m along {name}')


def over_road(xy: FloatArray, places: Places, size: Sequence[float] = ()) -> Judged:
    """Return whether one leg of a path lies over a carriageway.

    Args:
        size: Sides of the pattern: what the first leg has beyond one is the way there.
    """
    turns = corners(xy)
    road = places.carriageway()
    shares = []
    legs = list(itertools.pairwise(turns))
    if legs:
        left = np.linalg.norm(xy[turns[1]] - xy[: turns[1] + 1], axis=1)
        legs += [(int(np.argmax(left <= s)), turns[1]) for s in size if 0.0 < s < left[0]]
    for i, j in legs:
        points = xy[i : j + 1 : max(1, (j - i) // 40)]
        if np.linalg.norm(xy[j] - xy[i]) > 10.0:
            inside = shapely.distance(road, shapely.points(points)) <= limits.WAYPOINT_M
            shares.append(float(np.mean(inside)))
    best = max(shares, default=0.0)
    return graded(best >= 0.9, best >= 0.75, f'{best:.0%} of the best leg lies over a carriageway')


def centred(centre: FloatArray | None, places: Places, name: str) -> Judged:
    """Return whether the centre of a pattern is a place, within 10 m."""
    if centre is None:
        return cannot_tell('no pattern, so no centre')
    spots = places.chosen(name)
    if not spots:
        return cannot_tell(f'no place {name!r} in the recorded world')
    point = shapely.Point(centre)
    readings = []
    for spot in (*spots, *places.spots(name)):
        away = float(np.hypot(centre[0] - spot.x_m, centre[1] - spot.y_m))
        if spot.outline is not None:
            middle = spot.outline.centroid
            away = min(away, float(middle.distance(point)))
        readings.append(decide(away <= limits.CENTRED_M, f'centre {away:.1f} m from {name}'))
    return any_of(readings)
