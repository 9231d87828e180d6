# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The distance of two bodies in the plane, and from the centre of a pattern."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, FloatArray
from aurora_core.judging.series import Series, StatedSeries
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.waypoints import pattern_centre
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName


class HorizontalDistance(StatedSeries):
    """Distance of two reference points in the plane, metres."""

    name = QuantityName.HORIZONTAL_DISTANCE
    kind: Literal['horizontal_distance'] = 'horizontal_distance'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the distance at every tick."""
        return motion.horizontal_distance(context.view, condition.of[0], condition.of[1])


class FromCentre(Series):
    """Distance of a UAV from the centre of the pattern that it flies, metres in the plane."""

    name = QuantityName.HORIZONTAL_DISTANCE
    kind: Literal['from_centre'] = 'from_centre'
    window: Window = Window.PHASE
    mission: MissionArguments

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the distance at every tick."""
        x, y = pattern_centre(self.mission.waypoints)
        point = context.view.reference(condition.of[0])
        return distance_2d(point[:, 0] - x, point[:, 1] - y)


def of_hover(
    inputs: Inputs, mission: MissionArguments, standoff: Parameter, target: str, source: Source
) -> Condition:
    """Return that a UAV hovers as far from its target as the prompt says."""
    return condition(
        id=f'{mission.mission}.standoff',
        sentence=(
            f'{mission.uav} hovers {bound_words(standoff)} {number(standoff.value)} m '
            f'from {target}'
        ),
        of=(mission.uav, target),
        target=number_target(standoff, inputs.tolerances.standoff_m),
        arguments=HorizontalDistance(**inputs.common, window=Window.PHASE, mission=mission),
        source=stated_by(source, standoff),
    )


def of_orbit(
    inputs: Inputs, mission: MissionArguments, radius: Parameter, source: Source
) -> Condition:
    """Return that a UAV circles with the radius that the prompt says."""
    uav = mission.uav
    return condition(
        id=f'{mission.mission}.radius',
        sentence=f'{uav} circles at {bound_words(radius)} {number(radius.value)} m',
        signal=f'distance_from_centre({uav})',
        of=(uav,),
        target=number_target(radius, inputs.tolerances.standoff_m),
        arguments=FromCentre(**inputs.common, mission=mission),
        source=stated_by(source, radius),
    )
