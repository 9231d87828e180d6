# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process that is no part of the graph and serves one of its calls: it answers at once."""

from __future__ import annotations

import argparse
import signal
import sys
import threading

import rclpy
from rclpy.action.server import ActionServer
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions

from aurora_msgs.msg import TickDone
from aurora_ros import interfaces as on

CALLS = {
    call.name: call
    for call in (on.RUN, on.PARSE, on.GROUND_SCENARIO, on.EXECUTE, on.VERIFY, on.RECORDER_STOP)
}
NAME = 'helper'
# Of the run in which one that comes late begins to serve.
TICK = 100
_LOOK_S = 0.1


class SecondServer(Node):
    """Serves one call under another node's name.

    Args:
        name: Key of `CALLS`.
        late: Begin when a run is at `TICK`; else at once.
    """

    def __init__(self, name: str, *, late: bool) -> None:
        super().__init__(NAME)
        self._call = CALLS[name]
        self._serves = False
        self._server: ActionServer | None = None
        if late:
            topic = on.TICK_DONE
            self.create_subscription(topic.type, topic.full_name, self._on_tick, topic.qos)
        else:
            self._serve()

    def _on_tick(self, message: TickDone) -> None:
        if message.tick >= TICK and not self._serves:
            self._serve()

    def _serve(self) -> None:
        self._serves = True
        full_name = f'/{on.NAMESPACE}/{self._call.name}'
        kind = self._call.type
        if self._call.is_action:
            self._server = ActionServer(self, kind, full_name, lambda _goal: kind.Result())
        else:
            self.create_service(kind, full_name, lambda _asked, answer: answer)


def main(arguments: list[str] | None = None) -> int:
    """Serve until ended."""
    parser = argparse.ArgumentParser(prog='second_server', description=__doc__)
    parser.add_argument('call', choices=CALLS)
    parser.add_argument('--late', action='store_true', help='come while a run goes on')
    options = parser.parse_args(sys.argv[1:] if arguments is None else arguments)
    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda _signal, _frame: ended.set())
    # Signals stay with us: whoever goes properly leaves no lease behind.
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = SecondServer(options.call, late=options.late)
    sys.stdout.write('ready\n')
    sys.stdout.flush()
    while not ended.is_set():
        rclpy.spin_once(node, timeout_sec=_LOOK_S)
    node.destroy_node()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
