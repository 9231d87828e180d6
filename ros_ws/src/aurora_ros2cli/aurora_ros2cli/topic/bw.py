# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic bw`."""

from __future__ import annotations

import argparse
import time

from aurora_ros2cli.graph import add_look_arguments, full_name, settled_node, spin_until
from aurora_ros2cli.output import emit
from aurora_ros2cli.qos import matching_profile
from aurora_ros2cli.topic.bandwidth import BandwidthMeter
from aurora_ros2cli.topic.hz import positive
from aurora_ros2cli.topic.subscribing import awaited_type
from aurora_ros2cli.types import load_type

WINDOW = 100
_REPORT_EACH_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('topic', help='Topic name to monitor for bandwidth utilization')
    parser.add_argument(
        '-w',
        '--window',
        type=positive,
        default=WINDOW,
        help='maximum window size, in # of messages, for calculating rate (default: %(default)s)',
    )


def main(arguments: argparse.Namespace) -> int:
    """Print bytes per second each second until Ctrl-C; waits for a topic that is not there yet."""
    with settled_node(arguments) as node:
        topic = full_name(node, arguments.topic)
        kind = load_type(awaited_type(node, topic), 'msg')
        meter = BandwidthMeter(arguments.window)

        def now_ns() -> int:
            if arguments.use_sim_time:
                return int(node.get_clock().now().nanoseconds)
            return time.monotonic_ns()

        node.create_subscription(
            kind,
            topic,
            lambda raw: meter.arrived(now_ns(), len(raw)),
            matching_profile(node, topic),
            raw=True,
        )
        emit(f'Subscribed to [{topic}]')
        said_s = time.monotonic()

        def show() -> bool:
            nonlocal said_s
            if time.monotonic() - said_s >= _REPORT_EACH_S:
                said_s = time.monotonic()
                text = meter.report(now_ns())
                if text is not None:
                    emit(text)
            return False

        spin_until(node, show)
    return 0
