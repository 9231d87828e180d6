# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How soon after its trigger, or after another event, an event is carried out."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.happening import (
    EVENT_TOPICS,
    agent_action,
    earliest_s,
    moment,
    never_happened,
    trigger_story,
    triggered,
    unready_story,
)
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import free_road
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.spec.parking import crosses_from_wait
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, EventDoneTrigger, Order
from aurora_core.spec.stated import is_stated


class EventDelay(OfEvent):
    """Time from the trigger of an event to its action, seconds.

    Attributes:
        after_s: What shows sooner after the trigger is not what was asked for.
    """

    name = QuantityName.EVENT_DELAY
    kind: Literal['event_delay'] = 'event_delay'
    after_s: FiniteFloat = 0.0

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; what was not carried out in it is late."""
        trigger = triggered(context, condition, self.event)
        if isinstance(trigger, Missing):
            return trigger
        first, fresh = trigger, False
        if self.after_s > 0.0:
            first, fresh = trigger + whole_ticks(self.after_s, context.view.dt_s), True
        action = context.events.action_tick(self.event, first, begins_there=fresh)
        begin = trigger_story(context, self.event, trigger)
        possible = context.events.possible_tick(self.event, first)
        if possible is None:
            return never_happened(context, condition, f'{begin}; it was possible nowhere then')
        if possible > first:
            # The time for which it was not possible does not count.
            trigger += possible - first
            begin = f'{begin}; it was possible from {context.time_s(possible):.2f} s on'
        if action is not None:
            return _carried_out(context, self.event, begin, trigger, action)
        waited_s = context.time_s(context.view.ticks - trigger)
        waited_s -= context.events.hidden_s(self.event)
        if waited_s > condition.threshold:
            story = f'{begin}; {self.event} was not carried out in the {waited_s:.2f} s after it'
            topics = EVENT_TOPICS
            # Of who sets off when his wait is over it shows later that he had set off by now.
            event = context.events.event(self.event)
            hidden = event is not None and crosses_from_wait(context.events.spec, event)
            later = Later.ANY if hidden else Later.RISES
            return at_tick(trigger, waited_s, story, topics, later=later, provisional=True)
        return context.short(condition)


class DelayOfFirst(OfEvent):
    """Time from the trigger of an event to the first such action at all, seconds."""

    name = QuantityName.EVENT_DELAY
    kind: Literal['delay_of_first'] = 'delay_of_first'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time, negative for an action before the trigger."""
        trigger = triggered(context, condition, self.event)
        if isinstance(trigger, Missing):
            return trigger
        action = context.events.action_tick(self.event, 0, begins_there=False)
        begin = trigger_story(context, self.event, trigger)
        if action is None:
            story = f'{begin}; {self.event} was never carried out'
            return never_happened(context, condition, story)
        return _carried_out(context, self.event, begin, trigger, action)


class DriverWaits(OfEvent):
    """Time from the trigger of an event to the first thing that shows its action, seconds.

    Braking for traffic or at a junction is no action: what shows with a leader or junction near,
    and what holds when the wait begins, does not count.

    Attributes:
        since_s: When the wait begins, before the trigger.
        until_s: When it is over, after the trigger; what shows later is in time.
        free_m: A leader or junction so near may be the cause.
        lane_offset_m: How far off its way a leader may be.
    """

    name = QuantityName.EVENT_DELAY
    kind: Literal['driver_waits'] = 'driver_waits'
    since_s: FiniteFloat
    until_s: FiniteFloat
    free_m: FiniteFloat
    lane_offset_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time."""
        trigger = triggered(context, condition, self.event)
        if isinstance(trigger, Missing):
            return trigger
        view, action = context.view, agent_action(context, condition, self.event)
        begin = max(0, trigger - whole_ticks(self.since_s, view.dt_s))
        end = trigger + whole_ticks(self.until_s, view.dt_s)
        if end + 1 >= view.ticks:
            return context.short(condition)
        body = view.body(action.agent)
        shows = context.events.shows(action, begin)
        # Each stretch counts where it begins; what held at the beginning has not begun.
        begins = shows & ~np.concatenate(([True], shows[:-1])) & view.present(action.agent)
        begins[: begin + 1] = False
        begins[end:] = False
        begins &= free_road.free_of_junctions(view, body, self.free_m)
        if begins.any():
            begins &= free_road.free_of_leaders(view, body, self.free_m, self.lane_offset_m)
        early = first_tick(begins)
        tick = end + 1 if early is None else early
        when = 'not' if early is None else f'already at {context.time_s(early):.2f} s,'
        story = f'{trigger_story(context, self.event, trigger)}; {self.event} showed {when} before'
        story += f' {context.time_s(end):.2f} s'
        return at_tick(tick, context.time_s(tick - trigger), story, EVENT_TOPICS)


class TimeBetween(OfEvent):
    """Time from the moment of the first event to that of the second one, seconds."""

    name = QuantityName.EVENT_DELAY
    kind: Literal['time_between'] = 'time_between'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time, negative where they come the other way round."""
        first, then = (moment(context, event_id) for event_id in condition.of)
        if first is None or then is None:
            what = condition.of[0] if first is None else condition.of[1]
            return never_happened(context, condition, f'{what} never happened')
        story = (
            f'{condition.of[0]} happened at {context.time_s(first):.2f} s, {condition.of[1]} at '
            f'{context.time_s(then):.2f} s'
        )
        return at_tick(then, context.time_s(then - first), story, EVENT_TOPICS)


