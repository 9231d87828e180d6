# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often an agent follows another one within the gap that fits its speed."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    Missing,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName


class FollowFraction(Quantity):
    """Share of the time with the bumper gap inside its limits.

    Attributes:
        after_s: Samples before this time do not count.
        low_m: Least gap in motion.
        high_m: Greatest gap in motion.
        slow_low_m: Least gap while slow.
        slow_high_m: Greatest gap while slow.
        slow_mps: Speed of the follower up to which it is slow.
        offset_m: How far from the follower's route the other one may be.
    """

    name = QuantityName.FOLLOW_FRACTION
    kind: Literal['follow_fraction'] = 'follow_fraction'
    window: Window = Window.MISSIONS
    after_s: FiniteFloat
    low_m: FiniteFloat
    high_m: FiniteFloat
    slow_low_m: FiniteFloat
    slow_high_m: FiniteFloat
    slow_mps: FiniteFloat
    offset_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; who is absent neither follows nor leads."""
        ticks = context.window(condition, self.after_s)
        if isinstance(ticks, Missing):
            return ticks
        a, b = condition.of
        _, good = self.samples(context, condition)
        topics, gap_m = ground_topics(condition), context.along(a, b).gap_m
        return share_of(context, ticks, good, gap_m, f'{a} followed {b}', topics)

    def samples(self, context: Context, condition: Condition) -> tuple[BoolArray, BoolArray]:
        """Return which samples of the run count, that is all of them, and which are good."""
        view = context.view
        a, b = condition.of
        along = context.along(a, b)
        moving = motion.speed(view, view.body(a)) > self.slow_mps
        low = np.where(moving, self.low_m, self.slow_low_m)
        high = np.where(moving, self.high_m, self.slow_high_m)
        good = (along.gap_m >= low) & (along.gap_m <= high)
        good &= (along.offset_m <= self.offset_m) & view.present(a) & view.present(b)
        return np.ones(len(good), dtype=np.bool_), good
