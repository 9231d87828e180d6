# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stated conditions on what a link delivers: every message of it counts."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.links import link_between
from aurora_core.conditions.stated_values import (
    CannotSayError,
    asked_true,
    only,
    sentence_of,
    source_of,
    target_of,
)
from aurora_core.judging.build import Inputs, Target, condition
from aurora_core.judging.quantities.delivered import (
    Delivered,
    DeliveredAt,
    NeverDelivered,
    delivery_deadline_s,
)
from aurora_core.judging.quantities.delivery_latency import DeliveryLatency
from aurora_core.judging.quantities.delivery_ratio import DeliveryRatio
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import Link, StatedCondition

LINK_QUANTITIES: dict[str, type[Delivered] | type[DeliveryLatency] | type[DeliveryRatio]] = {
    'delivered': Delivered,
    'delivery_latency': DeliveryLatency,
    'delivery_ratio': DeliveryRatio,
}


def stated_link(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield the conditions on the links from the first to the other bodies of a stated one.

    Raises:
        CannotSayError: There is no such link, or the comparison has no meaning.
    """
    sender, *receivers = stated.of
    links = [link_between(inputs.spec, sender, receiver) for receiver in receivers]
    found = [link for link in links if link is not None]
    if not found or len(found) < len(links):
        raise CannotSayError(f'{stated.quantity} without a link of {", ".join(stated.of)}')
    if len(found) == 1:
        yield from _on_link(inputs, stated, found[0])
        return
    for link in found:
        own = stated.model_copy(update={'of': (link.sender, link.receiver)})
        yield from _on_link(inputs, own, link, suffix=f'.{link.receiver}')


def _on_link(
    inputs: Inputs, stated: StatedCondition, link: Link, suffix: str = ''
) -> Iterator[Condition]:
    """Yield what is asked of one link, and of what is to arrive by a time that, too."""
    delivered = stated.quantity == 'delivered'
    only(stated, *(['by_s'] if delivered else []))
    if is_kept_from(stated, link):
        only(stated)
        yield _condition(inputs, stated, NeverDelivered(**inputs.common, link=link.id), suffix)
        return
    arguments = LINK_QUANTITIES[stated.quantity](**inputs.common, link=link.id)
    target, signal = target_of(inputs.tolerances, stated), None
    if isinstance(arguments, Delivered):
        asked_true(stated)
        target = Target(op='<=', threshold=delivery_deadline_s(inputs, link), unit='s')
        signal = f'delivery_time({link.id})'
    elif isinstance(arguments, DeliveryLatency) and stated.op not in ('<=', '<'):
        # A message that never arrives has no latency that could be long enough.
        raise CannotSayError(f'delivery_latency {stated.op}')
    yield _condition(inputs, stated, arguments, suffix, target, signal)
    if stated.by_s is not None:
        yield condition(
            id=f'{stated.id}.deadline{suffix}',
            sentence=sentence_of(stated),
            signal=f'arrival({link.id})',
            of=stated.of,
            target=Target(op='<=', threshold=stated.by_s.value, unit='s'),
            arguments=DeliveredAt(**inputs.common, link=link.id),
            source=source_of(stated),
        )


def is_kept_from(stated: StatedCondition, link: Link) -> bool:
    """Tell whether a condition asks that no message of a link arrives."""
    ends = stated.of[:1] == (link.sender,) and link.receiver in stated.of[1:]
    no = stated.op in ('==', '<=') and stated.value.value == 0.0
    return ends and no and stated.quantity == 'delivered'


def _condition(
    inputs: Inputs,
    stated: StatedCondition,
    arguments: Delivered | DeliveryLatency | DeliveryRatio | NeverDelivered,
    suffix: str,
    target: Target | None = None,
    signal: str | None = None,
) -> Condition:
    return condition(
        id=f'{stated.id}.holds{suffix}',
        sentence=sentence_of(stated),
        signal=signal,
        of=stated.of,
        target=target_of(inputs.tolerances, stated) if target is None else target,
        arguments=arguments,
        source=source_of(stated),
        every_sample=not isinstance(arguments, DeliveryRatio | NeverDelivered),
    )
