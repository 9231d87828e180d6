# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotated conditions, judged as written: no tolerance but for ==."""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from aurora_bench.checker import limits, missions
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    all_of,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.events import event_time
from aurora_bench.checker.flights import waypoints
from aurora_bench.checker.flown import flight, flown
from aurora_bench.checker.links import deliveries
from aurora_bench.checker.phases import segments
from aurora_bench.checker.recording import BoolArray, FloatArray
from aurora_bench.checker.scene import longest_s, share
from aurora_bench.checker.sight import visible
from aurora_bench.checker.triggers import battery

EPSILON = 1e-9


def compare(op: str, value: float, slack: float = 0.0) -> Callable[[Any], Any]:
    """Return the test of a condition; `slack` is the tolerance of ==."""
    tests: dict[str, Callable[[Any], Any]] = {
        '<=': lambda x: x <= value + EPSILON,
        '<': lambda x: x < value,
        '>=': lambda x: x >= value - EPSILON,
        '>': lambda x: x > value,
        '==': lambda x: np.abs(x - value) <= slack + EPSILON,
    }
    return tests[op]


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
        'battery': _series,
        'wind': _series,
        'tracked_fraction': _tracked,
        'visible_time': _visible,
        'visible_fraction': _visible,
        'delivery_latency': _delivery,
        'delivered': _delivery,
        'delivery_ratio': _delivery,
        'event_time': _event_time,
        'hover_drift': _drift,
        'waypoints_visited': _waypoints,
        'mission_completed': _completed,
        'landed': _completed,
    }.get(str(requirement['quantity']))
    if judge is None:
        return cannot_tell(f'quantity {requirement["quantity"]!r} is not known')
    return judge(case, requirement)


def _value(case: Case, requirement: Requirement) -> tuple[float, float]:
    """Return the threshold (its kindest reading inside of a variation) and the slack of ==."""
    value = float(requirement['value'])
    own = case.variation.get(f'{requirement.get("id")}.value')
    if isinstance(own, list | tuple) and len(own) == 2:
        low, high = float(own[0]), float(own[1])
        if requirement['op'] in ('>=', '>'):
            return low, 0.0
        if requirement['op'] in ('<=', '<'):
            return high, 0.0
        return (low + high) / 2.0, (high - low) / 2.0
    rule = {
        'altitude': limits.ALTITUDE,
        'speed': limits.SPEED,
        'event_time': limits.DURATION,
        'distance': limits.STANDOFF,
        'horizontal_distance': limits.STANDOFF,
        'separation': limits.STANDOFF,
    }.get(str(requirement['quantity']), (0.0, 0.01))
    return value, limits.tolerance(rule, value)


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
    own = [
        r
        for r in case.annotation.flat()
        if r['kind'] == 'mission' and uav in case.bodies(r.get('uav'))
    ]
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
    if quantity in ('altitude', 'speed', 'battery'):
        picks: dict[str, Callable[[str], FloatArray]] = {
            'altitude': scene.altitude,
            'speed': scene.speed,
            'battery': functools.partial(battery, case),
        }
        rows = [b for g in groups for b in g if scene.is_body(b)]
        if quantity != 'speed':
            rows = [b for b in rows if scene.bodies[b].is_uav]
        return [(f'{quantity} of {b}', picks[quantity](b)) for b in rows]
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
    value, slack = _value(case, requirement)
    op = str(requirement['op'])
    with np.errstate(invalid='ignore'):
        true = np.asarray(compare(op, value, slack)(row)) & np.isfinite(row)
    dt_s, times = case.scene.dt_s, case.scene.times
    counted = narrow & np.isfinite(row)
    if not counted.any():
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
    bad = int((~true[counted]).sum())
    return decide(bad == 0, f'{why}; {bad * dt_s:.2f} s of {counted.sum() * dt_s:.1f} s outside')


