# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 lifecycle set`."""

from __future__ import annotations

import argparse
import sys

from lifecycle_msgs.srv import ChangeState

from aurora_ros2cli.calling import add_node_arguments, call
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.lifecycle.services import lifecycle_node, transitions
from aurora_ros2cli.output import emit


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_node_arguments(parser)
    parser.add_argument('transition', help='The lifecycle transition, by label or number')


def main(arguments: argparse.Namespace) -> int:
    """Trigger a transition; one that fails goes to standard error with exit code 0, as in ros2cli.

    Raises:
        CliError: If the node is not there, or its state does not allow the transition.
    """
    with lifecycle_node(arguments) as (node, other):
        available = [each.transition for each in transitions(node, other)]
        wanted = [each for each in available if each.label == arguments.transition]
        wanted += [each for each in available if str(each.id) == arguments.transition]
        if not wanted:
            raise CliError(
                'Unknown transition requested, available ones are:'
                + ''.join(f'\n- {each.label} [{each.id}]' for each in available)
            )
        request = ChangeState.Request(transition=wanted[0])
        answer = call(node, ChangeState, f'{other}/change_state', request)
    if answer.success:
        emit('Transitioning successful')
    else:
        sys.stderr.write('Transitioning failed\n')
    return 0
