# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The arithmetic of `ros2 topic hz`."""

from __future__ import annotations

import math
from collections import deque

_REPORT_EACH_NS = 1_000_000_000


class RateMeter:
    """Intervals between arrivals, over the last ones.

    Args:
        window: How many intervals count.
    """

    def __init__(self, window: int) -> None:
        self._intervals_ns: deque[int] = deque(maxlen=window)
        self._last_ns: int | None = None
        self._reported_ns: int | None = None

    def arrived(self, now_ns: int) -> None:
        """Take up an arrival; a clock that went back starts anew."""
        if self._last_ns is not None and now_ns < self._last_ns:
            self._intervals_ns.clear()
            self._reported_ns = None
        elif self._last_ns is not None:
            self._intervals_ns.append(now_ns - self._last_ns)
        self._last_ns = now_ns

    def report(self) -> str | None:
        """Return the statistics, when a second of arrivals has passed since the last time."""
        if not self._intervals_ns or self._last_ns is None:
            return None
        if self._reported_ns is None:
            self._reported_ns = self._last_ns
            return None
        if self._last_ns - self._reported_ns < _REPORT_EACH_NS:
            return None
        self._reported_ns = self._last_ns
        seconds = [interval * 1e-9 for interval in self._intervals_ns]
        mean_s = sum(seconds) / len(seconds)
        deviation_s = math.sqrt(sum((s - mean_s) ** 2 for s in seconds) / len(seconds))
        rate_hz = 1.0 / mean_s if mean_s > 0.0 else 0.0
        return (
            f'average rate: {rate_hz:.3f}\n'
            f'\tmin: {min(seconds):.3f}s max: {max(seconds):.3f}s '
            f'std dev: {deviation_s:.5f}s window: {len(seconds)}'
        )
