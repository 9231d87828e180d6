# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A route in the plane: position by arc length, arc length by position."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray, FloatLike, as_rows, frozen

# Branches this much farther than the nearest one compete for the start: the lane beside, too (m).
_START_TIE_M = 4.0
DEFAULT_WINDOW_M = 10.0
_MANY_POINTS = 32  # fewer are measured sooner one by one


class Polyline:
    """Straight segments through points; arc length s = 0 at the first point.

    Attributes:
        points: (K, 2) metres, repeated points dropped, read-only.
        cumulative_m: (K,) arc length of each point.
        length_m: Arc length of the last point.
    """

    def __init__(self, points: FloatLike) -> None:
        """Measure the polyline.

        Args:
            points: (K, 2) metres; at least two different points.

        Raises:
            MapError: A point is not finite, or fewer than two points differ.
        """
        rows = as_rows('points', points, 2)
        if not np.isfinite(rows).all():
            raise MapError('polyline: finite coordinates expected')
        if not (len(rows) >= _MANY_POINTS and self._measured_at_once(rows)):
            self._measured_one_by_one(rows)
        if len(self._x) < 2:
            raise MapError(
                f'polyline: at least two different points expected, found {len(self._x)}'
            )
        self.points: FloatArray = frozen(np.array([self._x, self._y]).T.copy())
        self._tangents: FloatArray = frozen(np.array([self._tx, self._ty]).T.copy())
        self.cumulative_m: FloatArray = frozen(np.array(self._s))
        self.length_m = self._s[-1]

    def _measured_one_by_one(self, rows: FloatArray) -> None:
        """Measure, leaving out each point that is the one before."""
        x: list[float] = []
        y: list[float] = []
        self._s: list[float] = []
        self._tx: list[float] = []
        self._ty: list[float] = []
        self._step: list[float] = []
        for px, py in rows.tolist():
            if not x:
                self._s.append(0.0)
            else:
                dx, dy = px - x[-1], py - y[-1]
                step = math.sqrt(dx * dx + dy * dy)
                if step == 0.0:
                    continue
                self._tx.append(dx / step)
                self._ty.append(dy / step)
                self._step.append(step)
                self._s.append(self._s[-1] + step)
            x.append(px)
            y.append(py)
        self._x, self._y = x, y

    def _measured_at_once(self, rows: FloatArray) -> bool:
        """Measure with arrays, bit by bit as one by one; False when a point is repeated."""
        dx, dy = np.diff(rows[:, 0]), np.diff(rows[:, 1])
        steps = np.sqrt(dx * dx + dy * dy)
        if not steps.all():
            return False
        # Summed in order, as one by one: a sum by pairs would round otherwise.
        self._s = [0.0, *np.add.accumulate(steps).tolist()]
        self._tx, self._ty = (dx / steps).tolist(), (dy / steps).tolist()
        self._step = steps.tolist()
        self._x, self._y = rows[:, 0].tolist(), rows[:, 1].tolist()
        return True

    def at(self, s_m: float) -> tuple[float, float, float, float]:
        """Return the place at an arc length.

        Args:
            s_m: Metres from the start; limited to [0, length_m].

        Returns:
            x, y in metres and the unit tangent; at an inner point that of the segment after it.
        """
        s = min(max(s_m, 0.0), self.length_m)
        k = min(bisect_right(self._s, s) - 1, len(self._step) - 1)
        rest = s - self._s[k]
        tx, ty = self._tx[k], self._ty[k]
        return self._x[k] + rest * tx, self._y[k] + rest * ty, tx, ty

    def at_each(self, s_m: FloatArray) -> FloatArray:
        """Return the places at arc lengths (K,), bit by bit those of `at`, as rows (K, 4)."""
        s = np.minimum(np.maximum(s_m, 0.0), self.length_m)
        k = np.searchsorted(self.cumulative_m, s, side='right') - 1
        k = np.minimum(k, len(self._step) - 1)
        tangents = self._tangents[k]
        rest = (s - self.cumulative_m[k])[:, None]
        return np.concatenate((self.points[k] + rest * tangents, tangents), axis=1)

    def tangents_at(self, s_m: Sequence[float]) -> list[tuple[float, float]]:
        """Return the unit tangents at ascending arc lengths, those of `at`."""
        found, last, k = [], len(self._step) - 1, 0
        for s in s_m:
            k = bisect_right(self._s, min(max(s, 0.0), self.length_m), lo=k) - 1
            k = min(k, last)
            found.append((self._tx[k], self._ty[k]))
        return found

    def project(
        self,
        x_m: float,
        y_m: float,
        near_s: float | None = None,
        window_m: float | None = None,
        *,
        extend: bool = False,
    ) -> tuple[float, float]:
        """Return the place of the polyline nearest to a point.

        Args:
            x_m: Metres east.
            y_m: Metres north.
            near_s: Arc length about which to search; the whole polyline if omitted.
            window_m: Reach of that search to both sides; DEFAULT_WINDOW_M if omitted.
            extend: Prolong the first and the last segment without end, so that a point before
                the start has an arc length below 0 and one after the end one above `length_m`.

        Returns:
            Arc length in metres (limited to [0, length_m] unless extended), and the distance to
            that place, positive to the left. Of equally near places the one nearest to `near_s`,
            without `near_s` the first.
        """
        if near_s is None:
            low, high, anchor = -math.inf, math.inf, -math.inf
        else:
            reach = DEFAULT_WINDOW_M if window_m is None else window_m
            low, high, anchor = near_s - reach, near_s + reach, near_s
        return self.nearest_place(x_m, y_m, low, high, anchor, extend)

    def first_place(self, x: float, y: float, start_s: float, extend: bool) -> tuple[float, float]:
        """Return the best of the local nearest places by distance to the expected start."""
        found = [
            self._on_segment(k, x, y, -math.inf, math.inf, extend) for k in range(len(self._step))
        ]
        limit = math.sqrt(min(square for _, square, _ in found)) + _START_TIE_M
        runs: list[tuple[float, float, float]] = []  # nearest place of each run of segments
        joined = False
        for candidate in found:
            if candidate[1] > limit * limit:
                joined = False
                continue
            if joined and candidate[1] < runs[-1][1]:
                runs[-1] = candidate
            elif not joined:
                runs.append(candidate)
            joined = True
        s, square, side = min(runs, key=lambda run: abs(run[0] - start_s))
        return s, _signed(square, side)

    def nearest_place(
        self, x: float, y: float, low: float, high: float, anchor: float, extend: bool
    ) -> tuple[float, float]:
        count = len(self._step)
        if not extend:
            low, high = min(low, self.length_m), max(high, 0.0)
        first = max(bisect_right(self._s, low) - 1, 0)
        last = min(max(bisect_left(self._s, high), 1), count)
        first = min(first, count - 1)
        best = self._on_segment(first, x, y, low, high, extend)
        for k in range(first + 1, last):
            candidate = self._on_segment(k, x, y, low, high, extend)
            if candidate[1] < best[1] or (
                candidate[1] == best[1] and abs(candidate[0] - anchor) < abs(best[0] - anchor)
            ):
                best = candidate
        return best[0], _signed(best[1], best[2])

    def _on_segment(
        self, k: int, x: float, y: float, low: float, high: float, extend: bool
    ) -> tuple[float, float, float]:
        """Return arc length, squared distance and side of the nearest place of one segment."""
        tx, ty, start = self._tx[k], self._ty[k], self._s[k]
        wx, wy = x - self._x[k], y - self._y[k]
        rest = wx * tx + wy * ty
        least, most = low - start, high - start
        if not (extend and k == 0):
            least = max(least, 0.0)
        if not (extend and k == len(self._step) - 1):
            most = min(most, self._step[k])
        rest = max(min(rest, most), least)
        rx, ry = wx - rest * tx, wy - rest * ty
        return start + rest, rx * rx + ry * ry, tx * wy - ty * wx


def _signed(square: float, side: float) -> float:
    distance = math.sqrt(square)
    return 0.0 - distance if side < 0.0 else distance  # never -0.0
