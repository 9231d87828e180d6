# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether missions are flown in order, long enough, to the end of their route, and in time."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.geometry.kernel import norm2
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import OfMission
from aurora_core.judging.route import is_broken_off, route_flown
from aurora_core.judging.until import not_yet
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.phases import FlightPhases
from aurora_core.spec.quantity import QuantityName

# Time that a route may take: so much of what its stated speed gives, and so long per point (s).
_SLOW_SHARE = 1.5
_CORNER_S = 4.0


class PhaseOrder(OfMission):
    """How long after the phase before it a mission begins, seconds; negative: too early.

    Attributes:
        phase_change_s: Time within which the states have to show a change of phase.
        phase_follow_m: How close a UAV is to its set-point by then.
    """

    name = QuantityName.MISSION_COMPLETED
    kind: Literal['phase_order'] = 'phase_order'
    window: Window = Window.MOMENT
    phase_change_s: FiniteFloat
    phase_follow_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time, or the one to the landing if that is shorter."""
        mission = self.mission
        flight = context.flight(mission, self.touchdown_m)
        phase = context.phase(mission, self.touchdown_m)
        ready = self._ready(context, flight)
        if phase.command_tick is None or ready is None:
            if not context.complete(condition) and flight.landing_tick is None:
                return context.short(condition)
            what = 'was never commanded' if phase.command_tick is None else 'began too early'
            return Missing(reason=Reason.EMPTY_PHASE, story=f'{mission.mission} {what}')
        slack = phase.command_tick - ready
        if flight.landing_tick is not None:
            slack = min(slack, flight.landing_tick - phase.command_tick)
        story = (
            f'{mission.mission} was commanded at {context.time_s(phase.command_tick):.2f} s, '
            f'the phase before it ended at {context.time_s(ready):.2f} s'
        )
        return at_tick(
            phase.command_tick,
            context.time_s(slack),
            story,
            self.phase_topics,
            later=Later.FALLS,
            provisional=flight.landing_tick is None,
        )

    def _ready(self, context: Context, flight: FlightPhases) -> int | None:
        """Return when the phase before the mission ended: another mission, or the ascent."""
        before = [
            context.phase(other, self.touchdown_m)
            for other in context.mission_arguments
            if other.uav == self.mission.uav and other.index == self.mission.index - 1
        ]
        if before:
            return before[0].end_tick
        return flight.ascent_end_tick if self.mission.index == 0 else None


class PhaseTime(OfMission):
    """Time on a mission after its capture, seconds."""

    name = QuantityName.MISSION_COMPLETED
    kind: Literal['phase_time'] = 'phase_time'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time from capture to the next phase."""
        missing = context.phase_missing(condition, self.mission)
        if missing is not None:
            return missing
        phase = context.phase(self.mission, self.touchdown_m)
        assert phase.capture_tick is not None  # nothing is missing
        value = context.time_s(phase.stop_tick - phase.capture_tick)
        story = f'{self.mission.mission} lasted {value:.2f} s after capture'
        last_tick = phase.stop_tick - 1
        return at_tick(last_tick, value, story, self.phase_topics, later=Later.RISES)


