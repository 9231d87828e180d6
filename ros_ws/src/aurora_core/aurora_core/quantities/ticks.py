# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Durations in whole ticks and searches in time."""

from __future__ import annotations

from math import ceil

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# A duration this close to a whole number of ticks is that number: 0.15 / 0.05 is above 3.
TICK_GUARD = 1e-9


def whole_ticks(duration_s: float, dt_s: float) -> int:
    """Return the least number of ticks that lasts `duration_s`."""
    return ceil(duration_s / dt_s - TICK_GUARD)


def first_tick(mask: BoolArray, start: int = 0, stop: int | None = None) -> int | None:
    """Return the first tick in [start, stop) at which the mask is true, None if there is none."""
    part = mask[start:stop]
    index = int(np.argmax(part)) if len(part) else 0
    return start + index if len(part) and bool(part[index]) else None


def onset_tick(mask: BoolArray, start: int, *, begins_there: bool) -> int | None:
    """Return the first tick from `start` on in the mask, or where a stretch of it begins."""
    if begins_there:
        mask = mask & ~np.concatenate(([False], mask[:-1]))
    return first_tick(mask, start)


def last_tick(mask: BoolArray, start: int = 0, stop: int | None = None) -> int | None:
    """Return the last tick in [start, stop) at which the mask is true, None if there is none."""
    part = mask[start:stop][::-1]
    index = int(np.argmax(part)) if len(part) else 0
    return start + len(part) - 1 - index if len(part) and bool(part[index]) else None


def longest_stretch(mask: BoolArray) -> tuple[int, int] | None:
    """Return the longest stretch [start, stop) in which the mask is true, None if it never is.

    Of equal ones it is the first.
    """
    return max(stretches(mask), key=lambda one: one[1] - one[0], default=None)


def stretches(mask: BoolArray) -> list[tuple[int, int]]:
    """Return the stretches [start, stop) in which the mask is true."""
    edges = np.flatnonzero(np.diff(mask.astype(np.int8), prepend=0, append=0))
    return list(zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True))
