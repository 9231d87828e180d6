# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When a trigger of the annotation became true, computed from states and the ledger."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from aurora_bench.checker import headways, limits
from aurora_bench.checker.case import Case
from aurora_bench.checker.lasting import over_s
from aurora_bench.checker.phases import ascent_end_tick, landing_tick, segments
from aurora_bench.checker.recording import BoolArray, FloatArray, LinkKind
from aurora_bench.checker.scene import runs_of
from aurora_bench.checker.sight import STEP_S, visible

# "Arrives": the contract states no distance; from this one to where the body is nearest.
ARRIVED_FROM_M = 40.0
# When a gap in seconds falls below a number is known so well (s); between two samples, 0.2 s
# apart and measured along another line, it may have been shorter by so much.
BLUR_S = 0.4
BETWEEN_S = 0.25


@dataclass(frozen=True, slots=True)
class Instant:
    """A time at which a trigger may be said to have become true: between two times.

    Attributes:
        told_s: Where a wait is stated, when that began.
    """

    early_s: float
    late_s: float
    told_s: float | None = None


@dataclass(frozen=True, slots=True)
class Fired:
    """Instants in order of time; `unclear` says why there is no answer."""

    instants: tuple[Instant, ...] = ()
    unclear: str = ''
    why: str = ''


class EventTimes(Protocol):
    """Says when an event was done (the completion of its action), or had begun."""

    def __call__(self, event: str, *, begun: bool) -> Fired:
        """Return the instants."""


def fired(case: Case, trigger: Mapping[str, Any], moments: EventTimes) -> Fired:
    """Return when a trigger became true (each time again); none when it never did.

    Args:
        moments: For triggers that wait for another event.
    """
    scene = case.scene
    match trigger.get('on'):
        case 'time':
            at = float(trigger.get('at_s', 0.0))
            return Fired((Instant(at, at),))
        case 'distance_below' | 'distance_above':
            return _distance(case, trigger)
        case 'headway_below' | 'ttc_below':
            return _behind(case, trigger)
        case 'visible' | 'occluded':
            return _sight(case, trigger)
        case 'altitude_reached':
            level = float(trigger.get('value_m', 0.0))
            slack = limits.tolerance(limits.ALTITUDE, level)
            found = []
            for uav in case.bodies(trigger.get('uav')):
                z = scene.altitude(uav)
                soft, hard = np.flatnonzero(z >= level - slack), np.flatnonzero(z >= level)
                if len(soft):
                    early = float(scene.times[soft[0]])
                    late = float(scene.times[hard[0]]) if len(hard) else early + 5.0
                    found.append(Instant(early, min(late, early + 5.0)))
            return Fired(tuple(found), why=f'altitude of {level:g} m')
        case 'arrives':
            return _arrives(case, trigger)
        case 'message_received':
            return _received(case, trigger)
        case 'speed_below' | 'speed_above':
            return _speed(case, trigger)
        case 'event_done' | 'event_begun':
            event = trigger.get('event')
            if not isinstance(event, str) or event not in case.annotation.events:
                return Fired(unclear=f'it waits for {event!r}, which is no annotated event')
            after = float(trigger.get('after_s', 0.0))
            begun = trigger['on'] == 'event_begun'
            cause = moments(event, begun=begun)
            shifted = tuple(Instant(i.early_s + after, i.late_s + after) for i in cause.instants)
            what = f'{event} {"begun" if begun else "done"}'
            return Fired(shifted, cause.unclear, f'{what}, {cause.why}')
        case 'behavior_done':
            return _lasted(case, trigger)
        case 'mission_done':
            ends = [
                float(scene.times[min(s.end, scene.recording.ticks - 1)])
                for uav in case.bodies(trigger.get('uav'))
                for s in segments(scene, uav)
                if s.closed
            ]
            return Fired(tuple(Instant(e, e) for e in sorted(ends)), why='mission done')
        case 'battery_below':
            return _battery(case, trigger)
        case other:
            return Fired(unclear=f'trigger {other!r} is not known')


