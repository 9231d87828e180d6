# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A process that is no part of the graph and writes into a run that is going on.

It hears the commands or states of the run and publishes one for the coming tick that is a few
metres off, before the node that should.
"""

from __future__ import annotations

import argparse
import sys

import rclpy
from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rosgraph_msgs.msg import Clock

from aurora_msgs.msg import GroundState, UavCommand
from aurora_ros import interfaces as on

TOPICS = {'command': on.UAV_COMMAND, 'state': on.GROUND_STATE, 'clock': on.CLOCK}
NAME = 'intruder'
# Of the run in which it writes.
TICK = 200
_FIRST_NUMBER = {'command': 1, 'state': 0}
_OFF_M = 3.0
_DT_S = 0.05
# Recorder, monitor, who acts on it, and itself; of the clock the first and the last.
_LISTENERS = {'command': 4, 'state': 4, 'clock': 2}


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
        self.create_subscription(
            self._topic.type, self._topic.full_name, self._on_message, self._topic.qos
        )

    def _create(self) -> Publisher:
        return self.create_publisher(self._topic.type, self._topic.full_name, self._topic.qos)

    def _on_message(self, message: UavCommand | GroundState | Clock) -> None:
        if _tick_of(message) < TICK or self.done:
            return
        if self._publisher is None:
            self._publisher = self._create()
        if self._publisher.get_subscription_count() < _LISTENERS[self._kind]:
            return
        if isinstance(message, Clock):
            message.clock.sec += 1
        else:
            message.tick += 1
            message.data[_FIRST_NUMBER[self._kind]] += _OFF_M
        self._publisher.publish(message)
        if self._passing:
            self._publisher.wait_for_all_acked(Duration(seconds=1))
            self.destroy_publisher(self._publisher)
            self.done = True


def _tick_of(message: UavCommand | GroundState | Clock) -> int:
    if isinstance(message, Clock):
        time_s: float = message.clock.sec + 1e-9 * message.clock.nanosec
        return round(time_s / _DT_S)
    return int(message.tick)


def main(arguments: list[str] | None = None) -> int:
    """Write until ended."""
    parser = argparse.ArgumentParser(prog='intruder', description=__doc__)
    parser.add_argument('kind', choices=TOPICS)
    parser.add_argument('--early', action='store_true', help='be there before the run')
    parser.add_argument('--passing', action='store_true', help='come, write, and go again')
    options = parser.parse_args(sys.argv[1:] if arguments is None else arguments)
    rclpy.init()
    node = Intruder(options.kind, early=options.early, passing=options.passing)
    sys.stdout.write('ready\n')
    sys.stdout.flush()
    while not node.done:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
