# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a UAV is as high as its mission asks for."""

from __future__ import annotations

from typing import Literal

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
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class AltitudeFraction(OfMission):
    """Share of a mission at the requested altitude.

    Attributes:
        altitude: Requested, metres above ground.
    """

    name = QuantityName.ALTITUDE_FRACTION
    kind: Literal['altitude_fraction'] = 'altitude_fraction'
    altitude: PerSample

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; who is told to another altitude before it was there never was."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        early = context.left_early(self.mission, self.touchdown_m)
        if early is not None:
            told_s = f'{context.time_s(early):.2f} s'
            story = f'{self.mission.uav} left for another altitude at {told_s}, before its capture'
            return Missing(reason=Reason.EMPTY_PHASE, story=story)
        good = self.altitude.good(context.position(self.mission)[:, 2])
        values = motion.altitude(context.view, context.view.body(condition.of[0]))
        what = f'{condition.of[0]} kept its altitude'
        return share_of(context, ticks, good, values, what, self.phase_topics)


def implied(
    inputs: Inputs, mission: MissionArguments, altitude: Parameter, source: Source
) -> Condition:
    """Return that a UAV keeps the altitude that the prompt says."""
    share = inputs.tolerances.altitude_share
    slack = inputs.tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
    return share_condition(
        id=f'{mission.mission}.altitude',
        sentence=(
            f'{mission.uav} keeps {bound_words(altitude)} {number(altitude.value)} m altitude '
            f'for {number(100 * share)} % of {mission.mission}'
        ),
        of=(mission.uav,),
        share=share,
        arguments=AltitudeFraction(
            **inputs.common,
            mission=mission,
            altitude=PerSample.of(altitude, slack),
        ),
        source=stated_by(source, altitude),
    )
