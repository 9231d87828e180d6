# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""For how long a body sees a target, in all or without a break."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import OfSight
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.quantity import QuantityName


class VisibleTime(OfSight):
    """Time of sight in the phases of a UAV, from the ground in the whole run, seconds.

    Attributes:
        unbroken: The longest stretch without a gap counts, not the sum.
    """

    name = QuantityName.VISIBLE_TIME
    kind: Literal['visible_time'] = 'visible_time'
    unbroken: bool = False

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        observer, target = condition.of
        seen = context.sight(observer, target).visible[ticks]
        count = int(np.count_nonzero(seen))
        if self.unbroken:
            padded = np.concatenate(([False], seen, [False]))
            edges = np.flatnonzero(np.diff(padded.astype(np.int8)))
            count = int((edges[1::2] - edges[0::2]).max(initial=0))
        seen_s = context.time_s(count)
        story = f'{observer} saw {target} for {seen_s:.2f} s'
        topics = self.sight_topics(observer)
        return at_tick(int(ticks[-1]), seen_s, story, topics, later=Later.RISES)
