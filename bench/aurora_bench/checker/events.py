# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events (trigger, delay, action) and the order of events and missions."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from aurora_bench.checker import braking, limits, uav_actions
from aurora_bench.checker.actions import GROUND_ACTIONS, Acted, Window, ground_action
from aurora_bench.checker.answers import (
    Judged,
    Outcome,
    all_of,
    cannot_tell,
    does_not,
    graded,
    holds,
)
from aurora_bench.checker.case import Case, Requirement
from aurora_bench.checker.phases import ascent_end_tick
from aurora_bench.checker.triggers import Fired, Instant, fired

# Triggers of a state count from their first time; of happenings any one may be meant.
HAPPENINGS = ('message_received', 'mission_done', 'event_done', 'event_begun', 'arrives')
MOST_INSTANTS = 40
# What a driver also does for traffic or a signal.
TRAFFIC_ASKS = ('brake', 'stop', 'slow', 'yield', 'accelerate')
# "Within 6 s" asks that these are over then, and the second ones where they lead to a speed.
ENDS = ('stop', 'change_lane', 'land', 'return_home', 'ascend')
ENDS_WITH_A_SPEED = ('slow', 'accelerate')
OWN_FLIGHT = ('ascend', 'change_mission', 'land')
STATES = (
    'distance_below',
    'distance_above',
    'visible',
    'occluded',
    'arrives',
    'speed_below',
    'speed_above',
)


@dataclass(frozen=True, slots=True)
class Happened:
    """What became of an event."""

    judged: Judged
    start_s: float | None = None
    done_s: float | None = None
    done_from_s: float | None = None


def _became(judged: Judged, acted: Acted) -> Happened:
    return Happened(judged, acted.start_s, acted.done_s, acted.done_from_s)


def happened(case: Case, requirement: Requirement) -> Happened:
    """Return whether an event happened as annotated, and when."""
    key = ('event', id(requirement))
    if key not in case.memory:
        # An event that waits for itself through others is never done.
        case.memory[key] = Happened(cannot_tell('the events wait for each other'))
        case.memory[key] = _happened(case, requirement)
    found = case.memory[key]
    assert isinstance(found, Happened)
    return found


def _happened(case: Case, requirement: Requirement) -> Happened:
    trigger, action = requirement.get('trigger') or {}, requirement.get('action') or {}
    for part in (trigger, action):
        names = (v for k, v in part.items() if isinstance(v, str) and k != 'text')
        gone = case.missing(*names)
        if gone:
            return Happened(does_not(f'there is no {gone}'))
    if not trigger:
        if not action:
            return Happened(cannot_tell('an event without trigger and action'))
        begin = 0.0
        if action.get('do') in TRAFFIC_ASKS:
            # "Braking for traffic or a signal is no action": what comes before its turn is none.
            begin, _ = _ready_s(case, requirement, action)
        acted = _act(case, requirement, action, Window(begin, case.scene.end_s, free=True))
        return _became(acted.judged, acted)
    when = fired(case, trigger, partial(_moment, case))
    if when.unclear:
        return Happened(cannot_tell(when.unclear))
    if not when.instants:
        return Happened(does_not(f'the trigger never became true ({when.why})'))
    instants = _delayed(requirement, trigger, _rested(case, trigger, action, when.instants))
    if not action:
        first = instants[0]
        why = holds(f'at {first.late_s:.2f} s')
        return Happened(why, first.early_s, first.late_s, first.early_s)
    return _answered(case, requirement, trigger, action, instants)


def _rested(
    case: Case,
    trigger: Mapping[str, Any],
    action: Mapping[str, Any],
    instants: tuple[Instant, ...],
) -> tuple[Instant, ...]:
    """Let who stops and then drives on stand for the time that makes it a stop."""
    cause = case.annotation.events.get(str(trigger.get('event')), {}).get('action') or {}
    stops = trigger.get('on') == 'event_done' and cause.get('do') == 'stop'
    goes_on = action.get('do') in ('start', 'accelerate', 'change_lane')
    if not stops or not goes_on or trigger.get('after_s') is not None:
        return instants
    if cause.get('agent') != action.get('agent'):
        return instants
    return tuple(replace(i, late_s=i.late_s + limits.STOPPED_S) for i in instants)


