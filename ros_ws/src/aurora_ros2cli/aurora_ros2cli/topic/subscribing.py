# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What `ros2 topic echo`, `hz` and `bw` share: the type and the profile of a topic."""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

from rclpy.node import Node

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import spin_until
from aurora_ros2cli.output import emit
from aurora_ros2cli.qos import add_qos_arguments

PRESET = 'sensor_data'


def add_topic_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the topic's name and the options for its profile."""
    parser.add_argument('topic_name', help="Name of the ROS topic to listen to (e.g. '/chatter')")
    add_qos_arguments(parser, 'subscribe', PRESET)
    parser.add_argument(
        '--filter',
        dest='filter_expr',
        metavar='FILTER_EXPR',
        help='Python expression to filter messages by; the message is in scope as m',
    )


def only_type(node: Node, topic: str) -> str | None:
    """Return the type of a topic, or None while it has none.

    Raises:
        CliError: If it has several.
    """
    types = dict(node.get_topic_names_and_types()).get(topic, [])
    if len(types) > 1:
        raise CliError(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
        )
    return str(types[0]) if types else None


def awaited_type(node: Node, topic: str) -> str:
    """Return the type of a topic; where it has none yet say so and wait for it.

    Raises:
        CliError: If it has several.
    """
    found = only_type(node, topic)
    if found is None:
        emit(f'WARNING: topic [{topic}] does not appear to be published yet')
        spin_until(node, lambda: only_type(node, topic) is not None)
        found = only_type(node, topic)
    return str(found)


def message_filter(expression: str | None) -> Callable[[Any], bool] | None:
    """Return a test of messages from a Python expression of the caller's own command line.

    Raises:
        CliError: If it is no expression.
    """
    if expression is None:
        return None
    try:
        code = compile(expression, '<filter>', 'eval')
    except SyntaxError as err:
        raise CliError(f"Invalid filter expression '{expression}': {err.msg}") from err

    def passes(message: Any) -> bool:
        # The expression is typed by the user who runs the command, as in ros2cli.
        return bool(eval(code, {'m': message}))  # noqa: S307  # nosec B307

    return passes
