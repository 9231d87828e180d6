# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The managed executor: a pure step from the states of a tick to the commands of the next.

Both engines call it, so there is one executor. It never reads a clock and draws chance only from
the generators it was given.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from itertools import count

import numpy as np
import numpy.typing as npt

from aurora_core.comm.link import MessageLink, Path
from aurora_core.execution.braking import Braking
from aurora_core.execution.detours import Detours
from aurora_core.execution.events import EventRunner
from aurora_core.execution.follower import Follower
from aurora_core.execution.landing import PATIENCE_S, landing_spot
from aurora_core.execution.lane_changer import LaneChanger
from aurora_core.execution.lasting import Lasting, Standing
from aurora_core.execution.observe import Observation
from aurora_core.execution.overtaker import Overtaker
from aurora_core.execution.premises import Premises
from aurora_core.execution.reports import Reports
from aurora_core.execution.step_output import StepOutput
from aurora_core.execution.triggers import BatteryRule
from aurora_core.execution.walking_up import is_behind, is_there
from aurora_core.execution.ways import Destinations, Ways
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.limits import Tolerance
from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.mission.machine import MissionMachine
from aurora_core.outcomes.grounded import GroundedAgent, ReleaseOn
from aurora_core.quantities.actions import ActionRules
from aurora_core.quantities.instant_sight import InstantSight
from aurora_core.quantities.world_geometry import WorldGeometry
from aurora_core.spec.prohibitions import keeps_on
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import (
    UAV_COMMAND_WIDTH,
    GroundCommandKind,
    UavPhase,
)
from aurora_core.trace.records import (
    EventRecord,
    LinkEventKind,
    LinkRecord,
    ScenarioEventKind,
    SightRecord,
)
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]


# Who must not brake slows down no harder behind others: that is no braking (m/s^2).
_GENTLY_MPS2 = 3.0

# Who stops by itself, and nobody says for how long, stands for the rest of any run (s).
_STANDS_S = 3600.0


# Distance recorded for a transmission to or from a body that is gone (m).
GONE_M = 1e6


@dataclass(frozen=True, slots=True, kw_only=True)
class ExecutionSetup:
    """Everything the executor works with.

    Attributes:
        geometry: Solids and places of the world, the same that the monitor judges with.
        arrival_m: An agent this close to a place is there.
        crosswalk_m: A person this close to the outline of a crosswalk is there.
        drive_m: Way after which an agent counts as having driven.
        battery: What the level of a UAV's battery is counted by.
        action_rules: When the actions of ground agents are complete.
        driving: How drivers are led.
        deceleration: Tolerance on a stated one.
        landing_clearance_m: The way to a landing spot keeps this clearance.
        earliest_end_ticks: Runs with an inferred horizon do not end before.
        settle_ticks: Time between the last thing done and the end.
    """

    spec: ScenarioSpec
    roster: Roster
    agents: tuple[GroundedAgent, ...]
    machines: tuple[MissionMachine, ...]
    links: tuple[MessageLink, ...]
    airspace: Airspace
    geometry: WorldGeometry
    landing_clearance_m: float
    arrival_m: float
    crosswalk_m: float | None
    drive_m: float
    battery: BatteryRule
    action_rules: ActionRules
    driving: DrivingStyle
    deceleration: Tolerance
    horizon_ticks: int
    stated_horizon: bool
    earliest_end_ticks: int
    settle_ticks: int
    sight_period_ticks: int


