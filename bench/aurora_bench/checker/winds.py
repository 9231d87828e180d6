# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The wind of a run, and how it meets who flies."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from aurora_bench.checker import flown, limits
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.leaning import wind_shown
from aurora_bench.checker.missions import captured_tick
from aurora_bench.checker.phases import segments
from aurora_bench.checker.recording import FloatArray

# Slower air does not move (m/s).
STILL_MPS = 0.05
# Of several legs that are as long as that share of the longest one, any may be meant.
AS_LONG = 0.9
LEG_M = 5.0
DOUBT_DEG = 60.0
OFF_COURSE_DEG = {'tailwind': 0.0, 'headwind': 180.0, 'crosswind': 90.0}


def wind(case: Case, field: str, value: object) -> Judged:
    """Return whether the wind is as annotated: speed, origin, or course; and whether it blew."""
    judged = _recorded(case, field, value)
    still = '' if judged.outcome is not Outcome.HOLDS else _did_not_blow(case)
    return does_not(still) if still else judged


def _did_not_blow(case: Case) -> str:
    """Return that a flight shows another wind than the recorded one, '' where none does."""
    world = case.scene.world
    most = limits.WIND_SHOWN_MPS + limits.WIND_SHOWN_GUSTS * world.gust_mps
    for uav in _uavs(case):
        shown = wind_shown(case.scene, uav)
        if shown is not None and np.linalg.norm(shown - world.wind_mps) > most:
            return f'{uav} leans against a wind of {np.linalg.norm(shown):.1f} m/s on average'
    return ''


def _recorded(case: Case, field: str, value: object) -> Judged:
    east, north = case.scene.world.wind_mps
    speed = float(np.hypot(east, north))
    if field == 'wind_mps' and isinstance(value, int | float):
        slack = limits.tolerance((STILL_MPS, limits.REALISED_SHARE), float(value))
        return decide(abs(speed - value) <= slack, f'mean wind {speed:.2f} m/s')
    if field == 'gust_mps' and isinstance(value, int | float):
        gust = case.scene.world.gust_mps
        most = speed + gust if gust > 0.0 else 0.0
        slack = limits.tolerance((STILL_MPS, limits.REALISED_SHARE), float(value))
        return decide(abs(most - value) <= slack, f'gusts of {most:.2f} m/s')
    if speed < STILL_MPS:
        return does_not('no wind is recorded')
    origin = float(np.degrees(np.arctan2(-east, -north)) % 360.0)
    if field == 'wind_from_deg' and isinstance(value, int | float):
        off = abs((origin - value + 180.0) % 360.0 - 180.0)
        return decide(off <= limits.BEARING_DEG, f'wind from {origin:.0f} degrees')
    want = OFF_COURSE_DEG.get(str(value))
    if want is None:
        return cannot_tell(f'wind {value!r} is not known')
    return _course(case, np.array([east, north]), want)


def _course(case: Case, blows: FloatArray, want: float) -> Judged:
    """Return whether a wind meets the flights of the annotation at an angle."""
    asked = [r for r in case.annotation.flat() if r['kind'] == 'mission']
    routes = [r for r in asked if r.get('mode') == 'navigate']
    tracks = [r for r in asked if r.get('mode') == 'track']
    if any(r.get('pattern') == 'orbit' for r in routes):
        return holds('a wind blows; an orbit has legs in every direction')
    if asked and not routes and not tracks:
        return holds('a wind blows; who hovers has no course')
    if tracks and not routes:
        courses = [c for r in tracks for c in _targets(case, r)]
    else:
        courses = [c for uav in _uavs(case) for c in _legs(case, uav)]
    if not courses:
        return cannot_tell('no course to compare the wind with')
    angles = [_angle(course, blows) for course in courses]
    off = min(abs(a - want) for a in angles)
    shown = sorted({round(a) for a in angles})
    return graded(off <= limits.SIDE_DEG, off <= DOUBT_DEG, f'{shown} degrees off the course')


def _angle(course: FloatArray, blows: FloatArray) -> float:
    cosine = course @ blows / np.linalg.norm(course) / np.linalg.norm(blows)
    return float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _uavs(case: Case) -> list[str]:
    return [b.body_id for b in case.scene.bodies.values() if b.is_uav]


def _legs(case: Case, uav: str) -> Iterator[FloatArray]:
    """Yield the longest legs of what a UAV flew, with and without the ways there and back."""
    for segment in segments(case.scene, uav):
        xy = case.scene.xy(uav)[segment.start : segment.end]
        simple = (
            shapely.get_coordinates(shapely.LineString(xy).simplify(2.0)) if len(xy) > 1 else xy
        )
        legs = np.diff(simple, axis=0)
        for part in (legs, legs[1:-1]):
            lengths = np.linalg.norm(part, axis=1)
            if len(part) and lengths.max() > LEG_M:
                yield from part[lengths >= AS_LONG * lengths.max()]


def _targets(case: Case, requirement: Requirement) -> Iterator[FloatArray]:
    """Yield the headings of what a UAV tracks, when it captures it."""
    for uav in case.bodies(requirement.get('uav')):
        segment = flown.flown(case, requirement, uav).segment
        if segment is None:
            continue
        flight = flown.flight(case, requirement, uav, segment)
        tick = captured_tick(flight, requirement)
        for target in flight.targets if tick is not None else ():
            if case.scene.is_body(target):
                yield case.scene.course(target)[tick]
