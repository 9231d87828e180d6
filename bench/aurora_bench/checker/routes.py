# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotated routes (mode navigate) against one flown mission."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from aurora_bench.checker import flights, limits, ways
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    all_of,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.flight import (
    Flight,
    altitude,
    avoided,
    is_free,
    leg_speed,
    level_of,
)
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.scene import runs_of

# A UAV gets faster at so much at least (m/s^2), and comes to its route in so long (s).
GAINS_MPS2, TO_ROUTE_S = 1.5, 4.0
# Speed on a route where none is stated.
USUAL_MPS = 8.0
# Nobody flies faster.
FASTEST_MPS = 18.0


def navigate(flight: Flight, requirement: Mapping[str, Any]) -> Judged:
    """Return whether the flown mission is the annotated route."""
    scene = flight.scene
    level, asked = level_of(flight, requirement)
    height = scene.altitude(flight.uav)[flight.ticks]
    band = limits.tolerance(limits.ALTITUDE, level)
    if asked is not None and asked.slack > 0.0:
        band = max(band, asked.high - level, level - asked.low)
    reached = np.flatnonzero((np.abs(height - level) <= band) | is_free(flight, requirement))
    if not len(reached):
        return does_not(f'never at the altitude of {level:.1f} m')
    start = flight.segment.start + int(reached[0])
    step = max(1, round(0.2 / scene.dt_s))
    # A climb on the way changes the height of a route, not its course.
    xy = scene.xy(flight.uav)[flight.segment.start : flight.segment.end : step]
    flown = all_of([altitude(flight, requirement, start), _pattern(flight, requirement, xy)])
    # The way there may lead over what stands in between: what counts is the whole of the route.
    later = _past_the_way(flight, np.abs(height - level) <= band, int(reached[0]))
    if flown.outcome is not Outcome.HOLDS and later is not None:
        rest = [
            altitude(flight, requirement, flight.segment.start + later),
            _pattern(flight, requirement, xy[later // step :]),
        ]
        flown = all_of(rest) if all(p.outcome is Outcome.HOLDS for p in rest) else flown
    speed = leg_speed(flight, requirement, flight.ticks)
    rest = [*_ends(flight, requirement), *avoided(flight, requirement)]
    return all_of([flown, speed, ways.level(flight, requirement), *rest])


def _past_the_way(flight: Flight, level: BoolArray, reached: int) -> int | None:
    """Return where a flight comes to its altitude again that it passed through on its way.

    Args:
        level: (ticks,) Whether it is at its altitude, from the beginning of the mission on.
        reached: Where it first is.
    """
    if flight.segment.number == 0:
        return None
    away = next((b for a, b in runs_of(~level) if a >= reached), None)
    return None if away is None or away >= len(level) else away


def _pattern(flight: Flight, requirement: Mapping[str, Any], xy: FloatArray) -> Judged:
    scene, places = flight.scene, flight.scene.places
    size, pattern = requirement.get('size_m'), requirement.get('pattern')
    judged: Judged
    centre: FloatArray | None = None
    match pattern:
        case 'rectangle' | 'lawnmower' if size:
            shape = flights.rectangle if pattern == 'rectangle' else flights.lawnmower
            judged, centre = shape(xy, [float(s) for s in size])
        case 'line' if size:
            judged, centre = flights.line(xy, float(size[0]))
        case 'orbit':
            turns = None if requirement.get('turns') is None else float(requirement['turns'])
            radius = requirement.get('radius_m')
            centres = [
                xy for t in flight.targets if not scene.is_body(t) for xy in _centres(places, t)
            ]
            own = requirement.get('radius_m')
            bodies = [t for t in flight.targets if scene.is_body(t)]
            if bodies:
                return _orbit_of_body(flight, bodies, own, turns, _share(flight, requirement))
            judged, centre = flights.orbit(
                xy, centres, radius and float(radius), turns, _share(flight, requirement)
            )
            return judged
        case 'street':
            return any_of([flights.street(xy, places, t) for t in flight.targets])
        case 'waypoints' | None:
            return _points(flight, requirement, xy)
        case _:
            flown = len(flights.corners(xy))
            if flown < (2 if pattern == 'line' else 3):
                return does_not(f'no {pattern}: the path has {flown} corners')
            judged = cannot_tell(f'{pattern} without a size: {flown} corners')
    parts = [judged]
    for target in flight.targets[:1]:
        if scene.is_body(target):
            parts.append(_over_body(flight, target, centre))
        elif places.is_region(target):
            parts.append(flights.over_road(xy, places, [float(s) for s in size or ()]))
        elif centre is not None and judged.outcome is Outcome.CANNOT_TELL:
            parts.append(cannot_tell('no clear pattern, so no clear centre'))
        elif centre is not None:
            parts.append(flights.centred(centre, places, target))
    return all_of(parts)


def _points(flight: Flight, requirement: Mapping[str, Any], xy: FloatArray) -> Judged:
    """Return whether a route of points has so many, around its target; a single one is there."""
    pattern, count = requirement.get('pattern'), requirement.get('waypoint_count')
    number = None if count is None else int(count)
    if number is None and pattern is None:
        there = _goes_there(flight, xy)
        about = _about(flight, xy) if flight.targets else there
        # A flight of no stated form may as well be one around it.
        return about if about.outcome is Outcome.HOLDS else there
    if number == 1 and flight.targets:
        return _goes_there(flight, xy)
    reached = flights.waypoints(xy, number or 2)
    if not flight.targets:
        return reached
    about = _about(flight, xy, number)
    # So many points around it, the first of which may be where the flight begins.
    regions = any(map(flight.scene.places.is_region, flight.targets))
    if number is not None and about.outcome is Outcome.HOLDS and not regions:
        return about
    return all_of([reached, about])


def _about(flight: Flight, xy: FloatArray, count: int | None = None) -> Judged:
    """Return whether a route of points has its middle at a target."""
    scene, places = flight.scene, flight.scene.places
    likely, others = flights.middles(xy, count)
    readings = []
    for target in flight.targets:
        if places.is_region(target) and not scene.is_body(target):
            readings.append(flights.over_road(xy, places))
            continue
        judged = [_middle(flight, target, middle) for middle in likely]
        if any(j.outcome is Outcome.HOLDS for j in judged):
            readings.append(any_of(judged))
        elif any(_middle(flight, target, m).outcome is Outcome.HOLDS for m in others):
            readings.append(cannot_tell(f'which points are those around {target} does not show'))
        else:
            readings.append(any_of(judged) if judged else does_not(f'not around {target}'))
    return any_of(readings)


def _middle(flight: Flight, target: str, middle: FloatArray) -> Judged:
    if flight.scene.is_body(target):
        return _over_body(flight, target, middle)
    return flights.centred(middle, flight.scene.places, target)


def _centres(places: Any, name: str) -> Sequence[Any]:
    """Return what is gone round when a place is: its position, or the middle of its building."""
    spots = (*places.chosen(name), *places.spots(name)[:40])
    middles = [s.outline.centroid for s in spots if s.outline is not None]
    return (*(s.xy for s in spots), *(np.array([m.x, m.y]) for m in middles))


def _share(flight: Flight, requirement: Mapping[str, Any]) -> float:
    """Return for what share of a circle a stated duration leaves time, 1 for a whole one."""
    radius, lasts = requirement.get('radius_m'), requirement.get('duration_s')
    if radius is None or lasts is None:
        return 1.0
    around = 2.0 * np.pi * float(radius)
    speed = requirement.get('speed_mps')
    top = FASTEST_MPS
    if speed is not None:
        top = min(top, float(speed) + limits.tolerance(limits.SPEED, float(speed)))
    # It gets faster and brakes, both at less than it can.
    if around / top + top / GAINS_MPS2 <= float(lasts):
        return 1.0
    usual = USUAL_MPS if speed is None else float(speed)
    flown = float(lasts) - TO_ROUTE_S - usual / GAINS_MPS2
    return float(min(1.0, max(0.0, usual * flown) / around))


def _orbit_of_body(
    flight: Flight, bodies: Sequence[str], radius: Any, turns: float | None, most: float
) -> Judged:
    """Return whether a body is circled, where it stood at t = 0 or where it is."""
    scene = flight.scene
    step = max(1, round(0.2 / scene.dt_s))
    whole = slice(flight.segment.start, flight.segment.end, step)
    uav = scene.xy(flight.uav)[whole]
    size = None if radius is None else float(radius)
    readings = []
    for body in bodies:
        moving = scene.xy(body)[whole]
        readings.append(flights.orbit(uav, [scene.xy(body)[0]], size, turns, most)[0])
        readings.append(flights.orbit(uav - moving, [np.zeros(2)], size, turns, most)[0])
    return any_of(readings)


def _over_body(flight: Flight, target: str, centre: FloatArray | None) -> Judged:
    if centre is None:
        return holds('')
    away = float(np.linalg.norm(flight.scene.xy(target)[0] - centre))
    return decide(away <= limits.CENTRED_M, f'centre {away:.1f} m from {target} at t = 0')


def _goes_there(flight: Flight, xy: FloatArray) -> Judged:
    """Return whether a flight without a pattern reaches its target."""
    scene, readings = flight.scene, []
    for target in flight.targets:
        if scene.is_body(target):
            away = scene.distance(flight.uav, target, horizontal=True)[flight.ticks]
        elif scene.places.known(target):
            away = scene.places.outline_distance(target, xy)
        else:
            continue
        least = float(np.fmin.reduce(away))
        readings.append(decide(least <= limits.CENTRED_M, f'within {least:.1f} m of {target}'))
    return any_of(readings) if readings else cannot_tell('a route of unknown shape')


def _ends(flight: Flight, requirement: Mapping[str, Any]) -> list[Judged]:
    parts = []
    xy = flight.scene.xy(flight.uav)[flight.segment.start : flight.ticks.stop]
    for field in ('start', 'end'):
        place = requirement.get(field)
        if not isinstance(place, str) or not flight.scene.places.known(place):
            continue
        away = flight.scene.places.outline_distance(place, xy)
        half = away[: len(away) // 2] if field == 'start' else away[len(away) // 2 :]
        least = float(half.min()) if len(half) else np.inf
        why = f'{field} {least:.1f} m from {place}'
        parts.append(graded(least <= limits.CENTRED_M, least <= 30.0, why))
    return parts
