# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a link reaches as far as it is said to, and no farther; also past what is in between."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.comm.reach import reach_of
from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.messages import attempts_on_link, link_model
from aurora_core.judging.quantity import OfLink
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.ledger import is_out
from aurora_core.quantities.sight import radio_sight_series
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Link
from aurora_core.spec.vocabulary import LinkOcclusion
from aurora_core.trace.records import LossReason


class LinkRange(OfLink):
    """By how much each attempt was on the right side of the range, metres.

    One that passed, or was lost by chance, inside it; one that was lost for its distance outside.

    Attributes:
        range_m: Range with line of sight.
        hidden_m: Range without; None: the same.
    """

    name = QuantityName.LINK_RANGE
    kind: Literal['link_range'] = 'link_range'
    range_m: FiniteFloat
    hidden_m: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return one distance per attempt."""
        sent = attempts_on_link(context, condition, self.link)
        if isinstance(sent, Missing):
            return sent
        apart = motion.distance(context.view, *condition.of)
        free = radio_sight_series(context.view, *condition.of)
        outage_s = link_model(context, condition, self.link).outage_s
        ticks, slack = [], []
        for attempt in (a for message in sent for a in message.attempts):
            if attempt.tick < context.view.ticks:
                in_sight = self.hidden_m is None or bool(free[attempt.tick])
                range_m = self.range_m if in_sight else self.hidden_m
                inside_m = (range_m or 0.0) - float(apart[attempt.tick])
                out_of_range = not attempt.passed and attempt.reason is LossReason.RANGE
                if out_of_range and is_out(outage_s, attempt.tick, context.view.dt_s):
                    continue
                ticks.append(attempt.tick)
                slack.append(-inside_m if out_of_range else inside_m)
        return Measured(
            ticks=np.array(ticks, dtype=np.intp),
            values=np.array(slack),
            evidence=('comm', 'state'),
        )


def implied(inputs: Inputs, link: Link, range_m: Parameter) -> Condition:
    """Return that a link reaches as far as the prompt says."""
    return condition(
        id=f'{link.id}.range',
        sentence=f'{link.id} reaches {number(range_m.value)} m, and no farther',
        signal=f'range_slack({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='>=', threshold=0.0, unit='m'),
        arguments=LinkRange(
            **inputs.common, link=link.id, range_m=range_m.value, hidden_m=_hidden_m(inputs, link)
        ),
        source=Source(ids=(link.id,), spans=(range_m.span,), provenance=range_m.provenance),
    )


def occlusion(inputs: Inputs, link: Link) -> Condition:
    """Return what buildings and vehicles in between do to a link: stop it, or nothing."""
    reach_m = reach_of(link, inputs.limits).sight_m
    stops = link.occlusion is LinkOcclusion.BLOCKS
    what = 'nothing' if stops else 'as much'
    return condition(
        id=f'{link.id}.occlusion',
        sentence=(
            f'{link.id} reaches {number(reach_m)} m, and {what} passes where a building or '
            'vehicle is in between'
        ),
        signal=f'range_slack({link.id})',
        of=(link.sender, link.receiver),
        target=Target(op='>=', threshold=0.0, unit='m'),
        arguments=LinkRange(
            **inputs.common, link=link.id, range_m=reach_m, hidden_m=_hidden_m(inputs, link)
        ),
        source=Source(ids=(link.id,), spans=(link.span,)),
    )


def _hidden_m(inputs: Inputs, link: Link) -> float | None:
    """Return the range without line of sight, None where it is that with it."""
    reach = reach_of(link, inputs.limits)
    return None if reach.blocked_m == reach.sight_m else reach.blocked_m
