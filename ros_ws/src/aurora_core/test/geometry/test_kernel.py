# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Scalar and array arithmetic agree to the last bit."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.geometry import kernel

LENGTH = st.floats(-1e6, 1e6, allow_nan=False)


@settings(derandomize=True, deadline=None, max_examples=200)
@given(rows=st.lists(st.tuples(LENGTH, LENGTH, LENGTH), min_size=1, max_size=40))
def test_norms_of_scalars_and_arrays_have_the_same_bits(
    rows: list[tuple[float, float, float]],
) -> None:
    x, y, z = np.array(rows).T
    plane, space = kernel.norm2_array(x, y), kernel.norm3_array(x, y, z)
    assert plane.tolist() == [kernel.norm2(a, b) for a, b, _ in rows]
    assert space.tolist() == [kernel.norm3(a, b, c) for a, b, c in rows]


def test_norms_are_euclidean() -> None:
    assert kernel.norm2(3.0, -4.0) == 5.0
    assert kernel.norm3(2.0, -3.0, 6.0) == 7.0
    assert math.isnan(kernel.norm2(math.nan, 1.0))


def test_point_segment_distance_to_ends_and_inside() -> None:
    wx, wy = np.array([-3.0, 5.0, 14.0]), np.array([4.0, 2.0, 3.0])
    side = np.full(3, 10.0), np.zeros(3)
    square = kernel.point_segment_sq(wx, wy, *side, np.full(3, 100.0))
    assert square.tolist() == [25.0, 4.0, 25.0]


def test_a_segment_of_length_zero_is_its_point() -> None:
    ee = kernel.nonzero(np.zeros(1))
    square = kernel.point_segment_sq(
        np.array([3.0]), np.array([4.0]), np.zeros(1), np.zeros(1), ee
    )
    assert square.tolist() == [25.0]
