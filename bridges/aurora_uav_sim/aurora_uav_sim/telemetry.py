# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a vehicle tells about itself: pymavlink messages from its state, NED and FRD."""

from __future__ import annotations

from collections.abc import Callable
from math import nan, sqrt
from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.geometry.frames import (
    attitude_enu_to_ned,
    enu_to_ned,
    flu_to_frd,
    heading_to_yaw_enu,
    quaternion_to_euler_ned,
    quaternion_to_yaw_enu,
    yaw_enu_to_compass_deg,
)
from aurora_core.trace.layout import UavMode
from aurora_uav_sim.autopilot import Autopilot, FlightMode
from aurora_uav_sim.battery import Charge
from aurora_uav_sim.fence import Breach
from aurora_uav_sim.vehicle import Vehicle

# Custom mode enabled, automatic, guided, stabilised. Source: PX4 `HEARTBEAT.hpp`.
_BASE_MODE = 0x1D
# What a vehicle of perfect knowledge has: gyro, accelerometer, magnetometer, barometer, GPS, a
# battery, a fence.
_SENSORS = (
    mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_ACCEL
    | mavlink.MAV_SYS_STATUS_SENSOR_3D_MAG
    | mavlink.MAV_SYS_STATUS_SENSOR_ABSOLUTE_PRESSURE
    | mavlink.MAV_SYS_STATUS_SENSOR_GPS
    | mavlink.MAV_SYS_STATUS_SENSOR_BATTERY
    | mavlink.MAV_SYS_STATUS_GEOFENCE
    | mavlink.MAV_SYS_STATUS_PREARM_CHECK
)
_CAPABILITIES = (
    mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_FLOAT
    | mavlink.MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_PARAM_ENCODE_BYTEWISE
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_LOCAL_NED
    | mavlink.MAV_PROTOCOL_CAPABILITY_SET_POSITION_TARGET_GLOBAL_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
    | mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_FENCE
    | mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
)
# The PX4 release whose behaviour is followed: 1.14.0, release.
_SOFTWARE_VERSION = 0x010E00FF
_SATELLITES = 12


# Plain names: before Python 3.12 a member is slow to look up, and each tick asks.
_OFFBOARD, _HOLD = FlightMode.OFFBOARD, FlightMode.HOLD
_TAKEOFF, _LAND = FlightMode.TAKEOFF, FlightMode.LAND
_UAV_IDLE, _UAV_HOLD, _UAV_OFFBOARD = UavMode.IDLE, UavMode.HOLD, UavMode.OFFBOARD


def uav_mode(autopilot: Autopilot) -> UavMode:
    """Return the flight mode in the words of the trace."""
    if not autopilot.armed:
        return _UAV_IDLE
    mode = autopilot.mode
    if mode is _OFFBOARD:
        return _UAV_OFFBOARD
    if mode is _HOLD:
        return _UAV_IDLE if autopilot.landed else _UAV_HOLD
    if mode is _TAKEOFF:
        return UavMode.TAKEOFF
    # Mission, return and position do not exist in lockstep, whose trace these words are for.
    return UavMode.LAND if mode is _LAND else _UAV_OFFBOARD


def _boot_ms(vehicle: Vehicle) -> int:
    return int(vehicle.autopilot.time_s * 1000.0 + 0.5)


def _e7(degrees: float) -> int:
    return round(degrees * 1e7)


def heartbeat(vehicle: Vehicle) -> Any:
    """HEARTBEAT."""
    autopilot = vehicle.autopilot
    armed = mavlink.MAV_MODE_FLAG_SAFETY_ARMED if autopilot.armed else 0
    return mavlink.MAVLink_heartbeat_message(
        mavlink.MAV_TYPE_QUADROTOR,
        mavlink.MAV_AUTOPILOT_PX4,
        _BASE_MODE | armed,
        autopilot.mode.custom_mode,
        mavlink.MAV_STATE_ACTIVE if autopilot.armed else mavlink.MAV_STATE_STANDBY,
        3,
    )


