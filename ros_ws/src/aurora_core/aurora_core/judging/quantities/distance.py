# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The distance of two bodies in space, and how much closer they came."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.evaluation import Context, Evaluation, FloatArray, Later, Missing, at_tick
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.quantity import QuantityName


class Distance(StatedSeries):
    """Distance of two reference points in space, metres."""

    name = QuantityName.DISTANCE
    kind: Literal['distance'] = 'distance'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the distance at every tick."""
        return motion.distance(context.view, condition.of[0], condition.of[1])


class ClosedIn(Quantity):
    """How much the distance fell below the one at t = 0, metres.

    To a landmark it is that to where the road leads to it.
    """

    name = QuantityName.DISTANCE
    kind: Literal['closed_in'] = 'closed_in'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest approach; only the time before one of them is gone counts."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        values = motion.distance(context.view, *condition.of, on_road=True)
        both = context.view.present(condition.of[0]) & context.view.present(condition.of[1])
        end = first_tick(~both)
        if end == 0:
            return Missing(reason=Reason.TARGET_GONE, story='not both are there at t = 0', tick=0)
        nearest = int(np.argmin(values[:end]))
        closer_m = float(values[0] - values[nearest])
        topics = tuple(f'state[{name}]' for name in condition.of)
        return at_tick(nearest, closer_m, evidence=topics, later=Later.RISES)
