# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What one autopilot has told of its vehicle, by the times of its own clock."""

from __future__ import annotations

from bisect import bisect_left, insort
from math import sqrt
from typing import Any

# How long what was told is kept, before the newest of it.
_KEPT_S = 10.0
# Between two reports that are farther apart nothing is filled in.
MAX_GAP_S = 0.5

Sample = tuple[float, tuple[float, ...]]


class Track:
    """Numbers over time, in whatever order they arrive."""

    def __init__(self) -> None:
        self._samples: list[Sample] = []

    def __len__(self) -> int:
        return len(self._samples)

    def add(self, time_s: float, values: tuple[float, ...]) -> None:
        """Take what held at a time of the autopilot; of a time that is there already, nothing."""
        samples = self._samples
        at = bisect_left(samples, (time_s,))
        if at < len(samples) and samples[at][0] == time_s:
            return
        insort(samples, (time_s, values))
        while samples[0][0] < samples[-1][0] - _KEPT_S:
            del samples[0]

    def last_s(self) -> float:
        """Return the time of the newest sample, minus infinity without any."""
        return self._samples[-1][0] if self._samples else float('-inf')

    def around(self, time_s: float) -> tuple[float, Sample, Sample] | None:
        """Return the samples before and after a time and the share of the way between them.

        None until there is one at or after it, and where those around it are too far apart.
        """
        samples = self._samples
        at = bisect_left(samples, (time_s,))
        if at == len(samples) or (at == 0 and samples[0][0] != time_s):
            return None
        after = samples[at]
        before = samples[at - 1] if at and after[0] != time_s else after
        if before is after:
            return 0.0, after, after
        span_s = after[0] - before[0]
        if span_s > MAX_GAP_S:
            return None
        return (time_s - before[0]) / span_s, before, after

    def between(self, time_s: float) -> tuple[float, ...] | None:
        """Return the numbers at a time, on the straight line between the samples around it."""
        found = self.around(time_s)
        if found is None:
            return None
        share, (_, one), (_, other) = found
        return tuple(a + share * (b - a) for a, b in zip(one, other, strict=True))


class AttitudeTrack(Track):
    """Quaternions (w, x, y, z) and body rates: what is between two of them has unit length."""

    def between(self, time_s: float) -> tuple[float, ...] | None:
        """Return quaternion and rates at a time."""
        found = self.around(time_s)
        if found is None:
            return None
        share, (_, one), (_, other) = found
        # A quaternion and its negative are the same attitude.
        sign = -1.0 if sum(a * b for a, b in zip(one[:4], other[:4], strict=True)) < 0.0 else 1.0
        q = [a + share * (sign * b - a) for a, b in zip(one[:4], other[:4], strict=True)]
        length = sqrt(sum(a * a for a in q)) or 1.0
        rates = [a + share * (b - a) for a, b in zip(one[4:], other[4:], strict=True)]
        return (*(a / length for a in q), *rates)


class Told:
    """Everything that one autopilot tells.

    Attributes:
        position: LOCAL_POSITION_NED: north, east, down (m), and their rates (m/s).
        attitude: ATTITUDE_QUATERNION: w, x, y, z (NED to FRD), rates (rad/s, FRD).
        mode: Main and sub mode of PX4, None until a heartbeat came.
        armed: Motors may turn.
        landed: On the ground, None until told.
        altitude_m: Above sea level, None until told.
    """

    def __init__(self) -> None:
        self.position = Track()
        self.attitude = AttitudeTrack()
        self.mode: tuple[int, int] | None = None
        self.armed = False
        self.landed: bool | None = None
        self.altitude_m: float | None = None

    def take_heartbeat(self, m: Any, armed_flag: int) -> None:
        """Take mode and arming of a HEARTBEAT."""
        # Source: PX4, px4_custom_mode.h.
        self.mode = (m.custom_mode >> 16 & 0xFF, m.custom_mode >> 24 & 0xFF)
        self.armed = bool(m.base_mode & armed_flag)

    @property
    def heard(self) -> bool:
        """Whether the autopilot was heard at all."""
        return self.mode is not None

    @property
    def complete(self) -> bool:
        """Whether everything was told that a state consists of."""
        return (
            len(self.position) > 0
            and len(self.attitude) > 0
            and self.mode is not None
            and self.landed is not None
            and self.altitude_m is not None
        )
