# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A hover without a place: the UAV stays where the mission before has led it."""

from __future__ import annotations

from math import inf

from aurora_core.geometry.kernel import norm2
from aurora_core.trace.layout import UavColumn

_X, _Y = int(UavColumn.X), int(UavColumn.Y)
_VX, _VY = int(UavColumn.VX), int(UavColumn.VY)


class Staying:
    """One such hover: the set-point brakes to a halt, and where the UAV comes to rest it holds.

    Args:
        rest_mps: Slower than that over ground it is at rest.
    """

    def __init__(self, rest_mps: float) -> None:
        self._rest_mps = rest_mps
        self._goal: tuple[float, float] | None = None
        self._point: tuple[float, float] | None = None

    @property
    def at(self) -> tuple[float, float] | None:
        """Where the set-point goes (x, y in m), None before its first step."""
        return self._goal

    def goal(self, rest: tuple[float, float]) -> tuple[float, float]:
        """Return where the set-point goes (x, y in m): to where it came to rest at first.

        Args:
            rest: Where it would come to rest from where it is (x, y in m).
        """
        if self._goal is None:
            self._goal = rest
        return self._goal

    def away_m(self, state: list[float]) -> float:
        """Return how far a UAV is from where it came to rest, infinite before; asked each tick.

        Args:
            state: Row of the UAV.
        """
        x, y = state[_X], state[_Y]
        if self._point is None:
            if norm2(state[_VX], state[_VY]) >= self._rest_mps:
                return inf
            self._point = (x, y)
        return norm2(x - self._point[0], y - self._point[1])
