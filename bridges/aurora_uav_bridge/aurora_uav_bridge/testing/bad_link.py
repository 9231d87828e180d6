# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a bad link does to the datagrams of one direction. No sockets, no time."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, fields

import numpy as np

# CRC-16/MCRF4XX finds every error of up to three bits in a frame of MAVLink's length.
_MOST_FLIPS = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkFaults:
    """Shares of all datagrams, 0 to 1.

    Attributes:
        loss: Never arrives.
        duplication: Arrives twice.
        reordering: Arrives late, so that later ones overtake it.
        truncation: Arrives cut at a random place.
        corruption: Arrives with one to three bits flipped.
        delay_s: A late datagram is late by a random time up to this.
    """

    loss: float = 0.0
    duplication: float = 0.0
    reordering: float = 0.0
    truncation: float = 0.0
    corruption: float = 0.0
    delay_s: float = 0.02

    def __post_init__(self) -> None:
        for field in fields(self):
            value = getattr(self, field.name)
            if not 0.0 <= value <= 1.0:
                raise ValueError(f'{field.name}: expected a number from 0 to 1, found {value}')


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrival:
    """What comes out at the other end.

    Attributes:
        data: The datagram.
        late_s: How much later than the others.
    """

    data: bytes
    late_s: float = 0.0


class BadLink:
    """One direction of a link.

    Args:
        faults: Shares; may be replaced at any time.
        rng: Decides what happens to each datagram.

    Attributes:
        faults: As given.
        counts: How many datagrams came in (`sent`) and what happened to them, by fault.
    """

    def __init__(self, faults: LinkFaults, rng: np.random.Generator) -> None:
        self.faults = faults
        self.counts: Counter[str] = Counter()
        self._rng = rng

    def carry(self, datagram: bytes) -> list[Arrival]:
        """Return what arrives of a datagram: nothing, one or two."""
        faults = self.faults
        self.counts['sent'] += 1
        copies = 2 if self._happens('duplication', faults.duplication) else 1
        arrivals = []
        for _ in range(copies):
            if self._happens('loss', faults.loss):
                continue
            data = datagram
            if self._happens('truncation', faults.truncation):
                data = data[: int(self._rng.integers(0, len(data) + 1))]
            if data and self._happens('corruption', faults.corruption):
                data = self._flipped(data)
            late = self._happens('reordering', faults.reordering)
            late_s = float(self._rng.random()) * faults.delay_s if late else 0.0
            arrivals.append(Arrival(data=data, late_s=late_s))
        return arrivals

    def _happens(self, name: str, share: float) -> bool:
        happens = bool(self._rng.random() < share)
        if happens:
            self.counts[name] += 1
        return happens

    def _flipped(self, data: bytes) -> bytes:
        changed = bytearray(data)
        flips = int(self._rng.integers(1, _MOST_FLIPS + 1))
        # Without replacement: a bit that is flipped twice is not corrupted.
        for bit in self._rng.choice(8 * len(data), flips, replace=False):
            changed[bit >> 3] ^= 1 << (int(bit) & 7)
        return bytes(changed)
