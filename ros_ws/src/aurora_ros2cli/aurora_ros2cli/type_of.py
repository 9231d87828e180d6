# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic|service|action type NAME`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.graph import add_look_arguments, settled_node
from aurora_ros2cli.kinds import KINDS
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    one = KINDS[parser.prog.split()[1]].one
    parser.add_argument('name', metavar=f'{one}_name', help=f'Name of the ROS {one} to get type')


def main(arguments: argparse.Namespace) -> int:
    """Print the types of a name, one a line; without any the exit code is 1, as in ros2cli."""
    kind = KINDS[arguments.command]
    wanted = arguments.name
    with settled_node(
        arguments, lambda node: any(name == wanted for name, _ in kind.found(node))
    ) as node:
        types = dict(kind.found(node)).get(wanted, [])
    for name in types:
        emit(name)
    return 0 if types else 1
