# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The `recorder` node: keeps the bytes of a run as they came off the wire."""

from __future__ import annotations

import re
import threading
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from rclpy.clock import Clock
from rclpy.clock_type import ClockType

from aurora_core.errors import AuroraError, BagError
from aurora_core.report.visible import visible
from aurora_core.trace.bag_writer import BagSummary, BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_msgs.msg import Ack, Fault
from aurora_msgs.srv import StartRecording, StopRecording
from aurora_nodes.intake import Intake
from aurora_nodes.recording import Recording
from aurora_ros import interfaces as on
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.main import run_node
from aurora_ros.matching import wait_until
from aurora_ros.node import AuroraNode
from aurora_ros.parameters import declare, require_positive

_OWNER = 'executor'  # of the run that is recorded
_BAG_NAME = re.compile(r'bag(\.[0-9]{1,4})?', re.ASCII)


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
        self._definitions = message_definitions()
        # Guards both: a recording may end in the node's thread or, when it fails, in the intake's.
        self._lock = threading.Lock()
        self._writer: BagWriter | None = None
        self._recording: Recording | None = None
        self._watch = HeartbeatWatch(self)
        self._began_s = 0.0
        self._ack_publisher = self.publisher(on.ACK)
        self._fault_publisher = self.publisher(on.FAULT)
        self._intake = Intake(
            self,
            poll_period_s=self._settings.poll_period_s,
            idle_period_s=self._settings.idle_period_s,
            ack_ticks=self._settings.ack_ticks,
            on_stored=self._acknowledge,
            on_failure=self._fail,
        )
        self.serve(on.RECORDER_START, self._start)
        self.serve(on.RECORDER_STOP, self._stop)
        self.create_timer(
            self._settings.idle_period_s,
            self._check_executor,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )

    def destroy_node(self) -> None:
        """Close an open bag, so that what is there can be read."""
        self._close()
        self._intake.close()
        super().destroy_node()

    def _start(
        self, request: StartRecording.Request, response: StartRecording.Response
    ) -> StartRecording.Response:
        self._refuse_while_recording()
        if self._close() is not None:
            self.get_logger().warning('an earlier recording was still open: closed')
        directory = _bag_directory(request.directory)
        self._await_matched(set(request.topics))
        writer = BagWriter(directory, self._definitions)
        recording = Recording(writer, run_id=request.run_id, run_number=request.run_number)
        with self._lock:
            self._writer, self._recording = writer, recording
        self._intake.begin(recording)
        self._watch.look()  # what was said until now counts as heard before
        self._began_s = time.monotonic()
        self.heartbeat.busy(request.run_number)
        response.ready = True
        return response

    def _refuse_while_recording(self) -> None:
        """Keep the recording of a run that its executor is at work on.

        Raises:
            BagError: There is one. One that was left open is no reason to refuse.
        """
        recording = self._recording
        if recording is None or self._watch.is_dead(_OWNER):
            return
        # What it said before this recording began says nothing about this run.
        left = (
            self._watch.heard_since(_OWNER, self._began_s)
            and self._watch.run_number(_OWNER) != recording.run_number
        )
        if self._watch.was_heard(_OWNER) and not left:
            raise BagError(
                f'run {recording.run_number} is being recorded: no other recording begins',
                hint=f'only {_OWNER} calls {on.RECORDER_START.name}, once in a run',
            )

    def _stop(
        self, request: StopRecording.Request, response: StopRecording.Response
    ) -> StopRecording.Response:
        recording = self._recording
        if recording is None or recording.run_number != request.run_number:
            raise BagError(f'no recording of run {request.run_number} is open')
        expected = dict(zip(request.expected_topics, request.expected_counts, strict=True))
        try:
            self._await_stored(recording, expected)
            self._intake.end()
        finally:
            summary = self._close()
        if summary is None:
            raise BagError(
                f'the recording of run {request.run_number} failed', hint='see the log of recorder'
            )
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
        if not wait_until(
            lambda: not self._intake.unmatched(wanted), self._settings.match_limit_s
        ):
            raise BagError(
                f'nobody publishes {", ".join(self._intake.unmatched(wanted))} (waited '
                f'{self._settings.match_limit_s:g} s)',
                hint='is every node of the graph running in this ROS_DOMAIN_ID?',
            )

    def _await_stored(self, recording: Recording, expected: Mapping[str, int]) -> None:
        """Wait until everything expected is stored.

        Raises:
            BagError: Something is missing after the limit, or more came than was sent.
        """

        def complete() -> bool:
            self._intake.look()
            return not recording.missing(expected)

        if not wait_until(complete, self._settings.stop_limit_s):
            raise BagError(
                f'messages are missing in the bag: {recording.missing(expected)} (waited '
                f'{self._settings.stop_limit_s:g} s)'
            )
        if recording.excess(expected):
            raise BagError(f'unexpected messages in the bag: {recording.excess(expected)}')

    def _check_executor(self) -> None:
        if self._recording is not None and self._watch.is_dead(_OWNER):
            self.get_logger().error('the executor died: its recording is closed')
            self._close()

    def _acknowledge(self, recording: Recording, tick: int) -> None:
        self.heartbeat.at(tick)
        self._ack_publisher.publish(
            Ack(run_number=recording.run_number, observer=self.get_name(), tick=tick)
        )

    def _fail(self, recording: Recording, error: AuroraError) -> None:
        """Keep what is stored and tell sync, which ends the run."""
        self.get_logger().error(str(error))
        try:
            self._close()
        except AuroraError as err:
            self.get_logger().error(str(err))
        message = Fault(run_number=recording.run_number, node=self.get_name())
        write_error(message, error)
        self._fault_publisher.publish(message)

    def _close(self) -> BagSummary | None:
        """Close an open bag, if there is one that can still be closed."""
        self._intake.drop()
        with self._lock:
            writer, self._writer, self._recording = self._writer, None, None
        self.heartbeat.idle()
        if writer is None or writer.closed:  # after a full disk it has given up by itself
            return None
        return writer.close()


def _bag_directory(named: str) -> Path:
    """Return the folder of a bag: whoever is in the domain can call, so no other is made.

    Raises:
        BagError: It is none of a run.
    """
    path = Path(named)
    if not path.is_absolute() or '..' in path.parts or not _BAG_NAME.fullmatch(path.name):
        raise BagError(
            f'expected an absolute path that ends in bag.<number>, found {visible(named)!r}',
            hint=f'only {_OWNER} calls {on.RECORDER_START.name}, once in a run',
        )
    return path


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(RecorderNode, background=True)
