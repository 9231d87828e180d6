# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The battery of a vehicle: emptied in the air by what the rotors take."""

from __future__ import annotations

from enum import IntEnum
from math import pi, sqrt

from aurora_uav_sim.multirotor import Multirotor
from aurora_uav_sim.parameters import EnergyParameters, installed_model
from aurora_uav_sim.settings import AutopilotSettings
from aurora_uav_sim.wind import Wind

# Density of the standard atmosphere at sea level. Source: ISO 2533.
_AIR_KGPM3 = 1.225
_ROTORS = 4.0
# Newton steps for the induced speed; from above they fall to it, and six reach the last bit.
_NEWTON_STEPS = 8


class Charge(IntEnum):
    """How full it is; the numbers of MAV_BATTERY_CHARGE_STATE."""

    OK = 1
    LOW = 2
    CRITICAL = 3
    EMERGENCY = 4


def flight_power_w(body: Multirotor, wind: Wind, energy: EnergyParameters) -> float:
    """Return the electrical power that a flight takes at this moment.

    The rotors push the air through their discs with the induced speed v of momentum theory,
    v sqrt(p^2 + (c + v)^2) = T / (2 rho A), and take T (c + v) for it, over the efficiency; c is
    the speed of the vehicle through the air along its thrust, p the one across. A descent takes
    what a hover takes. Source: Leishman, Principles of Helicopter Aerodynamics, sections 2.13
    and 2.14 (Glauert).

    Args:
        body: What flies.
        wind: The air around it.
        energy: Its rotors and their efficiency.
    """
    thrust_n = float(body.f0 + body.f1 + body.f2 + body.f3)
    if thrust_n <= 0.0:
        return 0.0
    w, x, y, z = body.qw, body.qx, body.qy, body.qz
    ux, uy, uz = body.vx - wind.x, body.vy - wind.y, body.vz - wind.z
    along = 2.0 * (x * z + w * y) * ux + 2.0 * (y * z - w * x) * uy
    along += (1.0 - 2.0 * (x * x + y * y)) * uz
    across2 = max(0.0, ux * ux + uy * uy + uz * uz - along * along)
    climb = max(0.0, along)
    disc_m2 = _ROTORS * pi * energy.rotor_radius_m * energy.rotor_radius_m
    wanted = thrust_n / (2.0 * _AIR_KGPM3 * disc_m2)
    v = sqrt(wanted)
    for _ in range(_NEWTON_STEPS):
        through = climb + v
        speed = sqrt(across2 + through * through)
        v -= (v * speed - wanted) / (speed + v * through / speed)
    return thrust_n * (climb + v) / energy.efficiency


class Battery:
    """State of charge and what a monitor would measure.

    Attributes:
        share: State of charge, 0 to 1.
        power_w: What the last step took.
    """

    def __init__(self, settings: AutopilotSettings) -> None:
        self._settings = settings
        self._energy = installed_model().energy
        self.fill()

    def fill(self) -> None:
        """Put a full one in."""
        self.share = 1.0
        self.power_w = 0.0

    def step(self, h: float, body: Multirotor, wind: Wind) -> None:
        """Fly for `h` seconds as a body flies now."""
        s = self._settings
        linear = s.battery_endurance_s > 0.0
        self.power_w = (
            self._full_ws / s.battery_endurance_s
            if linear
            else flight_power_w(body, wind, self._energy)
        )
        floor = min(s.battery_floor_percent / 100.0, self.share)
        self.share = max(self.share - h * self.power_w / self._full_ws, floor)

    @property
    def _full_ws(self) -> float:
        return self._energy.battery_wh * 3600.0

    @property
    def is_flown(self) -> bool:
        """Whether what may be flown of it is; the rest is a reserve."""
        return self.share <= 1.0 - self._energy.usable_share

    @property
    def voltage_v(self) -> float:
        """Open-circuit voltage, linear in the charge. Source: PX4's battery estimate."""
        s = self._settings
        cell = s.battery_empty_v + self.share * (s.battery_charged_v - s.battery_empty_v)
        return s.battery_cells * cell

    @property
    def _mean_v(self) -> float:
        s = self._settings
        return 0.5 * s.battery_cells * (s.battery_empty_v + s.battery_charged_v)

    @property
    def capacity_ah(self) -> float:
        """Charge of the full battery."""
        return self._energy.battery_wh / self._mean_v

    @property
    def flight_current_a(self) -> float:
        """What the flight takes, so that charge and time agree."""
        return self.power_w / self._mean_v

    @property
    def left_s(self) -> float:
        """Flight time left as it flies now; 0 before it has flown: nobody can tell."""
        return self.share * self._full_ws / self.power_w if self.power_w > 0.0 else 0.0

    @property
    def charge(self) -> Charge:
        """How full it is, by the thresholds of the settings."""
        s = self._settings
        if self.share < s.battery_emergency:
            return Charge.EMERGENCY
        if self.share < s.battery_critical:
            return Charge.CRITICAL
        return Charge.LOW if self.share < s.battery_low else Charge.OK
