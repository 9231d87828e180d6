# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How close in time one drives behind another one: its headway."""

from __future__ import annotations

from typing import Literal

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    number,
    share_condition,
    stated_by,
)
from aurora_core.judging.evaluation import (
    Context,
    FloatArray,
    Missing,
    TickArray,
)
from aurora_core.judging.quantity import PerSample
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import headway
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent


class TimeHeadway(StatedSeries):
    """Bumper gap to the one ahead in the lane, divided by one's own speed, s.

    Attributes:
        after_s: Samples before this time do not count.
        moving: Only samples count at which the follower moves.
        first: Number that it has to be within once (s): from then on it counts.
    """

    name = QuantityName.TIME_HEADWAY
    kind: Literal['time_headway'] = 'time_headway'
    window: Window = Window.RUN
    after_s: float = 0.0
    moving: bool = omitted(False)
    first: PerSample | None = omitted(None)

    def ticks(self, context: Context, condition: Condition) -> TickArray | Missing:
        """Return the ticks to judge, or why there are none."""
        found = super().ticks(context, condition)
        if isinstance(found, Missing):
            return found
        kept = found[found >= round(self.after_s / context.view.dt_s)]
        if self.moving:
            kept = kept[headway.is_moving(context.view, condition.of[0])[kept]]
        if self.first is not None:
            good = self.first.good(self.values(context, condition))
            begin = first_tick(good, 0)
            if begin is None:
                story = f'{condition.of[0]} was never so close behind {condition.of[1]}'
                return Missing(reason=Reason.PREMISE_NEVER, story=story)
            kept = kept[kept >= begin]
        if not len(kept):
            if not context.complete(condition):
                return context.short(condition)
            story = f'{condition.of[0]} never moved then'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        return kept

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the headway at every tick."""
        return headway.pair_series(context.view, 'headway', *condition.of)


def of_follower(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, asked: Parameter, name: str
) -> Condition:
    """Return that somebody keeps a stated headway for most of the time that it drives."""
    t, other = inputs.tolerances, behavior.target or ''
    return share_condition(
        id=f'{name}.headway',
        sentence=(
            f'{agent.id} drives {bound_words(asked)} {number(asked.value)} s behind {other} for '
            f'{number(100 * t.follow_fraction)} % of its time on the move after '
            f'{number(t.follow_after_s)} s'
        ),
        of=(agent.id, other),
        share=t.follow_fraction,
        arguments=TimeHeadway(
            **inputs.common,
            window=Window.MISSIONS,
            after_s=t.follow_after_s,
            moving=True,
            share=PerSample.of(asked, t.headway_s.of(asked.value, approximate=asked.approximate)),
        ),
        source=stated_by(Source(ids=(agent.id,), spans=(behavior.span,)), asked),
    )
