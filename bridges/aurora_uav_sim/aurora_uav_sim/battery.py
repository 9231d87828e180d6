# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The battery of a stand-alone vehicle: linear in airborne time, as plans take it."""

from __future__ import annotations

from enum import IntEnum

from aurora_uav_sim.parameters import installed_model
from aurora_uav_sim.settings import AutopilotSettings


class Charge(IntEnum):
    """How full it is; the numbers of MAV_BATTERY_CHARGE_STATE."""

    OK = 1
    LOW = 2
    CRITICAL = 3
    EMERGENCY = 4


class Battery:
    """State of charge and what a monitor would measure.

    Attributes:
        share: State of charge, 0 to 1.
    """

    def __init__(self, settings: AutopilotSettings) -> None:
        self._settings = settings
        self._energy_wh = installed_model().energy.battery_wh
        self.share = 1.0

    def fill(self) -> None:
        """Put a full one in."""
        self.share = 1.0

    def step(self, h: float) -> None:
        """Fly for `h` seconds."""
        floor = min(self._settings.battery_floor_percent / 100.0, self.share)
        self.share = max(self.share - h / self._settings.battery_endurance_s, floor)

    @property
    def voltage_v(self) -> float:
        """Open-circuit voltage, linear in the charge. Source: PX4's battery estimate."""
        s = self._settings
        cell = s.battery_empty_v + self.share * (s.battery_charged_v - s.battery_empty_v)
        return s.battery_cells * cell

    @property
    def capacity_ah(self) -> float:
        """Charge of the full battery."""
        s = self._settings
        mean_v = 0.5 * s.battery_cells * (s.battery_empty_v + s.battery_charged_v)
        return self._energy_wh / mean_v

    @property
    def flight_current_a(self) -> float:
        """What flying takes, so that charge and time agree."""
        return self.capacity_ah * 3600.0 / self._settings.battery_endurance_s

    @property
    def left_s(self) -> float:
        """Flight time left."""
        return self.share * self._settings.battery_endurance_s

    @property
    def charge(self) -> Charge:
        """How full it is, by the thresholds of the settings."""
        s = self._settings
        if self.share < s.battery_emergency:
            return Charge.EMERGENCY
        if self.share < s.battery_critical:
            return Charge.CRITICAL
        return Charge.LOW if self.share < s.battery_low else Charge.OK
