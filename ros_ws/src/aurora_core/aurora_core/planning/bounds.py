# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Defaults that bend: what nobody states moves inside the bounds that a request does state.

"Keeps below 25 m" says nothing of the altitude of a mission, and everything about it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import inf, sqrt

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.apart import ring_m
from aurora_core.knowledge.limits import Limits
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import (
    AltitudeTrigger,
    GroundAgent,
    ScenarioSpec,
    UavAction,
    UavMission,
)
from aurora_core.spec.vocabulary import MissionMode, Relation

# Room between a default and a bound, for wind and for the lag behind a moving target (m).
_ALTITUDE_ROOM_M = 2.5
_STANDOFF_ROOM_M = 8.0
# And between two on the ground.
_GAP_ROOM_M = 2.0
# The same for a speed, for gusts and corners (m/s).
_SPEED_ROOM_MPS = 1.0
# Who is on a side of a target is so far from it, and no nearer than that (m).
_SIDE_M = 20.0
_SIDE_LEAST_M = 10.0
# Who is to be seen for a time is looked at for so many times that.
_SEEN_AT_TIMES = 3.0
# Who is in a row without more begins so far from the next one, middle to middle (m).
_ROW_M = 30.0
_IN_LINE = (Relation.AHEAD, Relation.BEHIND)
# A trigger has to be passed, not touched (m).
_PAST_M = 1.0
# Share of a greatest distance in space that is altitude where both are free.
_HEIGHT_SHARE = 0.7

_IN_THE_PLANE = (QuantityName.HORIZONTAL_DISTANCE,)
_IN_SPACE = (QuantityName.DISTANCE, QuantityName.SEPARATION)


@dataclass(frozen=True, slots=True)
class Range:
    """Where a number may lie (m)."""

    low: float = -inf
    high: float = inf

    def near(self, value: float, room: float) -> float:
        """Return the number nearest to `value` that is inside by `room`, or the middle."""
        low, high = self.low + room, self.high - room
        return (self.low + self.high) / 2.0 if low > high else min(max(value, low), high)


