# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of what ground agents are made to do by events: complete, from rest, let pass."""

from __future__ import annotations

import numpy as np

from aurora_core.errors import VerificationError
from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    Later,
    Measured,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.monitor.measure_events import never_happened, trigger_story
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.actions import ends_with_mps
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.events import sets_off
from aurora_core.spec.scenario import AgentAction, EventDoneTrigger


def _event(context: Context, condition: Condition) -> tuple[str, AgentAction]:
    name = condition.arguments.event
    event = None if name is None else context.events.event(name)
    if event is None or not isinstance(event.action, AgentAction):
        raise VerificationError(f'condition {condition.id} names no action of a ground agent')
    return event.id, event.action


def measure_completion_delay(context: Context, condition: Condition) -> Evaluation:
    """Seconds from when an action is due to its completion, beyond those that it needs.

    It needs the change of speed divided by what the agent can do. An action without a trigger is
    never late: it has to be complete at some time.
    """
    event_id, action = _event(context, condition)
    times = context.events
    due = times.due_tick(event_id)
    asked = times.event(event_id)
    if asked is not None and asked.trigger is None:
        return _at_some_time(context, condition, event_id)
    if due is None or due >= context.view.ticks:
        return never_happened(context, condition, f'{event_id} was never due')
    gone = context.gone(condition, np.array([due], dtype=np.intp))
    if gone is not None:
        return gone
    rules = condition.arguments.actions
    if rules is None:
        raise VerificationError(f'condition {condition.id} has no rules of actions')
    speed = motion.speed(context.view, context.view.body(action.agent))
    before_mps = float(speed[due])
    goal_mps = ends_with_mps(action, before_mps, rules)
    change_mps = 0.0 if goal_mps is None else abs(goal_mps - before_mps)
    needed_s = change_mps / condition.arguments.acceleration_mps2
    begin = f'{event_id} was due at {context.time_s(due):.2f} s with {before_mps:.2f} m/s'
    done = times.completion_tick(event_id)
    if done is not None:
        took_s = context.time_s(done - due)
        story = f'{begin}; it was complete {took_s:.2f} s later, {needed_s:.2f} s were needed'
        return at_tick(done, took_s - needed_s, story, ground_topics(condition))
    waited_s = context.time_s(context.view.ticks - due) - needed_s
    if waited_s > condition.threshold:
        story = f'{begin}; it was never complete, {needed_s:.2f} s would have been needed'
        return at_tick(
            due,
            waited_s,
            story,
            ground_topics(condition),
            later=Later.RISES,
            provisional=True,
        )
    if context.complete(condition):
        late_s = condition.threshold + context.view.dt_s
        story = f'{begin}; the run was over before it was complete'
        return at_tick(due, late_s, story, ground_topics(condition))
    return context.short(condition)


def _at_some_time(context: Context, condition: Condition, event_id: str) -> Evaluation:
    done = context.events.completion_tick(event_id)
    if done is None:
        return never_happened(context, condition, f'{event_id} was never complete')
    story = f'{event_id} was complete at {context.time_s(done):.2f} s'
    return at_tick(done, 0.0, story, ground_topics(condition))


def measure_speed_before_event(context: Context, condition: Condition) -> Evaluation:
    """Speed of an agent up to the trigger of what lets it set off, m/s.

    From t = 0; of who is to start again from when it has come to rest.
    """
    event_id, action = _event(context, condition)
    trigger = context.events.trigger_tick(event_id)
    if trigger is None:
        return never_happened(context, condition, f'the trigger of {event_id} never happened')
    first = _rests_from(context, event_id, action)
    if first is None or first > trigger:
        story = f'{action.agent} had not come to rest before {event_id} was triggered'
        return Missing(reason=Reason.EMPTY_PHASE, story=story, tick=trigger)
    wait = whole_ticks(condition.arguments.after_s, context.view.dt_s)
    last = min(trigger + wait, context.view.ticks - 1)
    ticks = np.arange(first, last + 1, dtype=np.intp)
    gone = context.gone(condition, ticks)
    if gone is not None:
        return gone
    speed = motion.speed(context.view, context.view.body(action.agent))
    return Measured(ticks=ticks, values=speed[ticks], evidence=ground_topics(condition))


def _rests_from(context: Context, event_id: str, action: AgentAction) -> int | None:
    first = sets_off(context.spec.events, action.agent)
    event = context.events.event(event_id)
    if first is not None and first.id == event_id:
        return 0
    trigger = None if event is None else event.trigger
    if isinstance(trigger, EventDoneTrigger):
        return context.events.done_tick(trigger.event)
    # It was to stop before, whichever event that was.
    stops = [
        context.events.done_tick(e.id)
        for e in context.spec.events
        if isinstance(e.action, AgentAction)
        and e.action.agent == action.agent
        and e.action.do in ('stop', 'brake', 'yield')
    ]
    return min((tick for tick in stops if tick is not None), default=None)


def measure_passed_after(context: Context, condition: Condition) -> Evaluation:
    """Metres by which the other one gets ahead on the way of who yields, after the trigger."""
    event_id, _ = _event(context, condition)
    due = context.events.due_tick(event_id)
    if due is None:
        return never_happened(context, condition, f'the trigger of {event_id} never happened')
    end = context.together_until(condition)
    if isinstance(end, Missing):
        return end
    if due >= end:
        return never_happened(context, condition, f'{event_id} was never due')
    a, b = condition.of
    along = context.along(a, b)
    left = condition.arguments.offset_m - along.offset_m
    ahead = np.where(left >= 0.0, along.lead_m, np.minimum(along.lead_m, left))[:end]
    farthest = due + int(np.argmax(ahead[due:]))
    begin = trigger_story(context, event_id, due)
    story = f'{begin}; {b} was at most {float(ahead[farthest]):.2f} m ahead of {a} after that'
    return at_tick(
        farthest,
        float(ahead[farthest]),
        story,
        ground_topics(condition),
        later=Later.RISES,
        provisional=True,
    )
