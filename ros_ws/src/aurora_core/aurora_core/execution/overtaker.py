# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Let vehicles overtake: pull out behind the other one, pass it, and pull in again ahead of it.

A driver that the simulator leaves to itself stays behind where it has no reason to hurry.
"""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.execution.lane_changer import LaneChanger
from aurora_core.execution.observe import Observation
from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.spec.own_events import overtakings
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn
from aurora_core.trace.roster import Roster

# Who is in the lane to the right is so far to the right (m): half a lane and more, not two.
_BESIDE_M = (1.5, 5.0)


@dataclass(slots=True)
class _Passing:
    """One overtaking: `row` passes `others`.

    Attributes:
        is_out: It has pulled out.
        done: It has pulled in again, or is over all lanes that it could.
    """

    row: int
    others: tuple[int, ...]
    is_out: bool = False
    done: bool = False


class Overtaker:
    """The overtakings of a run.

    Args:
        spec: The request.
        roster: Row order.
        lanes: Orders changes of lane.
        style: When they pull out and in.
    """

    def __init__(
        self, spec: ScenarioSpec, roster: Roster, lanes: LaneChanger, style: DrivingStyle
    ) -> None:
        self._roster = roster
        self._style = style
        self._lanes = lanes
        passed: dict[int, list[int]] = {}
        for agent, other in overtakings(spec):
            row, index = roster.agent_index(agent), roster.agent_index(other)
            if row is not None and index is not None:
                passed.setdefault(row, []).append(index)
        self._passing = [_Passing(row=row, others=tuple(rows)) for row, rows in passed.items()]

    def step(self, seen: Observation) -> list[GroundCommand]:
        """Return the commands of a tick."""
        if not self._passing:
            return []
        return [c for one in self._passing if not one.done for c in self._step(one, seen)]

    def _step(self, one: _Passing, seen: Observation) -> list[GroundCommand]:
        agents = self._roster.agents
        if not one.is_out:
            gaps_m = [seen.ahead_m(one.row, agents[other].body_id) for other in one.others]
            if not any(0.0 < gap_m <= self._style.overtake_out_m for gap_m in gaps_m):
                return []
            goal = self._lanes.goal(one.row, seen)
            if goal is None:
                return []
            one.is_out = True
            return self._lanes.commands(one.row, goal, stays_s=self._style.overtake_lane_s)
        own = agents[one.row].body_id
        if any(seen.ahead_m(other, own) < self._style.overtake_in_m for other in one.others):
            return []
        goal = self._lanes.goal(one.row, seen, back=True)
        if goal is None or not self._has_room(one.row, seen):
            return []
        one.done = True
        return self._lanes.commands(one.row, goal)

    def _has_room(self, row: int, seen: Observation) -> bool:
        """Tell whether nobody drives so near in the lane to the right that it would have to brake.

        Who drives close ahead of those that were overtaken is passed, too.
        """
        own, room_m = self._roster.agents[row], self._style.overtake_in_m
        x, y, hx, hy = seen.ground(row)[: GroundColumn.HEADING_Y + 1].tolist()
        for index, other in enumerate(self._roster.agents):
            motion = seen.motion(other.body_id)
            if index == row or other.is_person or motion is None:
                continue
            right_m = (motion.x_m - x) * hy - (motion.y_m - y) * hx
            same_way = motion.heading_x * hx + motion.heading_y * hy > 0.0
            gap_m = seen.ahead_m(row, other.body_id)
            behind_m = -gap_m - own.length_m - other.length_m
            near = gap_m < room_m and behind_m < room_m
            if same_way and near and _BESIDE_M[0] < right_m < _BESIDE_M[1]:
                return False
        return True
