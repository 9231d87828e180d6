# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What links imply: which one carries a message, until when, and how many may be lost."""

from __future__ import annotations

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.conditions.condition import Condition, Window
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link, MessageTrigger, ScenarioSpec


def link_between(spec: ScenarioSpec, sender: str, receiver: str) -> Link | None:
    """Return the link from one body to another."""
    return next(
        (link for link in spec.links if (link.sender, link.receiver) == (sender, receiver)), None
    )


def delivery_deadline_s(inputs: Inputs, link: Link) -> float:
    """Return the time that a message may take: of a stated latency what its retries can add."""
    if link.latency_s.provenance is not Provenance.EXPLICIT:
        return inputs.tolerances.delivery_s
    again_s = link.retransmissions.value * link.retransmission_interval_s.value
    return link.latency_s.value + again_s


def loses_messages(link: Link) -> bool:
    """Tell whether the prompt forbids the retransmissions that would make up for losses."""
    forbidden = (
        link.retransmissions.provenance is Provenance.EXPLICIT
        and link.retransmissions.value == 0.0
    )
    return forbidden and link.loss.value > 0.0


def is_needed(spec: ScenarioSpec, link: Link) -> bool:
    """Tell whether an event waits for a message of the link."""
    return any(
        isinstance(event.trigger, MessageTrigger)
        and event.trigger.by == link.receiver
        and event.trigger.sender in (None, link.sender)
        for event in spec.events
    )


def ratio_condition(inputs: Inputs, link: Link) -> Condition:
    """Return that a link which loses messages for good loses as many as its model says."""
    passes = 1.0 - link.loss.value
    return condition(
        id=f'{link.id}.ratio',
        sentence=(
            f'of the messages from {link.sender} to {link.receiver} as many arrive as chance '
            f'allows: {number(100 * passes)} %, within the 99 % interval'
        ),
        quantity=QuantityName.DELIVERY_RATIO,
        signal=f'delivery_ratio_slack({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='>=', threshold=0.0, unit='1'),
        arguments=inputs.arguments(Window.MOMENT, aspect='model', link=link.id),
        source=Source(
            ids=(link.id,),
            spans=(link.retransmissions.span, link.loss.span),
            provenance=link.loss.provenance,
        ),
        every_sample=False,
    )
