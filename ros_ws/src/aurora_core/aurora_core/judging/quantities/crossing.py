# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How wide a carriageway is that a person crossed."""

from __future__ import annotations

from typing import Literal

import numpy as np

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
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.quantity import QuantityName


class Crossing(Quantity):
    """Distance from where a carriageway was entered to where it was left, metres."""

    name = QuantityName.CROSSING
    kind: Literal['crossing'] = 'crossing'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the widest crossing; who stays on a carriageway has not crossed it."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        name = condition.of[0]
        point = context.view.reference(name)[:end, :2]
        on = context.view.geometry.surfaces(SurfaceKind.DRIVING).contains(point)
        edges = np.flatnonzero(np.diff(on.astype(np.int8)))
        entered = edges[~on[edges]]
        if len(entered) == 0:
            story = f'{name} never stepped onto a carriageway'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        widest, tick = 0.0, int(entered[0])
        for before in entered.tolist():
            after = first_tick(~on, before + 1)
            if after is None:
                continue
            dx, dy = (point[after] - point[before]).tolist()
            width = distance_2d(float(dx), float(dy))
            if width > widest:
                widest, tick = width, after
        return at_tick(tick, widest, evidence=ground_topics(condition), later=Later.RISES)
