# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic list` and `ros2 topic echo`."""

from __future__ import annotations

import argparse
import sys
from typing import Any

import rclpy
import yaml
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.fields import to_plain
from aurora_ros2cli.graph import is_hidden, settle, temporary_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.types import load_type
from aurora_ros2cli.verbs import add_verbs

DEPTH = 10
TRUNCATE_LENGTH = 128


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the verbs of the command."""
    verbs = add_verbs(parser)
    listing = verbs.add_parser('list', help='Output a list of available topics')
    listing.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the topic type'
    )
    listing.add_argument(
        '-c', '--count-topics', action='store_true', help='Only display the number of topics'
    )
    listing.add_argument(
        '-a', '--include-hidden-topics', action='store_true', help='Consider hidden topics as well'
    )
    listing.set_defaults(main=list_topics)
    echo = verbs.add_parser('echo', help='Output messages from a topic')
    echo.add_argument('topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')")
    echo.add_argument(
        'message_type', nargs='?', help="Type of the ROS message (e.g. 'std_msgs/msg/String')"
    )
    echo.add_argument(
        '--once', action='store_true', help='Print the first message received and then exit'
    )
    echo.add_argument(
        '-f', '--full-length', action='store_true', help='Output all elements of long fields'
    )
    echo.set_defaults(main=echo_topic)


def list_topics(arguments: argparse.Namespace) -> int:
    """Print each topic, with its types on request."""
    with temporary_node() as node:
        settle(lambda: sorted(map(str, node.get_topic_names_and_types())))
        found = sorted(node.get_topic_names_and_types())
    shown = [
        (name, types)
        for name, types in found
        if arguments.include_hidden_topics or not is_hidden(name)
    ]
    if arguments.count_topics:
        emit(str(len(shown)))
        return 0
    for name, types in shown:
        emit(f'{name} [{", ".join(types)}]' if arguments.show_types else name)
    return 0


def echo_topic(arguments: argparse.Namespace) -> int:
    """Print messages as YAML until Ctrl-C, or the first one only.

    Raises:
        CliError: If the type is unknown or ambiguous.
    """
    name = arguments.topic_name if arguments.topic_name[0] == '/' else f'/{arguments.topic_name}'
    longest = None if arguments.full_length else TRUNCATE_LENGTH
    with temporary_node('_echo') as node:
        settle(lambda: len(node.get_publishers_info_by_topic(name)))
        type_name = arguments.message_type or _only_type(node, name)
        message_type = load_type(type_name, 'msg', 'The passed message type is invalid')
        heard: list[Any] = []
        node.create_subscription(message_type, name, heard.append, _matching_qos(node, name))
        while True:
            rclpy.spin_once(node, timeout_sec=0.5)
            for message in heard:
                emit(as_yaml(message, longest) + '---')
                if arguments.once:
                    return 0
            heard.clear()


def as_yaml(message: Any, longest: int | None = TRUNCATE_LENGTH) -> str:
    """Render a message as ros2cli does: block style, fields in order."""
    return yaml.dump(
        to_plain(message, longest),
        sort_keys=False,
        allow_unicode=True,
        default_flow_style=False,
        width=sys.maxsize,
    )


def _only_type(node: Node, topic: str) -> str:
    types = dict(node.get_topic_names_and_types()).get(topic, [])
    if not types:
        raise CliError(
            f'WARNING: topic [{topic}] does not appear to be published yet\n'
            'Could not determine the type for the passed topic'
        )
    if len(types) > 1:
        raise CliError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return str(types[0])


def _matching_qos(node: Node, topic: str) -> QoSProfile:
    """Ask for no more than every publisher offers, so that all of them are heard."""
    offered = [info.qos_profile for info in node.get_publishers_info_by_topic(topic)]
    reliable = offered and all(qos.reliability == ReliabilityPolicy.RELIABLE for qos in offered)
    latched = offered and all(
        qos.durability == DurabilityPolicy.TRANSIENT_LOCAL for qos in offered
    )
    return QoSProfile(
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )
