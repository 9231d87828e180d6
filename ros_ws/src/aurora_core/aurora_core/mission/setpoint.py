# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Set-point generators: a reference point that moves as the vehicle can, ahead of the autopilot.

The autopilot tracks position with a velocity feed-forward; limiting speed and acceleration of the
reference keeps the realised speed inside the limits and makes arrival times predictable.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import sqrt

from aurora_core.geometry.kernel import norm2, norm3
from aurora_core.quantities.waypoints import CORNER_COSINE


@dataclass(frozen=True, slots=True, kw_only=True)
class FlightSettings:
    """Limits of the reference motion, below the limits in force so that the vehicle stays inside.

    Attributes:
        speed_max_mps: Horizontal.
        acceleration_mps2: Horizontal.
        climb_mps: Upwards.
        descent_mps: Downwards, positive.
        corner_speed_mps: Speed at a corner of a route.
        position_gain_hz: Gain from position error to closing speed (pursuit).
    """

    speed_max_mps: float
    acceleration_mps2: float
    climb_mps: float
    descent_mps: float
    corner_speed_mps: float
    position_gain_hz: float

    def climbing(self, vertical_mps: float | None) -> FlightSettings:
        """Return the limits of who climbs and descends with a speed; None: these."""
        if vertical_mps is None:
            return self
        return replace(self, climb_mps=vertical_mps, descent_mps=vertical_mps)


class PursuitReference:
    """Reference that closes in on a moving point with limited speed and acceleration.

    Args:
        x: Start, metres, ENU.
        y: Start.
        z: Start, above ground.
    """

    def __init__(self, x: float, y: float, z: float) -> None:
        self.x, self.y, self.z = x, y, z
        self.vx = self.vy = self.vz = 0.0

    def step(
        self,
        goal: tuple[float, float, float],
        goal_velocity: tuple[float, float],
        settings: FlightSettings,
        dt_s: float,
        speed_cap_mps: float | None = None,
    ) -> None:
        """Move one tick towards `goal` (x, y, z in m) that itself moves with `goal_velocity`."""
        ex, ey = goal[0] - self.x, goal[1] - self.y
        error = norm2(ex, ey)
        cap = settings.speed_max_mps if speed_cap_mps is None else speed_cap_mps
        # Closing speed that can still be braked with the acceleration limit at the goal.
        closing = min(settings.position_gain_hz * error, sqrt(settings.acceleration_mps2 * error))
        wx, wy = goal_velocity
        if error > 0.0:
            wx += closing * ex / error
            wy += closing * ey / error
        wanted = norm2(wx, wy)
        if wanted > cap:
            wx, wy = wx * cap / wanted, wy * cap / wanted
        dvx, dvy = wx - self.vx, wy - self.vy
        change = norm2(dvx, dvy)
        limit = settings.acceleration_mps2 * dt_s
        if change > limit:
            dvx, dvy = dvx * limit / change, dvy * limit / change
        self.vx += dvx
        self.vy += dvy
        self.x += self.vx * dt_s
        self.y += self.vy * dt_s
        self.step_vertical(goal[2], settings, dt_s)

    def rest_point(self, settings: FlightSettings) -> tuple[float, float, float]:
        """Return where it comes to rest, braking gently from its velocity (x, y, z in m)."""
        braking_s = norm2(self.vx, self.vy) / settings.acceleration_mps2
        return self.x + braking_s * self.vx, self.y + braking_s * self.vy, self.z

    def step_vertical(self, goal_z: float, settings: FlightSettings, dt_s: float) -> None:
        """Move one tick towards an altitude (m above ground)."""
        ez = goal_z - self.z
        rate = settings.position_gain_hz * ez
        rate = min(settings.climb_mps, max(-settings.descent_mps, rate))
        limit = 0.5 * settings.acceleration_mps2 * dt_s
        self.vz += min(limit, max(-limit, rate - self.vz))
        self.z += self.vz * dt_s


class RouteReference:
    """Reference that runs along a polyline, slowing down for its corners and stopping at its end.

    Args:
        points: (x, y, z) in metres, ENU, above ground; at least two.
        speed_mps: Wanted speed on the legs.
    """

    def __init__(self, points: Sequence[tuple[float, float, float]], speed_mps: float) -> None:
        self._points = [p for i, p in enumerate(points) if i == 0 or p != points[i - 1]]
        self._speed = speed_mps
        self._leg = 0
        self._s = 0.0
        self.speed = 0.0
        self._lengths: list[float] = []
        self._directions: list[tuple[float, float, float]] = []
        for a, b in zip(self._points[:-1], self._points[1:], strict=True):
            dx, dy, dz = b[0] - a[0], b[1] - a[1], b[2] - a[2]
            length = norm3(dx, dy, dz)
            self._lengths.append(length)
            self._directions.append((dx / length, dy / length, dz / length))
        self.x, self.y, self.z = self._points[0]
        self.vx = self.vy = self.vz = 0.0

    @property
    def done(self) -> bool:
        """Whether the reference stands at the end of the route."""
        return self._leg >= len(self._lengths)

    def step(self, settings: FlightSettings, dt_s: float) -> None:
        """Advance the reference by one tick."""
        if self._leg == len(self._lengths):
            self.vx = self.vy = self.vz = 0.0
            return
        speed = min(self._speed, self.speed + settings.acceleration_mps2 * dt_s)
        # Half the acceleration limit for braking keeps the vehicle close at corners.
        speed = min(speed, self._braking_speed(0.5 * settings.acceleration_mps2, settings))
        self.speed = max(speed, 0.2)
        self._s += self.speed * dt_s
        while self._leg < len(self._lengths) and self._s >= self._lengths[self._leg]:
            self._s -= self._lengths[self._leg]
            self._leg += 1
        if self._leg == len(self._lengths):
            self.x, self.y, self.z = self._points[-1]
            self.vx = self.vy = self.vz = self.speed = 0.0
            return
        a, d = self._points[self._leg], self._directions[self._leg]
        self.x, self.y, self.z = (
            a[0] + d[0] * self._s,
            a[1] + d[1] * self._s,
            a[2] + d[2] * self._s,
        )
        self.vx, self.vy, self.vz = d[0] * self.speed, d[1] * self.speed, d[2] * self.speed

    def _braking_speed(self, braking_mps2: float, settings: FlightSettings) -> float:
        allowed = self._speed
        distance = self._lengths[self._leg] - self._s
        horizon = self._speed * self._speed / (2.0 * braking_mps2) + 1.0
        leg = self._leg
        while distance <= horizon:
            at_end = leg + 1 >= len(self._lengths)
            if at_end:
                corner = 0.0
            else:
                d, e = self._directions[leg], self._directions[leg + 1]
                cosine = d[0] * e[0] + d[1] * e[1] + d[2] * e[2]
                corner = self._speed if cosine >= CORNER_COSINE else settings.corner_speed_mps
            allowed = min(allowed, sqrt(corner * corner + 2.0 * braking_mps2 * max(distance, 0.0)))
            if at_end:
                break
            leg += 1
            distance += self._lengths[leg]
        return allowed
