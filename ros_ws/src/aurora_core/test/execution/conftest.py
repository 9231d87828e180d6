# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A stage on which tests put agents and UAVs by hand and step the executor."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pytest
from flown_missions import DT_S
from flown_missions import SETTINGS as FLIGHT

from aurora_core.comm.link import LinkSettings, MessageLink
from aurora_core.comm.reach import Reach
from aurora_core.execution.fault_port import FaultPort, loss_with_faults
from aurora_core.execution.faults import Fault
from aurora_core.execution.plan import plans_with_events
from aurora_core.execution.scenario_executor import ExecutionSetup, ScenarioExecutor
from aurora_core.execution.step_output import StepOutput
from aurora_core.execution.triggers import BatteryRule
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import load_limits, load_tolerances
from aurora_core.knowledge.map_types import Building
from aurora_core.knowledge.settings import DrivingStyle, load_settings
from aurora_core.knowledge.world import (
    CentreLine,
    NamedPlace,
    Surface,
    SurfaceKind,
    Wind,
    WorldModel,
)
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.ports.random_streams import stream
from aurora_core.quantities.actions import action_rules
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.prohibitions import Prohibition
from aurora_core.spec.scenario import (
    Behavior,
    Event,
    GroundAgent,
    Link,
    Order,
    Placement,
    ScenarioSpec,
    StatedCondition,
    Uav,
    UavMission,
)
from aurora_core.spec.vocabulary import AgentType, MissionMode
from aurora_core.trace.layout import GROUND_WIDTH, UAV_WIDTH, GroundColumn, UavColumn, UavMode
from aurora_core.trace.records import ScenarioEventKind
from aurora_core.trace.roster import Roster, RosterEntry


