# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far from its start a UAV comes down."""

from __future__ import annotations

from typing import Literal

from aurora_core.geometry.kernel import norm2
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.quantity import OfMissions
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName


class ReturnDistance(OfMissions):
    """Horizontal distance from where a UAV was at t = 0 to where it touched down, metres."""

    name = QuantityName.RETURN_DISTANCE
    kind: Literal['return_distance'] = 'return_distance'
    window: Window = Window.MOMENT

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that distance; who never comes down has not returned."""
        mission = self.missions[0]
        tick = context.flight(mission, self.touchdown_m).landed_tick
        if tick is None:
            if not context.complete(condition):
                return context.short(condition)
            story = f'{mission.uav} never came down'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        point = context.view.reference(mission.uav)
        (from_x, from_y), (x, y) = point[0, :2].tolist(), point[tick, :2].tolist()
        value = norm2(x - from_x, y - from_y)
        story = f'{mission.uav} came down {value:.2f} m from its start'
        return at_tick(tick, value, story, (f'uav/state[{mission.uav}]',))


def implied(
    inputs: Inputs, event: str, missions: tuple[MissionArguments, ...], source: Source
) -> Condition:
    """Return that a UAV lands where it started.

    Args:
        inputs: The request.
        event: That sends it home.
        missions: All missions of the UAV, at least one.
        source: Of the condition.
    """
    uav, within_m = missions[0].uav, inputs.tolerances.return_m
    return condition(
        id=f'{event}.returned',
        sentence=f'{uav} lands where it started, within {number(within_m)} m',
        of=(uav,),
        target=Target(op='<=', threshold=within_m, unit='m'),
        arguments=ReturnDistance(**inputs.common, missions=missions),
        source=source,
        every_sample=False,
    )
