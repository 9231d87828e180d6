# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Annotated conditions on messages, events and the end of flights."""

from __future__ import annotations

import numpy as np

from aurora_bench.checker import missions
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
from aurora_bench.checker.events import event_time as time_of
from aurora_bench.checker.flights import waypoints as waypoints_of
from aurora_bench.checker.flown import flight, flown
from aurora_bench.checker.links import deliveries
from aurora_bench.checker.phases import segments
from aurora_bench.checker.thresholds import EPSILON, compare, value_of

# A hover that is inside of its default tolerance is inside of a stated one soon after (s).
SETTLED_S = 2.0


def delivery(case: Case, requirement: Requirement) -> Judged:
    """Return whether messages arrive in time, all, or often enough."""
    names = list(requirement['of'])
    sent = deliveries(case, names[0], names[-1])
    if not sent:
        return does_not(f'no message from {names[0]} to {names[-1]}')
    quantity = requirement['quantity']
    value, slack = value_of(case, requirement) if quantity != 'delivered' else (0.0, 0.0)
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


def event_time(case: Case, requirement: Requirement) -> Judged:
    """Return whether an event sets in at the time."""
    name = str((requirement.get('of') or [''])[0])
    time, judged = time_of(case, name)
    if time is None:
        if judged.outcome is Outcome.DOES_NOT:
            return does_not(f'{name}: {judged.why}')
        return cannot_tell(f'{name}: {judged.why}')
    value, slack = value_of(case, requirement)
    test = compare(str(requirement['op']), value, slack)
    return decide(bool(test(time)), f'{name} at {time:.2f} s')


def drift(case: Case, requirement: Requirement) -> Judged:
    """Return whether a hovering UAV stays where it hovers."""
    value, slack = value_of(case, requirement)
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
            away = np.linalg.norm(xy - np.median(xy, axis=0), axis=1)
            # A phase begins inside of its tolerance, which is the stated one where that is less.
            inside = np.flatnonzero(test(away))
            soon = len(inside) and inside[0] * case.scene.dt_s <= SETTLED_S
            if soon and requirement['op'] in ('<', '<='):
                away = away[inside[0] :]
            moved = float(away.max())
            # The hover point itself is not recorded; the median is near it.
            sure = bool(test(moved)) and bool(test(moved + 0.3))
            doubt = bool(test(moved)) or bool(test(max(moved - 0.3, 0.0)))
            readings.append(graded(sure, doubt, f'{uav} drifts {moved:.2f} m'))
        parts.append(any_of(readings) if readings else does_not(f'{uav} hovers nowhere'))
    return all_of(parts) if parts else does_not('there is no UAV')


def waypoints(case: Case, requirement: Requirement) -> Judged:
    """Return whether so many waypoints were flown to."""
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
            readings.append(waypoints_of(case.scene.xy(uav)[segment.start : end : step], count))
        parts.append(any_of(readings) if readings else does_not(f'{uav} flies no mission'))
    return all_of(parts) if parts else does_not('there is no UAV')


def completed(case: Case, requirement: Requirement) -> Judged:
    """Return whether a UAV finished its missions, or landed."""
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
