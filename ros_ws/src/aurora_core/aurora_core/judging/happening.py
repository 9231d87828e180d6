# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the quantities of events share: that they never happened, how they begin, who acts."""

from __future__ import annotations

from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs
from aurora_core.judging.evaluation import Context, Missing
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.events import reports_own_altitude
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import AgentAction, DistanceTrigger, Event, SendMessage
from aurora_core.stl.syntax import format_number

# What moments of events rest on.
EVENT_TOPICS = ('ground/state', 'uav/state', 'comm')


def never_happened(context: Context, condition: Condition, story: str) -> Missing:
    """Return that what a condition is about never happened, or that the record is too short."""
    if not context.complete(condition):
        return context.short(condition)
    return Missing(reason=Reason.PREMISE_NEVER, story=story)


def triggered(context: Context, condition: Condition, event_id: str) -> int | Missing:
    """Return the tick at which an event was triggered, or that it never was."""
    tick = context.events.trigger_tick(event_id)
    if tick is None:
        return never_happened(context, condition, f'the trigger of {event_id} never happened')
    return tick


def trigger_story(context: Context, event_id: str, tick: int) -> str:
    """Return what happened when an event was triggered, as the beginning of a sentence."""
    event = context.events.event(event_id)
    trigger = None if event is None else event.trigger
    when = f'at {context.time_s(tick):.2f} s'
    if isinstance(trigger, DistanceTrigger):
        within = 'within' if trigger.on == 'distance_below' else 'beyond'
        metres = format_number(trigger.value_m.value)
        return f'{trigger.a} came {within} {metres} m of {trigger.b} {when}'
    return f'{event_id} was triggered {when}'


def unready_story(context: Context, event_id: str) -> str:
    """Return, to end a sentence, that who sends a message could not yet when it was due."""
    times = context.events
    event, due = times.event(event_id), times.due_tick(event_id)
    if event is None or due is None or not isinstance(event.action, SendMessage):
        return ''
    if reports_own_altitude(event) or times.possible_tick(event_id, due) != due:
        return ''
    ready, flight = times.reports_from(event, due), times.rules.flights.get(event.action.sender)
    if ready is None or ready <= due or flight is None:
        return ''
    climbs = flight.ascent_end_tick is None or flight.ascent_end_tick > due
    what = 'was still climbing' if climbs else 'had not captured its target'
    return (
        f'; {event.action.sender} {what} at {context.time_s(due):.2f} s, when it was due: it can '
        f'send from {context.time_s(ready):.2f} s on'
    )


def agent_action(context: Context, condition: Condition, event_id: str) -> AgentAction:
    """Return what an event makes a ground agent do.

    Raises:
        VerificationError: It is no action of a ground agent.
    """
    event = context.events.event(event_id)
    if event is None or not isinstance(event.action, AgentAction):
        raise VerificationError(f'condition {condition.id} names no action of a ground agent')
    return event.action


def moment(context: Context, event_id: str) -> int | None:
    """Return the tick of an event's action, of its trigger where it has no action."""
    trigger = context.events.trigger_tick(event_id)
    event = context.events.event(event_id)
    if event is not None and event.action is not None:
        return context.events.action_tick(event_id, trigger or 0)
    return trigger


def earliest_s(inputs: Inputs, event: Event) -> float:
    """Return how long after its trigger an event has to wait at least, seconds."""
    delay = event.delay_s
    if delay is None or delay.provenance is not Provenance.EXPLICIT:
        return 0.0
    slack_s = inputs.tolerances.duration_s.of(event.waits_s, approximate=delay.approximate)
    return max(0.0, event.waits_s - slack_s)
