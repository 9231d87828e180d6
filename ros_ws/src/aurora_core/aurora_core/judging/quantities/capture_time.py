# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a UAV needs to where its mission begins."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.errors import VerificationError
from aurora_core.geometry.kernel import norm2
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.mission import changes_height, climb_mps, descent_mps
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.until import not_yet
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.quantity import QuantityName


class CaptureTime(OfMission):
    """Time from the end of the ascent (a later mission: its first command) to capture, s.

    Attributes:
        way_mps: The time that the way to the first point takes at this speed does not count. None:
            the threshold has it, as for a first mission, whose way is planned.
        climb_mps: Nor does the time that the height takes at this rate, where that is longer.
            None: it is as high as before.
        descent_mps: The same on the way down.
        level_way: It climbs or sinks before its way, and not on it.
    """

    name = QuantityName.CAPTURE_TIME
    kind: Literal['capture_time'] = 'capture_time'
    window: Window = Window.MOMENT
    way_mps: FiniteFloat | None = omitted(None)
    climb_mps: FiniteFloat | None = omitted(None)
    descent_mps: FiniteFloat | None = omitted(None)
    level_way: bool = omitted(False)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; a target that is gone before excuses, the end of the run does not."""
        mission = self.mission
        phase = context.phase(mission, self.touchdown_m)
        if phase.capture_tick is not None and phase.ready_tick is not None:
            value = context.time_s(phase.capture_tick - phase.ready_tick)
            story = (
                f'{mission.uav} captured at {context.time_s(phase.capture_tick):.2f} s, '
                f'{value:.2f} s after {context.time_s(phase.ready_tick):.2f} s'
            )
            way_s = self._way_s(context, phase.ready_tick)
            if way_s > 0.0:
                value -= way_s
                story += f', {way_s:.2f} s of them for its way'
            return at_tick(phase.capture_tick, value, story, self.phase_topics)
        missing = context.phase_missing(condition, mission)
        if missing is None:
            raise VerificationError(f'{condition.id}: a phase without capture must be missing')
        lasted = phase.end_tick is None and phase.ready_tick is not None
        if lasted and missing.reason is not Reason.TARGET_GONE:
            # Not by the end of the record: at the earliest with the next tick.
            ready = phase.ready_tick or 0
            waited_s = context.time_s(context.view.ticks - ready) - self._way_s(context, ready)
            if waited_s > condition.threshold or context.complete(condition):
                story = f'{mission.uav} had not captured after {waited_s:.2f} s'
                tick, topics = context.view.ticks - 1, self.phase_topics
                return not_yet(context, condition, tick, waited_s, story, topics)
            return context.short(condition)
        return missing

    def _way_s(self, context: Context, tick: int) -> float:
        """Return how long the way from where a UAV is at a tick to its first point takes."""
        mission, speed = self.mission, self.way_mps
        if speed is None:
            return 0.0
        x, y, z = context.view.reference(mission.uav)[tick].tolist()
        height_s = self._height_s(mission.altitude_m - z)
        goal = mission.point_m
        if goal is None:
            if mission.target is None or not context.view.has(mission.target):
                return height_s
            there = context.view.reference(mission.target)[tick, :2].tolist()
            goal = (there[0], there[1])
        way_m = norm2(goal[0] - x, goal[1] - y) - mission.standoff_m
        if self.level_way:
            return max(way_m, 0.0) / speed + height_s
        return max(way_m / speed, height_s)

    def _height_s(self, rise_m: float) -> float:
        """Return how long a UAV climbs or sinks by so much, at least 0 s."""
        rate = self.climb_mps if rise_m > 0.0 else self.descent_mps
        return 0.0 if rate is None else abs(rise_m) / rate


def implied(
    inputs: Inputs, mission: MissionArguments, facts: MissionFacts, source: Source
) -> Condition:
    """Return that a UAV captures in the time that the way takes."""
    allowed_s, way_mps = inputs.tolerances.capture_s, facts.transit_speed_mps
    after = f'and its way at {number(way_mps)} m/s after the phase before it'
    planned = mission.index == 0
    rates: tuple[float | None, float | None] = None, None
    level_way = False
    if planned:
        # A later mission begins wherever the one before it ended: that target has moved since.
        allowed_s += facts.transit_m / way_mps
        after = 'after its ascent'
    elif changes_height(inputs, mission):
        rates = up_mps, down_mps = climb_mps(inputs), descent_mps(inputs)
        asked = (m for m in inputs.spec.missions if m.id == mission.mission)
        level_way = any(m.has_a_level_way for m in asked)
        after = (
            f'and its way at {number(way_mps)} m/s, {"first " if level_way else ""}'
            f'{number(up_mps)} m/s up or {number(down_mps)} m/s down after the phase before it'
        )
    return condition(
        id=f'{mission.mission}.capture',
        sentence=f'{mission.uav} captures {mission.mission} within {number(allowed_s)} s {after}',
        of=(mission.uav,),
        target=Target(op='<=', threshold=allowed_s, unit='s'),
        arguments=CaptureTime(
            **inputs.common,
            mission=mission,
            way_mps=None if planned else way_mps,
            climb_mps=rates[0],
            descent_mps=rates[1],
            level_way=level_way,
        ),
        source=source,
        every_sample=False,
    )
