# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Let vehicles keep to others: behind them, level with them, or as far off on another lane.

The simulator's drivers mind only who is before them on their own lane. Once one of two has changed
lane, the other one would pass it, or stay behind somebody else; and who drives beside another one
would leave it behind. Who has braked to a standstill behind somebody would stand there for good.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass
from math import inf

from aurora_core.execution.lane_changer import LaneChanger
from aurora_core.execution.observe import Observation
from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.outcomes.grounded import GroundedAgent
from aurora_core.quantities.actions import SPEED_ACTIONS, ActionRules
from aurora_core.spec.own_events import keeps_to_lanes, own_events
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.scenario import AgentAction, GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.vocabulary import AgentType, BehaviorKind, Relation
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.roster import Roster

# Sides that a driver keeps to.
_BESIDE = frozenset({Relation.BESIDE, Relation.LEFT, Relation.RIGHT})
_IN_LINE = frozenset({Relation.AHEAD, Relation.BEHIND})
_NO_DRIVERS = frozenset({AgentType.PEDESTRIAN, AgentType.RSU})

# A smaller change of speed is not worth a command (m/s).
_NEW_MPS = 0.2

# An ordered change of lane is given this long before it is ordered again (s).
_AGAIN_S = 5.0


@dataclass(slots=True)
class _Following:
    """One that follows another one, or drives beside it.

    Attributes:
        row: Who follows.
        other: Whom.
        abreast: It is to be level with the other one, and on a lane of its own.
        off_m: So far the other one is to be ahead of it then, centre from centre (negative:
            behind it); None: as far as it is at first.
        changes: It may change lane after the other one.
        resumes: It drives on after the other one where it has braked to a standstill.
        paces: Its speed is nobody else's business.
        told_mps: Speed that it was told last, None when it drives by itself.
        ordered_s: When it was told to change lane.
        stands_s: Since when it stands, None when it does not.
    """

    row: int
    other: int
    changes: bool
    paces: bool
    abreast: bool = False
    off_m: float | None = 0.0
    resumes: bool = False
    told_mps: float | None = None
    ordered_s: float = -_AGAIN_S
    stands_s: float | None = None


class Follower:
    """Those who follow others in a run.

    Args:
        spec: The request.
        roster: Row order.
        agents: As they are grounded.
        lanes: Orders changes of lane.
        drive: Gives the command that lets the agent of a row drive on.
        style: The gap that they keep.
        rules: When one has stopped.
    """

    def __init__(
        self,
        spec: ScenarioSpec,
        roster: Roster,
        agents: Sequence[GroundedAgent],
        lanes: LaneChanger,
        drive: Callable[[int], GroundCommand],
        style: DrivingStyle,
        rules: ActionRules,
    ) -> None:
        self._style = style
        self._rules = rules
        self._roster = roster
        self._lanes = lanes
        self._drive = drive
        self._following = [*_followings(spec, roster), *_companions(spec, roster, agents)]

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
            if one.abreast:
                commands += self._level(one, other, seen)
                continue
            apart = self._lanes.are_on_two(one.row, one.other, seen)
            if apart and one.changes and now_s >= one.ordered_s + _AGAIN_S:
                goal = self._lanes.goal_beside(one.row, one.other, seen)
                if goal is not None:
                    one.ordered_s = now_s
                    commands += self._lanes.commands(one.row, goal)
            commands += self._paced(one, other, apart, seen)
            commands += self._resumed(one, other, now_s, seen)
        return commands

    def _resumed(
        self, one: _Following, other: str, now_s: float, seen: Observation
    ) -> list[GroundCommand]:
        """Return what lets one drive on that has stood behind another one that goes on."""
        own_mps = seen.speed_mps(self._roster.agents[one.row].body_id)
        if not one.resumes or own_mps is None or own_mps >= self._rules.stop_mps:
            one.stands_s = None
            return []
        if one.stands_s is None:
            one.stands_s = now_s
        lead_mps = seen.speed_mps(other)
        goes_on = lead_mps is not None and lead_mps >= self._rules.start_mps
        if not goes_on or now_s < one.stands_s + self._rules.stop_hold_s:
            return []
        one.stands_s = now_s
        return [self._drive(one.row)]

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
        return self._at(one, lead_mps + self._style.follow_gain_hz * (gap_m - wanted_m))

    def _level(self, one: _Following, other: str, seen: Observation) -> list[GroundCommand]:
        """Return what keeps one level with another one, or as far off as it is to be."""
        beside_mps = seen.speed_mps(other)
        ahead_m = seen.centre_ahead_m(one.row, other)
        one.off_m = ahead_m if one.off_m is None else one.off_m
        if beside_mps is None or abs(ahead_m) > self._style.follow_lost_m:
            if one.told_mps is None:
                return []
            one.told_mps = None
            return [self._drive(one.row)]
        return self._at(one, beside_mps + self._style.follow_gain_hz * (ahead_m - one.off_m))

    def _at(self, one: _Following, wanted_mps: float) -> list[GroundCommand]:
        """Return the command of a speed, none where the last one does."""
        wanted_mps = max(0.0, wanted_mps)
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
                    resumes=does & (SPEED_ACTIONS | {'yield'}) == {'brake'},
                )


