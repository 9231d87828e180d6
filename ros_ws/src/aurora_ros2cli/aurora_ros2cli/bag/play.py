# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag play`: publishes the recorded bytes as they are."""

from __future__ import annotations

import argparse
import math
import re
import time
from collections.abc import Iterator
from typing import Any

from rclpy.duration import Duration
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.qos import QoSProfile
from rosbags.rosbag2 import Reader
from rosgraph_msgs.msg import Clock

from aurora_ros2cli.bag.profiles import to_offer
from aurora_ros2cli.bag.reading import add_bag_arguments, opened
from aurora_ros2cli.bag.schedule import Schedule, schedule
from aurora_ros2cli.discovery import look_around
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import temporary_node
from aurora_ros2cli.types import load_type

NODE_NAME = 'rosbag2_player'
CLOCK_TOPIC = '/clock'
CLOCK_HZ = 40.0
_NS = 1_000_000_000
# Passes in full only where a subscriber has stopped listening.
_LAST_ACKED_S = 10.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_bag_arguments(parser)
    numbers = {
        ('-r', '--rate'): (1.0, 'Rate at which to play back messages. Valid range > 0.0.'),
        ('--start-offset',): (0.0, 'Start the playback this many seconds into the bag.'),
        ('-d', '--delay'): (0.0, 'Sleep duration before play (each loop), in seconds.'),
        ('--playback-duration',): (math.inf, 'Playback duration, in seconds of the bag.'),
        ('--wait-for-all-acked',): (None, 'Wait so many milliseconds for acknowledgements.'),
    }
    for names, (default, text) in numbers.items():
        parser.add_argument(*names, type=_number, default=default, help=text)
    parser.add_argument(
        '-l', '--loop', action='store_true', help='Start over at the end, until Ctrl-C.'
    )
    parser.add_argument(
        '--clock',
        type=_number,
        nargs='?',
        const=CLOCK_HZ,
        default=0.0,
        help='Publish to /clock at a specific frequency in Hz, to act as a ROS Time Source. '
        'Defaults to not publishing.',
    )
    parser.add_argument(
        '--topics', nargs='+', default=[], help='Topics to replay; by default all of them.'
    )
    parser.add_argument(
        '--exclude-topics', nargs='+', default=[], help='Topics not to be replayed.'
    )
    parser.add_argument(
        '-e', '--regex', default='', help='Play only topics matching the regular expression.'
    )
    parser.add_argument(
        '-x', '--exclude-regex', default='', help='Topics matching it are not played.'
    )
    parser.add_argument(
        '-m', '--remap', nargs='+', default=[], help='Topics to be remapped: "old:=new"'
    )
    parser.add_argument(
        '--disable-keyboard-controls', action='store_true', help='Accepted; there are none here'
    )
    parser.add_argument(
        '--read-ahead-queue-size', type=int, default=1000, help='Accepted without effect'
    )


def _number(text: str) -> float:
    value = float(text)
    if not 0.0 <= value < math.inf:
        raise argparse.ArgumentTypeError(f'{text} is not in the valid range (>= 0.0)')
    return value


def main(arguments: argparse.Namespace) -> int:
    """Play a bag once, or again and again.

    Raises:
        CliError: If the bag cannot be read, or an option does not fit it.
    """
    if arguments.rate <= 0:
        raise CliError('[ERROR] [ros2bag]: the rate must be greater than zero')
    with opened(arguments.bag_path) as reader, temporary_node(NODE_NAME) as node:
        node.get_logger().info(f'Set rate to {arguments.rate:g}')
        chosen = [
            connection
            for connection in reader.connections
            if is_chosen(connection.topic, arguments)
        ]
        publishers = _publishers(node, chosen, arguments.remap)
        chosen = [connection for connection in chosen if connection.id in publishers]
        clock = (
            node.create_publisher(Clock, CLOCK_TOPIC, QoSProfile(depth=10))
            if arguments.clock
            else None
        )
        # Subscribers that run already hear the first message too.
        look_around(node)
        while True:
            time.sleep(arguments.delay)
            for step in schedule(
                _messages(reader, chosen, arguments),
                plan(reader, arguments),
            ):
                if step.due_s > 0:
                    time.sleep(step.due_s)
                if step.message is not None:
                    connection_id, data = step.message
                    publishers[connection_id].publish(data)
                elif clock is not None:
                    clock.publish(_clock(step.time_ns))
            if not arguments.loop:
                break
        limit_s = (
            _LAST_ACKED_S
            if arguments.wait_for_all_acked is None
            else arguments.wait_for_all_acked / 1000
        )
        for publisher in publishers.values():
            publisher.wait_for_all_acked(Duration(seconds=limit_s))
    return 0


def is_chosen(topic: str, arguments: argparse.Namespace) -> bool:
    """Whether a topic is to be played."""
    if arguments.clock and topic == CLOCK_TOPIC:
        return False  # two clocks would contradict each other
    if topic in arguments.exclude_topics:
        return False
    if arguments.exclude_regex and re.search(arguments.exclude_regex, topic):
        return False
    if not arguments.topics and not arguments.regex:
        return True
    return topic in arguments.topics or bool(arguments.regex and re.search(arguments.regex, topic))


def plan(reader: Reader, arguments: argparse.Namespace) -> Schedule:
    """Return what part of a bag is played, and how fast."""
    start_ns = reader.start_time + int(arguments.start_offset * _NS)
    length_s = arguments.playback_duration
    return Schedule(
        start_ns=start_ns,
        end_ns=None if math.isinf(length_s) else start_ns + int(length_s * _NS),
        rate=arguments.rate,
        clock_hz=arguments.clock,
    )


def _messages(
    reader: Reader, chosen: list[Any], arguments: argparse.Namespace
) -> Iterator[tuple[int, tuple[int, bytes]]]:
    if not chosen:
        return
    start_ns = plan(reader, arguments).start_ns
    for connection, time_ns, data in reader.messages(chosen, start=start_ns):
        yield time_ns, (connection.id, bytes(data))


def _publishers(node: Node, chosen: list[Any], rules: list[str]) -> dict[int, Publisher]:
    names = dict(rule.partition(':=')[::2] for rule in rules)
    publishers = {}
    for connection in chosen:
        topic = names.get(connection.topic, connection.topic)
        try:
            message_type = load_type(connection.msgtype, 'msg')
        except CliError:
            node.get_logger().warning(
                f"Ignoring a topic '{topic}', reason: type '{connection.msgtype}' is not installed"
            )
            continue
        profile = to_offer(connection.ext.offered_qos_profiles)
        publishers[connection.id] = node.create_publisher(message_type, topic, profile)
    return publishers


def _clock(time_ns: int) -> Clock:
    message = Clock()
    message.clock.sec, message.clock.nanosec = divmod(time_ns, _NS)
    return message
