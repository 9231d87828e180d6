# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long messages are on their way, and how far that is off the latency of their link."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.delivery import delivery_times
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.happening import never_happened
from aurora_core.judging.messages import link_model, messages_of_link
from aurora_core.judging.quantity import OfEvent, OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, Link
from aurora_core.trace.records import LinkEventKind


class DeliveryLatency(OfLink):
    """Time from sending to receipt of every message of a link, seconds."""

    name = QuantityName.DELIVERY_LATENCY
    kind: Literal['delivery_latency'] = 'delivery_latency'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one time per message."""
        sent = messages_of_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        return delivery_times(context, condition, sent, self.link)


class ExcessLatency(OfEvent):
    """How far receipts are off the latency of their link, in time steps.

    Attributes:
        link: Which link.
        latency_s: Its latency.
    """

    name = QuantityName.DELIVERY_LATENCY
    kind: Literal['excess_latency'] = 'excess_latency'
    link: str
    latency_s: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the number of steps per receipt, counted from the attempt that passed."""
        return _excess_steps(context, condition, self.link, self.latency_s)


class ReportLatency(OfLink):
    """The same of a link that reports go over.

    Attributes:
        latency_s: Its latency.
    """

    name = QuantityName.DELIVERY_LATENCY
    kind: Literal['report_latency'] = 'report_latency'
    latency_s: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the number of steps per receipt, counted from the attempt that passed."""
        return _excess_steps(context, condition, self.link, self.latency_s)


def _excess_steps(
    context: Context, condition: Condition, link: str, latency_s: float
) -> Evaluation:
    model = link_model(context, condition, link)
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
            values.append(abs(took - latency_s / context.view.dt_s))
    if not values:
        return never_happened(context, condition, f'nothing passed {model.link_id}')
    return Measured(
        ticks=np.array(ticks, dtype=np.intp),
        values=np.array(values),
        evidence=('comm',),
        provisional=True,
    )


def implied(inputs: Inputs, event: Event | None, link: Link) -> Condition:
    """Return that what passes a link takes as long as the prompt says.

    Args:
        inputs: The request.
        event: What sends over it; None for reports.
        link: The link.
    """
    steps, latency_s = inputs.tolerances.latency_steps, link.latency_s.value
    arguments: ExcessLatency | ReportLatency
    if event is None:
        arguments = ReportLatency(**inputs.common, link=link.id, latency_s=latency_s)
    else:
        own = inputs.of_event(event.id)
        arguments = ExcessLatency(**own, link=link.id, latency_s=latency_s)
    return condition(
        id=f'{link.id if event is None else event.id}.latency',
        sentence=(
            f'what passes the link to {link.receiver} takes {number(latency_s)} s '
            f'(within {steps} steps)'
        ),
        signal=f'excess_latency({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='<=', threshold=float(steps), unit='1'),
        arguments=arguments,
        source=Source(
            ids=(link.id,), spans=(link.latency_s.span,), provenance=Provenance.EXPLICIT
        ),
    )
