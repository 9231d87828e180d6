# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The wind that a multirotor leans against in level flight: what blew, not what was recorded."""

from __future__ import annotations

import numpy as np

from aurora_bench.checker import limits
from aurora_bench.checker.recording import LANDED, UZ, VX, VZ, FloatArray
from aurora_bench.checker.scene import Scene

# First of the four columns of the attitude (UavState.msg), body FLU to ENU.
QW = 6
GRAVITY_MPS2 = 9.80665
# Level: it neither climbs nor sinks faster (m/s), and is so high (m).
LEVEL_MPS, AIRBORNE_M = 1.0, 1.0
# A mean of fewer samples says nothing.
LEAST_SAMPLES = 100


def wind_shown(scene: Scene, uav: str) -> FloatArray | None:
    """Return the mean wind (east, north) in m/s that a flight shows, None where it shows none."""
    rows = scene.recording.uav[:, scene.bodies[uav].row]
    attitude = rows[:, QW : QW + 4]
    if not np.allclose(np.linalg.norm(attitude, axis=1), 1.0, atol=1e-2):
        return None  # no attitude was recorded
    w, x, y, z = attitude.T
    up = 1.0 - 2.0 * (x * x + y * y)
    tilt = np.column_stack((2.0 * (x * z + w * y), 2.0 * (y * z - w * x))) / up[:, None]
    velocity = rows[:, VX : VZ + 1]
    gain = np.gradient(velocity, scene.dt_s, axis=0)
    level = (np.abs(velocity[:, 2]) < LEVEL_MPS) & (rows[:, UZ] > AIRBORNE_M)
    level &= (rows[:, LANDED] < 0.5) & (up > 0.3)
    if np.count_nonzero(level) < LEAST_SAMPLES:
        return None
    # What the lean gives beyond the gain of speed is lost to drag.
    lost = tilt * (gain[:, 2:] + GRAVITY_MPS2) - gain[:, :2]
    size = np.linalg.norm(lost, axis=1)
    linear, square = limits.DRAG_HZ, limits.DRAG_PER_M
    speed = (np.sqrt(linear**2 + 4.0 * square * size) - linear) / (2.0 * square)
    through = lost * np.divide(speed, size, out=np.zeros_like(size), where=size > 0.0)[:, None]
    shown: FloatArray = (velocity[:, :2] - through)[level].mean(axis=0)
    return shown
