# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The world of a run, and who is in it."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from aurora_bench.checker import limits
from aurora_bench.checker.answers import Judged, cannot_tell, decide, does_not, graded, holds
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.numbers import wanted
from aurora_bench.checker.phases import segments
from aurora_bench.checker.recording import FloatArray
from aurora_bench.checker.winds import wind

# Lanes that are so near and of one street are one street.
STREET_M = 14.0


def world(case: Case, requirement: Requirement) -> Judged:
    """Return whether a field of the world is as annotated."""
    recorded, value = case.scene.world, requirement.get('value')
    match requirement.get('field'):
        case 'weather':
            return decide(recorded.weather == value, f'weather {recorded.weather}')
        case 'time_of_day':
            return decide(recorded.time_of_day == value, f'time of day {recorded.time_of_day}')
        case 'map':
            return decide(recorded.map_name == value, f'map {recorded.map_name}')
        case 'duration_s':
            asked = wanted(
                {**requirement, 'duration_s': value},
                'duration_s',
                _as_duration(case, requirement),
                limits.DURATION,
            )
            if asked is None:
                return cannot_tell(f'duration {value!r} is no number')
            end = case.scene.end_s
            slack = 2.0 * case.scene.dt_s
            ok = asked.low - slack <= end <= asked.high + slack
            return decide(ok, f'recorded for {end:.2f} s, asked {asked.text()} s')
        case 'traffic_density':
            return _traffic(case, str(value))
        case 'wind_mps' | 'gust_mps' | 'wind_from_deg' | 'wind' as field:
            return wind(case, field, value)
        case other:
            return cannot_tell(f'field {other!r} is not known')


def _as_duration(case: Case, requirement: Requirement) -> dict[str, object]:
    own = case.variation.get(f'{requirement.get("id")}.value')
    own = case.variation.get(f'{requirement.get("id")}.duration_s', own)
    return {} if own is None else {f'{requirement.get("id")}.duration_s': own}


def _traffic(case: Case, value: str) -> Judged:
    """Return whether the background traffic is as dense as the word asks."""
    if value not in limits.TRAFFIC_PER_KM:
        return cannot_tell(f'traffic {value!r} is not known')
    scene = case.scene
    bound = {b for bodies in case.binding.values() for b in bodies}
    others = [
        b
        for b in scene.bodies.values()
        if not b.is_uav and not b.is_person and b.body_id not in bound and b.type_name != 'rsu'
    ]
    if len(others) < limits.TRAFFIC_LEAST:
        return does_not(f'{len(others)} background vehicles in the whole run')
    ratios = []
    for anchor in _anchors(case):
        length_km = _street_m(case, anchor) / 1000.0
        if length_km < 0.1:
            continue
        counts = np.zeros(scene.recording.ticks)
        for body in others:
            near = np.linalg.norm(scene.xy(body.body_id) - anchor, axis=1)
            counts += (near <= limits.TRAFFIC_RADIUS_M) & scene.present(body.body_id)
        due = max(limits.TRAFFIC_PER_KM[value] * length_km, limits.TRAFFIC_LEAST)
        ratios.append(float(counts.mean()) / due)
    if not ratios:
        return cannot_tell(f'{len(others)} background vehicles, no street near an anchor')
    low, high = limits.TRAFFIC_BAND
    best = min(ratios, key=lambda r: max(low - r, r - high, 0.0))
    why = f'{len(others)} background vehicles, {best:.0%} of the density {value}'
    # What the 300 m are measured from is not recorded.
    return graded(low <= best <= high, low / 2.0 <= best <= 2.0 * high, why)


def _anchors(case: Case) -> list[FloatArray]:
    """Return what the 300 m may be measured from: bodies, places and flights of the request."""
    scene, found = case.scene, []
    for bodies in case.binding.values():
        found += [scene.xy(b)[0] for b in bodies]
        found += [
            np.median(scene.xy(b)[s.start : s.end], axis=0)
            for b in bodies
            if scene.bodies[b].is_uav
            for s in segments(scene, b)
        ]
    for requirement in case.annotation.flat():
        target = requirement.get('target')
        if isinstance(target, str) and scene.places.known(target):
            found += [s.xy for s in scene.places.chosen(target)[:3]]
    if found:
        found.append(np.mean(found, axis=0))
    return found


def _street_m(case: Case, anchor: FloatArray) -> float:
    """Return metres of street near a point, each counted once whatever its carriageways."""
    circle = shapely.Point(anchor).buffer(limits.TRAFFIC_RADIUS_M)
    total = 0.0
    seen: dict[str, Any] = {}
    for lane in case.scene.world.lanes:
        part = shapely.LineString(lane.xy_m).intersection(circle)
        if part.is_empty:
            continue
        before = seen.get(lane.street, shapely.Polygon())
        total += float(part.difference(before).length)
        seen[lane.street] = before.union(part.buffer(STREET_M, cap_style='flat'))
    return total


def agent(case: Case, requirement: Requirement) -> Judged:
    """Return whether the bodies of a name are there, as many as asked."""
    kind = 'uav' if requirement['kind'] == 'uav' else str(requirement.get('type'))
    count = int(requirement.get('count', 1))
    there = [b for b in case.scene.bodies.values() if b.type_name == kind]
    if count == 0:
        return decide(not there, f'{len(there)} of type {kind}')
    bound = case.binding.get(str(requirement.get('ref')), ())
    own = [b for b in bound if case.scene.bodies[b].type_name == kind]
    if len(own) < count or len(own) != len(bound):
        return does_not(f'{len(own)} of type {kind} for {requirement.get("ref")}, asked {count}')
    missing = [b for b in own if not case.scene.present(b).any()]
    if missing:
        return does_not(f'{missing} never appear')
    # Counts are exact: who is neither asked for nor background traffic is one too many.
    most = sum(
        n for ref, n in case.annotation.counts.items() if kind in case.annotation.bodies[ref]
    )
    foreground = [b.body_id for b in there if b.role != 'background' or b.body_id in own]
    taken = {b for bodies in case.binding.values() for b in bodies}
    extra = [b for b in foreground if b not in taken]
    if len(foreground) > most and extra:
        return does_not(f'{len(foreground)} of type {kind}, asked {most}: {extra} too many')
    return holds(f'{", ".join(own)}')


def count(case: Case, requirement: Requirement) -> Judged:
    """Return whether so many bodies of a type (or of a name) are in the whole scene."""
    asked = wanted({**requirement, 'count': requirement.get('value')}, 'count', {}, (0.0, 0.0))
    if asked is None:
        return cannot_tell(f'count {requirement.get("value")!r} is no number')
    own = case.variation.get(f'{requirement.get("id")}.value')
    low, high = (float(own[0]), float(own[1])) if own else (asked.value, asked.value)
    kind, of = requirement.get('type'), requirement.get('of')
    if kind is not None:
        vehicles = kind == 'vehicle'
        there = [
            b.body_id
            for b in case.scene.bodies.values()
            if b.type_name == kind
            or (vehicles and not b.is_uav and not b.is_person and b.type_name != 'rsu')
        ]
    elif isinstance(of, str):
        there = list(case.bodies(of))
        # A name closes the scene for its type: background bodies of that type count as well.
        kinds = set(case.annotation.bodies.get(of, ()))
        there = [b.body_id for b in case.scene.bodies.values() if b.type_name in kinds] or there
    else:
        there = [b.body_id for b in case.scene.bodies.values() if not b.is_uav]
    present = [b for b in there if case.scene.present(b).any()]
    why = f'{len(present)} of {kind or of or "all"} in the scene, asked {asked.value:g}'
    return decide(low <= len(present) <= high, why)
