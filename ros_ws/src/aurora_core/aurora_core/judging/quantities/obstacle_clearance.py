# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The distance of a flying UAV from everything that it could fly into."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import contact
from aurora_core.spec.quantity import QuantityName


class ObstacleClearance(Quantity):
    """Distance of a flying UAV from the nearest building, vehicle or person, metres."""

    name = QuantityName.OBSTACLE_CLEARANCE
    kind: Literal['obstacle_clearance'] = 'obstacle_clearance'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance from the nearest obstacle at each tick in the air."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        least = contact.obstacle_clearance(context.view, context.view.body(condition.of[0]))
        return Measured(
            ticks=ticks,
            values=least.values[ticks],
            label=least.name_at,
            evidence=('ground/state', 'uav/state', 'world'),
        )


def implied(inputs: Inputs, uav: str) -> Condition:
    """Return that a UAV keeps clear of everything."""
    least = inputs.limits.clearance_min_m
    return condition(
        id=f'safety.clearance.{uav}',
        sentence=f'{uav} keeps {number(least)} m from buildings, vehicles and persons',
        of=(uav,),
        target=Target(op='>=', threshold=least, unit='m'),
        arguments=ObstacleClearance(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
