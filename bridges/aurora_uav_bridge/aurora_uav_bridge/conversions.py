# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Between rows of the trace (ENU map frame, float64) and MAVLink fields (NED, float32).

What comes off the wire is float32, in both engines alike: the map position is the home (float64)
plus the local position (float32), so the same bytes give the same bits.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite
from typing import Any

from aurora_core.geometry.frames import (
    attitude_ned_to_enu,
    enu_to_ned,
    frd_to_flu,
    ned_to_enu,
    yaw_enu_to_ned,
)
from aurora_core.ports.simulators import AirLoad, UavHome
from aurora_core.trace.layout import UavCommandColumn, UavMode
from aurora_uav_bridge.errors import CommandRangeError
from aurora_uav_sim.lockstep import MAX_TICK_US, MIN_TICK_US
from aurora_uav_sim.protocol import (
    AUTOPILOT_COMPONENT,
    MAX_FLEET,
    MAX_SYSTEM_ID,
    TYPE_MASK_POSITION_VELOCITY_YAW,
)

# The simulator refuses more; see `aurora_uav_sim.set_point`.
MAX_OFFSET_M = 20_000.0
MAX_SPEED_MPS = 100.0
MAX_YAW_RAD = 100.0
MAX_TAKEOFF_ALTITUDE_M = 1_000.0
MAX_WIND_MPS = 50.0
_FRAME_LOCAL_NED = 1
_FLOWN = UavCommandColumn.TAKEOFF_ALTITUDE + 1
_MODES = {
    float(mode): mode for mode in (UavMode.IDLE, UavMode.TAKEOFF, UavMode.OFFBOARD, UavMode.LAND)
}


def check_number(what: str, value: float, low: float, high: float) -> None:
    """Refuse a number that is not finite or out of range.

    Raises:
        CommandRangeError: It is; the message starts with `what`.
    """
    if not low <= value <= high:
        raise CommandRangeError(
            f'{what}: expected a number from {low:g} to {high:g}, found {value!r}',
            hint='the command was not sent',
        )


def check_load(load: AirLoad) -> int:
    """Check everything that a load would send.

    Returns:
        Length of a tick in us.

    Raises:
        CommandRangeError: Something is not finite, out of range or doubled; it is named.
    """
    check_number('air load, dt_s', load.dt_s, MIN_TICK_US / 1e6, MAX_TICK_US / 1e6)
    tick_us = round(load.dt_s * 1e6)
    if abs(tick_us / 1e6 - load.dt_s) > 1e-12:
        raise CommandRangeError(f'air load, dt_s: expected whole microseconds, found {load.dt_s}')
    check_number('air load, seed', load.seed, 0, 2**64 - 1)
    check_number('air load, origin_lat_deg', load.origin_lat_deg, -89.0, 89.0)
    check_number('air load, origin_lon_deg', load.origin_lon_deg, -180.0, 180.0)
    check_number('air load, origin_alt_m', load.origin_alt_m, -1000.0, 9000.0)
    limit = MAX_WIND_MPS
    check_number('air load, wind_mean_east_mps', load.wind_mean_east_mps, -limit, limit)
    check_number('air load, wind_mean_north_mps', load.wind_mean_north_mps, -limit, limit)
    check_number('air load, wind_gust_mps', load.wind_gust_mps, 0.0, limit)
    if len(load.homes) > MAX_FLEET:
        raise CommandRangeError(
            f'air load: expected at most {MAX_FLEET} UAVs, found {len(load.homes)}'
        )
    seen: set[int] = set()
    for home in load.homes:
        where = f'air load, home of {home.uav_id}'
        check_number(f'{where}, x_m', home.x_m, -1e6, 1e6)
        check_number(f'{where}, y_m', home.y_m, -1e6, 1e6)
        check_number(f'{where}, yaw_enu_rad', home.yaw_enu_rad, -MAX_YAW_RAD, MAX_YAW_RAD)
        check_number(f'{where}, system_id', home.system_id, 1, MAX_SYSTEM_ID)
        if home.system_id in seen:
            raise CommandRangeError(f'{where}: system id {home.system_id} is used twice')
        seen.add(home.system_id)
    return tick_us