def trigger_of(case: Case, requirement: Requirement) -> tuple[Instant, ...]:
    """Return when an event was due, by its trigger and delay; none where that is unclear."""
    trigger = requirement.get('trigger') or {}
    when = fired(case, trigger, partial(_moment, case))
    return () if when.unclear else _delayed(requirement, trigger, when.instants)


def _delayed(
    requirement: Requirement, trigger: Mapping[str, Any], instants: tuple[Instant, ...]
) -> tuple[Instant, ...]:
    """Add the delay, and the tolerance of stated times."""
    delay = float(requirement.get('delay_s') or trigger.get('delay_s') or 0.0)
    stated = delay or float(trigger.get('after_s') or trigger.get('at_s') or 0.0)
    slack = limits.tolerance(limits.DURATION, stated) if stated else 0.0
    # Being late is forgiven once: by the second of the onset, or by a greater tolerance.
    more = max(slack - limits.ONSET_S, 0.0)
    after = float(trigger.get('after_s') or 0.0)
    return tuple(
        Instant(
            max(i.early_s + delay - slack, 0.0),
            i.late_s + delay + more,
            i.early_s - after if delay or after else None,
        )
        for i in instants[:MOST_INSTANTS]
    )


def _answered(
    case: Case,
    requirement: Requirement,
    trigger: Mapping[str, Any],
    action: Mapping[str, Any],
    instants: tuple[Instant, ...],
) -> Happened:
    ready, at_last = _ready_s(case, requirement, action)
    # A UAV sends nothing before its ascent is over, and a stated time does not wait for that.
    binds = action.get('do') == 'send_message' and _is_timed(trigger)
    usable = tuple(
        i
        if i.late_s >= at_last
        else Instant(
            max(i.early_s, ready), i.late_s if binds else max(i.late_s, at_last), i.told_s
        )
        for i in instants
    )
    tried = [
        _act(case, requirement, action, Window(i.early_s, i.late_s, told_s=i.told_s))
        for i in usable
    ]
    good = [k for k, a in enumerate(tried) if a.judged.outcome is Outcome.HOLDS]
    if requirement.get('once') is False:
        judged = all_of([a.judged for a in tried])
        return Happened(judged, tried[0].start_s, tried[-1].done_s)
    tried = [_in_time(requirement, action, i, a) for i, a in zip(usable, tried, strict=True)]
    good = [k for k in good if tried[k].judged.outcome is Outcome.HOLDS]
    if not good:
        doubtful = [a for a in tried if a.judged.outcome is Outcome.CANNOT_TELL]
        best = (doubtful or tried)[0]
        at = usable[tried.index(best)]
        why = f'trigger at {at.late_s:.2f} s: {best.judged.why}'
        return _became(Judged(best.judged.outcome, why), best)
    k = good[0]
    best, at = tried[k], usable[k]
    why = f'trigger at {at.late_s:.2f} s: {best.judged.why}'
    # What holds from t = 0 on, before anything has moved, is no occurrence of its own.
    firsts = sum(1 for i in instants if i.late_s <= case.scene.dt_s)
    firsts += sum(1 for i in instants if i.late_s < ready)
    if trigger.get('on') in HAPPENINGS or k <= firsts:
        return _became(holds(why), best)
    first = f'not at the first time ({usable[0].late_s:.2f} s: {tried[0].judged.why})'
    return _became(cannot_tell(f'{why}, {first}'), best)


def _in_time(
    requirement: Requirement, action: Mapping[str, Any], at: Instant, acted: Acted
) -> Acted:
    """Hold an action against a stated deadline: its end, or its beginning if it has none."""
    within = requirement.get('within_s')
    if within is None or acted.judged.outcome is not Outcome.HOLDS:
        return acted
    ends = action.get('do') in ENDS or (
        action.get('do') in ENDS_WITH_A_SPEED and action.get('value_mps') is not None
    )
    moment = acted.done_s if ends else acted.start_s
    if moment is None:
        return replace(acted, judged=cannot_tell(f'{acted.judged.why}; when it was done is open'))
    most = float(within) + limits.tolerance(limits.DURATION, float(within))
    why = f'{acted.judged.why}; {"done" if ends else "begun"} at {moment:.2f} s'
    first = moment if not ends or acted.done_from_s is None else acted.done_from_s
    late = graded(moment - at.early_s <= most, first - at.late_s <= most, why)
    return replace(acted, judged=late)


