# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Recording`: which message belongs into the bag of a run, and is everything there? No ROS."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Protocol

from aurora_core.errors import BagError
from aurora_ros import cdr as wire


class Belonging(Enum):
    """How a message tells that it belongs to a run."""

    EVERY_TICK = 'every_tick'  # run number, and one message per tick without a gap
    AT_TICK = 'at_tick'  # run number
    BY_ID = 'by_id'  # run id
    CLOCK = 'clock'  # only by being there while the run is recorded


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedTopic:
    """A topic that goes into the bag."""

    name: str
    type_name: str
    belonging: Belonging
    first_tick: int = 0  # of EVERY_TICK


class Writer(Protocol):
    """What a recording needs of a bag writer."""

    def write(self, topic: str, type_name: str, cdr: bytes, time_ns: int) -> None:
        """Append a message."""

    def flush(self) -> None:
        """Put everything on the disk."""


class Recording:
    """The messages of one run.

    Args:
        writer: Open bag.
        run_id: Of roster, world, graph and verdict.
        run_number: Of everything on the tick path.
    """

    def __init__(self, writer: Writer, *, run_id: str, run_number: int) -> None:
        self._writer = writer
        self.run_id = run_id
        self.run_number = run_number
        self._counts: dict[str, int] = {}
        self._last_tick: dict[str, int] = {}
        self._last_clock_ns = -1

    @property
    def stored_tick(self) -> int:
        """Last tick of which every stream that has begun is stored, -1 before the first."""
        return min(self._last_tick.values(), default=-1)

    def store(self, topic: RecordedTopic, cdr: bytes) -> bool:
        """Write a message if it belongs to the run.

        Returns:
            Whether it was written.

        Raises:
            BagError: A sample was lost, or the bag cannot be written.
        """
        if not self._belongs(topic, cdr):
            return False
        self._writer.write(topic.name, topic.type_name, cdr, wire.time_ns(cdr))
        self._counts[topic.name] = self._counts.get(topic.name, 0) + 1
        return True

    def flush(self) -> None:
        """Put everything on the disk."""
        self._writer.flush()

    def missing(self, expected: Mapping[str, int]) -> dict[str, int]:
        """Return how many messages of which topic have not come yet."""
        lacks = {name: count - self._counts.get(name, 0) for name, count in expected.items()}
        return {name: lack for name, lack in lacks.items() if lack > 0}

    def excess(self, expected: Mapping[str, int]) -> dict[str, int]:
        """Return how many messages of which topic came beyond what was expected."""
        lacks = {name: self._counts.get(name, 0) - count for name, count in expected.items()}
        return {name: lack for name, lack in lacks.items() if lack > 0}

    def _belongs(self, topic: RecordedTopic, cdr: bytes) -> bool:
        if topic.belonging is Belonging.BY_ID:
            return wire.run_id(cdr) == self.run_id
        if topic.belonging is Belonging.CLOCK:
            return self._is_next_clock(wire.time_ns(cdr))
        run_number, tick = wire.run_and_tick(cdr)
        if run_number != self.run_number:
            return False
        return topic.belonging is Belonging.AT_TICK or self._is_next_tick(topic, tick)

    def _is_next_clock(self, time_ns: int) -> bool:
        """Accept clock samples in order: one of an earlier run may still be on its way."""
        if self._last_clock_ns < 0 and time_ns > 0:
            return False
        if time_ns <= self._last_clock_ns:
            return False
        self._last_clock_ns = time_ns
        return True

    def _is_next_tick(self, topic: RecordedTopic, tick: int) -> bool:
        last = self._last_tick.get(topic.name, topic.first_tick - 1)
        if tick <= last:
            return False
        if tick != last + 1:
            raise BagError(
                f'expected tick {last + 1} on {topic.name}, found {tick}: a sample was lost'
            )
        self._last_tick[topic.name] = tick
        return True
