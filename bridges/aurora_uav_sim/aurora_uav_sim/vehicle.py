# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One vehicle on the globe: the autopilot plus where its local origin lies."""

from __future__ import annotations

from aurora_core.geometry.frames import (
    enu_to_geodetic,
    geodetic_to_enu,
    quaternion_to_yaw_enu,
)
from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.autopilot import ACCEPTED, Answer, Autopilot, Result
from aurora_uav_sim.parameters import installed_model
from aurora_uav_sim.pilot import Pilot

# Where a stand-alone simulator starts. Source: PX4 SITL's default home (Zurich Irchel Park).
DEFAULT_LATITUDE_DEG = 47.397742
DEFAULT_LONGITUDE_DEG = 8.545594
DEFAULT_ALTITUDE_M = 488.0
# Stand-alone vehicles start in a row, so far apart.
SPACING_M = 5.0


class Vehicle:
    """A vehicle with a system id.

    Attributes:
        system_id: MAVLink system id.
        autopilot: Everything that moves.
        pilot: Missions, return and failsafes; at rest in lockstep.
        latitude_deg: Of the local origin (longitude_deg, altitude_m above sea level).
        home: Home position around the local origin, ENU, m.
        since_step_s: What its clock is past the last physics step, for which there is a state.
    """

    def __init__(self, system_id: int, seat: int) -> None:
        self.system_id = system_id
        self.autopilot = Autopilot()
        self._seat = seat
        self.home: tuple[float, float, float] = (0.0, 0.0, 0.0)
        self.since_step_s = 0.0
        self.pilot = Pilot(self)
        self.place_default()

    def place_default(self, *, lockstep: bool = False) -> None:
        """Stand at the vehicle's seat of the stand-alone row, in calm air, without a plan.

        Args:
            lockstep: Somebody else flies: the pilot rests.
        """
        self.latitude_deg, self.longitude_deg = enu_to_geodetic(
            SPACING_M * self._seat, 0.0, DEFAULT_LATITUDE_DEG, DEFAULT_LONGITUDE_DEG
        )
        self.altitude_m = DEFAULT_ALTITUDE_M
        self._yaw_enu_rad = 0.0
        self.since_step_s = 0.0
        self.autopilot.wind.set(0.0, 0.0, 0.0, 0.0)
        self.restart()
        self.pilot.clear()
        self.pilot.active = not lockstep

    def spawn(
        self, latitude_deg: float, longitude_deg: float, altitude_m: float, yaw_enu_rad: float
    ) -> None:
        """Move the local origin, stand there and make it the home."""
        self.latitude_deg, self.longitude_deg = latitude_deg, longitude_deg
        self.altitude_m = altitude_m
        self._yaw_enu_rad = yaw_enu_rad
        self.restart()

    def restart(self) -> None:
        """Stand at the local origin as after power-on; place, yaw and wind are kept."""
        self.home = (0.0, 0.0, 0.0)
        self.autopilot.reset(*sin_cos(0.5 * self._yaw_enu_rad))
        self.pilot.restart()

    def set_home_here(self) -> Answer:
        """Make the present position the home."""
        body = self.autopilot.body
        self.home = (body.x, body.y, body.z)
        self.pilot.home_is_set = True
        return ACCEPTED

    def set_home(self, latitude_deg: float, longitude_deg: float, altitude_m: float) -> Answer:
        """Make a geographic point the home; the vehicle stays where it is."""
        x, y = self.to_local(latitude_deg, longitude_deg)
        if x * x + y * y > 1e10:
            return Answer(Result.DENIED, 'Home denied: over 100 km away')
        self.home = (x, y, altitude_m - self.altitude_m)
        self.pilot.home_is_set = True
        return ACCEPTED

    def to_local(self, latitude_deg: float, longitude_deg: float) -> tuple[float, float]:
        """Return (east, north) in metres around the local origin."""
        return geodetic_to_enu(latitude_deg, longitude_deg, self.latitude_deg, self.longitude_deg)

    def to_geodetic(self, x_m: float, y_m: float) -> tuple[float, float]:
        """Return (latitude, longitude) in degrees of a local point."""
        return enu_to_geodetic(x_m, y_m, self.latitude_deg, self.longitude_deg)

    def body_velocity(
        self, forward_mps: float, right_mps: float, yaw_rate_radps: float
    ) -> tuple[tuple[float, float], tuple[float, float] | None]:
        """Turn a velocity seen from the vehicle into the map's.

        Args:
            forward_mps: Horizontal speed ahead.
            right_mps: And to the right.
            yaw_rate_radps: Clockwise seen from above.

        Returns:
            Velocity, ENU, m/s; sine and cosine of the heading to ask for, None to keep it: it
            runs ahead of the vehicle's by what makes the controller turn at that rate.
        """
        body = self.autopilot.body
        sine, cosine = sin_cos(quaternion_to_yaw_enu(body.qw, body.qx, body.qy, body.qz))
        vxy = (
            forward_mps * cosine + right_mps * sine,
            forward_mps * sine - right_mps * cosine,
        )
        if yaw_rate_radps == 0.0:
            return vxy, None
        ahead_s, ahead_c = sin_cos(-yaw_rate_radps / installed_model().control.yaw_gain_hz)
        return vxy, (sine * ahead_c + cosine * ahead_s, cosine * ahead_c - sine * ahead_s)

    def run(self, steps: int, h: float) -> None:
        """Advance by `steps` physics steps of `h` seconds."""
        self.autopilot.run(steps, h)
