# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where UAVs start: on free spots, and so that the ways to their first points never cross."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.beside import side_first
from aurora_core.grounding.crossings import way_over
from aurora_core.grounding.spots import Point2, SpotFinder
from aurora_core.mission.plan import UavPlan

Point3 = tuple[float, float, float]

# A start at a distance is looked for in so many directions, on so many spots in each.
_DIRECTIONS, _SPOTS = 12, 3
# And so many near where it flies first.
_SPOTS_LOOKED_AT = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class Starts:
    """Finds where a UAV can start.

    Attributes:
        spots: Free spots of the map.
        airspace: The way up and to the first point is free.
        clearance_m: Of that way.
        apart_m: Distance of two starts.
        wide: They are farther apart than usual: more spots are looked at.
    """

    spots: SpotFinder
    airspace: Airspace
    clearance_m: float
    apart_m: float
    wide: bool

    def free(
        self,
        first: Point3,
        taken: Sequence[Point2],
        *,
        way_m: float = 0.0,
        beside: Point2 | None = None,
    ) -> Point2 | None:
        """Return the first spot that does, the nearest ones first; None for none.

        Args:
            first: Where the UAV flies first (x, y, z in m).
            taken: Starts of others.
            way_m: Least way from the start to `first`.
            beside: Where its target stands: spots on the side of `first` come first.
        """
        x, y, z = first
        if way_m:
            spots = self._around((x, y), way_m + self.apart_m)
        else:
            spots = self.spots.near(
                x, y, (_SPOTS_LOOKED_AT + 20 * len(taken)) * (4 if self.wide else 1)
            )
        if beside is not None:
            spots = side_first(spots, beside, (x, y))
        for spot in spots:
            away_m = norm2(spot[0] - x, spot[1] - y)
            apart = all(norm2(spot[0] - a, spot[1] - b) >= self.apart_m for a, b in taken)
            way = ((*spot, z), first)
            if apart and away_m >= way_m and self.airspace.way_is_free(way, self.clearance_m):
                return spot
        return None

    def lead_to(self, point: Point3) -> bool:
        """Tell whether a level way leads from a free spot to a point (x, y, z in m)."""
        x, y, z = point
        return any(
            self.airspace.way_is_free(((*spot, z), point), self.clearance_m)
            for spot in self.spots.near(x, y, _SPOTS_LOOKED_AT)
        )

    def over(
        self, first: Point3, taken: Sequence[Point2], top_m: float
    ) -> tuple[Point2, float] | None:
        """Return a spot, and how high the way from it has to be to come to a point from above.

        Args:
            first: Where the UAV flies first (x, y, z in m).
            taken: Starts of others.
            top_m: No way is higher.
        """
        x, y, _ = first
        for spot in self.spots.near(x, y, _SPOTS_LOOKED_AT + 20 * len(taken)):
            apart = all(norm2(spot[0] - a, spot[1] - b) >= self.apart_m for a, b in taken)
            low = (*spot, first[2])
            up_m = way_over(self.airspace, [low], first, self.clearance_m, top_m)
            if apart and up_m is not None:
                return spot, up_m
        return None

    def _around(self, centre: Point2, away_m: float) -> tuple[Point2, ...]:
        angles = [2.0 * pi * k / _DIRECTIONS for k in range(_DIRECTIONS)]
        ring = [(centre[0] + away_m * cos(a), centre[1] + away_m * sin(a)) for a in angles]
        return tuple(dict.fromkeys(s for at in ring for s in self.spots.near(*at, _SPOTS)))


def uncrossed(
    plans: Sequence[UavPlan],
    first_points: Sequence[Point3],
    airspace: Airspace,
    *,
    apart_m: float,
    clearance_m: float,
) -> tuple[UavPlan, ...]:
    """Exchange the starts of UAVs that fly at one height, by the least sum of squared distances.

    UAVs that move at the same time from such starts stay apart: at no moment are two of them
    nearer than their starts or goals, whichever are nearer, divided by the square root of two.
    That holds for goals that move together as well. Source: Turpin, Michael, Kumar 2014, "CAPT",
    theorem 3.2.

    Args:
        plans: All UAVs; each may start from the spot of each.
        first_points: (x, y, z) in m, ENU, where each goes first.
        airspace: The ways up and across are checked again.
        apart_m: UAVs whose first heights differ by less are at one height.
        clearance_m: Of the ways.

    Returns:
        The plans in their order; as they were where an exchanged way is not free.
    """
    order = sorted(range(len(plans)), key=lambda k: (first_points[k][2], k))
    exchanged = list(plans)
    for group in _levels(order, first_points, apart_m):
        homes = np.array([(plans[k].home_x_m, plans[k].home_y_m) for k in group])
        goals = np.array([first_points[k][:2] for k in group])
        for row, column in enumerate(_nearest_pairs(homes, goals)):
            k = group[row]
            exchanged[k] = _started_at(plans[k], homes[column])
    for plan, (x, y, z) in zip(exchanged, first_points, strict=True):
        way = ((plan.home_x_m, plan.home_y_m, z), (x, y, z))
        if not airspace.way_is_free(way, clearance_m):
            return tuple(plans)
    return tuple(exchanged)


def _nearest_pairs(homes: np.ndarray, goals: np.ndarray) -> list[int]:
    """Return which home each goal gets, by the least sum of squared distances."""
    if len(homes) == 1:
        return [0]
    # Imported here: one UAV by itself needs no solver, whose import takes half a second.
    from scipy.optimize import linear_sum_assignment

    squares = ((goals[:, None, :] - homes[None, :, :]) ** 2).sum(axis=2)
    _, chosen = linear_sum_assignment(squares)
    return [int(column) for column in chosen]


def _levels(order: list[int], points: Sequence[Point3], apart_m: float) -> list[list[int]]:
    levels = [[k] for k in order[:1]]
    for before, k in itertools.pairwise(order):
        if points[k][2] - points[before][2] < apart_m:
            levels[-1].append(k)
        else:
            levels.append([k])
    return levels


def _started_at(plan: UavPlan, home: np.ndarray) -> UavPlan:
    x, y = home.tolist()
    values = {**plan.model_dump(), 'home_x_m': x, 'home_y_m': y, 'landing_spots': ((x, y),)}
    return UavPlan.model_validate(values)
