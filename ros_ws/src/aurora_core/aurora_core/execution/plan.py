# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a grounded graph to what an engine needs: loads, roster, world and executor."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace

from aurora_core.comm.link import LinkSettings, MessageLink, link_stream
from aurora_core.comm.reach import reach_of
from aurora_core.conditions.capabilities import undone_events
from aurora_core.errors import ExecutionError
from aurora_core.execution.fault_port import FaultPort, loss_with_faults
from aurora_core.execution.faults import Fault, in_order
from aurora_core.execution.map_parts import MapParts, map_parts
from aurora_core.execution.scenario_executor import ExecutionSetup, ScenarioExecutor
from aurora_core.execution.step_output import Stepper
from aurora_core.execution.triggers import BatteryRule
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.places import place_positions
from aurora_core.grounding.time_need import patience_s
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.measured_on import vtypes_path
from aurora_core.knowledge.settings import Settings
from aurora_core.knowledge.world import NamedPlace, Wind, WorldModel
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import UavPlan
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.outcomes.agsg import Agsg
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.outcomes.schedule import Schedule
from aurora_core.outcomes.triggers import as_realised
from aurora_core.ports.simulators import AirLoad, GroundAgentLoad, GroundLoad, UavHome
from aurora_core.quantities.actions import action_rules, climbed_mps
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.spec.flight_order import (
    awaits_climbs,
    awaits_reports,
    begun_by,
    ending_landings,
    lasts_until_event,
    left_by,
    patrols_until_told,
    returns_home,
)
from aurora_core.spec.parameter import Bound
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import APPROACH, LANDMARK
from aurora_core.spec.scenario import Event, Link, ScenarioSpec, SendMessage
from aurora_core.spec.vocabulary import Place
from aurora_core.trace.roster import Roster, RosterEntry

# Raised whenever the same states give other commands or records than before: what was recorded
# with another version cannot be recomputed here.
EXECUTOR_VERSION = 20

# Box of the multirotor in the roster (m): motor to motor with propellers, and its height.
UAV_SIZE_M = (0.7, 0.7, 0.3)


@dataclass(frozen=True, slots=True, kw_only=True)
class Execution:
    """Everything an engine needs to run a grounded scenario once.

    Attributes:
        stepper: The executor (behind its faults); stateful, for one run.
        horizon_s: Hard end.
    """

    stepper: Stepper
    ground_load: GroundLoad
    air_load: AirLoad
    roster: Roster
    world: WorldModel
    horizon_s: float


def build_execution(
    agsg: Agsg,
    map_model: MapModel,
    *,
    limits: Limits,
    tolerances: Tolerances,
    settings: Settings,
    seed: int,
    faults: tuple[Fault, ...] = (),
    parts: MapParts | None = None,
) -> Execution:
    """Build the execution of a grounded graph.

    Args:
        agsg: Grounded, with schedule and conditions.
        map_model: The map it was grounded on.
        limits: Limits in force.
        tolerances: Tolerances in force.
        settings: Execution settings.
        seed: Seed of the run.
        faults: Faults to inject.
        parts: Parts of that map, built here when not given.

    Raises:
        ExecutionError: The graph is not grounded, or on another map, or for another executor, or
            an event sends a message without a link.
    """
    grounded = agsg.grounding
    if grounded is None or agsg.schedule is None:
        raise ExecutionError('the graph is not grounded', hint='call ground_scenario first')
    if grounded.executor_version not in (0, EXECUTOR_VERSION):
        raise ExecutionError(
            f'grounded for version {grounded.executor_version} of the executor, this is '
            f'{EXECUTOR_VERSION}',
            hint='start every node of the graph from one installation',
        )
    if grounded.map_digest != map_model.digest:
        raise ExecutionError(
            f'grounded on map digest {grounded.map_digest[:12]}, loaded {map_model.digest[:12]}',
            hint='ground the scenario again on this map',
        )
    dt_s = settings.run.dt_s
    places = place_positions(agsg.spec, map_model, grounded)
    parts = map_parts(map_model) if parts is None else parts
    world = build_world(map_model, grounded, limits, places, agsg.texts.conditions, parts)
    roster = build_roster(grounded, dt_s)
    stepper = build_stepper(
        agsg.spec,
        grounded,
        agsg.schedule,
        roster,
        airspace=parts.airspace,
        geometry=WorldGeometry(world, parts.sight_line),
        tolerances=tolerances,
        settings=settings,
        seed=seed,
        faults=faults,
    )
    return Execution(
        stepper=stepper,
        ground_load=_ground_load(grounded, map_model, dt_s, seed),
        air_load=_air_load(grounded, map_model, dt_s, seed),
        roster=roster,
        world=world,
        horizon_s=agsg.schedule.horizon_s,
    )