def sys_status(vehicle: Vehicle) -> Any:
    """SYS_STATUS; healthy is what has nothing against arming or flying on."""
    pilot = vehicle.pilot
    ill = 0
    if not vehicle.autopilot.armed and pilot.arming_reasons():
        ill |= mavlink.MAV_SYS_STATUS_PREARM_CHECK
    if pilot.battery.charge >= Charge.CRITICAL:
        ill |= mavlink.MAV_SYS_STATUS_SENSOR_BATTERY
    if pilot.breach is not Breach.NONE:
        ill |= mavlink.MAV_SYS_STATUS_GEOFENCE
    return mavlink.MAVLink_sys_status_message(
        _SENSORS, _SENSORS, _SENSORS & ~ill, 0, round(pilot.battery.voltage_v * 1000.0),
        _current_ca(vehicle), _percent(vehicle), 0, 0, 0, 0, 0, 0,
    )  # fmt: skip


def _current_ca(vehicle: Vehicle) -> int:
    """Return the current in hundredths of an ampere; the field ends at 327 A."""
    if vehicle.autopilot.landed:
        return 0
    return min(round(vehicle.pilot.battery.flight_current_a * 100.0), 32767)


def _percent(vehicle: Vehicle) -> int:
    return round(vehicle.pilot.battery.share * 100.0)


def battery_status(vehicle: Vehicle) -> Any:
    """BATTERY_STATUS."""
    battery, settings = vehicle.pilot.battery, vehicle.autopilot.settings
    cells = round(settings.battery_cells)
    cell_mv = round(battery.voltage_v / cells * 1000.0)
    voltages = [cell_mv] * min(cells, 10) + [0xFFFF] * max(10 - cells, 0)
    used = 1.0 - battery.share
    return mavlink.MAVLink_battery_status_message(
        0,
        mavlink.MAV_BATTERY_FUNCTION_ALL,
        mavlink.MAV_BATTERY_TYPE_LIPO,
        32767,
        voltages,
        _current_ca(vehicle),
        round(used * battery.capacity_ah * 1000.0),
        -1,
        _percent(vehicle),
        round(battery.left_s),
        battery.charge,
        # Cells beyond the tenth; 0: there is none.
        [cell_mv] * min(max(cells - 10, 0), 4) + [0] * min(max(14 - cells, 0), 4),
    )


def mission_current(vehicle: Vehicle) -> Any:
    """MISSION_CURRENT."""
    return vehicle.pilot.mission_current()


def fence_status(vehicle: Vehicle) -> Any:
    """FENCE_STATUS."""
    pilot = vehicle.pilot
    return mavlink.MAVLink_fence_status_message(
        int(pilot.breach is not Breach.NONE), pilot.breaches, pilot.breach, pilot.breach_ms
    )


def wind_cov(vehicle: Vehicle) -> Any:
    """WIND_COV; the estimate is the truth."""
    autopilot = vehicle.autopilot
    wind = autopilot.wind
    return mavlink.MAVLink_wind_cov_message(
        int(autopilot.time_s * 1e6 + 0.5), *enu_to_ned(wind.x, wind.y, wind.z),
        0.0, 0.0, vehicle.altitude_m + autopilot.body.z, 0.0, 0.0,
    )  # fmt: skip


def altitude(vehicle: Vehicle) -> Any:
    """ALTITUDE; the ground is flat."""
    z = vehicle.autopilot.body.z
    above_sea_m = vehicle.altitude_m + z
    return mavlink.MAVLink_altitude_message(
        int(vehicle.autopilot.time_s * 1e6 + 0.5), above_sea_m, above_sea_m, z,
        z - vehicle.home[2], vehicle.altitude_m, z,
    )  # fmt: skip


