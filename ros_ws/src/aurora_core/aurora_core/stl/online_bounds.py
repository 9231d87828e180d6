# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Limits of values that are still open.

Bounds are one array (2, m) with m >= 1: the least (row 0) and the greatest (row 1) that the values
from some sample on can become; the last column holds for ever after. They hold for every finite
continuation that is long enough for the value to exist. One array because with few samples the
number of numpy's calls is what costs, and most work treats both limits alike.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from aurora_core.stl.windows import FloatArray

INF = float('inf')
Bounds = FloatArray
OPEN: Bounds = np.array([[-INF], [INF]])
OPEN.flags.writeable = False


def since(bounds: Bounds, skipped: int) -> Bounds:
    """Return the bounds from `skipped` samples later on."""
    return bounds[:, min(skipped, bounds.shape[1] - 1) :] if skipped else bounds


def extended(bounds: Bounds, length: int) -> Bounds:
    """Return the same bounds with at least `length` of them written out."""
    m = bounds.shape[1]
    if length <= m:
        return bounds
    longer = np.empty((2, length))
    longer[:, :m] = bounds
    longer[:, m:] = bounds[:, -1:]
    return longer


def preceded(values: FloatArray, bounds: Bounds) -> Bounds:
    """Return bounds with final values in front."""
    n = len(values)
    if not n:
        return bounds
    longer = np.empty((2, n + bounds.shape[1]))
    longer[:, :n] = values
    longer[:, n:] = bounds
    return longer


def by_limit(function: Callable[..., FloatArray], *bounds: Bounds) -> Bounds:
    """Return what a function of rows makes of the least, and of the greatest of each."""
    return np.stack([function(*rows) for rows in zip(*bounds, strict=True)])
