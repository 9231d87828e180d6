# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The one place where a frame becomes another frame.

Inside AURORA everything is ENU metres (x east, y north, z up), bodies are FLU (x forward, y left,
z up), quaternions are (w, x, y, z) and turn body vectors into the map frame, yaw is 0 towards
east and grows counter-clockwise. Outside there are:

- MAVLink: NED metres, FRD bodies, yaw 0 towards north and clockwise;
- SUMO: angle in degrees, 0 towards north and clockwise;
- geodesy: latitude and longitude in degrees.

Scalars and tuples, because these run on the tick path.

Source: REP-103 (ENU, FLU); MAVLink common.xml (NED, FRD); SUMO manual, TraCI vehicle value
retrieval (angle); PX4 `src/lib/geo` (local projection on a sphere).
"""

from __future__ import annotations

import math

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

# Mean radius that PX4 uses for its local projection (CONSTANTS_RADIUS_OF_EARTH).
EARTH_RADIUS_M = 6371000.0

_SQRT_HALF = math.sqrt(0.5)
_HALF_PI = math.pi / 2.0
_TWO_PI = 2.0 * math.pi
# A negative angle next to none rounds up to the full turn.
_QUARTERS = {
    0.0: (0.0, 1.0),
    90.0: (1.0, 0.0),
    180.0: (0.0, -1.0),
    270.0: (-1.0, 0.0),
    360.0: (0.0, 1.0),
}


def wrap_angle(angle_rad: float) -> float:
    """Return the same direction in (-pi, pi].

    Args:
        angle_rad: Any finite angle in rad.
    """
    if -math.pi < angle_rad <= math.pi:
        return angle_rad
    wrapped_rad = math.fmod(angle_rad, _TWO_PI)
    if wrapped_rad > math.pi:
        wrapped_rad -= _TWO_PI
    elif wrapped_rad <= -math.pi:
        wrapped_rad += _TWO_PI
    return wrapped_rad


def enu_to_ned(east: float, north: float, up: float) -> Vector3:
    """Turn a vector from ENU into NED; exact, any unit."""
    return north, east, -up


def ned_to_enu(north: float, east: float, down: float) -> Vector3:
    """Turn a vector from NED into ENU; exact, any unit."""
    return east, north, -down


def flu_to_frd(forward: float, left: float, up: float) -> Vector3:
    """Turn a body vector (rates too) from FLU into FRD; exact, any unit."""
    return forward, -left, -up


def frd_to_flu(forward: float, right: float, down: float) -> Vector3:
    """Turn a body vector (rates too) from FRD into FLU; exact, any unit."""
    return forward, -right, -down


def attitude_enu_to_ned(w: float, x: float, y: float, z: float) -> Quaternion:
    """Turn an attitude FLU-to-ENU into the same attitude FRD-to-NED.

    The product q(ENU to NED) * q * q(FRD to FLU) with q(ENU to NED) = (0, 1, 1, 0) / sqrt 2 and
    q(FRD to FLU) = (0, 1, 0, 0), with the overall sign turned so that the identity keeps w > 0.

    Args:
        w: Quaternion body FLU to ENU, w first.
        x: First imaginary part.
        y: Second imaginary part.
        z: Third imaginary part.
    """
    return (w + z) * _SQRT_HALF, (x + y) * _SQRT_HALF, (x - y) * _SQRT_HALF, (w - z) * _SQRT_HALF


def attitude_ned_to_enu(w: float, x: float, y: float, z: float) -> Quaternion:
    """Turn an attitude FRD-to-NED into the same attitude FLU-to-ENU.

    The map of `attitude_enu_to_ned` is its own inverse.
    """
    return (w + z) * _SQRT_HALF, (x + y) * _SQRT_HALF, (x - y) * _SQRT_HALF, (w - z) * _SQRT_HALF


def yaw_enu_to_ned(yaw_enu_rad: float) -> float:
    """Turn a yaw (0 east, counter-clockwise) into NED (0 north, clockwise), in (-pi, pi]."""
    return wrap_angle(_HALF_PI - yaw_enu_rad)


def yaw_ned_to_enu(yaw_ned_rad: float) -> float:
    """Turn a yaw (0 north, clockwise) into ENU (0 east, counter-clockwise), in (-pi, pi]."""
    return wrap_angle(_HALF_PI - yaw_ned_rad)


def yaw_enu_to_compass_deg(yaw_enu_rad: float) -> float:
    """Turn an ENU yaw into degrees clockwise from north, in [0, 360)."""
    angle_deg = 90.0 - math.degrees(wrap_angle(yaw_enu_rad))
    angle_deg = angle_deg + 360.0 if angle_deg < 0.0 else angle_deg
    # A tiny negative angle rounds up to the full turn.
    return 0.0 if angle_deg >= 360.0 else angle_deg


def compass_deg_to_yaw_enu(angle_deg: float) -> float:
    """Turn degrees clockwise from north into an ENU yaw in (-pi, pi]."""
    return wrap_angle(math.radians(90.0 - angle_deg))


def sumo_angle_to_heading(angle_deg: float) -> tuple[float, float]:
    """Return the unit vector (east, north) that SUMO's angle points along.

    Quarter turns are exact (`math.sin` of pi is not 0), so streets along the axes give
    coordinates without rounding dust.

    Args:
        angle_deg: Degrees clockwise from north, any real number.
    """
    turned_deg = math.fmod(angle_deg, 360.0)
    if turned_deg < 0.0:
        turned_deg += 360.0
    exact = _QUARTERS.get(turned_deg)
    if exact is not None:
        return exact
    angle_rad = math.radians(turned_deg)
    return math.sin(angle_rad), math.cos(angle_rad)


def heading_to_sumo_angle(east: float, north: float) -> float:
    """Return SUMO's angle, in [0, 360], of a vector of any length; exact along the axes."""
    if east == 0.0:
        return 0.0 if north >= 0.0 else 180.0
    if north == 0.0:
        return 90.0 if east > 0.0 else 270.0
    angle_deg = math.degrees(math.atan2(east, north))
    return angle_deg if angle_deg >= 0.0 else angle_deg + 360.0


