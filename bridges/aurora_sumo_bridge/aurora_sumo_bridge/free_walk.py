# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A person's way over a street where no crosswalk is.

SUMO has persons on sidewalks and crossings only, so such a person is put at its place in every
step, as a parked vehicle is.
"""

from __future__ import annotations

import libsumo

from aurora_core.geometry.frames import heading_to_sumo_angle
from aurora_sumo_bridge.polyline import Point, polyline

# SUMO's own mode: the person may be anywhere.
_ANYWHERE = 2


class FreeWalk:
    """The way of one person, from its place to where it stands at last.

    Args:
        person: Its id.
        points: x, y (m, ENU), the first one is its place at t = 0.
        dt_s: Step length.

    Raises:
        ValueError: Fewer than two different points.
    """

    def __init__(self, person: str, points: tuple[Point, ...], dt_s: float) -> None:
        self._person = person
        self._line = polyline(points)
        self._dt_s = dt_s
        self._gone_m = 0.0
        self.speed_mps = 0.0

    @property
    def start(self) -> Point:
        """Where it begins (m, ENU)."""
        return self._line.points[0]

    @property
    def angle_deg(self) -> float:
        """Compass angle of the walk where the person is."""
        _, (tx, ty) = self._line.at(self._gone_m)
        return heading_to_sumo_angle(tx, ty)

    @property
    def rest(self) -> tuple[Point, Point]:
        """What is left of the way (m, ENU), as a straight line."""
        return self._line.at(self._gone_m)[0], self._line.points[-1]

    def step(self, speed_mps: float) -> None:
        """Walk on for one step; at the end of the way the person stands."""
        gone_m = min(self._gone_m + speed_mps * self._dt_s, self._line.length_m)
        self.speed_mps = (gone_m - self._gone_m) / self._dt_s
        self._gone_m = gone_m
        self.hold()

    def hold(self) -> None:
        """Ask for the place in the next step; SUMO lets go of it when it is not asked again."""
        (x, y), _ = self._line.at(self._gone_m)
        libsumo.person.moveToXY(self._person, '', x, y, self.angle_deg, _ANYWHERE)
