# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 node|topic|service|action list` and `ros2 lifecycle nodes`."""

from __future__ import annotations

import argparse
import sys

from rclpy.node import Node

from aurora_ros2cli.graph import add_look_arguments, settled_node
from aurora_ros2cli.kinds import KINDS, Found
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    command = parser.prog.split()[1]
    kind = KINDS[command]
    add_look_arguments(parser)
    parser.add_argument(
        '-a',
        '--all',
        kind.show_hidden,
        dest='hidden',
        action='store_true',
        help=f'Display all {kind.one}s even hidden ones',
    )
    parser.add_argument(
        '-c',
        '--count',
        f'--count-{kind.one}s',
        dest='count',
        action='store_true',
        help=f'Only display the number of {kind.one}s discovered',
    )
    if kind.typed:
        parser.add_argument(
            '-t',
            '--show-types',
            action='store_true',
            help=f'Additionally show the {kind.one} type',
        )
    if command == 'topic':
        parser.add_argument(
            '-v',
            '--verbose',
            action='store_true',
            help='List full details about each topic',
        )


def main(arguments: argparse.Namespace) -> int:
    """Print each name, with its types on request."""
    kind = KINDS[arguments.command]
    with settled_node(arguments) as node:
        shown = [
            (name, types)
            for name, types in kind.found(node)
            if arguments.hidden or not kind.hidden(name)
        ]
        if arguments.count:
            emit(str(len(shown)))
            return 0
        if getattr(arguments, 'verbose', False):
            _emit_with_counts(node, shown)
            return 0
    names = [name for name, _ in shown]
    if arguments.command == 'node' and len(set(names)) != len(names):
        sys.stderr.write(
            'WARNING: Be aware that there are nodes in the graph that share an exact name, '
            'which can have unintended side effects.\n'
        )
    for name, types in shown:
        typed = kind.typed and arguments.show_types
        emit(f'{name} [{", ".join(types)}]' if typed else name)
    return 0


def _emit_with_counts(node: Node, topics: Found) -> None:
    for title, noun, count in (
        ('Published topics:', 'publisher', node.count_publishers),
        ('Subscribed topics:', 'subscriber', node.count_subscribers),
    ):
        emit(title)
        for name, types in topics:
            number = count(name)
            if number:
                plural = 's' if number > 1 else ''
                emit(f' * {name} [{", ".join(types)}] {number} {noun}{plural}')
        emit('')
