# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Calls that their maker gives up."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest

pytest.importorskip('rclpy')

import rclpy
from rclpy.action.server import ActionServer, CancelResponse, GoalResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node

from aurora_core.errors import ExecutionError
from aurora_msgs.action import ExecuteScenario
from aurora_ros import interfaces as on
from aurora_ros.call import Caller
from aurora_ros.testing.domains import own_domain
from aurora_ros.testing.partner import partner

pytestmark = pytest.mark.ros

SLOW_S = 0.5


class SlowServer:
    """Takes a goal after a while, and works on it until it is cancelled."""

    def __init__(self, node: Node) -> None:
        self.asked, self.cancelled = threading.Event(), threading.Event()
        self.server = ActionServer(
            node,
            ExecuteScenario,
            on.EXECUTE.name,
            self._work,
            goal_callback=self._take,
            cancel_callback=lambda _goal: CancelResponse.ACCEPT,
            callback_group=ReentrantCallbackGroup(),
        )

    def _take(self, _goal: Any) -> GoalResponse:
        self.asked.set()
        time.sleep(SLOW_S)
        return GoalResponse.ACCEPT

    def _work(self, goal: Any) -> Any:
        deadline = time.monotonic() + 20.0
        while not goal.is_cancel_requested:
            if time.monotonic() > deadline:
                goal.abort()
                return ExecuteScenario.Result()
            time.sleep(0.05)
        goal.canceled()
        self.cancelled.set()
        return ExecuteScenario.Result()


@contextmanager
def slow_server(domain: int) -> Iterator[SlowServer]:
    """Serve under the name of the node that should, and leave nothing in the domain."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node(on.EXECUTE.server, namespace=on.NAMESPACE, context=context)
    pool = MultiThreadedExecutor(context=context)
    pool.add_node(node)
    thread = threading.Thread(target=pool.spin, daemon=True)
    thread.start()
    serving = SlowServer(node)
    try:
        yield serving
    finally:
        pool.shutdown(timeout_sec=5.0)
        thread.join(timeout=5.0)
        serving.server.destroy()
        node.destroy_node()
        rclpy.shutdown(context=context)


def test_a_goal_given_up_before_it_is_taken_is_cancelled_then() -> None:
    with own_domain() as domain, slow_server(domain) as server, partner(domain) as play:

        def guard() -> None:
            if server.asked.is_set():
                raise ExecutionError('a partner died')

        caller = Caller(play.node, guard=guard)
        caller.prepare(on.EXECUTE)
        with pytest.raises(ExecutionError, match='a partner died'):
            caller.action(on.EXECUTE, ExecuteScenario.Goal(), 20.0)
        assert server.cancelled.wait(10.0)