def build_stepper(
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    schedule: Schedule,
    roster: Roster,
    *,
    airspace: Airspace,
    geometry: WorldGeometry,
    tolerances: Tolerances,
    settings: Settings,
    seed: int,
    faults: tuple[Fault, ...] = (),
) -> Stepper:
    """Build the executor of a grounded graph, behind its faults if there are any.

    It needs no map: a recording holds everything that this takes.

    Args:
        spec: The request.
        grounded: Its grounding.
        schedule: Its schedule.
        roster: Row order of the states, and their time step.
        airspace: What stands in the way of a flight.
        geometry: The world of the run, with the limits in force.
        tolerances: Tolerances in force.
        settings: Execution settings.
        seed: Seed of the run.
        faults: Faults to inject.

    Raises:
        ExecutionError: An event sends a message without a link, or a fault hits nobody.
    """
    _check_links(spec)
    spec = as_realised(spec, grounded)
    limits, dt_s = geometry.world.limits, roster.dt_s
    acting = in_order(faults)
    flight = FlightSettings(**settings.flight.model_dump())
    executor = ScenarioExecutor(
        ExecutionSetup(
            spec=spec,
            roster=roster,
            agents=grounded.agents,
            machines=tuple(
                MissionMachine(plan, _flown_by(spec, plan, flight), dt_s)
                for plan in plans_with_events(spec, grounded.uavs, undone_events(spec, grounded))
            ),
            links=tuple(_link(link, limits, dt_s, seed, acting) for link in spec.links),
            airspace=airspace.keeping_out(grounded.keep_out),
            geometry=geometry,
            landing_clearance_m=limits.clearance_min_m + 1.0,
            arrival_m=tolerances.arrival_m,
            crosswalk_m=tolerances.crosswalk_m,
            drive_m=tolerances.drive_distance_m,
            battery=BatteryRule(
                endurance_s=limits.uav_endurance_s, touchdown_m=tolerances.touchdown_height_m
            ),
            action_rules=action_rules(tolerances),
            driving=settings.run.driving,
            deceleration=tolerances.deceleration_mps2,
            horizon_ticks=round(schedule.horizon_s / dt_s),
            stated_horizon=schedule.stated_horizon,
            earliest_end_ticks=round(_earliest_end_s(spec, grounded, schedule, limits) / dt_s),
            settle_ticks=round(settings.run.settle_s / dt_s),
            sight_period_ticks=max(1, round(settings.run.sight_period_s / dt_s)),
        )
    )
    if not acting:
        return executor
    return FaultPort(executor, acting, roster, tuple(link.id for link in spec.links))


def _earliest_end_s(
    spec: ScenarioSpec, grounded: GroundedScenario, schedule: Schedule, limits: Limits
) -> float:
    """Return when a run with an inferred horizon may end once all is done."""
    if spec.missions:
        return limits.horizon_inferred_min_s
    if any(agent.stop_lane_id for agent in grounded.agents):
        return schedule.horizon_s  # who stops at a place has to get there
    return max(limits.horizon_inferred_min_s, schedule.horizon_s - patience_s(spec))


