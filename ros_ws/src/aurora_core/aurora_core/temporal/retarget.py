# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Move triggers that nobody states to where the grounding can meet them.

A default that was chosen before anybody had a place may hold from the start on, or never. It moves
to the nearest value between where the scene starts and what it can come to; where nothing lies
between the two it stays. What the prompt states stays in any case.
"""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.geometry.kernel import norm2
from aurora_core.knowledge.limits import Limits
from aurora_core.mission.plan import MissionPlan
from aurora_core.outcomes.grounded import GroundedScenario, RealisedValue
from aurora_core.outcomes.triggers import movable, trigger_path
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    DistanceTrigger,
    Event,
    ScenarioSpec,
    SpeedTrigger,
    TimeTrigger,
    UavAction,
)
from aurora_core.spec.stated import is_stated
from aurora_core.spec.vocabulary import MissionMode

# A trigger has to be passed, not touched: this far inside (m, m/s).
_ROOM = 2.0
# Share of a stated duration by which what nobody dates has begun: it takes time as well.
_EARLY_SHARE = 0.5


@dataclass(frozen=True, slots=True)
class Between:
    """Where a trigger is neither met from the start on nor out of reach."""

    low: float
    high: float

    def near(self, value: float) -> float:
        """Return the nearest value in between, the value itself where there is none."""
        return value if self.low > self.high else min(max(value, self.low), self.high)


def retargeted(spec: ScenarioSpec, grounded: GroundedScenario, limits: Limits) -> GroundedScenario:
    """Return a grounding with the values of the triggers that had to move.

    Args:
        spec: The request.
        grounded: Its grounding; values of triggers in it are worked out anew.
        limits: Limits in force.
    """
    ours = {
        trigger_path(event.id, found[0])
        for event in spec.events
        if (found := movable(event.trigger)) is not None
    }
    kept = tuple(row for row in grounded.realised if row.path not in ours)
    moved = tuple(
        row for event in spec.events if (row := _moved(spec, event, grounded, limits)) is not None
    )
    return grounded.model_copy(update={'realised': (*kept, *moved)})


def _moved(
    spec: ScenarioSpec, event: Event, grounded: GroundedScenario, limits: Limits
) -> RealisedValue | None:
    found = movable(event.trigger)
    between = _between(spec, event, grounded, limits)
    if found is None or between is None:
        return None
    name, parameter = found
    value = between.near(parameter.value)
    if value == parameter.value or not parameter.low <= value <= parameter.high:
        return None
    return RealisedValue(
        path=trigger_path(event.id, name),
        requested=parameter.value,
        realised=value,
        provenance=parameter.provenance,
    )


def _between(
    spec: ScenarioSpec, event: Event, grounded: GroundedScenario, limits: Limits
) -> Between | None:
    match event.trigger:
        case DistanceTrigger() as trigger:
            return _distances(trigger, grounded, limits)
        case AltitudeTrigger() as trigger:
            return _altitudes(spec, trigger, grounded)
        case SpeedTrigger() as trigger:
            return _speeds(trigger, grounded)
        case TimeTrigger() if is_stated(spec.world.duration_s) and spec.world.duration_s:
            return Between(0.0, _EARLY_SHARE * spec.world.duration_s.value)
        case _:
            return None


def _distances(
    trigger: DistanceTrigger, grounded: GroundedScenario, limits: Limits
) -> Between | None:
    """Return the distances that two bodies do not have at the start and can come to."""
    places = {a.id: (a.x_m, a.y_m) for a in grounded.agents}
    places |= {u.id: (u.home_x_m, u.home_y_m) for u in grounded.uavs}
    if trigger.a not in places or trigger.b not in places:
        return None
    a, b = places[trigger.a], places[trigger.b]
    start_m = norm2(b[0] - a[0], b[1] - a[1])
    if trigger.on == 'distance_above':
        return Between(start_m + _ROOM, trigger.value_m.high)
    return Between(_nearest_m(trigger, grounded, limits) + _ROOM, start_m - _ROOM)


def _nearest_m(trigger: DistanceTrigger, grounded: GroundedScenario, limits: Limits) -> float:
    """Return how near two bodies come at most, by what they are and how they fly."""
    pair = {trigger.a, trigger.b}
    lengths = [a.length_m for a in grounded.agents if a.id in pair]
    flights = [uav.missions for uav in grounded.uavs if uav.id in pair]
    if len(flights) == 2:
        return limits.separation_min_m
    if not flights:
        return sum(lengths) / 2.0
    return min(_away_m(plan, pair) for plan in flights[0])


def _away_m(plan: MissionPlan, pair: set[str]) -> float:
    """Return how far a UAV stays from a body in a mission: at least as far as it is high."""
    tracks = plan.mode is MissionMode.TRACK and plan.target in pair
    return norm2(plan.altitude_m, plan.standoff_m if tracks else 0.0)


def _altitudes(
    spec: ScenarioSpec, trigger: AltitudeTrigger, grounded: GroundedScenario
) -> Between | None:
    """Return the altitudes that a UAV passes."""
    heights = [m.altitude_m for u in grounded.uavs if u.id == trigger.uav for m in u.missions]
    heights += [
        e.action.altitude_m.value
        for e in spec.events
        if isinstance(e.action, UavAction)
        and e.action.uav == trigger.uav
        and e.action.altitude_m is not None
    ]
    return Between(_ROOM, max(heights) - _ROOM) if heights else None


def _speeds(trigger: SpeedTrigger, grounded: GroundedScenario) -> Between | None:
    """Return the speeds that a vehicle with a stated one passes on its way to it.

    A fall below a speed asks for a change by itself, and nothing says what it falls to.
    """
    agent = next((a for a in grounded.agents if a.id == trigger.who), None)
    if trigger.on != 'speed_above' or agent is None or agent.drive_speed_mps is None:
        return None
    return Between(agent.speed_mps + _ROOM, agent.drive_speed_mps - _ROOM)