def heading_to_yaw_enu(east: float, north: float) -> float:
    """Return the ENU yaw in (-pi, pi] of a vector of any length."""
    return math.atan2(north, east)


def offset_at_bearing(distance_m: float, bearing_deg: float) -> tuple[float, float]:
    """Return (east, north) in metres of what lies at a distance, clockwise from north."""
    compass_rad = bearing_deg * math.pi / 180.0
    return distance_m * math.sin(compass_rad), distance_m * math.cos(compass_rad)


def quaternion_to_yaw_enu(w: float, x: float, y: float, z: float) -> float:
    """Return the ENU yaw in (-pi, pi] of the body x axis projected on the ground.

    Args:
        w: Unit quaternion body FLU to ENU, w first.
        x: First imaginary part.
        y: Second imaginary part.
        z: Third imaginary part.
    """
    return math.atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z))


def quaternion_to_euler_ned(w: float, x: float, y: float, z: float) -> Vector3:
    """Return (roll, pitch, yaw) in rad of an attitude FRD-to-NED: yaw first, then pitch, roll."""
    return (
        math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y)),
        math.asin(min(max(2.0 * (w * y - z * x), -1.0), 1.0)),
        math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)),
    )


def enu_to_geodetic(
    east_m: float, north_m: float, origin_lat_deg: float, origin_lon_deg: float
) -> tuple[float, float]:
    """Return (latitude, longitude) in degrees of a point near the origin.

    Flat around the origin on a sphere, as autopilots do; good to about 1 m over 5 km. Only for
    telemetry and goals on the MAVLink border: maps use their own projection.
    """
    lat_deg = origin_lat_deg + math.degrees(north_m / EARTH_RADIUS_M)
    scale = math.cos(math.radians(origin_lat_deg))
    lon_deg = origin_lon_deg + math.degrees(east_m / (EARTH_RADIUS_M * scale))
    return lat_deg, lon_deg


def geodetic_to_enu(
    lat_deg: float, lon_deg: float, origin_lat_deg: float, origin_lon_deg: float
) -> tuple[float, float]:
    """Return (east, north) in metres of a geodetic point near the origin."""
    north_m = math.radians(lat_deg - origin_lat_deg) * EARTH_RADIUS_M
    scale = math.cos(math.radians(origin_lat_deg))
    east_m = math.radians(lon_deg - origin_lon_deg) * EARTH_RADIUS_M * scale
    return east_m, north_m
