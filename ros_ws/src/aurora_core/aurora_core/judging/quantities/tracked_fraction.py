# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a UAV tracks its target."""

from __future__ import annotations

from typing import Literal

from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs, Source, number, share_condition
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities import motion
from aurora_core.quantities.phases import tracked
from aurora_core.spec.quantity import QuantityName


class TrackedFraction(OfMission):
    """Share of a mission within the tracking tolerance."""

    name = QuantityName.TRACKED_FRACTION
    kind: Literal['tracked_fraction'] = 'tracked_fraction'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; a target that is gone is not tracked."""
        rule = self.mission.track_rule
        if rule is None or self.mission.target is None:
            raise VerificationError(f'condition {condition.id}: its mission does not track')
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        name, target = condition.of
        uav, point = context.view.body(name), context.position(self.mission)
        good = tracked(context.view, uav, target, rule, point)
        apart = motion.horizontal_distance(context.view, name, target)
        what = f'{name} tracked {target}'
        return share_of(context, ticks, good, apart, what, self.phase_topics)


def implied(inputs: Inputs, mission: MissionArguments, target: str, source: Source) -> Condition:
    """Return that a UAV keeps its distance from its target."""
    share = inputs.tolerances.tracked_fraction
    return share_condition(
        id=f'{mission.mission}.tracked',
        sentence=(
            f'{mission.uav} tracks {target} from {number(mission.standoff_m)} m for '
            f'{number(100 * share)} % of the time after capture'
        ),
        of=(mission.uav, target),
        share=share,
        arguments=TrackedFraction(**inputs.common, mission=mission),
        source=source,
    )