def plans_with_events(
    spec: ScenarioSpec, plans: Sequence[UavPlan], undone: Collection[str]
) -> tuple[UavPlan, ...]:
    """Return what the UAVs fly, with the missions that wait for an event or last until one.

    What waits for something that nobody carries out is flown in its turn: the run is incomplete.

    Args:
        spec: The request.
        plans: Of the UAVs, as grounded.
        undone: Ids of the events that nobody carries out.
    """

    def awaited(event: Event | None) -> bool:
        return event is not None and event.id not in undone

    telling = {u.id for u in plans if any(awaited(e) for e in awaits_reports(spec, u.id))}
    asked = {
        m.id: {
            'waits': awaited(begun_by(spec, m)),
            'until_event': (lasts_until_event(spec, m) and awaited(left_by(spec, m)))
            or (patrols_until_told(spec, m) and m.uav in telling),
        }
        for m in spec.missions
    }
    return tuple(
        u.model_copy(
            update={
                'missions': tuple(m.model_copy(update=asked[m.id]) for m in u.missions),
                'lands_after': tuple(
                    e.id
                    for e in (
                        *awaits_climbs(spec, u.id),
                        *ending_landings(spec, u.id),
                        *awaits_reports(spec, u.id),
                    )
                    if awaited(e)
                ),
                'returns': any(awaited(e) for e in returns_home(spec, u.id)),
            }
        )
        for u in plans
    )


def _check_links(spec: ScenarioSpec) -> None:
    pairs = {(link.sender, link.receiver) for link in spec.links}
    for event in spec.events:
        action = event.action
        if isinstance(action, SendMessage) and (action.sender, action.receiver) not in pairs:
            raise ExecutionError(
                f'event {event.id} sends a message from {action.sender} to {action.receiver}, '
                'but there is no link between them',
                hint='give the specification a link for it',
            )


def build_world(
    map_model: MapModel,
    grounded: GroundedScenario,
    limits: Limits,
    places: Mapping[str, tuple[float, float]],
    conditions_json: str,
    parts: MapParts,
) -> WorldModel:
    """Return the world of a run, self-contained, from the map and the scenario's weather."""
    return WorldModel(
        map_name=map_model.name,
        map_digest=map_model.digest,
        origin_lat_deg=map_model.origin_lat_deg,
        origin_lon_deg=map_model.origin_lon_deg,
        weather=grounded.weather,
        time_of_day=grounded.time_of_day,
        wind=wind_of(grounded),
        buildings=map_model.buildings,
        no_fly_zones=map_model.zones,
        surfaces=parts.surfaces + (parts.sidewalks if Place.SIDEWALK in places else ()),
        lanes=parts.lanes,
        signals=parts.signals,
        places=_named_places(parts, places),
        limits=limits,
        conditions_json=conditions_json,
    )


def wind_of(grounded: GroundedScenario) -> Wind:
    """Return the wind that a scenario was grounded with."""
    return Wind(
        mean_east_mps=grounded.wind_mean_east_mps,
        mean_north_mps=grounded.wind_mean_north_mps,
        gust_mps=grounded.wind_gust_mps,
    )


def _named_places(
    parts: MapParts, resolved: Mapping[str, tuple[float, float]]
) -> tuple[NamedPlace, ...]:
    # A landmark is where the map has it, whatever else is resolved.
    named = {f'{APPROACH}{n.removeprefix(LANDMARK)}' for n in resolved} | set(resolved)
    grounds = {n: point for n, point in parts.grounds.items() if n in named}
    points = dict(resolved) | parts.landmarks | grounds
    return tuple(NamedPlace(name=n, x_m=x, y_m=y) for n, (x, y) in sorted(points.items()))


