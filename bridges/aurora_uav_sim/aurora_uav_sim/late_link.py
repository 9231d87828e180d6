# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A simulator as hard to keep time with as a real autopilot: its clock drifts, its link is late.

For trying clients; both are off unless asked for.
"""

from __future__ import annotations

import heapq
import itertools
import random
from collections.abc import Hashable, Iterator

from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.signed_server import SignedServer


class LateLink:
    """Datagrams that each take a random time of their own, there and back.

    Args:
        server: The simulator.
        drift_ppm: Its clock counts so many millionths more per second.
        jitter_s: Each way takes a time drawn evenly from 0 to this.
        seed: Of what is drawn.
        start_s: Steady time at which its clock stands at 0.
    """

    def __init__(
        self,
        server: SimServer | SignedServer,
        *,
        drift_ppm: float = 0.0,
        jitter_s: float = 0.0,
        seed: int = 1,
        start_s: float = 0.0,
    ) -> None:
        self._server = server
        self._rate = 1.0 + drift_ppm * 1e-6
        self._start_s = start_s
        self._jitter_s = jitter_s
        self._random = random.Random(seed)
        # Steady time of arrival, number, whether it goes to the simulator, peer, datagram.
        self._under_way: list[tuple[float, int, bool, Hashable, bytes]] = []
        self._numbers = itertools.count()
        server.poll(0.0)

    def clock_s(self, steady_s: float) -> float:
        """Return the simulator's time at a steady time."""
        return self._rate * (steady_s - self._start_s)

    def take(self, datagram: bytes, source: Hashable, now_s: float) -> None:
        """Let a datagram set out for the simulator."""
        self._send(now_s, True, source, datagram)

    def next_s(self) -> float | None:
        """Return when the next datagram arrives, None when none is under way."""
        return self._under_way[0][0] if self._under_way else None

    def pass_time(self, now_s: float) -> Iterator[tuple[Hashable, bytes]]:
        """Let time pass; yield what has come back, with its destination."""
        while self._under_way and self._under_way[0][0] <= now_s:
            at_s, _, inward, peer, datagram = heapq.heappop(self._under_way)
            if not inward:
                yield peer, datagram
                continue
            self._poll(at_s)
            for reply in self._server.handle(datagram, peer):
                self._send(at_s, False, peer, reply)
        self._poll(now_s)

    def _poll(self, now_s: float) -> None:
        for destination, datagram in self._server.poll(self.clock_s(now_s)):
            self._send(now_s, False, destination, datagram)

    def _send(self, now_s: float, inward: bool, peer: Hashable, datagram: bytes) -> None:
        at_s = now_s + self._random.uniform(0.0, self._jitter_s)
        heapq.heappush(self._under_way, (at_s, next(self._numbers), inward, peer, datagram))
