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
        manual_mps: Horizontal speed at full stick.
        manual_yaw_dps: Yaw rate at full stick, degrees per second.
        acceptance_m: A waypoint counts as reached this close (PX4 default of multicopters).
        altitude_acceptance_m: The same, vertically.
        offboard_loss_s: Set-points may be silent so long in offboard mode.
        offboard_loss_action: 3 return, 4 land, 5 hold.
        sticks_loss_s: Sticks may be silent so long in position mode.
        data_link_loss_s: A ground station may be silent so long.
        data_link_loss_action: 0 none, 1 hold, 2 return, 3 land.
        low_battery_action: 0 warn, 2 land when critical, 3 return when critical, land in an
            emergency.
        battery_low: State of charge below which it is low (battery_critical, battery_emergency).
        battery_cells: In series (battery_charged_v, battery_empty_v: of one cell).
        battery_endurance_s: A full battery lasts so long in the air, however it flies; 0: until
            the rotors have taken its energy.
        battery_floor_percent: It is never emptier than this.
        disarm_landed_s: Disarms so long after touchdown.
        disarm_preflight_s: Disarms so long after arming without take-off.
        fence_action: 0 none, 1 warn, 2 hold, 3 return, 5 land.
        fence_radius_m: Largest horizontal distance from home, 0: any.
        fence_height_m: Largest height above home, 0: any.
        return_altitude_m: Height above home of the way back (PX4's default, 60 m, is 30 m here:
            the height that AURORA takes for unstated ones).
        return_descend_m: Height above home down to which it sinks there before it lands.
        return_delay_s: Waits so long there, -1: for ever.
        wind_north_mps: Mean wind towards north while stand-alone (wind_east_mps: east).
    """

    takeoff_altitude_m: float = 2.5
    takeoff_speed_mps: float = 4.0
    land_speed_mps: float = 0.7
    auto_descent_mps: float = 2.5
    auto_climb_mps: float = 4.0
    cruise_mps: float = 5.0
    manual_mps: float = 10.0
    manual_yaw_dps: float = 90.0
    acceptance_m: float = 2.0
    altitude_acceptance_m: float = 0.8
    offboard_loss_s: float = 1.0
    offboard_loss_action: float = 5.0
    sticks_loss_s: float = 0.5
    data_link_loss_s: float = 10.0
    data_link_loss_action: float = 0.0
    low_battery_action: float = 0.0
    battery_low: float = 0.15
    battery_critical: float = 0.07
    battery_emergency: float = 0.05
    battery_cells: float = 4.0
    battery_charged_v: float = 4.05
    battery_empty_v: float = 3.6
    battery_endurance_s: float = 0.0
    battery_floor_percent: float = 0.0
    disarm_landed_s: float = 2.0
    disarm_preflight_s: float = 10.0
    fence_action: float = 2.0
    fence_radius_m: float = 0.0
    fence_height_m: float = 0.0
    return_altitude_m: float = 30.0
    return_descend_m: float = 10.0
    return_delay_s: float = 0.0
    wind_north_mps: float = 0.0
    wind_east_mps: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Parameter:
    """One row of the table: PX4 name, the attribute behind it, its range.

    Attributes:
        whole: An INT32 for MAVLink, otherwise a REAL32.
        values: The only ones that it may have, empty: all of the range.
    """

    name: str
    attribute: str
    low: float
    high: float
    whole: bool = False
    values: tuple[int, ...] = ()


def _real(name: str, attribute: str, low: float, high: float) -> Parameter:
    return Parameter(name=name, attribute=attribute, low=low, high=high)


def _whole(name: str, attribute: str, low: int, high: int) -> Parameter:
    return Parameter(name=name, attribute=attribute, low=low, high=high, whole=True)


def _one_of(name: str, attribute: str, *values: int) -> Parameter:
    low, high = min(values), max(values)
    return Parameter(name=name, attribute=attribute, low=low, high=high, whole=True, values=values)


# Source of names, types and ranges: PX4 parameter reference; speeds are capped by what the
# vehicle does, cells by what BATTERY_STATUS carries. Of an action the values are left out that
# this vehicle cannot do. A drain of 0 is ours: the battery empties by what the rotors take.
PARAMETERS = (
    _whole('BAT1_N_CELLS', 'battery_cells', 1, 14),
    _real('BAT1_V_CHARGED', 'battery_charged_v', 3.7, 4.5),
    _real('BAT1_V_EMPTY', 'battery_empty_v', 2.5, 3.7),
    _real('BAT_CRIT_THR', 'battery_critical', 0.05, 0.5),
    _real('BAT_EMERGEN_THR', 'battery_emergency', 0.03, 0.5),
    _real('BAT_LOW_THR', 'battery_low', 0.12, 0.8),
    _real('COM_DISARM_LAND', 'disarm_landed_s', 0.1, 20.0),
    _real('COM_DISARM_PRFLT', 'disarm_preflight_s', 1.0, 60.0),
    _whole('COM_DL_LOSS_T', 'data_link_loss_s', 5, 300),
    _one_of('COM_LOW_BAT_ACT', 'low_battery_action', 0, 2, 3),
    _one_of('COM_OBL_RC_ACT', 'offboard_loss_action', 3, 4, 5),
    _real('COM_OF_LOSS_T', 'offboard_loss_s', 0.1, 60.0),
    _real('COM_RC_LOSS_T', 'sticks_loss_s', 0.1, 35.0),
    _one_of('GF_ACTION', 'fence_action', 0, 1, 2, 3, 5),
    _real('GF_MAX_HOR_DIST', 'fence_radius_m', 0.0, 10_000.0),
    _real('GF_MAX_VER_DIST', 'fence_height_m', 0.0, 10_000.0),
    _real('MIS_TAKEOFF_ALT', 'takeoff_altitude_m', 0.5, 120.0),
    _real('MPC_LAND_SPEED', 'land_speed_mps', 0.3, 2.0),
    _real('MPC_MAN_Y_MAX', 'manual_yaw_dps', 0.0, 90.0),
    _real('MPC_TKO_SPEED', 'takeoff_speed_mps', 0.5, 5.0),
    _real('MPC_VEL_MANUAL', 'manual_mps', 3.0, 18.0),
    _real('MPC_XY_CRUISE', 'cruise_mps', 1.0, 18.0),
    _real('MPC_Z_V_AUTO_DN', 'auto_descent_mps', 0.5, 3.0),
    _real('MPC_Z_V_AUTO_UP', 'auto_climb_mps', 0.5, 5.0),
    _real('NAV_ACC_RAD', 'acceptance_m', 0.05, 200.0),
    _one_of('NAV_DLL_ACT', 'data_link_loss_action', 0, 1, 2, 3),
    _real('NAV_MC_ALT_RAD', 'altitude_acceptance_m', 0.05, 200.0),
    _real('RTL_DESCEND_ALT', 'return_descend_m', 2.0, 100.0),
    _real('RTL_LAND_DELAY', 'return_delay_s', -1.0, 60.0),
    _real('RTL_RETURN_ALT', 'return_altitude_m', 0.0, 150.0),
    _real('SIH_WIND_E', 'wind_east_mps', -15.0, 15.0),
    _real('SIH_WIND_N', 'wind_north_mps', -15.0, 15.0),
    _real('SIM_BAT_DRAIN', 'battery_endurance_s', 0.0, 86_400.0),
    _real('SIM_BAT_MIN_PCT', 'battery_floor_percent', 0.0, 100.0),
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
    if (row.whole and value != int(value)) or (row.values and value not in row.values):
        return False
    setattr(settings, row.attribute, float(value))
    return True


def restore_defaults(settings: AutopilotSettings) -> None:
    """Set everything back to its default."""
    for field in fields(settings):
        setattr(settings, field.name, field.default)
