# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What is left in the battery of a UAV."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName


class Battery(StatedSeries):
    """Share of a full charge while a UAV flies: linear in its time in the air."""

    name = QuantityName.BATTERY
    kind: Literal['battery'] = 'battery'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the share at every tick."""
        uav = context.view.body(condition.of[0])
        return motion.battery_series(context.view, uav, self.touchdown_m)
