# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a pattern lies."""

from __future__ import annotations

from typing import Literal

import shapely

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.waypoints import pattern_centre
from aurora_core.spec.quantity import QuantityName


class PatternCentre(OfMission):
    """Distance from the centre of the pattern, or the hover point, to the target at t = 0, metres.

    Of a way between two places it is the first or last point that counts, and the outline of a
    landmark that is a building.

    A landmark is where the map has it; a hover over the roof of its building is over it. The
    street before it is another place.
    """

    name = QuantityName.PATTERN_CENTRE
    kind: Literal['pattern_centre'] = 'pattern_centre'
    window: Window = Window.START
    end: Literal['first', 'last'] | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that distance."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        target = condition.of[1]
        if not context.view.present(target)[0]:
            return Missing(reason=Reason.TARGET_GONE, story=f'{target} is absent at t = 0', tick=0)
        if self.end is not None:
            return self._at_end(context, target)
        hovers = not self.mission.waypoints and self.mission.point_m is not None
        point = self.mission.point_m or (0.0, 0.0)
        x, y = point if hovers else pattern_centre(self.mission.waypoints)
        value = self._away_m(context, target, (x, y), hovers=hovers)
        what = 'hover point' if hovers else 'centre of the pattern'
        story = f'the {what} is {value:.2f} m from {target} at t = 0'
        return at_tick(0, value, story, (f'state[{target}]',))

    def _at_end(self, context: Context, target: str) -> Evaluation:
        x, y, _ = self.mission.waypoints[0 if self.end == 'first' else -1]
        building = context.view.geometry.building_of(target)
        if building is not None:
            value = float(shapely.Polygon(building.ring).distance(shapely.Point(x, y)))
        else:
            value = self._away_m(context, target, (x, y), hovers=False)
        story = f'the {self.end} point of the way is {value:.2f} m from {target}'
        return at_tick(0, value, story, (f'state[{target}]',))

    def _away_m(
        self, context: Context, target: str, point: tuple[float, float], *, hovers: bool
    ) -> float:
        x, y = point
        at = context.view.reference(target)[0]
        before_m = float(distance_2d(float(at[0]) - x, float(at[1]) - y))
        building = context.view.geometry.building_of(target)
        if building is None:
            return before_m
        if not context.view.geometry.is_itself(target):
            middle = building.centre
            before_m = float(distance_2d(middle[0] - x, middle[1] - y))
        return 0.0 if hovers and building.is_below(x, y) else before_m


def implied(
    inputs: Inputs, mission: MissionArguments, target: str, source: Source, limit: float
) -> Condition:
    """Return that a pattern lies around its target, to `limit` (m)."""
    return condition(
        id=f'{mission.mission}.centre',
        sentence=(
            f'the pattern of {mission.uav} is centred within {number(limit)} m of {target} '
            'at t = 0'
        ),
        of=(mission.uav, target),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=PatternCentre(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )


def of_end(
    inputs: Inputs,
    mission: MissionArguments,
    end: Literal['first', 'last'],
    place: str,
    source: Source,
) -> Condition:
    """Return that a way begins, or ends, at a place."""
    limit = inputs.tolerances.pattern_centre_m
    name, verb = ('start', 'begins') if end == 'first' else ('end', 'ends')
    return condition(
        id=f'{mission.mission}.{name}',
        sentence=f'the way of {mission.uav} {verb} within {number(limit)} m of {place}',
        of=(mission.uav, place),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=PatternCentre(**inputs.common, mission=mission, end=end),
        source=source,
        every_sample=False,
    )


def of_hover(inputs: Inputs, mission: MissionArguments, target: str, source: Source) -> Condition:
    """Return that a UAV hovers over its target."""
    limit = inputs.tolerances.pattern_centre_m
    return condition(
        id=f'{mission.mission}.over',
        sentence=(
            f'the hover point of {mission.uav} is within {number(limit)} m of {target} at t = 0'
        ),
        of=(mission.uav, target),
        target=Target(op='<=', threshold=limit, unit='m'),
        arguments=PatternCentre(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )
