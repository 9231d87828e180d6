# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A transport to a simulator with a clock and a late link of its own, in time that is counted."""

from __future__ import annotations

from collections import deque

from aurora_uav_sim.late_link import LateLink
from aurora_uav_sim.mavlink_server import SimServer

_STEP_S = 0.005
_START_S = 1000.0


class VirtualTimeTransport:
    """Waiting costs nothing: time goes on as far as the next datagram, or as was to be waited.

    Args:
        server: The simulator.
        drift_ppm: Of its clock.
        jitter_s: Of each way.
        seed: Of the jitter.

    Attributes:
        link: Knows what the simulator's clock really shows.
    """

    def __init__(
        self, server: SimServer, *, drift_ppm: float = 0.0, jitter_s: float = 0.0, seed: int = 1
    ) -> None:
        self._now_s = _START_S
        self.link = LateLink(
            server, drift_ppm=drift_ppm, jitter_s=jitter_s, seed=seed, start_s=_START_S
        )
        self._inbox: deque[bytes] = deque()

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""
        return 'uav_sim in virtual time'

    def send(self, datagram: bytes) -> None:
        """Let a datagram set out."""
        self.link.take(datagram, 'client', self._now_s)

    def receive(self, timeout_s: float) -> bytes | None:
        """Return the next datagram, or None when none came within the time."""
        until_s = self._now_s + timeout_s
        while not self._inbox:
            if self._now_s >= until_s:
                return None
            next_s = self.link.next_s()
            at_s = min(until_s, self._now_s + _STEP_S)
            self._now_s = at_s if next_s is None else max(min(next_s, at_s), self._now_s)
            self._inbox.extend(out for _, out in self.link.pass_time(self._now_s))
        return self._inbox.popleft()

    def steady_time_s(self) -> float:
        """Return the counted time."""
        return self._now_s

    def close(self) -> None:
        """Forget what was not read."""
        self._inbox.clear()
