# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether messages arrive, and in time."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.delivery import delivery_times
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.messages import messages_of_event, messages_of_link
from aurora_core.judging.quantity import OfEvent, OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, Link


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
