# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Items of a plan as MAVLink's mission protocol carries them: missions and fences."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.geometry.frames import compass_deg_to_yaw_enu
from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.commands import MAX_HEIGHT_M, MAX_REACH_M, is_place, whole

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle

ACCEPTED = int(mavlink.MAV_MISSION_ACCEPTED)

WAYPOINT = int(mavlink.MAV_CMD_NAV_WAYPOINT)
LOITER = int(mavlink.MAV_CMD_NAV_LOITER_UNLIM)
LOITER_TIME = int(mavlink.MAV_CMD_NAV_LOITER_TIME)
RETURN = int(mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH)
LAND = int(mavlink.MAV_CMD_NAV_LAND)
TAKEOFF = int(mavlink.MAV_CMD_NAV_TAKEOFF)
DELAY = int(mavlink.MAV_CMD_NAV_DELAY)
JUMP = int(mavlink.MAV_CMD_DO_JUMP)
SPEED = int(mavlink.MAV_CMD_DO_CHANGE_SPEED)
# Of these a mission may be made.
STEPS = frozenset(
    {WAYPOINT, LOITER, LOITER_TIME, RETURN, LAND, TAKEOFF, DELAY, JUMP, SPEED}
)  # fmt: skip
_PLACED = frozenset({WAYPOINT, LOITER, LOITER_TIME, LAND, TAKEOFF})
_ABOVE_SEA = frozenset({int(mavlink.MAV_FRAME_GLOBAL), int(mavlink.MAV_FRAME_GLOBAL_INT)})
_ABOVE_HOME = frozenset(
    {
        int(mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT),
        int(mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT),
    }
)
# A place that is not given.
_NO_PLACE = 2**31 - 1


class Item(NamedTuple):
    """One item as it came, to be given back the same.

    Attributes:
        frame: MAV_FRAME.
        command: MAV_CMD.
        autocontinue: Go on after it.
        p1: First parameter (p2 to p4 likewise).
        x: Latitude, 1e-7 degrees (y: longitude).
        z: Height in the frame, m.
    """

    frame: int
    command: int
    autocontinue: int
    p1: float
    p2: float
    p3: float
    p4: float
    x: int
    y: int
    z: float


class Step(NamedTuple):
    """One item of a mission as it is flown.

    Attributes:
        command: MAV_CMD.
        xy: Place around the local origin, ENU, m; None: where one is.
        z: Height, m; None: as it is.
        above_home: The height counts from home, otherwise from the local origin.
        sin_cos_yaw: Heading to keep, ENU; None: towards the place.
        stay_s: Time to stay.
        within_m: Reached this close; None: the setting.
        value: Speed in m/s, or the item to jump to.
        repeats: How often to jump, -1: always.
    """

    command: int
    xy: tuple[float, float] | None = None
    z: float | None = None
    above_home: bool = False
    sin_cos_yaw: tuple[float, float] | None = None
    stay_s: float = 0.0
    within_m: float | None = None
    value: float = 0.0
    repeats: int = 0


class Refusal(NamedTuple):
    """Why an item cannot be: MAV_MISSION_RESULT, and words for the pilot."""

    result: int
    reason: str


def item_of(m: Any) -> Item:
    """Return the item of a MISSION_ITEM_INT, or of an old MISSION_ITEM in degrees."""
    x, y = m.x, m.y
    if m.get_type() == 'MISSION_ITEM':
        x, y = (round(v * 1e7) if abs(v) <= 200.0 else _NO_PLACE for v in (x, y))
    return Item(
        m.frame, m.command, m.autocontinue, m.param1, m.param2, m.param3, m.param4, x, y, m.z
    )


def place_of(item: Item, vehicle: Vehicle) -> tuple[float, float] | None:
    """Return where an item is, ENU around the local origin, None when it is no place or far."""
    latitude_deg, longitude_deg = item.x * 1e-7, item.y * 1e-7
    if not is_place(latitude_deg, longitude_deg):
        return None
    x, y = vehicle.to_local(latitude_deg, longitude_deg)
    return (x, y) if x * x + y * y <= MAX_REACH_M * MAX_REACH_M else None


def read_step(item: Item, vehicle: Vehicle, count: int) -> Step | Refusal:
    """Return an item as it is flown.

    Args:
        item: Of a mission.
        vehicle: Who flies it.
        count: Number of items of the mission.
    """
    command = item.command
    if command not in STEPS:
        return Refusal(mavlink.MAV_MISSION_UNSUPPORTED, f'command {command}')
    if command in _PLACED:
        return _read_placed(item, vehicle)
    if command == SPEED:
        if not isfinite(item.p2) or item.p2 == 0.0 or item.p1 not in (0.0, 1.0):
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM2, 'speed')
        return Step(command, value=item.p2)
    if command == JUMP:
        goal, repeats = whole(item.p1), whole(item.p2)
        if goal is None or not 0 <= goal < count:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1, 'jump to no item')
        if repeats is None or repeats < -1:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM2, 'repeats')
        return Step(command, value=goal, repeats=repeats)
    if command == DELAY:
        if not 0.0 <= item.p1 < 1e6:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1, 'delay in s')
        return Step(command, stay_s=item.p1)
    return Step(command)


def _read_placed(item: Item, vehicle: Vehicle) -> Step | Refusal:
    command = item.command
    above_home = item.frame in _ABOVE_HOME
    if not above_home and item.frame not in _ABOVE_SEA:
        return Refusal(mavlink.MAV_MISSION_UNSUPPORTED_FRAME, f'frame {item.frame}')
    xy = None
    # Taking off and landing without a place: here. Zero is what QGroundControl writes for none.
    here = command in (LAND, TAKEOFF) and (item.x, item.y) in ((0, 0), (_NO_PLACE, _NO_PLACE))
    if not here:
        xy = place_of(item, vehicle)
        if xy is None:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM5_X, 'no place, or too far')
    z = None
    if command != LAND:
        z = item.z if above_home else item.z - vehicle.altitude_m
        if not 0.0 < z < MAX_HEIGHT_M:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM7, 'height')
    stay_s = item.p1 if command in (WAYPOINT, LOITER_TIME) and isfinite(item.p1) else 0.0
    if not 0.0 <= stay_s < 1e6:
        return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1, 'time to stay')
    within_m = item.p2 if command == WAYPOINT and isfinite(item.p2) and item.p2 > 0.0 else None
    yaw = None
    if isfinite(item.p4) and abs(item.p4) <= 720.0:
        yaw = sin_cos(compass_deg_to_yaw_enu(item.p4))
    return Step(command, xy, z, above_home, yaw, stay_s, within_m)
