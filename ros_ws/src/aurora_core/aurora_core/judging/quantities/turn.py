# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a vehicle turned to one side."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.until import moving_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities.angle import compass_bearing_deg, turned_deg
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.quantity import QuantityName
from aurora_core.stl.windows import Extremum, sliding_clipped
from aurora_core.trace.layout import GroundColumn


class Turn(Quantity):
    """By how much the heading changed to one side within some seconds, degrees.

    Attributes:
        side: Which one.
        within_s: Those seconds.
        moving_mps: Speed that counts as moving; who never moves cannot turn.
    """

    name = QuantityName.TURN
    kind: Literal['turn'] = 'turn'
    window: Window = Window.RUN
    side: Literal['left', 'right']
    within_s: FiniteFloat
    moving_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest change."""
        end = moving_until(context, condition, self.moving_mps)
        if isinstance(end, Missing):
            return end
        rows = context.view.rows(context.view.body(condition.of[0]))[:end]
        heading = rows[:, GroundColumn.HEADING_X], rows[:, GroundColumn.HEADING_Y]
        turned = turned_deg(compass_bearing_deg(*heading))
        if self.side == 'left':
            turned = -turned
        width = whole_ticks(self.within_s, context.view.dt_s) + 1
        least_before = sliding_clipped(turned[::-1], width, Extremum.LEAST)[::-1]
        tick = int(np.argmax(turned - least_before))
        value = float(turned[tick] - least_before[tick])
        return at_tick(tick, value, evidence=ground_topics(condition), later=Later.RISES)
