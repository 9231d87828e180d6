# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Arc lengths, offsets, bends and overlaps of plain geometry."""

from __future__ import annotations

import math
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from shapely import affinity
from shapely.geometry import box as shapely_box

from aurora_sumo_bridge.polyline import Box, boxes_overlap, polyline

# 10 m east, then 10 m north.
CORNER = polyline(((0.0, 0.0), (10.0, 0.0), (10.0, 0.0), (10.0, 10.0)))


def test_points_and_tangents_along_a_corner() -> None:
    assert CORNER.length_m == 20.0
    assert CORNER.at(4.0) == ((4.0, 0.0), (1.0, 0.0))
    assert CORNER.at(13.0) == ((10.0, 3.0), (0.0, 1.0))


def test_arc_length_is_clamped_to_the_line() -> None:
    assert CORNER.at(-5.0)[0] == (0.0, 0.0)
    assert CORNER.at(50.0)[0] == (10.0, 10.0)


def test_left_is_positive() -> None:
    assert CORNER.left_offset_m((4.0, 1.5), 4.0) == 1.5
    assert CORNER.left_offset_m((12.0, 15.0), 15.0) == -2.0


def test_bend_is_zero_on_the_straight_and_known_in_the_corner() -> None:
    assert CORNER.bend_m(5.0, 3.0) == pytest.approx(0.0, abs=1e-12)
    # Chord from (8, 0) to (10, 2); its middle is (9, 1), the corner (10, 0).
    assert CORNER.bend_m(10.0, 2.0) == pytest.approx(math.sqrt(2.0))


def test_a_single_point_is_no_line() -> None:
    with pytest.raises(ValueError, match='two different points'):
        polyline(((1.0, 1.0), (1.0, 1.0)))


def test_touching_boxes_do_not_overlap() -> None:
    a = Box(x_m=0.0, y_m=0.0, heading_x=1.0, heading_y=0.0, length_m=4.0, width_m=2.0)
    b = Box(x_m=4.0, y_m=0.0, heading_x=1.0, heading_y=0.0, length_m=4.0, width_m=2.0)
    c = Box(x_m=3.9, y_m=0.0, heading_x=1.0, heading_y=0.0, length_m=4.0, width_m=2.0)
    assert not boxes_overlap(a, b)
    assert boxes_overlap(a, c)


_PLACES = st.floats(min_value=-6.0, max_value=6.0)
_SIZES = st.floats(min_value=0.5, max_value=8.0)
_YAWS = st.floats(min_value=-math.pi, max_value=math.pi)


@given(_PLACES, _PLACES, _YAWS, _YAWS, _SIZES, _SIZES)
def test_overlap_agrees_with_shapely(
    x_m: float, y_m: float, yaw_a: float, yaw_b: float, length_m: float, width_m: float
) -> None:
    def ours(x: float, y: float, yaw: float) -> Box:
        return Box(
            x_m=x,
            y_m=y,
            heading_x=math.cos(yaw),
            heading_y=math.sin(yaw),
            length_m=length_m,
            width_m=width_m,
        )

    def theirs(x: float, y: float, yaw: float) -> Any:
        shape = shapely_box(-length_m / 2, -width_m / 2, length_m / 2, width_m / 2)
        turned = affinity.rotate(shape, yaw, origin=(0, 0), use_radians=True)
        return affinity.translate(turned, x, y)

    area_m2 = theirs(0.0, 0.0, yaw_a).intersection(theirs(x_m, y_m, yaw_b)).area
    overlap = boxes_overlap(ours(0.0, 0.0, yaw_a), ours(x_m, y_m, yaw_b))
    # Within rounding of a mere touch either answer is right.
    assert overlap == (area_m2 > 0.0) or area_m2 < 1e-9