def bent(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with default altitudes, standoffs, speeds and gaps in its bounds.

    Args:
        spec: The request; it is not changed.
        limits: Limits in force.
    """
    missions = tuple(
        _lasting(spec, _at_speed(spec, _standing_off(spec, _at_altitude(spec, m, limits), limits)))
        for m in spec.missions
    )
    agents = tuple(_placed(spec, agent) for agent in spec.agents)
    if (missions, agents) == (spec.missions, spec.agents):
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'missions': missions, 'agents': agents})


def _placed(spec: ScenarioSpec, agent: GroundAgent) -> GroundAgent:
    """Return an agent that starts as near to others as it is to stay.

    Several that it is behind without more, to overtake them, stand one before the other.
    """
    related = {p.of for a in spec.agents for p in a.placements if a.id != agent.id}
    related |= {a.id for a in spec.agents if a.placements}
    placements = []
    row_m: dict[Relation, float] = {}
    for placed in agent.placements:
        gap = placed.distance_m
        if gap is not None and gap.provenance is Provenance.DEFAULT and placed.of is not None:
            bounds = stated_range(spec, (*_IN_THE_PLANE, *_IN_SPACE), {agent.id, placed.of})
            begin_m = gap.value
            if placed.relation in _IN_LINE and placed.of not in related:
                begin_m = max(begin_m, row_m.get(placed.relation, -inf) + _ROW_M)
                row_m[placed.relation] = begin_m
            value = min(max(bounds.near(begin_m, _GAP_ROOM_M), gap.low), gap.high)
            placed = placed.model_copy(update={'distance_m': _moved(gap, value, bounds)})
        placements.append(placed)
    return agent.model_copy(update={'placements': tuple(placements)})


def _at_altitude(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> UavMission:
    altitude = mission.altitude_m
    if altitude.provenance is not Provenance.DEFAULT:
        return mission
    bounds = stated_range(spec, (QuantityName.ALTITUDE,), {mission.uav})
    value = max(bounds.near(altitude.value, _ALTITUDE_ROOM_M), _passed_m(spec, mission))
    if mission.mode is MissionMode.TRACK and mission.target is not None:
        reach_m = stated_range(spec, _IN_SPACE, {mission.uav, mission.target}).high
        if value > reach_m - _STANDOFF_ROOM_M:
            value = max(_HEIGHT_SHARE * reach_m, min(value, bounds.low + _ALTITUDE_ROOM_M))
    value = min(max(value, limits.uav_altitude_min_m), limits.uav_altitude_max_m)
    return mission.model_copy(update={'altitude_m': _moved(altitude, value, bounds)})


def _passed_m(spec: ScenarioSpec, mission: UavMission) -> float:
    """Return the altitude that a UAV has to pass in its first mission for an event to happen."""
    own = [m for m in spec.missions if m.uav == mission.uav]
    climbs = any(
        isinstance(e.action, UavAction)
        and e.action.uav == mission.uav
        and e.action.altitude_m is not None
        for e in spec.events
    )
    if mission.id != own[0].id or climbs:
        return -inf
    triggers = (e.trigger for e in spec.events if isinstance(e.trigger, AltitudeTrigger))
    asked = [t.value_m.value for t in triggers if t.uav == mission.uav]
    reached = [m.altitude_m.value for m in own if m.altitude_m.provenance is Provenance.EXPLICIT]
    return max((z + _PAST_M for z in asked if z > max(reached, default=0.0)), default=-inf)


def _standing_off(spec: ScenarioSpec, mission: UavMission, limits: Limits) -> UavMission:
    standoff = mission.standoff_m
    if (
        mission.mode is not MissionMode.TRACK
        or mission.target is None
        or standoff is None
        or standoff.provenance is not Provenance.DEFAULT
    ):
        return mission
    if mission.side is not None:
        high = max(standoff.high, _SIDE_M)
        beside = {'value': _SIDE_M, 'low': _SIDE_LEAST_M, 'high': high}
        standoff = standoff.model_copy(update=beside)
    pair = {mission.uav, mission.target}
    bounds = stated_range(spec, _IN_THE_PLANE, pair)
    value = bounds.near(standoff.value, _STANDOFF_ROOM_M)
    in_space = stated_range(spec, _IN_SPACE, pair)
    height_m = mission.altitude_m.value
    away_m = in_space.near(norm2(value, height_m), _STANDOFF_ROOM_M)
    if away_m > norm2(value, height_m):
        value = sqrt(away_m * away_m - height_m * height_m)
    value = min(max(value, ring_m(spec, mission, limits), standoff.low), standoff.high)
    return mission.model_copy(update={'standoff_m': _moved(standoff, value, bounds)})


def _at_speed(spec: ScenarioSpec, mission: UavMission) -> UavMission:
    speed = mission.speed_mps
    if speed is None or speed.provenance is not Provenance.DEFAULT:
        return mission
    bounds = stated_range(spec, (QuantityName.SPEED,), {mission.uav})
    value = min(max(bounds.near(speed.value, _SPEED_ROOM_MPS), speed.low), speed.high)
    return mission.model_copy(update={'speed_mps': _moved(speed, value, bounds)})


def _lasting(spec: ScenarioSpec, mission: UavMission) -> UavMission:
    """Return a mission that goes on long enough for somebody to be seen for a stated time."""
    duration = mission.duration_s
    if duration is None or duration.provenance is not Provenance.DEFAULT:
        return mission
    seen_s = [
        one.value.value
        for one in spec.conditions
        if one.quantity == QuantityName.VISIBLE_TIME
        and one.op in ('>=', '>')
        and one.of[:1] == (mission.uav,)
    ]
    need_s = _SEEN_AT_TIMES * max(seen_s, default=0.0)
    if need_s <= duration.value:
        return mission
    value = min(need_s, max(duration.value, duration.high))
    return mission.model_copy(update={'duration_s': duration.model_copy(update={'value': value})})


def stated_range(spec: ScenarioSpec, quantities: Iterable[str], of: set[str]) -> Range:
    """Return the range that the conditions of a request leave to a quantity of some bodies."""
    low, high = -inf, inf
    for one in spec.conditions:
        if one.quantity not in quantities or set(one.of) != of:
            continue
        if one.op in ('>=', '>', '=='):
            low = max(low, one.value.value)
        if one.op in ('<=', '<', '=='):
            high = min(high, one.value.value)
    return Range(low, high)


def _moved(parameter: Parameter, value: float, bounds: Range) -> Parameter:
    """Return a parameter with another value, and with the part of its domain inside bounds."""
    low = min(value, max(parameter.low, bounds.low))
    high = max(value, min(parameter.high, bounds.high))
    return parameter.model_copy(update={'value': value, 'low': low, 'high': high})
