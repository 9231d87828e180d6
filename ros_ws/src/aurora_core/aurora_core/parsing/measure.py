# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A stated quantity, as `measures` reads it."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.spec.parameter import Bound

LENGTH, TIME, SPEED, RATIO, ANGLE, COUNT = 'length', 'time', 'speed', 'ratio', 'angle', 'count'
ACCELERATION, RATE = 'acceleration', 'rate'
UNREADABLE = 'unreadable'
# Between a number and its unit: `20 consecutive seconds`.
UNBROKEN = frozenset(
    {'consecutive', 'uninterrupted', 'unbroken', 'continuous', 'straight', 'successive'}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Measure:
    """A stated quantity in SI (angles in degrees, ratios 0..1).

    Attributes:
        dimension: length, time, speed, acceleration, ratio, angle, rate (1/s), count (no unit) or
            unreadable.
        value: In SI.
        start: First character of the number (qualifiers such as `about` are outside).
        end: One past the last character of the unit.
        upper: Upper end of a stated range.
        second: The other side of a size (`100 x 60 m`).
        second_start: Where the second number begins.
    """

    dimension: str
    value: float
    start: int
    end: int
    bound: Bound = Bound.EXACTLY
    approximate: bool = False
    upper: float | None = None
    second: float | None = None
    second_start: int | None = None
