# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A mission as its conditions measure it: from the request and the plan."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.errors import VerificationError
from aurora_core.judging.build import Inputs
from aurora_core.knowledge.limits import (
    climb_share_mps,
    descent_share_mps,
    hover_capture_m,
    rest_mps,
)
from aurora_core.outcomes.condition import ClimbArguments, MissionArguments, RestArguments
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.quantities.actions import least_climb_mps
from aurora_core.spec.flight_order import (
    climbs_last,
    cut_by,
    keeps_altitude,
    stays_where_it_is,
)
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.scenario import ScenarioSpec, UavAction, UavMission
from aurora_core.spec.vocabulary import MissionMode


def mission_arguments(inputs: Inputs, mission: UavMission) -> MissionArguments:
    """Return a mission as it is measured.

    Raises:
        VerificationError: The plan has no facts of the mission, or facts that do not fit it.
    """
    facts = inputs.mission_facts(mission.id)
    if facts is None:
        raise VerificationError(f'the plan has no facts of mission {mission.id}')
    own = [m for m in inputs.spec.missions if m.uav == mission.uav]
    first_facts = inputs.mission_facts(own[0].id)
    if first_facts is None:
        raise VerificationError(f'the plan has no facts of mission {own[0].id}')
    tolerances = inputs.tolerances
    altitude = _explicit_or(mission.altitude_m, facts.altitude_m)
    altitude_slack = _slack(mission.altitude_m, altitude, inputs)
    standoff = _explicit_or(mission.standoff_m, facts.standoff_m or 0.0)
    standoff_slack = inputs.limits.tracking_horizontal_m
    if mission.standoff_m is not None and mission.standoff_m.provenance is Provenance.EXPLICIT:
        standoff_slack = tolerances.standoff_m.of(
            standoff, approximate=mission.standoff_m.approximate
        )
    first_altitude = _explicit_or(own[0].altitude_m, first_facts.altitude_m)
    point = _first_point(inputs.spec, mission, facts)
    ends = cut_by(inputs.spec, mission)
    track = mission.mode is MissionMode.TRACK
    hover = mission.mode is MissionMode.HOVER
    horizontal = (
        hover_capture_m(inputs.spec, mission.uav, inputs.limits, tolerances)
        if hover
        else tolerances.waypoint_horizontal_m
    )
    return MissionArguments(
        mission=mission.id,
        uav=mission.uav,
        index=own.index(mission),
        mode=mission.mode,
        target=mission.target,
        altitude_m=altitude,
        altitude_bound=mission.altitude_m.bound,
        altitude_tolerance_m=altitude_slack,
        capture_altitude_m=inputs.limits.tracking_altitude_m if track else altitude_slack,
        capture_horizontal_m=horizontal,
        point_m=point,
        standoff_m=standoff,
        standoff_bound=Bound.EXACTLY if mission.standoff_m is None else mission.standoff_m.bound,
        standoff_tolerance_m=standoff_slack,
        tracking_altitude_m=inputs.limits.tracking_altitude_m,
        first_altitude_m=first_altitude,
        first_altitude_tolerance_m=_slack(own[0].altitude_m, first_altitude, inputs),
        planned_s=facts.duration_s,
        waypoints=facts.waypoints,
        waypoint_horizontal_m=tolerances.waypoint_horizontal_m,
        left_by=None if ends is None else ends.id,
        climbs=tuple(_climbs(inputs, mission, altitude)),
        rest=_rest(inputs) if stays_where_it_is(inputs.spec, mission) else None,
        level_from=_level_from(inputs.spec, own, mission),
    )


def _rest(inputs: Inputs) -> RestArguments:
    tolerances = inputs.tolerances
    return RestArguments(
        speed_mps=rest_mps(inputs.spec.world, inputs.limits, tolerances),
        braking_mps2=tolerances.route_acceleration_mps2,
        off_m=tolerances.phase_follow_m,
    )


def _level_from(spec: ScenarioSpec, own: list[UavMission], mission: UavMission) -> int | None:
    """Return which mission of a UAV has given the altitude that another one keeps."""
    if not keeps_altitude(spec, mission):
        return None
    before = own[: own.index(mission)]
    return max(k for k, m in enumerate(before) if not keeps_altitude(spec, m))


def changes_height(inputs: Inputs, mission: MissionArguments) -> bool:
    """Tell whether a UAV may come to a later mission from another height."""
    if mission.level_from is not None:
        return False
    own = [m.id for m in inputs.spec.missions if m.uav == mission.uav]
    facts = (inputs.mission_facts(name) for name in own[: mission.index])
    heights_m = [f.altitude_m for f in facts if f is not None]
    heights_m += [climb.altitude_m for climb in mission.climbs]
    return any(abs(z - mission.altitude_m) > mission.altitude_tolerance_m for z in heights_m)


def climb_mps(inputs: Inputs) -> float:
    """Return how fast a UAV climbs at least on average when an event asks for it, in m/s."""
    measured = inputs.facts.climb_mps
    return climb_share_mps(inputs.limits) if measured is None else measured


def descent_mps(inputs: Inputs) -> float:
    """Return how fast a UAV sinks at least on average when an event asks for it, in m/s."""
    measured = inputs.facts.descent_mps
    return descent_share_mps(inputs.limits) if measured is None else measured


def _climbs(inputs: Inputs, mission: UavMission, from_m: float) -> Iterator[ClimbArguments]:
    """Yield the climbs that an event may ask for while a mission is flown."""
    for event in inputs.spec.events:
        action = event.action
        if not isinstance(action, UavAction) or action.altitude_m is None:
            continue
        if action.uav == mission.uav and not climbs_last(event):
            rise_m = action.altitude_m.value - from_m
            rates = climb_mps(inputs), descent_mps(inputs)
            if action.vertical_mps is not None:
                least = least_climb_mps(action.vertical_mps, inputs.tolerances.vertical_mps)
                rates = min(rates[0], least), min(rates[1], least)
            way_s = max(rise_m / rates[0], -rise_m / rates[1])
            within_s = way_s + inputs.tolerances.action_done_s
            yield ClimbArguments(
                event=event.id, altitude_m=action.altitude_m.value, within_s=within_s
            )


def _explicit_or(parameter: Parameter | None, realised: float) -> float:
    explicit = parameter is not None and parameter.provenance is Provenance.EXPLICIT
    # A one-sided number is a limit, not the value that was chosen inside it.
    if parameter is not None and explicit and parameter.bound is Bound.EXACTLY:
        return parameter.value
    return realised


def _slack(parameter: Parameter, value: float, inputs: Inputs) -> float:
    return inputs.tolerances.altitude_m.of(value, approximate=parameter.approximate)


def _first_point(
    spec: ScenarioSpec, mission: UavMission, facts: MissionFacts
) -> tuple[float, float] | None:
    if mission.mode is MissionMode.HOVER:
        if facts.hover_point is None:
            if stays_where_it_is(spec, mission):
                return None
            raise VerificationError(f'the plan has no hover point for mission {mission.id}')
        return facts.hover_point[0], facts.hover_point[1]
    if mission.mode is MissionMode.NAVIGATE:
        if not facts.waypoints:
            raise VerificationError(f'the plan has no waypoints for mission {mission.id}')
        return facts.waypoints[0][0], facts.waypoints[0][1]
    return None


def missions_of_uav(inputs: Inputs, uav: str) -> tuple[MissionArguments, ...]:
    """Return all missions of a UAV as they are measured."""
    return tuple(
        mission_arguments(inputs, mission)
        for mission in inputs.spec.missions
        if mission.uav == uav
    )
