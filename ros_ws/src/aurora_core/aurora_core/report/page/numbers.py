# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of a page, as few digits as the eye needs."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]

_DIGITS = 4


def whole(values: FloatArray, step: float) -> list[int]:
    """Return values in whole steps, each as the difference to the one before."""
    steps = np.round(values / step).astype(np.int64)
    return np.diff(steps, prepend=0).tolist()  # type: ignore[no-any-return]


def rounded(values: FloatArray) -> list[float | None]:
    """Return values with four digits of the greatest of them; None where there is none."""
    finite = np.isfinite(values)
    top = float(np.abs(values[finite]).max()) if finite.any() else 0.0
    decimals = _DIGITS - (math.ceil(math.log10(top)) if top > 0.0 else 0)
    kept = np.round(values, min(decimals, 9))
    return [float(v) if ok else None for v, ok in zip(kept, finite, strict=True)]


def seconds(ticks: npt.NDArray[np.intp] | FloatArray, dt_s: float) -> list[float]:
    """Return simulated times of ticks."""
    return np.round(np.asarray(ticks, dtype=np.float64) * dt_s, 3).tolist()  # type: ignore[no-any-return]
