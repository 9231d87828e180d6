# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The side of a moving target: an offset that turns with its course, no faster than one can fly.

A target turns round a corner in a second or two; who is 25 m to its left then has 40 m to fly.
The offset goes round the target with a speed of its own, limited like every other motion, and the
velocity of that way is part of the reference.
"""

from __future__ import annotations

from math import sqrt

from aurora_core.geometry.kernel import norm2
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.quantities.motion import COURSE_MPS

# Speed round the target: what the target leaves of the UAV's own, within these bounds (m/s).
_ROUND_LEAST_MPS = 3.0
_ROUND_MOST_MPS = 8.0

# Half a turn: which way round nobody can tell. The half tangent of the angle has no bound there.
_OPPOSITE = 1e-9


class TurningOffset:
    """Goes round a target until it is on the side that was asked for.

    Args:
        offset_m: Where to be: metres ahead of the target, and to its left.
        settings: Limits of the reference motion.
        dt_s: Time step.
    """

    def __init__(
        self, offset_m: tuple[float, float], settings: FlightSettings, dt_s: float
    ) -> None:
        self._ahead_m, self._left_m = offset_m
        self._away_m = max(1.0, norm2(*offset_m))
        self._settings = settings
        self._dt = dt_s
        self._course: tuple[float, float] | None = None
        self._followed = (1.0, 0.0)
        self._round_mps = 0.0

    def step(
        self, velocity: tuple[float, float], heading: tuple[float, float]
    ) -> tuple[tuple[float, float], tuple[float, float]]:
        """Turn by one tick.

        Args:
            velocity: Of the target, m/s (ENU).
            heading: Of its body (unit vector), which counts until it moves.

        Returns:
            The offset from the target, metres (ENU), and its velocity against the target, m/s.
        """
        speed = norm2(*velocity)
        if speed > COURSE_MPS:
            self._course = (velocity[0] / speed, velocity[1] / speed)
        if self._course is None:
            self._course = self._followed = heading
        self._turn(self._course, speed)
        hx, hy = self._followed
        x = self._ahead_m * hx - self._left_m * hy
        y = self._ahead_m * hy + self._left_m * hx
        rate = self._round_mps / self._away_m
        return (x, y), (-rate * y, rate * x)

    def _turn(self, course: tuple[float, float], speed_mps: float) -> None:
        """Turn the followed course towards that of the target; counter-clockwise is positive."""
        (hx, hy), (cx, cy) = self._followed, course
        cross, along = hx * cy - hy * cx, 1.0 + hx * cx + hy * cy
        half = cross / along if along > _OPPOSITE else 1.0 / _OPPOSITE  # tan of half the angle
        way_m = 2.0 * self._away_m * abs(half)
        s = self._settings
        cap = min(_ROUND_MOST_MPS, max(_ROUND_LEAST_MPS, s.speed_max_mps - speed_mps))
        wanted = min(cap, s.position_gain_hz * way_m, sqrt(s.acceleration_mps2 * way_m))
        change = (wanted if half >= 0.0 else -wanted) - self._round_mps
        limit = s.acceleration_mps2 * self._dt
        self._round_mps += min(limit, max(-limit, change))
        step = self._round_mps * self._dt / (2.0 * self._away_m)
        # A turn by an angle whose half has this tangent, without sine or cosine.
        norm = 1.0 + step * step
        c, d = (1.0 - step * step) / norm, 2.0 * step / norm
        x, y = c * hx - d * hy, d * hx + c * hy
        length = norm2(x, y)
        self._followed = (x / length, y / length)
