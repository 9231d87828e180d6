# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One annotated mission against one flown mission."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.answers import (
    Judged,
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
from aurora_bench.checker.flights import corners
from aurora_bench.checker.numbers import wanted
from aurora_bench.checker.places import GENERAL
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.routes import navigate
from aurora_bench.checker.scene import share
from aurora_bench.checker.sight import visible

# The hover point is not recorded; the median of the phase stands for it, with this doubt.
HOVER_DOUBT_M = 1.0
HOVER_POINT_DOUBT_M = 0.5
# Marks the reading of a tracking without a stated standoff as one from above.
ABOVE = 'from above'
# A stated bound on the drift of a hover, m.
DRIFT = 'stated drift'
# Marks a hover at a place that is not known.
SOMEWHERE = 'somewhere'


def judge(flight: Flight, requirement: Mapping[str, Any]) -> Judged:
    """Return whether the flown mission is the annotated one.

    Args:
        requirement: Of kind `mission`, or the action `change_mission` of an event.
    """
    match requirement.get('mode'):
        case 'hover':
            return _hover(flight, requirement)
        case 'track':
            return _track(flight, requirement)
        case 'navigate':
            return navigate(flight, requirement)
        case None:
            return altitude(flight, requirement, flight.segment.start)
        case mode:
            return cannot_tell(f'mode {mode!r} is not known')


def captured_tick(flight: Flight, requirement: Mapping[str, Any]) -> int | None:
    """Return when the mission first meets its tolerance (its start for a route)."""
    mode = requirement.get('mode')
    if mode == 'hover':
        return _hover_capture(flight, requirement)[1]
    if mode == 'track':
        for target in flight.targets:
            if flight.scene.is_body(target):
                ticks = np.flatnonzero(tracked(flight, requirement, target)[0][flight.ticks])
                if len(ticks):
                    return flight.segment.start + int(ticks[0])
        return None
    # The way to a route is no part of it: it ends where the path turns first.
    turns = corners(flight.scene.xy(flight.uav)[flight.ticks])
    return flight.segment.start + (turns[1] if len(turns) > 2 else 0)


def _duration(flight: Flight, requirement: Mapping[str, Any], early: int, late: int) -> Judged:
    asked = wanted(requirement, 'duration_s', flight.variation, limits.DURATION)
    if asked is None:
        return holds('')
    scene, end = flight.scene, flight.segment.end
    if not flight.segment.closed:
        last = (end - 1 - early) * scene.dt_s
        why = f'flown for {last:.2f} s when the recording ends, asked {asked.text()} s'
        return graded(False, last >= asked.low, why)
    least, most = (end - late) * scene.dt_s, (end - early) * scene.dt_s
    why = f'phase of {least:.2f} s'
    why += f' to {most:.2f} s' if most > least else ''
    slack = 2 * scene.dt_s
    ok = (flight.cut or most >= asked.low - slack) and least <= asked.high + slack
    why += ', ended by its event' if flight.cut else ''
    return decide(ok, f'{why}, asked {asked.text()} s')


def _seen(flight: Flight, start: int) -> Judged:
    """Return whether the target was seen for the default share of the phase."""
    parts = []
    for target in flight.targets:
        if not flight.scene.is_body(target) and flight.scene.places.is_region(target):
            return holds('')
        seen = visible(flight.scene, flight.uav, target)[start : flight.ticks.stop]
        parts.append(
            decide(share(seen) >= limits.VISIBLE_SHARE, f'{target} visible {share(seen):.1%}')
        )
    return any_of(parts) if parts else holds('')


# ---- hover


