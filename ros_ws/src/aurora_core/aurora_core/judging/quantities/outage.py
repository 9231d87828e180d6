# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether nothing passes a link while it is said to be out."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.happening import never_happened
from aurora_core.judging.messages import attempts_on_link
from aurora_core.judging.quantity import OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link


class Outage(OfLink):
    """How deep inside an outage something passes, seconds; 0 where nothing does.

    Attributes:
        from_s: Its beginning, scenario time.
        to_s: Its end.
    """

    name = QuantityName.OUTAGE
    kind: Literal['outage'] = 'outage'
    from_s: FiniteFloat
    to_s: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the worst attempt; an outage in which nothing is tried shows nothing."""
        sent = attempts_on_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        tried = [(a, context.time_s(a.tick)) for m in sent for a in m.attempts]
        inside = [(a, at_s) for a, at_s in tried if self.from_s <= at_s < self.to_s]
        if not inside:
            story = f'nothing was sent from {self.from_s:g} to {self.to_s:g} s'
            return never_happened(context, condition, story)
        deep = [
            (min(at_s - self.from_s, self.to_s - at_s) if a.passed else 0.0, a.tick)
            for a, at_s in inside
        ]
        worst, tick = max(deep)
        passed = sum(a.passed for a, _ in inside)
        story = f'{passed} of {len(inside)} attempts passed in the outage'
        return at_tick(tick, worst, story, ('comm',))


def implied(inputs: Inputs, link: Link, outage_s: tuple[Parameter, Parameter]) -> Condition:
    """Return that a link is out when the prompt says, to the tolerance at both ends."""
    begins, ends = outage_s
    return condition(
        id=f'{link.id}.outage',
        sentence=f'{link.id} is out from {number(begins.value)} to {number(ends.value)} s',
        signal=f'passed_in_outage({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='<=', threshold=inputs.tolerances.outage_s, unit='s'),
        arguments=Outage(**inputs.common, link=link.id, from_s=begins.value, to_s=ends.value),
        source=Source(
            ids=(link.id,), spans=(begins.span, ends.span), provenance=begins.provenance
        ),
        every_sample=False,
    )
