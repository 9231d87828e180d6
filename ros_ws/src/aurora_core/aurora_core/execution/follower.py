# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Let vehicles follow others that are on another lane: change after them, and stay behind.

The simulator's drivers mind only who is before them on their own lane. Once one of two has changed
lane, the other one would pass it, or stay behind somebody else.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass

from aurora_core.execution.lane_changer import LaneChanger
from aurora_core.execution.observe import Observation
from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.quantities.actions import SPEED_ACTIONS
from aurora_core.spec.own_events import keeps_to_lanes, own_events
from aurora_core.spec.scenario import AgentAction, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.roster import Roster

# A smaller change of speed is not worth a command (m/s).
_NEW_MPS = 0.2

# An ordered change of lane is given this long before it is ordered again (s).
_AGAIN_S = 5.0


@dataclass(slots=True)
class _Following:
    """One that follows another one.

    Attributes:
        row: Who follows.
        other: Whom.
        changes: It may change lane after the other one.
        paces: Its speed is nobody else's business.
        told_mps: Speed that it was told last, None when it drives by itself.
        ordered_s: When it was told to change lane.
    """

    row: int
    other: int
    changes: bool
    paces: bool
    told_mps: float | None = None
    ordered_s: float = -_AGAIN_S


class Follower:
    """Those who follow others in a run.

    Args:
        spec: The request.
        roster: Row order.
        lanes: Orders changes of lane.
        drive: Gives the command that lets the agent of a row drive on.
        style: The gap that they keep.
    """

    def __init__(
        self,
        spec: ScenarioSpec,
        roster: Roster,
        lanes: LaneChanger,
        drive: Callable[[int], GroundCommand],
        style: DrivingStyle,
    ) -> None:
        self._style = style
        self._roster = roster
        self._lanes = lanes
        self._drive = drive
        self._following = list(_followings(spec, roster))

    def step(self, tick: int, seen: Observation, held: Collection[int]) -> list[GroundCommand]:
        """Return the commands of a tick.

        Args:
            tick: Its number.
            seen: Its states.
            held: Rows that may not set off yet.
        """
        now_s = tick * self._roster.dt_s
        commands: list[GroundCommand] = []
        for one in self._following:
            other = self._roster.agents[one.other].body_id
            here = seen.motion(self._roster.agents[one.row].body_id) and seen.motion(other)
            if one.row in held or here is None:
                continue
            apart = self._lanes.are_on_two(one.row, one.other, seen)
            if apart and one.changes and now_s >= one.ordered_s + _AGAIN_S:
                goal = self._lanes.goal_beside(one.row, one.other, seen)
                if goal is not None:
                    one.ordered_s = now_s
                    commands += self._lanes.commands(one.row, goal)
            commands += self._paced(one, other, apart, seen)
        return commands

    def _paced(
        self, one: _Following, other: str, apart: bool | None, seen: Observation
    ) -> list[GroundCommand]:
        """Return what keeps one behind another one that is not before it on its lane."""
        lead_mps = seen.speed_mps(other)
        if not one.paces or lead_mps is None:
            return []
        # Who is changing lane comes to its new one first.
        starts = apart and self._lanes.is_in_the_middle(one.row, seen)
        if one.told_mps is None and not starts:
            return []
        gap_m = seen.ahead_m(one.row, other)
        if apart is False or abs(gap_m) > self._style.follow_lost_m:
            if one.told_mps is None:
                return []
            one.told_mps = None
            return [self._drive(one.row)]
        wanted_m = self._style.follow_gap_m + self._style.follow_gap_s * lead_mps
        wanted_mps = max(0.0, lead_mps + self._style.follow_gain_hz * (gap_m - wanted_m))
        if one.told_mps is not None and abs(wanted_mps - one.told_mps) < _NEW_MPS:
            return []
        one.told_mps = wanted_mps
        kind = GroundCommandKind.SET_SPEED
        return [GroundCommand(agent=one.row, kind=kind, value=wanted_mps)]


def _followings(spec: ScenarioSpec, roster: Roster) -> Iterator[_Following]:
    drivers = {agent.id for agent in spec.agents if keeps_to_lanes(agent)}
    acting = [
        (event.action.agent, event.action.do)
        for event in (*spec.events, *own_events(spec))
        if isinstance(event.action, AgentAction)
    ]
    for agent in spec.agents:
        does = {do for name, do in acting if name == agent.id}
        row = roster.agent_index(agent.id)
        for behavior in agent.behaviors:
            other = roster.agent_index(behavior.target or '')
            pair = {agent.id, behavior.target}
            if behavior.kind is not BehaviorKind.FOLLOW or not pair <= drivers:
                continue
            if row is not None and other is not None:
                yield _Following(
                    row=row,
                    other=other,
                    changes='change_lane' not in does,
                    paces=not does & (SPEED_ACTIONS | {'yield'}),
                )
