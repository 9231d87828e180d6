# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sliding extrema and the until recursion without loops over samples.

Only comparisons select values here, nothing is computed: results are bit-identical however the
work is split.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]


class Extremum(Enum):
    """Which extremum a window takes."""

    LEAST = 'least'
    GREATEST = 'greatest'

    @property
    def neutral(self) -> float:
        """The value that never wins."""
        return float('inf') if self is Extremum.LEAST else float('-inf')

    @property
    def ufunc(self) -> np.ufunc:
        """numpy's binary function."""
        return np.minimum if self is Extremum.LEAST else np.maximum


def sliding(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return the extremum of every full window, in linear time whatever the width.

    Blocks of `width` samples with running extrema forwards and backwards; a window is the end of
    one block and the beginning of the next.

    Args:
        values: (n,).
        width: Samples per window, at least 1.
        extremum: Which one.

    Returns:
        (n - width + 1,) extrema of values[i : i + width]; empty when no window fits.

    Source: van Herk 1992; Gil and Werman 1993.
    """
    n = len(values)
    if width > n:
        return np.empty(0, dtype=np.float64)
    if width == 1:
        return values.copy()
    combine = extremum.ufunc
    blocks = -(-n // width)
    padded = np.full(blocks * width, extremum.neutral)
    padded[:n] = values
    grid = padded.reshape(blocks, width)
    ahead: FloatArray = combine.accumulate(grid, axis=1).ravel()
    behind: FloatArray = combine.accumulate(grid[:, ::-1], axis=1)[:, ::-1].ravel()
    last = n - width
    result: FloatArray = combine(behind[: last + 1], ahead[width - 1 : n])
    return result


def sliding_clipped(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return (n,) extrema of values[i : i + width], the last windows cut at the end."""
    width = min(width, len(values))
    if width == 0:
        return np.empty(0, dtype=np.float64)
    padded = np.concatenate((values, np.full(width - 1, extremum.neutral)))
    return sliding(padded, width, extremum)


def running_to_end(values: FloatArray, extremum: Extremum) -> FloatArray:
    """Return (n,) extrema of values[i:]."""
    result: FloatArray = extremum.ufunc.accumulate(values[::-1])[::-1]
    return result


@dataclass(frozen=True, slots=True)
class _Step:
    """The function x -> max(low, min(high, x)) at each sample; closed under composition.

    `until` at sample i is the composition of the steps i, i+1, ... with low = right, high = left.
    """

    low: FloatArray
    high: FloatArray

    def after(self, later: _Step) -> _Step:
        """Return self applied to the result of `later`, sample by sample."""
        return _Step(
            np.maximum(self.low, np.minimum(self.high, later.low)),
            np.minimum(self.high, later.high),
        )


def until_within(left: FloatArray, right: FloatArray, width: int) -> FloatArray:
    """Return the robustness of `left until right` with the witness among the next samples.

    Value i is the greatest over j in [i, i + width) (cut at the end) of the lesser of right[j]
    and the least of left[i : j]. O(n log width).

    Args:
        left: (n,).
        right: (n,).
        width: Samples that may bear the witness, at least 1.

    Returns:
        (n,).
    """
    n = len(left)
    width = min(width, n)
    if n == 0:
        return np.empty(0, dtype=np.float64)
    power = _Step(right, left)  # composition of 2^k steps from each sample on
    found: _Step | None = None  # composition of the binary digits of `width` so far
    covered = 0
    size = 1
    while True:
        if width & size:
            shifted = _shift(power, covered)
            found = shifted if found is None else found.after(shifted)
            covered += size
        size *= 2
        if size > width:
            break
        power = power.after(_shift(power, size // 2))
    assert found is not None  # width >= 1 has a digit
    return found.low


def _shift(step: _Step, ticks: int) -> _Step:
    """Return the steps `ticks` later; beyond the end the step that has no witness."""
    if ticks == 0:
        return step
    n = len(step.low)
    none = np.full(min(ticks, n), float('-inf'))
    return _Step(
        np.concatenate((step.low[ticks:], none)), np.concatenate((step.high[ticks:], none))
    )
