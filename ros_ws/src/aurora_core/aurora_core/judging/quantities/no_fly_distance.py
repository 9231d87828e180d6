# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The distance of a flying UAV from no-fly zones."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import contact
from aurora_core.spec.quantity import QuantityName


class NoFlyDistance(Quantity):
    """Signed distance of a flying UAV from the nearest no-fly zone, metres; negative inside."""

    name = QuantityName.NO_FLY_DISTANCE
    kind: Literal['no_fly_distance'] = 'no_fly_distance'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance from the nearest zone at each tick in the air."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        values = contact.no_fly_distance(context.view, context.view.body(condition.of[0]))
        return Measured(ticks=ticks, values=values[ticks], evidence=('uav/state', 'world'))


def implied(inputs: Inputs, uav: str) -> Condition:
    """Return that a UAV enters no zone."""
    return condition(
        id=f'safety.no_fly.{uav}',
        sentence=f'{uav} enters no no-fly zone',
        of=(uav,),
        target=Target(op='>=', threshold=0.0, unit='m'),
        arguments=NoFlyDistance(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
