# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 node info`."""

from __future__ import annotations

import argparse
import sys

from rclpy.action import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import (
    add_look_arguments,
    is_hidden,
    node_names,
    settled_node,
    split_node_name,
)
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('node_name', help='Fully qualified node name to request information')
    parser.add_argument(
        '--include-hidden',
        action='store_true',
        help='Display hidden topics, services, and actions as well',
    )


def main(arguments: argparse.Namespace) -> int:
    """Print what a node publishes, subscribes, serves and calls.

    Raises:
        CliError: If there is no such node.
    """
    name = arguments.node_name
    with settled_node(arguments) as node:
        count = node_names(node, hidden=True).count(name)
        if count == 0:
            raise CliError(f"Unable to find node '{name}'")
        if count > 1:
            sys.stderr.write(
                f'There are {count} nodes in the graph with the exact name "{name}". '
                'You are seeing information about only one of them.\n'
            )
        base, space = split_node_name(name)
        emit(name)
        for title, found in (
            ('Subscribers', node.get_subscriber_names_and_types_by_node(base, space)),
            ('Publishers', node.get_publisher_names_and_types_by_node(base, space)),
            ('Service Servers', node.get_service_names_and_types_by_node(base, space)),
            ('Service Clients', node.get_client_names_and_types_by_node(base, space)),
            ('Action Servers', get_action_server_names_and_types_by_node(node, base, space)),
            ('Action Clients', get_action_client_names_and_types_by_node(node, base, space)),
        ):
            emit(f'  {title}:')
            shown = [
                f'    {each}: {", ".join(types)}'
                for each, types in sorted(found)
                if arguments.include_hidden or not is_hidden(each)
            ]
            # An empty section is one empty line, as ros2cli prints it.
            emit('\n'.join(shown))
    return 0
