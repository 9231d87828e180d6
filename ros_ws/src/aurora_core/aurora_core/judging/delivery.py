# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long messages take from sending to receipt."""

from __future__ import annotations

import numpy as np

from aurora_core.judging.evaluation import Context, Evaluation, Measured
from aurora_core.judging.happening import trigger_story
from aurora_core.judging.messages import link_model
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities.ledger import LinkModel, Message


def delivery_times(
    context: Context, condition: Condition, sent: tuple[Message, ...], link_id: str
) -> Evaluation:
    """Return the seconds from sending to receipt, per message; the latest one is told.

    A message that was given up counts as received one tick after its deadline, or one tick after
    the end of the record if that is later.
    """
    model = link_model(context, condition, link_id)
    ticks, values, stories = [], [], []
    for message in sent:
        value = _delivery_s(context, condition, message, model)
        if value is None:
            return context.short(condition)
        tick, story = _receipt(context, message)
        ticks.append(tick)
        values.append(value)
        stories.append(story)
    worst = int(np.argmax(values))
    return Measured(
        ticks=np.array(ticks, dtype=np.intp),
        values=np.array(values),
        story=stories[worst],
        place_of=condition.of[-1],
        evidence=('comm',),
        provisional=True,
    )


def _receipt(context: Context, message: Message) -> tuple[int, str]:
    """Return when a message arrived, or was tried last, and what happened."""
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
        return arrived, f'{begin}; the message reached {message.receiver} {later_s:.2f} s later'
    lost = sum(not attempt.passed for attempt in message.attempts)
    tick = message.attempts[-1].tick if message.attempts else message.sent_tick
    story = f'{begin}; the message never reached {message.receiver}, {lost} attempts were lost'
    return tick, story


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
