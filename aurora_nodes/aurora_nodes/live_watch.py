# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LiveWatch`: hears a run as it happens and acknowledges it, so that the clock waits for it.

As in the recorder, subscriptions are drained in batches: waking the executor for each message
would cost more than keeping it.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable
from dataclasses import dataclass

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from aurora_core.trace.trace import Integrity
from aurora_msgs.msg import Ack, RunEnd, SyncStatus
from aurora_nodes.live_margins import LiveMargins
from aurora_nodes.live_run import LiveRun, RunTotals
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.interfaces import Topic
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import require_positive
from aurora_ros.polling import PolledGroup, drain


@dataclass(frozen=True, kw_only=True)
class LiveSettings:
    """See `config/monitor.param.yaml`."""

    live: bool
    poll_period_s: float
    idle_period_s: float
    ack_ticks: int
    end_limit_s: float
    margins_period_s: float
    margins_lag_ticks: int

    def __post_init__(self) -> None:
        require_positive(self, 'poll_period_s', 'idle_period_s', 'ack_ticks', 'end_limit_s')
        require_positive(self, 'margins_period_s', 'margins_lag_ticks')


class LiveWatch:
    """Keeps the messages of the run that is going on.

    Args:
        node: The monitor.
        settings: Periods and limits.
        watch: Tells whether the clock still lives, which says how a run ends.
        margins: Looks ahead while the run goes on.
        on_end: Called with a run that has ended, once everything that was sent is there or the
            limit for that has passed.
    """

    def __init__(
        self,
        node: AuroraNode,
        settings: LiveSettings,
        watch: HeartbeatWatch,
        margins: LiveMargins,
        on_end: Callable[[LiveRun, RunTotals], None],
    ) -> None:
        self._node = node
        self._settings = settings
        self._watch = watch
        self._margins = margins
        self._on_end = on_end
        self._run: LiveRun | None = None
        self._totals: RunTotals | None = None
        self._deadline_s = float('inf')
        self._acked = -1
        # What came since the last look while no run was known: a run is announced on another
        # topic, which its first messages may overtake.
        self._early: dict[str, list[bytes]] = {}
        group = PolledGroup()
        self._taps = {
            topic.full_name: node.subscription(topic, _ignore, raw=True, group=group)
            for topic in on.JUDGED
        }
        self._statuses = node.subscription(_history(on.SYNC_STATUS), self._on_status)
        self._ends = node.subscription(_history(on.RUN_END), self._on_end_message)
        self._ack_publisher = node.publisher(on.ACK)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(settings.idle_period_s, self._on_idle, clock=steady)
        self._poll = node.create_timer(settings.poll_period_s, self.poll, clock=steady)
        self._poll.cancel()

    @property
    def is_ending(self) -> bool:
        """Whether a run has ended of which not everything is there yet."""
        return self._run is not None and self._deadline_s < float('inf')

    def look(self) -> None:
        """Take what has arrived and acknowledge it; for whoever keeps the node's thread busy."""
        for status in drain(self._statuses):
            self._on_status(status)
        for end in drain(self._ends):
            self._on_run_end(end)
        for topic, tap in self._taps.items():
            heard = list(drain(tap))
            if self._run is not None:
                self._run.keep(topic, heard)
            else:
                self._early[topic] = heard
        self._acknowledge()

    def _on_idle(self) -> None:
        if self._run is None:
            self.look()
        elif self._watch.is_dead('sync'):
            self._node.get_logger().error('sync died: the run is dropped')
            self._close()

    def _on_status(self, status: SyncStatus) -> None:
        run = self._run
        if status.state == SyncStatus.LOADED:
            # Also with the same number: a replay that was killed is begun again.
            self._begin(status.run_number)
        elif run is None or status.run_number != run.run_number:
            return
        elif status.state == SyncStatus.FINISHED:
            self._deadline_s = time.monotonic() + self._settings.end_limit_s
        elif status.state != SyncStatus.RUNNING:
            self._close()

    def _begin(self, run_number: int) -> None:
        self._close()
        self._run = LiveRun(run_number)
        for topic, heard in self._early.items():
            self._run.keep(topic, heard)
        self._early.clear()
        self._margins.begin(self._run)
        self._poll.reset()
        self._node.heartbeat.busy(run_number)

    def _close(self) -> None:
        self._margins.end()
        self._run = self._totals = None
        self._acked = -1
        self._deadline_s = float('inf')
        self._poll.cancel()
        self._node.heartbeat.idle()

    def _on_run_end(self, message: RunEnd) -> None:
        if self._run is None or message.run_number != self._run.run_number:
            return
        try:
            self._totals = _totals(message)
        except ValueError as err:
            self._node.get_logger().error(f'the end of run {message.run_id} is not valid: {err}')
            self._close()
            return
        self._deadline_s = time.monotonic() + self._settings.end_limit_s

    def _on_end_message(self, message: RunEnd) -> None:
        self._on_run_end(message)
        self.poll()

    def poll(self) -> None:
        """Take what has arrived; go on to the end once everything is there."""
        self.look()
        run, totals = self._run, self._totals
        if run is None:
            return
        if totals is None:
            self._margins.look()
        overdue = time.monotonic() > self._deadline_s
        if totals is None:
            if overdue:
                self._node.get_logger().warning('a run ended, but not how much was sent: dropped')
                self._close()
            return
        missing = run.missing(totals)
        if missing and not overdue:
            return
        if missing:
            self._node.get_logger().error(f'not heard of run {totals.run_id}: {missing}')
        self._close()
        self._on_end(run, totals)

    def _acknowledge(self) -> None:
        run = self._run
        if run is None:
            return
        tick = run.stored_tick
        if tick < self._acked + self._settings.ack_ticks:
            return
        self._acked = tick
        self._node.heartbeat.at(tick)
        self._ack_publisher.publish(
            Ack(run_number=run.run_number, observer=self._node.get_name(), tick=tick)
        )


def _totals(message: RunEnd) -> RunTotals:
    """Return what a message says.

    Raises:
        ValueError: Its arrays do not fit each other, or an integrity is not one.
    """
    return RunTotals(
        run_number=message.run_number,
        run_id=message.run_id,
        iteration=message.iteration,
        counts=dict(zip(message.topics, message.counts, strict=True)),
        replayed=message.replayed,
        damage=tuple(
            (Integrity(kind), note)
            for kind, note in zip(message.damage_kinds, message.damage_notes, strict=True)
        ),
    )


def _history(topic: Topic) -> Topic:
    return dataclasses.replace(topic, qos=qos.LATCHED_HISTORY)


def _ignore(_cdr: bytes) -> None:
    """Nothing: the subscription is drained."""
