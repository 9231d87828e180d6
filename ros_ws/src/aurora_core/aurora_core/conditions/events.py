# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by events, alerts and what an event makes a ground agent do."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.links import (
    is_needed,
    link_between,
    link_conditions,
    loses_messages,
)
from aurora_core.conditions.stated_links import is_kept_from
from aurora_core.judging.build import Inputs, Source, Underivable, number
from aurora_core.judging.happening import earliest_s
from aurora_core.judging.mission import missions_of_uav
from aurora_core.judging.quantities import (
    altitude,
    completion_delay,
    deceleration,
    delivered,
    delivery_latency,
    event_delay,
    event_time,
    lane_change,
    message_text,
    moving_before_action,
    return_distance,
    sent_after_capture,
    speed_before_event,
    vertical_speed,
    visible_at_send,
    yielding,
)
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.events import (
    actor_of,
    comes_to_an_end,
    reports_own_altitude,
    sets_off,
)
from aurora_core.spec.flight_order import begun_by, climbs_last
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.parking import crosses_from_wait
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    Link,
    SendMessage,
    TimeTrigger,
    UavAction,
)

# What an agent may not have done before it is asked to.
_NOT_BEFORE = frozenset({'start', 'cross', 'change_lane'})

# What a driver does for traffic as well: in a stated wait it counts on a free road alone.
_TAKES_SPEED_OFF = frozenset({'brake', 'stop', 'slow'})
# Actions that with a stated number end with a speed.
_TO_A_SPEED = frozenset({'slow', 'accelerate', 'start', 'brake'})


