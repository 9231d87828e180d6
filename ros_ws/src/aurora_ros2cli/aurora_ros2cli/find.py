# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 topic|service|action find TYPE`."""

from __future__ import annotations

import argparse

from aurora_ros2cli.graph import add_look_arguments, settled_node
from aurora_ros2cli.kinds import KINDS
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    kind = KINDS[parser.prog.split()[1]]
    add_look_arguments(parser)
    parser.add_argument(
        'type',
        metavar=f'{kind.one}_type',
        help=f'Name of the ROS {kind.one} type to filter for',
    )
    parser.add_argument(
        '-c',
        '--count',
        f'--count-{kind.one}s',
        dest='count',
        action='store_true',
        help=f'Only display the number of {kind.one}s discovered',
    )
    parser.add_argument(
        kind.show_hidden,
        dest='hidden',
        action='store_true',
        help=f'Consider hidden {kind.one}s as well',
    )


def main(arguments: argparse.Namespace) -> int:
    """Print each name that has a type."""
    kind = KINDS[arguments.command]
    with settled_node(arguments) as node:
        names = [
            name
            for name, types in kind.found(node)
            if arguments.type in types and (arguments.hidden or not kind.hidden(name))
        ]
    if arguments.count:
        emit(str(len(names)))
        return 0
    for name in names:
        emit(name)
    return 0
