# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""MAVLink commands to one vehicle: read the parameters, ask the autopilot, give its answer."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite
from typing import TYPE_CHECKING, Any, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from aurora_core.geometry.frames import compass_deg_to_yaw_enu, yaw_ned_to_enu
from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.autopilot import ACCEPTED, Answer, FlightMode, Result
from aurora_uav_sim.protocol import FORCE_ARM_MAGIC

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle

_INT32_MAX = 2**31 - 1
# Goals further than this from the local origin are refused.
MAX_REACH_M = 20_000.0
MAX_HEIGHT_M = 10_000.0
MAX_SPEED_MPS = 100.0
# Source: MAVLink common.xml, MAV_DO_REPOSITION_FLAGS_CHANGE_MODE.
_CHANGE_MODE = 1


class Request(NamedTuple):
    """COMMAND_LONG and COMMAND_INT alike.

    Attributes:
        command: MAV_CMD.
        p1: First parameter (p2 to p4 likewise).
        latitude_deg: Fifth parameter as a latitude, NaN when not given (longitude_deg: sixth).
        p7: Seventh parameter.
        frame: MAV_FRAME of the position (global for COMMAND_LONG).
        sender: System and component id of the sender.
    """

    command: int
    p1: float
    p2: float
    p3: float
    p4: float
    latitude_deg: float
    longitude_deg: float
    p7: float
    frame: int
    sender: tuple[int, int]


def request_of_long(m: Any, sender: tuple[int, int]) -> Request:
    """Return the request of a COMMAND_LONG message."""
    return Request(
        m.command, m.param1, m.param2, m.param3, m.param4, m.param5, m.param6, m.param7,
        int(mavlink.MAV_FRAME_GLOBAL), sender,
    )  # fmt: skip


def request_of_int(m: Any, sender: tuple[int, int]) -> Request:
    """Return the request of a COMMAND_INT message."""
    nan = float('nan')
    return Request(
        m.command, m.param1, m.param2, m.param3, m.param4,
        nan if m.x == _INT32_MAX else m.x * 1e-7,
        nan if m.y == _INT32_MAX else m.y * 1e-7,
        m.z, m.frame, sender,
    )  # fmt: skip


def whole(value: float) -> int | None:
    """Return a parameter that must be a whole number, None when it is not one."""
    if not isfinite(value) or value != int(value):
        return None
    return int(value)


def is_place(latitude_deg: float, longitude_deg: float) -> bool:
    """Return whether this is a point on the globe (NaN is not)."""
    return -90.0 <= latitude_deg <= 90.0 and -180.0 <= longitude_deg <= 180.0


def _arm_disarm(vehicle: Vehicle, request: Request) -> Answer:
    force = request.p2 == FORCE_ARM_MAGIC
    if request.p1 == 1.0:
        return vehicle.pilot.arm()
    if request.p1 == 0.0:
        return vehicle.autopilot.disarm(force=force)
    return Answer(Result.DENIED, 'Arm or disarm expected')


def _takeoff(vehicle: Vehicle, request: Request) -> Answer:
    autopilot = vehicle.autopilot
    if isfinite(request.p7):
        # PX4: absolute altitude.
        height_m = request.p7 - vehicle.altitude_m
    else:
        height_m = vehicle.home[2] + autopilot.settings.takeoff_altitude_m
    return autopilot.takeoff(height_m)


def _land(vehicle: Vehicle, request: Request) -> Answer:
    del request
    return vehicle.autopilot.land()


def _set_mode(vehicle: Vehicle, request: Request) -> Answer:
    base = whole(request.p1)
    main = whole(request.p2)
    sub = whole(request.p3) if isfinite(request.p3) else 0
    if base is None or main is None or sub is None:
        return Answer(Result.DENIED, 'Mode denied: not a mode')
    if not base & mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED:
        return Answer(Result.UNSUPPORTED, 'Only PX4 custom modes')
    autopilot = vehicle.autopilot
    if main == FlightMode.OFFBOARD.value[0]:
        return autopilot.offboard()
    if (main, sub) == FlightMode.HOLD.value:
        return autopilot.hold()
    if (main, sub) == FlightMode.LAND.value:
        return autopilot.land()
    if main == FlightMode.POSITION.value[0]:
        return vehicle.pilot.position()
    if (main, sub) == FlightMode.MISSION.value:
        return vehicle.pilot.fly_mission()
    if (main, sub) == FlightMode.RETURN.value:
        return vehicle.pilot.return_home()
    if (main, sub) == FlightMode.TAKEOFF.value:
        return autopilot.takeoff(vehicle.home[2] + autopilot.settings.takeoff_altitude_m)
    return Answer(Result.UNSUPPORTED, f'Mode {main}/{sub} does not exist here')


