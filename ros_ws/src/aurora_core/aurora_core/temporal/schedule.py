# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Plan the time of a grounded scenario: horizon, times, and the facts that conditions quote."""

from __future__ import annotations

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.time_need import horizon_s
from aurora_core.knowledge.limits import Limits, Tolerances, climb_share_mps, descent_share_mps
from aurora_core.knowledge.settings import FlightDefaults
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import GroundedScenario
from aurora_core.outcomes.schedule import AgentFacts, MissionFacts, PlanFacts, Schedule
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.temporal.links import Basis
from aurora_core.temporal.times import planned_times

# Mean rate of a climb over the rate that it is flown at, with its beginning and its end.
_RATE_SHARE = 0.75


def plan_time(
    spec: ScenarioSpec, grounded: GroundedScenario, limits: Limits, tolerances: Tolerances
) -> Schedule:
    """Return the schedule of a grounded scenario."""
    basis = grounded.basis
    flight = None if basis is None else basis.tables().settings.flight
    horizon = horizon_s(spec, limits, flight)
    missions = tuple(
        _facts(uav, mission, k, grounded)
        for uav in grounded.uavs
        for k, mission in enumerate(uav.missions)
    )
    order = {m.id: k for k, m in enumerate(spec.missions)}
    agents = tuple(
        AgentFacts(
            agent=agent.id,
            acceleration_mps2=agent.acceleration_mps2,
            deceleration_mps2=agent.deceleration_mps2,
        )
        for agent in grounded.agents
    )
    facts = PlanFacts(
        horizon_s=horizon,
        missions=tuple(sorted(missions, key=lambda f: order[f.mission])),
        agents=agents,
        **({} if flight is None else _slow_rates(flight, limits)),
    )
    plan = {facts.mission: facts for facts in missions}
    times, conflict = planned_times(
        Basis(spec=spec, limits=limits, tolerances=tolerances, plan=plan), horizon
    )
    return Schedule(
        horizon_s=horizon,
        stated_horizon=spec.world.duration_s is not None,
        facts=facts,
        times=times,
        conflict=conflict,
    )


def _slow_rates(flight: FlightDefaults, limits: Limits) -> dict[str, float]:
    """Return the mean rates of climbs and descents that are below what limits let expect."""
    rates = {
        'climb_mps': (_RATE_SHARE * flight.climb_mps, climb_share_mps(limits)),
        'descent_mps': (_RATE_SHARE * flight.descent_mps, descent_share_mps(limits)),
    }
    return {name: flown for name, (flown, usual) in rates.items() if flown < usual}


def _facts(
    uav: UavPlan, mission: MissionPlan, index: int, grounded: GroundedScenario
) -> MissionFacts:
    before = [m for m in uav.missions[:index] if m.is_placed]
    start = _end(before[-1], grounded) if before else (uav.home_x_m, uav.home_y_m)
    first = _first(mission, grounded) if mission.is_placed else start
    return MissionFacts(
        mission=mission.id,
        uav=uav.id,
        mode=mission.mode,
        altitude_m=mission.altitude_m,
        standoff_m=mission.standoff_m if mission.mode is MissionMode.TRACK else None,
        waypoints=mission.waypoints,
        hover_point=mission.hover_point,
        duration_s=mission.duration_s,
        transit_m=norm2(first[0] - start[0], first[1] - start[1]),
        transit_speed_mps=mission.speed_mps,
    )


def _first(mission: MissionPlan, grounded: GroundedScenario) -> tuple[float, float]:
    if mission.waypoints:
        return mission.waypoints[0][0], mission.waypoints[0][1]
    if mission.hover_point is not None:
        return mission.hover_point[0], mission.hover_point[1]
    for agent in grounded.agents:
        if agent.id == mission.target:
            x_m, y_m = mission.offset_from((agent.heading_x, agent.heading_y))
            return agent.x_m + x_m, agent.y_m + y_m
    return 0.0, 0.0


def _end(mission: MissionPlan, grounded: GroundedScenario) -> tuple[float, float]:
    if mission.waypoints:
        return mission.waypoints[-1][0], mission.waypoints[-1][1]
    return _first(mission, grounded)
