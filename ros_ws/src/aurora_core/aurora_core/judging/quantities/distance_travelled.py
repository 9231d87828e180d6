# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a body has come."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName


class DistanceTravelled(Quantity):
    """Way covered within the window, metres."""

    name = QuantityName.DISTANCE_TRAVELLED
    kind: Literal['distance_travelled'] = 'distance_travelled'
    window: Window = Window.MISSIONS

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the way covered by the last tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        last = int(ticks[-1])
        value = float(motion.travelled(context.view, context.view.body(condition.of[0]))[last])
        story = f'{condition.of[0]} covered {value:.2f} m by {context.time_s(last):.2f} s'
        return at_tick(last, value, story, ground_topics(condition), later=Later.RISES)
