# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compass bearings from + - * / sqrt alone, so that they agree to the bit everywhere.

`atan2` of the C library may differ in the last bit between machines; here the argument is halved
four times (atan t = 2 atan(t / (1 + sqrt(1 + t^2)))) and the rest is a short odd series.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_DEGREES = 57.29577951308232  # 180 / pi
_HALVINGS = 4
_TERMS = 9  # the argument is at most 0.05: the next term is below 1e-26


def _atan01(t: FloatArray) -> FloatArray:
    """Return atan of 0 <= t <= 1 in rad."""
    for _ in range(_HALVINGS):
        t = t / (1.0 + np.sqrt(1.0 + t * t))
    square = t * t
    total = np.zeros_like(t)
    for k in range(_TERMS - 1, -1, -1):
        total = total * square * -1.0 + 1.0 / (2 * k + 1)
    result: FloatArray = total * t * float(2**_HALVINGS)
    return result


def compass_bearing_deg(east: FloatArray, north: FloatArray) -> FloatArray:
    """Return the direction of vectors in degrees clockwise from north, in [0, 360); 0 for none."""
    a, b = np.abs(east), np.abs(north)
    large = np.maximum(a, b)
    small = np.minimum(a, b)
    angle = _atan01(small / np.where(large == 0.0, 1.0, large)) * _DEGREES
    from_north = np.where(a > b, 90.0 - angle, angle)
    bearing = np.where(north < 0.0, 180.0 - from_north, from_north)
    bearing = np.where(east < 0.0, 360.0 - bearing, bearing)
    return np.where(bearing >= 360.0, 0.0, bearing)


def turned_deg(bearing_deg: FloatArray) -> FloatArray:
    """Return by how much a bearing turned clockwise since its first sample, (T,) degrees.

    Each step is less than half a turn.
    """
    step = bearing_deg[1:] - bearing_deg[:-1]
    step = np.where(step > 180.0, step - 360.0, np.where(step < -180.0, step + 360.0, step))
    return np.concatenate(([0.0], np.add.accumulate(step)))


def bearing_error_deg(bearing_deg: FloatArray, wanted_deg: float) -> FloatArray:
    """Return the angle between bearings and a wanted one, in [0, 180]."""
    off = np.abs(bearing_deg - wanted_deg % 360.0)
    result: FloatArray = np.minimum(off, 360.0 - off)
    return result
