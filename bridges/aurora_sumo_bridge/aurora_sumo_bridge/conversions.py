# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pure conversions between SUMO's poses and the poses of the map frame.

SUMO speaks of the middle of the FRONT bumper and of degrees clockwise from north; everything
else in AURORA speaks of the centre of the box and of a unit heading vector (east, north) in the
ENU map frame. This file is the only place where the two meet.
"""

from __future__ import annotations

import math

# Free space between the kerb-side border of a traffic lane and the flank of a parked vehicle.
KERB_CLEARANCE_M = 0.3


def heading_from_sumo_angle(angle_deg: float) -> tuple[float, float]:
    """Return the ENU heading vector of a compass angle.

    Quarter turns are exact (`math.sin` of pi is not 0), so streets along the axes give
    coordinates without rounding dust.

    Args:
        angle_deg: Degrees clockwise from north, any real number.

    Returns:
        Unit vector (east, north).
    """
    turned_deg = math.fmod(angle_deg, 360.0)
    if turned_deg < 0.0:
        turned_deg += 360.0
    if turned_deg == 0.0 or turned_deg == 360.0:
        return 0.0, 1.0
    if turned_deg == 90.0:
        return 1.0, 0.0
    if turned_deg == 180.0:
        return 0.0, -1.0
    if turned_deg == 270.0:
        return -1.0, 0.0
    angle_rad = math.radians(turned_deg)
    return math.sin(angle_rad), math.cos(angle_rad)


def sumo_angle_from_heading(heading_x: float, heading_y: float) -> float:
    """Return the compass angle in [0, 360) of a vector (east, north); exact on the axes."""
    if heading_x == 0.0:
        return 0.0 if heading_y >= 0.0 else 180.0
    if heading_y == 0.0:
        return 90.0 if heading_x > 0.0 else 270.0
    angle_deg = math.degrees(math.atan2(heading_x, heading_y))
    return angle_deg if angle_deg >= 0.0 else angle_deg + 360.0


def centre_from_front(
    front_x_m: float, front_y_m: float, heading_x: float, heading_y: float, length_m: float
) -> tuple[float, float]:
    """Return the box centre (ENU, m) of a body whose front bumper is at the given point."""
    half_m = 0.5 * length_m
    return front_x_m - half_m * heading_x, front_y_m - half_m * heading_y


def front_from_centre(
    centre_x_m: float, centre_y_m: float, heading_x: float, heading_y: float, length_m: float
) -> tuple[float, float]:
    """Return the front bumper (ENU, m) of a body whose box centre is at the given point."""
    half_m = 0.5 * length_m
    return centre_x_m + half_m * heading_x, centre_y_m + half_m * heading_y


def kerb_offset_m(lane_width_m: float, vehicle_width_m: float) -> float:
    """Return how far right of a traffic lane's centre line a parked vehicle's centre stands."""
    return 0.5 * lane_width_m + 0.5 * vehicle_width_m + KERB_CLEARANCE_M