def _lasted(case: Case, trigger: Mapping[str, Any]) -> Fired:
    """Return when what somebody does has gone on for its stated time."""
    what = f'{trigger.get("who")} to {trigger.get("behavior")} for its time'
    found = over_s(case, trigger)
    if found is None:
        return Fired(unclear=f'nobody annotates {what}')
    return Fired(_sorted([Instant(max(a, 0.0), b) for a, b in found]), why=what)


def edges(case: Case, true: BoolArray, blur_s: float = 0.0) -> tuple[Instant, ...]:
    """Return when a series becomes true, its first sample included."""
    times = case.scene.times
    return tuple(
        Instant(max(float(times[a]) - blur_s, 0.0), float(times[a]) + blur_s)
        for a, _ in runs_of(true)
    )


def _behind(case: Case, trigger: Mapping[str, Any]) -> Fired:
    quantity = 'time_headway' if trigger['on'] == 'headway_below' else 'time_to_collision'
    value, found = float(trigger.get('value_s', 0.0)), list[Instant]()
    least: list[float] = []
    for a in case.bodies(trigger.get('a')):
        for b in case.bodies(trigger.get('b')):
            values, _ = headways.seconds(case.scene, quantity, a, b)
            with np.errstate(invalid='ignore'):
                found += edges(case, np.asarray(values <= value + BETWEEN_S), BLUR_S)
            least.append(round(float(np.nanmin(values)), 2))
    return Fired(_sorted(found), why=f'{quantity} {least} s against {value:g}')


def _distance(case: Case, trigger: Mapping[str, Any]) -> Fired:
    a, b = trigger.get('a'), trigger.get('b')
    for name in (a, b):
        if case.unknown_place(name):
            return Fired(unclear=f'no place {name!r} in the recorded world')
    value = float(trigger.get('value_m', 0.0))
    below = trigger['on'] == 'distance_below'
    rows = [
        case.scene.distance(x, y)
        for x in case.things(a)
        for y in case.things(b)
        if x != y and (case.scene.is_body(x) or case.scene.is_body(y))
    ]
    if not rows:
        return Fired(why='no pair of bodies')
    with np.errstate(invalid='ignore'):
        near = np.fmin.reduce(rows) if below else np.fmax.reduce(rows)
        true = near < value if below else near > value
    extreme = float(np.fmin.reduce(near) if below else np.fmax.reduce(near))
    word = 'least' if below else 'greatest'
    return Fired(edges(case, true), why=f'{word} distance {extreme:.2f} m, {value:g} m')


def _sight(case: Case, trigger: Mapping[str, Any]) -> Fired:
    scene, ever = case.scene, 0.0
    found: list[Instant] = []
    seeing = trigger['on'] == 'visible'
    if case.unknown_place(trigger.get('target')):
        return Fired(unclear=f'no place {trigger.get("target")!r} in the recorded world')
    for observer in case.bodies(trigger.get('observer')):
        for target in case.things(trigger.get('target')):
            seen = visible(scene, observer, target)
            ever += float(seen.sum()) * scene.dt_s
            # A UAV looks out once it is up, not from the ground nor in its ascent.
            start = ascent_end_tick(scene, observer) if scene.bodies[observer].is_uav else 0
            if seeing:
                ready = np.arange(len(seen)) >= start
                found += edges(case, seen & ready, STEP_S)
            else:
                lost = ~seen & scene.present(target) if scene.is_body(target) else ~seen
                landing = landing_tick(scene, observer) if scene.bodies[observer].is_uav else None
                lost[:start] = False
                lost[landing if landing is not None else len(lost) :] = False
                found += edges(case, lost, STEP_S)
    return Fired(_sorted(found), why=f'seen for {ever:.1f} s in all')