def _is_timed(trigger: Mapping[str, Any]) -> bool:
    """Tell whether it is stated when an event is due: a time, or how long after something."""
    return trigger.get('at_s') is not None or trigger.get('after_s') is not None


def _ready_s(
    case: Case, requirement: Requirement, action: Mapping[str, Any]
) -> tuple[float, float]:
    """Return from when on the event can happen, and at the latest can: after what it follows."""
    scene, ready = case.scene, 0.0
    actors = [action.get('uav')]
    if action.get('do') == 'send_message' and not _on_the_way_up(case, requirement, action):
        actors.append(action.get('sender'))
    for actor in actors:
        for body in case.bodies(actor):
            if scene.bodies[body].is_uav:
                ready = max(ready, float(scene.times[ascent_end_tick(scene, body)]))
    at_last = 0.0
    trigger = requirement.get('trigger') or {}
    if action.get('do') == 'send_message' and trigger.get('on') in STATES:
        # Who tracks somebody may report from its capture on.
        for body in case.bodies(action.get('sender')):
            if not scene.bodies[body].is_uav:
                continue
            flown = [m for m in case.annotation.requirements if _is_flown(m, case, body)]
            captured = uav_actions.first_captured(case, body)
            if captured is not None and flown[0].get('mode') == 'track':
                at_last = max(at_last, float(scene.times[captured[0]]))
            elif not flown:  # what it flies was left to the run: it may track, too
                at_last = max(at_last, ready + limits.CAPTURE_S)
    if action.get('do') in OWN_FLIGHT and trigger.get('on') in STATES:
        # What ends or changes a mission counts once that has begun: from its capture on.
        for body in case.bodies(action.get('uav')):
            captured = uav_actions.first_captured(case, body)
            if captured is not None:
                ready = max(ready, float(scene.times[captured[0]]))
                at_last = max(at_last, float(scene.times[captured[1]]))
    for order in case.annotation.requirements:
        if order['kind'] != 'order' or order.get('then') != requirement.get('ref'):
            continue
        first = case.annotation.events.get(str(order.get('first')))
        if first is not None and first is not requirement:
            start = happened(case, first).start_s
            ready = max(ready, start) if start is not None else ready
    return ready, max(ready, at_last)


def _on_the_way_up(case: Case, requirement: Requirement, action: Mapping[str, Any]) -> bool:
    """Tell whether a UAV is to report an altitude of its own, which it may reach in its ascent."""
    trigger = requirement.get('trigger') or {}
    own = set(case.bodies(trigger.get('uav'))) & set(case.bodies(action.get('sender')))
    return trigger.get('on') == 'altitude_reached' and bool(own)


def _is_flown(requirement: Requirement, case: Case, uav: str) -> bool:
    """Tell whether a requirement is a mission of a UAV."""
    return requirement['kind'] == 'mission' and uav in case.bodies(requirement.get('uav'))


def _moment(case: Case, event: str, *, begun: bool) -> Fired:
    found = happened(case, case.annotation.events[event])
    if begun:
        if found.start_s is not None:
            return Fired((Instant(found.start_s, found.start_s),), why=found.judged.why)
        if found.judged.outcome is Outcome.HOLDS:
            return Fired(unclear=f'when {event} began is open')
    if found.done_s is not None:
        early = found.done_s if found.done_from_s is None else found.done_from_s
        return Fired((Instant(early, found.done_s),), why=found.judged.why)
    if found.judged.outcome is Outcome.CANNOT_TELL:
        return Fired(unclear=f'{event}: {found.judged.why}')
    if found.start_s is not None and found.judged.outcome is Outcome.HOLDS:
        return Fired((Instant(found.start_s, case.scene.end_s),), why=found.judged.why)
    return Fired(why=found.judged.why)


