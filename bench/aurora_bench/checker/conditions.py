# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotated conditions, judged as written: no tolerance but for ==."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from aurora_bench.checker import endings, headways, missions
from aurora_bench.checker.answers import (
    Judged,
    all_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.flown import flight, flown
from aurora_bench.checker.phases import segments
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.scene import longest_s, share
from aurora_bench.checker.sight import visible
from aurora_bench.checker.thresholds import EPSILON, compare, value_of
from aurora_bench.checker.triggers import battery


def condition(case: Case, requirement: Requirement) -> Judged:
    """Return whether an annotated condition holds on the recording."""
    names = list(requirement.get('of') or [])
    if requirement['quantity'] != 'event_time':
        gone = case.missing(*names)
        if gone:
            return does_not(f'there is no {gone}')
        unknown = [n for n in names if case.unknown_place(n)]
        if unknown:
            return cannot_tell(f'no place {unknown[0]!r} in the recorded world')
    if requirement.get('op') not in ('<=', '<', '>=', '>', '=='):
        return cannot_tell(f'operator {requirement.get("op")!r} is not known')
    judge = {
        'distance': _series,
        'horizontal_distance': _series,
        'separation': _series,
        'altitude': _series,
        'speed': _series,
        'clearance': _series,
        'time_headway': _series,
        'vertical_speed': _series,
        'time_to_collision': _series,
        'deceleration': _hardest_braking,
        'battery': _series,
        'wind': _series,
        'tracked_fraction': _tracked,
        'visible_time': _visible,
        'visible_fraction': _visible,
        'delivery_latency': endings.delivery,
        'delivered': endings.delivery,
        'delivery_ratio': endings.delivery,
        'event_time': endings.event_time,
        'hover_drift': endings.drift,
        'waypoints_visited': endings.waypoints,
        'mission_completed': endings.completed,
        'landed': endings.completed,
    }.get(str(requirement['quantity']))
    if judge is None:
        return cannot_tell(f'quantity {requirement["quantity"]!r} is not known')
    return judge(case, requirement)


def window_of(case: Case, names: list[str]) -> tuple[BoolArray, BoolArray]:
    """Return (ticks,) the narrowest and the widest time in which a condition counts.

    With a UAV: its missions after capture, and all of them from the end of ascent on. Otherwise
    the whole run.
    """
    scene = case.scene
    narrow = np.ones(scene.recording.ticks, dtype=bool)
    wide = narrow.copy()
    bodies = [b for n in names for b in case.bodies(n)]
    for uav in (b for b in bodies if scene.bodies[b].is_uav):
        inner, outer = np.zeros_like(narrow), np.zeros_like(narrow)
        found = _own_segments(case, uav, bodies)
        for segment, start, stop in found:
            inner[start:stop] = True
            outer[segment : max(stop, start)] = True
        if not found:
            inner = scene.airborne(uav)
            outer = inner.copy()
        narrow &= inner
        wide &= outer
    for body in bodies:
        narrow &= scene.present(body)
        wide &= scene.present(body)
    return narrow, wide


def _own_segments(case: Case, uav: str, bodies: list[str]) -> list[tuple[int, int, int]]:
    """Return (start, captured, end) of the missions that a condition on a UAV is about.

    With a body that one of the UAV's missions observes, these missions; else all.
    """
    rows = []
    own = _own_missions(case, uav)
    about = [r for r in own if set(case.bodies(r.get('target'))) & set(bodies)] or own
    taken = set()
    for requirement in about:
        segment = flown(case, requirement, uav).segment
        if segment is None or segment.number in taken:
            continue
        taken.add(segment.number)
        captured = missions.captured_tick(flight(case, requirement, uav, segment), requirement)
        if captured is not None:
            rows.append((segment.start, captured, segment.end))
    if not rows:
        rows = [(s.start, s.start, s.end) for s in segments(case.scene, uav)]
    return rows


def _series(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    series = _values(case, requirement, names)
    if not series:
        return cannot_tell(f'{requirement["quantity"]} of {names} has no values')
    narrow, wide = window_of(case, names)
    return all_of(
        [_over_time(case, requirement, label, row, narrow, wide) for label, row in series]
    )


def _values(
    case: Case, requirement: Requirement, names: list[str]
) -> list[tuple[str, FloatArray]]:
    scene, quantity = case.scene, str(requirement['quantity'])
    if quantity == 'wind':
        speed = float(np.hypot(*scene.world.wind_mps))
        return [('mean wind', np.full(scene.recording.ticks, speed))]
    groups = [case.things(n) for n in names]
    if quantity in ('altitude', 'speed', 'battery', 'vertical_speed'):
        picks: dict[str, Callable[[str], FloatArray]] = {
            'altitude': scene.altitude,
            'speed': scene.speed,
            'battery': functools.partial(battery, case),
            'vertical_speed': scene.vertical_speed,
        }
        rows = [b for g in groups for b in g if scene.is_body(b)]
        if quantity != 'speed':
            rows = [b for b in rows if scene.bodies[b].is_uav]
        return [(f'{quantity} of {b}', picks[quantity](b)) for b in rows]
    if quantity in ('time_headway', 'time_to_collision'):
        return [
            (f'{quantity} of {a} behind {b}', _seconds_behind(case, requirement, a, b))
            for a in groups[0]
            for b in (groups[1] if len(groups) > 1 else ())
            if a != b and scene.is_body(a) and scene.is_body(b)
        ]
    if quantity == 'clearance':
        return [
            (f'{a} to {b}', _clearance(case, a, b))
            for a in groups[0]
            if scene.is_body(a)
            for b in (groups[1] if len(groups) > 1 else ())
        ]
    if len(groups) == 1:
        pairs = [(a, b) for i, a in enumerate(groups[0]) for b in groups[0][i + 1 :]]
    else:
        pairs = [
            (a, b)
            for i, g in enumerate(groups)
            for h in groups[i + 1 :]
            for a in g
            for b in h
            if a != b
        ]
    flat = quantity == 'horizontal_distance'
    return [
        (f'{quantity} {a}-{b}', scene.distance(a, b, flat))
        for a, b in pairs
        if scene.is_body(a) or scene.is_body(b)
    ]


def _seconds_behind(case: Case, requirement: Requirement, a: str, b: str) -> FloatArray:
    """Return headway or time to collision; who stands has no headway to be within."""
    values, moves = headways.seconds(case.scene, str(requirement['quantity']), a, b)
    return np.where(moves, values, np.nan) if _from_first(requirement) else values


def _from_first(requirement: Requirement) -> bool:
    """Return whether a bound counts from when it is first kept: nobody is near at a start."""
    upper = requirement['op'] in ('<', '<=', '==')
    plain = all(requirement.get(name) is None for name in ('hold_s', 'by_s', 'fraction'))
    return requirement['quantity'] == 'time_headway' and upper and plain


def _clearance(case: Case, uav: str, thing: str) -> FloatArray:
    if case.scene.is_body(thing):
        return case.scene.distance(uav, thing, horizontal=True)
    away = case.scene.places.outline_distance(thing, case.scene.xy(uav))
    return np.where(case.scene.airborne(uav), away, np.nan)


def _over_time(
    case: Case,
    requirement: Requirement,
    label: str,
    row: FloatArray,
    narrow: BoolArray,
    wide: BoolArray,
) -> Judged:
    value, slack = value_of(case, requirement)
    op = str(requirement['op'])
    with np.errstate(invalid='ignore'):
        true = np.asarray(compare(op, value, slack)(row)) & np.isfinite(row)
    dt_s, times = case.scene.dt_s, case.scene.times
    counted = narrow & np.isfinite(row)
    if not counted.any():
        # Missions that share no time: what holds all along holds in them, too.
        along = np.isfinite(row)
        if along.any() and true[along].all() and requirement.get('hold_s') is None:
            return holds(f'{label} all along, though no sample is in the phase')
        return does_not(f'{label}: no sample in the phase')
    least, most = float(row[counted].min()), float(row[counted].max())
    why = f'{label} {least:.2f} to {most:.2f}, asked {op} {value:g}'
    by, hold = requirement.get('by_s'), requirement.get('hold_s')
    if by is not None:
        early = times <= float(by) + EPSILON
        need = float(hold or 0.0)
        # A deadline from the start of the scenario: also what happens before the capture counts.
        stretches = longest_s(true & early, dt_s)
        found = bool((true & early).any()) and stretches >= need - EPSILON
        return decide(found, f'{why} by {by:g} s ({stretches:.2f} s of it)')
    if hold is not None:
        inside, outside = longest_s(true & counted, dt_s), longest_s(true & wide, dt_s)
        why = f'{why}, longest {inside:.2f} s of {hold:g} s'
        edge = 2.0 * dt_s
        return graded(inside >= float(hold) - edge, outside >= float(hold) - edge, why)
    if requirement.get('fraction') is not None:
        need = float(requirement['fraction'])
        inner, outer = share(true[counted]), share(true[wide & np.isfinite(row)])
        why = f'{why}: {inner:.1%} of {need:.0%}'
        both = (inner >= need - EPSILON, outer >= need - EPSILON)
        return graded(all(both), any(both), why)
    flies = any(case.scene.bodies[b].is_uav for n in requirement['of'] for b in case.bodies(n))
    floor = requirement['quantity'] == 'speed' and op in ('>', '>=') and not flies
    if floor or _from_first(requirement):
        # Everybody stands at first: who is never to be slower is so from then on.
        reached = np.flatnonzero(true & counted)
        if not len(reached):
            return does_not(f'{why}: never')
        counted = counted & (np.arange(len(row)) >= reached[0])
    bad = int((~true[counted]).sum())
    return decide(bad == 0, f'{why}; {bad * dt_s:.2f} s of {counted.sum() * dt_s:.1f} s outside')


def _hardest_braking(case: Case, requirement: Requirement) -> Judged:
    """Return how hard bodies brake at their hardest: a moment of it counts."""
    value, slack = value_of(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    parts = []
    for body in (b for n in requirement['of'] for b in case.bodies(n)):
        lost = -np.diff(case.scene.speed(body)) / case.scene.dt_s
        there = case.scene.present(body)
        hardest = float(lost[there[1:] & there[:-1]].max(initial=0.0))
        # One step of the simulation may be a little harder than what was commanded.
        near = bool(test(hardest * 0.98)) or bool(test(hardest * 1.02))
        why = f'{body} brakes with {hardest:.2f} m/s^2 at its hardest'
        parts.append(graded(bool(test(hardest)), near, why))
    return all_of(parts) if parts else does_not('there is nobody who could brake')


def _tracked(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    value, slack = value_of(case, requirement)
    parts = []
    for uav in case.bodies(names[0]):
        for target in case.bodies(names[-1]):
            fractions = []
            for asked in _missions(case, uav, target):
                segment = flown(case, asked, uav).segment
                if segment is None:
                    continue
                one = flight(case, asked, uav, segment)
                good = missions.tracked(one, asked, target)[0][one.ticks]
                hits = np.flatnonzero(good)
                fractions.append(share(good[hits[0] :]) if len(hits) else 0.0)
            if not fractions:
                parts.append(does_not(f'{uav} flies no mission that tracks {target}'))
                continue
            test = compare(str(requirement['op']), value, slack)
            why = f'{target} tracked {max(fractions):.1%}'
            parts.append(decide(any(bool(test(f)) for f in fractions), why))
    return all_of(parts)


def _missions(case: Case, uav: str, target: str) -> list[Mapping[str, Any]]:
    found = [r for r in _own_missions(case, uav) if target in case.things(r.get('target'))]
    return found or [{'kind': 'mission', 'mode': 'track', 'target': target, 'uav': uav}]


def _own_missions(case: Case, uav: str) -> list[Mapping[str, Any]]:
    """Return the annotated missions of a UAV, and those that events change it to."""
    found: list[Mapping[str, Any]] = []
    for requirement in case.annotation.flat():
        action = requirement.get('action') or {}
        if requirement['kind'] == 'mission' and uav in case.bodies(requirement.get('uav')):
            found.append(requirement)
        elif action.get('do') == 'change_mission' and uav in case.bodies(action.get('uav')):
            found.append({**action, 'kind': 'mission', 'id': requirement.get('id')})
    return found


def _visible(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    value, slack = value_of(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    parts = []
    for observer in case.bodies(names[0]):
        readings = []
        for target in case.things(names[-1]):
            seen = visible(case.scene, observer, target)
            narrow, wide = window_of(case, [observer, target])
            if requirement['quantity'] == 'visible_fraction':
                readings.append(_fraction(case, requirement, target, seen, narrow, wide, test))
            else:
                readings.append(_seconds(case, requirement, target, seen, narrow, wide))
        parts.append(all_of(readings) if readings else does_not('nothing to be seen'))
    return all_of(parts) if parts else does_not(f'there is no {names[0]}')


def _fraction(
    case: Case,
    requirement: Requirement,
    target: str,
    seen: BoolArray,
    narrow: BoolArray,
    wide: BoolArray,
    test: Callable[[Any], Any],
) -> Judged:
    hold = requirement.get('hold_s')
    if hold is not None and float(requirement['value']) >= 1.0:
        longest = longest_s(seen & narrow, case.scene.dt_s)
        why = f'{target} seen for {longest:.1f} s at a stretch'
        return decide(longest >= float(hold) - 2.0 * case.scene.dt_s, why)
    inner, outer = share(seen[narrow]), share(seen[wide])
    why = f'{target} visible {inner:.1%} of the phase ({outer:.1%} with its way there)'
    # A sample of sight stands for 0.1 s: one of them decides nothing.
    step = 0.1 / max(narrow.sum() * case.scene.dt_s, 0.1)
    both = (bool(test(inner)), bool(test(inner - step)) != bool(test(inner + step)))
    return graded(both[0] and bool(test(outer)), both[0] or both[1], why)


def _seconds(
    case: Case,
    requirement: Requirement,
    target: str,
    seen: BoolArray,
    narrow: BoolArray,
    wide: BoolArray,
) -> Judged:
    value, slack = value_of(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    dt_s, by = case.scene.dt_s, requirement.get('by_s')
    if by is not None:
        seen = seen & (case.scene.times <= float(by))
    if requirement.get('hold_s') is not None:
        inner, outer = longest_s(seen & narrow, dt_s), longest_s(seen & wide, dt_s)
    else:
        inner, outer = float((seen & narrow).sum()) * dt_s, float((seen & wide).sum()) * dt_s
    why = f'{target} seen {inner:.1f} s in the phase, {outer:.1f} s with its way there'
    ok = (bool(test(inner)), bool(test(outer)), bool(test(inner + 0.1)))
    return graded(ok[0] and ok[1], any(ok), why)
