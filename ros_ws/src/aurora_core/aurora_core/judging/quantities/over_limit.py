# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""By how much a vehicle drove faster than its lane allows."""

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
from aurora_core.judging.until import existing_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.lanes import NO_LANE, lane_of
from aurora_core.spec.quantity import QuantityName


class OverLimit(Quantity):
    """By how much the speed limit of the present lane was exceeded most, m/s.

    Attributes:
        moving_mps: Speed that counts as driving.
    """

    name = QuantityName.OVER_LIMIT
    kind: Literal['over_limit'] = 'over_limit'
    window: Window = Window.RUN
    moving_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest excess; off the streets there is no limit."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        view = context.view
        body = view.body(condition.of[0])
        lanes = lane_of(view, body)[:end]
        values = motion.speed(view, body)[:end]
        driven = np.flatnonzero((lanes != NO_LANE) & (values >= self.moving_mps))
        if len(driven) == 0:
            story = f'{body.body_id} never drove on a street'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        limits = np.array([lane.speed_limit_mps for lane in view.world.lanes])
        over = values[driven] - limits[lanes[driven]]
        most = int(np.argmax(over))
        tick, topics = int(driven[most]), ground_topics(condition)
        return at_tick(tick, float(over[most]), evidence=topics, later=Later.RISES)
