# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic hz`."""

from __future__ import annotations

import argparse
import time
from typing import Any

from aurora_ros2cli.graph import add_look_arguments, full_name, settled_node, spin_until
from aurora_ros2cli.output import emit
from aurora_ros2cli.qos import matching_profile, named_profile
from aurora_ros2cli.topic.rate import RateMeter
from aurora_ros2cli.topic.subscribing import (
    PRESET,
    add_topic_arguments,
    awaited_type,
    message_filter,
)
from aurora_ros2cli.types import load_type

WINDOW = 10_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    add_topic_arguments(parser)
    parser.add_argument(
        '-w',
        '--window',
        type=positive,
        default=WINDOW,
        help='window size, in # of messages, for calculating rate (default: %(default)s)',
    )
    parser.add_argument(
        '--wall-time',
        action='store_true',
        help='calculates rate using wall time also with --use-sim-time',
    )


def positive(text: str) -> int:
    """Read a positive integer for argparse."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError('value must be a positive integer')
    return int(text)


def main(arguments: argparse.Namespace) -> int:
    """Print the rate each second until Ctrl-C; waits for a topic that is not there yet."""
    passes = message_filter(arguments.filter_expr)
    simulated = arguments.use_sim_time and not arguments.wall_time
    with settled_node(arguments) as node:
        topic = full_name(node, arguments.topic_name)
        type_name = awaited_type(node, topic)
        meter = RateMeter(arguments.window)

        def hear(message: Any) -> None:
            if passes is None or passes(message):
                now_ns = node.get_clock().now().nanoseconds if simulated else time.monotonic_ns()
                meter.arrived(now_ns)

        node.create_subscription(
            load_type(type_name, 'msg'),
            topic,
            hear,
            named_profile(arguments, PRESET) or matching_profile(node, topic),
            raw=passes is None,
        )

        def show() -> bool:
            text = meter.report()
            if text is not None:
                emit(text)
            return False

        spin_until(node, show)
    return 0
