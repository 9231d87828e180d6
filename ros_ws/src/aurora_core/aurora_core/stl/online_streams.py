# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Robustness of growing traces: what is final, what is open, what would be if the trace ended.

A stream hands out each value once, as soon as no continuation can change it. Of the operands it
keeps what the values still open depend on. Only comparisons select values, as in `windows`.

Source: Deshmukh et al. 2017, robust online monitoring of signal temporal logic (robust
satisfaction intervals).
"""

from __future__ import annotations

from abc import ABC, abstractmethod

import numpy as np

from aurora_core.stl.formula import Predicate
from aurora_core.stl.online_bounds import OPEN, Bounds, extended, preceded, since
from aurora_core.stl.robustness import SampledSignals, predicate_robustness
from aurora_core.stl.windows import Extremum, FloatArray

_LEAST_ROOM = 64  # samples


class Kept:
    """Samples that come at the end and go at the front, each at a constant cost on average.

    Room is at most some four times what was kept at the last change of it, so a long push leaves
    no large array behind once its samples are gone.

    Args:
        values: The first samples; copied.
    """

    def __init__(self, values: FloatArray) -> None:
        self._start = 0
        self._stop = 0
        self._room: FloatArray = np.empty(0)
        self.append(values)

    def __len__(self) -> int:
        """Return how many samples are kept."""
        return self._stop - self._start

    @property
    def values(self) -> FloatArray:
        """The samples; a view that holds until the next change."""
        return self._room[self._start : self._stop]

    def append(self, values: FloatArray) -> None:
        """Add samples at the end."""
        stop = self._stop + len(values)
        if stop > len(self._room):
            self._move(len(values))
            stop = self._stop + len(values)
        self._room[self._stop : stop] = values
        self._stop = stop

    def drop(self, count: int) -> None:
        """Forget the first samples."""
        self._start += count
        if len(self._room) > _LEAST_ROOM + 4 * len(self):
            self._move(0)

    def _move(self, more: int) -> None:
        """Move into new room for twice the samples and those that come."""
        kept = self.values
        room = np.empty(max(_LEAST_ROOM, 2 * (len(kept) + more)))
        room[: len(kept)] = kept
        self._room, self._start, self._stop = room, 0, len(kept)


NOTHING: FloatArray = np.empty(0, dtype=np.float64)


class Stream(ABC):
    """The robustness of one formula along a growing trace.

    Attributes:
        start: First sample that ever has a value.
        lag: Samples at the end of a trace that have none.
        known: First sample whose value is not final.
        samples: Samples so far.
    """

    def __init__(self, *, start: int, lag: int) -> None:
        self.start = start
        self.lag = lag
        self.known = start
        self.samples = 0

    @property
    def stop(self) -> int:
        """First sample after the last value, if the trace ended here."""
        return max(self.start, self.samples - self.lag)

    def push(self, signals: SampledSignals) -> FloatArray:
        """Take new samples and return the values that became final, from `known` on."""
        self.samples += signals.samples
        final = self._advance(signals)
        self.known += len(final)
        return final

    @abstractmethod
    def _advance(self, signals: SampledSignals) -> FloatArray:
        """Return the values from `known` on that are final with these samples."""

    @abstractmethod
    def bounds(self) -> Bounds:
        """Return the bounds of the values from `known` on."""

    @abstractmethod
    def ended(self) -> FloatArray:
        """Return the values from `known` up to `stop`, if the trace ended here."""


class Operand:
    """A stream and those of its final values that are still needed.

    Args:
        stream: The operand.
        base: First sample that is needed; may lie before the stream's start by `padding`.
        padding: Neutral values in front of the first.
    """

    def __init__(self, stream: Stream, *, base: int, padding: FloatArray = NOTHING) -> None:
        self.stream = stream
        self.base = base
        self._kept = Kept(padding)

    @property
    def values(self) -> FloatArray:
        """The final values from `base` on; a view that holds until the next push or drop."""
        return self._kept.values

    def push(self, signals: SampledSignals) -> None:
        """Take new samples."""
        fresh = self._from_next(signals)
        if len(fresh):
            self._kept.append(fresh)

    def taken(self, signals: SampledSignals) -> FloatArray:
        """Take new samples, return the values that are final with them and keep none."""
        fresh = self._from_next(signals)
        self.base += len(fresh)
        return fresh

    def drop(self, count: int) -> None:
        """Forget the first values."""
        if count:
            self._kept.drop(count)
            self.base += count

    def bounds(self) -> Bounds:
        """Return the bounds of the values from `base` on."""
        rest = since(self.stream.bounds(), max(0, self._next - self.stream.known))
        return preceded(self.values, rest)

    def ended(self) -> FloatArray:
        """Return the values from `base` on, if the trace ended here."""
        rest = self.stream.ended()[max(0, self._next - self.stream.known) :]
        return np.concatenate((self.values, rest))

    @property
    def certain(self) -> int:
        """How many values from `base` on exist however short the rest of the trace is."""
        return max(0, self.stream.stop - self.base)

    @property
    def _next(self) -> int:
        return self.base + len(self._kept)

    def _from_next(self, signals: SampledSignals) -> FloatArray:
        fresh = self.stream.push(signals)
        early = self._next - (self.stream.known - len(fresh))
        return fresh[early:] if early > 0 else fresh


class Samples(Stream):
    """A predicate: final at once, open beyond the last sample."""

    def __init__(self, predicate: Predicate) -> None:
        super().__init__(start=0, lag=0)
        self._predicate = predicate

    def _advance(self, signals: SampledSignals) -> FloatArray:
        return predicate_robustness(self._predicate, signals.values[self._predicate.signal])

    def bounds(self) -> Bounds:
        return OPEN

    def ended(self) -> FloatArray:
        return NOTHING


class Negation(Stream):
    """Not."""

    def __init__(self, operand: Stream) -> None:
        super().__init__(start=operand.start, lag=operand.lag)
        self._operand = operand

    def _advance(self, signals: SampledSignals) -> FloatArray:
        return -self._operand.push(signals)

    def bounds(self) -> Bounds:
        return -self._operand.bounds()[::-1]

    def ended(self) -> FloatArray:
        return -self._operand.ended()


class Pair(Stream):
    """And, or: the lesser or the greater of two."""

    def __init__(self, left: Stream, right: Stream, extremum: Extremum) -> None:
        super().__init__(start=max(left.start, right.start), lag=max(left.lag, right.lag))
        self._left = Operand(left, base=self.start)
        self._right = Operand(right, base=self.start)
        self._extremum = extremum

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._left.push(signals)
        self._right.push(signals)
        final = self._combine(self._left.values, self._right.values)
        self._left.drop(len(final))
        self._right.drop(len(final))
        return final

    def bounds(self) -> Bounds:
        bounds: Bounds = self._extremum.ufunc(*aligned(self._left, self._right))
        return bounds

    def ended(self) -> FloatArray:
        return self._combine(self._left.ended(), self._right.ended())

    def _combine(self, left: FloatArray, right: FloatArray) -> FloatArray:
        both = min(len(left), len(right))
        result: FloatArray = self._extremum.ufunc(left[:both], right[:both])
        return result


def aligned(left: Operand, right: Operand, *, more: int = 0) -> tuple[Bounds, Bounds]:
    """Return the bounds of two operands with one base, as long as the longer and `more`."""
    a, b = left.bounds(), right.bounds()
    length = max(a.shape[1], b.shape[1]) + more
    return extended(a, length), extended(b, length)
