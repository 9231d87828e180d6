# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A node in the recorder's place that stores nothing: what does recording cost?

It answers `recorder/start` and `recorder/stop` and grants the clock all its credit at once. Its
subscriptions are there while the nodes look for their listeners and gone while ticks flow, so that
not even the delivery of the messages is paid for. The executor finds no bag afterwards, and ends
the run with an error that the benchmark expects.
"""

from __future__ import annotations

import sys

from aurora_msgs.msg import Ack, SyncStatus
from aurora_msgs.srv import StartRecording, StopRecording
from aurora_ros import interfaces as on
from aurora_ros.main import run_node
from aurora_ros.node import AuroraNode

_HEARD = (
    on.AGSG,
    on.ROSTER,
    on.WORLD,
    on.GROUND_STATE,
    on.UAV_STATE,
    on.GROUND_COMMAND,
    on.UAV_COMMAND,
    on.COMM,
    on.SENSING,
    on.EVENTS,
)
_LAST_TICK = 2**31


class NullRecorder(AuroraNode):
    """Stores nothing."""

    def __init__(self) -> None:
        super().__init__('recorder')
        self._ack_publisher = self.publisher(on.ACK)
        self.subscription(on.SYNC_STATUS, self._on_sync_status)
        self.serve(on.RECORDER_START, self._start)
        self.serve(on.RECORDER_STOP, self._stop)
        self._listen()

    def _listen(self) -> None:
        self._taps = [self.subscription(topic, lambda _cdr: None, raw=True) for topic in _HEARD]

    def _start(
        self, _request: StartRecording.Request, response: StartRecording.Response
    ) -> StartRecording.Response:
        for tap in self._taps:
            self.destroy_subscription(tap)
        self._taps.clear()
        response.ready = True
        return response

    def _stop(
        self, _request: StopRecording.Request, response: StopRecording.Response
    ) -> StopRecording.Response:
        if not self._taps:
            self._listen()
        response.bag_uri = '/nonexistent'
        return response

    def _on_sync_status(self, message: SyncStatus) -> None:
        if message.state == SyncStatus.RUNNING:
            self._ack_publisher.publish(
                Ack(run_number=message.run_number, observer='recorder', tick=_LAST_TICK)
            )


def main() -> int:
    """Run the node until it is told to end."""
    return run_node(NullRecorder)


if __name__ == '__main__':
    sys.exit(main())
