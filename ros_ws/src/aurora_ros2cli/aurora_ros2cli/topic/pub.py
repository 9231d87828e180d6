# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic pub`."""

from __future__ import annotations

import argparse
import sys
import time

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.fields import FieldError, read_fields
from aurora_ros2cli.graph import add_look_arguments, full_name, spin_until, temporary_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.qos import add_qos_arguments, profile_or_preset
from aurora_ros2cli.types import load_type

PRESET = 'default'
_WAITING_EACH_S = 1.0
_ACKED_LIMIT_S = 1.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('topic_name', help="Name of the ROS topic to publish to (e.g. '/chatter')")
    parser.add_argument(
        'message_type', help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
    )
    values = parser.add_mutually_exclusive_group()
    values.add_argument(
        'values', nargs='?', default='{}', help='Values to fill the message with in YAML format'
    )
    values.add_argument('--stdin', action='store_true', help='Read values from standard input')
    parser.add_argument(
        '-r', '--rate', metavar='N', type=_positive, default=1.0, help='Publishing rate in Hz'
    )
    parser.add_argument(
        '-p',
        '--print',
        metavar='N',
        dest='print_nth',
        type=int,
        default=1,
        help='Only print every N-th published message (default: 1)',
    )
    count = parser.add_mutually_exclusive_group()
    count.add_argument('-1', '--once', action='store_true', help='Publish one message and exit')
    count.add_argument(
        '-t', '--times', type=int, default=0, help='Publish this number of times and then exit'
    )
    parser.add_argument(
        '-w',
        '--wait-matching-subscriptions',
        type=int,
        metavar='N',
        help='Wait until finding the specified number of matching subscriptions. Defaults to 1 '
        'when using "-1"/"--once"/"--times", otherwise defaults to 0.',
    )
    parser.add_argument(
        '--max-wait-time-secs',
        type=float,
        metavar='S',
        help='Give up after so many seconds of waiting for subscriptions (default: never)',
    )
    parser.add_argument(
        '--keep-alive',
        metavar='N',
        type=float,
        default=0.1,
        help='Keep publishing node alive for N seconds after the last msg (default: 0.1)',
    )
    parser.add_argument('-n', '--node-name', help='Name of the created publishing node')
    add_qos_arguments(parser, 'publish', PRESET)


def _positive(text: str) -> float:
    value = float(text)
    if not 0.0 < value < float('inf'):
        raise argparse.ArgumentTypeError('value must be positive')
    return value


def main(arguments: argparse.Namespace) -> int:
    """Publish a message, again and again unless limited.

    Raises:
        CliError: If the type is unknown, the values do not fit it, or no subscription came.
    """
    message = load_type(arguments.message_type, 'msg')()
    text = sys.stdin.read() if arguments.stdin else arguments.values
    try:
        stamps = read_fields(message, text)
    except FieldError as err:
        raise CliError(f'Failed to populate field: {err}') from err
    times = 1 if arguments.once else arguments.times
    with temporary_node(arguments.node_name, use_sim_time=arguments.use_sim_time) as node:
        publisher = node.create_publisher(
            type(message),
            full_name(node, arguments.topic_name),
            profile_or_preset(arguments, PRESET),
        )
        wanted = arguments.wait_matching_subscriptions
        _wait(
            node,
            publisher,
            (1 if times else 0) if wanted is None else wanted,
            arguments.max_wait_time_secs,
        )
        emit('publisher: beginning loop')
        count = 0
        due_s = time.monotonic()
        while times == 0 or count < times:
            count += 1
            for stamp in stamps:
                stamp(node.get_clock().now().to_msg())
            if arguments.print_nth and count % arguments.print_nth == 0:
                emit(f'publishing #{count}: {message!r}\n')
            publisher.publish(message)
            due_s += 1.0 / arguments.rate
            if count != times:
                spin_until(node, lambda until_s=due_s: time.monotonic() >= until_s)  # type: ignore[misc]
        publisher.wait_for_all_acked(Duration(seconds=_ACKED_LIMIT_S))
        time.sleep(max(0.0, arguments.keep_alive))
    return 0


def _wait(node: Node, publisher: Publisher, wanted: int, limit_s: float | None) -> None:
    end_s = None if limit_s is None else time.monotonic() + limit_s
    while publisher.get_subscription_count() < wanted:
        if end_s is not None and time.monotonic() >= end_s:
            raise CliError(
                f'Timed out waiting for subscribers: Expected {wanted} subscribers but only got '
                f'{publisher.get_subscription_count()} subscribers'
            )
        enough = spin_until(
            node, lambda: publisher.get_subscription_count() >= wanted, _WAITING_EACH_S
        )
        if not enough:
            emit(f'Waiting for at least {wanted} matching subscription(s)...')
