# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Make happen what an event waits for and nothing else brings about.

"If the truck falls below 3 m/s, the ego brakes": left to traffic, the truck stops at a light and
the ego has long been standing behind it. A driver whose speed nobody else decides slows down once
everybody watches, and while who is to answer drives.
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.execution.observe import Observation
from aurora_core.execution.untold import on_the_move_mps
from aurora_core.execution.ways import Ways
from aurora_core.mission.machine import MissionMachine
from aurora_core.spec.scenario import AgentAction, Event, ScenarioSpec, SpeedTrigger
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.roster import Roster

# So much below the speed that is waited for (m/s), and not before it has been driven for so long;
# where a speed is stated, with such a share of it and for so long that slowing down is no matter.
_BELOW_MPS = 1.0
_DRIVEN_S = 4.0
_STATED_SHARE = 0.95
_STATED_S = 20.0

# Who was as fast as is waited for, for so long (s), goes on at this share of what a UAV flies.
_FAST_S = 0.3
_KEPT_UP_SHARE = 0.75
# From this share on a UAV falls behind.
_OUTRUN_SHARE = 0.85

_DECIDE_SPEED = frozenset(
    {
        BehaviorKind.STOP,
        BehaviorKind.BRAKE,
        BehaviorKind.SLOW,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
        BehaviorKind.EMERGENCY_RUN,
    }
)


class Premises:
    """Slows down the drivers whose low speed an event waits for, or who need not be fast any more.

    Args:
        spec: The request.
        roster: Row order.
        ways: Who has to drive before anybody stops.
        most_mps: So fast a UAV flies at most.
    """

    def __init__(self, spec: ScenarioSpec, roster: Roster, ways: Ways, most_mps: float) -> None:
        self._roster = roster
        self._ways = ways
        self._events = [e for e in spec.events if _is_left_to_chance(spec, e)]
        self._driven: dict[str, int] = {}
        self._stated_mps = {
            agent.id: _STATED_SHARE * max(speeds)
            for agent in spec.agents
            if (speeds := [b.speed_mps.value for b in agent.behaviors if b.speed_mps is not None])
        }
        self._fast = [e for e in spec.events if _is_outrun(spec, e, most_mps)]
        self._most_mps = most_mps

    def step(
        self, tick: int, dt_s: float, seen: Observation, machines: Sequence[MissionMachine]
    ) -> list[GroundCommand]:
        """Return the commands of a tick."""
        commands = self._let_up(tick, dt_s, seen) if self._fast else []
        if not self._events:
            return commands
        watched = all(m.first_capture_tick is not None for m in machines if not m.waits_on_ground)
        for event in tuple(self._events):
            trigger = event.trigger
            assert isinstance(trigger, SpeedTrigger)
            row = self._roster.agent_index(trigger.who)
            if row is None or not watched or not self._drive(event, trigger, seen):
                self._driven.pop(event.id, None)
                continue
            since = self._driven.setdefault(event.id, tick)
            driven_s = _STATED_S if trigger.who in self._stated_mps else _DRIVEN_S
            if (tick - since) * dt_s < driven_s or not self._ways.all_driven():
                continue
            value = max(0.0, trigger.value_mps.value - _BELOW_MPS)
            kind = GroundCommandKind.SET_SPEED
            commands.append(GroundCommand(agent=row, kind=kind, value=value))
            self._events.remove(event)
        return commands

    def _let_up(self, tick: int, dt_s: float, seen: Observation) -> list[GroundCommand]:
        """Let who has been as fast as an event waits for drive on so that a UAV keeps up."""
        commands = []
        for event in tuple(self._fast):
            trigger = event.trigger
            assert isinstance(trigger, SpeedTrigger)
            row = self._roster.agent_index(trigger.who)
            speed_mps = seen.speed_mps(trigger.who)
            if row is None or speed_mps is None or speed_mps <= trigger.value_mps.value:
                self._driven.pop(event.id, None)
                continue
            since = self._driven.setdefault(event.id, tick)
            if (tick - since) * dt_s < _FAST_S:
                continue
            value = _KEPT_UP_SHARE * self._most_mps
            kind = GroundCommandKind.SET_SPEED
            commands.append(GroundCommand(agent=row, kind=kind, value=value))
            self._fast.remove(event)
        return commands

    def _drive(self, event: Event, trigger: SpeedTrigger, seen: Observation) -> bool:
        """Tell whether who is waited for, and who is to answer, are on the move."""
        speed_mps = seen.speed_mps(trigger.who)
        least_mps = self._stated_mps.get(trigger.who, 0.0)
        if speed_mps is None or speed_mps <= trigger.value_mps.value or speed_mps < least_mps:
            return False
        if not isinstance(event.action, AgentAction):
            return True
        answer_mps = seen.speed_mps(event.action.agent)
        row = self._roster.agent_index(event.action.agent)
        if answer_mps is None or row is None:
            return False
        return answer_mps >= on_the_move_mps(is_person=self._roster.agents[row].is_person)


def _is_outrun(spec: ScenarioSpec, event: Event, most_mps: float) -> bool:
    """Tell whether an event waits for a speed at which a UAV loses who is not asked to keep it."""
    trigger = event.trigger
    if not isinstance(trigger, SpeedTrigger) or trigger.on != 'speed_above':
        return False
    agent = next((a for a in spec.agents if a.id == trigger.who), None)
    tracked = any(m.mode is MissionMode.TRACK and m.target == trigger.who for m in spec.missions)
    if agent is None or not tracked or trigger.value_mps.value < _OUTRUN_SHARE * most_mps:
        return False
    return all(b.speed_mps is None for b in agent.behaviors)


def _is_left_to_chance(spec: ScenarioSpec, event: Event) -> bool:
    """Tell whether an event waits for a low speed of a driver whose speed nothing else decides."""
    trigger = event.trigger
    if not isinstance(trigger, SpeedTrigger) or trigger.on != 'speed_below':
        return False
    agent = next((a for a in spec.agents if a.id == trigger.who), None)
    if agent is None:
        return False
    told = any(
        isinstance(e.action, AgentAction) and e.action.agent == agent.id for e in spec.events
    )
    decided = any(
        b.kind in _DECIDE_SPEED
        or (b.speed_mps is not None and b.speed_mps.value <= trigger.value_mps.value)
        for b in agent.behaviors
    )
    return not told and not decided
