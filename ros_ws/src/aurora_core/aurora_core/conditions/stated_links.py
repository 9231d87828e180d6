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
from aurora_core.judging.quantities.delivered import Delivered, delivery_deadline_s
from aurora_core.judging.quantities.delivery_latency import DeliveryLatency
from aurora_core.judging.quantities.delivery_ratio import DeliveryRatio
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import StatedCondition

LINK_QUANTITIES: dict[str, type[Delivered] | type[DeliveryLatency] | type[DeliveryRatio]] = {
    'delivered': Delivered,
    'delivery_latency': DeliveryLatency,
    'delivery_ratio': DeliveryRatio,
}


def stated_link(inputs: Inputs, stated: StatedCondition) -> Iterator[Condition]:
    """Yield the condition on the link from the first to the second body of a stated one.

    Raises:
        CannotSayError: There is no such link, or the comparison has no meaning.
    """
    only(stated)
    link = link_between(inputs.spec, *stated.of) if len(stated.of) == 2 else None
    if link is None:
        raise CannotSayError(f'{stated.quantity} without a link of {", ".join(stated.of)}')
    target, signal = target_of(inputs.tolerances, stated), None
    arguments = LINK_QUANTITIES[stated.quantity](**inputs.common, link=link.id)
    if isinstance(arguments, Delivered):
        asked_true(stated)
        target = Target(op='<=', threshold=delivery_deadline_s(inputs, link), unit='s')
        signal = f'delivery_time({link.id})'
    elif isinstance(arguments, DeliveryLatency) and stated.op not in ('<=', '<'):
        # A message that never arrives has no latency that could be long enough.
        raise CannotSayError(f'delivery_latency {stated.op}')
    yield condition(
        id=f'{stated.id}.holds',
        sentence=sentence_of(stated),
        signal=signal,
        of=stated.of,
        target=target,
        arguments=arguments,
        source=source_of(stated),
        every_sample=not isinstance(arguments, DeliveryRatio),
    )
