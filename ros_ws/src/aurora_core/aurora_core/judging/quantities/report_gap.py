# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a body reports as often as it is said to, from the first report to the last."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.happening import never_happened
from aurora_core.judging.messages import messages_of_link
from aurora_core.judging.mission import missions_of_uav
from aurora_core.judging.quantity import OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link


class ReportGap(OfLink):
    """By how much more than a tick the time between two reports is off at worst, seconds.

    A UAV reports from the end of its ascent to the end of its missions, anybody else from t = 0
    until all missions are over: before the first report and after the last one no more time than
    between two of them may pass.

    Attributes:
        period_s: Wanted time between two reports.
    """

    name = QuantityName.REPORT_GAP
    kind: Literal['report_gap'] = 'report_gap'
    period_s: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; who never is up has nothing to report."""
        found = messages_of_link(context, condition, self.link)
        if isinstance(found, Missing):
            return found
        begin, end = 0, context.missions_end
        if self.missions:
            flight = context.flight(self.missions[0], self.touchdown_m)
            if flight.ascent_end_tick is None:
                return never_happened(context, condition, 'the sender never was up')
            begin = flight.ascent_end_tick
            end = context.view.ticks if flight.over_tick is None else flight.over_tick
        sent = [m.sent_tick for m in found if m.event == self.link]
        if not sent:
            return never_happened(context, condition, f'nothing was reported on {self.link}')
        edges = [(begin, sent[0]), (sent[-1], end)]
        late = [(context.time_s(b - a) - self.period_s, b) for a, b in edges]
        off = [(abs(context.time_s(b - a) - self.period_s), b) for a, b in pairwise(sent)]
        worst_s, tick = max([*late, *off])
        worst_s = max(0.0, worst_s - context.view.dt_s)
        story = (
            f'{len(sent)} reports, the time between two of them is off by {worst_s:.2f} s at worst'
        )
        return at_tick(min(tick, context.view.ticks - 1), worst_s, story, ('comm',))


def implied(inputs: Inputs, link: Link, rate_hz: Parameter) -> Condition:
    """Return that a body reports as often as it is said to."""
    rate, period_s = number(rate_hz.value), 1.0 / rate_hz.value
    slack_s = inputs.tolerances.rate_share * period_s
    return condition(
        id=f'{link.id}.rate',
        sentence=f'{link.sender} reports to {link.receiver} {rate} times a second',
        signal=f'report_gap_off({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='<=', threshold=slack_s, unit='s'),
        arguments=ReportGap(
            **inputs.common,
            link=link.id,
            period_s=period_s,
            missions=missions_of_uav(inputs, link.sender),
        ),
        source=Source(ids=(link.id,), spans=(rate_hz.span,), provenance=rate_hz.provenance),
        every_sample=False,
    )
