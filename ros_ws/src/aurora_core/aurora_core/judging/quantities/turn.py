# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a vehicle turned to one side."""

from __future__ import annotations

from typing import Literal

import numpy as np
import numpy.typing as npt
from pydantic import FiniteFloat

from aurora_core.document import omitted
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
from aurora_core.quantities import motion
from aurora_core.quantities.angle import compass_bearing_deg, turned_deg
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.quantity import QuantityName
from aurora_core.stl.windows import Extremum, sliding_clipped
from aurora_core.trace.layout import GroundColumn

BoolArray = npt.NDArray[np.bool_]


class Turn(Quantity):
    """By how much the heading changed to one side within some seconds, degrees.

    Attributes:
        side: Which one.
        within_s: Those seconds.
        moving_mps: Speed that counts as moving; who never moves cannot turn.
        place: Where it is to turn; None: anywhere.
        near_m: How far from there its front or rear may be.
    """

    name = QuantityName.TURN
    kind: Literal['turn'] = 'turn'
    window: Window = Window.RUN
    side: Literal['left', 'right']
    within_s: FiniteFloat
    moving_mps: FiniteFloat
    place: str | None = omitted(None)
    near_m: FiniteFloat | None = omitted(None)

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
        change = turned - least_before
        if self.place is not None:
            change = np.where(self._was_there(context, condition)[:end], change, 0.0)
        tick = int(np.argmax(change))
        topics = ground_topics(condition)
        return at_tick(tick, float(change[tick]), evidence=topics, later=Later.RISES)

    def _was_there(self, context: Context, condition: Condition) -> BoolArray:
        """Return whether it was at the place within those seconds, (T,)."""
        view, name = context.view, condition.of[0]
        assert self.place is not None
        reach_m = (self.near_m or 0.0) + view.body(name).entry.length_m / 2.0
        near = motion.horizontal_distance(view, name, self.place, on_road=True) <= reach_m
        ticks = whole_ticks(self.within_s, view.dt_s)
        last = np.maximum.accumulate(np.where(near, np.arange(len(near)), -ticks - 1))
        found: BoolArray = np.arange(len(near)) - last <= ticks
        return found
