# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The arithmetic of `ros2 topic bw`."""

from __future__ import annotations

from collections import deque

# From so many bytes per second on: unit and digits behind the point, as ros2cli has them.
_UNITS = ((1e6, 'MB', 2), (1e3, 'KB', 2), (1.0, 'B', 0))


class BandwidthMeter:
    """Sizes of the last messages.

    Args:
        window: How many messages count.
    """

    def __init__(self, window: int) -> None:
        self._arrivals: deque[tuple[int, int]] = deque(maxlen=window)

    def arrived(self, now_ns: int, size_bytes: int) -> None:
        """Take up an arrival."""
        self._arrivals.append((now_ns, size_bytes))

    def report(self, now_ns: int) -> str | None:
        """Return the statistics up to now, None before the second message.

        A clock that went back starts anew.
        """
        if len(self._arrivals) < 2:
            return None
        begin_ns = self._arrivals[0][0]
        if now_ns <= begin_ns:
            self._arrivals.clear()
            return None
        sizes = [size for _, size in self._arrivals]
        rate = sum(sizes) / ((now_ns - begin_ns) * 1e-9)
        scale, unit, digits = next((u for u in _UNITS if rate >= u[0]), _UNITS[-1])

        def told(value: float) -> str:
            return f'{value / scale:.{digits}f} {unit}'

        return (
            f'{told(rate)}/s from {len(sizes)} messages\n'
            f'\tMessage size mean: {told(sum(sizes) / len(sizes))} '
            f'min: {told(min(sizes))} max: {told(max(sizes))}'
        )
