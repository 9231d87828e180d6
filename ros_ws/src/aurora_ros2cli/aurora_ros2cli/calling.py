# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Call the services of a node: parameters and lifecycle."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from rclpy.node import Node

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import (
    add_look_arguments,
    node_names,
    settled_node,
    spin_until,
)

# A node that is in the graph but whose service cannot be matched: as long as ros2cli waits.
SERVICE_WAIT_S = 5.0


def add_node_arguments(parser: argparse.ArgumentParser, *, optional: bool = False) -> None:
    """Add the name of the node that is asked."""
    add_look_arguments(parser)
    parser.add_argument('node_name', nargs='?' if optional else None, help='Name of the ROS node')
    parser.add_argument(
        '-a',
        '--all',
        '--include-hidden-nodes',
        dest='hidden',
        action='store_true',
        help='Consider hidden nodes as well',
    )


def absolute(name: str) -> str:
    """Return a node name with the slash that it begins with."""
    return name if name.startswith('/') else f'/{name}'


@contextmanager
def node_that_sees(arguments: argparse.Namespace) -> Iterator[tuple[Node, str]]:
    """Start a node that knows the node which the user named.

    Yields:
        The own node and the full name of the other.

    Raises:
        CliError: If there is no such node.
    """
    wanted = absolute(arguments.node_name)

    def found(node: Node) -> bool:
        return wanted in node_names(node, hidden=arguments.hidden)

    with settled_node(arguments, found) as node:
        if not found(node):
            raise CliError('Node not found')
        yield node, wanted


def call(node: Node, service: Any, name: str, request: Any) -> Any:
    """Call a service of a node that is there.

    Args:
        node: The own node.
        service: Service class.
        name: Full name of the service.
        request: The request.

    Returns:
        The response.

    Raises:
        CliError: If the service does not come up, or the call failed.
    """
    client = node.create_client(service, name)
    try:
        if not spin_until(node, client.service_is_ready, SERVICE_WAIT_S):
            raise CliError(f"Wait for service timed out: '{name}' is not available")
        future = client.call_async(request)
        spin_until(node, future.done)
        if future.exception() is not None:
            raise CliError(f"Exception while calling service '{name}': {future.exception()}")
        return future.result()
    finally:
        node.destroy_client(client)
