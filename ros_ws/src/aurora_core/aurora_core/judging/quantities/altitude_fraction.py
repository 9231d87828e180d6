# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a UAV is as high as its mission asks for, and on the way to it."""

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
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Missing,
    TickArray,
    at_tick,
)
from aurora_core.judging.quantity import OfMission, PerSample
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, MissionArguments
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.kernels import distance_2d
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName

# A way round what stands somewhere keeps so much more than the least clearance (m).
_ROOM_M = 2.0


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


class WayAltitude(OfMission):
    """Share of the metres of the way to a mission at the requested altitude.

    The way begins where the UAV is out of reach of where it was when the mission began: within
    that it may brake, climb and sink. Where what stands below leaves no room at the altitude it
    does not count.

    Attributes:
        altitude: Requested, metres above ground.
        braking_mps2: Deceleration at least.
        off_m: How far a UAV may be from its set-point.
        room_m: Clearance that a height needs to be free.
    """

    name = QuantityName.ALTITUDE_FRACTION
    kind: Literal['way_altitude'] = 'way_altitude'
    altitude: PerSample
    braking_mps2: FiniteFloat
    off_m: FiniteFloat
    room_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share of metres, 1 where there is no way to fly."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        phase = context.phase(self.mission, self.touchdown_m)
        first, last = phase.ready_tick, phase.capture_tick
        assert first is not None  # it has captured
        assert last is not None
        uav = context.view.body(self.mission.uav)
        point = context.position(self.mission)
        speed_mps = float(motion.horizontal_speed(context.view, uav)[first])
        ticks = first + self._metres(point[first : last + 1], speed_mps)
        at_height = point[ticks].copy()
        at_height[:, 2] = self.altitude.wanted
        room_m = context.view.geometry.obstacles.clearance_series(at_height, self.room_m + 1.0)
        ticks = ticks[room_m >= self.room_m]
        what = f'{self.mission.uav} had its altitude on its way'
        if len(ticks) == 0:
            return at_tick(last, 1.0, f'{what}, which had no length', self.phase_topics)
        values = motion.altitude(context.view, uav)
        good = self.altitude.good(point[:, 2])
        return share_of(context, ticks, good, values, what, self.phase_topics, growing=False)

    def _metres(self, point: FloatArray, speed_mps: float) -> TickArray:
        """Return the samples at which another metre is flown, out of reach of the first one."""
        step_m = distance_2d(np.diff(point[:, 0]), np.diff(point[:, 1]))
        flown_m = np.floor(np.concatenate([[0.0], np.cumsum(step_m)]))
        another = np.concatenate([[False], np.diff(flown_m) > 0.0])
        away_m = distance_2d(point[:, 0] - point[0, 0], point[:, 1] - point[0, 1])
        reach_m = speed_mps * speed_mps / (2.0 * self.braking_mps2) + self.off_m
        return np.flatnonzero(another & (away_m > reach_m))


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


def on_the_way(
    inputs: Inputs, mission: MissionArguments, altitude: Parameter, source: Source
) -> Condition:
    """Return that a UAV comes to a mission at the altitude that the prompt says."""
    share, tolerances = inputs.tolerances.altitude_share, inputs.tolerances
    slack = tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
    return share_condition(
        id=f'{mission.mission}.way_altitude',
        sentence=(
            f'{mission.uav} flies {bound_words(altitude)} {number(altitude.value)} m high for '
            f'{number(100 * share)} % of its way to {mission.mission}, once its climb or descent '
            'is over'
        ),
        signal=f'way_altitude({mission.uav})',
        of=(mission.uav,),
        share=share,
        arguments=WayAltitude(
            **inputs.common,
            mission=mission,
            altitude=PerSample.of(altitude, slack),
            braking_mps2=tolerances.route_acceleration_mps2,
            off_m=tolerances.phase_follow_m,
            room_m=inputs.limits.clearance_min_m + _ROOM_M,
        ),
        source=stated_by(source, altitude),
    )
