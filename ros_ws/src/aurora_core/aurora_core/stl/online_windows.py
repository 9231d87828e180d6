# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Always, eventually, historically and once along a growing trace."""

from __future__ import annotations

import numpy as np

from aurora_core.stl import windows
from aurora_core.stl.online_bounds import Bounds, by_limit
from aurora_core.stl.online_streams import NOTHING, Operand, Stream
from aurora_core.stl.robustness import SampledSignals
from aurora_core.stl.windows import Extremum, FloatArray


class Window(Stream):
    """Always, eventually; historically, once over a bounded interval.

    Without an end ahead, nothing is ever final and all values of the operand are kept.

    Args:
        operand: What the window goes over.
        extremum: Which one the window takes.
        ticks: Nearest and farthest sample of the window, None without end (ahead only).
        ahead: Into the future.
        clip: Windows take the samples that there are.
    """

    def __init__(
        self,
        operand: Stream,
        extremum: Extremum,
        *,
        ticks: tuple[int, int | None],
        ahead: bool,
        clip: bool,
    ) -> None:
        near, far = ticks
        self._width = None if far is None else far - near + 1
        self._extremum = extremum
        self._shortens = ahead and (clip or far is None)
        if ahead:
            start = max(0, operand.start - near)
            needed = near if far is None or clip else far
            super().__init__(start=start, lag=operand.lag + needed)
            self._operand = Operand(operand, base=start + near)
        else:
            assert far is not None  # `Running` is the window without end behind
            start = operand.start + (near if clip else far)
            super().__init__(start=start, lag=max(0, operand.lag - near))
            padding = np.full(far - near if clip else 0, extremum.neutral)
            self._operand = Operand(operand, base=start - far, padding=padding)

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._operand.push(signals)
        if self._width is None:
            return NOTHING
        final = self._full(self._operand.values, self._width)
        self._operand.drop(len(final))
        return final

    def bounds(self) -> Bounds:
        rows = self._operand.bounds()
        found = self._all_cut(rows)
        if self._shortens:
            # If the trace ends early, only the samples that are certain and the nearest count.
            limit = 1 if self._extremum is Extremum.LEAST else 0
            certain = self._cut(self._certain(rows[limit]))
            self._extremum.ufunc(certain, rows[limit], out=found[limit])
        return found

    def ended(self) -> FloatArray:
        values = self._operand.ended()
        if self._width is None or self._shortens:
            return self._cut(values)
        return self._full(values, self._width)

    def _full(self, values: FloatArray, width: int) -> FloatArray:
        # A window that lies behind may be complete before the trace has come to its sample.
        reached = max(0, self.samples - self.known)
        return windows.sliding(values, width, self._extremum)[:reached]

    def _all_cut(self, rows: Bounds) -> Bounds:
        if self._width is None or self._width >= rows.shape[1]:
            return windows.running_to_end(rows, self._extremum)
        return by_limit(self._cut, rows)

    def _cut(self, values: FloatArray) -> FloatArray:
        if self._width is None:
            return windows.running_to_end(values, self._extremum)
        return windows.sliding_clipped(values, self._width, self._extremum)

    def _certain(self, row: FloatArray) -> FloatArray:
        row = row.copy()
        row[self._operand.certain :] = self._extremum.neutral
        return row


class Running(Stream):
    """Historically, once without end behind: one value stands for all that has gone by."""

    def __init__(self, operand: Stream, extremum: Extremum, *, near: int) -> None:
        super().__init__(start=operand.start + near, lag=max(0, operand.lag - near))
        self._operand = Operand(operand, base=operand.start)
        self._extremum = extremum
        self._past = extremum.neutral

    def _advance(self, signals: SampledSignals) -> FloatArray:
        self._operand.push(signals)
        final = self._reached(self._operand.values)
        if len(final):
            self._past = float(final[-1])
            self._operand.drop(len(final))
        return final

    def bounds(self) -> Bounds:
        return by_limit(self._run, self._operand.bounds())

    def ended(self) -> FloatArray:
        return self._reached(self._operand.ended())

    def _reached(self, values: FloatArray) -> FloatArray:
        return self._run(values[: max(0, self.samples - self.known)])

    def _run(self, values: FloatArray) -> FloatArray:
        seeded = np.concatenate(([self._past], values))
        result: FloatArray = self._extremum.ufunc.accumulate(seeded)[1:]
        return result
