# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Defaults that hurry: a flight with a deadline is lower and shorter where that is left open.

"Tracks the bus and has landed by 70 s" says neither how high nor for how long; "at 5 s it sends
a message" not how high it is by then.
"""

from __future__ import annotations

from itertools import pairwise
from math import inf, pi

from aurora_core.grounding.pace import stated_times_s
from aurora_core.knowledge.limits import Limits, ascent_s
from aurora_core.spec.events import reports_own_altitude
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, SendMessage, UavMission
from aurora_core.spec.vocabulary import MissionMode, Pattern

# Share of the greatest rates at which a UAV is counted on to climb and to sink.
_RATE_SHARE = 0.8
# To its first mission and to the landing spot, and to every further mission (s).
_AROUND_S = 20.0
_BETWEEN_S = 10.0
# From its ascent to the capture of what it tracks, where its start is beside the street (s).
_CAPTURES_S = 4.0
# What is left of open altitudes (m) and durations (s); between houses one is no lower.
_LEAST_M = 15.0
_LEAST_S = 10.0


def hurried(spec: ScenarioSpec, limits: Limits) -> ScenarioSpec:
    """Return the specification with default altitudes and durations that fit into its deadlines.

    Altitudes come first, durations only where that is not enough; where all fits both stay.

    Args:
        spec: The request; it is not changed.
        limits: Limits in force.
    """
    changed: dict[str, UavMission] = {}
    for uav in spec.uavs:
        own = [m for m in spec.missions if m.uav == uav.id]
        early = _up_in_time(own, _sends_at_s(spec, uav.id), limits)
        if early != own:
            own = early
            changed |= {m.id: m for m in own}
        late_s = _needed_s(own, limits) - _deadline_s(spec, uav.id)
        if own and late_s > 0.0:
            own = _lower(own, late_s, limits)
            own = _shorter(own, _needed_s(own, limits) - _deadline_s(spec, uav.id))
            changed |= {m.id: m for m in own}
    if not changed:
        return spec
    missions = tuple(changed.get(m.id, m) for m in spec.missions)
    return ScenarioSpec.model_validate({**dict(spec), 'missions': missions})


def _deadline_s(spec: ScenarioSpec, uav: str) -> float:
    """Return when a UAV has to be down, or done, at the latest (s)."""
    ends = (QuantityName.LANDED, QuantityName.MISSION_COMPLETED)
    return min(
        (
            one.by_s.value
            for one in spec.conditions
            if one.by_s is not None and one.quantity in ends and one.of == (uav,)
        ),
        default=inf,
    )


def _sends_at_s(spec: ScenarioSpec, uav: str) -> float:
    """Return the first stated time at which a UAV sends a message (s)."""
    times_s = stated_times_s(spec)
    return min(
        (
            times_s[event.id] + event.waits_s
            for event in spec.events
            if event.id in times_s
            and isinstance(event.action, SendMessage)
            and event.action.sender == uav
            and not reports_own_altitude(event)
        ),
        default=inf,
    )


def _up_in_time(own: list[UavMission], due_s: float, limits: Limits) -> list[UavMission]:
    """Return missions of which the first one is low enough to have begun by then."""
    if own and own[0].mode is MissionMode.TRACK:
        due_s -= _CAPTURES_S
    late_s = ascent_s(own[0].altitude_m.value, limits) - due_s if own else 0.0
    if late_s <= 0.0:
        return own
    per_m = ascent_s(1.0, limits) - ascent_s(0.0, limits)
    lower = _less(own[0].altitude_m, late_s / per_m, _LEAST_M)
    return [own[0].model_copy(update={'altitude_m': lower}), *own[1:]]


def _needed_s(own: list[UavMission], limits: Limits) -> float:
    """Return how long a flight takes from t = 0 to its landing, about (s)."""
    if not own:
        return 0.0
    climb_mps = _RATE_SHARE * limits.uav_climb_max_mps
    sink_mps = _RATE_SHARE * limits.uav_descent_max_mps
    heights = [m.altitude_m.value for m in own]
    found = heights[0] / climb_mps + heights[-1] / sink_mps
    found += sum(max((b - a) / climb_mps, (a - b) / sink_mps) for a, b in pairwise(heights))
    return found + _AROUND_S + _BETWEEN_S * (len(own) - 1) + sum(map(_phase_s, own))


def _phase_s(mission: UavMission) -> float:
    """Return how long a mission lasts: as long as is said, or as its route takes (s)."""
    route_s = 0.0
    if mission.speed_mps is not None and mission.speed_mps.value > 0.0:
        sides = [side.value for side in mission.size_m or ()]
        way_m = {
            Pattern.RECTANGLE: 2.0 * sum(sides),
            Pattern.LINE: sum(sides[:1]),
            Pattern.ORBIT: 0.0 if mission.radius_m is None else 2.0 * pi * mission.radius_m.value,
        }.get(mission.pattern or Pattern.WAYPOINTS, 0.0)
        route_s = way_m / mission.speed_mps.value
    return max(route_s, 0.0 if mission.duration_s is None else mission.duration_s.value)


def _lower(own: list[UavMission], late_s: float, limits: Limits) -> list[UavMission]:
    """Return missions of which the open altitudes are lower by what there is to save (s)."""
    per_m = (1.0 / limits.uav_climb_max_mps + 1.0 / limits.uav_descent_max_mps) / _RATE_SHARE
    return [
        m.model_copy(update={'altitude_m': _less(m.altitude_m, late_s / per_m, _LEAST_M)})
        for m in own
    ]


def _shorter(own: list[UavMission], late_s: float) -> list[UavMission]:
    """Return missions of which the open durations are shorter by what is still too much (s)."""
    found = []
    for mission in own:
        duration = mission.duration_s
        if late_s > 0.0 and duration is not None:
            less = _less(duration, late_s, _LEAST_S)
            late_s -= duration.value - less.value
            mission = mission.model_copy(update={'duration_s': less})
        found.append(mission)
    return found


def _less(parameter: Parameter, by: float, least: float) -> Parameter:
    """Return a default that is less by so much, in its domain and not below `least`."""
    if parameter.provenance is not Provenance.DEFAULT:
        return parameter
    floor = min(parameter.value, max(least, parameter.low))
    return parameter.model_copy(update={'value': max(floor, parameter.value - by)})