def _reposition(vehicle: Vehicle, request: Request) -> Answer:
    autopilot = vehicle.autopilot
    flags = whole(request.p2)
    if flags is None:
        return Answer(Result.DENIED, 'Reposition denied: flags')
    if not flags & _CHANGE_MODE and autopilot.mode is not FlightMode.HOLD:
        return Answer(Result.TEMPORARILY_REJECTED, 'Reposition denied: not in hold')
    xy = None
    if is_place(request.latitude_deg, request.longitude_deg):
        xy = vehicle.to_local(request.latitude_deg, request.longitude_deg)
        if xy[0] * xy[0] + xy[1] * xy[1] > MAX_REACH_M * MAX_REACH_M:
            return Answer(Result.DENIED, 'Reposition denied: too far')
    elif isfinite(request.latitude_deg) or isfinite(request.longitude_deg):
        return Answer(Result.DENIED, 'Reposition denied: not a place')
    z = None
    if isfinite(request.p7):
        if request.frame in (mavlink.MAV_FRAME_GLOBAL, mavlink.MAV_FRAME_GLOBAL_INT):
            z = request.p7 - vehicle.altitude_m
        elif request.frame in (
            mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT,
            mavlink.MAV_FRAME_GLOBAL_RELATIVE_ALT_INT,
        ):
            z = request.p7 + vehicle.home[2]
        else:
            return Answer(Result.DENIED, 'Reposition denied: frame')
        if not 0.0 < z < MAX_HEIGHT_M:
            return Answer(Result.DENIED, 'Reposition denied: height')
    yaw = None
    if isfinite(request.p4) and -10.0 < request.p4 < 10.0:
        yaw = sin_cos(yaw_ned_to_enu(request.p4))
    speed = request.p1 if isfinite(request.p1) and request.p1 > 0.0 else None
    return autopilot.reposition(xy, z, yaw, speed)


def _set_home(vehicle: Vehicle, request: Request) -> Answer:
    if request.p1 == 1.0:
        return vehicle.set_home_here()
    place = home_of(request)
    if place is None:
        return Answer(Result.DENIED, 'Home denied: not a place')
    return vehicle.set_home(*place[:3])


def home_of(request: Request) -> tuple[float, float, float, float] | None:
    """Return (latitude, longitude in deg, altitude in m, ENU yaw in rad) of DO_SET_HOME."""
    if not is_place(request.latitude_deg, request.longitude_deg):
        return None
    if not -1000.0 <= request.p7 <= MAX_HEIGHT_M:
        return None
    # No yaw given: north.
    compass_deg = request.p4 if isfinite(request.p4) and abs(request.p4) <= 720.0 else 0.0
    yaw_enu_rad = compass_deg_to_yaw_enu(compass_deg)
    return request.latitude_deg, request.longitude_deg, request.p7, yaw_enu_rad


def _reboot(vehicle: Vehicle, request: Request) -> Answer:
    if request.p1 == 0.0:
        return ACCEPTED
    if request.p1 != 1.0:
        return Answer(Result.UNSUPPORTED, 'Only reboot')
    if vehicle.autopilot.armed:
        return Answer(Result.TEMPORARILY_REJECTED, 'Reboot denied: armed')
    vehicle.restart()
    return ACCEPTED


def _return(vehicle: Vehicle, request: Request) -> Answer:
    del request
    return vehicle.pilot.return_home()


def _start_mission(vehicle: Vehicle, request: Request) -> Answer:
    first = whole(request.p1)
    if first:
        answer = vehicle.pilot.select_item(first)
        if answer.result is not Result.ACCEPTED:
            return answer
    return vehicle.pilot.fly_mission()


def _select_item(vehicle: Vehicle, request: Request) -> Answer:
    at = whole(request.p1)
    if at is None:
        return Answer(Result.DENIED, 'Mission item expected')
    return vehicle.pilot.select_item(at)


def _pause(vehicle: Vehicle, request: Request) -> Answer:
    if request.p1 == 0.0:
        return vehicle.autopilot.hold()
    return vehicle.pilot.fly_mission()


def _change_speed(vehicle: Vehicle, request: Request) -> Answer:
    if request.p1 not in (0.0, 1.0) or not 0.0 < request.p2 <= MAX_SPEED_MPS:
        return Answer(Result.DENIED, 'Speed denied: horizontal, above 0')
    vehicle.autopilot.limit_speed(request.p2)
    return ACCEPTED


def _check_arming(vehicle: Vehicle, request: Request) -> Answer:
    del request
    for reason in vehicle.pilot.arming_reasons():
        vehicle.pilot.say(f'Arming check: {reason}', mavlink.MAV_SEVERITY_WARNING)
    return ACCEPTED


Handler = Callable[['Vehicle', Request], Answer]

# Everything that changes the vehicle. What is not here, and is not a request for a message, is
# answered UNSUPPORTED.
HANDLERS: dict[int, Handler] = {
    int(mavlink.MAV_CMD_COMPONENT_ARM_DISARM): _arm_disarm,
    int(mavlink.MAV_CMD_NAV_TAKEOFF): _takeoff,
    int(mavlink.MAV_CMD_NAV_LAND): _land,
    int(mavlink.MAV_CMD_DO_SET_MODE): _set_mode,
    int(mavlink.MAV_CMD_DO_REPOSITION): _reposition,
    int(mavlink.MAV_CMD_DO_SET_HOME): _set_home,
    int(mavlink.MAV_CMD_PREFLIGHT_REBOOT_SHUTDOWN): _reboot,
    int(mavlink.MAV_CMD_NAV_RETURN_TO_LAUNCH): _return,
    int(mavlink.MAV_CMD_MISSION_START): _start_mission,
    int(mavlink.MAV_CMD_DO_SET_MISSION_CURRENT): _select_item,
    int(mavlink.MAV_CMD_DO_PAUSE_CONTINUE): _pause,
    int(mavlink.MAV_CMD_DO_CHANGE_SPEED): _change_speed,
    int(mavlink.MAV_CMD_RUN_PREARM_CHECKS): _check_arming,
}
