# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 lifecycle get`."""

from __future__ import annotations

import argparse
import sys

from lifecycle_msgs.srv import GetState

from aurora_ros2cli.calling import absolute, add_node_arguments, call
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import settled_node
from aurora_ros2cli.kinds import lifecycle_nodes
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser, optional=True)


def main(arguments: argparse.Namespace) -> int:
    """Print the state of one node, or of all nodes that have a lifecycle.

    Raises:
        CliError: If the node is not there, has no lifecycle or does not answer.
    """
    named = absolute(arguments.node_name) if arguments.node_name else None

    with settled_node(
        arguments, None if named is None else lambda node: named in lifecycle_nodes(node)
    ) as node:
        names = lifecycle_nodes(node)
        if named is not None and named not in names:
            raise CliError('Node not found')
        for name in [named] if named is not None else names:
            try:
                state = call(node, GetState, f'{name}/get_state', GetState.Request())
            except CliError as err:
                if named is not None:
                    raise
                sys.stderr.write(f'{err}\n')
                continue
            shown = f'{state.current_state.label} [{state.current_state.id}]'
            emit(shown if named is not None else f'{name}: {shown}')
    return 0
