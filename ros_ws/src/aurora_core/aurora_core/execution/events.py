# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the events of a scenario: trigger, delay, the sight rule of alerts, action."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from aurora_core.comm.link import MessageLink, whole_ticks
from aurora_core.execution.observe import Observation
from aurora_core.execution.triggers import Progress, holds
from aurora_core.mission.machine import MissionMachine
from aurora_core.quantities.actions import (
    ActionRules,
    ends_with_mps,
    is_complete,
    takes_time,
)
from aurora_core.spec.events import actor_of
from aurora_core.spec.scenario import (
    AgentAction,
    Event,
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

# Deceleration of a commanded braking (m/s^2): above the 4 m/s^2 that "brake" asks for.
BRAKING_MPS2 = 6.0

Note = Callable[[int, ScenarioEventKind, str, str], None]

# Speed from which an agent can be seen to brake or stop (m/s).
ON_THE_MOVE_MPS = 5.0

_FROM_MOTION = frozenset({'brake', 'stop', 'yield', 'slow'})


def _shows_after(event: Event) -> int:
    """Return how many ticks after it is due an action shows in the record.

    A message is sent at once. What an agent is told shows in its state one tick later. A UAV
    begins a phase with its next step, whose command belongs to the tick after.
    """
    if isinstance(event.action, UavAction):
        return 2
    return 1 if isinstance(event.action, AgentAction) else 0


@dataclass(slots=True)
class _EventState:
    """How far an event has come.

    Attributes:
        acted: Its action was ordered.
        before_mps: Speed of the agent when it was, None when it has no speed to get to.
        done: Its action is complete.
    """

    event: Event
    triggered_tick: int | None = None
    acted: bool = False
    before_mps: float | None = None
    done: bool = False


class EventRunner:
    """All events of one run.

    Args:
        spec: The request.
        roster: Row order.
        links: Message links.
        arrival_m: An agent this close to a place is there.
        rules: When the actions of ground agents are complete.
        set_off: Gives the commands that let the agent of a row drive.
    """

    def __init__(
        self,
        spec: ScenarioSpec,
        roster: Roster,
        links: Sequence[MessageLink],
        arrival_m: float,
        rules: ActionRules,
        set_off: Callable[[int], list[GroundCommand]],
    ) -> None:
        self._roster = roster
        self._rules = rules
        self._set_off = set_off
        self._links = links
        # What waits for a body that could not be placed never happens: the run ends without it,
        # as `incomplete`.
        absent = {a.id for a in spec.agents if roster.agent_index(a.id) is None}
        self._states = [_EventState(event=e) for e in spec.events if not bodies_of(e) & absent]
        ids = {e.id for e in spec.events}
        self._before: dict[str, set[str]] = {
            e.id: {o.first for o in spec.orders if o.then == e.id and o.first in ids}
            for e in spec.events
        }
        self._progress = Progress(arrival_m=arrival_m)
        self._messages = 0

    @property
    def done(self) -> bool:
        """Whether every event has happened."""
        return all(s.done for s in self._states)

    def received(self, receiver: str, sender: str) -> None:
        """Note a delivered message."""
        self._progress.received.add((receiver, sender))

    def keeps_up(self, uav_id: str, tick: int) -> bool:
        """Tell whether something is still to happen before a UAV lands after its missions."""
        return any(
            s.event.trigger is None
            and isinstance(s.event.action, UavAction)
            and s.event.action.do == 'land'
            and s.event.action.uav == uav_id
            and not self._may_follow(s.event, tick)
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
            if machine.ascended_tick is not None:
                self._progress.ascended.add(machine.plan.id)
            if machine.missions_done:
                self._progress.missions_done.add(machine.plan.id)
        commands: list[GroundCommand] = []
        for state in self._states:
            if state.done:
                continue
            event = state.event
            if state.triggered_tick is None and self._begins(event, tick, dt_s, seen, machines):
                state.triggered_tick = tick
                note(tick, ScenarioEventKind.TRIGGERED, event.id, '')
            if state.triggered_tick is None:
                continue
            if state.acted:
                self._finish(state, tick, seen)
                continue
            due = tick >= state.triggered_tick + whole_ticks(event.waits_s, dt_s)
            due = due and self._may_follow(event, tick)
            if due and self._allowed(event, seen, machines):
                commands += self._act(tick, event, seen, machines)
                note(tick, ScenarioEventKind.ACTION, event.id, '')
                self._begun(state, tick, seen)
        return commands

    def _begun(self, state: _EventState, tick: int, seen: Observation) -> None:
        """Note that an action was ordered; one that gets to a speed is not complete yet."""
        action = state.event.action
        state.acted = True
        speed_mps = None
        if isinstance(action, AgentAction) and takes_time(action):
            speed_mps = seen.speed_mps(action.agent)
        if speed_mps is None:
            state.done = True
            self._progress.done_tick[state.event.id] = tick + _shows_after(state.event)
            return
        state.before_mps = speed_mps
        self._finish(state, tick, seen)

    def _finish(self, state: _EventState, tick: int, seen: Observation) -> None:
        """Note that an action is complete, once the speed of its agent says so."""
        action = state.event.action
        if not isinstance(action, AgentAction) or state.before_mps is None:
            return
        speed_mps = seen.speed_mps(action.agent)
        if speed_mps is None:
            return
        if is_complete(action, state.before_mps, speed_mps, self._rules):
            state.done = True
            self._progress.done_tick[state.event.id] = tick

    def _begins(
        self,
        event: Event,
        tick: int,
        dt_s: float,
        seen: Observation,
        machines: Sequence[MissionMachine],
    ) -> bool:
        if event.trigger is not None:
            return holds(event, tick, dt_s, seen, self._progress)
        if not self._may_follow(event, tick):
            return False
        if isinstance(event.action, UavAction) and event.action.do == 'land':
            # Nobody says when: a UAV lands after its missions.
            return event.action.uav in self._progress.missions_done
        # Nobody says when: once the UAVs watch, and once who is to brake or stop is on the move.
        if any(m.first_capture_tick is None for m in machines):
            return False
        if not isinstance(event.action, AgentAction) or event.action.do not in _FROM_MOTION:
            return True
        speed_mps = seen.speed_mps(event.action.agent)
        return speed_mps is not None and speed_mps >= ON_THE_MOVE_MPS

    def _allowed(
        self, event: Event, seen: Observation, machines: Sequence[MissionMachine]
    ) -> bool:
        """A UAV reports only what it sees: after its ascent, when tracking after capture."""
        if not isinstance(event.action, SendMessage):
            return True
        sender = event.action.sender
        machine = next((m for m in machines if m.plan.id == sender), None)
        if machine is None:
            return True
        if machine.ascended_tick is None:
            return False
        tracks = [m.id for m in machine.plan.missions if m.mode is MissionMode.TRACK]
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
                    self._messages += 1
                    link.send(tick, self._messages, event.id)
                    break
            return []
        if isinstance(action, UavAction):
            for machine in machines:
                if machine.plan.id == action.uav and action.do == 'land':
                    machine.land_now()
                elif machine.plan.id == action.uav and action.altitude_m is not None:
                    machine.climb_to(action.altitude_m.value)
            return []
        if isinstance(action, AgentAction):
            return self._agent_commands(action, seen)
        return []

    def _agent_commands(self, action: AgentAction, seen: Observation) -> list[GroundCommand]:
        row = self._roster.agent_index(action.agent)
        if row is None:
            return []
        if action.do == 'start' and action.value_mps is None:
            return self._set_off(row)
        now_mps = seen.speed_mps(action.agent)
        if now_mps is None:
            return []
        goal_mps = ends_with_mps(action, now_mps, self._rules)
        if goal_mps is None:
            return []
        commands = [GroundCommand(agent=row, kind=GroundCommandKind.SET_SPEED, value=goal_mps)]
        if action.do == 'brake':
            harder = GroundCommandKind.SET_DECELERATION
            commands.insert(0, GroundCommand(agent=row, kind=harder, value=BRAKING_MPS2))
        return commands
