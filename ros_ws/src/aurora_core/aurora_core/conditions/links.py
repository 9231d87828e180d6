# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What links imply: which one carries a message, until when, how many may be lost, how far."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Parameter, Provenance
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


def model_conditions(inputs: Inputs, link: Link) -> Iterator[Condition]:
    """Yield that the ledger of a link fits the parameters that the prompt states of it."""
    of, arguments = (link.sender, link.receiver), inputs.arguments
    if link.loss.provenance is Provenance.EXPLICIT and not loses_messages(link):
        passes = 1.0 - link.loss.value
        yield condition(
            id=f'{link.id}.loss',
            sentence=(
                f'of the attempts on {link.id} as many pass as chance allows: '
                f'{number(100 * passes)} %, within the 99 % interval'
            ),
            quantity=QuantityName.DELIVERY_RATIO,
            signal=f'attempts_slack({link.id})',
            of=of,
            target=Target(op='>=', threshold=0.0, unit='1'),
            arguments=arguments(
                Window.MOMENT, aspect='attempts', link=link.id, wanted=link.loss.value
            ),
            source=_of_number(link, link.loss),
            every_sample=False,
        )
    if link.range_m is not None and link.range_m.provenance is Provenance.EXPLICIT:
        range_m = link.range_m.value
        yield condition(
            id=f'{link.id}.range',
            sentence=f'{link.id} reaches {number(range_m)} m, and no farther',
            quantity=QuantityName.LINK_RANGE,
            signal=f'range_slack({link.id})',
            of=of,
            target=Target(op='>=', threshold=0.0, unit='m'),
            arguments=arguments(Window.MOMENT, link=link.id, wanted=range_m),
            source=_of_number(link, link.range_m),
        )
    again = link.retransmissions
    if again.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{link.id}.retransmissions',
            sentence=f'{link.id} sends a lost message up to {number(again.value)} times again',
            quantity=QuantityName.ATTEMPTS,
            signal=f'attempts_off({link.id})',
            of=of,
            target=Target(op='<=', threshold=0.0, unit='1'),
            arguments=arguments(Window.MOMENT, aspect='count', link=link.id, wanted=again.value),
            source=_of_number(link, again),
            every_sample=False,
        )
    interval = link.retransmission_interval_s
    if interval.provenance is Provenance.EXPLICIT:
        slack_s = inputs.tolerances.duration_s.of(interval.value)
        yield condition(
            id=f'{link.id}.interval',
            sentence=f'{link.id} sends again every {number(interval.value)} s',
            quantity=QuantityName.ATTEMPTS,
            signal=f'interval_off({link.id})',
            of=of,
            target=Target(op='<=', threshold=slack_s, unit='s'),
            arguments=arguments(
                Window.MOMENT, aspect='interval', link=link.id, wanted=interval.value
            ),
            source=_of_number(link, interval),
            every_sample=False,
        )


def _of_number(link: Link, stated: Parameter) -> Source:
    return Source(ids=(link.id,), spans=(stated.span,), provenance=stated.provenance)