class TimeAfterRoute(OfMission):
    """How long before the end of its phase a route was flown, seconds; negative: it was not.

    Attributes:
        allowed_s: Where an event may break the route off: time that it may take. Of one that is
            still under way then the time that is left counts.
    """

    name = QuantityName.MISSION_COMPLETED
    kind: Literal['time_after_route'] = 'time_after_route'
    allowed_s: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; a missed route ended at least one tick before it was done."""
        mission = self.mission
        missing = context.phase_missing(condition, mission)
        if missing is not None:
            return missing
        phase = context.phase(mission, self.touchdown_m)
        if self.allowed_s is not None and is_broken_off(context, condition, mission):
            assert phase.capture_tick is not None  # nothing is missing
            took_s = context.time_s(phase.stop_tick - phase.capture_tick)
            story = f'{mission.uav} had been on its route for {took_s:.2f} s when it was ended'
            return at_tick(phase.stop_tick - 1, self.allowed_s - took_s, story, self.phase_topics)
        flown = route_flown(context, condition, mission)
        last = flown[-1]
        missed = [k for k, passage in enumerate(flown) if passage.tick is None]
        if missed or last.tick is None:
            story = f'{mission.uav} had missed waypoint {missed[0] + 1} when the phase ended'
            return at_tick(phase.stop_tick - 1, -context.view.dt_s, story, self.phase_topics)
        value = context.time_s(phase.stop_tick - last.tick)
        story = f'{mission.uav} had flown its route {value:.2f} s before the phase ended'
        return at_tick(last.tick, value, story, self.phase_topics, later=Later.RISES)


class MissionEnd(OfMission):
    """When the phase after a mission is commanded, seconds from scenario start."""

    name = QuantityName.MISSION_COMPLETED
    kind: Literal['mission_end'] = 'mission_end'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; what is not over by the end of the run is late."""
        mission = self.mission
        missing = context.phase_missing(condition, mission)
        phase = context.phase(mission, self.touchdown_m)
        if phase.end_tick is not None and missing is None:
            value = context.time_s(phase.end_tick)
            story = f'{mission.mission} was over at {value:.2f} s'
            return at_tick(phase.end_tick, value, story, self.phase_topics)
        earliest_s = context.time_s(context.view.ticks)
        decided = earliest_s > condition.threshold or context.complete(condition)
        if phase.end_tick is None and phase.capture_tick is not None and decided:
            last_tick = context.view.ticks - 1
            story = f'{mission.mission} was not over at the end, {context.time_s(last_tick):.2f} s'
            return not_yet(context, condition, last_tick, earliest_s, story, self.phase_topics)
        return context.short(condition) if missing is None else missing


def in_order(
    inputs: Inputs, mission: MissionArguments, source: Source, *, id: str, sentence: str
) -> Condition:
    """Return that a mission is flown after the phase before it."""
    return condition(
        id=id,
        sentence=sentence,
        signal=f'phase_order({mission.uav},{mission.mission})',
        of=(mission.uav,),
        target=Target(op='>=', threshold=0.0, unit='s'),
        arguments=PhaseOrder(
            **inputs.common,
            mission=mission,
            phase_change_s=inputs.tolerances.phase_change_s,
            phase_follow_m=inputs.tolerances.phase_follow_m,
        ),
        source=source,
        every_sample=False,
    )


def completed(inputs: Inputs, mission: MissionArguments, *, id: str, source: Source) -> Condition:
    """Return that a mission lasts as long as planned, or that its route is flown."""
    uav, planned_s = mission.uav, mission.planned_s
    if mission.waypoints:
        until = '' if mission.left_by is None else f', or is on it when {mission.left_by} ends it'
        return condition(
            id=id,
            sentence=(
                f'{uav} has flown the whole route of {mission.mission} when the phase ends{until}'
            ),
            signal=f'time_after_route({uav},{mission.mission})',
            of=(uav,),
            target=Target(op='>=', threshold=0.0, unit='s'),
            arguments=TimeAfterRoute(
                **inputs.common, mission=mission, allowed_s=_allowed_s(inputs, mission)
            ),
            source=source,
            every_sample=False,
        )
    least_s = 0.0
    if planned_s is not None and mission.left_by is None:
        least_s = max(0.0, planned_s - inputs.tolerances.duration_s.of(planned_s))
    return condition(
        id=id,
        sentence=f'{uav} stays on {mission.mission} for at least {number(least_s)} s',
        signal=f'phase_time({uav},{mission.mission})',
        of=(uav,),
        target=Target(op='>=', threshold=least_s, unit='s'),
        arguments=PhaseTime(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )


def _allowed_s(inputs: Inputs, mission: MissionArguments) -> float | None:
    """Return the time that a route which an event may end takes at most, None for all others."""
    facts = inputs.mission_facts(mission.mission)
    if mission.left_by is None or facts is None:
        return None
    way_m = sum(norm2(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(mission.waypoints))
    corners_s = _CORNER_S * len(mission.waypoints)
    return _SLOW_SHARE * way_m / facts.transit_speed_mps + corners_s


def deadline(
    inputs: Inputs, mission: MissionArguments, by_s: float, *, id: str, source: Source
) -> Condition:
    """Return that a mission is over by a time from scenario start, completed or not."""
    return condition(
        id=id,
        sentence=f'{mission.mission} of {mission.uav} is over by {number(by_s)} s',
        signal=f'end_of_mission({mission.uav},{mission.mission})',
        of=(mission.uav,),
        target=Target(op='<=', threshold=by_s, unit='s'),
        arguments=MissionEnd(**inputs.common, mission=mission),
        source=source,
        every_sample=False,
    )