class ScenarioExecutor:
    """Runs one grounded scenario.

    Args:
        setup: What to run.
    """

    def __init__(self, setup: ExecutionSetup) -> None:
        self._setup = setup
        self._sequence = count()
        self._link_sequence = count()
        self._events: list[EventRecord] = []
        self._held = {i for i, a in enumerate(setup.agents) if a.release is not ReleaseOn.START}
        self._walking_up = {i: a.halt_xy_m for i, a in enumerate(setup.agents) if a.halt_xy_m}
        self._behind: frozenset[int] = frozenset()
        self._phases = [int(UavPhase.IDLE)] * len(setup.machines)
        self._seen: dict[tuple[str, str], bool] = {}
        self._ways = Ways(setup.spec, setup.drive_m)
        self._destinations = Destinations(setup.spec, setup.arrival_m)
        self._braking = Braking(setup.spec, setup.agents, setup.deceleration)
        self._lasting = Lasting(setup.spec, setup.action_rules, setup.roster.dt_s)
        self._runner = self._run_events(EventRunner)
        self._reports = Reports(setup.links, setup.roster.dt_s, self._runner.next_message)
        most_mps = setup.geometry.world.limits.uav_speed_max_mps
        self._premises = Premises(setup.spec, setup.roster, self._ways, most_mps)
        self._overtaker = Overtaker(setup.spec, setup.roster, self._lanes(), setup.driving)
        self._follower = Follower(
            setup.spec,
            setup.roster,
            setup.agents,
            self._lanes(),
            self._drives,
            setup.driving,
            setup.action_rules,
        )
        self._standing = Standing(setup.spec, setup.agents, setup.roster.dt_s)
        self._done_tick: int | None = None
        self._landing_since: dict[int, int] = {}
        self._sight = InstantSight(setup.geometry, setup.roster)
        self._dt_s = setup.roster.dt_s
        limits = setup.geometry.world.limits
        self._detours = Detours(setup.airspace, limits.clearance_min_m, limits.uav_altitude_max_m)

    def step(self, tick: int, ground: FloatArray, uav: FloatArray) -> StepOutput:
        """Evaluate the states of `tick`, return the commands for tick + 1.

        Args:
            tick: k >= 0; called once for every tick in order.
            ground: (N, GROUND_WIDTH).
            uav: (M, UAV_WIDTH).
        """
        s = self._setup
        self._events = []
        seen = Observation(s.roster, ground, uav, s.geometry, self._sight)
        commands = self._initial_commands() if tick == 0 else []
        rows = self._fly(tick, uav, seen)
        commands += self._release(tick, seen)
        commands += self._halts(tick, seen)
        commands += self._stood(tick)
        self._lasting.step(seen)
        self._ways.step(s.roster.dt_s, seen)
        self._destinations.step(seen)
        commands += self._premises.step(tick, s.roster.dt_s, seen, s.machines)
        commands += self._overtaker.step(seen)
        commands += self._follower.step(tick, seen, self._held)
        commands += self._runner.step(tick, s.roster.dt_s, seen, s.machines, self.note)
        for index in sorted(self._runner.sped_up):
            self._standing.leaves(index)
            if index not in self._held:
                continue
            # The first command says how fast it drives; that an event has told it.
            self._held.discard(index)
            commands += self._start_commands(index, s.agents[index])[1:]
        self._reports.step(tick, s.machines)
        links = self._step_links(tick, seen)
        sights = self._sights(tick, seen)
        outcome = self._outcome(tick)
        if outcome:
            self.note(tick, ScenarioEventKind.FINISHED, 'run', outcome)
        return StepOutput(
            ground_commands=tuple(commands),
            uav_commands=rows,
            links=tuple(links),
            sights=tuple(sights),
            events=tuple(self._events),
            finished=bool(outcome),
            outcome=outcome,
        )

    def note(self, tick: int, kind: ScenarioEventKind, subject: str, detail: str = '') -> None:
        """Add a scenario event to the records of this tick."""
        self._events.append(
            EventRecord(
                tick=tick, sequence=next(self._sequence), kind=kind, subject=subject, detail=detail
            )
        )

    def next_sequence(self) -> int:
        """Return the number of the next scenario event (for records added by fault ports)."""
        return next(self._sequence)

    def _run_events(self, kind: type[EventRunner]) -> EventRunner:
        """Return what sets the events of the scenario off."""
        s = self._setup
        stopping = frozenset(
            i for i, a in enumerate(s.agents) if a.stop_lane_id or a.halt_xy_m is not None
        )
        return kind(
            s.spec,
            s.roster,
            s.links,
            s.arrival_m,
            s.crosswalk_m,
            s.battery,
            s.action_rules,
            self._lanes(),
            self._set_off,
            self._drives,
            self._held,
            stopping,
            self._ways,
            self._braking,
            self._lasting,
        )

    def _lanes(self) -> LaneChanger:
        s = self._setup
        return LaneChanger(s.geometry.world, s.roster, s.action_rules.start_mps, s.driving)

    def _initial_commands(self) -> list[GroundCommand]:
        gently = GroundCommandKind.SET_DECELERATION
        forbidden = self._setup.spec.prohibitions
        commands = self._braking.at_start()
        for index, agent in enumerate(self._setup.agents):
            if any(keeps_on(no, agent.id) for no in forbidden):
                commands.append(GroundCommand(agent=index, kind=gently, value=_GENTLY_MPS2))
            if index in self._held:
                commands.append(
                    GroundCommand(agent=index, kind=GroundCommandKind.SET_SPEED, value=0.0)
                )
            else:
                commands += self._start_commands(index, agent)
        return commands

    def _start_commands(self, index: int, agent: GroundedAgent) -> list[GroundCommand]:
        commands = [self._drive_command(index, agent)]
        if agent.stop_lane_id:
            commands.append(
                GroundCommand(
                    agent=index,
                    kind=GroundCommandKind.STOP_AT,
                    value=agent.stop_position_m,
                    value2=_STANDS_S if agent.stop_s is None else agent.stop_s,
                    text=agent.stop_lane_id,
                )
            )
        return commands

    def _drive_command(self, index: int, agent: GroundedAgent) -> GroundCommand:
        if agent.drive_speed_mps is None:
            return GroundCommand(agent=index, kind=GroundCommandKind.RELEASE_SPEED)
        kind = GroundCommandKind.SET_SPEED
        return GroundCommand(agent=index, kind=kind, value=agent.drive_speed_mps)

    def _drives(self, index: int) -> GroundCommand:
        return self._drive_command(index, self._setup.agents[index])

    def _set_off(self, index: int) -> list[GroundCommand]:
        """Return the commands that let an agent drive, who may have been held until now."""
        agent = self._setup.agents[index]
        self._walking_up.pop(index, None)
        if index in self._held or not agent.stop_lane_id:
            self._held.discard(index)
            return self._start_commands(index, agent)
        resume = GroundCommand(agent=index, kind=GroundCommandKind.RESUME)
        return [resume, self._drive_command(index, agent)]

    def _is_over(self, agent: GroundedAgent, tick: int) -> bool:
        """Tell whether an agent has waited for as long as it is to."""
        return tick * self._dt_s >= agent.release_after_s

    def _release(self, tick: int, seen: Observation) -> list[GroundCommand]:
        commands: list[GroundCommand] = []
        if not self._held:
            return commands
        machines = {m.plan.id: m for m in self._setup.machines}
        for index in sorted(self._held):
            agent = self._setup.agents[index]
            machine = machines.get(agent.release_uav)
            ready = machine is not None and (
                (agent.release is ReleaseOn.ASCENDED and machine.ascended_tick is not None)
                or (
                    agent.release is ReleaseOn.CAPTURED
                    and agent.release_mission in machine.captured_missions
                )
                or (
                    agent.release is ReleaseOn.LAPPED
                    and agent.release_mission in machine.captured_missions
                    and not machine.is_on_first_lap
                )
                or (agent.release is ReleaseOn.OBSERVED and machine.missions_done)
            )
            waited = agent.release is ReleaseOn.WAITED and self._is_over(agent, tick)
            if ready or waited or _is_as_far(agent, seen):
                self._held.discard(index)
                self.note(tick, ScenarioEventKind.RELEASED, agent.id)
                commands += self._released_commands(index, agent)
        return commands

    def _halts(self, tick: int, seen: Observation) -> list[GroundCommand]:
        """Let persons who have walked to where they cross, or stop, stand there.

        Who comes up behind one that stands there waits until he has gone on.
        """
        commands: list[GroundCommand] = []
        for index, (x_m, y_m) in sorted(self._walking_up.items()):
            if index in self._held or seen.position(self._setup.agents[index].id) is None:
                continue
            there = is_there(seen.ground(index), x_m, y_m) or seen.steps_off(index, self._dt_s)
            waits = not there and self._somebody_stands_before(index, seen)
            stands = index in self._behind
            if there:
                del self._walking_up[index]
                self._standing.begins(index, tick)
            if (there or waits) and not stands:
                kind = GroundCommandKind.SET_SPEED
                commands.append(GroundCommand(agent=index, kind=kind, value=0.0))
            elif stands and not (there or waits):
                commands.append(self._drives(index))
            self._behind = self._behind | {index} if waits else self._behind - {index}
        return commands

    def _somebody_stands_before(self, index: int, seen: Observation) -> bool:
        others = [
            seen.ground(other)
            for other, agent in enumerate(self._setup.agents)
            if other != index and agent.is_person and other not in self._walking_up
        ]
        return is_behind(seen.ground(index), others, self._setup.action_rules.stop_mps)

    def _stood(self, tick: int) -> list[GroundCommand]:
        """Let go on who has stood for its time."""
        commands: list[GroundCommand] = []
        for index in self._standing.over(tick):
            agent = self._setup.agents[index]
            if index not in self._held:
                commands.append(self._drive_command(index, agent))
                continue
            self._held.discard(index)
            self.note(tick, ScenarioEventKind.RELEASED, agent.id)
            commands += self._released_commands(index, agent)
        return commands

    def _released_commands(self, index: int, agent: GroundedAgent) -> list[GroundCommand]:
        """Return what lets an agent drive, no faster than an event has told it meanwhile."""
        most_mps = self._runner.slowed_mps.get(index)
        drive, *stop = self._start_commands(index, agent)
        if most_mps is None or 0.0 < drive.value <= most_mps:
            return [drive, *stop]
        kind = GroundCommandKind.SET_SPEED
        return [GroundCommand(agent=index, kind=kind, value=most_mps), *stop]

    def _fly(self, tick: int, uav: FloatArray, seen: Observation) -> FloatArray:
        rows = np.zeros((len(self._setup.machines), UAV_COMMAND_WIDTH))
        for index, machine in enumerate(self._setup.machines):
            if tick == 0:
                machine.start()
            machine.stays_up = self._runner.keeps_up(machine.plan, tick)
            followed = machine.followed
            target = None if followed is None else seen.motion(followed)
            self._detours.look_ahead(tick, self._dt_s, machine, uav[index], target)
            row = machine.step(tick, uav[index], target)
            if machine.needs_landing_spot():
                self._choose_landing_spot(tick, index, uav)
            rows[index] = row
            if machine.phase != self._phases[index]:
                self._phases[index] = machine.phase
                self.note(tick, ScenarioEventKind.PHASE, machine.plan.id, machine.phase_name)
        return rows

    def _choose_landing_spot(self, tick: int, index: int, uav: FloatArray) -> None:
        s = self._setup
        since = self._landing_since.setdefault(index, tick)
        chosen = landing_spot(
            index,
            s.machines,
            uav,
            s.airspace,
            s.landing_clearance_m,
            patient=(tick - since) * s.roster.dt_s < PATIENCE_S,
        )
        if chosen is not None:
            s.machines[index].set_landing_spot(*chosen)

    def _step_links(self, tick: int, seen: Observation) -> list[LinkRecord]:
        records: list[LinkRecord] = []
        for link in self._setup.links:
            if link.idle:
                continue
            sender, receiver = link.settings.sender, link.settings.receiver
            records += link.step(
                tick, partial(_path, seen, sender, receiver), self._next_link_sequence
            )
        for record in records:
            if record.kind is LinkEventKind.DELIVERED:
                self._runner.received(record.receiver, record.sender)
        return records

    def _next_link_sequence(self) -> int:
        return next(self._link_sequence)

    def _sights(self, tick: int, seen: Observation) -> list[SightRecord]:
        records = []
        for machine in self._setup.machines:
            mission = machine.mission
            if mission is None or mission.target is None:
                continue
            pair = (machine.plan.id, mission.target)
            visible, slant_range_m = seen.sight(*pair)
            if visible != self._seen.get(pair) or tick % self._setup.sight_period_ticks == 0:
                self._seen[pair] = visible
                records.append(
                    SightRecord(
                        tick=tick,
                        observer=pair[0],
                        target=pair[1],
                        visible=visible,
                        slant_range_m=slant_range_m,
                    )
                )
        return records

    def _outcome(self, tick: int) -> str:
        s = self._setup
        if tick >= s.horizon_ticks:
            return 'horizon'
        if s.stated_horizon or not (s.machines or s.spec.events):
            return ''
        if not self._all_done():
            self._done_tick = None
            return ''
        if self._done_tick is None:
            self._done_tick = tick
        settled = tick - self._done_tick >= s.settle_ticks
        return 'finished' if settled and tick >= s.earliest_end_ticks else ''

    def _all_done(self) -> bool:
        for machine in self._setup.machines:
            if not machine.done:  # the usual answer
                return False
        idle = all(link.idle for link in self._setup.links)
        return (
            idle and self._runner.done and self._destinations.all_reached() and self._lasting.done
        )


def _is_as_far(agent: GroundedAgent, seen: Observation) -> bool:
    """Tell whether the agent that another one waits for has come near, or has drawn away."""
    if agent.release not in (ReleaseOn.NEARED, ReleaseOn.PARTED):
        return False
    distance_m = seen.distance_m(agent.id, agent.release_agent)
    if distance_m is None:
        return False
    if agent.release is ReleaseOn.PARTED:
        return distance_m >= agent.release_beyond_m
    return distance_m <= agent.release_within_m


def _path(seen: Observation, sender: str, receiver: str) -> Path:
    """Return the geometry of a transmission; a body that is gone is out of any range."""
    distance_m = seen.distance_m(sender, receiver)
    if distance_m is None:
        return Path(distance_m=GONE_M, line_of_sight=False)
    return Path(distance_m=distance_m, line_of_sight=seen.line_of_sight(sender, receiver))