def _companions(
    spec: ScenarioSpec, roster: Roster, agents: Sequence[GroundedAgent]
) -> Iterator[_Following]:
    """Yield who keeps to whom on the lane beside: who is told no speed, else the faster one.

    A vehicle keeps to who walks beside it.
    """
    top_mps = {agent.id: _top_mps(agent) for agent in agents}
    bodies = {agent.id: agent for agent in spec.agents if agent.type is not AgentType.RSU}
    drivers = {agent.id for agent in spec.agents if agent.type not in _NO_DRIVERS}
    acting = {
        event.action.agent
        for event in (*spec.events, *own_events(spec))
        if isinstance(event.action, AgentAction) and event.action.do in SPEED_ACTIONS | {'yield'}
    }
    for agent in spec.agents:
        for placed in agent.placements:
            sided = placed.relation in _BESIDE or _is_on_two_lanes(agent, placed)
            pair = [bodies.get(name or '') for name in (agent.id, placed.of)]
            free = [
                a
                for a in pair
                if a is not None and a.id in drivers and a.id not in acting and not _told(a)
            ]
            if not sided or not placed.kept_in_motion or None in pair or not free:
                continue
            rows = [roster.agent_index(a.id) for a in pair if a is not None]
            one = max(free, key=lambda a: top_mps.get(a.id, inf))
            row, other = rows if one is pair[0] else reversed(rows)
            # What the agent is ahead by the other one is behind.
            off_m = _ahead_m(placed) if one is pair[1] else _opposite(_ahead_m(placed))
            if row is not None and other is not None:
                yield _Following(
                    row=row, other=other, changes=False, paces=True, abreast=True, off_m=off_m
                )


def _is_on_two_lanes(agent: GroundAgent, placed: Placement) -> bool:
    """Tell whether who is ahead of another one, or behind it, is on the lane beside."""
    beside = any(
        p.relation is Relation.ADJACENT_LANE and p.of == placed.of for p in agent.placements
    )
    return beside and placed.relation in _IN_LINE


def _ahead_m(placed: Placement) -> float | None:
    """Return how far who is placed is ahead of the other one, None where nobody says."""
    if placed.relation in _BESIDE:
        return 0.0
    if placed.distance_m is None:
        return None
    sign = 1.0 if placed.relation is Relation.AHEAD else -1.0
    return sign * placed.distance_m.value


def _opposite(off_m: float | None) -> float | None:
    return None if off_m is None else -off_m


def _top_mps(agent: GroundedAgent) -> float:
    """Return the greatest speed that an agent reaches: of its type, or what it holds."""
    known = (agent.top_speed_mps, agent.drive_speed_mps)
    return min((mps for mps in known if mps is not None), default=inf)


def _told(agent: GroundAgent) -> bool:
    """Return whether the speed of an agent is stated."""
    speeds = (b.speed_mps for b in agent.behaviors)
    return any(s is not None and s.provenance is Provenance.EXPLICIT for s in speeds)
