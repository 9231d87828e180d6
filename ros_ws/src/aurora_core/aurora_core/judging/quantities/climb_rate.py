# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The vertical speed of a UAV inside its limits."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import (
    EVERY_RUN,
    Inputs,
    Target,
    condition,
    number,
)
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import Series
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName


class ClimbRate(Series):
    """Vertical speed, m/s, upwards positive."""

    name = QuantityName.CLIMB_RATE
    kind: Literal['climb_rate'] = 'climb_rate'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the vertical speed at every tick."""
        return motion.climb_rate(context.view, context.view.body(condition.of[0]))


def implied(inputs: Inputs, uav: str) -> tuple[Condition, Condition]:
    """Return that a UAV climbs and descends no faster than its limits allow."""
    limits, margin = inputs.limits, 1.0 + inputs.tolerances.limit_margin
    up, down = limits.uav_climb_max_mps, limits.uav_descent_max_mps
    climb, descent = (
        condition(
            id=f'safety.{name}.{uav}',
            sentence=f'{uav} {verb} with at most {number(most)} m/s',
            of=(uav,),
            target=target,
            arguments=ClimbRate(**inputs.common, window=Window.AIRBORNE),
            source=EVERY_RUN,
        )
        for name, verb, most, target in (
            ('climb', 'climbs', up, Target(op='<=', threshold=up * margin, unit='m/s')),
            ('descent', 'descends', down, Target(op='>=', threshold=-down * margin, unit='m/s')),
        )
    )
    return climb, descent
