# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far round its centre a UAV went on an orbit."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import route_topics
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.quantities.angle import compass_bearing_deg, turned_deg
from aurora_core.quantities.waypoints import pattern_centre
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName

_TURN_DEG = 360.0


class AngleSwept(OfMission):
    """Angle about the centre of a pattern from capture to the end of the phase, degrees.

    What is flown one way and back again is not swept.
    """

    name = QuantityName.ANGLE_SWEPT
    kind: Literal['angle_swept'] = 'angle_swept'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that angle, whichever way round."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        uav = self.mission.uav
        x, y = pattern_centre(self.mission.waypoints)
        point = context.view.reference(uav)[ticks]
        bearing = compass_bearing_deg(point[:, 0] - x, point[:, 1] - y)
        value = abs(float(turned_deg(bearing)[-1]))
        story = f'{uav} went {value:.1f} deg round the centre of its pattern'
        return at_tick(int(ticks[-1]), value, story, route_topics(condition), later=Later.ANY)


def implied(
    inputs: Inputs,
    mission: MissionArguments,
    turns: Parameter | None,
    source: Source,
    *,
    again: bool,
) -> Condition:
    """Return that an orbit goes round as often as stated.

    Args:
        inputs: The request and its plan.
        mission: The orbit.
        turns: Stated number of turns; None: one full turn.
        source: Of the condition.
        again: Where no number is stated it is one turn at least: its time is stated.
    """
    tolerance_deg = inputs.tolerances.orbit_deg
    if turns is not None:
        words, target = _stated(turns, tolerance_deg)
        source = stated_by(source, turns)
    elif again:
        words = f'at least {number(_TURN_DEG)} deg'
        target = Target(op='>=', threshold=_TURN_DEG - tolerance_deg, unit='deg')
    else:
        words = f'{number(_TURN_DEG)} deg'
        target = Target(op='==', threshold=_TURN_DEG, unit='deg', tolerance=tolerance_deg)
    return _swept(inputs, mission, words, target, source)


def in_part(
    inputs: Inputs, mission: MissionArguments, part_deg: float, source: Source
) -> Condition:
    """Return that an orbit goes as far round as there is time for.

    Args:
        inputs: The request and its plan.
        mission: The orbit.
        part_deg: How far that is at least (degrees).
        source: Of the condition.
    """
    # Of a part that is smaller than the tolerance half has to be flown: none at all is no orbit.
    least_deg = max(part_deg / 2.0, part_deg - inputs.tolerances.orbit_deg)
    target = Target(op='>=', threshold=least_deg, unit='deg')
    words = f'at least {number(part_deg)} deg, for which there is time,'
    return _swept(inputs, mission, words, target, source)


def _swept(
    inputs: Inputs, mission: MissionArguments, words: str, target: Target, source: Source
) -> Condition:
    return condition(
        id=f'{mission.mission}.turn',
        sentence=(
            f'{mission.uav} goes {words} round the centre of its orbit, within '
            f'{number(inputs.tolerances.orbit_deg)} deg'
        ),
        of=(mission.uav,),
        target=target,
        arguments=AngleSwept(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )


def _stated(turns: Parameter, tolerance_deg: float) -> tuple[str, Target]:
    """Return a stated number of turns as an angle: in words, and as a comparison."""
    angle_deg = _TURN_DEG * turns.value
    target = {
        Bound.AT_LEAST: Target(op='>=', threshold=angle_deg, unit='deg'),
        Bound.AT_MOST: Target(op='<=', threshold=angle_deg, unit='deg'),
        Bound.EXACTLY: Target(op='==', threshold=angle_deg, unit='deg', tolerance=tolerance_deg),
    }[turns.bound]
    return f'{bound_words(turns)} {number(angle_deg)} deg ({number(turns.value)} turns)', target
