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

from collections.abc import Callable, Sequence
from enum import Enum

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
# What the windows that begin at each sample have; one array per quantity.
_Rows = Sequence[FloatArray]
# Grows windows: rows, their size, the size wanted, room for the rows and one array more.
_Grow = Callable[[_Rows, int, int, Sequence[FloatArray]], _Rows]

# Samples. Best of what was measured with 1 MiB of second-level cache per core.
_PIECE = 16384
_SHORT = 4096


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

    @property
    def pick(self) -> Callable[[float, float], float]:
        """Python's function of two numbers."""
        return min if self is Extremum.LEAST else max


def sliding(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return the extremum of every full window.

    Args:
        values: (n,).
        width: Samples per window, at least 1.
        extremum: Which one.

    Returns:
        (n - width + 1,) extrema of values[i : i + width]; empty when no window fits.
    """
    count = max(0, len(values) - width + 1)
    if 0 < count <= width:
        # Sample width - 1 is in every window: each is what it has up to there and from there on.
        before = running_to_end(values[:width], extremum)[:count]
        result: FloatArray = extremum.ufunc(before, extremum.ufunc.accumulate(values[width - 1 :]))
        return result
    return sliding_clipped(values, width, extremum)[:count]


def sliding_clipped(values: FloatArray, width: int, extremum: Extremum) -> FloatArray:
    """Return (n,) extrema of values[i : i + width], the last windows cut at the end.

    O(n log width), O(n) where every window reaches the end.
    """
    if width >= len(values):
        return running_to_end(values, extremum)
    combine = extremum.ufunc

    def grow(rows: _Rows, size: int, width: int, room: Sequence[FloatArray]) -> _Rows:
        now, spare = room
        now[:] = rows[0]
        while size < width:
            shift = min(size, width - size)
            combine(now[:-shift], now[shift:], out=spare[:-shift])
            spare[-shift:] = now[-shift:]
            now, spare = spare, now
            size += shift
        return (now,)

    return _grown((values,), width, grow)[0]


def running_to_end(values: FloatArray, extremum: Extremum) -> FloatArray:
    """Return (..., n) extrema of values[..., i:]."""
    result: FloatArray = extremum.ufunc.accumulate(values[..., ::-1], axis=-1)[..., ::-1]
    return result


def until(left: FloatArray, right: FloatArray, near: int, far: int | None) -> FloatArray:
    """Return the robustness of `left until right` over an interval.

    Args:
        left: (n,).
        right: (n,).
        near: Samples from a value to its nearest witness.
        far: Samples to the farthest, None without end.

    Returns:
        (n - near,) values, intervals cut at the end; empty when none has a witness.
    """
    width = len(left) if far is None else far - near + 1
    witness = until_within(left[near:], right[near:], width)
    if near > 0:
        before = sliding(left, near, Extremum.LEAST)[: len(witness)]
        np.minimum(witness, before, out=witness)
    return witness


def until_within(left: FloatArray, right: FloatArray, width: int) -> FloatArray:
    """Return the robustness of `left until right` with the witness among the next samples.

    Value i is the greatest over j in [i, i + width) (cut at the end) of the lesser of right[j]
    and the least of left[i : j]. O(n log width), O(n) where every window reaches the end.

    Args:
        left: (n,).
        right: (n,).
        width: Samples that may bear the witness, at least 1.

    Returns:
        (n,).
    """
    if width >= len(left):
        return _until_to_end(left, right)
    return _grown((right, left), width, _grow_until)[0]


def _until_to_end(left: FloatArray, right: FloatArray) -> FloatArray:
    """Return the robustness of `left until right` without end, piece by piece from the last.

    Of all that comes after a piece its first value is enough: it is a witness right behind the
    piece. So windows grow no longer than a piece, and every pass stays in the cache.
    """
    n = len(left)
    found = np.empty(n)
    room = _room((right, left), min(n, _PIECE))
    later = Extremum.GREATEST.neutral
    for start in reversed(range(0, n, _PIECE)):
        piece = (right[start : start + _PIECE], left[start : start + _PIECE])
        size = len(piece[0])
        until, held = _grow_until(piece, 1, size, [each[:size] for each in room])
        np.minimum(held, later, out=held)
        np.maximum(until, held, out=found[start : start + size])
        later = float(found[start])
    return found


def _grow_until(rows: _Rows, size: int, width: int, room: Sequence[FloatArray]) -> _Rows:
    """Grow (until, least of left): the witness comes now, or later and left holds meanwhile."""
    until, held, spare = room
    until[:], held[:] = rows
    while size < width:
        shift = min(size, width - size)
        later = spare[:-shift]
        np.minimum(held[:-shift], until[shift:], out=later)
        np.maximum(until[:-shift], later, out=until[:-shift])
        np.minimum(held[:-shift], held[shift:], out=later)
        spare[-shift:] = held[-shift:]
        held, spare = spare, held
        size += shift
    return until, held


def _grown(rows: _Rows, width: int, grow: _Grow) -> _Rows:
    """Return what windows of `width` samples have (cut at the end), from single samples.

    The last doubling may be a smaller step, so that both windows overlap. An extremum does not
    mind; for `until`, what the later window has twice counts less there than in the first.
    """
    n = len(rows[0])
    width = min(width, n)
    if n <= _PIECE:
        return grow(rows, 1, width, _room(rows, n))
    short = min(width, _SHORT)
    near = [np.empty(n) for _ in rows]
    room = _room(rows, _PIECE + short - 1)  # once: fresh memory costs more than the work in it
    for start in range(0, n, _PIECE):
        piece = [row[start : start + _PIECE + short - 1] for row in rows]
        found = grow(piece, 1, short, [each[: len(piece[0])] for each in room])
        for row, part in zip(near, found, strict=True):
            row[start : start + _PIECE] = part[:_PIECE]
    return grow(near, short, width, _room(rows, n)) if short < width else near


def _room(rows: _Rows, n: int) -> list[FloatArray]:
    return [np.empty(n) for _ in range(len(rows) + 1)]
