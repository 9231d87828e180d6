# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 action send_goal`."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from typing import Any

from action_msgs.msg import GoalStatus
from rclpy.action import ActionClient
from rclpy.node import Node

from aurora_ros2cli.errors import CliError
from aurora_ros2cli.fields import FieldError, read_fields
from aurora_ros2cli.graph import (
    NAME_PREFIX,
    full_name,
    interrupts_held,
    spin_until,
    temporary_node,
)
from aurora_ros2cli.output import emit
from aurora_ros2cli.rendering import WHOLE, as_yaml
from aurora_ros2cli.types import load_type

_STATUS = {
    GoalStatus.STATUS_ACCEPTED: 'ACCEPTED',
    GoalStatus.STATUS_EXECUTING: 'EXECUTING',
    GoalStatus.STATUS_CANCELING: 'CANCELING',
    GoalStatus.STATUS_SUCCEEDED: 'SUCCEEDED',
    GoalStatus.STATUS_CANCELED: 'CANCELED',
    GoalStatus.STATUS_ABORTED: 'ABORTED',
}
# Ctrl-C asks the server to cancel; one that is gone must not keep the command for ever.
_CANCEL_LIMIT_S = 30.0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    parser.add_argument('action_name', help="Name of the ROS action (e.g. '/fibonacci')")
    parser.add_argument(
        'action_type',
        help="Type of the ROS action (e.g. 'example_interfaces/action/Fibonacci')",
    )
    values = parser.add_mutually_exclusive_group()
    values.add_argument(
        'goal', nargs='?', default='{}', help="Goal values in YAML (e.g. '{order: 10}')"
    )
    values.add_argument('--stdin', action='store_true', help='Read goal from standard input')
    parser.add_argument(
        '-f', '--feedback', action='store_true', help='Echo feedback messages for the goal'
    )


def main(arguments: argparse.Namespace) -> int:
    """Send a goal and print its result; Ctrl-C cancels it.

    Raises:
        CliError: If the type is unknown, the values do not fit it, or the server failed.
    """
    action = load_type(arguments.action_type, 'action')
    goal = action.Goal()
    text = sys.stdin.read() if arguments.stdin else arguments.goal
    try:
        stamps = read_fields(goal, text)
    except FieldError as err:
        raise CliError(f'Failed to populate message fields: {err}') from err
    name = f'{NAME_PREFIX}_send_goal_{arguments.action_type.replace("/", "_")}'
    with temporary_node(name) as node:
        client = ActionClient(node, action, full_name(node, arguments.action_name))
        try:
            emit('Waiting for an action server to become available...')
            spin_until(node, client.server_is_ready)
            for stamp in stamps:
                stamp(node.get_clock().now().to_msg())
            _send(node, client, goal, _emit_feedback if arguments.feedback else None)
        finally:
            client.destroy()  # the node does not do it, and would stay in the graph
    return 0


def _send(
    node: Node, client: ActionClient, goal: Any, feedback: Callable[[Any], None] | None
) -> None:
    emit(f'Sending goal:\n     {as_yaml(goal, WHOLE)}')
    sending = client.send_goal_async(goal, feedback)
    try:
        # From here on Ctrl-C has a goal to cancel: it must not get lost between two waits.
        with interrupts_held():
            handle = _answer(node, sending, 'sending goal')
            if not handle.accepted:
                emit('Goal was rejected.')
                return
            emit(f'Goal accepted with ID: {bytes(handle.goal_id.uuid).hex()}\n')
            result = _answer(node, handle.get_result_async(), 'getting result')
    except KeyboardInterrupt:
        _cancel(node, sending)
        raise
    emit(f'Result:\n    {as_yaml(result.result, WHOLE)}')
    emit(f'Goal finished with status: {_STATUS.get(result.status, "UNKNOWN")}')


def _emit_feedback(feedback: Any) -> None:
    emit(f'Feedback:\n    {as_yaml(feedback.feedback, WHOLE)}')


def _answer(node: Node, future: Any, what: str) -> Any:
    spin_until(node, future.done)
    if future.exception() is not None:
        raise CliError(f'Exception while {what}: {future.exception()!r}')
    return future.result()


def _cancel(node: Node, sending: Any) -> None:
    emit('Canceling goal...')
    # The goal may run already although the server's answer has not come yet.
    answered = spin_until(node, sending.done, _CANCEL_LIMIT_S)
    if answered and sending.exception() is None and not sending.result().accepted:
        emit('Goal was rejected.')
        return
    if answered and sending.exception() is None:
        future = sending.result().cancel_goal_async()
        answered = spin_until(node, future.done, _CANCEL_LIMIT_S)
        if answered and future.result().goals_canceling:
            emit('Goal canceled.')
            return
    raise CliError(
        'Failed to cancel goal'
        + ('' if answered else f': the server did not answer within {_CANCEL_LIMIT_S:g} s')
    )
