# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a body sees its target."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, number, share_condition
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.quantity import OfSight
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.spec.quantity import QuantityName


class VisibleFraction(OfSight):
    """Share of a mission, from the ground of the whole run, in which the target is visible."""

    name = QuantityName.VISIBLE_FRACTION
    kind: Literal['visible_fraction'] = 'visible_fraction'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; a target that is gone is not visible."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        observer, target = condition.of
        sight = context.sight(observer, target)
        what = f'{observer} saw {target}'
        topics = self.sight_topics(observer)
        return share_of(context, ticks, sight.visible, sight.margin_m, what, topics)


def implied(inputs: Inputs, mission: MissionArguments, target: str, source: Source) -> Condition:
    """Return that a UAV sees its target for most of its mission, or for a lesser stated share."""
    shares = [inputs.tolerances.visible_fraction]
    shares += [
        stated.value.value
        for stated in inputs.spec.conditions
        if stated.quantity == QuantityName.VISIBLE_FRACTION
        and stated.op in ('>=', '>')
        and stated.of == (mission.uav, target)
    ]
    share = min(shares)
    return share_condition(
        id=f'{mission.mission}.visible',
        sentence=f'{mission.uav} sees {target} for {number(100 * share)} % of {mission.mission}',
        of=(mission.uav, target),
        share=share,
        arguments=VisibleFraction(**inputs.common, mission=mission),
        source=Source(ids=source.ids, spans=source.spans),
    )
