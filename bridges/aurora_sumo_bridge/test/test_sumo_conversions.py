# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Poses cross the border to SUMO without loss, in every quadrant."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_core.geometry.frames import sumo_angle_to_heading
from aurora_core.ports.simulators import KERB_CLEARANCE_M, kerb_offset_m
from aurora_sumo_bridge.conversions import centre_from_front, front_from_centre

_ANGLES = st.floats(min_value=-1080.0, max_value=1080.0)
_METRES = st.floats(min_value=-5000.0, max_value=5000.0)


def test_centre_lies_half_a_length_behind_the_front() -> None:
    # Heading west: the centre of a 12 m bus is 6 m east of its front bumper.
    assert centre_from_front(100.0, 5.0, -1.0, 0.0, 12.0) == (106.0, 5.0)


@given(_METRES, _METRES, _ANGLES, st.floats(min_value=0.1, max_value=20.0))
def test_front_and_centre_are_inverse(
    x_m: float, y_m: float, angle_deg: float, length_m: float
) -> None:
    heading = sumo_angle_to_heading(angle_deg)
    front = front_from_centre(x_m, y_m, *heading, length_m)
    assert centre_from_front(*front, *heading, length_m) == pytest.approx((x_m, y_m), abs=1e-9)


def test_parked_vehicle_leaves_the_lane_free() -> None:
    offset_m = kerb_offset_m(lane_width_m=3.3, vehicle_width_m=2.5)
    assert offset_m - 2.5 / 2 == pytest.approx(3.3 / 2 + KERB_CLEARANCE_M)
