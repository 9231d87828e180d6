# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `sync` node: `TickBarrier` on topics and services."""

from __future__ import annotations

import time
from dataclasses import dataclass

from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rosgraph_msgs.msg import Clock as ClockMessage

from aurora_core.errors import AuroraError, ParticipantSilentError
from aurora_msgs.msg import Ack, Fault, SyncStatus, Tick, TickDone
from aurora_msgs.srv import LoadSync, StartSync, StopSync
from aurora_ros import interfaces as on
from aurora_ros.conversions.time import stamp
from aurora_ros.errors import read_error, write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.main import run_node
from aurora_ros.matching import await_subscribers
from aurora_ros.parameters import declare, require_positive
from aurora_sync.barrier import BarrierLoad, Phase, TickBarrier, tick_of_horizon

_EXECUTOR = 'executor'
_STATES = {
    Phase.IDLE: SyncStatus.IDLE,
    Phase.LOADED: SyncStatus.LOADED,
    Phase.RUNNING: SyncStatus.RUNNING,
    Phase.FINISHED: SyncStatus.FINISHED,
    Phase.FAILED: SyncStatus.FAILED,
}


@dataclass(frozen=True, kw_only=True)
class SyncSettings:
    """See `config/sync.param.yaml`."""

    autostart: bool
    credit_ticks: int
    recorder_credit_ticks: int
    silence_limit_s: float
    watchdog_period_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'credit_ticks', 'recorder_credit_ticks')
        require_positive(self, 'silence_limit_s', 'watchdog_period_s')


class SyncNode(ManagedNode):
    """Publishes `/clock` and how far it may go; collects what the participants answer."""

    def __init__(self) -> None:
        super().__init__('sync')
        self._settings = declare(self, 'sync', SyncSettings)
        self.wants_autostart = self._settings.autostart
        self._dt_s = 0.0
        self._listeners = 0
        self._published: tuple[Phase, int] | None = None
        self._granted = -1

    def configure(self) -> None:
        """Create the barrier and its endpoints."""
        self._barrier = TickBarrier(
            credit_ticks=self._settings.credit_ticks,
            silence_limit_s=self._settings.silence_limit_s,
            own_credit_ticks={'recorder': self._settings.recorder_credit_ticks},
        )
        self._clock_publisher = self.publisher(on.CLOCK)
        self._tick_publisher = self.publisher(on.TICK)
        self._status_publisher = self.publisher(on.SYNC_STATUS)
        self.subscription(on.TICK_DONE, self._on_done)
        self.subscription(on.ACK, self._on_ack)
        self.subscription(on.FAULT, self._on_fault)
        self._watch = HeartbeatWatch(self)
        self.serve(on.SYNC_LOAD, self._load)
        self.serve(on.SYNC_START, self._start)
        self.serve(on.SYNC_STOP, self._stop)
        self.create_timer(
            self._settings.watchdog_period_s,
            self._on_watchdog,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    def deactivate(self) -> None:
        """Give up a run that is going on."""
        self._barrier.stop(self._barrier.status.run_number)
        self._tell()

    def _load(self, request: LoadSync.Request, response: LoadSync.Response) -> LoadSync.Response:
        self.require_active()
        self._dt_s = request.dt_s
        self._listeners = request.listeners
        self._granted = -1
        self._barrier.load(
            BarrierLoad(
                run_number=request.run_number,
                last_tick=tick_of_horizon(request.horizon_s, request.dt_s),
                participants=tuple(request.participants),
                observers=tuple(request.observers),
            )
        )
        self._tell()
        response.ok = True
        return response

    def _start(
        self, request: StartSync.Request, response: StartSync.Response
    ) -> StartSync.Response:
        self.require_active()
        await_subscribers(
            {self._tick_publisher: self._listeners},
            limit_s=self._settings.silence_limit_s,
            component=self.get_name(),
        )
        self._publish(self._barrier.start(request.run_number, time.monotonic()))
        response.ok = True
        return response

    def _stop(self, request: StopSync.Request, response: StopSync.Response) -> StopSync.Response:
        response.last_tick = self._barrier.stop(request.run_number)
        self._tell()
        response.ok = True
        return response

    def _on_done(self, message: TickDone) -> None:
        self._publish(
            self._barrier.done(
                message.run_number,
                message.tick,
                message.participant,
                message.finished,
                time.monotonic(),
            )
        )

    def _on_ack(self, message: Ack) -> None:
        self._publish(
            self._barrier.acknowledge(
                message.run_number, message.observer, message.tick, time.monotonic()
            )
        )

    def _on_fault(self, message: Fault) -> None:
        error = read_error(message, message.node)
        if error is not None:
            self._barrier.fault(message.run_number, error)
            self._tell()

    def _on_watchdog(self) -> None:
        self._barrier.check(time.monotonic())
        self._check_executor()
        self._tell()

    def _check_executor(self) -> None:
        """Fail a run whose executor has died: nobody else would end it."""
        status = self._barrier.status
        if status.phase not in (Phase.LOADED, Phase.RUNNING):
            return
        cause = self._watch.cause_of_death(_EXECUTOR)
        if cause:
            error = ParticipantSilentError(f'{_EXECUTOR} {cause}', component=_EXECUTOR)
            self._barrier.fault(status.run_number, error)

    def _publish(self, tick: int | None) -> None:
        """Grant ticks, show the one that has begun, and tell of a change of state."""
        # First: somebody may be waiting for it.
        self._grant()
        if tick is not None:
            self.heartbeat.at(tick)
            self._clock_publisher.publish(ClockMessage(clock=stamp(tick, self._dt_s)))
        self._tell()

    def _grant(self) -> None:
        """Publish how far the participants may go, when that is further than before."""
        granted = self._barrier.granted
        if granted <= self._granted:
            return
        self._granted = granted
        self._tick_publisher.publish(
            Tick(
                run_number=self._barrier.status.run_number,
                tick=granted,
                time_s=granted * self._dt_s,
            )
        )

    def _tell(self) -> None:
        """Publish the state when it has changed."""
        status = self._barrier.status
        if (status.phase, status.run_number) == self._published:
            return
        self._published = (status.phase, status.run_number)
        message = SyncStatus(
            run_number=status.run_number, state=_STATES[status.phase], tick=status.tick
        )
        if status.phase is Phase.RUNNING:
            self.heartbeat.busy(status.run_number)
        else:
            self.heartbeat.idle()
        if isinstance(status.error, AuroraError):
            message.failed_participant = status.error.component
            write_error(message, status.error)
            self.get_logger().error(message.error_msg)
        self._status_publisher.publish(message)


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(SyncNode)
