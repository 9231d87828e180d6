# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Frames in all quadrants: a wrong sign here mirrors every flight."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_core.geometry import frames

metres = st.floats(-1e5, 1e5)
angles_rad = st.floats(-50.0, 50.0)


def rotate(q: frames.Quaternion, v: frames.Vector3) -> frames.Vector3:
    """Turn a body vector by a quaternion through the rotation matrix."""
    w, x, y, z = q
    a, b, c = v
    return (
        (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c,
        2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c,
        2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c,
    )


@st.composite
def unit_quaternions(draw: st.DrawFn) -> frames.Quaternion:
    parts = [draw(st.floats(-1.0, 1.0)) for _ in range(4)]
    norm = math.sqrt(sum(p * p for p in parts))
    if norm < 1e-3:
        return 1.0, 0.0, 0.0, 0.0
    return parts[0] / norm, parts[1] / norm, parts[2] / norm, parts[3] / norm


@given(metres, metres, metres)
def test_vectors_come_back_exactly(a: float, b: float, c: float) -> None:
    assert frames.ned_to_enu(*frames.enu_to_ned(a, b, c)) == (a, b, c)
    assert frames.frd_to_flu(*frames.flu_to_frd(a, b, c)) == (a, b, c)


def test_axes() -> None:
    assert frames.enu_to_ned(1.0, 2.0, 3.0) == (2.0, 1.0, -3.0)
    assert frames.flu_to_frd(1.0, 2.0, 3.0) == (1.0, -2.0, -3.0)


@given(unit_quaternions(), metres, metres, metres)
def test_attitude_agrees_with_vectors(q: frames.Quaternion, a: float, b: float, c: float) -> None:
    """Turning first and changing frame afterwards is changing frame first and turning then."""
    via_enu = frames.enu_to_ned(*rotate(q, (a, b, c)))
    via_ned = rotate(frames.attitude_enu_to_ned(*q), frames.flu_to_frd(a, b, c))
    scale = 1.0 + abs(a) + abs(b) + abs(c)
    assert via_ned == pytest.approx(via_enu, abs=1e-12 * scale)


@given(unit_quaternions())
def test_attitude_comes_back(q: frames.Quaternion) -> None:
    back = frames.attitude_ned_to_enu(*frames.attitude_enu_to_ned(*q))
    assert back == pytest.approx(q, abs=1e-15)


@pytest.mark.parametrize(
    ('yaw_enu_deg', 'yaw_ned_deg', 'sumo_deg', 'east', 'north'),
    [
        (0.0, 90.0, 90.0, 1.0, 0.0),
        (90.0, 0.0, 0.0, 0.0, 1.0),
        (180.0, -90.0, 270.0, -1.0, 0.0),
        (-90.0, 180.0, 180.0, 0.0, -1.0),
        (45.0, 45.0, 45.0, math.sqrt(0.5), math.sqrt(0.5)),
        (135.0, -45.0, 315.0, -math.sqrt(0.5), math.sqrt(0.5)),
        (-135.0, -135.0, 225.0, -math.sqrt(0.5), -math.sqrt(0.5)),
        (-45.0, 135.0, 135.0, math.sqrt(0.5), -math.sqrt(0.5)),
    ],
)
def test_headings_in_all_quadrants(
    yaw_enu_deg: float, yaw_ned_deg: float, sumo_deg: float, east: float, north: float
) -> None:
    yaw_rad = math.radians(yaw_enu_deg)
    assert math.degrees(frames.yaw_enu_to_ned(yaw_rad)) == pytest.approx(yaw_ned_deg)
    assert math.degrees(frames.yaw_ned_to_enu(math.radians(yaw_ned_deg))) == pytest.approx(
        yaw_enu_deg
    )
    assert frames.yaw_enu_to_compass_deg(yaw_rad) == pytest.approx(sumo_deg, abs=1e-9)
    assert frames.compass_deg_to_yaw_enu(sumo_deg) == pytest.approx(yaw_rad)
    assert frames.offset_at_bearing(3.0, sumo_deg) == pytest.approx((3.0 * east, 3.0 * north))
    assert frames.sumo_angle_to_heading(sumo_deg) == pytest.approx((east, north), abs=1e-12)
    assert frames.heading_to_sumo_angle(3.0 * east, 3.0 * north) == pytest.approx(
        sumo_deg, abs=1e-9
    )
    half = yaw_rad / 2.0
    q = (math.cos(half), 0.0, 0.0, math.sin(half))
    assert frames.quaternion_to_yaw_enu(*q) == pytest.approx(yaw_rad)


@given(angles_rad)
def test_wrapping_keeps_the_direction(angle_rad: float) -> None:
    wrapped = frames.wrap_angle(angle_rad)
    assert -math.pi < wrapped <= math.pi
    assert math.cos(wrapped) == pytest.approx(math.cos(angle_rad), abs=1e-12)
    assert math.sin(wrapped) == pytest.approx(math.sin(angle_rad), abs=1e-12)
    assert 0.0 <= frames.yaw_enu_to_compass_deg(angle_rad) < 360.0


@given(st.floats(0.0, 359.999))
def test_compass_angle_comes_back(angle_deg: float) -> None:
    yaw_rad = frames.compass_deg_to_yaw_enu(angle_deg)
    gap_deg = abs(frames.yaw_enu_to_compass_deg(yaw_rad) - angle_deg)
    assert min(gap_deg, 360.0 - gap_deg) < 1e-9
    assert frames.sumo_angle_to_heading(angle_deg) == pytest.approx(
        (math.cos(yaw_rad), math.sin(yaw_rad)), abs=1e-12
    )


@pytest.mark.parametrize(
    ('angle_deg', 'heading'),
    [
        (0.0, (0.0, 1.0)),
        (90.0, (1.0, 0.0)),
        (180.0, (0.0, -1.0)),
        (270.0, (-1.0, 0.0)),
        (360.0, (0.0, 1.0)),
        (-90.0, (-1.0, 0.0)),
        (450.0, (1.0, 0.0)),
        (-1e-30, (0.0, 1.0)),
    ],
)
def test_quarter_turns_are_exact(angle_deg: float, heading: tuple[float, float]) -> None:
    assert frames.sumo_angle_to_heading(angle_deg) == heading


@pytest.mark.parametrize(
    ('angle_deg', 'east_sign', 'north_sign'),
    [(45.0, 1, 1), (135.0, 1, -1), (225.0, -1, -1), (315.0, -1, 1)],
)
def test_compass_runs_clockwise_from_north(
    angle_deg: float, east_sign: int, north_sign: int
) -> None:
    half = math.sqrt(0.5)
    assert frames.sumo_angle_to_heading(angle_deg) == pytest.approx(
        (east_sign * half, north_sign * half), abs=1e-15
    )


@given(st.floats(-1080.0, 1080.0))
def test_heading_is_a_unit_vector_and_turns_back(angle_deg: float) -> None:
    heading_x, heading_y = frames.sumo_angle_to_heading(angle_deg)
    assert heading_x * heading_x + heading_y * heading_y == pytest.approx(1.0, abs=1e-12)
    back_deg = frames.heading_to_sumo_angle(heading_x, heading_y)
    assert 0.0 <= back_deg <= 360.0
    assert math.remainder(back_deg - angle_deg, 360.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize('angle_deg', [0.0, 90.0, 180.0, 270.0])
def test_axes_turn_back_exactly(angle_deg: float) -> None:
    assert frames.heading_to_sumo_angle(*frames.sumo_angle_to_heading(angle_deg)) == angle_deg


@given(
    st.floats(-5000.0, 5000.0),
    st.floats(-5000.0, 5000.0),
    st.floats(-70.0, 70.0),
    st.floats(-170.0, 170.0),
)
def test_geodetic_comes_back(east_m: float, north_m: float, lat: float, lon: float) -> None:
    point = frames.enu_to_geodetic(east_m, north_m, lat, lon)
    back = frames.geodetic_to_enu(point[0], point[1], lat, lon)
    assert back == pytest.approx((east_m, north_m), abs=1e-5)


def test_geodetic_directions() -> None:
    lat, lon = frames.enu_to_geodetic(100.0, 200.0, 48.0, 11.0)
    assert lat > 48.0
    assert lon > 11.0
    # One degree of latitude is about 111 km.
    assert (lat - 48.0) * 111_000.0 == pytest.approx(200.0, rel=0.01)


@pytest.mark.parametrize(
    ('east', 'north', 'yaw_deg'), [(2.0, 0.0, 0.0), (0.0, 3.0, 90.0), (-1.0, 0.0, 180.0)]
)
def test_the_yaw_of_a_heading_runs_from_east(east: float, north: float, yaw_deg: float) -> None:
    assert frames.heading_to_yaw_enu(east, north) == pytest.approx(math.radians(yaw_deg))


@pytest.mark.parametrize('axis', [0, 1, 2], ids=['roll', 'pitch', 'yaw'])
def test_a_turn_round_one_axis_is_that_angle_alone(axis: int) -> None:
    turned = [math.cos(0.15), 0.0, 0.0, 0.0]
    turned[axis + 1] = math.sin(0.15)
    wanted = [0.0, 0.0, 0.0]
    wanted[axis] = 0.3
    assert frames.quaternion_to_euler_ned(*turned) == pytest.approx(wanted)
