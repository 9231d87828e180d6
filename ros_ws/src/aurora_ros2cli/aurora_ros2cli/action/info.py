# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 action info`."""

from __future__ import annotations

import argparse
from collections.abc import Callable

from rclpy.action import (
    get_action_client_names_and_types_by_node,
    get_action_server_names_and_types_by_node,
)
from rclpy.node import Node

from aurora_ros2cli.graph import (
    add_look_arguments,
    full_name,
    node_names,
    settled_node,
    split_node_name,
)
from aurora_ros2cli.output import emit

ByNode = Callable[[Node, str, str], list[tuple[str, list[str]]]]


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('action_name', help="Name of the ROS action (e.g. '/fibonacci')")
    parser.add_argument(
        '-t', '--show-types', action='store_true', help='Additionally show the action type'
    )
    parser.add_argument(
        '-c',
        '--count',
        action='store_true',
        help='Only display the number of action clients and action servers',
    )


def main(arguments: argparse.Namespace) -> int:
    """Print the nodes that use or serve an action."""
    with settled_node(arguments) as node:
        action = full_name(node, arguments.action_name)
        ends = {
            'clients': _nodes_with(node, action, get_action_client_names_and_types_by_node),
            'servers': _nodes_with(node, action, get_action_server_names_and_types_by_node),
        }
    emit(f'Action: {arguments.action_name}')
    for word, found in ends.items():
        emit(f'Action {word}: {len(found)}')
        for name, types in () if arguments.count else found:
            shown = f' [{", ".join(types)}]' if arguments.show_types else ''
            emit(f'    {name}{shown}')
    return 0


def _nodes_with(node: Node, action: str, by_node: ByNode) -> list[tuple[str, list[str]]]:
    return [
        (name, types)
        for name in node_names(node, hidden=True)
        for found, types in by_node(node, *split_node_name(name))
        if found == action
    ]
