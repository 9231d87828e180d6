# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sine and cosine without the mathematical library."""

from __future__ import annotations

import math

from hypothesis import given
from hypothesis import strategies as st

from aurora_uav_sim.arithmetic import sin_cos


@given(st.floats(-1000.0, 1000.0))
def test_agrees_with_the_library(angle_rad: float) -> None:
    sine, cosine = sin_cos(angle_rad)
    assert abs(sine - math.sin(angle_rad)) < 5e-16
    assert abs(cosine - math.cos(angle_rad)) < 5e-16


def test_exact_where_it_matters() -> None:
    assert sin_cos(0.0) == (0.0, 1.0)
