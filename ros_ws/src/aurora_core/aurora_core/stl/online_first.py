# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The robustness at sample 0 of a growing trace.

At one sample a window needs no buffer: what is final goes into one value, whatever the length.
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from aurora_core.stl.online_bounds import INF, Bounds, extended
from aurora_core.stl.online_streams import Operand, Stream, aligned
from aurora_core.stl.robustness import SampledSignals
from aurora_core.stl.windows import Extremum, FloatArray


class First(ABC):
    """The value of one formula at sample 0.

    Attributes:
        exists: Whether any trace is long enough to give it a value.
    """

    def __init__(self, *, exists: bool) -> None:
        self.exists = exists

    @abstractmethod
    def push(self, signals: SampledSignals) -> None:
        """Take new samples."""

    @abstractmethod
    def bounds(self) -> tuple[float, float]:
        """Return the limits over all finite continuations."""

    @abstractmethod
    def ended(self) -> float | None:
        """Return the value if the trace ended here, None if there is none."""


class FirstOf(First):
    """The first value of a stream."""

    def __init__(self, stream: Stream) -> None:
        super().__init__(exists=stream.start == 0)
        self._stream = stream
        self._value: float | None = None

    def push(self, signals: SampledSignals) -> None:
        if self._value is None:
            final = self._stream.push(signals)
            if len(final):
                self._value = float(final[0])

    def bounds(self) -> tuple[float, float]:
        if self._value is not None:
            return self._value, self._value
        rows = self._stream.bounds()
        return float(rows[0, 0]), float(rows[1, 0])

    def ended(self) -> float | None:
        if self._value is not None:
            return self._value
        values = self._stream.ended()
        return float(values[0]) if len(values) else None


class FirstNegation(First):
    """Not."""

    def __init__(self, operand: First) -> None:
        super().__init__(exists=operand.exists)
        self._operand = operand

    def push(self, signals: SampledSignals) -> None:
        self._operand.push(signals)

    def bounds(self) -> tuple[float, float]:
        low, high = self._operand.bounds()
        return -high, -low

    def ended(self) -> float | None:
        value = self._operand.ended()
        return None if value is None else -value


class FirstPair(First):
    """And, or: the lesser or the greater of two."""

    def __init__(self, left: First, right: First, extremum: Extremum) -> None:
        super().__init__(exists=left.exists and right.exists)
        self._left = left
        self._right = right
        self._pick = extremum.pick

    def push(self, signals: SampledSignals) -> None:
        self._left.push(signals)
        self._right.push(signals)

    def bounds(self) -> tuple[float, float]:
        (a, b), (c, d) = self._left.bounds(), self._right.bounds()
        return self._pick(a, c), self._pick(b, d)

    def ended(self) -> float | None:
        left, right = self._left.ended(), self._right.ended()
        return None if left is None or right is None else self._pick(left, right)


class FirstWindow(First):
    """Always, eventually."""

    def __init__(
        self,
        operand: Stream,
        extremum: Extremum,
        *,
        ticks: tuple[int, int | None],
        clip: bool,
    ) -> None:
        near, self._far = ticks
        super().__init__(exists=operand.start <= near)
        self._extremum = extremum
        self._pick = extremum.pick
        self._shortens = clip or self._far is None
        self._near = near
        self._operand = Operand(operand, base=near)
        self._past = extremum.neutral

    def push(self, signals: SampledSignals) -> None:
        if self._finished:
            return
        stop = self._stop
        self._past = self._fold(self._operand.taken(signals)[:stop])

    def bounds(self) -> tuple[float, float]:
        if self._finished:
            return self._past, self._past
        rows = self._operand.bounds()[:, : self._stop]
        low, high = rows
        if self._shortens:
            # If the trace ends early, only the samples that are certain and the nearest count.
            sure = self._operand.certain
            if self._operand.base == self._near:
                sure = max(sure, 1)
            if self._extremum is Extremum.LEAST:
                high = high[:sure]
            else:
                low = low[:sure]
        return self._fold(low), self._fold(high)

    def ended(self) -> float | None:
        if self._finished:
            return self._past
        values = self._operand.ended()
        needed = self._near if self._far is None or self._shortens else self._far
        if self._operand.base + len(values) <= needed:
            return None
        return self._fold(values[: self._stop])

    @property
    def _finished(self) -> bool:
        return self._far is not None and self._operand.base > self._far

    @property
    def _stop(self) -> int | None:
        """How many values from the base on are in the window, None for all."""
        return None if self._far is None else self._far + 1 - self._operand.base

    def _fold(self, values: FloatArray) -> float:
        """Return the extremum of what has gone by and these values."""
        if len(values) > 1:
            return self._pick(self._past, float(self._extremum.ufunc.reduce(values)))
        return self._pick(self._past, float(values[0])) if len(values) else self._past


class FirstUntil(First):
    """Until."""

    def __init__(
        self, left: Stream, right: Stream, *, ticks: tuple[int, int | None], clip: bool
    ) -> None:
        super().__init__(exists=max(left.start, right.start) == 0)
        self._near, self._far = ticks
        self._shortens = clip or self._far is None
        self._left = Operand(left, base=0)
        self._right = Operand(right, base=0)
        self._held = INF  # the least of left so far
        self._best = -INF  # the best witness so far

    def push(self, signals: SampledSignals) -> None:
        if self._finished:
            return
        self._left.push(signals)
        self._right.push(signals)
        left, right = self._left.values, self._right.values
        both = min(len(left), len(right))
        if both:
            self._best = self._fold(left[:both], right[:both])
            self._held = min(self._held, float(left[:both].min()))
            self._left.drop(both)
            self._right.drop(both)

    def bounds(self) -> tuple[float, float]:
        if self._finished:
            return self._best, self._best
        left, right = self._rows()
        sure = right.shape[1]
        if self._shortens:
            # If the trace ends early, only the certain witnesses and the nearest count.
            certain = min(self._left.certain, self._right.certain)
            sure = max(certain, self._near + 1 - self._left.base)
        return self._fold(left[0, :sure], right[0, :sure]), self._fold(left[1], right[1])

    def ended(self) -> float | None:
        if self._finished:
            return self._best
        left, right = self._left.ended(), self._right.ended()
        both = min(len(left), len(right))
        needed = self._near if self._far is None or self._shortens else self._far
        if self._left.base + both <= needed:
            return None
        return self._fold(left[:both], right[:both])

    @property
    def _finished(self) -> bool:
        return self._far is not None and self._left.base > self._far

    def _rows(self) -> tuple[Bounds, Bounds]:
        """Return the bounds from the base on, at least as far as the nearest witness."""
        left, right = aligned(self._left, self._right)
        length = self._near + 1 - self._left.base
        return extended(left, length), extended(right, length)

    def _fold(self, left: FloatArray, right: FloatArray) -> float:
        """Return the best witness with these values from the base on."""
        if len(left) == 1:
            return self._fold_one(float(right[0]))
        held = np.minimum.accumulate(np.concatenate(([self._held], left)))[:-1]
        first = max(0, self._near - self._left.base)
        stop = None if self._far is None else self._far + 1 - self._left.base
        return float(np.minimum(right, held)[first:stop].max(initial=self._best))

    def _fold_one(self, right: float) -> float:
        base = self._left.base
        if base < self._near or (self._far is not None and base > self._far):
            return self._best
        return max(self._best, min(self._held, right))
