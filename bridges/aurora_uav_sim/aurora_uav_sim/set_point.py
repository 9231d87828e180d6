# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""SET_POSITION_TARGET_LOCAL_NED to an autopilot target; NaN and the absurd are refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.geometry.frames import yaw_ned_to_enu
from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.autopilot import Target
from aurora_uav_sim.commands import is_place
from aurora_uav_sim.protocol import (
    FORCE_BIT,
    IGNORE_VXY,
    IGNORE_VZ,
    IGNORE_XY,
    IGNORE_YAW,
    IGNORE_Z,
    MUST_IGNORE,
)

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle

_BODY_NED = int(mavlink.MAV_FRAME_BODY_NED)
_IGNORE_YAW_RATE = 0x800
_LOCAL_NED = int(mavlink.MAV_FRAME_LOCAL_NED)
MAX_POSITION_M = 20_000.0
MAX_SPEED_MPS = 100.0
MAX_YAW_RAD = 100.0


class SetPointReader:
    """Reads set-points; keeps the last sine and cosine, since the yaw seldom changes."""

    __slots__ = ('_sin_cos', '_yaw')

    def __init__(self) -> None:
        self._yaw: float | None = None
        self._sin_cos = (0.0, 1.0)

    def read(self, fields: tuple[Any, ...]) -> Target | None:
        """Return the target of a set-point, None when it is not acceptable.

        Args:
            fields: Of SET_POSITION_TARGET_LOCAL_NED in wire order.
        """
        _, n, e, d, vn, ve, vd, _, _, _, yaw, _, mask, _, _, frame = fields
        if frame != _LOCAL_NED or mask & FORCE_BIT or mask & MUST_IGNORE != MUST_IGNORE:
            return None
        xy = z = vxy = vz = heading = None
        far, fast = MAX_POSITION_M, MAX_SPEED_MPS
        # A comparison with NaN is false, so each check refuses NaN too.
        if not mask & IGNORE_XY:
            if not (-far <= n <= far and -far <= e <= far):
                return None
            xy = (e, n)
        if not mask & IGNORE_Z:
            if not -far <= d <= far:
                return None
            z = -d
        if not mask & IGNORE_VXY:
            if not (-fast <= vn <= fast and -fast <= ve <= fast):
                return None
            vxy = (ve, vn)
        if not mask & IGNORE_VZ:
            if not -fast <= vd <= fast:
                return None
            vz = -vd
        if not mask & IGNORE_YAW:
            if yaw != self._yaw:
                if not -MAX_YAW_RAD <= yaw <= MAX_YAW_RAD:
                    return None
                self._yaw = yaw
                self._sin_cos = sin_cos(yaw_ned_to_enu(yaw))
            heading = self._sin_cos
        if (xy is None and vxy is None) or (z is None and vz is None):
            return None
        return Target(xy, z, vxy, vz, heading)


def read_streamed(reader: SetPointReader, m: Any, kind: str, vehicle: Vehicle) -> Target | None:
    """Return the target of a set-point of a stand-alone flight, None when it is not acceptable.

    Beside LOCAL_NED that is a velocity in the body's frame with a yaw rate, and a place on the
    globe.

    Args:
        reader: Of LOCAL_NED.
        m: pymavlink message.
        kind: Its name.
        vehicle: Whom it is for.
    """
    if kind == 'SET_POSITION_TARGET_GLOBAL_INT':
        return _read_global(reader, m, vehicle)
    if m.coordinate_frame == _BODY_NED:
        return _read_body(m, vehicle)
    return reader.read(
        (
            m.time_boot_ms, m.x, m.y, m.z, m.vx, m.vy, m.vz, m.afx, m.afy, m.afz, m.yaw,
            m.yaw_rate, m.type_mask, m.target_system, m.target_component, m.coordinate_frame,
        )
    )  # fmt: skip


def _read_global(reader: SetPointReader, m: Any, vehicle: Vehicle) -> Target | None:
    latitude_deg, longitude_deg = m.lat_int * 1e-7, m.lon_int * 1e-7
    north = east = 0.0
    if not m.type_mask & IGNORE_XY:
        if not is_place(latitude_deg, longitude_deg):
            return None
        east, north = vehicle.to_local(latitude_deg, longitude_deg)
    origin_m = _origin_of(m.coordinate_frame, vehicle)
    if origin_m is None:
        return None
    return reader.read(
        (
            m.time_boot_ms, north, east, origin_m - m.alt, m.vx, m.vy, m.vz, m.afx, m.afy, m.afz,
            m.yaw, m.yaw_rate, m.type_mask, m.target_system, m.target_component, _LOCAL_NED,
        )
    )  # fmt: skip


def _origin_of(frame: int, vehicle: Vehicle) -> float | None:
    """Return the height of the local origin in a frame's terms, m; None for other frames."""
    if frame in (mavlink.MAV_FRAME_GLOBAL, mavlink.MAV_FRAME_GLOBAL_INT):
        return vehicle.altitude_m
    # The ground is flat and home stands on it.
    if frame in (
        mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT,
        mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        mavlink.MAV_FRAME_GLOBAL_TERRAIN_ALT,
        mavlink.MAV_FRAME_GLOBAL_TERRAIN_ALT_INT,
    ):
        return -vehicle.home[2]
    return None


def _read_body(m: Any, vehicle: Vehicle) -> Target | None:
    wanted = IGNORE_VXY | IGNORE_VZ
    if m.type_mask & (wanted | FORCE_BIT | _IGNORE_YAW_RATE):
        return None
    fast = MAX_SPEED_MPS
    speeds = (m.vx, m.vy, m.vz)
    if not all(-fast <= v <= fast for v in speeds):
        return None
    if not -MAX_YAW_RAD <= m.yaw_rate <= MAX_YAW_RAD:
        return None
    vxy, heading = vehicle.body_velocity(m.vx, m.vy, m.yaw_rate)
    return Target(None, None, vxy, -m.vz, heading)
