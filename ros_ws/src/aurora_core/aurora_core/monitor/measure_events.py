# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of event, alert and message conditions."""

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
)
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.ledger import LinkModel, Message, binomial_interval
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.scenario import DistanceTrigger
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.stl.syntax import format_number
from aurora_core.trace.records import LinkEventKind, LossReason


def _event_id(condition: Condition) -> str:
    if condition.arguments.event is None:
        raise VerificationError(f'condition {condition.id} names no event')
    return condition.arguments.event


def never_happened(context: Context, condition: Condition, story: str) -> Missing:
    """Return that what a condition is about never happened, or that the record is too short."""
    if not context.complete(condition):
        return context.short(condition)
    return Missing(reason=Reason.PREMISE_NEVER, story=story)


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


def measure_event_delay(context: Context, condition: Condition) -> Evaluation:
    """Seconds from trigger to action; `not_before`: of the first action at all.

    `order`: from the moment of another event to that of this one.
    """
    if condition.arguments.aspect == 'order':
        return _order(context, condition)
    event_id = _event_id(condition)
    trigger = context.events.trigger_tick(event_id)
    if trigger is None:
        return never_happened(context, condition, f'the trigger of {event_id} never happened')
    first, fresh = trigger, False
    if condition.arguments.aspect == 'not_before':
        first = 0
    elif condition.arguments.after_s > 0.0:
        # What a driver does before the stated delay is over is not what was asked for.
        first = trigger + whole_ticks(condition.arguments.after_s, context.view.dt_s)
        fresh = True
    action = context.events.action_tick(event_id, first, begins_there=fresh)
    begin = trigger_story(context, event_id, trigger)
    topics = ('ground/state', 'uav/state', 'comm')
    if action is not None:
        value = context.time_s(action - trigger)
        story = f'{begin}; {event_id} was carried out {value:.2f} s later'
        return at_tick(action, value, story, topics)
    if condition.arguments.aspect == 'not_before':
        return never_happened(context, condition, f'{begin}; {event_id} was never carried out')
    waited_s = context.time_s(context.view.ticks - trigger)
    if waited_s > condition.threshold:
        story = f'{begin}; {event_id} was not carried out in the {waited_s:.2f} s after it'
        return at_tick(trigger, waited_s, story, topics, later=Later.RISES, provisional=True)
    return context.short(condition)


def _order(context: Context, condition: Condition) -> Evaluation:
    first, then = (_moment(context, event_id) for event_id in condition.of)
    if first is None or then is None:
        what = condition.of[0] if first is None else condition.of[1]
        return never_happened(context, condition, f'{what} never happened')
    value = context.time_s(then - first)
    story = (
        f'{condition.of[0]} happened at {context.time_s(first):.2f} s, {condition.of[1]} at '
        f'{context.time_s(then):.2f} s'
    )
    return at_tick(then, value, story, ('ground/state', 'uav/state', 'comm'))


def _moment(context: Context, event_id: str) -> int | None:
    """Return the tick of an event's action, of its trigger where it has no action."""
    trigger = context.events.trigger_tick(event_id)
    event = context.events.event(event_id)
    if event is not None and event.action is not None:
        return context.events.action_tick(event_id, trigger or 0)
    return trigger


def measure_event_time(context: Context, condition: Condition) -> Evaluation:
    """Seconds from scenario start to the `trigger` or the `action` of an event."""
    event_id = _event_id(condition)
    tick = context.events.trigger_tick(event_id)
    if condition.arguments.aspect == 'action':
        tick = _moment(context, event_id)
    if tick is None:
        return never_happened(context, condition, f'{event_id} never happened')
    value = context.time_s(tick)
    return at_tick(tick, value, f'{event_id} happened at {value:.2f} s', ('events',))


def _messages(context: Context, condition: Condition) -> tuple[Message, ...]:
    """Return the messages of the condition's event, of its whole link when it names no event."""
    event_id, link_id = condition.arguments.event, condition.arguments.link
    return tuple(
        message
        for message in context.messages
        if (message.link_id == link_id if event_id is None else message.event == event_id)
    )


