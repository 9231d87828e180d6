# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Wind at one vehicle: a mean plus gusts from a seeded stream of its own."""

from __future__ import annotations

import hashlib
from math import sqrt

import numpy as np

# Correlation time of the gusts. A Dryden field of length 50 m at low altitude that passes at
# 20 to 25 m/s decorrelates in about 2 s. Source: MIL-F-8785C, low-altitude model.
_CORRELATION_S = 2.0
# Vertical turbulence over horizontal, below 300 m. Source: MIL-F-8785C (0.5 is its low end).
_VERTICAL_SHARE = 0.5
_BLOCK = 384


def wind_stream(seed: int, system_id: int) -> np.random.Generator:
    """Return the random stream of one vehicle's gusts.

    Args:
        seed: Seed of the run, 0 to 2^64 - 1.
        system_id: MAVLink system id of the vehicle.
    """
    name = hashlib.sha256(f'aurora_uav_sim/wind/{system_id}'.encode()).digest()
    return np.random.Generator(
        np.random.PCG64(np.random.SeedSequence([seed, int.from_bytes(name[:8], 'little')]))
    )


class Wind:
    """First-order filtered noise per axis around a mean, bounded by the gust amplitude.

    The standard deviation is half the gust amplitude and a gust never exceeds the amplitude, per
    horizontal axis; vertical gusts are half as strong. The noise that drives the filter is
    uniform: after the filter it is close to normal, and it needs no logarithm.

    Attributes:
        x: Wind towards east now, m/s (y north, z up).
    """

    __slots__ = ('_gain', '_gust', '_h', '_mean_x', '_mean_y', '_mean_z', '_noise', '_rng',
                 '_unit_drive', 'gx', 'gy', 'gz', 'x', 'y', 'z')  # fmt: skip

    def __init__(self) -> None:
        self._rng: np.random.Generator | None = None
        self._noise: list[float] = []
        self._h = 0.0  # the step that the next two are for
        self._gain = self._unit_drive = 0.0
        self.set(0.0, 0.0, 0.0, 0.0)

    def set(self, mean_x: float, mean_y: float, mean_z: float, gust_mps: float) -> None:
        """Set the mean (ENU) and the gust amplitude, m/s, and start calm.

        Args:
            mean_x: Mean wind towards east.
            mean_y: Mean wind towards north.
            mean_z: Mean wind upwards.
            gust_mps: Largest deviation from the mean per horizontal axis, >= 0.
        """
        self._mean_x, self._mean_y, self._mean_z = mean_x, mean_y, mean_z
        self._gust = gust_mps
        self.x, self.y, self.z = mean_x, mean_y, mean_z
        self.gx = self.gy = self.gz = 0.0

    def seed(self, rng: np.random.Generator) -> None:
        """Take a fresh random stream and start calm."""
        self._rng = rng
        self._noise = []
        self.set(self._mean_x, self._mean_y, self._mean_z, self._gust)

    @property
    def is_steady(self) -> bool:
        """Whether there are no gusts."""
        return self._gust == 0.0 or self._rng is None

    def step(self, h: float) -> None:
        """Advance the gusts by `h` seconds; free when there are none."""
        gust = self._gust
        if gust == 0.0 or self._rng is None:
            return
        noise = self._noise
        if not noise:
            # Uniform on +-sqrt 3 has variance 1.
            draws = self._rng.random(_BLOCK) * (2.0 * sqrt(3.0)) - sqrt(3.0)
            self._noise = noise = draws.tolist()
        if h != self._h:
            self._h = h
            self._gain = h / (_CORRELATION_S + h)
            # An autoregression y += gain (n - y) has variance gain / (2 - gain): undo it.
            self._unit_drive = sqrt((2.0 - self._gain) / self._gain)
        gain = self._gain
        drive = 0.5 * gust * self._unit_drive
        limit_z = _VERTICAL_SHARE * gust
        gx = self.gx + gain * (drive * noise.pop() - self.gx)
        gy = self.gy + gain * (drive * noise.pop() - self.gy)
        gz = self.gz + gain * (_VERTICAL_SHARE * drive * noise.pop() - self.gz)
        if not -gust <= gx <= gust:
            gx = gust if gx > gust else -gust
        if not -gust <= gy <= gust:
            gy = gust if gy > gust else -gust
        if not -limit_z <= gz <= limit_z:
            gz = limit_z if gz > limit_z else -limit_z
        self.gx, self.gy, self.gz = gx, gy, gz
        self.x, self.y, self.z = self._mean_x + gx, self._mean_y + gy, self._mean_z + gz
