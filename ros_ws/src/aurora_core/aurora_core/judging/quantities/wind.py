# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The mean wind of the run: how fast, from where, and how it meets a flight."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.geometry.kernel import norm2
from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing, TickArray
from aurora_core.judging.mission import mission_arguments
from aurora_core.judging.quantity import Quantity
from aurora_core.knowledge.limits import Tolerance
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.quantities import motion
from aurora_core.quantities.angle import bearing_error_deg, compass_bearing_deg
from aurora_core.quantities.waypoints import longest_leg
from aurora_core.spec.parameter import Bound, Parameter, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID
from aurora_core.spec.vocabulary import MissionMode, RelativeWind

# By how much the air goes off the course of who flies.
_OFF_COURSE_DEG = {
    RelativeWind.TAILWIND: 0.0,
    RelativeWind.CROSSWIND: 90.0,
    RelativeWind.HEADWIND: 180.0,
}
# Where no air moves it comes from nowhere: as far off as a direction can be.
_NOWHERE_DEG = 180.0

_WORLD = Source(ids=(ENVIRONMENT_ID,))


class WindSpeed(Quantity):
    """Speed of the mean wind of the recorded world at each tick, m/s."""

    name = QuantityName.WIND
    kind: Literal['wind_speed'] = 'wind_speed'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that speed."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        speed_mps = norm2(*_blows_to(context))
        return _measured(ticks, speed_mps, f'the recorded wind has {number(speed_mps)} m/s')


class GustSpeed(Quantity):
    """Speed of the recorded wind at the height of a gust, at each tick, m/s."""

    name = QuantityName.WIND
    kind: Literal['gust_speed'] = 'gust_speed'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that speed: of the mean wind and of the gusts over it."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        gust_mps = context.view.world.wind.gust_mps
        speed_mps = norm2(*_blows_to(context)) + gust_mps if gust_mps > 0.0 else 0.0
        return _measured(ticks, speed_mps, f'recorded gusts have {number(speed_mps)} m/s')


class WindFrom(Quantity):
    """How far off a bearing the recorded wind comes from at each tick, degrees.

    Attributes:
        from_deg: Asked, compass.
    """

    name = QuantityName.WIND
    kind: Literal['wind_from'] = 'wind_from'
    window: Window = Window.RUN
    from_deg: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that angle."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        east, north = _blows_to(context)
        if east == 0.0 and north == 0.0:
            return _measured(ticks, _NOWHERE_DEG, 'the recorded world has no wind')
        origin = compass_bearing_deg(np.array([-east]), np.array([-north]))
        off_deg = float(bearing_error_deg(origin, self.from_deg)[0])
        return _measured(ticks, off_deg, f'the recorded wind is from {float(origin[0]):.1f} deg')


class WindCourse(Quantity):
    """How far off the recorded wind is from meeting a flight as asked, degrees.

    On a route it is compared with the longest leg, on a track with the heading of the target at
    capture. Who hovers has no course: any wind will do.

    Attributes:
        wind: Asked.
    """

    name = QuantityName.WIND
    kind: Literal['wind_course'] = 'wind_course'
    window: Window = Window.RUN
    wind: RelativeWind

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that angle; a target that is never captured has no heading at capture."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        east, north = _blows_to(context)
        if east == 0.0 and north == 0.0:
            return _measured(ticks, _NOWHERE_DEG, 'the recorded world has no wind')
        mission = self.mission
        if mission is None or mission.mode is MissionMode.HOVER:
            return _measured(ticks, 0.0, 'a wind blows; who hovers has no course')
        if mission.mode is MissionMode.TRACK:
            missing = context.phase_missing(condition, mission)
            if missing is not None:
                return missing
        x, y = _course(context, mission, self.touchdown_m)
        along, across = east * x + north * y, abs(north * x - east * y)
        off = compass_bearing_deg(np.array([across]), np.array([along]))  # 0 to 180
        off_deg = float(bearing_error_deg(off, _OFF_COURSE_DEG[self.wind])[0])
        story = f'the recorded wind goes {float(off[0]):.1f} deg off the course of {mission.uav}'
        return _measured(ticks, off_deg, story)


