# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Orders changes of lane: whether one is possible now, to which lane, and whether it is over."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.execution.observe import Observation
from aurora_core.knowledge.settings import DrivingStyle
from aurora_core.knowledge.world import CentreLine, WorldModel
from aurora_core.quantities.lane_changes import (
    CENTRED_M,
    LANE_CHANGE_S,
    can_change,
    is_to_side,
    lanes_beside,
    other_lane,
)
from aurora_core.quantities.lanes import lanes_of_rows, off_lane_m
from aurora_core.spec.vocabulary import LaneSide
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundColumn, GroundCommandKind
from aurora_core.trace.roster import Roster

FloatArray = npt.NDArray[np.float64]

# The simulator's own changes of lane from an ordered one on, a SUMO bit set: only where the route
# needs them and not against the order, which avoids collisions and waits for no longer gaps.
ROUTE_CHANGES = 257.0

# For so long the new lane is kept, the change itself included (s).
_STAYS_S = LANE_CHANGE_S + 5.0


class LaneChanger:
    """Changes of lane of the ground agents of a run.

    Args:
        world: With the lanes.
        roster: Row order.
        driving_mps: Speed that counts as driving.
        style: When a lane is free.
    """

    def __init__(
        self, world: WorldModel, roster: Roster, driving_mps: float, style: DrivingStyle
    ) -> None:
        self._style = style
        self._world = world
        self._roster = roster
        self._driving_mps = driving_mps

    def lane(self, row: int, seen: Observation) -> int:
        """Return the lane that an agent is on, as an index in the world's lanes."""
        return int(lanes_of_rows(self._world, seen.ground(row)[None, :])[0])

    def goal(
        self, row: int, seen: Observation, *, side: LaneSide | None = None, back: bool = False
    ) -> int | None:
        """Return the lane that an agent can change to now, None when there is none.

        Args:
            row: Which agent.
            seen: States of the tick.
            side: Where the lane has to be; None: on any side.
            back: The lane to the right before the one to the left.
        """
        state = seen.ground(row)
        if not can_change(self._world, state[None, :], self._driving_mps, side)[0]:
            return None
        beside = lanes_beside(self._world, self.lane(row, seen), side)
        beside = beside[::-1] if back else beside
        return next((k for k in beside if self._is_free(k, row, seen)), None)

    def goal_beside(self, row: int, other: int, seen: Observation) -> int | None:
        """Return the lane of another agent where one can change to it now, else None."""
        wanted = self.lane(other, seen)
        if not can_change(self._world, seen.ground(row)[None, :], self._driving_mps)[0]:
            return None
        beside = wanted in lanes_beside(self._world, self.lane(row, seen))
        return wanted if beside and self._is_free(wanted, row, seen) else None

    def is_in_the_middle(self, row: int, seen: Observation) -> bool:
        """Tell whether an agent is in the middle of its lane."""
        lane = self._world.lanes[self.lane(row, seen)]
        return bool(off_lane_m(lane, seen.ground(row)[None, :])[0] <= CENTRED_M)

    def are_on_two(self, row: int, other: int, seen: Observation) -> bool | None:
        """Tell whether two agents are on two lanes of one street, None where on two streets."""
        own, wanted = self.lane(row, seen), self.lane(other, seen)
        if own == wanted:
            return False
        return True if other_lane(self._world, own, wanted) else None

    def commands(self, row: int, goal: int, *, stays_s: float = _STAYS_S) -> list[GroundCommand]:
        """Return what lets an agent change to a lane, and keep to it for some time (s)."""
        index = float(self._world.lanes[goal].lane_id.rpartition('_')[2])
        return [
            GroundCommand(
                agent=row, kind=GroundCommandKind.SET_LANE_CHANGE_MODE, value=ROUTE_CHANGES
            ),
            GroundCommand(
                agent=row, kind=GroundCommandKind.CHANGE_LANE, value=index, value2=stays_s
            ),
        ]

    def is_over(self, row: int, was: int, seen: Observation, side: LaneSide | None = None) -> bool:
        """Tell whether an agent is in the middle of another lane of its street.

        Args:
            row: Which agent.
            was: The lane that it was on when the change was ordered.
            seen: States of the tick.
            side: Of the other lane; None: any.
        """
        now = self.lane(row, seen)
        if not other_lane(self._world, was, now) or not is_to_side(self._world, was, now, side):
            return False
        return bool(off_lane_m(self._world.lanes[now], seen.ground(row)[None, :])[0] <= CENTRED_M)

    def _is_free(self, lane: int, row: int, seen: Observation) -> bool:
        others = range(len(self._roster.agents))
        return all(
            self._is_apart(row, other, seen)
            for other in others
            if other != row and self._is_on(self._world.lanes[lane], other, seen)
        )

    def _is_on(self, lane: CentreLine, row: int, seen: Observation) -> bool:
        state = seen.ground(row)
        off_m = off_lane_m(lane, state[None, :])[0]
        return bool(state[GroundColumn.PRESENT] > 0.5 and off_m <= lane.width_m / 2.0)

    def _is_apart(self, row: int, other: int, seen: Observation) -> bool:
        """Tell whether one is clear ahead or clear behind, now and with these speeds later."""
        x, y, hx, hy, speed = seen.ground(row)[: GroundColumn.SPEED + 1].tolist()
        to_x, to_y, _, _, other_speed = seen.ground(other)[: GroundColumn.SPEED + 1].tolist()
        now_m = (to_x - x) * hx + (to_y - y) * hy
        later_m = now_m + (other_speed - speed) * self._style.lane_free_s
        agents = self._roster.agents
        boxes_m = (agents[row].length_m + agents[other].length_m) / 2.0
        need_m = self._style.lane_free_m + boxes_m
        return bool(min(now_m, later_m) >= need_m or max(now_m, later_m) <= -need_m)
