# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far a hovering UAV is from its point."""

from __future__ import annotations

from typing import Literal

from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import OfMission
from aurora_core.knowledge.limits import hover_drift_limit_m
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.kernels import distance_2d
from aurora_core.spec.quantity import QuantityName


class HoverDrift(OfMission):
    """Distance from the hover point in the plane, metres.

    Of a hover without a place the point is where the UAV comes to rest, see `RestRule`.
    """

    name = QuantityName.HOVER_DRIFT
    kind: Literal['hover_drift'] = 'hover_drift'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance at each tick of the mission."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        at = context.phase(self.mission, self.touchdown_m).point_m
        if at is None:
            raise VerificationError(f'condition {condition.id}: its mission has no hover point')
        point = context.view.reference(condition.of[0])
        drift = distance_2d(point[:, 0] - at[0], point[:, 1] - at[1])
        return Measured(ticks=ticks, values=drift[ticks], evidence=self.phase_topics)


def implied(inputs: Inputs, mission: MissionArguments, source: Source) -> Condition:
    """Return that a UAV stays where it hovers, as far as the weather lets it."""
    limit = hover_drift_limit_m(inputs.spec.world, inputs.limits, inputs.tolerances)
    where = 'its hover point' if mission.rest is None else 'where it comes to rest'
    return condition(
        id=f'{mission.mission}.drift',
        sentence=f'{mission.uav} stays within {number(limit)} m of {where}',
        of=(mission.uav,),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=HoverDrift(**inputs.common, mission=mission),
        source=source,
    )
