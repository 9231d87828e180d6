# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Poses cross the border to SUMO without loss, in every quadrant."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_sumo_bridge.conversions import (
    KERB_CLEARANCE_M,
    centre_from_front,
    front_from_centre,
    heading_from_sumo_angle,
    kerb_offset_m,
    sumo_angle_from_heading,
)

_ANGLES = st.floats(min_value=-1080.0, max_value=1080.0)
_METRES = st.floats(min_value=-5000.0, max_value=5000.0)


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
    assert heading_from_sumo_angle(angle_deg) == heading


@pytest.mark.parametrize(
    ('angle_deg', 'east_sign', 'north_sign'),
    [(45.0, 1, 1), (135.0, 1, -1), (225.0, -1, -1), (315.0, -1, 1)],
)
def test_compass_runs_clockwise_from_north(
    angle_deg: float, east_sign: int, north_sign: int
) -> None:
    half = math.sqrt(0.5)
    assert heading_from_sumo_angle(angle_deg) == pytest.approx(
        (east_sign * half, north_sign * half), abs=1e-15
    )


@given(_ANGLES)
def test_heading_is_a_unit_vector_and_turns_back(angle_deg: float) -> None:
    heading_x, heading_y = heading_from_sumo_angle(angle_deg)
    assert heading_x * heading_x + heading_y * heading_y == pytest.approx(1.0, abs=1e-12)
    back_deg = sumo_angle_from_heading(heading_x, heading_y)
    assert 0.0 <= back_deg <= 360.0
    assert math.remainder(back_deg - angle_deg, 360.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize('angle_deg', [0.0, 90.0, 180.0, 270.0])
def test_axes_turn_back_exactly(angle_deg: float) -> None:
    assert sumo_angle_from_heading(*heading_from_sumo_angle(angle_deg)) == angle_deg


def test_centre_lies_half_a_length_behind_the_front() -> None:
    # Heading west: the centre of a 12 m bus is 6 m east of its front bumper.
    assert centre_from_front(100.0, 5.0, -1.0, 0.0, 12.0) == (106.0, 5.0)


@given(_METRES, _METRES, _ANGLES, st.floats(min_value=0.1, max_value=20.0))
def test_front_and_centre_are_inverse(
    x_m: float, y_m: float, angle_deg: float, length_m: float
) -> None:
    heading = heading_from_sumo_angle(angle_deg)
    front = front_from_centre(x_m, y_m, *heading, length_m)
    assert centre_from_front(*front, *heading, length_m) == pytest.approx((x_m, y_m), abs=1e-9)


def test_parked_vehicle_leaves_the_lane_free() -> None:
    offset_m = kerb_offset_m(lane_width_m=3.3, vehicle_width_m=2.5)
    assert offset_m - 2.5 / 2 == pytest.approx(3.3 / 2 + KERB_CLEARANCE_M)