@dataclass
class Stage:
    """An executor whose world is set by hand.

    Attributes:
        agents: Ids of the ground agents; all are cars.
        absent: Ids of agents that the request names and that nobody placed.
        releases: When each may start, as (release, UAV); START where not given.
        parted: Who waits until whom is how far away (m).
        waits_s: Who waits for how long.
        halts: Where persons wait who have walked there to cross; all of them are persons then.
        stops_s: How long who halts stands there.
        tops_mps: How fast each is at most by itself.
        tracks: UAV id -> target of its one mission, '' = no mission at all.
        links: UAV or agent pairs with a link.
        hold_s: Length of the track missions.
        hold_said: The request states that length.
        street_x_m: A carriageway from south to north lies between these.
        sidewalks_x_m: So do sidewalks.
    """

    make: Callable[..., Parameter]
    agents: tuple[str, ...] = ('van1', 'ego')
    behaviors: dict[str, tuple[Behavior, ...]] = field(default_factory=dict)
    placements: dict[str, tuple[Placement, ...]] = field(default_factory=dict)
    absent: tuple[str, ...] = ()
    releases: dict[str, tuple[ReleaseOn, str]] = field(default_factory=dict)
    parted: dict[str, tuple[str, float]] = field(default_factory=dict)
    waits_s: dict[str, float] = field(default_factory=dict)
    halts: dict[str, tuple[float, float]] = field(default_factory=dict)
    stops_s: dict[str, float] = field(default_factory=dict)
    speeds: dict[str, float] = field(default_factory=dict)
    tops_mps: dict[str, float] = field(default_factory=dict)
    tracks: dict[str, str] = field(default_factory=lambda: {'uav1': 'van1'})
    links: tuple[tuple[str, str], ...] = ()
    events: tuple[Event, ...] = ()
    orders: tuple[Order, ...] = ()
    prohibitions: tuple[Prohibition, ...] = ()
    conditions: tuple[StatedCondition, ...] = ()
    buildings: tuple[Building, ...] = ()
    lanes: tuple[CentreLine, ...] = ()
    street_x_m: tuple[float, float] | None = None
    sidewalks_x_m: tuple[tuple[float, float], ...] = ()
    landing_spots: tuple[tuple[float, float], ...] = ((0.0, 0.0),)
    faults: tuple[Fault, ...] = ()
    loss: float = 0.0
    hold_s: float = 600.0
    hold_said: bool = True
    horizon_ticks: int = 4000
    drive_m: float = 20.0
    driving: DrivingStyle = field(default_factory=lambda: load_settings().run.driving)
    stated_horizon: bool = False
    earliest_end_ticks: int = 0
    settle_ticks: int = 10

    def __post_init__(self) -> None:
        self.tick = 0
        self.outputs: list[StepOutput] = []
        self.roster = self._roster()
        self.ground = np.zeros((len(self.agents), GROUND_WIDTH))
        self.ground[:, GroundColumn.HEADING_X] = 1.0
        self.ground[:, GroundColumn.PRESENT] = 1.0
        self.uav = np.zeros((len(self.tracks), UAV_WIDTH))
        self.uav[:, UavColumn.QW] = self.uav[:, UavColumn.LANDED] = 1.0
        plans = plans_with_events(self._spec(), self._uav_plans(), ())
        self.machines = tuple(MissionMachine(plan, FLIGHT, DT_S) for plan in plans)
        executor = ScenarioExecutor(self._setup())
        self.stepper: Any = executor
        if self.faults:
            ids = tuple(f'l{k}' for k in range(len(self.links)))
            self.stepper = FaultPort(executor, self.faults, self.roster, ids)

    def put(self, agent: str, x: float, y: float = 0.0, speed: float = 0.0) -> Stage:
        """Place an agent."""
        row = self.ground[self.agents.index(agent)]
        row[GroundColumn.X], row[GroundColumn.Y], row[GroundColumn.SPEED] = x, y, speed
        return self

    def remove(self, agent: str) -> Stage:
        """Take an agent out of the world."""
        self.ground[self.agents.index(agent), GroundColumn.PRESENT] = 0.0
        return self

    def fly(self, uav: str, x: float, y: float, z: float) -> Stage:
        """Place a UAV in the air, or landed and disarmed at z = 0."""
        row = self.uav[list(self.tracks).index(uav)]
        row[UavColumn.X], row[UavColumn.Y], row[UavColumn.Z] = x, y, z
        row[UavColumn.LANDED] = float(z <= 0.0)
        row[UavColumn.ARMED] = float(z > 0.0)
        return self

    def step(self, count: int = 1) -> StepOutput:
        """Step the executor `count` times on the same states."""
        for _ in range(count):
            self.outputs.append(self.stepper.step(self.tick, self.ground.copy(), self.uav.copy()))
            self.tick += 1
        return self.outputs[-1]

    def follow(self, count: int = 1) -> StepOutput:
        """Step and let the UAVs do at once what they are told."""
        for _ in range(count):
            output = self.step()
            for k, name in enumerate(self.tracks):
                mode = int(output.uav_commands[k, 0])
                x, y, z = output.uav_commands[k, 1:4].tolist()
                if mode == UavMode.LAND:
                    z = max(0.0, float(self.uav[k, UavColumn.Z]) - 0.5)
                    x, y = self.uav[k, :2].tolist()
                if mode != UavMode.IDLE:
                    self.fly(name, x, y, z)
                    velocity = output.uav_commands[k, 4:6] if mode == UavMode.OFFBOARD else 0.0
                    self.uav[k, UavColumn.VX : UavColumn.VY + 1] = velocity
        return self.outputs[-1]

    def notes(self, kind: ScenarioEventKind) -> list[tuple[int, str, str]]:
        """Return tick, subject and detail of all events of a kind so far."""
        return [
            (e.tick, e.subject, e.detail) for o in self.outputs for e in o.events if e.kind is kind
        ]

    def commands(self) -> list[tuple[int, str, int, float]]:
        """Return tick, agent, kind and value of all ground commands so far."""
        return [
            (k, self.agents[c.agent], int(c.kind), c.value)
            for k, output in enumerate(self.outputs)
            for c in output.ground_commands
        ]

    def _roster(self) -> Roster:
        def entry(body_id: str, kind: str, system_id: int) -> RosterEntry:
            return RosterEntry(
                body_id=body_id,
                type_name=kind,
                is_person=body_id in self.halts,
                system_id=system_id,
                length_m=4.5,
                width_m=1.8,
                height_m=1.5,
            )

        return Roster(
            dt_s=DT_S,
            agents=tuple(entry(a, 'car', 0) for a in self.agents),
            uavs=tuple(entry(u, 'uav', k + 1) for k, u in enumerate(self.tracks)),
        )

    def _surfaces(self) -> tuple[Surface, ...]:
        streets = () if self.street_x_m is None else (self.street_x_m,)
        kinds = ((SurfaceKind.DRIVING, streets), (SurfaceKind.SIDEWALK, self.sidewalks_x_m))
        return tuple(
            Surface(
                surface_id=f'{kind.name}{k}',
                kind=kind,
                ring=np.array([(a, -50.0), (b, -50.0), (b, 50.0), (a, 50.0)]),
            )
            for kind, strips in kinds
            for k, (a, b) in enumerate(strips)
        )

    def _grounded(self, agent: str) -> GroundedAgent:
        release, uav = self.releases.get(agent, (ReleaseOn.START, ''))
        front, beyond_m = self.parted.get(agent, ('', 0.0))
        release = ReleaseOn.WAITED if agent in self.waits_s else release
        return GroundedAgent(
            id=agent,
            type_name='car',
            is_person=agent in self.halts,
            length_m=4.5,
            width_m=1.8,
            height_m=1.5,
            role='other',
            edges=('a',),
            route_xy_m=((0.0, 0.0), (1.0, 0.0)),
            lane_id='a_0',
            lane_position_m=0.0,
            x_m=0.0,
            y_m=0.0,
            heading_x=1.0,
            heading_y=0.0,
            release=ReleaseOn.PARTED if front else release,
            release_agent=front,
            release_beyond_m=beyond_m,
            release_after_s=self.waits_s.get(agent, 0.0),
            release_uav=uav,
            release_mission=f'm{list(self.tracks).index(uav)}' if uav else '',
            drive_speed_mps=self.speeds.get(agent),
            halt_xy_m=self.halts.get(agent),
            stop_s=self.stops_s.get(agent),
            top_speed_mps=self.tops_mps.get(agent),
        )

    def _uav_plans(self) -> list[UavPlan]:
        return [
            UavPlan(
                id=name,
                system_id=k + 1,
                home_x_m=0.0,
                home_y_m=20.0 * k,
                landing_spots=self.landing_spots,
                missions=(
                    MissionPlan(
                        id=f'm{k}',
                        mode=MissionMode.TRACK,
                        target=target,
                        altitude_m=30.0,
                        duration_s=self.hold_s,
                    ),
                )
                if target
                else (),
                safe_altitude_m=60.0,
            )
            for k, (name, target) in enumerate(self.tracks.items())
        ]

    def _spec(self) -> ScenarioSpec:
        make = self.make
        return ScenarioSpec(
            prompt='x',
            agents=tuple(
                GroundAgent(
                    id=a,
                    type=AgentType.PEDESTRIAN if a in self.halts else AgentType.CAR,
                    behaviors=self.behaviors.get(a, ()),
                    placements=self.placements.get(a, ()),
                )
                for a in (*self.agents, *self.absent)
            ),
            uavs=tuple(Uav(id=u) for u in self.tracks),
            missions=tuple(
                UavMission(
                    id=f'm{k}',
                    uav=name,
                    mode=MissionMode.TRACK,
                    target=target,
                    altitude_m=make(30.0),
                    standoff_m=make(0.0),
                    duration_s=make(self.hold_s, 's', explicit=self.hold_said),
                )
                for k, (name, target) in enumerate(self.tracks.items())
                if target
            ),
            links=tuple(
                Link(
                    id=f'l{k}',
                    sender=a,
                    receiver=b,
                    loss=make(self.loss, '1'),
                    latency_s=make(0.1, 's'),
                    retransmissions=make(3.0, '1'),
                    retransmission_interval_s=make(0.2, 's'),
                )
                for k, (a, b) in enumerate(self.links)
            ),
            events=self.events,
            orders=self.orders,
            prohibitions=self.prohibitions,
            conditions=self.conditions,
        )

    def _link(self, link: Link) -> MessageLink:
        settings = LinkSettings(
            link_id=link.id,
            sender=link.sender,
            receiver=link.receiver,
            loss=link.loss.value,
            latency_s=link.latency_s.value,
            retransmissions=3,
            interval_s=0.2,
            reach=Reach(sight_m=500.0, blocked_m=200.0),
        )
        loss_at = loss_with_faults(link.id, link.loss.value, self.faults, DT_S)
        return MessageLink(settings, DT_S, stream(1, f'link:{link.id}'), loss_at)

    def _setup(self) -> ExecutionSetup:
        spec = self._spec()
        world = WorldModel(
            map_name='stage',
            map_digest='',
            origin_lat_deg=0.0,
            origin_lon_deg=0.0,
            weather='clear',
            time_of_day='noon',
            wind=Wind(),
            buildings=self.buildings,
            no_fly_zones=(),
            surfaces=self._surfaces(),
            lanes=self.lanes,
            signals=(),
            limits=load_limits(config_path('limits.json')),
            places=(NamedPlace(name='intersection', x_m=300.0, y_m=0.0),),
        )
        return ExecutionSetup(
            spec=spec,
            roster=self.roster,
            agents=tuple(self._grounded(a) for a in self.agents),
            machines=self.machines,
            links=tuple(self._link(link) for link in spec.links),
            airspace=Airspace(self.buildings, ()),
            geometry=WorldGeometry(world),
            landing_clearance_m=4.0,
            arrival_m=15.0,
            crosswalk_m=5.0,
            drive_m=self.drive_m,
            battery=BatteryRule(endurance_s=10.0, touchdown_m=0.3),
            action_rules=action_rules(load_tolerances(config_path('tolerances.json'))),
            driving=self.driving,
            deceleration=load_tolerances(config_path('tolerances.json')).deceleration_mps2,
            horizon_ticks=self.horizon_ticks,
            stated_horizon=self.stated_horizon,
            earliest_end_ticks=self.earliest_end_ticks,
            settle_ticks=self.settle_ticks,
            sight_period_ticks=20,
        )


@pytest.fixture
def stage(parameter: Callable[..., Parameter]) -> Callable[..., Stage]:
    """Set up a stage; arguments are the fields of `Stage`."""

    def make(**fields: Any) -> Stage:
        return Stage(make=parameter, **fields)

    return make
