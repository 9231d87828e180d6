# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which UAV starts where, so that the ways to their first points never cross."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from aurora_core.grounding.airspace import Airspace
from aurora_core.mission.plan import UavPlan

Point3 = tuple[float, float, float]


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
