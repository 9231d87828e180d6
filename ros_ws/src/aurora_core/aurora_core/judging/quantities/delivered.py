# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether messages arrive, and in time."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.delivery import delivery_times
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Measured,
    Missing,
    at_tick,
)
from aurora_core.judging.messages import messages_of_event, messages_of_link
from aurora_core.judging.quantity import OfEvent, OfLink, Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, Link
from aurora_core.trace.records import LinkEventKind


class Delivered(OfLink):
    """Time from sending to receipt of every message of a link, seconds."""

    name = QuantityName.DELIVERED
    kind: Literal['delivered'] = 'delivered'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one time per message."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        return delivery_times(context, condition, sent, self.link)


class DeliveredAt(OfLink):
    """When every message of a link arrived, seconds from scenario start."""

    name = QuantityName.DELIVERED
    kind: Literal['delivered_at'] = 'delivered_at'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one time per message: one that has not arrived will not have by the deadline."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        end = context.view.ticks
        never_s = max(context.time_s(end), condition.threshold + context.view.dt_s)
        ticks, values = [], []
        for message in sent:
            arrived = message.delivered_tick
            there = arrived is not None and arrived < end
            ticks.append(arrived if arrived is not None and there else message.sent_tick)
            values.append(context.time_s(arrived) if arrived is not None and there else never_s)
        worst = int(np.argmax(values))
        arrived = sent[worst].delivered_tick
        told = 'never' if arrived is None or arrived >= end else f'at {values[worst]:.2f} s'
        return Measured(
            ticks=np.array(ticks, dtype=np.intp),
            values=np.array(values),
            story=f'the last message reached {condition.of[-1]} {told}',
            place_of=condition.of[-1],
            evidence=('comm',),
            provisional=True,
        )


class NeverDelivered(OfLink):
    """How many messages of a link arrive, where none of those that are sent may."""

    name = QuantityName.DELIVERED
    kind: Literal['never_delivered'] = 'never_delivered'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the number; where nothing was sent nothing was kept from arriving."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        end = context.view.ticks
        arrived = [m for m in sent if m.delivered_tick is not None and m.delivered_tick < end]
        story = f'{len(arrived)} of {len(sent)} messages reached {condition.of[-1]}'
        tick = sent[-1].sent_tick if not arrived else arrived[0].delivered_tick
        assert tick is not None
        return at_tick(tick, float(len(arrived)), story, ('comm',), provisional=True)


class NeverSent(Quantity):
    """How many messages one body sends to another, where it may send none."""

    name = QuantityName.DELIVERED
    kind: Literal['never_sent'] = 'never_sent'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the number in the ledger."""
        sent = [
            record.tick
            for record in context.view.trace.links
            if record.kind is LinkEventKind.SENT
            and (record.sender, record.receiver) == condition.of
        ]
        if not sent and not context.complete(condition):
            return context.short(condition)
        story = f'{condition.of[0]} sent {len(sent)} messages to {condition.of[1]}'
        tick = sent[0] if sent else context.view.ticks - 1
        number, rises = float(len(sent)), Later.RISES
        return at_tick(tick, number, story, ('comm',), later=rises, provisional=True)


def never_sent(
    inputs: Inputs, id: str, sender: str, receiver: str, span: Span | None
) -> Condition:
    """Return that one body sends nothing to another.

    Args:
        inputs: What every derivation needs.
        id: Of the prohibition.
        sender: Who must not send.
        receiver: To whom.
        span: Where the prompt says so.
    """
    return condition(
        id=f'{id}.holds',
        sentence=f'{sender} never sends a message to {receiver}',
        signal=f'messages({sender},{receiver})',
        of=(sender, receiver),
        target=Target(op='<', threshold=1.0, unit='1'),
        arguments=NeverSent(**inputs.common),
        source=Source(ids=(id,), spans=(span,), provenance=Provenance.EXPLICIT, implied=False),
        every_sample=False,
    )


class MessageDelivered(OfEvent):
    """Time from sending to receipt of every message of an event, seconds."""

    name = QuantityName.DELIVERED
    kind: Literal['message_delivered'] = 'message_delivered'
    link: str

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one time per message."""
        sent = messages_of_event(context, condition, self.event)
        if isinstance(sent, Missing):
            return sent
        return delivery_times(context, condition, sent, self.link)


def delivery_deadline_s(inputs: Inputs, link: Link) -> float:
    """Return the time that a message may take: of a stated latency what its retries can add."""
    if link.latency_s.provenance is not Provenance.EXPLICIT:
        return inputs.tolerances.delivery_s
    again_s = link.retransmissions.value * link.retransmission_interval_s.value
    return link.latency_s.value + again_s


def implied(inputs: Inputs, event: Event, link: Link) -> Condition:
    """Return that the messages of an event arrive."""
    return condition(
        id=f'{event.id}.delivered',
        sentence=f'the message of {event.id} reaches {link.receiver}',
        signal=f'delivery_time({event.id})',
        of=(link.sender, link.receiver),
        target=Target(op='<=', threshold=delivery_deadline_s(inputs, link), unit='s'),
        arguments=MessageDelivered(**inputs.of_event(event.id), link=link.id),
        source=Source(
            ids=(event.id, link.id),
            spans=(event.span, link.span),
            provenance=link.latency_s.provenance,
        ),
    )
