# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where other UAVs are when a mission is planned: over which points, and on which routes when."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from math import inf

import numpy as np
import shapely

from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.kernel import norm2
from aurora_core.geometry.sight_line import Point3
from aurora_core.mission.plan import MissionPlan

# Two that begin together may begin so many seconds apart: starts and ways to them differ.
_LATER_S = (-4.0, -2.0, 0.0, 2.0, 4.0)
_STEP_S = 0.5
# A sequence of missions is not timed before the run: only where both fly their first ones.
_ROUNDING_M = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class Neighbours:
    """Other UAVs.

    Attributes:
        points: Where they hover, as near to a height as they get.
        routes: What they fly first.
        apart_m: Distance at one height.
        layer_m: Difference of heights at which they may be over each other.
        share: Which one of how many over one point this is.
    """

    points: tuple[Point3, ...] = ()
    routes: tuple[MissionPlan, ...] = ()
    apart_m: float = 0.0
    layer_m: float = 0.0
    share: tuple[int, int] = (0, 1)

    def leave(self, point: Point3) -> bool:
        """Tell whether somebody may hover at a point."""
        return all(
            norm2(norm2(point[0] - x, point[1] - y), point[2] - z) >= self.apart_m - _ROUNDING_M
            or abs(point[2] - z) >= self.layer_m - _ROUNDING_M
            for x, y, z in self.points
        ) and all(
            _line(route).distance(shapely.Point(point[:2])) >= self.apart_m - _ROUNDING_M
            for route in self._at(point[2])
        )

    def gap_m(self, plan: MissionPlan) -> float:
        """Return how near the others get to a route, begun when they begin; infinite for none."""
        own = _line(plan)
        level = [p for p in self.points if abs(p[2] - plan.altitude_m) < self.layer_m]
        gaps = [float(own.distance(shapely.Point(point[:2]))) for point in level]
        gaps += [_least_m(plan, own, route, self.apart_m) for route in self._at(plan.altitude_m)]
        return min(gaps, default=inf)

    def _at(self, height_m: float) -> Iterator[MissionPlan]:
        return (r for r in self.routes if abs(r.altitude_m - height_m) < self.layer_m)


NOBODY = Neighbours()


def _line(plan: MissionPlan) -> shapely.Geometry:
    """Return the route as seen from above."""
    points = [point[:2] for point in plan.waypoints]
    return shapely.LineString(points) if len(points) > 1 else shapely.Point(points[0])


def _least_m(
    plan: MissionPlan, own: shapely.Geometry, other: MissionPlan, enough_m: float
) -> float:
    """Return how near two get: on their routes at all, where that is enough, else in flight."""
    apart_m = float(own.distance(_line(other)))
    if apart_m >= enough_m or other.speed_mps <= 0.0 or plan.speed_mps <= 0.0:
        return apart_m
    least_m = inf
    for later_s in _LATER_S:
        one, two = _flown(plan, max(0.0, later_s)), _flown(other, max(0.0, -later_s))
        ticks = max(len(one), len(two))
        gaps = _held(one, ticks) - _held(two, ticks)
        least_m = min(least_m, float(np.hypot(gaps[:, 0], gaps[:, 1]).min()))
    return least_m


def _flown(plan: MissionPlan, later_s: float) -> FloatArray:
    """Return where a UAV is every half second (K, 2), first so long at the beginning."""
    points = np.array([point[:2] for point in plan.waypoints])
    legs = [norm2(*(b - a)) for a, b in pairwise(points)]
    marks = np.concatenate(([0.0], np.cumsum(legs)))
    count = int(marks[-1] / plan.speed_mps / _STEP_S) + 2
    way = np.minimum(np.arange(count) * _STEP_S * plan.speed_mps, marks[-1])
    found = np.column_stack([np.interp(way, marks, points[:, k]) for k in (0, 1)])
    waits = np.repeat(found[:1], round(later_s / _STEP_S), axis=0)
    return np.concatenate((waits, found))


def _held(points: FloatArray, count: int) -> FloatArray:
    """Return as many points, the last one again and again."""
    return np.concatenate((points, np.repeat(points[-1:], count - len(points), axis=0)))
