# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The air that hovering UAVs keep for themselves: a column where one is to climb on the way."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from aurora_core.geometry.sight_line import Point3
from aurora_core.spec.scenario import ScenarioSpec, UavAction


@dataclass(frozen=True, slots=True)
class Column:
    """A point in the plane and the heights over it, ENU metres."""

    x_m: float
    y_m: float
    low_m: float
    high_m: float


def climbs_to_m(spec: ScenarioSpec, uav: str, height_m: float) -> float:
    """Return the greatest height that events make a UAV climb to, `height_m` where none does."""
    heights = [
        e.action.altitude_m.value
        for e in spec.events
        if isinstance(e.action, UavAction)
        and e.action.uav == uav
        and e.action.altitude_m is not None
    ]
    return max([height_m, *heights])


def columns(spec: ScenarioSpec, uav: str, points: Iterable[Point3 | None]) -> list[Column]:
    """Return the columns over the hover points of a UAV; None: no hover."""
    return [
        Column(p[0], p[1], p[2], climbs_to_m(spec, uav, p[2])) for p in points if p is not None
    ]


def nearest_points(others: Sequence[Column], low_m: float, high_m: float) -> tuple[Point3, ...]:
    """Return a point for each column that is as far from a hover at `low_m` as the two get.

    Args:
        others: Columns of other UAVs.
        low_m: Height of the hover.
        high_m: Height that it may climb to.
    """
    gaps = (max(0.0, c.low_m - high_m, low_m - c.high_m) for c in others)
    return tuple((c.x_m, c.y_m, low_m + gap) for c, gap in zip(others, gaps, strict=True))
