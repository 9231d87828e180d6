# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the events of a scenario: trigger, delay, the sight rule of alerts, action."""

from __future__ import annotations

from collections.abc import Callable, Sequence, Set

from aurora_core.comm.link import MessageLink, whole_ticks
from aurora_core.execution.braking import Braking
from aurora_core.execution.event_state import EventState, has_crossed, shows_after
from aurora_core.execution.lane_changer import LaneChanger
from aurora_core.execution.lasting import Lasting
from aurora_core.execution.observe import Observation
from aurora_core.execution.own_stops import OwnStops
from aurora_core.execution.triggers import BatteryRule, Progress, holds
from aurora_core.execution.untold import heard_before, least_mps, slowed_later
from aurora_core.execution.ways import Ways
from aurora_core.execution.yielding import Yielding
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import UavPlan
from aurora_core.quantities.actions import (
    CLIMBED_M,
    FROM_MOTION,
    ActionRules,
    climbed_mps,
    commanded_mps,
    is_complete,
    rest_s,
    takes_time,
)
from aurora_core.quantities.doing import doing_watches
from aurora_core.quantities.headway import pair_watches
from aurora_core.spec.events import BRAKING, actor_of, reports_own_altitude
from aurora_core.spec.flight_order import counts_from_capture, is_next_anyway
from aurora_core.spec.own_events import let_pass, own_events
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
    EventDoneTrigger,
    ScenarioSpec,
    SendMessage,
    UavAction,
    bodies_of,
)
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.records import ScenarioEventKind
from aurora_core.trace.roster import Roster

Note = Callable[[int, ScenarioEventKind, str, str], None]

# Speed below which braking is over before it shows (m/s).
_BRAKES_FROM_MPS = 1.0

# Speed from which somebody is on the way who is to slow down or stop later (m/s).
_UNDER_WAY_MPS = 3.0


