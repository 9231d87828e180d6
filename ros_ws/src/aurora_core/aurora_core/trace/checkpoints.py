# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A running digest over the messages of a bag, noted inside the bag at every flush.

The digest of the file in `metadata.yaml` tells that a bag was changed; the checkpoints tell where,
and also when someone has written a new file digest beside a changed bag. They are no signature:
whoever rewrites checkpoints and metadata alike is found by the trace hash in the run's report.
"""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterable, Mapping
from dataclasses import dataclass

# Names of MCAP Metadata records.
CHECKPOINT = 'aurora.checkpoint'
RECOVERY = 'aurora.recovery'

_HEAD = struct.Struct('<HQQ')


@dataclass(frozen=True, slots=True, kw_only=True)
class Checkpoint:
    """What a bag should hold up to a place.

    Attributes:
        messages: Number of messages before it.
        time_ns: Latest simulated time among them.
        sha256: Running digest (hex) over them.
        final: Nothing follows.
    """

    messages: int
    time_ns: int
    sha256: str
    final: bool

    def record(self) -> dict[str, str]:
        """Return the values of the Metadata record."""
        return {
            'messages': str(self.messages),
            'time_ns': str(self.time_ns),
            'sha256': self.sha256,
            'final': str(int(self.final)),
        }


class ContentDigest:
    """Digest over topic, time and bytes of each message, in the order of the file."""

    def __init__(self) -> None:
        self._digest = hashlib.sha256()
        self.messages = 0
        self.time_ns = 0

    def add(self, messages: Iterable[tuple[bytes, int, bytes | memoryview]]) -> None:
        """Take in messages: topic name in UTF-8, simulated time, encoding."""
        pack, parts, latest_ns = _HEAD.pack, list[bytes | memoryview](), self.time_ns
        for topic, time_ns, cdr in messages:
            parts += (pack(len(topic), time_ns, len(cdr)), topic, cdr)
            if time_ns > latest_ns:
                latest_ns = time_ns
        self.messages += len(parts) // 3
        self.time_ns = latest_ns
        self._digest.update(b''.join(parts))

    def checkpoint(self, *, final: bool = False) -> Checkpoint:
        """Return where the digest stands."""
        return Checkpoint(
            messages=self.messages,
            time_ns=self.time_ns,
            sha256=self._digest.hexdigest(),
            final=final,
        )


def read_checkpoint(values: Mapping[str, str]) -> Checkpoint:
    """Read the values of a Metadata record.

    Raises:
        ValueError: They are not those of a checkpoint.
    """
    try:
        return Checkpoint(
            messages=int(values['messages']),
            time_ns=int(values['time_ns']),
            sha256=values['sha256'],
            final=bool(int(values['final'])),
        )
    except KeyError as err:
        raise ValueError(f'a checkpoint has no value {err}') from err
