# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Calls that their maker gives up, and those that he goes on to wait for."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
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
from aurora_ros.interfaces import Call
from aurora_ros.matching import wait_until
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


class Watch:
    """Hears of progress for a while, and of no death."""

    def __init__(self, working_s: float) -> None:
        self._until_s = time.monotonic() + working_s

    def came_further_s(self, _name: str) -> float:
        return min(time.monotonic(), self._until_s)

    def cause_of_death(self, _name: str) -> str:
        return ''

    def is_dead(self, _name: str) -> bool:
        return False

    def hear(self, _name: str) -> None:
        pass


class SlowJudge:
    """Answers after a while."""

    def __init__(self, node: Node) -> None:
        self.server = node.create_service(on.VERIFY.type, on.VERIFY.name, self._judge)

    def _judge(self, _request: Any, response: Any) -> Any:
        time.sleep(4.0 * SLOW_S)
        return response


class BusyServer:
    """Refuses the first goals, as one that still ends the run before; then does each at once."""

    def __init__(self, node: Node) -> None:
        self.refused = 0
        self.server = ActionServer(
            node,
            ExecuteScenario,
            on.EXECUTE.name,
            self._work,
            goal_callback=self._take,
            callback_group=ReentrantCallbackGroup(),
        )

    def _take(self, _goal: Any) -> GoalResponse:
        if self.refused == 3:
            return GoalResponse.ACCEPT
        self.refused += 1
        return GoalResponse.REJECT

    def _work(self, goal: Any) -> Any:
        goal.succeed()
        return ExecuteScenario.Result(ticks=7)


@contextmanager
def slow_server(
    domain: int, call: Call = on.EXECUTE, kind: Callable[[Node], Any] = SlowServer
) -> Iterator[Any]:
    """Serve under the name of the node that should, and leave nothing in the domain."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node(call.server, namespace=on.NAMESPACE, context=context)
    pool = MultiThreadedExecutor(context=context)
    pool.add_node(node)
    thread = threading.Thread(target=pool.spin, daemon=True)
    thread.start()
    serving = kind(node)
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


def test_a_goal_is_offered_again_while_the_server_ends_another() -> None:
    with (
        own_domain() as domain,
        slow_server(domain, kind=BusyServer) as server,
        partner(domain) as play,
    ):
        caller = Caller(play.node)
        caller.prepare(on.EXECUTE)
        with pytest.raises(ExecutionError, match='refused the goal'):
            caller.action(on.EXECUTE, ExecuteScenario.Goal(), 20.0)
        assert server.refused == 1
        result = caller.action(on.EXECUTE, ExecuteScenario.Goal(), 20.0, busy_s=15.0)
    assert (result.ticks, server.refused) == (7, 3)


def test_many_goals_are_sent_by_one_client() -> None:
    with own_domain() as domain, slow_server(domain, kind=BusyServer), partner(domain) as play:
        for _ in range(3):
            play.send_goal(on.EXECUTE, ExecuteScenario.Goal(), 20.0, busy_s=15.0)
        assert play.node.count_subscribers(f'{on.EXECUTE.name}/_action/feedback') == 1


@pytest.mark.parametrize(('working_s', 'is_answered'), [(30.0, True), (0.0, False)])
def test_an_answer_is_waited_for_beyond_the_limit_while_its_work_goes_on(
    working_s: float, is_answered: bool
) -> None:
    with (
        own_domain() as domain,
        slow_server(domain, on.VERIFY, SlowJudge),
        partner(domain) as play,
    ):
        caller = Caller(play.node, Watch(working_s))  # type: ignore[arg-type]
        caller.prepare(on.VERIFY)

        def call() -> None:
            caller.service(on.VERIFY, on.VERIFY.type.Request(), SLOW_S, while_working=True)

        assert wait_until(lambda: caller.is_served(on.VERIFY), 10.0)
        if is_answered:
            call()
        else:
            with pytest.raises(ExecutionError, match='did not answer'):
                call()
