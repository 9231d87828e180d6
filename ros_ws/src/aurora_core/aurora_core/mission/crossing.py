# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The way to a mission over what stands in between: up, across, down, or by given points."""

from __future__ import annotations

from aurora_core.geometry.kernel import norm2
from aurora_core.mission.setpoint import PursuitReference

Goal = tuple[tuple[float, float, float], tuple[float, float]]

# A point of a way is flown by once the set-point is so near (m).
_BY_M = 1.0
# So near to its height it turns to the way across, so near above its goal it goes down (m).
_UP_M = 0.5
_ABOVE_M = 2.0
# So far from the height of its way it has to come back to it (m).
_OFF_M = 1.5


class Crossing:
    """One crossing; over once it has been above its goal.

    Args:
        over_m: Height of the way across; None: straight.
        level: To the height of its goal first, wherever that leads, then across at it.

    Attributes:
        by: Points to fly by instead (x, y, z in m), as long as whoever looks ahead gives some.
        level: It is to be flown so, and has not come to its height yet.
    """

    def __init__(self, over_m: float | None, *, level: bool = False) -> None:
        self._over_m = over_m
        self.level = level
        self._from: tuple[float, float] | None = None
        self.by: tuple[tuple[float, float, float], ...] = ()

    def goal(self, reference: PursuitReference, rest: tuple[float, float], goal: Goal) -> Goal:
        """Return where to go next, a point and its velocity, on the way to a goal.

        Args:
            reference: Where the set-point is.
            rest: Where it would come to rest (x, y in m).
            goal: The point (x, y, z in m) to get to, and its velocity (m/s).
        """
        if self.by:
            return self._next_point(reference), (0.0, 0.0)
        if self.level:
            self._from = rest if self._from is None else self._from
            self.level = abs(reference.z - goal[0][2]) > _UP_M
            return (*self._from, goal[0][2]), (0.0, 0.0)
        if self._over_m is None:
            return goal
        (x, y, _), velocity = goal
        if norm2(x - reference.x, y - reference.y) <= _ABOVE_M:
            self._over_m = None
            return goal
        if self._from is None:
            self._from = rest
        if reference.z < self._over_m - _UP_M:
            return (*self._from, self._over_m), (0.0, 0.0)
        return (x, y, self._over_m), velocity

    def straight(self) -> None:
        """Go on straight: whoever looks ahead sees that nothing is in between any more."""
        self._over_m, self.by = None, ()

    def level_off(self, off_m: float) -> None:
        """Go on at the height of the goal, so far (m) from it: nothing is in between there."""
        if self.by or self._over_m is not None or off_m > _OFF_M:
            self.straight()
            self.level, self._from = True, None

    def _next_point(self, reference: PursuitReference) -> tuple[float, float, float]:
        """Return the point of the given way that is next; the last one stays."""
        x, y, z = self.by[0]
        near = norm2(x - reference.x, y - reference.y) <= _BY_M and abs(z - reference.z) <= _BY_M
        if near and len(self.by) > 1:
            self.by = self.by[1:]
        return self.by[0]
