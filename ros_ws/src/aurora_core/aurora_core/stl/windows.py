# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sliding extrema and the until recursion without loops over samples.

Windows grow by doubling: what begins at sample i and is 2s long is what begins at i and is s long
followed by what begins at i + s. Short windows are grown in pieces of the trace that stay in the
processor's cache, where a pass costs a fraction of one through memory.

Only comparisons select values here, nothing is computed: results are bit-identical however the
work is split (but for the sign of zero, which has no meaning).
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
# One row per quantity, one column per sample: what the window that begins there has.
_Rows = FloatArray
# Takes the windows from some samples, those that follow them, and the rows to write to.
_Follow = Callable[[_Rows, _Rows, _Rows], None]

# Samples. Best of what was measured on 1 MiB of second-level cache; half or twice is 20 % worse.
_PIECE = 16384
_SHORT = 4096


class Extremum(Enum):
    """Which extremum a window takes."""

    LEAST = 'least'
    GREATEST = 'greatest'

    @property
    def ufunc(self) -> np.ufunc:
        """numpy's binary function."""
        return np.minimum if self is Extremum.LEAST else np.maximum


def sliding(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return the extremum of every full window.

    Args:
        values: (n,).
        width: Samples per window, at least 1.
        extremum: Which one.

    Returns:
        (n - width + 1,) extrema of values[i : i + width]; empty when no window fits.
    """
    return sliding_clipped(values, width, extremum)[: max(0, len(values) - width + 1)]


def sliding_clipped(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return (n,) extrema of values[i : i + width], the last windows cut at the end.

    O(n log width).
    """
    combine = extremum.ufunc

    def follow(now: _Rows, later: _Rows, out: _Rows) -> None:
        combine(now, later, out=out)

    return _grown(values[np.newaxis], width, follow)[0]


def running_to_end(values: FloatArray, extremum: Extremum) -> FloatArray:
    """Return (n,) extrema of values[i:]."""
    result: FloatArray = extremum.ufunc.accumulate(values[::-1])[::-1]
    return result


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
    return _grown(np.stack((right, left)), width, _until_follow)[0]


def _until_follow(now: _Rows, later: _Rows, out: _Rows) -> None:
    """Continue `until`: row 0 is its value, row 1 the least of `left` over the window.

    The witness is in the first window, or it is later and `left` held over the first.
    """
    np.minimum(now[1], later[0], out=out[0])
    np.maximum(now[0], out[0], out=out[0])
    np.minimum(now[1], later[1], out=out[1])


def _grown(rows: _Rows, width: int, follow: _Follow) -> _Rows:
    """Return what windows of `width` samples have (cut at the end), from single samples."""
    n = rows.shape[1]
    width = min(width, n)
    short = min(width, _SHORT)
    if n <= _PIECE:
        return _doubled(rows, 1, width, follow)
    result = np.empty_like(rows)
    for start in range(0, n, _PIECE):
        piece = rows[:, start : start + _PIECE + short - 1]
        result[:, start : start + _PIECE] = _doubled(piece, 1, short, follow)[:, :_PIECE]
    return _doubled(result, short, width, follow)


def _doubled(rows: _Rows, size: int, width: int, follow: _Follow) -> _Rows:
    """Return what windows of `width` samples have, from those of `size`.

    The last step may overlap: an extremum does not mind, and for `until` whatever the second
    window has twice is in the first with a value at least as great.
    """
    spare = (np.empty_like(rows), np.empty_like(rows))
    turn = 0
    while size < width:
        shift = min(size, width - size)
        grown = spare[turn]
        follow(rows[:, :-shift], rows[:, shift:], grown[:, :-shift])
        grown[:, -shift:] = rows[:, -shift:]
        rows, size, turn = grown, size + shift, 1 - turn
    return rows