def _more_may_follow(context: Context, condition: Condition) -> bool:
    """Tell whether a condition on a whole link lacks the rest of its messages."""
    return condition.arguments.event is None and not context.complete(condition)


def _none_sent(context: Context, condition: Condition) -> Missing:
    of = condition.arguments.event or condition.arguments.link
    return never_happened(context, condition, f'no message of {of} was sent')


def measure_sent_after_capture(context: Context, condition: Condition) -> Evaluation:
    """Seconds from the sender's `ascent` or `capture` to the first message of an event."""
    event_id = _event_id(condition)
    sent = _messages(context, condition)
    if not sent:
        return _none_sent(context, condition)
    touchdown_m = condition.arguments.touchdown_m
    missions = condition.arguments.missions
    if condition.arguments.aspect == 'capture':
        tracking = [m for m in missions if m.mode is MissionMode.TRACK]
        ready = context.phase(tracking[0], touchdown_m).capture_tick
    else:
        ready = context.flight(missions[0], touchdown_m).ascent_end_tick
    first = min(message.sent_tick for message in sent)
    after = condition.arguments.aspect
    if ready is None:
        story = f'{event_id} was sent, but {condition.of[0]} never finished its {after}'
        return Missing(reason=Reason.EMPTY_PHASE, story=story, tick=first)
    value = context.time_s(first - ready)
    story = (
        f'{condition.of[0]} sent {event_id} at {context.time_s(first):.2f} s, {value:.2f} s after '
        f'its {after}'
    )
    return at_tick(first, value, story, ('comm', f'uav/state[{condition.of[0]}]'))


def measure_visible_at_send(context: Context, condition: Condition) -> Evaluation:
    """Metres of sight margin to the actor at each first transmission."""
    sent = _messages(context, condition)
    if not sent:
        return _none_sent(context, condition)
    ticks = np.array([message.sent_tick for message in sent], dtype=np.intp)
    ticks = ticks[ticks < context.view.ticks]
    if len(ticks) == 0:
        return context.short(condition)
    gone = context.gone(condition, ticks)
    if gone is not None:
        return gone
    margin = context.sight(condition.of[0], condition.of[1]).margin_m
    topics = ('comm', 'ground/state', 'world')
    return Measured(ticks=ticks, values=margin[ticks], evidence=topics, provisional=True)


def measure_delivered(context: Context, condition: Condition) -> Evaluation:
    """Seconds from sending to receipt, per message of an event or a link; the latest one decides.

    A message that was given up counts as received one tick after its deadline, or one tick after
    the end of the record if that is later.
    """
    sent = _messages(context, condition)
    if not sent:
        return _none_sent(context, condition)
    if _more_may_follow(context, condition):
        return context.short(condition)
    model = link_model(context, condition)
    ticks, values, stories = [], [], []
    for message in sent:
        value = _delivery_s(context, condition, message, model)
        if value is None:
            return context.short(condition)
        trigger = context.events.trigger_tick(message.event)
        begin = (
            trigger_story(context, message.event, trigger)
            if trigger is not None and trigger <= message.sent_tick
            else f'{message.event} was sent at {context.time_s(message.sent_tick):.2f} s'
        )
        arrived = message.delivered_tick
        if arrived is not None and arrived < context.view.ticks:
            since = trigger if trigger is not None else message.sent_tick
            later_s = context.time_s(arrived - min(since, message.sent_tick))
            stories.append(
                f'{begin}; the message reached {message.receiver} {later_s:.2f} s later'
            )
            ticks.append(arrived)
        else:
            lost = sum(not attempt.passed for attempt in message.attempts)
            stories.append(
                f'{begin}; the message never reached {message.receiver}, {lost} attempts were lost'
            )
            ticks.append(message.attempts[-1].tick if message.attempts else message.sent_tick)
        values.append(value)
    worst = int(np.argmax(values))
    return Measured(
        ticks=np.array(ticks, dtype=np.intp),
        values=np.array(values),
        story=stories[worst],
        place_of=condition.of[-1],
        evidence=('comm',),
        provisional=True,
    )


