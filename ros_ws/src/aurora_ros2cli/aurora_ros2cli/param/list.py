# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 param list`."""

from __future__ import annotations

import argparse
import sys

from rclpy.node import Node

from aurora_ros2cli.calling import absolute, add_node_arguments
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import node_names, settled_node
from aurora_ros2cli.output import emit
from aurora_ros2cli.param.services import (
    LIST,
    TYPE_WORDS,
    describe_parameters,
    list_parameters,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser, optional=True)
    parser.add_argument(
        '--param-prefixes',
        nargs='+',
        default=[],
        help='Only list parameters with the provided prefixes',
    )
    parser.add_argument(
        '--param-type', action='store_true', help='Print parameter types with parameter names'
    )


def main(arguments: argparse.Namespace) -> int:
    """Print the parameters of one node, or of all nodes below their names.

    Raises:
        CliError: If the node is not there.
    """
    with settled_node(arguments) as node:
        served = {name for name, _ in node.get_service_names_and_types()}
        names = node_names(node, hidden=arguments.hidden)
        if arguments.node_name:
            wanted = absolute(arguments.node_name)
            if wanted not in names:
                raise CliError('Node not found')
            names = [wanted]
        for name in dict.fromkeys(names):
            if name + LIST not in served:
                continue
            try:
                lines = _lines(node, name, arguments)
            except CliError as err:
                if arguments.node_name:
                    raise
                sys.stderr.write(f'{err}\n')
                continue
            if not arguments.node_name:
                emit(f'{name}:')
            for line in lines:
                emit(f'  {line}')
    return 0


def _lines(node: Node, other: str, arguments: argparse.Namespace) -> list[str]:
    names = list_parameters(node, other, arguments.param_prefixes)
    if not arguments.param_type:
        return names
    found = describe_parameters(node, other, names)
    kinds = {each.name: TYPE_WORDS.get(each.type, 'unknown') for each in found}
    return [f'{name} (type: {kinds.get(name, "unknown")})' for name in names]
