# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a UAV is on a side of the target that it tracks."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, number, share_condition
from aurora_core.judging.evaluation import Context, Evaluation, Missing
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities import motion
from aurora_core.quantities.angle import bearing_error_deg, compass_bearing_deg
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.vocabulary import Side

# Clockwise from the heading of the target.
_WANTED_DEG = {Side.AHEAD: 0.0, Side.RIGHT: 90.0, Side.BEHIND: 180.0, Side.LEFT: 270.0}
_WORDS = {
    Side.AHEAD: 'ahead of',
    Side.RIGHT: 'to the right of',
    Side.BEHIND: 'behind',
    Side.LEFT: 'to the left of',
}


class SideFraction(OfMission):
    """Share of a mission in which a UAV is on a side of its target.

    A side is relative to the heading of the target, of the last moment at which it moved; right
    above the target there is none.

    Attributes:
        side: Asked.
        tolerance_deg: On its direction.
    """

    name = QuantityName.SIDE_FRACTION
    kind: Literal['side_fraction'] = 'side_fraction'
    side: Side
    tolerance_deg: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; nobody is on a side of a target that is gone."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view, (uav, target) = context.view, condition.of
        delta = view.reference(uav) - view.reference(target)
        course = motion.course(view, view.body(target))
        ahead = delta[:, 0] * course[:, 0] + delta[:, 1] * course[:, 1]
        right = delta[:, 0] * course[:, 1] - delta[:, 1] * course[:, 0]
        off_deg = bearing_error_deg(compass_bearing_deg(right, ahead), _WANTED_DEG[self.side])
        good = (off_deg <= self.tolerance_deg) & ((ahead != 0.0) | (right != 0.0))
        good &= view.present(target)
        what = f'{uav} was {_WORDS[self.side]} {target}'
        topics = (*self.phase_topics, f'ground/state[{target}]')
        return share_of(context, ticks, good, off_deg, what, topics)


def implied(
    inputs: Inputs, mission: MissionArguments, side: Side, target: str, source: Source
) -> Condition:
    """Return that a UAV keeps to the side of its target that is asked for."""
    share, tolerance_deg = inputs.tolerances.relation_fraction, inputs.tolerances.side_deg
    return share_condition(
        id=f'{mission.mission}.side',
        sentence=(
            f'{mission.uav} is {_WORDS[side]} {target}, within {number(tolerance_deg)} deg, for '
            f'{number(100 * share)} % of {mission.mission}'
        ),
        signal=f'{side.value}_fraction({mission.uav},{target})',
        of=(mission.uav, target),
        share=share,
        arguments=SideFraction(
            **inputs.common, mission=mission, side=side, tolerance_deg=tolerance_deg
        ),
        source=source,
    )
