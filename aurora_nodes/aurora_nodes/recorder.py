# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `recorder` node: keeps the bytes of a run as they came off the wire.

Subscriptions live as long as the node and are drained in batches: waking the executor for each
message would cost more than storing it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from aurora_core.errors import AuroraError, BagError
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_msgs.msg import Ack, Fault
from aurora_msgs.srv import StartRecording, StopRecording
from aurora_nodes.recording import Belonging, RecordedTopic, Recording
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.interfaces import Topic
from aurora_ros.main import run_node
from aurora_ros.matching import wait_until
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare, require_positive
from aurora_ros.polling import PolledGroup, drain

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


@dataclass(frozen=True, kw_only=True)
class RecorderSettings:
    """See `config/recorder.param.yaml`."""

    poll_period_s: float
    idle_period_s: float
    ack_ticks: int
    match_limit_s: float
    stop_limit_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'poll_period_s', 'idle_period_s', 'ack_ticks')
        require_positive(self, 'match_limit_s', 'stop_limit_s')


class RecorderNode(AuroraNode):
    """One bag at a time."""

    def __init__(self) -> None:
        super().__init__('recorder')
        self._settings = declare(self, 'recorder', RecorderSettings)
        self._writer: BagWriter | None = None
        self._recording: Recording | None = None
        self._acked = -1
        self._definitions = message_definitions()
        group = PolledGroup()
        self._taps = {
            RecordedTopic(
                name=topic.full_name,
                type_name=topic.type_name,
                belonging=belonging,
                first_tick=first_tick,
            ): self.subscription(topic, lambda _cdr: None, raw=True, group=group)
            for topic, belonging, first_tick in _TOPICS
        }
        self._watch = HeartbeatWatch(self)
        self._ack_publisher = self.publisher(on.ACK)
        self._fault_publisher = self.publisher(on.FAULT)
        self.serve(on.RECORDER_START, self._start)
        self.serve(on.RECORDER_STOP, self._stop)
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        self.create_timer(self._settings.idle_period_s, self._on_idle, clock=steady)
        self._poll = self.create_timer(self._settings.poll_period_s, self._on_poll, clock=steady)
        self._poll.cancel()

    def destroy_node(self) -> None:
        """Close an open bag, so that what is there can be read."""
        self._close()
        super().destroy_node()

    def _start(
        self, request: StartRecording.Request, response: StartRecording.Response
    ) -> StartRecording.Response:
        if self._close():
            self.get_logger().warning('an earlier recording was still open: closed')
        self._drain()
        self._await_matched(set(request.topics))
        self._writer = BagWriter(Path(request.directory), self._definitions)
        self._recording = Recording(
            self._writer, run_id=request.run_id, run_number=request.run_number
        )
        self._acked = -1
        self._poll.reset()
        self.heartbeat.busy(request.run_number)
        response.ready = True
        return response

    def _stop(
        self, request: StopRecording.Request, response: StopRecording.Response
    ) -> StopRecording.Response:
        recording, writer = self._recording, self._writer
        if recording is None or writer is None or recording.run_number != request.run_number:
            raise BagError(f'no recording of run {request.run_number} is open')
        expected = dict(zip(request.expected_topics, request.expected_counts, strict=True))
        try:
            self._await_stored(recording, expected)
        finally:
            self._recording = self._writer = None
            self._poll.cancel()
            self.heartbeat.idle()
            summary = writer.close()
        response.bag_uri = str(summary.path)
        response.topics = list(summary.counts)
        response.counts = list(summary.counts.values())
        response.sha256 = summary.sha256
        return response

    def _await_matched(self, wanted: set[str]) -> None:
        """Wait until each wanted subscription has a publisher.

        Raises:
            BagError: A topic has none within the limit, or is not recorded at all.
        """
        unknown = wanted - {topic.name for topic in self._taps}
        if unknown:
            raise BagError(f'expected topics that are recorded, found {sorted(unknown)}')

        def unmatched() -> list[str]:
            return [
                topic.name
                for topic, tap in self._taps.items()
                if topic.name in wanted and tap.get_publisher_count() == 0
            ]

        if not wait_until(lambda: not unmatched(), self._settings.match_limit_s):
            raise BagError(
                f'nobody publishes {", ".join(unmatched())} (waited '
                f'{self._settings.match_limit_s:g} s)',
                hint='is every node of the graph running in this ROS_DOMAIN_ID?',
            )

    def _await_stored(self, recording: Recording, expected: Mapping[str, int]) -> None:
        """Drain until everything expected is stored.

        Raises:
            BagError: Something is missing after the limit, or more came than was sent.
        """

        def complete() -> bool:
            self._drain()
            return not recording.missing(expected)

        if not wait_until(complete, self._settings.stop_limit_s):
            raise BagError(
                f'messages are missing in the bag: {recording.missing(expected)} (waited '
                f'{self._settings.stop_limit_s:g} s)'
            )
        if recording.excess(expected):
            raise BagError(f'unexpected messages in the bag: {recording.excess(expected)}')

    def _on_idle(self) -> None:
        if self._recording is None:
            self._drain()
        elif self._watch.is_dead('executor'):
            self.get_logger().error('the executor died: its recording is closed')
            self._close()

    def _on_poll(self) -> None:
        recording = self._recording
        if recording is None:
            return
        try:
            self._drain()
            if recording.stored_tick >= self._acked + self._settings.ack_ticks:
                recording.flush()
                self._acknowledge(recording)
        except (AuroraError, OSError) as err:
            self._fail(recording, err)

    def _drain(self) -> None:
        """Take what has arrived; without a recording it is dropped."""
        for topic, tap in self._taps.items():
            for cdr in drain(tap):
                if self._recording is not None:
                    self._recording.store(topic, cdr)

    def _acknowledge(self, recording: Recording) -> None:
        self._acked = recording.stored_tick
        self.heartbeat.at(self._acked)
        self._ack_publisher.publish(
            Ack(run_number=recording.run_number, observer='recorder', tick=self._acked)
        )

    def _fail(self, recording: Recording, err: AuroraError | OSError) -> None:
        """Tell sync, which ends the run; keep what is stored."""
        error = err if isinstance(err, AuroraError) else BagError(f'cannot write the bag: {err}')
        self.get_logger().error(str(error))
        message = Fault(run_number=recording.run_number, node=self.get_name())
        write_error(message, error)
        self._fault_publisher.publish(message)
        self._close()

    def _close(self) -> bool:
        """Close an open bag; return whether there was one."""
        writer, self._writer, self._recording = self._writer, None, None
        self._poll.cancel()
        self.heartbeat.idle()
        if writer is None:
            return False
        if not writer.closed:  # after a full disk it has given up by itself
            writer.close()
        return True


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(RecorderNode)
