# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the verbs of `ros2 lifecycle` ask a node."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from lifecycle_msgs.srv import GetAvailableTransitions
from rclpy.node import Node

from aurora_ros2cli.calling import absolute, call
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import settled_node
from aurora_ros2cli.kinds import lifecycle_nodes


def transitions(node: Node, other: str, *, every: bool = False) -> list[Any]:
    """Return the transitions of a node (`lifecycle_msgs/msg/TransitionDescription`).

    Args:
        node: The own node.
        other: Full name of the node.
        every: All that exist, not only those that its state allows.

    Raises:
        CliError: If the node does not answer.
    """
    name = 'get_transition_graph' if every else 'get_available_transitions'
    request = GetAvailableTransitions.Request()
    answer = call(node, GetAvailableTransitions, f'{other}/{name}', request)
    return list(answer.available_transitions)


@contextmanager
def lifecycle_node(arguments: argparse.Namespace) -> Iterator[tuple[Node, str]]:
    """Start a node that knows the lifecycle node which the user named.

    Yields:
        The own node and the full name of the other.

    Raises:
        CliError: If there is no such node, or it has no lifecycle.
    """
    wanted = absolute(arguments.node_name)
    with settled_node(arguments, lambda node: wanted in lifecycle_nodes(node)) as node:
        if wanted not in lifecycle_nodes(node):
            raise CliError('Node not found')
        yield node, wanted
