# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How many messages arrive, and whether chance explains how many do not."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.happening import never_happened
from aurora_core.judging.messages import link_model, messages_of_link
from aurora_core.judging.quantity import OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities.ledger import Attempt, binomial_interval
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link
from aurora_core.trace.records import LossReason


class DeliveryRatio(OfLink):
    """Share of a link's messages that arrive."""

    name = QuantityName.DELIVERY_RATIO
    kind: Literal['delivery_ratio'] = 'delivery_ratio'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share of all messages of the run."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        link_model(context, condition, self.link)
        end = context.view.ticks
        arrived = sum(m.delivered_tick is not None and m.delivered_tick < end for m in sent)
        story = f'{arrived} of {len(sent)} messages reached {condition.of[-1]}'
        return at_tick(sent[-1].sent_tick, arrived / len(sent), story, ('comm',), provisional=True)


class FirstAttempts(OfLink):
    """How far the share of passed first attempts is inside what chance allows.

    Attributes:
        loss: Stated loss probability; None: that of the link as recorded.
    """

    name = QuantityName.DELIVERY_RATIO
    kind: Literal['first_attempts'] = 'first_attempts'
    loss: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that distance from the nearer end of the 99 % interval."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        tried = [attempt for message in sent for attempt in message.attempts[:1]]
        return _chance(context, condition, self, tried, 'messages')


class AllAttempts(OfLink):
    """How far the share of all passed attempts is inside what chance allows.

    Attributes:
        loss: Stated loss probability.
    """

    name = QuantityName.DELIVERY_RATIO
    kind: Literal['all_attempts'] = 'all_attempts'
    loss: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that distance from the nearer end of the 99 % interval."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        tried = [attempt for message in sent for attempt in message.attempts]
        return _chance(context, condition, self, tried, 'attempts')


def _chance(
    context: Context,
    condition: Condition,
    asked: FirstAttempts | AllAttempts,
    attempts: list[Attempt],
    what: str,
) -> Evaluation:
    """Return how far the share of what passed is inside its 99 % interval.

    What was sent out of range is lost for certain and says nothing about chance.
    """
    model = link_model(context, condition, asked.link)
    loss = model.loss if asked.loss is None else asked.loss
    tried = [attempt for attempt in attempts if attempt.reason is not LossReason.RANGE]
    if not tried:
        return never_happened(context, condition, f'nothing was sent in range on {model.link_id}')
    passed = sum(attempt.passed for attempt in tried)
    low, high = binomial_interval(len(tried), 1.0 - loss)
    slack = min(passed - low, high - passed) / len(tried)
    story = (
        f'{passed} of {len(tried)} {what} passed {model.link_id}, chance allows {low} to {high}'
    )
    return at_tick(tried[-1].tick, slack, story, ('comm',), provisional=True)


def of_messages(inputs: Inputs, link: Link) -> Condition:
    """Return that a link which loses messages for good loses as many as its model says."""
    return condition(
        id=f'{link.id}.ratio',
        sentence=(
            f'of the messages from {link.sender} to {link.receiver} as many arrive as chance '
            f'allows: {number(100 * (1.0 - link.loss.value))} %, within the 99 % interval'
        ),
        signal=f'delivery_ratio_slack({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='>=', threshold=0.0, unit='1'),
        arguments=FirstAttempts(
            **inputs.common,
            link=link.id,
            loss=link.loss.value if link.loss.provenance is Provenance.EXPLICIT else None,
        ),
        source=Source(
            ids=(link.id,),
            spans=(link.retransmissions.span, link.loss.span),
            provenance=link.loss.provenance,
        ),
        every_sample=False,
    )


def of_attempts(inputs: Inputs, link: Link) -> Condition:
    """Return that a link loses as many attempts as the prompt says."""
    return condition(
        id=f'{link.id}.loss',
        sentence=(
            f'of the attempts on {link.id} as many pass as chance allows: '
            f'{number(100 * (1.0 - link.loss.value))} %, within the 99 % interval'
        ),
        signal=f'attempts_slack({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='>=', threshold=0.0, unit='1'),
        arguments=AllAttempts(**inputs.common, link=link.id, loss=link.loss.value),
        source=Source(ids=(link.id,), spans=(link.loss.span,), provenance=link.loss.provenance),
        every_sample=False,
    )
