# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ways at the height of their goal: down, or up, at the nearest place that lets it, then round.

Looked for on a grid, with plain arithmetic alone: whoever recomputes a run finds the same way.
"""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush
from itertools import product
from math import ceil, floor, inf

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

Point2 = tuple[float, float]
Point3 = tuple[float, float, float]
Cell = tuple[int, int]

NEIGHBOURS = tuple((i, j) for i in (-1, 0, 1) for j in (-1, 0, 1) if (i, j) != (0, 0))
# A way that is straight, or level, keeps so much more than the least clearance (m).
SPARE_M = 0.5
# The grid is so fine, and so much wider than the straight way (m).
_GRID_M = 3.0
_BESIDE_M = 120.0
# Who cannot come to its height where it is does so elsewhere: so far away (m), in so many
# directions (ahead, left; of any length).
_LEAVES_M = tuple(5.0 * k for k in range(21))
_TURNS = (
    (1.0, 0.0), (2.0, 1.0), (2.0, -1.0), (1.0, 1.0), (1.0, -1.0), (1.0, 2.0), (1.0, -2.0),
    (0.0, 1.0), (0.0, -1.0), (-1.0, 2.0), (-1.0, -2.0), (-1.0, 1.0), (-1.0, -1.0), (-2.0, 1.0),
    (-2.0, -1.0), (-1.0, 0.0),
)  # fmt: skip
# A metre at another height is as bad as so many at the right one.
_WORSE = 4.0


def level_way(
    airspace: Airspace, here: Point3, goal: Point3, clearance_m: float
) -> tuple[Point3, ...]:
    """Return a way that is at the height of its goal as soon as it can be.

    Args:
        airspace: What stands in the way.
        here: Where the UAV is (x, y, z in m).
        goal: Where it goes.
        clearance_m: That every flight keeps; the level part of the way keeps a little more.

    Returns:
        The points to fly by, the goal as the last; none where no such way is found.
    """

    wide_m = clearance_m + SPARE_M

    def free(*way: Point3) -> bool:
        return airspace.way_is_free(way, wide_m)

    foot = (*here[:2], goal[2])
    if free(here, foot, goal):
        return foot, goal
    grid = _Grid(airspace, here[:2], goal, wide_m)
    best, least = None, inf
    for above in _places(here, goal):
        foot = (*above[:2], goal[2])
        leaves_m = norm2(above[0] - here[0], above[1] - here[1])
        way_m = grid.way_m(foot[:2])
        cost = _WORSE * leaves_m + way_m
        if cost < least and free(above, foot) and airspace.way_is_free((here, above), clearance_m):
            best, least = above, cost
    if best is None:
        return ()
    foot = (*best[:2], goal[2])
    bends = _short_cut(foot, [*grid.way(foot[:2]), goal], free)
    way = (foot, *bends) if best == here else (best, foot, *bends)
    return way if free(foot, *bends) else ()


def _places(here: Point3, goal: Point3) -> tuple[Point3, ...]:
    """Return where a UAV may change its height, as high as it is: where it is first."""
    away_m = norm2(goal[0] - here[0], goal[1] - here[1])
    if away_m == 0.0:
        return (here,)
    ahead_x, ahead_y = (goal[0] - here[0]) / away_m, (goal[1] - here[1]) / away_m
    found = [here]
    for leaves_m, (along, left) in product(_LEAVES_M[1:], _TURNS):
        off_m = leaves_m / norm2(along, left)
        x = here[0] + off_m * (along * ahead_x - left * ahead_y)
        found.append((x, here[1] + off_m * (along * ahead_y + left * ahead_x), here[2]))
    return tuple(found)


class _Grid:
    """How far it is to a goal at its height, from every cell of a grid round the way."""

    def __init__(self, airspace: Airspace, here: Point2, goal: Point3, clearance_m: float) -> None:
        self._z_m = goal[2]
        low = [floor((min(a, b) - _BESIDE_M) / _GRID_M) for a, b in zip(here, goal, strict=False)]
        high = [ceil((max(a, b) + _BESIDE_M) / _GRID_M) for a, b in zip(here, goal, strict=False)]
        self._low, self._shape = low, (high[0] - low[0] + 1, high[1] - low[1] + 1)
        xs, ys = (
            np.arange(low[k], high[k] + 1, dtype=np.float64) * np.float64(_GRID_M) for k in (0, 1)
        )
        points = np.stack([*np.meshgrid(xs, ys, indexing='ij'), np.full(self._shape, goal[2])])
        clear_m = airspace.obstacles.clearance_series(points.reshape(3, -1).T)
        # Between two neighbours that are so far from everything the way keeps its clearance.
        self._free = clear_m.reshape(self._shape) >= clearance_m + 0.75 * _GRID_M
        self._onward: dict[Cell, Cell] = {}
        self._cost = self._flood(goal[:2])

    def way_m(self, point: Point2) -> float:
        """Return how long the way from a point (x, y in m) is, infinite where there is none."""
        cell = self._cell(point)
        return inf if cell is None else _GRID_M * self._cost.get(cell, inf)

    def way(self, point: Point2) -> list[Point3]:
        """Return the way from a point with a finite one, cell by cell."""
        cell, found = self._cell(point), []
        while cell is not None:
            x, y = self._point(cell)
            found.append((x, y, self._z_m))
            cell = self._onward.get(cell)
        return found

    def _point(self, cell: Cell) -> Point2:
        return (self._low[0] + cell[0]) * _GRID_M, (self._low[1] + cell[1]) * _GRID_M

    def _cell(self, point: Point2) -> Cell | None:
        """Return the nearest free cell round a point, None where there is none."""
        i, j = (round(point[k] / _GRID_M) - self._low[k] for k in (0, 1))
        best, least = None, inf
        for di, dj in ((0, 0), *NEIGHBOURS):
            cell = i + di, j + dj
            if not self._is_free(cell):
                continue
            x, y = self._point(cell)
            away = norm2(x - point[0], y - point[1])
            if away < least:
                best, least = cell, away
        return best

    def _is_free(self, cell: Cell) -> bool:
        inside = 0 <= cell[0] < self._shape[0] and 0 <= cell[1] < self._shape[1]
        return inside and bool(self._free[cell])

    def _flood(self, goal: Point2) -> dict[Cell, float]:
        """Return how many cells it is to a goal, from all from which one comes there."""
        last = self._cell(goal)
        if last is None:
            return {}
        queue, cost = [(0.0, last)], {last: 0.0}
        while queue:
            so_far, cell = heappop(queue)
            if so_far > cost[cell]:
                continue
            for i, j in NEIGHBOURS:
                before = (cell[0] + i, cell[1] + j)
                length = so_far + norm2(float(i), float(j))
                if self._is_free(before) and length < cost.get(before, inf) - 1e-9:
                    cost[before], self._onward[before] = length, cell
                    heappush(queue, (length, before))
        return cost


def _short_cut(
    here: Point3, points: list[Point3], free: Callable[..., bool]
) -> tuple[Point3, ...]:
    """Leave out the points of a way that need not be flown by; the last one stays."""
    found: list[Point3] = []
    while points:
        far = len(points) - 1
        while far > 0 and not free(here, points[far]):
            far = far * 3 // 4
        here = points[far]
        found.append(here)
        points = points[far + 1 :]
    return tuple(found)
