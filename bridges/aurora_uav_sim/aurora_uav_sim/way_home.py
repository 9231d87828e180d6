# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The way home: up, over, down to where one waits, and a landing."""

from __future__ import annotations

from enum import Enum
from math import sqrt
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle


class _Phase(Enum):
    CLIMB = 0
    FLY = 1
    SINK = 2
    WAIT = 3


class WayHome:
    """One return. Source: PX4 user guide, return mode (home location, direct).

    Args:
        vehicle: Whose set-point it moves.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self._vehicle = vehicle
        self._waited_s = 0.0
        autopilot, home = vehicle.autopilot, vehicle.home
        body, settings = autopilot.body, autopilot.settings
        self._z = max(body.z, home[2] + settings.return_altitude_m)
        # Never up in order to sink.
        self._wait_z = min(self._z, home[2] + settings.return_descend_m)
        if self._at_home():
            # Beside home no height is needed.
            self._wait_z = min(self._wait_z, body.z)
            self._sink()
        else:
            self._phase = _Phase.CLIMB
            autopilot.aim(None, self._z, None, None)

    def step(self, h: float) -> None:
        """Go on for `h` seconds; the landing at the end changes the flight mode."""
        autopilot, home = self._vehicle.autopilot, self._vehicle.home
        body, settings = autopilot.body, autopilot.settings
        near = settings.altitude_acceptance_m
        if self._phase is _Phase.CLIMB and body.z >= self._z - near:
            self._phase = _Phase.FLY
            dx, dy = home[0] - body.x, home[1] - body.y
            distance = sqrt(dx * dx + dy * dy)
            yaw = (dy / distance, dx / distance) if distance > settings.acceptance_m else None
            autopilot.aim((home[0], home[1]), self._z, yaw, None)
        elif self._phase is _Phase.FLY and self._at_home():
            self._sink()
        elif self._phase is _Phase.SINK and body.z <= self._wait_z + near:
            self._phase = _Phase.WAIT
        elif self._phase is _Phase.WAIT:
            self._waited_s += h
            if 0.0 <= settings.return_delay_s <= self._waited_s:
                autopilot.land((home[0], home[1]))

    def _at_home(self) -> bool:
        body, home = self._vehicle.autopilot.body, self._vehicle.home
        within = self._vehicle.autopilot.settings.acceptance_m
        return (body.x - home[0]) ** 2 + (body.y - home[1]) ** 2 <= within * within

    def _sink(self) -> None:
        self._phase = _Phase.SINK
        home = self._vehicle.home
        self._vehicle.autopilot.aim((home[0], home[1]), self._wait_z, None, None)