def check_command(home: UavHome, tick: int, row: Sequence[float]) -> UavMode:
    """Check a command row.

    Args:
        home: The UAV that it is for.
        tick: Tick that it is for.
        row: (UAV_COMMAND_WIDTH,) in the order of `UavCommandColumn`.

    Returns:
        The mode wanted.

    Raises:
        CommandRangeError: A field is not finite or out of range; UAV, field and value are named.
    """
    # What comes after these (the phase) is the trace's and not the simulator's.
    mode, x, y, z, vx, vy, vz, yaw, altitude = row[:_FLOWN]
    far, fast = MAX_OFFSET_M, MAX_SPEED_MPS
    if (
        -far <= x - home.x_m <= far
        and -far <= y - home.y_m <= far
        and -far <= z <= far
        and -fast <= vx <= fast
        and -fast <= vy <= fast
        and -fast <= vz <= fast
        and -MAX_YAW_RAD <= yaw <= MAX_YAW_RAD
        and 0.0 <= altitude <= MAX_TAKEOFF_ALTITUDE_M
        and mode in _MODES
    ):
        return _MODES[mode]
    # Something is wrong: find it.
    limits = {
        UavCommandColumn.X: (home.x_m - far, home.x_m + far),
        UavCommandColumn.Y: (home.y_m - far, home.y_m + far),
        UavCommandColumn.Z: (-far, far),
        UavCommandColumn.VX: (-fast, fast),
        UavCommandColumn.VY: (-fast, fast),
        UavCommandColumn.VZ: (-fast, fast),
        UavCommandColumn.YAW: (-MAX_YAW_RAD, MAX_YAW_RAD),
        UavCommandColumn.TAKEOFF_ALTITUDE: (0.0, MAX_TAKEOFF_ALTITUDE_M),
    }
    where = f'command for {home.uav_id} at tick {tick}'
    for column, (low, high) in limits.items():
        check_number(f'{where}, {column.name}', row[column], low, high)
    names = ', '.join(f'{int(m)} ({m.name})' for m in _MODES.values())
    raise CommandRangeError(f'{where}, MODE: expected one of {names}, found {mode!r}')


def set_point_fields(home: UavHome, tick: int, row: Sequence[float]) -> tuple[Any, ...]:
    """Return the fields of SET_POSITION_TARGET_LOCAL_NED in wire order.

    Args:
        home: The UAV, whose home is the origin of its local frame.
        tick: Stamped as time_boot_ms.
        row: A checked command row.
    """
    _, x, y, z, vx, vy, vz, yaw, _ = row[:_FLOWN]
    north, east, down = enu_to_ned(x - home.x_m, y - home.y_m, z)
    v_north, v_east, v_down = enu_to_ned(vx, vy, vz)
    return (
        tick, north, east, down, v_north, v_east, v_down, 0.0, 0.0, 0.0, yaw_enu_to_ned(yaw), 0.0,
        TYPE_MASK_POSITION_VELOCITY_YAW, home.system_id, AUTOPILOT_COMPONENT, _FRAME_LOCAL_NED,
    )  # fmt: skip


def state_row(
    home: UavHome, position: tuple[Any, ...], attitude: tuple[Any, ...], status: tuple[Any, ...]
) -> list[float]:
    """Return a state row in the order of `UavColumn`.

    Args:
        home: Of the UAV.
        position: Fields of LOCAL_POSITION_NED in wire order.
        attitude: Fields of ATTITUDE_QUATERNION in wire order.
        status: Mode, armed and landed.
    """
    _, north, east, down, v_north, v_east, v_down = position
    x, y, z = ned_to_enu(north, east, down)
    vx, vy, vz = ned_to_enu(v_north, v_east, v_down)
    mode, armed, landed = status
    return [
        home.x_m + x, home.y_m + y, z, vx, vy, vz,
        *attitude_ned_to_enu(*attitude[1:5]), *frd_to_flu(*attitude[5:8]),
        float(armed), float(mode), float(landed),
    ]  # fmt: skip


def all_finite(rows: Sequence[Sequence[float]]) -> bool:
    """Return whether every number of every row is finite (none is near the largest double)."""
    # A sum keeps what is not finite: infinities of both signs make it NaN.
    return isfinite(sum(map(sum, rows)))
