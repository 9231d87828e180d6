# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The autopilot's settings and their PX4 parameter names."""

from __future__ import annotations

from dataclasses import dataclass, fields


@dataclass(slots=True, kw_only=True)
class AutopilotSettings:
    """What a ground station may set; defaults keep automatic flight inside the contract limits.

    Attributes:
        takeoff_altitude_m: Height of a take-off that names none (PX4 default 2.5 m).
        takeoff_speed_mps: Climb rate of take-off; below the 5 m/s limit with room for overshoot.
        land_speed_mps: Descent rate just above the ground.
        auto_descent_mps: Descent rate of landing and of repositioning; limit 3 m/s.
        auto_climb_mps: Climb rate of repositioning.
        cruise_mps: Horizontal speed of repositioning (PX4 default 5 m/s).
        offboard_loss_s: Set-points may be silent so long in offboard mode.
        disarm_landed_s: Disarms so long after touchdown.
        disarm_preflight_s: Disarms so long after arming without take-off.
    """

    takeoff_altitude_m: float = 2.5
    takeoff_speed_mps: float = 4.0
    land_speed_mps: float = 0.7
    auto_descent_mps: float = 2.5
    auto_climb_mps: float = 4.0
    cruise_mps: float = 5.0
    offboard_loss_s: float = 1.0
    disarm_landed_s: float = 2.0
    disarm_preflight_s: float = 10.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """One row of the table: PX4 name, the attribute behind it, its range."""

    name: str
    attribute: str
    low: float
    high: float


# Source of names and ranges: PX4 parameter reference; speeds are capped by what the vehicle does.
PARAMETERS = (
    Parameter(name='COM_DISARM_LAND', attribute='disarm_landed_s', low=0.1, high=20.0),
    Parameter(name='COM_DISARM_PRFLT', attribute='disarm_preflight_s', low=1.0, high=60.0),
    Parameter(name='COM_OF_LOSS_T', attribute='offboard_loss_s', low=0.1, high=60.0),
    Parameter(name='MIS_TAKEOFF_ALT', attribute='takeoff_altitude_m', low=0.5, high=120.0),
    Parameter(name='MPC_LAND_SPEED', attribute='land_speed_mps', low=0.3, high=2.0),
    Parameter(name='MPC_TKO_SPEED', attribute='takeoff_speed_mps', low=0.5, high=5.0),
    Parameter(name='MPC_XY_CRUISE', attribute='cruise_mps', low=1.0, high=18.0),
    Parameter(name='MPC_Z_V_AUTO_DN', attribute='auto_descent_mps', low=0.5, high=3.0),
    Parameter(name='MPC_Z_V_AUTO_UP', attribute='auto_climb_mps', low=0.5, high=5.0),
)
PARAMETER_INDEX = {row.name: index for index, row in enumerate(PARAMETERS)}


def get_parameter(settings: AutopilotSettings, row: Parameter) -> float:
    """Return the value behind a row of the table."""
    return float(getattr(settings, row.attribute))


def set_parameter(settings: AutopilotSettings, row: Parameter, value: float) -> bool:
    """Set the value behind a row; a value out of range (NaN too) changes nothing.

    Returns:
        Whether the value was taken.
    """
    if not row.low <= value <= row.high:
        return False
    setattr(settings, row.attribute, value)
    return True


def restore_defaults(settings: AutopilotSettings) -> None:
    """Set everything back to its default."""
    for field in fields(settings):
        setattr(settings, field.name, field.default)