def _tracked(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    value, slack = _value(case, requirement)
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
    found: list[Mapping[str, Any]] = [
        r
        for r in case.annotation.flat()
        if r['kind'] == 'mission'
        and uav in case.bodies(r.get('uav'))
        and target in case.things(r.get('target'))
    ]
    for event in case.annotation.flat():
        action = event.get('action') or {}
        if (
            event['kind'] == 'event'
            and action.get('do') == 'change_mission'
            and uav in case.bodies(action.get('uav'))
            and target in case.things(action.get('target'))
        ):
            found.append({**action, 'kind': 'mission', 'id': event.get('id')})
    return found or [{'kind': 'mission', 'mode': 'track', 'target': target, 'uav': uav}]


def _visible(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    value, slack = _value(case, requirement)
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
    value, slack = _value(case, requirement)
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


def _delivery(case: Case, requirement: Requirement) -> Judged:
    names = list(requirement['of'])
    sent = deliveries(case, names[0], names[-1])
    if not sent:
        return does_not(f'no message from {names[0]} to {names[-1]}')
    quantity = requirement['quantity']
    value, slack = _value(case, requirement) if quantity != 'delivered' else (0.0, 0.0)
    open_ = [s for s in sent if s.received_s is None and not s.failed]
    got = [s for s in sent if s.received_s is not None]
    if quantity == 'delivery_latency':
        if not got:
            return does_not('no message was received')
        worst = max(s.received_s - s.sent_s for s in got if s.received_s is not None)
        test = compare(str(requirement['op']), value, slack)
        lost = len(sent) - len(got)
        why = f'slowest of {len(got)} messages {worst:.3f} s, {lost} not received'
        return graded(
            bool(test(worst)) and not lost, bool(test(worst)) and lost <= len(open_), why
        )
    ratio = len(got) / len(sent)
    why = f'{len(got)} of {len(sent)} messages received'
    if quantity == 'delivered':
        by = requirement.get('by_s')
        late = [s for s in got if by is not None and (s.received_s or 0.0) > float(by)]
        whole = len(got) == len(sent) and not late
        asked = bool(requirement['value'])
        if by is not None:
            why += f', {len(late)} after {by:g} s'
        return graded(whole is asked, bool(open_) and asked and not late, why)
    test = compare(str(requirement['op']), value, slack)
    return graded(bool(test(ratio)), bool(test((len(got) + len(open_)) / len(sent))), why)


def _event_time(case: Case, requirement: Requirement) -> Judged:
    name = str((requirement.get('of') or [''])[0])
    time, judged = event_time(case, name)
    if time is None:
        if judged.outcome is Outcome.DOES_NOT:
            return does_not(f'{name}: {judged.why}')
        return cannot_tell(f'{name}: {judged.why}')
    value, slack = _value(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    return decide(bool(test(time)), f'{name} at {time:.2f} s')


def _drift(case: Case, requirement: Requirement) -> Judged:
    value, slack = _value(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    parts = []
    for uav in case.bodies(requirement['of'][0]):
        asked = [
            r
            for r in case.annotation.flat()
            if r['kind'] == 'mission' and r['mode'] == 'hover' and uav in case.bodies(r.get('uav'))
        ]
        readings = []
        for one in asked:
            segment = flown(case, one, uav).segment
            if segment is None:
                continue
            start = missions.captured_tick(flight(case, one, uav, segment), one)
            if start is None:
                continue
            xy = case.scene.xy(uav)[start : flight(case, one, uav, segment).until]
            middle = np.median(xy, axis=0)
            drift = float(np.linalg.norm(xy - middle, axis=1).max())
            # The hover point itself is not recorded; the median is near it.
            sure = bool(test(drift)) and bool(test(drift + 0.3))
            doubt = bool(test(drift)) or bool(test(max(drift - 0.3, 0.0)))
            readings.append(graded(sure, doubt, f'{uav} drifts {drift:.2f} m'))
        parts.append(any_of(readings) if readings else does_not(f'{uav} hovers nowhere'))
    return all_of(parts) if parts else does_not('there is no UAV')


def _waypoints(case: Case, requirement: Requirement) -> Judged:
    count = int(float(requirement['value']))
    if requirement['op'] in ('<', '<='):
        return cannot_tell('points flown to that were not asked for cannot be told from turns')
    parts = []
    for uav in case.bodies(requirement['of'][0]):
        readings = []
        for segment in segments(case.scene, uav):
            end = segment.end
            if requirement.get('by_s') is not None:
                end = min(end, case.scene.tick(float(requirement['by_s'])) + 1)
            if end <= segment.start + 2:
                readings.append(does_not('the mission has not begun'))
                continue
            step = max(1, round(0.2 / case.scene.dt_s))
            readings.append(waypoints(case.scene.xy(uav)[segment.start : end : step], count))
        parts.append(any_of(readings) if readings else does_not(f'{uav} flies no mission'))
    return all_of(parts) if parts else does_not('there is no UAV')


def _completed(case: Case, requirement: Requirement) -> Judged:
    asked = bool(requirement['value'])
    by, parts = requirement.get('by_s'), []
    for uav in case.bodies(requirement['of'][0]):
        if requirement['quantity'] == 'landed':
            time = case.scene.landed_s(uav)
            word = 'landed'
        else:
            found = segments(case.scene, uav)
            last = found[-1] if found else None
            time = float(case.scene.times[last.end]) if last is not None and last.closed else None
            word = 'last mission ended'
        if time is None:
            parts.append(decide(not asked, f'{uav}: never {word}'))
        else:
            within = by is None or time <= float(by) + EPSILON
            parts.append(decide(within is asked, f'{uav}: {word} at {time:.2f} s'))
    return all_of(parts) if parts else does_not('there is no UAV')
