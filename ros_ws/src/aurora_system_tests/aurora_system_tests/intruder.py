# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process that is no part of the graph and writes into a run that is going on.

It hears the run and publishes for the coming tick what is a few metres off, before the node that
should, or what is of no run.
"""

from __future__ import annotations

import argparse
import signal
import sys
import threading
from typing import Any

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.signals import SignalHandlerOptions
from rosgraph_msgs.msg import Clock

from aurora_ros import interfaces as on

_NUMBERED = {'command': on.UAV_COMMAND, 'state': on.GROUND_STATE}
_OTHERS = {
    topic.name.replace('/', '_'): topic
    for topic in on.RUN_TOPICS
    if topic is not on.CLOCK and topic not in _NUMBERED.values()
}
TOPICS = {**_NUMBERED, 'clock': on.CLOCK, **_OTHERS}
NAME = 'intruder'
# Of the run in which it writes.
TICK = 200
_FIRST_NUMBER = {'command': 1, 'state': 0}
_LOOK_S = 0.1
_OFF_M = 3.0
_OFF_NS = 7  # of the clock: no tick of any run


class Intruder(Node):
    """Writes for the coming tick whenever it hears one.

    Args:
        kind: Key of `TOPICS`.
        early: Have the publisher from the beginning; else from the tick `TICK` of a run on.
        passing: Go again after the first message.
    """

    def __init__(self, kind: str, *, early: bool, passing: bool) -> None:
        super().__init__(NAME)
        self._topic = TOPICS[kind]
        self._kind = kind
        self._passing = passing
        self._publisher = self._create() if early else None
        self.done = False
        heard = self._topic if kind in _NUMBERED else on.GROUND_STATE
        self.create_subscription(heard.type, heard.full_name, self._on_message, heard.qos)

    def _create(self) -> Publisher:
        return self.create_publisher(self._topic.type, self._topic.full_name, self._topic.qos)

    def _on_message(self, message: Any) -> None:
        if message.tick < TICK or self.done:
            return
        if self._publisher is None:
            self._publisher = self._create()
        if not self._is_heard(self._publisher):
            return
        self._publisher.publish(self._forged(message))
        if self._passing:
            self._publisher.wait_for_all_acked(Duration(seconds=1))
            self.destroy_publisher(self._publisher)
            self.done = True

    def _is_heard(self, publisher: Publisher) -> bool:
        """Return whether everybody hears it who listens to the topic."""
        listeners = len(self.get_subscriptions_info_by_topic(publisher.topic_name))
        matched: int = publisher.get_subscription_count()
        return matched >= max(1, listeners)

    def _forged(self, message: Any) -> Any:
        if self._kind in _NUMBERED:
            message.tick += 1
            message.data[_FIRST_NUMBER[self._kind]] += _OFF_M
            return message
        if self._kind == 'clock':
            forged = Clock()
            forged.clock.sec, forged.clock.nanosec = int(message.tick), _OFF_NS
            return forged
        return self._topic.type()


def main(arguments: list[str] | None = None) -> int:
    """Write until ended."""
    parser = argparse.ArgumentParser(prog='intruder', description=__doc__)
    parser.add_argument('kind', choices=TOPICS)
    parser.add_argument('--early', action='store_true', help='be there before the run')
    parser.add_argument('--passing', action='store_true', help='come, write, and go again')
    options = parser.parse_args(sys.argv[1:] if arguments is None else arguments)
    ended = threading.Event()
    signal.signal(signal.SIGTERM, lambda _signal, _frame: ended.set())
    # Signals stay with us: whoever goes properly leaves no lease behind.
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = Intruder(options.kind, early=options.early, passing=options.passing)
    sys.stdout.write('ready\n')
    sys.stdout.flush()
    while not (node.done or ended.is_set()):
        rclpy.spin_once(node, timeout_sec=_LOOK_S)
    node.destroy_node()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
