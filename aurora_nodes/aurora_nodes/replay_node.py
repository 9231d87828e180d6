# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ReplayNode`: publishes a recorded run in place of the nodes that it came from.

Its methods block, so they are called from another thread than the one that spins the node.
"""

from __future__ import annotations

import dataclasses
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from rclpy.duration import Duration
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.publisher import Publisher
from rosgraph_msgs.msg import Clock as ClockMessage

from aurora_core.errors import ExecutionError
from aurora_core.trace import messages
from aurora_core.trace.bag_reader import StoredMessage
from aurora_msgs.msg import Ack, Heartbeat, RunEnd, SyncStatus, Verdict
from aurora_nodes.replay_plan import ReplayPlan
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.conversions.time import stamp
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.matching import wait_until
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare, require_positive

MONITOR = 'monitor'
_COMPONENT = 'replay'
_ALONE = 'give --no-monitor to publish for RViz, Foxglove or ros2 topic echo alone'
_LOOK_S = 0.1
_STREAMS = (
    messages.GROUND_STATE,
    messages.UAV_STATE,
    messages.GROUND_COMMAND,
    messages.UAV_COMMAND,
)


@dataclass(frozen=True, kw_only=True)
class ReplaySettings:
    """See `config/replay.param.yaml`."""

    discovery_s: float
    monitor_limit_s: float
    credit_ticks: int
    ack_limit_s: float
    verdict_limit_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'discovery_s', 'monitor_limit_s', 'credit_ticks')
        require_positive(self, 'ack_limit_s', 'verdict_limit_s')


class ReplayNode(AuroraNode):
    """Publishes one bag.

    Args:
        plan: What to publish.
    """

    def __init__(self, plan: ReplayPlan) -> None:
        super().__init__('replay')
        self._settings = declare(self, 'replay', ReplaySettings)
        self._plan = plan
        self._changed = threading.Condition()
        self._acked = -1
        self._verdict: Verdict | None = None
        self._busy: dict[str, bool] = {}
        self._running = ''
        self._began = self._ended = False
        self._outlets: dict[str, Publisher] = {}
        self._watch = HeartbeatWatch(self)
        self.subscription(on.HEARTBEAT, self._on_heartbeat)
        self.subscription(on.SYNC_STATUS, self._on_status)
        # Volatile: the latched verdict of an earlier run or replay is not wanted.
        verdicts = dataclasses.replace(on.VERDICT, qos=qos.STREAM)
        self._heard = [
            self.subscription(on.ACK, self._on_ack),
            self.subscription(verdicts, self._on_verdict),
        ]

    def await_quiet(self) -> None:
        """Look whether a run is going on in this domain; if not, get ready to publish.

        Not before: a second writer on its topics ends a run.

        Raises:
            ExecutionError: There is one.
        """
        deadline = time.monotonic() + self._settings.discovery_s
        self._await(lambda: time.monotonic() > deadline or self._is_occupied())
        self._refuse_occupied()
        self._outlets = {topic.full_name: self.publisher(topic) for topic in on.JUDGED}
        self._clock_outlet = self.publisher(on.CLOCK)
        self._status_outlet = self.publisher(on.SYNC_STATUS)
        self._end_outlet = self.publisher(on.RUN_END)

    def _refuse_occupied(self) -> None:
        if self._is_occupied():
            raise ExecutionError(
                f'a run is going on in this ROS_DOMAIN_ID: {self._occupant()}',
                component=_COMPONENT,
                hint='wait for its end, or use another ROS_DOMAIN_ID',
            )

    def await_listeners(self) -> None:
        """Wait until whoever was discovered is heard; not longer than for a monitor."""
        wait_until(self._all_matched, self._settings.monitor_limit_s)

    def await_monitor(self) -> None:
        """Wait until a monitor hears everything and is heard.

        Raises:
            ExecutionError: None does within the limit.
        """
        limit_s = self._settings.monitor_limit_s
        if not wait_until(self._monitor_matched, limit_s):
            raise ExecutionError(
                f'no monitor listens in this ROS_DOMAIN_ID (waited {limit_s:g} s)',
                component=_COMPONENT,
                hint=f'start one: ros2 run aurora_nodes monitor (its `live` true); or {_ALONE}',
            )

    def play(self, *, rate: float | None, monitored: bool) -> None:
        """Publish the whole run.

        Args:
            rate: Times real time; None: no limit of that kind.
            monitored: Tell the monitor and wait for its acknowledgements. Without that, one that
                hears us by chance pays no attention: it may miss messages.

        Raises:
            ExecutionError: A run is going on or began, the monitor stopped acknowledging or died,
                or a message could not be published.
        """
        # Where discovery is slow it is heard of while a monitor is waited for.
        self._refuse_occupied()
        self._began = monitored
        self.heartbeat.busy(self._plan.run_number)
        if monitored:
            self._tell(SyncStatus.LOADED)
            # Who has not discovered us yet would hear only the next one of these.
            limit = Duration(nanoseconds=int(self._settings.monitor_limit_s * 1e9))
            self._status_outlet.wait_for_all_acked(limit)
        for document in self._plan.documents:
            self._send(document)
        if monitored:
            self._tell(SyncStatus.RUNNING)
        sent: dict[str, int] = {}
        began_s = time.monotonic()
        for tick, group in enumerate(self._plan.ticks):
            self._check()
            if rate is not None:
                due_s = began_s + min(tick, self._plan.last_tick) * self._plan.dt_s / rate
                self._await(self._is_occupied, until_s=due_s)
            if monitored and sent:
                self._await_acknowledged(min(sent.values()) - self._settings.credit_ticks)
            if tick <= self._plan.last_tick:
                self._clock_outlet.publish(ClockMessage(clock=stamp(tick, self._plan.dt_s)))
            for message in group:
                self._send(message)
                if message.topic in _STREAMS:
                    sent[message.topic] = tick
        self._check()
        if monitored:
            self._tell(SyncStatus.FINISHED)
            self._ended = True
            self._end_outlet.publish(self._end())

    def await_verdict(self) -> Verdict:
        """Wait for what the monitor has found out.

        Raises:
            ExecutionError: It told nothing within the limit, or died.
        """
        limit_s = self._settings.verdict_limit_s
        self._await(
            lambda: self._verdict is not None, until_s=time.monotonic() + limit_s, checked=True
        )
        if self._verdict is None:
            raise ExecutionError(
                f'the monitor published no verdict of run {self._plan.run_id} within '
                f'{limit_s:g} s of its end',
                component=MONITOR,
                hint='see its log; is its parameter `live` true?',
            )
        return self._verdict

    def leave(self) -> None:
        """Tell the listeners that nothing more comes, and let the last messages reach them."""
        if self._began and not self._ended:
            self._tell(SyncStatus.IDLE)
        if not self._outlets:
            return
        limit = Duration(seconds=1)
        for publisher in (*self._outlets.values(), self._status_outlet, self._end_outlet):
            publisher.wait_for_all_acked(limit)

    def _send(self, message: StoredMessage) -> None:
        try:
            self._outlets[message.topic].publish(message.cdr)
        except rclpy_implementation.RCLError as err:
            raise ExecutionError(
                f'a message on {message.topic} could not be published: {err}',
                component=_COMPONENT,
                hint='does somebody listen who does not keep up? a lower --rate helps',
            ) from err

    def _tell(self, state: int) -> None:
        tick = self._plan.last_tick if state == SyncStatus.FINISHED else 0
        self._status_outlet.publish(
            SyncStatus(run_number=self._plan.run_number, state=state, tick=tick)
        )

    def _end(self) -> RunEnd:
        counts = self._plan.counts
        return RunEnd(
            run_number=self._plan.run_number,
            run_id=self._plan.run_id,
            iteration=self._plan.iteration,
            last_tick=self._plan.last_tick,
            replayed=True,
            topics=list(counts),
            counts=list(counts.values()),
            damage_kinds=[kind.value for kind, _ in self._plan.damage],
            damage_notes=[note for _, note in self._plan.damage],
        )

    def _await_acknowledged(self, tick: int) -> None:
        if self._acked >= tick:
            return
        limit_s = self._settings.ack_limit_s
        self._await(lambda: self._acked >= tick, until_s=time.monotonic() + limit_s, checked=True)
        if self._acked < tick:
            raise ExecutionError(
                f'the monitor did not acknowledge tick {tick} within {limit_s:g} s (it is at '
                f'{self._acked})',
                component=MONITOR,
                hint=f'see its log; is its parameter `live` true? or {_ALONE}',
            )

    def _await(
        self, is_true: Callable[[], bool], *, until_s: float = float('inf'), checked: bool = False
    ) -> None:
        """Wait until something holds or a time has come, looking when a message comes."""
        with self._changed:
            while not is_true() and (left_s := until_s - time.monotonic()) > 0.0:
                self._changed.wait(min(_LOOK_S, left_s))
                if checked:
                    self._check()

    def _check(self) -> None:
        """Give way to a run; notice a dead monitor.

        Raises:
            ExecutionError: The replay cannot go on.
        """
        # Not only its clock: a run does not begin while we publish.
        if self._is_occupied():
            raise ExecutionError(
                f'gave way to a run that began: {self._occupant()}',
                component=_COMPONENT,
                hint='replay again when it has ended',
            )
        if self._began and self._watch.is_dead(MONITOR):
            raise ExecutionError('the monitor died during the replay', component=MONITOR)

    def _is_occupied(self) -> bool:
        return bool(self._running) or any(self._busy.values())

    def _occupant(self) -> str:
        busy = sorted(name for name, is_busy in self._busy.items() if is_busy)
        return ' and '.join([self._running, *busy] if self._running else busy)

    def _monitor_matched(self) -> bool:
        # Of whom no sign of life came, none could be missed either: a death would go unnoticed.
        if not self._watch.was_heard(MONITOR):
            return False
        for publisher in (*self._outlets.values(), self._status_outlet, self._end_outlet):
            listeners = self.get_subscriptions_info_by_topic(publisher.topic_name)
            if MONITOR not in {info.node_name for info in listeners}:
                return False
        for subscription in self._heard:
            speakers = self.get_publishers_info_by_topic(subscription.topic_name)
            if MONITOR not in {info.node_name for info in speakers}:
                return False
            if subscription.get_publisher_count() < len(speakers):
                return False
        return self._all_matched()

    def _all_matched(self) -> bool:
        return all(
            publisher.get_subscription_count()
            >= len(self.get_subscriptions_info_by_topic(publisher.topic_name))
            for publisher in (*self._outlets.values(), self._status_outlet, self._end_outlet)
        )

    def _on_heartbeat(self, message: Heartbeat) -> None:
        """Notice who is busy: the monitor, which takes whatever comes, and we do not count."""
        if message.node in (MONITOR, self.get_name()):
            return
        with self._changed:
            self._busy[message.node] = message.state == Heartbeat.BUSY
            self._changed.notify_all()

    def _on_status(self, message: SyncStatus) -> None:
        """Notice a run of somebody else; once it has begun, our own word comes back to us."""
        if self._began and message.run_number == self._plan.run_number:
            return
        if message.state in (SyncStatus.LOADED, SyncStatus.RUNNING):
            with self._changed:
                self._running = f'the clock of run number {message.run_number}'
                self._changed.notify_all()

    def _on_ack(self, message: Ack) -> None:
        if message.run_number == self._plan.run_number and message.observer == MONITOR:
            with self._changed:
                self._acked = message.tick
                self._changed.notify_all()

    def _on_verdict(self, message: Verdict) -> None:
        named = (message.run_id, message.iteration) == (self._plan.run_id, self._plan.iteration)
        if named and message.source == Verdict.LIVE:
            with self._changed:
                self._verdict = message
                self._changed.notify_all()