def vfr_hud(vehicle: Vehicle) -> Any:
    """VFR_HUD."""
    autopilot = vehicle.autopilot
    body, wind = autopilot.body, autopilot.wind
    ux, uy, uz = body.vx - wind.x, body.vy - wind.y, body.vz - wind.z
    heading_deg = yaw_enu_to_compass_deg(quaternion_to_yaw_enu(body.qw, body.qx, body.qy, body.qz))
    full_n = 4.0 * body.parameters.motor_max_thrust_n
    return mavlink.MAVLink_vfr_hud_message(
        sqrt(ux * ux + uy * uy + uz * uz),
        sqrt(body.vx * body.vx + body.vy * body.vy),
        round(heading_deg) % 360,
        round(100.0 * (body.f0 + body.f1 + body.f2 + body.f3) / full_n),
        vehicle.altitude_m + body.z,
        body.vz,
    )


def global_position(vehicle: Vehicle) -> Any:
    """GLOBAL_POSITION_INT."""
    body = vehicle.autopilot.body
    latitude_deg, longitude_deg = vehicle.to_geodetic(body.x, body.y)
    north, east, down = enu_to_ned(body.vx, body.vy, body.vz)
    heading_deg = yaw_enu_to_compass_deg(quaternion_to_yaw_enu(body.qw, body.qx, body.qy, body.qz))
    return mavlink.MAVLink_global_position_int_message(
        _boot_ms(vehicle),
        _e7(latitude_deg),
        _e7(longitude_deg),
        round((vehicle.altitude_m + body.z) * 1000.0),
        round((body.z - vehicle.home[2]) * 1000.0),
        _cmps(north),
        _cmps(east),
        _cmps(down),
        round(heading_deg * 100.0) % 36000,
    )


def _cmps(speed_mps: float) -> int:
    return min(max(round(speed_mps * 100.0), -32768), 32767)


def local_position(vehicle: Vehicle) -> Any:
    """LOCAL_POSITION_NED."""
    body = vehicle.autopilot.body
    return mavlink.MAVLink_local_position_ned_message(
        _boot_ms(vehicle),
        *enu_to_ned(body.x, body.y, body.z),
        *enu_to_ned(body.vx, body.vy, body.vz),
    )


def attitude_quaternion(vehicle: Vehicle) -> Any:
    """ATTITUDE_QUATERNION."""
    body = vehicle.autopilot.body
    return mavlink.MAVLink_attitude_quaternion_message(
        _boot_ms(vehicle),
        *attitude_enu_to_ned(body.qw, body.qx, body.qy, body.qz),
        *flu_to_frd(body.p, body.q, body.r),
        repr_offset_q=[0.0, 0.0, 0.0, 0.0],
    )


def attitude(vehicle: Vehicle) -> Any:
    """ATTITUDE."""
    body = vehicle.autopilot.body
    attitude_ned = attitude_enu_to_ned(body.qw, body.qx, body.qy, body.qz)
    return mavlink.MAVLink_attitude_message(
        _boot_ms(vehicle),
        *quaternion_to_euler_ned(*attitude_ned),
        *flu_to_frd(body.p, body.q, body.r),
    )


def gps_raw(vehicle: Vehicle) -> Any:
    """GPS_RAW_INT of a receiver without error."""
    body = vehicle.autopilot.body
    latitude_deg, longitude_deg = vehicle.to_geodetic(body.x, body.y)
    course_deg = yaw_enu_to_compass_deg(heading_to_yaw_enu(body.vx, body.vy))
    return mavlink.MAVLink_gps_raw_int_message(
        int(vehicle.autopilot.time_s * 1e6 + 0.5),
        mavlink.GPS_FIX_TYPE_3D_FIX,
        _e7(latitude_deg),
        _e7(longitude_deg),
        round((vehicle.altitude_m + body.z) * 1000.0),
        70,
        90,
        min(round(sqrt(body.vx * body.vx + body.vy * body.vy) * 100.0), 65534),
        round(course_deg * 100.0) % 36000,
        _SATELLITES,
    )