def _carried_out(
    context: Context, event_id: str, begin: str, trigger: int, action: int
) -> Evaluation:
    value = context.time_s(action - trigger)
    story = f'{begin}; {event_id} was carried out {value:.2f} s later'
    story += unready_story(context, event_id)
    return at_tick(action, value, story, EVENT_TOPICS)


def within(
    inputs: Inputs, event: Event, latest_s: float, after_s: float, source: Source
) -> Condition:
    """Return that an event is carried out soon enough after its trigger."""
    return condition(
        id=f'{event.id}.within',
        sentence=f'{event.id} happens within {number(latest_s)} s of its trigger',
        of=(event.id,),
        target=Target(op='<=', threshold=latest_s, unit='s'),
        arguments=EventDelay(**inputs.of_event(event.id), after_s=after_s),
        source=source,
        every_sample=False,
    )


def not_before(inputs: Inputs, event_id: str, first_s: float, source: Source) -> Condition:
    """Return that an event is not carried out too soon."""
    after = 'its trigger' if first_s == 0.0 else f'{number(first_s)} s after its trigger'
    return condition(
        id=f'{event_id}.not_before',
        sentence=f'{event_id} happens not before {after}',
        of=(event_id,),
        target=Target(op='>=', threshold=first_s, unit='s'),
        arguments=DelayOfFirst(**inputs.of_event(event_id)),
        source=source,
        every_sample=False,
    )


def driver_waits(inputs: Inputs, event: Event, source: Source) -> Condition | None:
    """Return that a driver keeps a stated wait, None where none is stated."""
    after = event.trigger.after_s if isinstance(event.trigger, EventDoneTrigger) else None
    since_s = after.value if after is not None and is_stated(after) else 0.0
    until_s = earliest_s(inputs, event)
    if until_s <= 0.0 < since_s:
        until_s = -inputs.tolerances.duration_s.of(since_s, approximate=False)
    if since_s + until_s <= 0.0:
        return None
    t = inputs.tolerances
    return condition(
        id=f'{event.id}.waits',
        sentence=(
            f'{event.id} shows not before {number(since_s + until_s)} s of its wait are over, '
            f'but where a leader or junction within {number(t.free_road_m)} m may be why'
        ),
        of=(event.id,),
        target=Target(op='>=', threshold=until_s, unit='s'),
        arguments=DriverWaits(
            **inputs.of_event(event.id),
            since_s=since_s,
            until_s=until_s,
            free_m=t.free_road_m,
            lane_offset_m=t.lane_offset_m,
        ),
        source=source,
        every_sample=False,
    )


def in_order(
    inputs: Inputs,
    order: Order,
    name: str,
    sentence: str,
    target: Target,
    source: Source,
    awaiting: Event | None = None,
) -> Condition:
    """Return that one event comes before another one, or within some time of it.

    Args:
        inputs: What conditions are derived from.
        order: The order.
        name: Of the condition, behind the id of the order.
        sentence: The condition in words.
        target: Bound on the time between the two (s).
        source: Where the order is stated.
        awaiting: Event that waits for the end of what comes first; it acts not before then.
    """
    return condition(
        id=f'{order.id}.{name}',
        sentence=sentence,
        signal=f'time_between({order.first},{order.then})',
        of=(order.first, order.then),
        target=target,
        arguments=TimeBetween(**inputs.of_event(order.then))
        if awaiting is None
        else DelayOfFirst(**inputs.of_event(awaiting.id)),
        source=source,
        every_sample=False,
    )
