# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 lifecycle list`: the transitions of a node."""

from __future__ import annotations

import argparse

from aurora_ros2cli.graph import add_look_arguments
from aurora_ros2cli.lifecycle.services import lifecycle_node, transitions
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_look_arguments(parser)
    parser.add_argument('node_name', help='Name of the ROS node')
    parser.add_argument(
        '-a', '--all', action='store_true', help='Display all existing transitions'
    )


def main(arguments: argparse.Namespace) -> int:
    """Print each transition with the states that it connects.

    Raises:
        CliError: If the node is not there, has no lifecycle or does not answer.
    """
    with lifecycle_node(arguments) as (node, other):
        found = transitions(node, other, every=arguments.all)
    for each in found:
        emit(f'- {each.transition.label} [{each.transition.id}]')
        emit(f'\tStart: {each.start_state.label}')
        emit(f'\tGoal: {each.goal_state.label}')
    return 0
