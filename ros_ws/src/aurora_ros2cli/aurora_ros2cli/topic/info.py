# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic info`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import add_look_arguments, full_name, settled_node
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('topic_name', help="Name of the ROS topic to get info (e.g. '/chatter')")
    parser.add_argument(
        '-v',
        '--verbose',
        action='store_true',
        help='Prints detailed information like the node name, node namespace, topic type, '
        'GUID, and QoS Profile of the publishers and subscribers to this topic',
    )


def main(arguments: argparse.Namespace) -> int:
    """Print type and counts, and every end point on request.

    Raises:
        CliError: If nobody publishes or subscribes the topic.
    """
    with settled_node(arguments) as node:
        topic = full_name(node, arguments.topic_name)
        types = dict(node.get_topic_names_and_types()).get(topic)
        if not types:
            raise CliError(f"Unknown topic '{arguments.topic_name}'")
        gap = '\n' if arguments.verbose else ''
        emit(f'Type: {types[0] if len(types) == 1 else types}{gap}')
        for word, count, ends in (
            ('Publisher', node.count_publishers, node.get_publishers_info_by_topic),
            ('Subscription', node.count_subscribers, node.get_subscriptions_info_by_topic),
        ):
            emit(f'{word} count: {count(topic)}{gap}')
            for end in ends(topic) if arguments.verbose else ():
                emit(f'{end}\n')
    return 0
