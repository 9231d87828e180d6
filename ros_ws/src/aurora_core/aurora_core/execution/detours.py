# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ways of UAVs that nobody could plan: over what stands between, or round what is too high.

Where a target will be when an event sets a UAV on it is not known before, nor where the UAV itself
will be when an event, or the end of a tracking, sends it elsewhere: the way there is looked at as
it is flown.
"""

from __future__ import annotations

from heapq import heappop, heappush
from itertools import pairwise
from math import ceil, floor

import numpy as np
import numpy.typing as npt

from aurora_core.execution.level_ways import NEIGHBOURS, SPARE_M, level_way
from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.mission.machine import MissionMachine, TargetMotion
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavColumn

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

Point2 = tuple[float, float]
Point3 = tuple[float, float, float]

# Plain name: before Python 3.12 a member is slow to look up, and each tick asks.
_TRACK = MissionMode.TRACK
# The way is looked at so often, and a detour is planned again so often (s).
_LOOKS_EVERY_S = 0.5
_PLANS_EVERY_S = 2.0
# A straight way with less than the least clearance and so much is left, and a detour keeps that
# much more (m).
_WIDE_M = 2.0
# A metre up or down takes as long as so many across.
_SLOWER = 4.0
# Heights are tried in such steps (m).
_HIGHER_M = 10.0
# Ways round are looked for on a grid that is so fine, and so much wider than the way (m).
_GRID_M = 15.0
_BESIDE_M = 200.0


class Detours:
    """Plans the ways of UAVs to moving targets, and from wherever they are to their next mission.

    Args:
        airspace: What stands in the way.
        clearance_m: That every flight keeps.
        top_m: No way is higher.
    """

    def __init__(self, airspace: Airspace, clearance_m: float, top_m: float) -> None:
        self._air = airspace
        self._clearance_m = clearance_m
        self._top_m = top_m

    def look_ahead(
        self,
        tick: int,
        dt_s: float,
        machine: MissionMachine,
        state: FloatArray,
        target: TargetMotion | None,
    ) -> None:
        """Let a UAV on a way that was not planned fly over, or round, what is between.

        Args:
            tick: Of the state.
            dt_s: Time step.
            machine: Of the UAV.
            state: (UAV_WIDTH,) row of the UAV.
            target: Motion of the body that it follows.
        """
        if machine.captured or tick % round(_LOOKS_EVERY_S / dt_s):
            return
        x, y, z = state[UavColumn.X : UavColumn.Z + 1].tolist()
        if machine.staying is not None:
            self._keep_clear(machine, z)
            return
        goal = _goal(machine, target)
        if goal is None or (_levels_off(machine) and self._stays_level(machine, state, goal)):
            return
        if self.is_straight((x, y, z), goal):
            machine.way_there.straight()
        elif not machine.way_there.by or tick % round(_PLANS_EVERY_S / dt_s) == 0:
            machine.way_there.by = self.way((x, y, z), goal)

    def _keep_clear(self, machine: MissionMachine, z: float) -> None:
        """Let who stays where it is stay as high, too, where its own height is not free there."""
        mission, at = machine.mission, None if machine.staying is None else machine.staying.at
        if mission is None or at is None or mission.keeps_level:
            return
        up_or_down = ((*at, z), (*at, mission.altitude_m))
        if self._free(up_or_down, self._clearance_m):
            machine.way_there.straight()
        elif not machine.way_there.by:
            machine.way_there.by = ((*at, z),)

    def _stays_level(self, machine: MissionMachine, state: FloatArray, goal: Point3) -> bool:
        """Tell whether a UAV needs no other way than at the height of its goal; let it fly that.

        Where there is none it comes as it would otherwise.
        """
        way, here = machine.way_there, (*machine.stop_point(state), float(state[UavColumn.Z]))
        foot = (*here[:2], goal[2])
        if way.by[-1:] == (goal,):
            return True  # who leaves the bends of such a way would cut its corners
        if self._free((here, foot, goal), self._clearance_m + SPARE_M):
            way.level_off(abs(here[2] - goal[2]))
            return True
        if way.level:
            way.by, way.level = level_way(self._air, here, goal, self._clearance_m), False
        return bool(way.by) or _is_planned(machine)

    def is_straight(self, here: Point3, goal: Point3) -> bool:
        """Tell whether the straight way is free at both heights."""
        return all(
            self._free(((*here[:2], z), (*goal[:2], z)), self._clearance_m + SPARE_M)
            for z in sorted({here[2], goal[2]})
        )

    def way(self, here: Point3, goal: Point3) -> tuple[Point3, ...]:
        """Return the points to fly by before the goal; none where no way is found."""
        ways = (self._over(here, goal), self._round(here, goal))
        found = [way for way in ways if way]
        return min(found, key=lambda way: _length_m(here, (*way, goal)), default=())

    def _free(self, way: tuple[Point3, ...], clearance_m: float) -> bool:
        return self._air.way_is_free(way, clearance_m)

    def _over(self, here: Point3, goal: Point3) -> tuple[Point3, ...]:
        """Return the way up and across at the lowest height that is free."""
        wide_m = self._clearance_m + _WIDE_M
        height_m = max(here[2], goal[2]) + _HIGHER_M
        while height_m <= self._top_m:
            up, above = (*here[:2], height_m), (*goal[:2], height_m)
            if self._free((here, up, above, goal), wide_m):
                return up, above
            height_m += _HIGHER_M
        return ()

    def _round(self, here: Point3, goal: Point3) -> tuple[Point3, ...]:
        """Return the shortest way at the greater of both heights on a grid round the straight."""
        z_m, wide_m = max(here[2], goal[2]), self._clearance_m + _WIDE_M
        low = [floor((min(a, b) - _BESIDE_M) / _GRID_M) for a, b in zip(here, goal, strict=True)]
        high = [ceil((max(a, b) + _BESIDE_M) / _GRID_M) for a, b in zip(here, goal, strict=True)]
        xs, ys = (
            np.arange(low[k], high[k] + 1, dtype=np.float64) * np.float64(_GRID_M) for k in (0, 1)
        )
        grid = np.stack([*np.meshgrid(xs, ys, indexing='ij'), np.full((len(xs), len(ys)), z_m)])
        clear_m = self._air.obstacles.clearance_series(grid.reshape(3, -1).T)
        # Between two neighbours that are so far from everything the way keeps its clearance.
        free = clear_m.reshape(len(xs), len(ys)) >= wide_m + 0.75 * _GRID_M
        first, last = _nearest(free, xs, ys, here[:2]), _nearest(free, xs, ys, goal[:2])
        if first is None or last is None:
            return ()
        cells = _shortest(free, first, last)
        points = [(float(xs[i]), float(ys[j]), z_m) for i, j in cells]
        return self._short_cut((*here[:2], z_m), points, wide_m)

    def _short_cut(
        self, here: Point3, points: list[Point3], clearance_m: float
    ) -> tuple[Point3, ...]:
        """Leave out the points of a way that need not be flown by."""
        found: list[Point3] = []
        while points:
            far = len(points) - 1
            while far > 0 and not self._free((here, points[far]), clearance_m):
                far //= 2
            here = points[far]
            found.append(here)
            points = points[far + 1 :]
        return tuple(found)


def _goal(machine: MissionMachine, target: TargetMotion | None) -> Point3 | None:
    """Return where a way leads that nobody planned, None where one did."""
    mission = machine.mission
    if mission is None:
        return None
    if mission.mode is _TRACK:
        if target is None:
            return None
        x_m, y_m = mission.offset_m
        return target.x_m + x_m, target.y_m + y_m, mission.altitude_m
    point = mission.waypoints[0] if mission.waypoints else mission.hover_point
    if point is None or not _levels_off(machine):
        return None if _is_planned(machine) else point
    return (*point[:2], machine.altitude_m(mission))


def _before(machine: MissionMachine) -> MissionPlan | None:
    """Return the mission before the present one, None for the first."""
    assert machine.mission is not None
    index = machine.plan.missions.index(machine.mission)
    return machine.plan.missions[index - 1] if index > 0 else None


def _is_planned(machine: MissionMachine) -> bool:
    """Tell whether the way to the present mission was planned: where it begins is known before."""
    mission, before = machine.mission, _before(machine)
    unknown = before is not None and (before.mode is _TRACK or not before.is_placed)
    return mission is not None and (before is None or not (mission.waits or unknown))


def _levels_off(machine: MissionMachine) -> bool:
    """Tell whether the present mission comes to its height before its way."""
    mission = machine.mission
    return mission is not None and mission.level_way and _before(machine) is not None


def _length_m(here: Point3, way: tuple[Point3, ...]) -> float:
    """Return how long a way is (m); up and down are slower than across."""
    return sum(
        norm2(b[0] - a[0], b[1] - a[1]) + _SLOWER * abs(b[2] - a[2])
        for a, b in pairwise((here, *way))
    )


def _nearest(
    free: BoolArray, xs: FloatArray, ys: FloatArray, point: Point2
) -> tuple[int, int] | None:
    """Return the free cell nearest to a point, None where there is none."""
    rows, columns = np.nonzero(free)
    if len(rows) == 0:
        return None
    away = (xs[rows] - point[0]) ** 2 + (ys[columns] - point[1]) ** 2
    best = int(np.argmin(away))
    return int(rows[best]), int(columns[best])


def _shortest(
    free: BoolArray, first: tuple[int, int], last: tuple[int, int]
) -> list[tuple[int, int]]:
    """Return the cells of the shortest way between two free cells, none where there is no way."""
    queue = [(0.0, 0.0, first)]
    before: dict[tuple[int, int], tuple[int, int]] = {}
    cost = {first: 0.0}
    while queue:
        _, so_far, cell = heappop(queue)
        if cell == last:
            way = [cell]
            while way[-1] != first:
                way.append(before[way[-1]])
            return way[::-1]
        if so_far > cost[cell]:
            continue
        for i, j in NEIGHBOURS:
            onward = (cell[0] + i, cell[1] + j)
            inside = 0 <= onward[0] < free.shape[0] and 0 <= onward[1] < free.shape[1]
            if not inside or not free[onward]:
                continue
            length = so_far + norm2(float(i), float(j))
            if length < cost.get(onward, float('inf')) - 1e-9:
                cost[onward], before[onward] = length, cell
                left = norm2(float(last[0] - onward[0]), float(last[1] - onward[1]))
                heappush(queue, (length + left, length, onward))
    return []
