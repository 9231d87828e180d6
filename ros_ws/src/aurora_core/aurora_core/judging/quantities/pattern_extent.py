# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long and how wide the flown pattern is."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    condition,
    number,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import route_topics
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.waypoints import extent
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class PatternExtent(OfMission):
    """How far the flown route reaches along one side of its pattern, metres.

    Attributes:
        axis: Direction (x, y) of that side.
    """

    name = QuantityName.PATTERN_EXTENT
    kind: Literal['pattern_extent'] = 'pattern_extent'
    axis: tuple[FiniteFloat, FiniteFloat]

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that length."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        uav = self.mission.uav
        topics = route_topics(condition)
        value = extent(context.view.reference(uav)[ticks], self.axis)
        story = f'{uav} flew {value:.2f} m far along that side of its pattern'
        return at_tick(int(ticks[-1]), value, story, topics, later=Later.RISES)


def implied(
    inputs: Inputs,
    mission: MissionArguments,
    side: str,
    size: Parameter,
    axis: tuple[float, float],
    source: Source,
) -> Condition:
    """Return that the length or width is the stated one: each end as a waypoint may be missed."""
    return condition(
        id=f'{mission.mission}.{side}',
        sentence=f'the pattern of {mission.uav} has a {side} of {number(size.value)} m',
        signal=f'{side}({mission.uav})',
        of=(mission.uav,),
        target=Target(
            op='==',
            threshold=size.value,
            unit='m',
            tolerance=2.0 * inputs.tolerances.waypoint_horizontal_m,
        ),
        arguments=PatternExtent(**inputs.common, mission=mission, axis=axis),
        source=stated_by(source, size),
        every_sample=False,
    )
