# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 node list`."""

from __future__ import annotations

import argparse
import sys

from aurora_ros2cli.graph import is_hidden, settle, temporary_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.verbs import add_verbs


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the verbs of the command."""
    listing = add_verbs(parser).add_parser('list', help='Output a list of available nodes')
    listing.add_argument(
        '-a', '--all', action='store_true', help='Display all nodes even hidden ones'
    )
    listing.add_argument(
        '-c', '--count-nodes', action='store_true', help='Only display the number of nodes'
    )
    listing.set_defaults(main=list_nodes)


def list_nodes(arguments: argparse.Namespace) -> int:
    """Print the full name of each node."""
    with temporary_node() as node:
        settle(lambda: sorted(node.get_node_names_and_namespaces()))
        pairs = node.get_node_names_and_namespaces()
    names = sorted(
        f'{space.rstrip("/")}/{name}'
        for name, space in pairs
        if arguments.all or not is_hidden(name)
    )
    if arguments.count_nodes:
        emit(str(len(names)))
        return 0
    if len(set(names)) != len(names):
        sys.stderr.write(
            'WARNING: Be aware that there are nodes in the graph that share an exact name, '
            'which can have unintended side effects.\n'
        )
    for name in names:
        emit(name)
    return 0
