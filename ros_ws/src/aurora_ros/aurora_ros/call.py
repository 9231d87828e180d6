# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Blocking calls with wall-clock limits, made from a worker thread (never a nested spin).

A service client whose server was killed waits for ever and `service_is_ready` stays true
until its lease is over, so each wait has a limit and asks the heartbeats in between.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from typing import Any

from action_msgs.msg import GoalStatus
from rclpy.action.client import ClientGoalHandle
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future

from aurora_core.errors import AuroraError, ExecutionError, ParticipantSilentError
from aurora_ros.action_client import ThreadedActionClient
from aurora_ros.errors import raise_error
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.interfaces import Call

_POLL_S = 0.01  # discovery of a server
_RESTART_S = 15.0  # a server that is dead when the call begins may be just starting again
_ABANDON_S = 3.0  # for the end of a goal that is given up
_ACCEPT_S = 30.0  # for an action server to be there and to answer a goal, which it does at once
_LOOK_S = 0.1  # between two looks at heartbeats and cancellation while an answer is awaited


class Caller:
    """Clients of one node, made once and kept.

    Args:
        node: Its executor must be spinning in another thread than the caller's.
        watch: Tells early that a server has died.
        guard: Asked in every wait; raises when waiting makes no sense for another reason.
    """

    def __init__(
        self,
        node: Node,
        watch: HeartbeatWatch | None = None,
        *,
        guard: Callable[[], None] = lambda: None,
    ) -> None:
        self._node = node
        self._watch = watch
        self._guard = guard
        self._group = ReentrantCallbackGroup()
        self._services: dict[str, Client] = {}
        self._actions: dict[str, ThreadedActionClient] = {}

    def prepare(self, *calls: Call) -> None:
        """Create clients ahead of the first call, so that discovery costs nothing later."""
        for call in calls:
            if hasattr(call.type, 'Goal'):
                self._actions[call.name] = ThreadedActionClient(
                    self._node, call.type, call.name, callback_group=self._group
                )
            else:
                self._services[call.name] = self._node.create_client(
                    call.type, call.name, callback_group=self._group
                )

    def is_served(self, call: Call) -> bool:
        """Return whether somebody serves a prepared call now, and is not known to be dead."""
        action = self._actions.get(call.name)
        ready = (
            self._services[call.name].service_is_ready
            if action is None
            else action.server_is_ready
        )
        return bool(ready()) and not self._is_dead(call)

    def service(
        self, call: Call, request: Any, limit_s: float, *, await_restart: bool = True
    ) -> Any:
        """Call a prepared service and return its response.

        Args:
            call: Interface.
            request: Request message.
            limit_s: Wall-clock limit for server and answer together.
            await_restart: Give a server that is dead some seconds to come back.

        Raises:
            ExecutionError: No server, no answer within the limit, or the server died.
            AuroraError: The response carries an error.
        """
        deadline = time.monotonic() + limit_s
        client = self._services[call.name]
        if not await_restart:
            self._check(call, deadline, limit_s)
        self._await_server(call, client.service_is_ready, deadline, limit_s)
        future = client.call_async(request)
        try:
            self._await(future, call, deadline, limit_s)
        except ExecutionError:
            client.remove_pending_request(future)
            raise
        if self._watch is not None:
            self._watch.hear(call.server)
        response = future.result()
        raise_error(response, call.server)
        return response

    def action(
        self,
        call: Call,
        goal: Any,
        limit_s: float,
        *,
        on_feedback: Callable[[Any], None] = lambda _feedback: None,
        cancelled: Callable[[], bool] = lambda: False,
        cancel_limit_s: float = 10.0,
        raise_errors: bool = True,
    ) -> Any:
        """Send a goal to a prepared action, wait for its end and return the result.

        Args:
            call: Interface.
            goal: Goal message.
            limit_s: Wall-clock limit from the accepted goal to its end; server and acceptance have
                at most 30 s more.
            on_feedback: Called with each feedback message in the executor's thread.
            cancelled: Asked ten times a second; the goal is cancelled once it is true.
            cancel_limit_s: Wall-clock limit from then on.
            raise_errors: Raise the error that the result carries.

        Raises:
            ExecutionError: No server, goal refused, no result within the limit, server died.
            AuroraError: The result carries an error, or the guard raised.
        """
        accept_s = min(limit_s, _ACCEPT_S)
        deadline = time.monotonic() + accept_s
        client = self._actions[call.name]
        self._await_server(call, client.server_is_ready, deadline, accept_s)
        sent = client.send_goal_async(
            goal, feedback_callback=lambda message: on_feedback(message.feedback)
        )
        self._await(sent, call, deadline, accept_s)
        deadline = time.monotonic() + limit_s
        handle: ClientGoalHandle = sent.result()
        if not handle.accepted:
            raise ExecutionError(
                f'{call.server} refused the goal of {call.name}',
                component=call.server,
                hint='it is busy with another run, or not active',
            )
        result = handle.get_result_async()
        done = _event_of(result)
        cancelling = False
        try:
            while not done.wait(_LOOK_S):
                if cancelled() and not cancelling:
                    cancelling = True
                    handle.cancel_goal_async()
                    deadline, limit_s = time.monotonic() + cancel_limit_s, cancel_limit_s
                self._check(call, deadline, limit_s)
        except AuroraError:
            self._abandon(call, handle, done)
            raise
        response = result.result()
        if response.status == GoalStatus.STATUS_UNKNOWN:
            raise ExecutionError(f'{call.server} lost the goal', component=call.server)
        if raise_errors:
            raise_error(response.result, call.server)
        return response.result

    def _abandon(self, call: Call, handle: ClientGoalHandle, done: threading.Event) -> None:
        """Ask for the end of a goal that nobody waits for any more; wait for it a little."""
        if self._is_dead(call) or not self._node.context.ok():
            return
        handle.cancel_goal_async()
        deadline = time.monotonic() + _ABANDON_S
        while not done.wait(_LOOK_S):
            if self._is_dead(call) or time.monotonic() > deadline:
                return

    def _await_server(
        self, call: Call, is_ready: Callable[[], bool], deadline: float, limit_s: float
    ) -> None:
        pause = threading.Event()
        restart_deadline = min(deadline, time.monotonic() + _RESTART_S)
        while not is_ready() or self._is_dead(call):
            self._guard()
            until = restart_deadline if self._is_dead(call) else deadline
            if time.monotonic() > until or not self._node.context.ok():
                raise ParticipantSilentError(
                    f'nobody serves {call.name} (waited up to {limit_s:g} s)',
                    component=call.server,
                    hint=f'start it: is {call.server} running in this ROS_DOMAIN_ID?',
                )
            pause.wait(_POLL_S)

    def _await(self, future: Future, call: Call, deadline: float, limit_s: float) -> None:
        done = _event_of(future)
        while not done.wait(_LOOK_S):
            self._check(call, deadline, limit_s)
        err = future.exception()
        if err is not None:
            raise ExecutionError(f'{call.name} failed: {err}', component=call.server) from err

    def _is_dead(self, call: Call) -> bool:
        return self._watch is not None and self._watch.is_dead(call.server)

    def _check(self, call: Call, deadline: float, limit_s: float) -> None:
        """Raise when it makes no sense to wait any longer."""
        if not self._node.context.ok():
            raise ExecutionError(f'shut down while waiting for {call.name}')
        cause = self._watch.cause_of_death(call.server) if self._watch is not None else ''
        if cause:
            raise ParticipantSilentError(
                f'{call.server} {cause} while {call.name} was waited for', component=call.server
            )
        self._guard()
        if time.monotonic() > deadline:
            raise ParticipantSilentError(
                f'{call.server} did not answer {call.name} within {limit_s:g} s',
                component=call.server,
                hint=f'see the log of {call.server}',
            )


def _event_of(future: Future) -> threading.Event:
    done = threading.Event()
    future.add_done_callback(lambda _future: done.set())
    return done
