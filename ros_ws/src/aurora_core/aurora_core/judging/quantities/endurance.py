# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a UAV is in the air."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.quantity import QuantityName


class Endurance(Quantity):
    """Seconds from the first to the last sample in the air."""

    name = QuantityName.ENDURANCE
    kind: Literal['endurance'] = 'endurance'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time in the air; landings in between count as flight."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        value = context.time_s(int(ticks[-1]) - int(ticks[0]) + 1)
        story = f'{condition.of[0]} was in the air for {value:.2f} s'
        topics = (f'uav/state[{condition.of[0]}]',)
        return at_tick(int(ticks[-1]), value, story, topics, later=Later.RISES)


def implied(inputs: Inputs, uav: str) -> Condition:
    """Return that a UAV is down before its battery is empty."""
    most_s = inputs.limits.uav_endurance_s
    return condition(
        id=f'safety.endurance.{uav}',
        sentence=f'{uav} flies at most {number(most_s)} s',
        of=(uav,),
        target=Target(
            op='<=', threshold=most_s * (1.0 + inputs.tolerances.limit_margin), unit='s'
        ),
        arguments=Endurance(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
        every_sample=False,
    )
