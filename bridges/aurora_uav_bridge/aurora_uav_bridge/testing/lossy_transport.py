# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A transport that loses, doubles, delays and cuts datagrams."""

from __future__ import annotations

from collections import deque

import numpy as np

from aurora_uav_bridge.transports import Transport


class LossyTransport:
    """A bad link in both directions: loses, doubles, delays and cuts datagrams.

    Args:
        inner: The good transport.
        rng: Decides what happens to each datagram.
        loss: Share that is lost.
        duplication: Share that arrives twice.
        reordering: Share that is overtaken by up to three later datagrams of its direction.
        truncation: Share that arrives cut at a random place.
    """

    def __init__(
        self,
        inner: Transport,
        rng: np.random.Generator,
        *,
        loss: float = 0.2,
        duplication: float = 0.2,
        reordering: float = 0.2,
        truncation: float = 0.05,
    ) -> None:
        self._inner = inner
        self._rng = rng
        self._loss = loss
        self._duplication = duplication
        self._reordering = reordering
        self._truncation = truncation
        self._held_out: list[tuple[int, bytes]] = []
        self._held_in: list[tuple[int, bytes]] = []
        self._inbox: deque[bytes] = deque()

    @property
    def peer(self) -> str:
        """Name of the simulator for messages."""
        return self._inner.peer

    def send(self, datagram: bytes) -> None:
        """Send what the link makes of a datagram."""
        for arriving in self._suffer(datagram, self._held_out):
            self._inner.send(arriving)

    def receive(self, timeout_s: float) -> bytes | None:
        """Return the next datagram that survived, or None when none came within the time."""
        deadline_s = self._inner.steady_time_s() + timeout_s
        while not self._inbox:
            left_s = deadline_s - self._inner.steady_time_s()
            datagram = self._inner.receive(left_s) if left_s > 0.0 else None
            if datagram is None:
                return None
            self._inbox.extend(self._suffer(datagram, self._held_in))
        return self._inbox.popleft()

    def steady_time_s(self) -> float:
        """Return the inner transport's time."""
        return self._inner.steady_time_s()

    def close(self) -> None:
        """Close the inner transport."""
        self._inner.close()

    def _suffer(self, datagram: bytes, held: list[tuple[int, bytes]]) -> list[bytes]:
        """Return what arrives now, given that `datagram` was sent now."""
        rng = self._rng
        due = [late for wait, late in held if wait <= 1]
        held[:] = [(wait - 1, late) for wait, late in held if wait > 1]
        copies = 2 if rng.random() < self._duplication else 1
        now: list[bytes] = []
        for _ in range(copies):
            if rng.random() < self._loss:
                continue
            arriving = datagram
            if rng.random() < self._truncation:
                arriving = datagram[: int(rng.integers(0, len(datagram) + 1))]
            if rng.random() < self._reordering:
                held.append((int(rng.integers(1, 4)), arriving))
            else:
                now.append(arriving)
        return now + due
