# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a UAV flies its legs with the stated speed."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    number,
    share_condition,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.quantity import OfMission, PerSample
from aurora_core.judging.route import flown_legs, route_topics
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.waypoints import cruising
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class RouteSpeed(OfMission):
    """Share of the samples on legs, away from their ends, at the stated speed.

    Attributes:
        speed: Stated, m/s.
        settle_m: Way that it needs to reach the slowest speed that counts, and to brake from it.
    """

    name = QuantityName.ROUTE_SPEED
    kind: Literal['route_speed'] = 'route_speed'
    speed: PerSample
    settle_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; on short legs there is no sample that counts."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        uav = context.view.body(self.mission.uav)
        flown = flown_legs(context, condition, self.mission)
        ticks = np.flatnonzero(cruising(context.view, uav, flown, self.settle_m))
        if len(ticks) == 0:
            return Missing(
                reason=Reason.EMPTY_PHASE,
                story=(
                    f'{uav.body_id} flew no leg longer than its acceleration and braking distances'
                ),
            )
        values = motion.speed(context.view, uav)
        good, what = self.speed.good(values), f'{uav.body_id} kept its speed'
        topics = route_topics(condition)
        return share_of(context, ticks, good, values, what, topics, growing=False)


def implied(
    inputs: Inputs, mission: MissionArguments, speed: Parameter, source: Source
) -> Condition:
    """Return that a UAV flies as fast as the prompt says."""
    share = inputs.tolerances.route_speed_share
    slack = inputs.tolerances.route_speed_mps.of(speed.value, approximate=speed.approximate)
    asked = PerSample.of(speed, slack)
    slowest_mps = max(0.0, speed.value - asked.tolerance)
    return share_condition(
        id=f'{mission.mission}.speed',
        sentence=(
            f'{mission.uav} flies {bound_words(speed)} {number(speed.value)} m/s for '
            f'{number(100 * share)} % of the time on its legs'
        ),
        of=(mission.uav,),
        share=share,
        arguments=RouteSpeed(
            **inputs.common,
            mission=mission,
            speed=asked,
            settle_m=(
                slowest_mps * slowest_mps / (2.0 * inputs.tolerances.route_acceleration_mps2)
            ),
        ),
        source=stated_by(source, speed),
    )