def build_roster(grounded: GroundedScenario, dt_s: float) -> Roster:
    """Return the bodies of a grounded scenario in row order."""
    agents = tuple(
        RosterEntry(
            body_id=a.id,
            type_name=a.type_name,
            is_person=a.is_person,
            system_id=0,
            length_m=a.length_m,
            width_m=a.width_m,
            height_m=a.height_m,
            route_edges=a.edges,
            route_xy_m=a.route_xy_m,
            role=a.role,
        )
        for a in grounded.agents
    )
    uavs = tuple(
        RosterEntry(
            body_id=u.id,
            type_name='uav',
            is_person=False,
            system_id=u.system_id,
            length_m=UAV_SIZE_M[0],
            width_m=UAV_SIZE_M[1],
            height_m=UAV_SIZE_M[2],
        )
        for u in grounded.uavs
    )
    return Roster(dt_s=dt_s, agents=agents, uavs=uavs)


def _ground_load(
    grounded: GroundedScenario, map_model: MapModel, dt_s: float, seed: int
) -> GroundLoad:
    return GroundLoad(
        map_name=map_model.name,
        net_path=map_model.net_path,
        vtypes_path=vtypes_path(),
        map_digest=map_model.digest,
        dt_s=dt_s,
        seed=seed,
        agents=tuple(_agent_load(a) for a in grounded.agents),
        weather=grounded.weather,
    )


def _agent_load(agent: GroundedAgent) -> GroundAgentLoad:
    return GroundAgentLoad(
        agent_id=agent.id,
        type_name=agent.type_name,
        is_person=agent.is_person,
        edges=agent.edges,
        lane_id=agent.lane_id,
        lane_position_m=agent.lane_position_m,
        speed_mps=agent.speed_mps,
        arrival_position_m=agent.arrival_position_m,
        speed_factor=agent.speed_factor,
        time_gap_s=agent.time_gap_s,
        min_gap_m=agent.min_gap_m,
        lane_change_mode=agent.lane_change_mode,
        parked=agent.parked,
        acceleration_mps2=agent.gentle_mps2,
        runs_red=agent.runs_red,
        lateral_m=agent.lateral_m,
        way_xy_m=agent.way_xy_m,
    )


def _air_load(grounded: GroundedScenario, map_model: MapModel, dt_s: float, seed: int) -> AirLoad:
    return AirLoad(
        dt_s=dt_s,
        seed=seed,
        homes=tuple(
            UavHome(
                uav_id=u.id,
                system_id=u.system_id,
                x_m=u.home_x_m,
                y_m=u.home_y_m,
                yaw_enu_rad=u.home_yaw_enu_rad,
            )
            for u in grounded.uavs
        ),
        origin_lat_deg=map_model.origin_lat_deg,
        origin_lon_deg=map_model.origin_lon_deg,
        wind_mean_east_mps=grounded.wind_mean_east_mps,
        wind_mean_north_mps=grounded.wind_mean_north_mps,
        wind_gust_mps=grounded.wind_gust_mps,
    )


def _flown_by(spec: ScenarioSpec, plan: UavPlan, flight: FlightSettings) -> FlightSettings:
    """Return the limits of the reference motion of one UAV."""
    most = [
        climbed_mps(c.value.model_copy(update={'bound': Bound.AT_MOST}))
        for c in spec.conditions
        if c.quantity == QuantityName.VERTICAL_SPEED and plan.id in c.of and c.op in ('<', '<=')
    ]
    flight = replace(
        flight,
        climb_mps=min([flight.climb_mps, *most]),
        descent_mps=min([flight.descent_mps, *most]),
    )
    if plan.speed_max_mps is None:
        return flight
    return replace(flight, speed_max_mps=plan.speed_max_mps)


def _link(
    link: Link, limits: Limits, dt_s: float, seed: int, faults: tuple[Fault, ...]
) -> MessageLink:
    return MessageLink(
        LinkSettings(
            link_id=link.id,
            sender=link.sender,
            receiver=link.receiver,
            loss=link.loss.value,
            latency_s=link.latency_s.value,
            retransmissions=round(link.retransmissions.value),
            interval_s=link.retransmission_interval_s.value,
            reach=reach_of(link, limits),
            outage_s=link.outage,
            rate_hz=None if link.rate_hz is None else link.rate_hz.value,
        ),
        dt_s,
        link_stream(seed, link.id),
        loss_with_faults(link.id, link.loss.value, faults, dt_s),
    )
