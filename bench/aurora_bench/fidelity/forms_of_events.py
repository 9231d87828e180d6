# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Events, missions and orders that say the same in another form (`equivalences.py`)."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_bench.fidelity.chains import is_same_ascent, is_same_event, is_same_moment
from aurora_bench.fidelity.events import action_fields
from aurora_bench.fidelity.fields import Case, Subject
from aurora_bench.fidelity.moments import onset_of
from aurora_bench.fidelity.numbers import NumberRule
from aurora_bench.prompts.format import EventRequirement, OrderRequirement
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import (
    Event,
    EventDoneTrigger,
    MissionDoneTrigger,
    ScenarioSpec,
    UavAction,
    UavMission,
)


def other_moments(r: EventRequirement, case: Case) -> Iterator[str]:
    """Return the missions, events and onsets of triggers that an annotated event is as well."""
    subject = case.subject
    mission = _next_mission(r, subject, case.rule)
    if mission is not None:
        yield mission.id
    for event in subject.spec.events:
        is_moment = is_same_moment(r, event, subject, case.rule, asked=case.asked)
        if is_moment and event.trigger is not None and event.action is not None:
            yield onset_of(event.trigger)
        is_ascent = is_same_ascent(r, event, subject, case.rule)
        if is_ascent or _is_its_landing(r, event, subject, case.rule):
            yield event.id


def is_next_mission(case: Case) -> bool:
    """Whether a change of mission after a mission is the next mission of a sequence."""
    r = case.requirement
    return (
        isinstance(r, EventRequirement) and _next_mission(r, case.subject, case.rule) is not None
    )


def _next_mission(r: EventRequirement, subject: Subject, rule: NumberRule) -> UavMission | None:
    """Return the mission that a UAV goes on to by itself, as the event wants it."""
    if r.trigger is None or r.action is None:
        return None
    if (r.trigger.on, r.action.do) != ('mission_done', 'change_mission'):
        return None
    flown: set[str] = set()
    for mission in subject.spec.missions:
        is_next = mission.uav in flown
        flown.add(mission.uav)
        named = [name for name in (r.trigger.uav, r.action.uav) if name is not None]
        if not is_next or not all(subject.binding.means(name, mission.uav) for name in named):
            continue
        if any(_begins(event, mission) for event in subject.spec.events):
            continue
        change = UavAction(do='change_mission', uav=mission.uav, mission=mission.id)
        if all(action_fields(r.action, change, subject, rule).values()):
            return mission
    return None


def _begins(event: Event, mission: UavMission) -> bool:
    """Whether something else than the end of the mission before begins a mission."""
    action, trigger = event.action, event.trigger
    if not isinstance(action, UavAction) or action.mission != mission.id:
        return False
    return not (isinstance(trigger, MissionDoneTrigger) and trigger.uav == mission.uav)


def _is_its_landing(r: EventRequirement, event: Event, subject: Subject, rule: NumberRule) -> bool:
    """Whether an event is the landing that an annotation names without saying its cause."""
    if r.trigger is not None or r.action is None or r.action.do != 'land':
        return False
    if event.action is None or event.action.do != 'land':
        return False
    return all(action_fields(r.action, event.action, subject, rule).values())


def is_chain_by(event: Event, case: Case, *, ascents: bool = True) -> bool:
    """Whether one event of the specification is the annotated one, told by other links."""
    r = case.requirement
    return isinstance(r, EventRequirement) and is_same_event(
        r, event, case.subject, case.rule, asked=case.asked, ascents=ascents
    )


def is_chain(case: Case, *, ascents: bool) -> bool:
    """Whether an event is set off by the same, after the same time, told by other links."""
    r = case.requirement
    return isinstance(r, EventRequirement) and any(
        is_chain_by(event, case, ascents=ascents)
        for event in case.subject.spec.events
        # An event of the prompt has one of its own.
        if case.is_reading or case.subject.binding.moments.get(r.ref) == event.id
    )


def is_onset(case: Case) -> bool:
    """Whether a milestone is the moment at which another event is set off."""
    r = case.requirement
    return isinstance(r, EventRequirement) and any(
        is_same_moment(r, event, case.subject, case.rule, asked=case.asked)
        for event in case.subject.spec.events
    )


def is_ascent(case: Case) -> bool:
    """Whether the end of an ascent is told as an altitude that is reached, or turned round."""
    r = case.requirement
    if not isinstance(r, EventRequirement):
        return False
    return is_chain(case, ascents=True) or any(
        is_same_ascent(r, event, case.subject, case.rule) for event in case.subject.spec.events
    )


def is_ordered(case: Case) -> bool:
    """Whether an order holds between other elements that say the same."""
    r, binding = case.requirement, case.subject.binding
    if not isinstance(r, OrderRequirement):
        return False
    pairs = [(a, b) for a in binding.moments_of(r.first) for b in binding.moments_of(r.then)]
    pairs = [pair for pair in pairs if pair in case.subject.before]
    if r.within_s is None:
        return bool(pairs)
    return any(
        case.rule.counts('within_s', r.within_s, deadline)
        for pair in pairs
        for deadline in _deadlines(*pair, case.subject.spec)
    )


def _deadlines(first: str, then: str, spec: ScenarioSpec) -> Iterator[Parameter]:
    """Return the seconds after one moment within which another is to come."""
    for order in spec.orders:
        if (order.first, order.then) == (first, then) and order.within_s is not None:
            yield order.within_s
    for event in spec.events:
        delay_s, trigger = event.delay_s, event.trigger
        if event.id != then or trigger is None or delay_s is None:
            continue
        after = {onset_of(trigger)}
        if isinstance(trigger, EventDoneTrigger) and trigger.after_s is None:
            after.add(trigger.event)
        if first in after and delay_s.bound is Bound.AT_MOST:
            yield delay_s