def _blows_to(context: Context) -> tuple[float, float]:
    wind = context.view.world.wind
    return wind.mean_east_mps, wind.mean_north_mps


def _measured(ticks: TickArray, value: float, story: str) -> Measured:
    values = np.full(len(ticks), value)
    return Measured(ticks=ticks, values=values, story=story, evidence=('world',))


def _course(
    context: Context, mission: MissionArguments, touchdown_m: float
) -> tuple[float, float]:
    """Return the direction of a flight: of its longest leg, or of its target at capture."""
    if mission.mode is MissionMode.NAVIGATE:
        a, b = longest_leg(mission.waypoints)
        return b[0] - a[0], b[1] - a[1]
    tick = context.phase(mission, touchdown_m).capture_tick
    assert tick is not None  # nothing of the phase is missing
    assert mission.target is not None  # the specification refuses a track without one
    course = motion.course(context.view, context.view.body(mission.target))[tick]
    return float(course[0]), float(course[1])


def speed(inputs: Inputs, asked: Parameter) -> Condition:
    """Return that the wind is as fast as the request says."""
    exact = Tolerance(absolute=0.0, relative=inputs.tolerances.limit_margin)
    return condition(
        id='world.wind_speed',
        sentence=f'the wind has {bound_words(asked)} {number(asked.value)} m/s',
        signal='wind_speed',
        of=(),
        target=number_target(asked, exact),
        arguments=WindSpeed(**inputs.common),
        source=stated_by(_WORLD, asked),
    )


def gusts(inputs: Inputs, asked: Parameter) -> Condition:
    """Return that gusts are as fast as the request says: up to a speed they reach that speed."""
    exact = Tolerance(absolute=0.0, relative=inputs.tolerances.limit_margin)
    reached = asked
    if asked.bound is Bound.AT_MOST:
        reached = asked.model_copy(update={'bound': Bound.EXACTLY})
    return condition(
        id='world.gust_speed',
        sentence=f'gusts have {bound_words(reached)} {number(asked.value)} m/s',
        signal='gust_speed',
        of=(),
        target=number_target(reached, exact),
        arguments=GustSpeed(**inputs.common),
        source=stated_by(_WORLD, asked),
    )


def origin(inputs: Inputs, asked: Parameter) -> Condition:
    """Return that the wind comes from where the request says."""
    return condition(
        id='world.wind_from',
        sentence=f'the wind comes from {number(asked.value)} deg',
        signal='wind_off_bearing',
        of=(),
        target=Target(op='<=', threshold=inputs.tolerances.bearing_deg, unit='deg'),
        arguments=WindFrom(**inputs.common, from_deg=asked.value),
        source=stated_by(_WORLD, asked),
    )


def course(inputs: Inputs, wind: RelativeWind, span: Span | None) -> Condition:
    """Return that the wind meets the flight as the request says."""
    mission = _met(inputs)
    whom = 'whoever flies' if mission is None else mission.uav
    return condition(
        id='world.wind_course',
        sentence=f'{whom} has a {wind.value}',
        signal=f'off_{wind.value}',
        of=(),
        target=Target(op='<=', threshold=inputs.tolerances.side_deg, unit='deg'),
        arguments=WindCourse(**inputs.common, mission=mission, wind=wind),
        source=Source(ids=(ENVIRONMENT_ID,), spans=(span,)),
    )


def _met(inputs: Inputs) -> MissionArguments | None:
    """Return the flight that a wind is relative to: on the longest leg, else the first track."""
    missions = [mission_arguments(inputs, m) for m in inputs.spec.missions]
    routes = [m for m in missions if m.mode is MissionMode.NAVIGATE]
    tracks = [m for m in missions if m.mode is MissionMode.TRACK]
    return max(routes, key=_longest_m, default=next(iter((*tracks, *missions)), None))


def _longest_m(mission: MissionArguments) -> float:
    a, b = longest_leg(mission.waypoints)
    return norm2(b[0] - a[0], b[1] - a[1])
