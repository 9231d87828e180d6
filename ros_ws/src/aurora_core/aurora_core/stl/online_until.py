# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Until and since along a growing trace."""

from __future__ import annotations

import numpy as np

from aurora_core.stl import windows
from aurora_core.stl.online_bounds import INF, Bounds, by_limit
from aurora_core.stl.online_streams import NOTHING, Operand, Stream, aligned
from aurora_core.stl.robustness import SampledSignals
from aurora_core.stl.windows import Extremum, FloatArray


def _before(left: FloatArray, near: int) -> FloatArray:
    """Return the least of left over the `near` samples before the first witness."""
    if near == 0:
        return np.full(len(left), INF)
    return windows.sliding(left, near, Extremum.LEAST)


class Ahead(Stream):
    """Until. Without an end nothing is ever final and all values of the operands are kept."""

    def __init__(
        self, left: Stream, right: Stream, *, ticks: tuple[int, int | None], clip: bool
    ) -> None:
        self._near, self._far = ticks
        self._shortens = clip or self._far is None
        lag = max(left.lag, right.lag)
        needed = self._near if self._far is None or clip else self._far
        super().__init__(start=max(left.start, right.start), lag=lag + needed)
        self._left = Operand(left, base=self.start)
        self._right = Operand(right, base=self.start)

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._left.push(signals)
        self._right.push(signals)
        if self._far is None:
            return NOTHING
        final = self._full(self._left.values, self._right.values, self._far)
        self._left.drop(len(final))
        self._right.drop(len(final))
        return final

    def bounds(self) -> Bounds:
        # With constant bounds the nearest witness is the best: `near` more samples are enough.
        left, right = aligned(self._left, self._right, more=self._near)
        witness = right
        if self._shortens:
            # If the trace ends early, only the certain witnesses and the nearest count.
            witness = witness.copy()
            witness[0, min(self._left.certain, self._right.certain) :] = -INF
        found = by_limit(self._all, left, witness)
        if self._shortens:
            nearest = right[0, self._near :]
            nearest = np.minimum(nearest, _before(left[0], self._near)[: len(nearest)])
            np.maximum(found[0], nearest, out=found[0])
        return found

    def ended(self) -> FloatArray:
        left, right = self._left.ended(), self._right.ended()
        if self._far is not None and not self._shortens:
            return self._full(left, right, self._far)
        both = min(len(left), len(right))
        return self._all(left[:both], right[:both])

    def _all(self, left: FloatArray, right: FloatArray) -> FloatArray:
        return windows.until(left, right, self._near, self._far)

    def _full(self, left: FloatArray, right: FloatArray, far: int) -> FloatArray:
        both = min(len(left), len(right))
        if both <= far:
            return NOTHING
        return windows.until(left[:both], right[:both], self._near, far)[: both - far]


class Behind(Stream):
    """Since over a bounded interval."""

    def __init__(self, left: Stream, right: Stream, *, ticks: tuple[int, int], clip: bool) -> None:
        self._near, self._far = ticks
        first = max(left.start, right.start)
        start = first + (self._near if clip else self._far)
        super().__init__(start=start, lag=max(left.lag, right.lag))
        missing = self._far - self._near if clip else 0
        base = start - self._far
        self._left = Operand(left, base=base, padding=np.full(missing, INF))
        self._right = Operand(right, base=base, padding=np.full(missing, -INF))

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._left.push(signals)
        self._right.push(signals)
        final = self._since(self._left.values, self._right.values)
        self._left.drop(len(final))
        self._right.drop(len(final))
        return final

    def bounds(self) -> Bounds:
        return by_limit(self._since, *aligned(self._left, self._right, more=self._far))

    def ended(self) -> FloatArray:
        return self._since(self._left.ended(), self._right.ended())

    def _since(self, left: FloatArray, right: FloatArray) -> FloatArray:
        """Return the values of the full windows."""
        both = min(len(left), len(right))
        if both <= self._far:
            return NOTHING
        mirrored = windows.until(left[:both][::-1], right[:both][::-1], self._near, self._far)
        return mirrored[: both - self._far][::-1]


class RunningBehind(Stream):
    """Since without an end: one value stands for all witnesses that have gone by."""

    def __init__(self, left: Stream, right: Stream, *, near: int) -> None:
        first = max(left.start, right.start)
        super().__init__(start=first + near, lag=max(left.lag, right.lag))
        self._near = near
        self._left = Operand(left, base=first)
        self._right = Operand(right, base=first)
        self._past = -INF  # `left since right` with the witness before the base

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._left.push(signals)
        self._right.push(signals)
        left, right = self._left.values, self._right.values
        final = self._since(left, right)
        done = len(final)
        if done:
            self._past = float(self._witnessed(left[:done], right[:done])[-1])
            self._left.drop(done)
            self._right.drop(done)
        return final

    def bounds(self) -> Bounds:
        return by_limit(self._since, *aligned(self._left, self._right, more=self._near))

    def ended(self) -> FloatArray:
        return self._since(self._left.ended(), self._right.ended())

    def _witnessed(self, left: FloatArray, right: FloatArray) -> FloatArray:
        """Return `left since right` with any witness up to each sample."""
        seeded_left = np.concatenate(([INF], left))[::-1]
        seeded_right = np.concatenate(([self._past], right))[::-1]
        return windows.until_within(seeded_left, seeded_right, len(left) + 1)[::-1][1:]

    def _since(self, left: FloatArray, right: FloatArray) -> FloatArray:
        both = min(len(left), len(right))
        if both <= self._near:
            return NOTHING
        count = both - self._near
        witnessed = self._witnessed(left[:count], right[:count])
        # The witness lies at least `near` back; left must have held from after it.
        after = _before(left[1:both], self._near)[:count] if self._near else INF
        return np.minimum(witnessed, after)
