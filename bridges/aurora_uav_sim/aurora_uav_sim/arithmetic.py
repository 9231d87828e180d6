# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sine and cosine from + - * / alone.

The mathematical library of one machine differs from the next in the last bit, which a controlled
flight would carry into every later state. These give the same bits everywhere.
"""

from __future__ import annotations

import math

# pi/2 as a sum of two doubles, the first with 33 bits, so that k * _HALF_PI_HIGH is exact for
# every |k| < 2^20. Source: fdlibm, __ieee754_rem_pio2.
_HALF_PI_HIGH = 1.57079632673412561417
_HALF_PI_LOW = 6.07710050650619224932e-11


def sin_cos(angle_rad: float) -> tuple[float, float]:
    """Return (sin, cos) of a finite angle, good to 4e-16 for |angle| < 1e5.

    Source: Taylor series on [-pi/4, pi/4]; the first term left out is below 5e-17.
    """
    quarter = math.floor(angle_rad / (_HALF_PI_HIGH + _HALF_PI_LOW) + 0.5)
    x = (angle_rad - quarter * _HALF_PI_HIGH) - quarter * _HALF_PI_LOW
    s = x * x
    sine = x * (
        1.0
        - s
        / 6.0
        * (
            1.0
            - s
            / 20.0
            * (
                1.0
                - s
                / 42.0
                * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0 * (1.0 - s / 210.0))))
            )
        )
    )
    cosine = 1.0 - s / 2.0 * (
        1.0
        - s
        / 12.0
        * (
            1.0
            - s
            / 30.0
            * (
                1.0
                - s
                / 56.0
                * (1.0 - s / 90.0 * (1.0 - s / 132.0 * (1.0 - s / 182.0 * (1.0 - s / 240.0))))
            )
        )
    )
    turn = quarter % 4
    if turn == 0:
        return sine, cosine
    if turn == 1:
        return cosine, -sine
    if turn == 2:
        return -sine, -cosine
    return -cosine, sine