def _act(case: Case, requirement: Requirement, action: Mapping[str, Any], window: Window) -> Acted:
    do = action.get('do')
    if do == 'send_message':
        return uav_actions.send(case, action, window)
    if do in GROUND_ACTIONS:
        agents = case.bodies(action.get('agent'))
        if not agents:
            return Acted(does_not(f'there is no {action.get("agent")!r}'))
        others = _others(case, requirement, agents)
        acted = [ground_action(case, action, agent, window, others) for agent in agents]
        number = braking.asked(case, requirement, action)
        if number is not None:
            acted = [
                replace(a, judged=all_of([a.judged, braking.braked(case, agent, start, number)]))
                for agent, a in zip(agents, acted, strict=True)
                for start in (window.early_s if a.start_s is None else a.start_s,)
            ]
        return _together(acted)
    uavs = case.bodies(action.get('uav'))
    if not uavs:
        return Acted(does_not(f'there is no {action.get("uav")!r}'))
    if do == 'hand_over':
        return uav_actions.hand_over(case, action, window)
    each = {
        'land': lambda uav: uav_actions.land(case, uav, window),
        'return_home': lambda uav: uav_actions.return_home(case, uav, window),
        'ascend': lambda uav: uav_actions.ascend(case, action, uav, window),
        'change_mission': lambda uav: uav_actions.change_mission(
            case, action, uav, window, requirement
        ),
    }.get(str(do))
    if each is None:
        return Acted(cannot_tell(f'action {do!r} is not known'))
    return _together(
        [uav_actions.as_fast(case, requirement, action, uav, each(uav)) for uav in uavs]
    )


def _together(parts: list[Acted]) -> Acted:
    starts = [p.start_s for p in parts if p.start_s is not None]
    ends = [p.done_s for p in parts]
    known = [e for e in ends if e is not None]
    done = max(known) if known and len(known) == len(ends) else None
    early = [p.done_s if p.done_from_s is None else p.done_from_s for p in parts]
    return Acted(
        all_of([p.judged for p in parts]),
        min(starts, default=None),
        done,
        done_from_s=max((e for e in early if e is not None), default=None),
    )


def _others(case: Case, requirement: Requirement, agents: tuple[str, ...]) -> tuple[str, ...]:
    """Return to whom somebody may have to yield: the others of the trigger, or of a behaviour."""
    trigger = requirement.get('trigger') or {}
    names = [trigger.get(k) for k in ('a', 'b', 'who', 'target')]
    names += [
        r.get('target')
        for r in case.annotation.flat()
        if r['kind'] == 'behavior'
        and r.get('behavior') == 'yield'
        and set(case.bodies(r.get('agent'))) & set(agents)
    ]
    found = [b for n in names for b in case.bodies(n)]
    ground = [b for b in found if not case.scene.bodies[b].is_uav and b not in agents]
    return tuple(dict.fromkeys(ground))


def ordered(
    case: Case, requirement: Requirement, spans: Mapping[str, tuple[float, float]]
) -> Judged:
    """Return whether one event or mission comes after another.

    Args:
        spans: Start and end of the flown missions of the annotated ones, by reference.
    """
    times = []
    for name in (requirement.get('first'), requirement.get('then')):
        ref = str(name)
        if ref in spans:
            times.append(spans[ref])
            continue
        if ref not in case.annotation.events:
            if ref in case.annotation.missions:
                return does_not(f'{ref} was not flown')
            return cannot_tell(f'{name!r} is neither an event nor a mission')
        found = happened(case, case.annotation.events[ref])
        if found.start_s is None:
            return Judged(
                Outcome.DOES_NOT
                if found.judged.outcome is Outcome.DOES_NOT
                else Outcome.CANNOT_TELL,
                f'{ref}: {found.judged.why}',
            )
        times.append((found.start_s, found.done_s if found.done_s is not None else found.start_s))
    (start_a, end_a), (start_b, _) = times
    why = f'{requirement["first"]} from {start_a:.2f} to {end_a:.2f} s'
    why += f', {requirement["then"]} from {start_b:.2f} s'
    slack = 2.0 * case.scene.dt_s
    judged = graded(end_a <= start_b + 0.5, start_a <= start_b + slack, why)
    within = requirement.get('within_s')
    if within is None:
        return judged
    most = float(within) + limits.tolerance(limits.DURATION, float(within)) + slack
    gaps = (start_b - end_a, start_b - start_a)
    late = graded(max(gaps) <= most, min(gaps) <= most, f'{why}, within {within:g} s')
    return all_of([judged, late])


def event_time(case: Case, name: str) -> tuple[float | None, Judged]:
    """Return when an event happened (its onset), and what is known of it."""
    if name not in case.annotation.events:
        return None, cannot_tell(f'{name!r} is no annotated event')
    found = happened(case, case.annotation.events[name])
    return found.start_s, found.judged
