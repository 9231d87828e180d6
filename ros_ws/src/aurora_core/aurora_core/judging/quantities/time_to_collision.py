# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How soon one would run into the one ahead of it: the time to collision."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import headway
from aurora_core.spec.quantity import QuantityName


class TimeToCollision(StatedSeries):
    """Bumper gap to the one ahead in the lane, divided by the closing speed, s."""

    name = QuantityName.TIME_TO_COLLISION
    kind: Literal['time_to_collision'] = 'time_to_collision'
    window: Window = Window.RUN

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the time to collision at every tick."""
        return headway.pair_series(context.view, 'ttc', *condition.of)
