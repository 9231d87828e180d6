# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The driver of one moving vehicle."""

from __future__ import annotations

import libsumo

from aurora_core.ports.simulators import GroundAgentLoad

# SUMO's default bit set: all its own reasons to change lanes, commanded changes with care.
DEFAULT_LANE_CHANGE_MODE = 0b011001010101
# No change of its own; commanded ones respect the gaps (0 would let them hit other vehicles).
NO_LANE_CHANGE_MODE = 0b001000000000
_RELEASED = -1.0
# All of SUMO's checks of speeds but that of red lights: those who cross are looked out for.
_PAST_RED = 0b01111


class Driver:
    """Car-following and lane-change settings of one vehicle, kept together.

    A held vehicle (commanded speed 0) keeps its lane: it is an obstacle to the one behind, which
    would change lanes, and with `--lanechange.duration` SUMO slides even a standing vehicle
    sideways. And SUMO forgets a vehicle's speed factor whenever a setting of its type changes, so
    the factor is set again each time.

    Args:
        agent: What was asked for the vehicle, which is in the simulation already.
    """

    def __init__(self, agent: GroundAgentLoad) -> None:
        self._vehicle = agent.agent_id
        self._held = False
        self._wanted_mps = _RELEASED
        self._looks_out = False
        self._speed_factor = agent.speed_factor
        self._mode = (
            DEFAULT_LANE_CHANGE_MODE if agent.lane_change_mode is None else agent.lane_change_mode
        )
        if agent.time_gap_s is not None:
            libsumo.vehicle.setTau(self._vehicle, agent.time_gap_s)
        if agent.min_gap_m is not None:
            libsumo.vehicle.setMinGap(self._vehicle, agent.min_gap_m)
        if agent.acceleration_mps2 is not None:
            libsumo.vehicle.setAccel(self._vehicle, agent.acceleration_mps2)
        if agent.runs_red:
            libsumo.vehicle.setSpeedMode(self._vehicle, _PAST_RED)
        self._apply_speed_factor()
        self._apply_mode()

    def set_speed(self, speed_mps: float) -> None:
        """Keep this speed, as far as the traffic ahead allows."""
        self._held = speed_mps == 0.0
        self._apply_mode()
        self._want(speed_mps)

    def release_speed(self) -> None:
        """Give the speed back to the car-following model."""
        self._held = False
        self._apply_mode()
        self._want(_RELEASED)

    def look_out(self, speed_mps: float, cap_mps: float | None) -> None:
        """Brake for somebody on the road, and keep so slow until nobody is there.

        Args:
            speed_mps: Of the vehicle.
            cap_mps: It may be no faster; None where nobody is on the road.
        """
        looks_out = cap_mps is not None and (self._looks_out or cap_mps < speed_mps)
        if looks_out and cap_mps is not None:
            slow_mps = min(speed_mps, cap_mps)
            if self._wanted_mps != _RELEASED:
                slow_mps = min(slow_mps, self._wanted_mps)
            libsumo.vehicle.setSpeed(self._vehicle, slow_mps)
        elif self._looks_out:
            libsumo.vehicle.setSpeed(self._vehicle, self._wanted_mps)
        self._looks_out = looks_out

    def set_speed_factor(self, factor: float) -> None:
        """Drive at this multiple of the speed limit when free."""
        self._speed_factor = factor
        self._apply_speed_factor()

    def set_time_gap(self, time_gap_s: float) -> None:
        """Follow with this headway."""
        libsumo.vehicle.setTau(self._vehicle, time_gap_s)
        self._apply_speed_factor()

    def set_min_gap(self, min_gap_m: float) -> None:
        """Stand with this gap."""
        libsumo.vehicle.setMinGap(self._vehicle, min_gap_m)
        self._apply_speed_factor()

    def set_deceleration(self, deceleration_mps2: float) -> None:
        """Brake this hard at most in service (SUMO raises the emergency braking to it)."""
        libsumo.vehicle.setDecel(self._vehicle, deceleration_mps2)
        self._apply_speed_factor()

    def set_lane_change_mode(self, mode: int) -> None:
        """Set the mode for whenever the vehicle is not held."""
        self._mode = mode
        self._apply_mode()

    def _want(self, speed_mps: float) -> None:
        self._wanted_mps = speed_mps
        libsumo.vehicle.setSpeed(self._vehicle, speed_mps)

    def _apply_mode(self) -> None:
        mode = NO_LANE_CHANGE_MODE if self._held else self._mode
        libsumo.vehicle.setLaneChangeMode(self._vehicle, mode)

    def _apply_speed_factor(self) -> None:
        libsumo.vehicle.setSpeedFactor(self._vehicle, self._speed_factor)
