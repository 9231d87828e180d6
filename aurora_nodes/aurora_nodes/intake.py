# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`Intake`: takes what arrives for the bag in short intervals, in a thread of its own.

Waking an executor for each message would cost more than storing it, and waking it by a timer costs
more than looking whether there is a message.
"""

from __future__ import annotations

import dataclasses
import threading
import time
import traceback
from collections.abc import Callable

from aurora_core.errors import AuroraError, BagError, ExecutionError
from aurora_nodes.recording import Belonging, RecordedTopic, Recording
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.interfaces import Topic
from aurora_ros.node import AuroraNode, defect
from aurora_ros.polling import PolledGroup, drain
from aurora_ros.writers import MatchedWriters

# How often it is looked who writes, while recording (s).
_LOOK_S = 0.2

_TOPICS: tuple[tuple[Topic, Belonging, int], ...] = (
    (on.AGSG, Belonging.BY_ID, 0),
    (on.ROSTER, Belonging.BY_ID, 0),
    (on.WORLD, Belonging.BY_ID, 0),
    (dataclasses.replace(on.CLOCK, qos=qos.CLOCK_HISTORY), Belonging.CLOCK, 0),
    (on.GROUND_STATE, Belonging.EVERY_TICK, 0),
    (on.UAV_STATE, Belonging.EVERY_TICK, 0),
    (on.GROUND_COMMAND, Belonging.EVERY_TICK, 1),
    (on.UAV_COMMAND, Belonging.EVERY_TICK, 1),
    (on.COMM, Belonging.AT_TICK, 0),
    (on.SENSING, Belonging.AT_TICK, 0),
    (on.EVENTS, Belonging.AT_TICK, 0),
    (on.VERDICT, Belonging.BY_ID, 0),
)


class Intake:
    """Subscriptions of everything that is recorded; they live as long as the node.

    Args:
        node: The recorder.
        poll_period_s: Wall-clock time between two looks while recording.
        idle_period_s: The same while idle, when everything is dropped.
        ack_ticks: The bag is put on the disk this often.
        on_stored: Called in the thread with the last tick that is on the disk.
        on_failure: Called in the thread when the recording cannot go on; nothing more is stored.
    """

    def __init__(
        self,
        node: AuroraNode,
        *,
        poll_period_s: float,
        idle_period_s: float,
        ack_ticks: int,
        on_stored: Callable[[Recording, int], None],
        on_failure: Callable[[Recording, AuroraError], None],
    ) -> None:
        self._node = node
        self._poll_period_s = poll_period_s
        self._idle_period_s = idle_period_s
        self._ack_ticks = ack_ticks
        self._on_stored = on_stored
        self._on_failure = on_failure
        group = PolledGroup()
        self._taps = {
            RecordedTopic(
                name=topic.full_name,
                type_name=topic.type_name,
                belonging=belonging,
                first_tick=first_tick,
            ): node.subscription(topic, _ignore, raw=True, group=group)
            for topic, belonging, first_tick in _TOPICS
        }
        self._writers = MatchedWriters(
            node,
            {topic: tap for (topic, _, _), tap in zip(_TOPICS, self._taps.values(), strict=True)},
        )
        self._looked_s = 0.0
        self._recording: Recording | None = None
        self._acked = -1
        self._lock = threading.Lock()
        self._changed = threading.Event()
        self._closing = False
        # Starts with the first recording: endpoints must not be used while others are created.
        self._thread = threading.Thread(target=self._work, name='intake', daemon=True)

    def begin(self, recording: Recording) -> None:
        """Store what belongs to a recording from now on; nobody else may begin to write it."""
        with self._lock:
            self._acked = -1
            self._writers.begin()
            self._recording = recording
        if not self._thread.is_alive():
            self._thread.start()
        self._changed.set()

    def drop(self) -> None:
        """Store nothing more; what has arrived and was not stored is dropped."""
        with self._lock:
            self._recording = None
            self._drain()

    def look(self) -> None:
        """Store what has arrived.

        Raises:
            BagError: A sample was lost, or the bag cannot be written.
        """
        with self._lock:
            self._drain()

    def end(self) -> None:
        """Store nothing more, and look whether anybody else has written what is stored.

        In this order: a sample comes only from a writer that was matched before.

        Raises:
            ExecutionError: Somebody has, or may have.
        """
        with self._lock:
            self._recording = None
            self._writers.check(last=True)

    def close(self) -> None:
        """End the thread; the subscriptions may be destroyed afterwards."""
        self._closing = True
        self._changed.set()
        if self._thread.is_alive():
            self._thread.join()
        self._writers.close()

    def unmatched(self, wanted: set[str]) -> list[str]:
        """Return which of these topics have no publisher.

        Raises:
            BagError: One of them is not recorded at all.
        """
        unknown = wanted - {topic.name for topic in self._taps}
        if unknown:
            raise BagError(f'expected topics that are recorded, found {sorted(unknown)}')
        return [
            topic.name
            for topic, tap in self._taps.items()
            if topic.name in wanted and tap.get_publisher_count() == 0
        ]

    def _work(self) -> None:
        while not self._closing:
            idle = self._recording is None
            self._changed.wait(self._idle_period_s if idle else self._poll_period_s)
            self._changed.clear()
            self._poll()

    def _poll(self) -> None:
        with self._lock:
            recording = self._recording
            try:
                self._drain()
                if recording is not None:
                    self._acknowledge(recording)
                    self._look_around()
                return
            except AuroraError as err:
                error = self._cause(err)
            except OSError as err:
                error = BagError(f'cannot write the bag: {err}')
            except Exception as err:  # noqa: BLE001 - a defect: it ends the run, not the node
                self._node.get_logger().error(traceback.format_exc())
                error = defect(err, self._node.get_name())
            self._recording = None
        if recording is not None:
            self._on_failure(recording, error)

    def _drain(self) -> None:
        """Take what has arrived; without a recording it is dropped."""
        recording = self._recording
        for topic, tap in self._taps.items():
            for cdr in drain(tap):
                if recording is not None:
                    recording.store(topic, cdr)

    def _look_around(self) -> None:
        now_s = time.monotonic()
        if now_s - self._looked_s >= _LOOK_S:
            self._looked_s = now_s
            self._writers.check()

    def _cause(self, error: AuroraError) -> AuroraError:
        """Return what is behind an error: a message too many may be a stranger's."""
        try:
            self._writers.check()
        except ExecutionError as err:
            return err
        return error

    def _acknowledge(self, recording: Recording) -> None:
        stored = recording.stored_tick
        if stored >= self._acked + self._ack_ticks:
            recording.flush()
            self._acked = stored
            self._on_stored(recording, stored)


def _ignore(_cdr: bytes) -> None:
    """Nothing: the subscription is drained."""
