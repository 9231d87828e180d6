# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Columns of the packed float64 arrays that carry states and commands on the tick path.

Everything is in the ENU map frame (metres, origin of the SUMO network) and SI units. The same
columns travel in the ROS messages, lie in the bag and are hashed.
"""

from __future__ import annotations

from enum import IntEnum


class GroundColumn(IntEnum):
    """One row per ground agent in roster order."""

    X = 0  # m, east; centre of the agent's box at ground level
    Y = 1  # m, north
    HEADING_X = 2  # unit vector of the heading, east component (cos of the ENU yaw)
    HEADING_Y = 3  # north component (sin of the ENU yaw)
    SPEED = 4  # m/s along the heading
    ACCELERATION = 5  # m/s^2 along the heading, as the simulator reports it
    PRESENT = 6  # 1 while the agent exists, else 0 (other columns keep their last value)


class UavColumn(IntEnum):
    """One row per UAV in roster order."""

    X = 0  # m, east
    Y = 1  # m, north
    Z = 2  # m above ground, centre of the UAV; 0 when landed
    VX = 3  # m/s, east
    VY = 4  # m/s, north
    VZ = 5  # m/s, up
    QW = 6  # attitude quaternion, body FLU to ENU
    QX = 7
    QY = 8
    QZ = 9
    P = 10  # rad/s, body FLU
    Q = 11
    R = 12
    ARMED = 13  # 0 or 1
    MODE = 14  # UavMode as reported by the autopilot
    LANDED = 15  # 0 or 1


class UavMode(IntEnum):
    """Flight mode, commanded and reported. IDLE: disarmed, or armed without a task."""

    IDLE = 0
    TAKEOFF = 1
    OFFBOARD = 2
    LAND = 3
    HOLD = 4


class UavPhase(IntEnum):
    """Phase of the mission state machine that a command belongs to.

    The k-th mission of a UAV (k from 0, order of the specification) is `MISSION + k`; the way from
    the end of ascent to the mission's first point belongs to the mission (before its capture).
    HOLDING stands where a mission ended, until an event begins the next one, or to the end.
    LANDING holds the flight to the landing spot (OFFBOARD) and the landing itself (LAND).
    """

    IDLE = 0
    ASCENT = 1
    MISSION = 2
    HOLDING = 99
    LANDING = 100


class UavCommandColumn(IntEnum):
    """One row per UAV in roster order, stamped with the tick it is for."""

    MODE = 0  # UavMode wanted (IDLE, TAKEOFF, OFFBOARD or LAND)
    X = 1  # m, position set-point
    Y = 2
    Z = 3  # m above ground
    VX = 4  # m/s, velocity feed-forward
    VY = 5
    VZ = 6
    YAW = 7  # rad, ENU
    TAKEOFF_ALTITUDE = 8  # m above ground, used with MODE = TAKEOFF
    PHASE = 9  # UavPhase this command belongs to; a phase ends at the first command of the next


GROUND_WIDTH = len(GroundColumn)
UAV_WIDTH = len(UavColumn)
UAV_COMMAND_WIDTH = len(UavCommandColumn)


class GroundCommandKind(IntEnum):
    """What a ground command does, with the unit of `value` and the meaning of `text`."""

    SET_SPEED = 1  # value: m/s to hold, reached within the agent's own acceleration limits
    RELEASE_SPEED = 2  # back to the car-following model
    SET_SPEED_FACTOR = 3  # value: factor on the lane's speed limit
    SET_TIME_GAP = 4  # value: s, desired time headway
    SET_MIN_GAP = 5  # value: m, gap at standstill
    SET_DECELERATION = 6  # value: m/s^2 > 0, service braking
    SET_ROUTE = 7  # text: edge ids separated by blanks, first = current edge
    CHANGE_LANE = 8  # value: lane index in SUMO's count; value2: s to stay there
    STOP_AT = 9  # text: lane id; value: m along the lane of the box's centre; value2: s to stand
    RESUME = 10  # leave a stop
    REMOVE = 11  # take the agent out of the simulation
    WALK = 12  # text: edge ids; value: arrival position in m on the last edge
    # value: SUMO bit set. 513: own changes only where the route needs them, CHANGE_LANE with care
    # for others; 257: the same, but CHANGE_LANE only avoids collisions; 512: only CHANGE_LANE; 0:
    # the same, but CHANGE_LANE does not mind who is there.
    SET_LANE_CHANGE_MODE = 13
