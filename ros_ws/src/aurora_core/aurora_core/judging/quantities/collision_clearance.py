# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The gap between bodies: no two may overlap."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import contact
from aurora_core.spec.quantity import QuantityName


class CollisionClearance(Quantity):
    """Least gap of any two bodies, metres."""

    name = QuantityName.COLLISION_CLEARANCE
    kind: Literal['collision_clearance'] = 'collision_clearance'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the gap of the closest pair at each tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        least = contact.body_gap(context.view)
        return Measured(
            ticks=ticks,
            values=least.values[ticks],
            label=least.name_at,
            evidence=('ground/state', 'uav/state', 'world'),
        )


def implied(inputs: Inputs, bodies: tuple[str, ...]) -> Condition:
    """Return that no two bodies overlap."""
    return condition(
        id='safety.collision',
        sentence='no two bodies overlap',
        signal='gap(all)',
        of=bodies,
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=CollisionClearance(**inputs.common, window=Window.RUN),
        source=EVERY_RUN,
    )