def extended_sys_state(vehicle: Vehicle) -> Any:
    """EXTENDED_SYS_STATE."""
    autopilot = vehicle.autopilot
    if autopilot.landed:
        landed = mavlink.MAV_LANDED_STATE_ON_GROUND
    elif autopilot.mode is FlightMode.TAKEOFF:
        landed = mavlink.MAV_LANDED_STATE_TAKEOFF
    elif autopilot.mode is FlightMode.LAND:
        landed = mavlink.MAV_LANDED_STATE_LANDING
    else:
        landed = mavlink.MAV_LANDED_STATE_IN_AIR
    return mavlink.MAVLink_extended_sys_state_message(mavlink.MAV_VTOL_STATE_UNDEFINED, landed)


def home_position(vehicle: Vehicle) -> Any:
    """HOME_POSITION."""
    x, y, z = vehicle.home
    latitude_deg, longitude_deg = vehicle.to_geodetic(x, y)
    return mavlink.MAVLink_home_position_message(
        _e7(latitude_deg),
        _e7(longitude_deg),
        round((vehicle.altitude_m + z) * 1000.0),
        *enu_to_ned(x, y, z),
        [nan, nan, nan, nan],
        0.0,
        0.0,
        0.0,
        int(vehicle.autopilot.time_s * 1e6 + 0.5),
    )


def autopilot_version(vehicle: Vehicle) -> Any:
    """AUTOPILOT_VERSION."""
    return mavlink.MAVLink_autopilot_version_message(
        _CAPABILITIES,
        _SOFTWARE_VERSION,
        0,
        0,
        0,
        [0] * 8,
        [0] * 8,
        [0] * 8,
        0,
        0,
        vehicle.system_id,
        [0] * 18,
    )


Builder = Callable[[Vehicle], Any]

# Streamed messages: builder and default interval in s of wall time.
STREAMS: dict[int, tuple[Builder, float]] = {
    int(mavlink.MAVLINK_MSG_ID_HEARTBEAT): (heartbeat, 1.0),
    int(mavlink.MAVLINK_MSG_ID_SYS_STATUS): (sys_status, 0.5),
    int(mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE): (extended_sys_state, 0.2),
    int(mavlink.MAVLINK_MSG_ID_HOME_POSITION): (home_position, 1.0),
    int(mavlink.MAVLINK_MSG_ID_GLOBAL_POSITION_INT): (global_position, 0.1),
    int(mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED): (local_position, 0.1),
    int(mavlink.MAVLINK_MSG_ID_ATTITUDE_QUATERNION): (attitude_quaternion, 0.1),
    int(mavlink.MAVLINK_MSG_ID_ATTITUDE): (attitude, 0.1),
    int(mavlink.MAVLINK_MSG_ID_GPS_RAW_INT): (gps_raw, 0.1),
    int(mavlink.MAVLINK_MSG_ID_ALTITUDE): (altitude, 0.2),
    int(mavlink.MAVLINK_MSG_ID_BATTERY_STATUS): (battery_status, 0.5),
    int(mavlink.MAVLINK_MSG_ID_FENCE_STATUS): (fence_status, 1.0),
    int(mavlink.MAVLINK_MSG_ID_MISSION_CURRENT): (mission_current, 1.0),
    int(mavlink.MAVLINK_MSG_ID_VFR_HUD): (vfr_hud, 0.2),
    int(mavlink.MAVLINK_MSG_ID_WIND_COV): (wind_cov, 1.0),
}

# Also on request.
ON_REQUEST: dict[int, Builder] = {
    **{number: builder for number, (builder, _) in STREAMS.items()},
    int(mavlink.MAVLINK_MSG_ID_AUTOPILOT_VERSION): autopilot_version,
}