def event_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all events and of the messages that they send."""
    used: set[str] = set()
    for event in inputs.spec.events:
        if event.trigger is None and event.action is None:
            what = 'an event without trigger and action'
            yield Underivable(element=event.id, what=what, span=event.span)
            continue
        source = Source(ids=(event.id,), spans=(event.span,))
        action = event.action
        yield from _moment(inputs, event, source)
        if isinstance(action, AgentAction):
            yield from _of_agent(inputs, event, action, source)
        if isinstance(action, UavAction) and action.altitude_m is not None:
            yield altitude.climb(inputs, action, action.altitude_m, event, source)
            if action.vertical_mps is not None:
                yield vertical_speed.of_event(inputs, event, action, action.vertical_mps, source)
            if event.trigger is not None and not climbs_last(event):
                yield completion_delay.of_climb(inputs, event, action, action.altitude_m, source)
        if isinstance(action, UavAction) and action.do == 'return_home':
            flown = missions_of_uav(inputs, action.uav)
            if flown:
                yield return_distance.implied(inputs, event.id, flown, source)
        if isinstance(action, SendMessage):
            link = link_between(inputs.spec, action.sender, action.receiver)
            if link is None:
                what = f'message from {action.sender} to {action.receiver}: no link'
                yield Underivable(element=event.id, what=what, span=event.span)
                continue
            if link.id not in used:
                yield from link_conditions(inputs, link)
            used.add(link.id)
            yield from _alert(inputs, event, action, source)
            yield from _message(inputs, event, link)
            if action.text is not None:
                yield message_text.implied(inputs, event, action.text)
    for link in inputs.spec.links:
        if link.id in used:
            continue
        if link.rate_hz is not None:
            yield from link_conditions(inputs, link)
        else:
            yield Underivable(element=link.id, what='a link without a message', span=link.span)


def _moment(inputs: Inputs, event: Event, source: Source) -> Iterator[Condition]:
    if event.trigger is None:
        yield event_time.happens(inputs, event, 'action', source)
        return
    if event.action is None:
        yield event_time.happens(inputs, event, 'trigger', source)
        return
    delay_s, provenance = 0.0, Provenance.DEFAULT
    first_s = earliest_s(inputs, event)
    if event.delay_s is not None:
        delay_s, provenance = event.waits_s, event.delay_s.provenance
    latest_s = delay_s + inputs.tolerances.event_delay_s
    if _steps_on(inputs, event):
        # Who is to cross stands at the kerb by then.
        latest_s = delay_s + inputs.tolerances.duration_s.of(delay_s, approximate=False)
    deadline_s = event.deadline_s
    if deadline_s is not None:
        latest_s = deadline_s
    source = Source(ids=source.ids, spans=source.spans, provenance=provenance)
    climbs = isinstance(event.action, UavAction) and event.action.do == 'ascend'
    drives = isinstance(event.action, AgentAction) and not _binds_before(inputs, event)
    # What is left of a climb before says nothing in the first moments of a wait.
    waits = drives or (climbs and first_s >= inputs.tolerances.phase_change_s)
    yield event_delay.within(inputs, event, latest_s, first_s if waits else 0.0, source)
    if deadline_s is not None and comes_to_an_end(event.action):
        yield completion_delay.by_deadline(inputs, event, deadline_s, source)
    if not (drives or climbs):
        # Drivers slow down and speed up for many reasons, and a UAV has climbed at its take-off:
        # what was before says nothing. What they do before a stated delay is over neither, and
        # whoever did it then is late.
        yield event_delay.not_before(inputs, event.id, first_s, source)
    if isinstance(event.action, AgentAction) and event.action.do in _TAKES_SPEED_OFF:
        kept = event_delay.driver_waits(inputs, event, source)
        if kept is not None:
            yield kept
    if isinstance(event.trigger, TimeTrigger):
        at = event.trigger.at_s
        if at.provenance is Provenance.EXPLICIT:
            yield event_time.at(inputs, event, at, delay_s, source)


def _steps_on(inputs: Inputs, event: Event) -> bool:
    """Tell whether an event is a step onto the carriageway by who stands at the kerb before."""
    crosses = isinstance(event.action, AgentAction) and event.action.do == 'cross'
    return crosses and not crosses_from_wait(inputs.spec, event)


def _binds_before(inputs: Inputs, event: Event) -> bool:
    """Tell whether what an agent did before the trigger would be the action itself, too early.

    Who is to start again has driven before.
    """
    action = event.action
    if not isinstance(action, AgentAction) or action.do not in _NOT_BEFORE:
        return False
    return action.do != 'start' or sets_off(inputs.spec.events, action.agent) == event


def _of_agent(
    inputs: Inputs, event: Event, action: AgentAction, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield that an agent completes what an event makes it do, and does not begin too early.

    That something changes after the trigger is a condition of every event; here is that the agent
    comes to rest, gets to its speed or lane, keeps to that lane, lets the other one pass, and does
    not set off too early.
    """
    value, goes_to = action.value_mps, action.do in _TO_A_SPEED
    if value is not None and not goes_to:
        what = f'a speed of {number(value.value)} m/s with {action.do}'
        yield Underivable(element=event.id, what=what, span=value.span)
    goal = value if goes_to else None
    if goal is not None or action.do in completion_delay.ENDS:
        yield completion_delay.implied(inputs, event, action, goal, source)
    if action.deceleration_mps2 is not None:
        yield deceleration.of_event(inputs, event, action, action.deceleration_mps2, source)
    if action.do == 'start' and event.trigger is not None:
        yield speed_before_event.implied(inputs, event, action, source)
    moving = moving_before_action.implied(inputs, event, action, source)
    if moving is not None:
        yield moving
    if action.do == 'change_lane':
        yield lane_change.after_event(inputs, event, action, source)
    if action.do == 'yield':
        yield yielding.after_event(inputs, event, action, source)


def _alert(
    inputs: Inputs, event: Event, action: SendMessage, source: Source
) -> Iterator[Condition]:
    """Yield the conditions of an alert by a UAV: after ascent or capture, actor in sight.

    A report of its own altitude comes when that is reached, which may be on its way up.
    """
    missions = missions_of_uav(inputs, action.sender)
    if not missions or reports_own_altitude(event):
        return
    # Of a UAV that tracks from some event on, what it sees before is an alert as well.
    waiting = {m.id for m in inputs.spec.missions if begun_by(inputs.spec, m) is not None}
    missions = tuple(m for m in missions if m.mission not in waiting) or missions
    yield sent_after_capture.implied(inputs, event, action, missions, source)
    actor = actor_of(event)
    if actor is not None and actor != action.sender:
        yield visible_at_send.implied(inputs, event, action.sender, actor, source)


def _message(inputs: Inputs, event: Event, link: Link) -> Iterator[Condition]:
    kept = any(is_kept_from(stated, link) for stated in inputs.spec.conditions)
    if not kept and (is_needed(inputs.spec, link) or not loses_messages(link)):
        yield delivered.implied(inputs, event, link)
    if link.latency_s.provenance is Provenance.EXPLICIT:
        yield delivery_latency.implied(inputs, event, link)
