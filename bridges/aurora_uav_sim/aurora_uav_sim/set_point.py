# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""SET_POSITION_TARGET_LOCAL_NED to an autopilot target; NaN and the absurd are refused."""

from __future__ import annotations

from typing import Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.geometry.frames import yaw_ned_to_enu
from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.autopilot import Target
from aurora_uav_sim.protocol import (
    FORCE_BIT,
    IGNORE_VXY,
    IGNORE_VZ,
    IGNORE_XY,
    IGNORE_YAW,
    IGNORE_Z,
    MUST_IGNORE,
)

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
