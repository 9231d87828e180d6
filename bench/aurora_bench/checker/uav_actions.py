# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Actions of UAVs and messages: send, change of mission, land, ascend, return, hand over."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np

from aurora_bench.checker import limits, missions
from aurora_bench.checker.actions import Acted, Window
from aurora_bench.checker.answers import (
    all_of,
    any_of,
    cannot_tell,
    decide,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.flight import Flight
from aurora_bench.checker.numbers import wanted
from aurora_bench.checker.phases import Segment, landing_tick, segments
from aurora_bench.checker.recording import LinkKind

STEPS = 2
VERTICAL = 'action.vertical_mps'


def _inside(case: Case, window: Window, time_s: float) -> bool:
    slack = STEPS * case.scene.dt_s
    return window.free or window.early_s - slack <= time_s <= window.last_s + slack


def _words(window: Window) -> str:
    return 'at any time' if window.free else f'{window.early_s:.2f} to {window.last_s:.2f} s'


def send(case: Case, action: Mapping[str, Any], window: Window) -> Acted:
    """Return whether a message was sent in time and received."""
    receivers = case.bodies(action.get('receiver'))
    sender = action.get('sender')
    senders = case.bodies(sender) if sender is not None else tuple(case.scene.bodies)
    if not receivers or not senders:
        return Acted(does_not(f'no body for {sender!r} or {action.get("receiver")!r}'))
    parts, starts, ends = [], [], []
    for receiver in receivers:
        part = _send_to(case, senders, receiver, window)
        parts.append(part.judged)
        starts += [part.start_s] if part.start_s is not None else []
        ends += [part.done_s] if part.done_s is not None else []
    # "After it has warned": once the message is out, or once it has arrived.
    sent = max(starts, default=None)
    return Acted(all_of(parts), min(starts, default=None), max(ends, default=None), sent)


def _send_to(case: Case, senders: tuple[str, ...], receiver: str, window: Window) -> Acted:
    ledger = case.scene.recording.ledger
    sent = [
        e
        for e in ledger
        if e.kind is LinkKind.SENT and e.sender in senders and e.receiver == receiver
    ]
    fitting = [e for e in sent if _inside(case, window, e.time_s)]
    if not fitting:
        times = [round(e.time_s, 2) for e in sent]
        if not window.free and window.last_s > case.scene.end_s:
            return Acted(cannot_tell(f'the recording ends before {window.last_s:.2f} s'))
        why = f'{senders} to {receiver}: sent at {times} s, asked {_words(window)}'
        return Acted(does_not(why))
    entry = fitting[0]
    got = [e.time_s for e in ledger if e.kind is LinkKind.DELIVERED and e.message == entry.message]
    needed, bound = _delivery(case, entry.sender, receiver)
    why = f'{entry.sender} to {receiver}: sent {entry.time_s:.2f} s'
    early = [
        uav
        for uav in (entry.sender,)
        if case.scene.bodies[uav].is_uav
        and not case.scene.airborne(uav)[case.scene.tick(entry.time_s)]
    ]
    if early:
        return Acted(does_not(f'{why}, from the ground'), entry.time_s)
    if not got:
        left = case.scene.end_s - entry.time_s < bound
        judged = graded(not needed, left, f'{why}, never received')
        return Acted(judged, entry.time_s, None if needed else entry.time_s)
    took = got[0] - entry.time_s
    slack = limits.LATENCY_STEPS * case.scene.dt_s
    judged = decide(took <= bound + slack, f'{why}, received {got[0]:.2f} s')
    return Acted(judged, entry.time_s, got[0])


def _delivery(case: Case, sender: str, receiver: str) -> tuple[bool, float]:
    """Return whether a message has to arrive, and within which time."""
    for link in case.annotation.flat():
        if link['kind'] != 'link' or link.get('negate'):
            continue
        if sender in case.bodies(link.get('sender')) and receiver in case.bodies(
            link.get('receiver')
        ):
            tries = link.get('retransmissions', limits.RETRANSMISSIONS)
            latency = float(link.get('latency_s') or limits.LATENCY_S)
            lossy = float(link.get('loss') or 0.0) > 0.0
            needed = not (lossy and tries == 0) and float(link.get('loss') or 0.0) < 1.0
            needed = needed and not link.get('outage_s')
            needed = needed and not _kept_from(case, sender, receiver)
            most = latency * (1 + tries) + tries * limits.RETRANSMISSION_GAP_S
            return needed, max(limits.DELIVERED_S, most)
    return not _kept_from(case, sender, receiver), limits.DELIVERED_S


def _kept_from(case: Case, sender: str, receiver: str) -> bool:
    """Tell whether it is annotated that what is sent never arrives."""
    return any(
        one['kind'] == 'condition'
        and one.get('quantity') == 'delivered'
        and one.get('value') is False
        and not one.get('negate')
        and sender in case.bodies(one['of'][0])
        and receiver in [body for name in one['of'][1:] for body in case.bodies(name)]
        for one in case.annotation.flat()
    )


def change_mission(
    case: Case, action: Mapping[str, Any], uav: str, window: Window, event: Mapping[str, Any]
) -> Acted:
    """Return whether another mission began in time, and is the annotated one."""
    found = segments(case.scene, uav)
    # Who is asked for no other mission waits on the ground for this one.
    others = any(
        r['kind'] == 'mission' and uav in case.bodies(r.get('uav')) for r in case.annotation.flat()
    )
    fitting = [
        s
        for s in found
        if s.number >= int(others) and _inside(case, window, float(case.scene.times[s.start]))
    ]
    if not fitting:
        times = [round(float(case.scene.times[s.start]), 2) for s in found]
        return Acted(does_not(f'{uav} begins missions at {times} s, asked {_words(window)}'))
    readings = [(_change(case, action, uav, s, event), s) for s in fitting]
    best = any_of([j for j, _ in readings])
    segment = next(s for j, s in readings if j.outcome is best.outcome)
    start = float(case.scene.times[segment.start])
    # It has been done once the UAV is where the mission begins: what follows counts from there.
    there = missions.captured_tick(_flight(case, action, uav, segment), action)
    done = None if there is None else float(case.scene.times[there])
    return Acted(best, start, done, done_from_s=start)


def _change(
    case: Case, action: Mapping[str, Any], uav: str, segment: Segment, event: Mapping[str, Any]
) -> Any:
    if case.missing(action.get('target')):
        return does_not(f'there is no {action["target"]}')
    requirement = {**action, 'id': event.get('id')}
    return missions.judge(_flight(case, action, uav, segment), requirement)


def _flight(case: Case, action: Mapping[str, Any], uav: str, segment: Segment) -> Flight:
    return Flight(
        scene=case.scene,
        uav=uav,
        segment=segment,
        targets=case.things(action.get('target')),
        variation=case.variation,
        until=segment.end,
    )


def land(case: Case, uav: str, window: Window) -> Acted:
    """Return whether a landing began in time and ended on the ground."""
    tick = landing_tick(case.scene, uav)
    if tick is None:
        return Acted(does_not(f'{uav} is never told to land'))
    start, down = float(case.scene.times[tick]), case.scene.landed_s(uav)
    why = f'{uav} goes down from {start:.2f} s'
    if not _inside(case, window, start):
        return Acted(does_not(f'{why}, asked {_words(window)}'), start, down)
    if down is None:
        return Acted(cannot_tell(f'{why}, still up as the recording ends'), start)
    return Acted(holds(f'{why}, landed at {down:.2f} s'), start, down)


def return_home(case: Case, uav: str, window: Window) -> Acted:
    """Return whether a UAV lands where it took off."""
    landed = land(case, uav, window)
    xy = case.scene.xy(uav)
    away = float(np.linalg.norm(xy[-1] - xy[0]))
    home = decide(away <= limits.RETURN_M, f'{uav} lands {away:.1f} m from its start')
    return Acted(all_of([landed.judged, home]), landed.start_s, landed.done_s)


def as_fast(
    case: Case, requirement: Requirement, action: Mapping[str, Any], uav: str, acted: Acted
) -> Acted:
    """Return what became of a climb or descent, with its stated speed."""
    stated = {**requirement, VERTICAL: action.get('vertical_mps')}
    number = wanted(stated, VERTICAL, case.variation, limits.VERTICAL)
    if number is None or acted.start_s is None or acted.done_s is None:
        return acted
    first, last = case.scene.tick(acted.start_s), case.scene.tick(acted.done_s)
    z = case.scene.altitude(uav)[first : last + 1]
    way = np.abs(z - z[0])
    steady = np.flatnonzero((way >= 0.2 * way[-1]) & (way <= 0.8 * way[-1]))
    if len(steady) < 3:
        return replace(acted, judged=cannot_tell(f'{uav} hardly climbs'))
    rate = abs(float(np.polyfit(steady * case.scene.dt_s, z[steady], 1)[0]))
    why = f'{uav} goes up or down with {rate:.2f} m/s, asked {number.text()}'
    near = number.off(rate) <= 0.1 * number.value
    return replace(acted, judged=all_of([acted.judged, graded(number.counts(rate), near, why)]))


def ascend(case: Case, action: Mapping[str, Any], uav: str, window: Window) -> Acted:
    """Return whether a UAV begins to climb, or to sink, in time and reaches the altitude."""
    scene = case.scene
    goal = action.get('altitude_m')
    first = 0 if window.free else scene.tick(window.early_s)
    z = scene.altitude(uav)
    # To an altitude below it, it sinks: the same, upside down.
    sinks = goal is not None and not window.free and z[first] > float(goal)
    z = -z if sinks else z
    rate = np.gradient(z, scene.dt_s)
    last = len(z) if window.free else scene.tick(window.last_s) + 1 + STEPS
    climbing = np.flatnonzero(rate[first:last] > 0.15)
    if goal is None:
        why = f'{uav} climbs {_words(window)}'
        if not len(climbing):
            return Acted(does_not(f'{uav} does not climb {_words(window)}'))
        start = float(scene.times[first + climbing[0]])
        rest = z[first + climbing[0] :]
        return Acted(graded(float(rest.max() - rest[0]) >= 2.0, True, why), start, start)
    slack = limits.tolerance(limits.ALTITUDE, float(goal))
    level = -float(goal) if sinks else float(goal)
    near = np.abs(z - level) <= slack
    if not window.free and near[scene.tick(window.early_s) : scene.tick(window.late_s) + 1].all():
        return Acted(holds(f'{uav} is at {goal:g} m'), window.late_s, window.late_s)
    if not len(climbing):
        if not window.free and window.last_s > scene.end_s:
            return Acted(cannot_tell('the recording ends before'))
        return Acted(does_not(f'{uav} does not climb {_words(window)}'))
    begin = first + int(climbing[0])
    reached = np.flatnonzero(near[begin:])
    if len(reached):
        # What is left of an ascent is no climb of its own: this one begins after the last level.
        way = rate[begin : begin + reached[0]]
        level_at = np.flatnonzero((way <= 0.15) & (z[begin : begin + reached[0]] < level - slack))
        later = begin + (int(level_at[-1]) + 1 if len(level_at) else 0)
        if later > last:
            why = f'{uav} climbs at {scene.times[later]:.2f} s, asked {_words(window)}'
            return Acted(does_not(why))
        reached, begin = reached - (later - begin), later
    start = float(scene.times[begin])
    if not len(reached):
        most = abs(float(z[begin:].max()))
        why = f'{uav} climbs from {start:.2f} s, gets to {most:.2f} of {goal:g} m'
        return Acted(does_not(why), start)
    done = float(scene.times[begin + reached[0]])
    # Half of the least climb rate that a limit allows is the slowest that counts.
    bound = abs(level - float(z[begin])) / 1.0 + 2.0
    why = f'{uav} climbs from {start:.2f} s, at {goal:g} m at {done:.2f} s'
    return Acted(graded(done - start <= bound, window.free, why), start, done)


def first_captured(case: Case, uav: str) -> tuple[int, int] | None:
    """Return the first and the last tick at which a UAV may have captured its first mission.

    None where no annotation tells of one. Climbs that change it are left out of account: they may
    wait for it. Where a hover is left soon, its point does not show: it may have been reached at
    any time until the UAV stands still, or goes.
    """
    found = segments(case.scene, uav)
    own = [
        r
        for r in case.annotation.requirements
        if r['kind'] == 'mission' and uav in case.bodies(r.get('uav')) and not r.get('negate')
    ]
    if not found or not own:
        return None
    whole = Flight(
        scene=case.scene,
        uav=uav,
        segment=found[0],
        targets=case.things(own[0].get('target')),
        variation=case.variation,
        until=found[0].end,
    )
    asked = own[0]
    if asked.get('altitude_m') is None:
        # The altitude with which it begins: a climb may change it later.
        asked = {**asked, 'altitude_m': float(case.scene.altitude(uav)[found[0].start])}
    early = missions.captured_tick(whole, asked)
    if early is None:
        return None
    if asked.get('mode') == 'navigate':  # the first point of a route shows by the turn there
        return found[0].start, early
    if asked.get('mode') != 'hover':
        # Unstated, it may be above its target that it has to be.
        above = missions.captured_tick(whole, {**asked, missions.ABOVE: True})
        bare = asked.get('standoff_m') is None and asked.get('side') is None
        return early, max(early, above) if bare and above is not None else early
    still = np.flatnonzero(case.scene.speed(uav)[early : found[0].end] < limits.STOPPED_MPS)
    return early, early + int(still[0]) if len(still) else found[0].end


def hand_over(case: Case, action: Mapping[str, Any], window: Window) -> Acted:
    """Return what can be seen of a hand-over: the other UAV begins a mission."""
    others = case.bodies(action.get('to'))
    parts = [part for uav in others for part in segments(case.scene, uav)]
    starts = [float(case.scene.times[part.start]) for part in parts]
    for uav in others:  # who is still on the ground begins by taking off
        up = np.flatnonzero(case.scene.airborne(uav))
        starts += [float(case.scene.times[up[0]])] if len(up) else []
    if not any(_inside(case, window, s) or s <= window.last_s for s in starts):
        return Acted(does_not(f'{action.get("to")} begins no mission ({starts} s)'))
    return Acted(cannot_tell('who observes whom after a hand-over is not in the states'))