def _stays(flight: Flight) -> tuple[slice, BoolArray]:
    """Return the second half of a flight (the first may be a way), and where it stands still."""
    # A climb leaves it where it is.
    ticks = slice((flight.segment.start + flight.segment.end) // 2, flight.segment.end)
    return ticks, flight.scene.speed(flight.uav)[ticks] < limits.STARTED_MPS


def _hover_point(flight: Flight) -> FloatArray:
    """Return where a UAV stays in the end."""
    ticks, still = _stays(flight)
    xy = flight.scene.xy(flight.uav)[ticks]
    return np.asarray(np.median(xy[still] if still.any() else xy, axis=0))


def _hover_capture(
    flight: Flight, requirement: Mapping[str, Any]
) -> tuple[int | None, int | None]:
    """Return the earliest and the latest tick that count as the capture of a hover."""
    scene = flight.scene
    level, asked = level_of(flight, requirement)
    height = scene.altitude(flight.uav)[flight.ticks]
    band = limits.tolerance(limits.ALTITUDE, level)
    if asked is not None and asked.slack > 0.0:
        band = max(band, asked.high - level, level - asked.low)
    away = np.linalg.norm(scene.xy(flight.uav)[flight.ticks] - _hover_point(flight), axis=1)
    drift = limits.HOVER_DRIFT_WIND_M if scene.windy else limits.HOVER_DRIFT_CALM_M
    # A stated bound takes the place of the one that is not.
    drift = min(drift, float(requirement.get(DRIFT, drift)))
    at_level = (np.abs(height - level) <= band) | is_free(flight, requirement)
    early = np.flatnonzero(at_level & (away <= drift + HOVER_POINT_DOUBT_M))
    surely = max(drift - HOVER_POINT_DOUBT_M, drift / 2.0)
    late = np.flatnonzero(at_level & (away <= surely))
    first = flight.segment.start
    if not len(early):
        return None, None
    earliest = first + int(early[0])
    if len(late):
        return earliest, first + int(late[0])
    # A climb may have waited for just that.
    return earliest, max(earliest, flight.until) if flight.climbs else earliest


def _hover(flight: Flight, requirement: Mapping[str, Any]) -> Judged:
    scene = flight.scene
    early, late = _hover_capture(flight, requirement)
    if early is None or late is None:
        level, _ = level_of(flight, requirement)
        return does_not(f'never settles near its hover point at {level:.1f} m')
    asked = wanted(requirement, 'duration_s', flight.variation, limits.DURATION)
    if asked is not None and flight.segment.closed:
        # A capture that leaves less than the stated duration is none that all the rest may count
        # from.
        last = flight.segment.end - round(asked.low / scene.dt_s)
        late = max(early, min(late, last))
    start = min(late, flight.ticks.stop - 1)  # a climb may begin with the capture
    point = _hover_point(flight)
    limit = limits.HOVER_DRIFT_WIND_M if scene.windy else limits.HOVER_DRIFT_CALM_M
    away = np.linalg.norm(scene.xy(flight.uav)[start : flight.ticks.stop] - point, axis=1)
    drift = float(away.max()) if len(away) else 0.0
    # Whoever is called away on its last metres has never shown its point: the median is none.
    shown = bool(_stays(flight)[1].any())
    parts = [
        graded(
            shown and drift <= limit,
            not shown or drift <= limit + HOVER_DOUBT_M,
            f'drift {drift:.2f} m',
        ),
        altitude(flight, requirement, start),
        _duration(flight, requirement, early, late),
    ]
    if not flight.targets and flight.segment.number and not requirement.get(SOMEWHERE):
        parts.append(_stays_where_it_was(flight, point))
    if flight.targets:
        parts += [
            _over(flight, requirement, point, start),
            _at_bearing(flight, requirement, point),
            _seen(flight, start),
        ]
    return all_of([*parts, *avoided(flight, requirement)])


def _stays_where_it_was(flight: Flight, point: FloatArray) -> Judged:
    """Return whether a hover at no place is where the mission before has led its UAV.

    It may have braked from the speed that it had then, as gently as a leg is flown.
    """
    scene, start = flight.scene, flight.segment.start
    speed = float(scene.speed(flight.uav)[start])
    reach = speed * speed / (2.0 * limits.GENTLE_MPS2) + limits.FOLLOWS_M
    away = float(np.linalg.norm(scene.xy(flight.uav)[start] - point))
    return decide(away <= reach, f'{away:.1f} m from where it was, braking takes {reach:.1f} m')


def _over(flight: Flight, requirement: Mapping[str, Any], point: FloatArray, tick: int) -> Judged:
    """Return whether the hover point is over its target, or at the stated distance from it."""
    scene = flight.scene
    asked = wanted(requirement, 'standoff_m', flight.variation, limits.STANDOFF)
    readings = []
    for target in flight.targets:
        if scene.is_body(target):
            last = min(flight.ticks.stop, scene.recording.ticks) - 1
            gaps = [float(np.linalg.norm(scene.xy(target)[t] - point)) for t in (0, tick, last)]
            inside = False
        elif scene.places.known(target):
            # Any junction, any crossing is one; the position that the run chose is one as well.
            spots = scene.places.spots(target)
            gaps = [float(scene.places.distance(target, point[None])[0])]
            gaps += [float(np.linalg.norm(s.xy - point)) for s in spots]
            inside = float(scene.places.outline_distance(target, point[None])[0]) <= 1.0
        else:
            readings.append(cannot_tell(f'no place {target!r} in the recorded world'))
            continue
        if asked is not None:
            best = min(gaps, key=asked.off)
            why = f'{best:.1f} m from {target}, asked {asked.text()} m'
            readings.append(decide(asked.off(best) <= asked.slack, why))
            continue
        near = min(gaps) <= limits.CENTRED_M
        # Over the roof of a building is over it; the far corner of a junction is in doubt.
        roof = inside and target.casefold() not in GENERAL
        readings.append(graded(near or roof, inside, f'{min(gaps):.1f} m from {target}'))
    return any_of(readings)


def _at_bearing(flight: Flight, requirement: Mapping[str, Any], point: FloatArray) -> Judged:
    """Return whether the hover point is at the stated bearing from the place that it is at."""
    asked, places = requirement.get('bearing_deg'), flight.scene.places
    if asked is None or any(flight.scene.is_body(t) for t in flight.targets):
        return holds('')
    readings = []
    for spot in (s for t in flight.targets for s in places.spots(t)):
        bearing = np.degrees(np.arctan2(*(point - spot.xy)))
        off = abs((bearing - float(asked) + 180.0) % 360.0 - 180.0)
        # From the place or to it: the format leaves that open.
        doubt = off >= 180.0 - limits.BEARING_DEG
        why = f'at bearing {bearing % 360.0:.0f}, asked {asked:g}'
        readings.append(graded(off <= limits.BEARING_DEG, doubt, why))
    return any_of(readings) if readings else cannot_tell('the place is not known')


# ---- track


def tracked(
    flight: Flight, requirement: Mapping[str, Any], target: str
) -> tuple[BoolArray, FloatArray, str]:
    """Return (ticks,) tracked within tolerance, the horizontal distance, and the rule in words."""
    scene = flight.scene
    away = scene.distance(flight.uav, target, horizontal=True)
    level, height = level_of(flight, requirement)
    altitude = scene.altitude(flight.uav)
    band = scene.limit('tracking_altitude_m')
    asked = wanted(requirement, 'standoff_m', flight.variation, limits.STANDOFF)
    if requirement.get(ABOVE):
        low, high = 0.0, scene.limit('tracking_horizontal_m')
        word = f'0 (default) to {high:g} m'
    elif asked is None:
        inside = away[flight.ticks]
        inside = inside[len(inside) // 4 :]
        known = inside[np.isfinite(inside)]
        middle = float(np.median(known)) if len(known) else np.nan
        reach = scene.limit('tracking_horizontal_m')
        # A UAV that is to be above its target has no standoff that the median could show.
        low, high = max(middle - reach, 0.0), middle + reach
        word = f'{middle:.1f} m (flown) +- {reach:g} m'
        if middle > scene.limit('uav_standoff_max_m'):
            low, high = 0.0, scene.limit('uav_standoff_max_m')
    else:
        low, high = asked.low - asked.slack, asked.high + asked.slack
        word = f'{low:.1f} to {high:.1f} m'
    if height is not None and height.slack > 0.0:
        at_level = (altitude >= height.low - band) & (altitude <= height.high + band)
    else:
        at_level = (np.abs(altitude - level) <= band) | is_free(flight, requirement)
    with np.errstate(invalid='ignore'):
        return (away >= low) & (away <= high) & at_level, away, word


def _track(flight: Flight, requirement: Mapping[str, Any]) -> Judged:
    asked: list[Mapping[str, Any]] = [requirement]
    if requirement.get('standoff_m') is None and requirement.get('side') is None:
        # Unstated, it is above its target, whatever the median of the way there shows.
        asked.append({**requirement, ABOVE: True})
    readings = [_track_one(flight, r, t) for t in flight.targets for r in asked]
    return any_of(readings) if readings else cannot_tell('nothing to track is annotated')


def _track_one(flight: Flight, requirement: Mapping[str, Any], target: str) -> Judged:
    scene = flight.scene
    if not scene.is_body(target):
        return cannot_tell(f'{target!r} is no body')
    good, away, word = tracked(flight, requirement, target)
    hits = np.flatnonzero(good[flight.ticks])
    if not len(hits):
        nearest = float(np.fmin.reduce(away[flight.ticks]))
        return does_not(f'{target} is never tracked at {word}; nearest {nearest:.1f} m')
    start = flight.segment.start + int(hits[0])
    window = slice(start, flight.ticks.stop)
    fraction = share(good[window])
    sight = visible(scene, flight.uav, target)
    seen = share(sight[window])
    # An event that ends the window, by lost sight perhaps, need not end the mission.
    whole = share(sight[start : flight.segment.end])
    parts = [
        decide(fraction >= limits.TRACKED_SHARE, f'{target} tracked {fraction:.1%} at {word}'),
        graded(
            seen >= limits.VISIBLE_SHARE,
            whole >= limits.VISIBLE_SHARE,
            f'{target} visible {seen:.1%}',
        ),
        altitude(flight, requirement, start),
        _duration(flight, requirement, start, start),
        _middle_standoff(flight, requirement, away[window]),
        _side(flight, requirement, target, window),
        _bearing(flight, requirement, target, window),
        leg_speed(flight, requirement, window),
    ]
    return all_of([*parts, *avoided(flight, requirement)])


def _middle_standoff(flight: Flight, requirement: Mapping[str, Any], away: FloatArray) -> Judged:
    """Return whether the number meant by an annotated range is the one that was flown."""
    asked = wanted(requirement, 'standoff_m', flight.variation, limits.STANDOFF)
    if asked is None or asked.slack == 0.0:
        return holds('')
    known = away[np.isfinite(away)]
    middle = float(np.median(known)) if len(known) else np.nan
    return decide(asked.counts(middle), f'median distance {middle:.1f} m, {asked.text()} m')


def _side(flight: Flight, requirement: Mapping[str, Any], target: str, window: slice) -> Judged:
    wanted_deg = {'ahead': 0.0, 'left': 90.0, 'behind': 180.0, 'right': -90.0}
    side = requirement.get('side')
    if side is None:
        return holds('')
    if side not in wanted_deg:
        return cannot_tell(f'side {side!r} is not known')
    delta = (flight.scene.xy(flight.uav) - flight.scene.xy(target))[window]
    course = flight.scene.course(target)[window]
    angle = np.degrees(
        np.arctan2(delta[:, 1], delta[:, 0]) - np.arctan2(course[:, 1], course[:, 0])
    )
    off = np.abs((angle - wanted_deg[side] + 180.0) % 360.0 - 180.0)
    good = share((off <= limits.SIDE_DEG) & (np.hypot(*delta.T) >= 5.0))
    return decide(good >= limits.SIDE_SHARE, f'{side} of {target} for {good:.1%}')


def _bearing(flight: Flight, requirement: Mapping[str, Any], target: str, window: slice) -> Judged:
    asked = requirement.get('bearing_deg')
    if asked is None:
        return holds('')
    delta = (flight.scene.xy(flight.uav) - flight.scene.xy(target))[window]
    bearing = np.degrees(np.arctan2(delta[:, 0], delta[:, 1]))
    off = np.abs((bearing - float(asked) + 180.0) % 360.0 - 180.0)
    good = share(off <= limits.BEARING_DEG)
    # Whether from the target or to it, from north or from the heading, the format leaves open.
    return graded(good >= limits.TRACKED_SHARE, True, f'bearing {asked:g} for {good:.1%}')