def _arrives(case: Case, trigger: Mapping[str, Any]) -> Fired:
    scene, place = case.scene, trigger.get('place')
    if case.unknown_place(place):
        return Fired(unclear=f'no place {place!r} in the recorded world')
    found, least = [], np.inf
    for who in case.bodies(trigger.get('who')):
        for goal in case.things(place):
            if scene.is_body(goal):
                away = scene.distance(who, goal, horizontal=True)
            else:
                on_road = not scene.bodies[who].is_uav
                away = scene.places.outline_distance(goal, scene.xy(who), on_road=on_road)
                if goal.casefold() == 'sidewalk':
                    away = _since_left(away)
            least = float(np.fmin(least, np.fmin.reduce(away)))
            with np.errstate(invalid='ignore'):
                near = away <= ARRIVED_FROM_M
            for a, b in runs_of(near):
                # At the latest it has arrived where it is nearest.
                nearest = int(np.nanargmin(away[a:b]))
                moved = np.flatnonzero(scene.speed(who)[a + nearest : b] < limits.STOPPED_MPS)
                stop = a + nearest + (int(moved[0]) if len(moved) else 0)
                found.append(Instant(float(scene.times[a]), float(scene.times[stop])))
    return Fired(_sorted(found), why=f'nearest {least:.1f} m')


def _since_left(away: FloatArray) -> FloatArray:
    """Return distances from sidewalks without those before somebody on one has left it.

    Who stands on a sidewalk arrives at one when he gets onto it again.
    """
    off = np.flatnonzero(away > 0.0)
    left = int(off[0]) if len(off) else len(away)
    return np.where(np.arange(len(away)) < left, np.inf, away)


def _received(case: Case, trigger: Mapping[str, Any]) -> Fired:
    by, sender = case.bodies(trigger.get('by')), trigger.get('from')
    senders = case.bodies(sender) if sender is not None else None
    times = [
        e.time_s
        for e in case.scene.recording.ledger
        if e.kind is LinkKind.DELIVERED
        and e.receiver in by
        and (senders is None or e.sender in senders)
    ]
    why = f'{len(times)} messages received'
    return Fired(tuple(Instant(t, t) for t in sorted(times)), why=why)


def _speed(case: Case, trigger: Mapping[str, Any]) -> Fired:
    scene, below = case.scene, trigger['on'] == 'speed_below'
    value = trigger.get('value_mps')
    limit = limits.STOPPED_MPS if value is None else float(value)
    found: list[Instant] = []
    extreme: list[float] = []
    for who in case.bodies(trigger.get('who')):
        speed = scene.speed(who)
        true = (speed < limit if below else speed > limit) & scene.present(who)
        extreme.append(float(speed.min() if below else speed.max()))
        fallen = edges(case, true)
        if below and value is None:
            # "When it stops" names no speed: any moment from where it slows down may be meant.
            fallen = tuple(Instant(_slows_from(case, speed, i.late_s), i.late_s) for i in fallen)
        found += fallen
    shown = [round(e, 2) for e in extreme]
    return Fired(_sorted(found), why=f'{shown} m/s against {limit:g}')


def _slows_from(case: Case, speed: FloatArray, end_s: float) -> float:
    """Return the time (s) from which a speed (ticks,) only falls until a time."""
    times = case.scene.times
    tick = int(np.searchsorted(times, end_s))
    while tick > 0 and speed[tick - 1] > speed[tick]:
        tick -= 1
    return float(times[tick])


def _battery(case: Case, trigger: Mapping[str, Any]) -> Fired:
    value = float(trigger.get('value', 0.0))
    level = value / 100.0 if value > 1.0 else value
    found = []
    for uav in case.bodies(trigger.get('uav')):
        first = edges(case, battery(case, uav, from_power=True) < level)
        # Take-off is where it is reported, or where the UAV has left the ground.
        found += [
            Instant(min(early.early_s, late.early_s), late.late_s)
            for early, late in zip(first, edges(case, battery(case, uav) < level), strict=False)
        ]
    return Fired(_sorted(found), why=f'battery below {level:.0%}')


def battery(case: Case, uav: str, *, from_power: bool = False) -> FloatArray:
    """Return (ticks,) the share left: full at take-off, empty at the endurance.

    Args:
        from_power: Count from where a UAV reports that it has taken off, before it is up.
    """
    scene = case.scene
    flies = scene.powered(uav) if from_power else scene.airborne(uav)
    flown = np.cumsum(flies) * scene.dt_s
    return np.asarray(1.0 - flown / scene.limit('uav_endurance_s'))


def _sorted(found: Sequence[Instant]) -> tuple[Instant, ...]:
    return tuple(sorted(found, key=lambda i: (i.late_s, i.early_s)))
