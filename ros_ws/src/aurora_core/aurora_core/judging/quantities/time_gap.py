# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How soon a follower would be where its leader is."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing, ground_topics
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName

# A follower that is not behind its leader (beside it is not behind), or stands, has no time gap:
# this stands for it.
NO_TIME_GAP_S = 100.0


class TimeGap(Quantity):
    """Bumper gap divided by the follower's speed, seconds; NO_TIME_GAP_S where there is none.

    Attributes:
        moving_mps: Speed above which a follower has a time gap.
        offset_m: How far from the follower's route the other one may be.
    """

    name = QuantityName.TIME_GAP
    kind: Literal['time_gap'] = 'time_gap'
    window: Window = Window.RUN
    moving_mps: FiniteFloat
    offset_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time gap at each tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view = context.view
        a, b = condition.of
        along = context.along(a, b)
        speed = motion.speed(view, view.body(a))
        valid = (speed > self.moving_mps) & (along.gap_m > 0.0)
        valid &= (along.offset_m <= self.offset_m) & view.present(a) & view.present(b)
        gap = np.maximum(along.gap_m, 0.0) / np.where(valid, speed, 1.0)
        values = np.where(valid, np.minimum(gap, NO_TIME_GAP_S), NO_TIME_GAP_S)
        return Measured(ticks=ticks, values=values[ticks], evidence=ground_topics(condition))