class EventRunner:
    """All events of one run.

    Args:
        spec: The request.
        roster: Row order.
        links: Message links.
        arrival_m: An agent this close to a place is there.
        crosswalk_m: A person this close to the outline of a crosswalk is there.
        battery: What its level is counted by.
        rules: When the actions of ground agents are complete.
        lanes: Orders changes of lane.
        set_off: Gives the commands that let the agent of a row drive.
        drive: Gives the command that lets the agent of a row drive on.
        held: Rows of the agents that may not set off yet.
        stopping: Rows of the agents that stop by themselves.
        ways: Who has to drive before anybody stops.
        braking: How hard drivers brake.
        lasting: Who is to do something for some time first.

    Attributes:
        sped_up: Rows of agents that an event has told how fast to drive, at the last step.
        slowed_mps: How fast the agents of rows may drive that an event has told to stop, or to be
            no faster: whoever may set off only later keeps to that.
    """

    def __init__(
        self,
        spec: ScenarioSpec,
        roster: Roster,
        links: Sequence[MessageLink],
        arrival_m: float,
        crosswalk_m: float | None,
        battery: BatteryRule,
        rules: ActionRules,
        lanes: LaneChanger,
        set_off: Callable[[int], list[GroundCommand]],
        drive: Callable[[int], GroundCommand],
        held: Set[int],
        stopping: frozenset[int],
        ways: Ways,
        braking: Braking,
        lasting: Lasting,
    ) -> None:
        self._roster = roster
        self._rules = rules
        self._lanes = lanes
        self._set_off = set_off
        self._stops = OwnStops(roster, stopping, rules.stop_mps)
        self._ways = ways
        self._braking = braking
        self._lasting = lasting
        self._drive = drive
        self._held = held
        self._spec = spec
        self.sped_up: set[int] = set()
        self.slowed_mps: dict[int, float] = {}
        self._yielding = Yielding(spec, roster)
        self._links = links
        # What waits for a body that could not be placed never happens: the run ends without it,
        # as `incomplete`.
        absent = {a.id for a in spec.agents if roster.agent_index(a.id) is None}
        events = (*spec.events, *own_events(spec))
        self._states = [EventState(event=e) for e in events if not bodies_of(e) & absent]
        ids = {e.id for e in spec.events}
        self._before: dict[str, set[str]] = {
            e.id: {o.first for o in spec.orders if o.then == e.id and o.first in ids}
            for e in events
        }
        self._waited_for = {
            e.trigger.event for e in events if isinstance(e.trigger, EventDoneTrigger)
        }
        self._slowed_later = slowed_later(spec)
        self._heard_before = heard_before(spec)
        self._over_from: dict[str, int] = {}
        self._touchdown_m = battery.touchdown_m
        self._progress = Progress(
            arrival_m=arrival_m, crosswalk_m=crosswalk_m, endurance_s=battery.endurance_s
        )
        self._watches = pair_watches(roster, events)
        self._progress.doing = doing_watches(spec, rules, roster.dt_s)
        self._progress.rests_s = {e.id: rest_s(spec, e, rules) for e in events}
        self._messages = 0

    @property
    def done(self) -> bool:
        """Whether every event has happened."""
        return all(s.done for s in self._states)

    def next_message(self) -> int:
        """Return the number of the next message of the run."""
        self._messages += 1
        return self._messages

    def received(self, receiver: str, sender: str) -> None:
        """Note a delivered message."""
        self._progress.received.add((receiver, sender))

    def keeps_up(self, plan: UavPlan, tick: int) -> bool:
        """Tell whether something is still to happen before a UAV lands after its missions."""
        return bool(self._states) and any(
            s.event.id in plan.lands_after
            or (
                s.event.trigger is None
                and isinstance(s.event.action, UavAction)
                and s.event.action.lands
                and s.event.action.uav == plan.id
                and not self._may_follow(s.event, tick)
            )
            for s in self._states
            if not s.done
        )

    def _may_follow(self, event: Event, tick: int) -> bool:
        """Tell whether everything that is to come before an event shows by `tick`."""
        done = self._progress.done_tick
        return all(first in done and done[first] <= tick for first in self._before[event.id])

    def step(
        self,
        tick: int,
        dt_s: float,
        seen: Observation,
        machines: Sequence[MissionMachine],
        note: Note,
    ) -> list[GroundCommand]:
        """Evaluate triggers at `tick`, start due actions, return their ground commands."""
        for machine in machines:
            if machine.is_landing:
                self._progress.looking.discard(machine.plan.id)
            elif machine.ascended_tick is not None:
                self._progress.looking.add(machine.plan.id)
            if machine.missions_done and self._over_from.setdefault(machine.plan.id, tick) < tick:
                # The record shows it with the next command.
                self._progress.missions_done.add(machine.plan.id)
            if seen.airborne(machine.plan.id, self._touchdown_m):
                flown = self._progress.airborne_ticks
                flown[machine.plan.id] = flown.get(machine.plan.id, 0) + 1
        self._progress.pairs = {e: seen.pair_s(w) for e, w in self._watches.items()}
        self.sped_up.clear()
        commands = [self._drive(row) for row in self._yielding.passed(seen)]
        for state in self._states:
            if state.done:
                continue
            event = state.event
            if state.triggered_tick is None and self._begins(event, tick, dt_s, seen, machines):
                state.triggered_tick = tick
                note(tick, ScenarioEventKind.TRIGGERED, event.id, '')
            if state.triggered_tick is None:
                continue
            commands += self._drives_on(state, seen)
            if state.acted:
                self._finish(state, tick, seen, machines)
                continue
            due = tick >= state.triggered_tick + whole_ticks(event.waits_s, dt_s)
            due = due and self._may_follow(event, tick)
            due = due and self._can_begin(event, seen) and self._has_stood(event, tick, dt_s)
            if due and self._allowed(event, seen, machines):
                commands += self._act(tick, event, seen, machines)
                said = event.action.text if isinstance(event.action, SendMessage) else None
                note(tick, ScenarioEventKind.ACTION, event.id, said or '')
                self._begun(state, tick, seen, machines)
        return commands

    def _drives_on(self, state: EventState, seen: Observation) -> list[GroundCommand]:
        """Let who was to brake or stop before drive on to change lane."""
        action, since = state.event.action, state.triggered_tick
        if state.drove_on or not isinstance(action, AgentAction) or action.do != 'change_lane':
            return []
        held = any(
            isinstance(s.event.action, AgentAction)
            and s.event.action.agent == action.agent
            and s.event.action.do in ('brake', 'stop')
            and s.acted
            and s.triggered_tick is not None
            and since is not None
            and s.triggered_tick <= since
            for s in self._states
        )
        row, speed_mps = self._roster.agent_index(action.agent), seen.speed_mps(action.agent)
        if not held or row is None or speed_mps is None or speed_mps >= _UNDER_WAY_MPS:
            return []
        state.drove_on = True
        return [self._drive(row)]

    def _begun(
        self,
        state: EventState,
        tick: int,
        seen: Observation,
        machines: Sequence[MissionMachine],
    ) -> None:
        """Note that an action was ordered; one that gets somewhere is not complete yet."""
        action = state.event.action
        state.acted = True
        if not isinstance(action, AgentAction) or action.do != 'cross':
            self._progress.begun_tick[state.event.id] = tick + shows_after(state.event)
        speed_mps = None
        if isinstance(action, AgentAction) and takes_time(action):
            speed_mps = seen.speed_mps(action.agent)
            row = self._roster.agent_index(action.agent)
            if action.do == 'change_lane' and row is not None:
                state.lane = self._lanes.lane(row, seen)
        if isinstance(action, UavAction) and action.altitude_m is not None:
            state.climbs = any(
                m.plan.id == action.uav and (m.on_mission or m.climbs_first) for m in machines
            )
        if isinstance(action, UavAction) and state.event.id in self._waited_for:
            state.flies = action.mission
        if speed_mps is None and not state.climbs and state.flies is None:
            state.done = True
            self._progress.done_tick[state.event.id] = tick + shows_after(state.event)
            return
        state.before_mps = speed_mps
        self._finish(state, tick, seen, machines)

    def _finish(
        self,
        state: EventState,
        tick: int,
        seen: Observation,
        machines: Sequence[MissionMachine],
    ) -> None:
        """Note that an action is complete: by speed, lane, altitude or capture of a mission."""
        action = state.event.action
        if state.flies is not None:
            if any(state.flies in m.captured_missions for m in machines):
                state.done = True
                self._progress.done_tick[state.event.id] = tick
            return
        if isinstance(action, UavAction) and action.altitude_m is not None:
            point = seen.position(action.uav)
            if point is not None and abs(point[2] - action.altitude_m.value) <= CLIMBED_M:
                state.done = True
                self._progress.done_tick[state.event.id] = tick
            return
        if not isinstance(action, AgentAction) or state.before_mps is None:
            return
        speed_mps = seen.speed_mps(action.agent)
        if speed_mps is None:
            return
        if action.do == 'cross':
            complete = has_crossed(state, action.agent, seen)
            if state.stepped_on is not None:
                self._progress.begun_tick.setdefault(state.event.id, tick)
        elif state.lane is not None:
            row = self._roster.agent_index(action.agent)
            complete = row is not None and self._lanes.is_over(row, state.lane, seen, action.side)
        else:
            complete = is_complete(action, state.before_mps, speed_mps, self._rules)
        if complete:
            state.done = True
            self._progress.done_tick[state.event.id] = tick

    def _has_stood(self, event: Event, tick: int, dt_s: float) -> bool:
        """Tell whether who is to start again has stood for as long as a stop is."""
        action = event.action
        if not isinstance(action, AgentAction) or action.do != 'start':
            return True
        stops = [
            s
            for s in self._states
            if isinstance(s.event.action, AgentAction)
            and (s.event.action.agent, s.event.action.do) == (action.agent, 'stop')
            and s.acted
        ]
        hold_ticks = whole_ticks(self._rules.stop_hold_s, dt_s)
        done = self._progress.done_tick
        return all(s.done and tick - done[s.event.id] >= hold_ticks for s in stops)

    def _can_begin(self, event: Event, seen: Observation) -> bool:
        """Tell whether an action is possible now.

        A change of lane needs a free lane beside, braking something to brake from.
        """
        action = event.action
        if isinstance(action, AgentAction) and action.do == 'brake':
            speed_mps = seen.speed_mps(action.agent)
            return speed_mps is not None and speed_mps >= _BRAKES_FROM_MPS
        if not isinstance(action, AgentAction) or action.do != 'change_lane':
            return True
        row = self._roster.agent_index(action.agent)
        return row is not None and self._lanes.goal(row, seen, side=action.side) is not None

    def _begins(
        self,
        event: Event,
        tick: int,
        dt_s: float,
        seen: Observation,
        machines: Sequence[MissionMachine],
    ) -> bool:
        action = event.action
        if is_next_anyway(event) and isinstance(action, UavAction) and action.mission is not None:
            return any(m.has_begun(action.mission) for m in machines if m.plan.id == action.uav)
        if counts_from_capture(self._spec, event) and isinstance(event.action, UavAction):
            own = [m for m in machines if m.plan.id == event.action.uav]
            if any(m.first_capture_tick is None for m in own):
                return False
        if event.trigger is not None:
            return holds(event, tick, dt_s, seen, self._progress)
        if not self._may_follow(event, tick):
            return False
        if isinstance(event.action, UavAction) and event.action.lands:
            # Nobody says when: a UAV lands after its missions.
            return event.action.uav in self._over_from
        heard = self._heard_before.get(event.id, frozenset())
        if not heard <= self._progress.received:
            return False
        on_foot = self._stops.on_foot(event, seen)
        busy = isinstance(event.action, AgentAction) and self._lasting.is_busy(event.action.agent)
        if busy and not on_foot:
            return False
        # Nobody says when: once the UAVs watch, have flown the route that this may end, and once
        # who is to brake or stop is on the move and has driven.
        flying = [m for m in machines if not m.waits_on_ground]
        if any(m.first_capture_tick is None or m.is_on_first_lap for m in flying):
            return False
        later = [seen.speed_mps(agent) for agent in sorted(self._slowed_later.get(event.id, ()))]
        if any(speed_mps is not None and speed_mps < _UNDER_WAY_MPS for speed_mps in later):
            return False
        if not isinstance(event.action, AgentAction) or event.action.do not in FROM_MOTION:
            return True
        speed_mps = seen.speed_mps(event.action.agent)
        if speed_mps is None:
            return False
        row = self._roster.agent_index(event.action.agent)
        stands = self._stops.stands(event, seen)
        if stands is not None:
            return stands
        is_person = row is not None and self._roster.agents[row].is_person
        least = least_mps(event.action, is_person=is_person)
        return speed_mps >= least and self._ways.all_driven()

    def _allowed(
        self, event: Event, seen: Observation, machines: Sequence[MissionMachine]
    ) -> bool:
        """A UAV reports only what it sees: after its ascent, when tracking after capture.

        Once it has landed it reports nothing. Its own altitude it reports when it is reached.
        """
        if not isinstance(event.action, SendMessage):
            return True
        sender = event.action.sender
        machine = next((m for m in machines if m.plan.id == sender), None)
        if machine is None:
            return True
        if machine.landed:
            return False
        if reports_own_altitude(event):
            return True
        if machine.ascended_tick is None:
            return False
        missions = machine.plan.missions
        flown = [m for m in missions if not m.waits] or missions
        tracks = [m.id for m in flown if m.mode is MissionMode.TRACK]
        if tracks and tracks[0] not in machine.captured_missions:
            return False
        actor = actor_of(event)
        return actor is None or actor == sender or seen.visible(sender, actor)

    def _act(
        self,
        tick: int,
        event: Event,
        seen: Observation,
        machines: Sequence[MissionMachine],
    ) -> list[GroundCommand]:
        action = event.action
        if isinstance(action, SendMessage):
            for link in self._links:
                pair = (link.settings.sender, link.settings.receiver)
                if pair == (action.sender, action.receiver):
                    link.send(tick, self.next_message(), event.id)
                    break
            return []
        if isinstance(action, UavAction):
            for machine in machines:
                if machine.plan.id == action.uav:
                    _order(machine, action)
            return []
        if isinstance(action, AgentAction):
            self._note_yielding(event, action)
            return self._agent_commands(action, seen)
        return []

    def _note_yielding(self, event: Event, action: AgentAction) -> None:
        """Note whom an agent lets pass; what else it is to do later is left to that event."""
        row, other = self._roster.agent_index(action.agent), let_pass(self._spec, event)
        does = {
            s.event.action.do
            for s in self._states
            if isinstance(s.event.action, AgentAction) and s.event.action.agent == action.agent
        }
        if row is not None and other is not None and does == {'yield'}:
            self._yielding.note(row, other)

    def _agent_commands(self, action: AgentAction, seen: Observation) -> list[GroundCommand]:
        row = self._roster.agent_index(action.agent)
        if row is None:
            return []
        # A person who crosses has stood on the way that was planned over the street.
        crosses = action.do == 'cross' and self._roster.agents[row].is_person
        if action.do in ('start', 'accelerate'):
            self.slowed_mps.pop(row, None)
        if crosses or (action.do == 'start' and action.value_mps is None):
            return self._set_off(row)
        now_mps = seen.speed_mps(action.agent)
        if now_mps is None:
            return []
        if action.do == 'change_lane':
            goal = self._lanes.goal(row, seen, side=action.side)
            return [] if goal is None else self._lanes.commands(row, goal)
        goal_mps = commanded_mps(action, now_mps, self._rules)
        if goal_mps is None:
            return []
        commands = [GroundCommand(agent=row, kind=GroundCommandKind.SET_SPEED, value=goal_mps)]
        if action.do in ('start', 'accelerate'):
            self.sped_up.add(row)
        # Who stands has no speed to halve.
        if action.do == 'stop' or (action.do == 'slow' and action.value_mps is not None):
            self.slowed_mps[row] = goal_mps
            if row in self._held and goal_mps > 0.0:
                return []  # who may not set off yet stands
        if action.do in BRAKING:
            commands = [*self._braking.commands(row, action), *commands]
        return commands


def _order(machine: MissionMachine, action: UavAction) -> None:
    """Let a UAV do what an event asks of it."""
    if action.lands:
        machine.land_now()
    elif action.mission is not None:
        machine.change_to(action.mission)
    elif action.altitude_m is not None:
        asked = action.vertical_mps
        machine.climb_to(action.altitude_m.value, None if asked is None else climbed_mps(asked))