def link_model(context: Context, condition: Condition) -> LinkModel:
    """Return the link that a condition is about.

    Raises:
        VerificationError: The specification has none of this name.
    """
    for model in context.links:
        if model.link_id == condition.arguments.link:
            return model
    raise VerificationError(f'condition {condition.id} names no link of the specification')


def _delivery_s(
    context: Context, condition: Condition, message: Message, model: LinkModel
) -> float | None:
    """Return seconds from sending to receipt, None when the record ends before it is known."""
    arrived = message.delivered_tick
    if arrived is not None and arrived < context.view.ticks:
        return context.time_s(arrived - message.sent_tick)
    waited_s = context.time_s(context.view.ticks - message.sent_tick)
    given_up = arrived is None and len(message.attempts) > model.retransmissions
    if given_up:
        return max(waited_s, condition.threshold + context.view.dt_s)
    return waited_s if waited_s > condition.threshold else None


def measure_delivery_latency(context: Context, condition: Condition) -> Evaluation:
    """Seconds from sending to receipt; `steps`: ticks that receipts are off the link's latency."""
    if condition.arguments.aspect != 'steps':
        return measure_delivered(context, condition)
    model = link_model(context, condition)
    numbers = {m.number: m for m in context.messages if m.link_id == model.link_id}
    ticks, values = [], []
    for record in context.view.trace.links:
        message = numbers.get(record.message)
        if record.kind is not LinkEventKind.DELIVERED or message is None:
            continue
        passed = next((a.tick for a in message.attempts if a.passed), None)
        if passed is not None:
            ticks.append(record.tick)
            took = float(record.tick - passed)
            values.append(abs(took - condition.arguments.wanted / context.view.dt_s))
    if not values:
        return never_happened(context, condition, f'nothing passed {model.link_id}')
    return Measured(
        ticks=np.array(ticks, dtype=np.intp),
        values=np.array(values),
        evidence=('comm',),
        provisional=True,
    )


def measure_delivery_ratio(context: Context, condition: Condition) -> Evaluation:
    """Share of a link's messages that arrive.

    `model`: how far the share of first attempts that passed is inside what chance allows;
    `attempts`: the same of all attempts.
    """
    sent = _messages(context, condition)
    if not sent:
        return _none_sent(context, condition)
    model = link_model(context, condition)
    if _more_may_follow(context, condition):
        return context.short(condition)
    if condition.arguments.aspect in ('model', 'attempts'):
        return _chance(context, condition, sent, model)
    end = context.view.ticks
    arrived = sum(m.delivered_tick is not None and m.delivered_tick < end for m in sent)
    story = f'{arrived} of {len(sent)} messages reached {condition.of[-1]}'
    return at_tick(sent[-1].sent_tick, arrived / len(sent), story, ('comm',), provisional=True)


def _chance(
    context: Context, condition: Condition, sent: tuple[Message, ...], model: LinkModel
) -> Evaluation:
    """Return how far the share of passed messages is inside its 99 % interval.

    What was sent out of range is lost for certain and says nothing about chance.
    """
    each = 1 if condition.arguments.aspect == 'model' else None
    tried = [
        attempt
        for message in sent
        for attempt in message.attempts[:each]
        if attempt.reason is not LossReason.RANGE
    ]
    if not tried:
        return never_happened(context, condition, f'nothing was sent in range on {model.link_id}')
    passed = sum(attempt.passed for attempt in tried)
    low, high = binomial_interval(len(tried), 1.0 - model.loss)
    slack = min(passed - low, high - passed) / len(tried)
    what = 'messages' if each else 'attempts'
    story = (
        f'{passed} of {len(tried)} {what} passed {model.link_id}, chance allows {low} to {high}'
    )
    return at_tick(tried[-1].tick, slack, story, ('comm',), provisional=True)
