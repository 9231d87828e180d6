# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Blocking calls with wall-clock limits, made from a worker thread (never a nested spin).

A service client whose server was killed waits for ever and `service_is_ready` stays true
until its lease is over, so each wait has a limit and asks the heartbeats in between.

Whoever serves a name beside the node that should may answer first. It is looked for while an
answer is awaited and before it is believed.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
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
from aurora_ros.matching import wait_until
from aurora_ros.writers import Stranger, named, second_one, second_servers

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
        others: Calls that this node does not make, but that nobody else may serve either.
    """

    def __init__(
        self,
        node: Node,
        watch: HeartbeatWatch | None = None,
        *,
        guard: Callable[[], None] = lambda: None,
        others: Iterable[Call] = (),
    ) -> None:
        self._node = node
        self._watch = watch
        self._guard = guard
        self._group = ReentrantCallbackGroup()
        self._guarded = list(others)
        self._services: dict[str, Client] = {}
        self._actions: dict[str, ThreadedActionClient] = {}

    def prepare(self, *calls: Call) -> None:
        """Create clients ahead of the first call, so that discovery costs nothing later.

        What has a client keeps that one: of dozens for one action a server answered the last one
        no more, whose endpoints the middleware had not matched.
        """
        for call in calls:
            if call.name in self._actions or call.name in self._services:
                continue
            self._guarded.append(call)
            if call.is_action:
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

    def strangers(self) -> list[Stranger]:
        """Return who serves a guarded call beside the node that should."""
        return second_servers(self._node, self._guarded)

    def await_alone(self, limit_s: float, cancelled: Callable[[], bool]) -> None:
        """Wait until nobody else serves a guarded call; one that died is forgotten.

        Args:
            limit_s: Wall-clock limit, longer than any lease.
            cancelled: True ends the wait.

        Raises:
            ExecutionError: Somebody does.
            AuroraError: The guard raised.
        """

        def alone() -> bool:
            self._guard()
            return cancelled() or not self.strangers()

        if not wait_until(alone, limit_s, _LOOK_S):
            self.check_alone()

    def check_alone(self, *calls: Call) -> None:
        """Look whether only those who should can have answered.

        Args:
            calls: Which ones; every guarded one when none is given.

        Raises:
            ExecutionError: Somebody else can; it is named if it has a name.
        """

        for stranger in named(lambda: second_servers(self._node, calls or self._guarded)):
            raise second_one(stranger)

    def service(
        self,
        call: Call,
        request: Any,
        limit_s: float,
        *,
        await_restart: bool = True,
        while_working: bool = False,
    ) -> Any:
        """Call a prepared service and return its response.

        Args:
            call: Interface.
            request: Request message.
            limit_s: Wall-clock limit for server and answer together.
            await_restart: Give a server that is dead some seconds to come back.
            while_working: The limit begins anew whenever the server says that it came further.

        Raises:
            ExecutionError: No server or a second one, no answer within the limit, or the server
                died.
            AuroraError: The response carries an error.
        """
        deadline = time.monotonic() + limit_s
        client = self._services[call.name]
        if not await_restart:
            self._check(call, deadline, limit_s)
        self._await_server(call, client.service_is_ready, deadline, limit_s)
        future = client.call_async(request)
        try:
            self._await(future, call, deadline, limit_s, while_working=while_working)
        except ExecutionError:
            client.remove_pending_request(future)
            raise
        self.check_alone(call)
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
        busy_s: float = 0.0,
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
            busy_s: Wall-clock seconds in which a refused goal is sent again: the server may still
                be ending what was given up before.

        Raises:
            ExecutionError: No server or a second one, goal refused, no result within the limit,
                server died.
            AuroraError: The result carries an error, or the guard raised.
        """
        busy_until = time.monotonic() + busy_s
        handle = self._offer(call, goal, limit_s, on_feedback)
        while not handle.accepted and time.monotonic() < busy_until and not cancelled():
            time.sleep(_LOOK_S)
            handle = self._offer(call, goal, limit_s, on_feedback)
        if not handle.accepted:
            raise ExecutionError(
                f'{call.server} refused the goal of {call.name}',
                component=call.server,
                hint='it is busy with another run, or not active',
            )
        deadline = time.monotonic() + limit_s
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
        self.check_alone(call)
        response = result.result()
        if response.status == GoalStatus.STATUS_UNKNOWN:
            raise ExecutionError(f'{call.server} lost the goal', component=call.server)
        if raise_errors:
            raise_error(response.result, call.server)
        return response.result

    def _offer(
        self, call: Call, goal: Any, limit_s: float, on_feedback: Callable[[Any], None]
    ) -> ClientGoalHandle:
        """Send a goal and return whether it was accepted, with its handle."""
        accept_s = min(limit_s, _ACCEPT_S)
        deadline = time.monotonic() + accept_s
        client = self._actions[call.name]
        self._await_server(call, client.server_is_ready, deadline, accept_s)
        sent = client.send_goal_async(
            goal, feedback_callback=lambda message: on_feedback(message.feedback)
        )
        try:
            self._await(sent, call, deadline, accept_s)
            self.check_alone(call)
        except AuroraError:
            # The server may take it all the same, and would be busy when the next goal comes.
            sent.add_done_callback(_give_up)
            raise
        handle: ClientGoalHandle = sent.result()
        return handle

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
        while not is_ready() or self._is_dead(call) or self._has_twin(call):
            self._guard()
            until = restart_deadline if self._is_dead(call) else deadline
            if time.monotonic() > until or not self._node.context.ok():
                self.check_alone(call)
                raise ParticipantSilentError(
                    f'nobody serves {call.name} (waited up to {limit_s:g} s)',
                    component=call.server,
                    hint=f'start it: is {call.server} running in this ROS_DOMAIN_ID?',
                )
            pause.wait(_POLL_S)

    def _await(
        self,
        future: Future,
        call: Call,
        deadline: float,
        limit_s: float,
        *,
        while_working: bool = False,
    ) -> None:
        done = _event_of(future)
        while not done.wait(_LOOK_S):
            if while_working and self._watch is not None:
                deadline = max(deadline, self._watch.came_further_s(call.server) + limit_s)
            self._check(call, deadline, limit_s)
        err = future.exception()
        if err is not None:
            raise ExecutionError(f'{call.name} failed: {err}', component=call.server) from err

    def _has_twin(self, call: Call) -> bool:
        """Return whether the server is there twice; one that was killed is so until its lease."""
        twin = f'{self._node.get_namespace().rstrip("/")}/{call.server}'
        return any(one.node == twin for one in second_servers(self._node, [call]))

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
        for stranger in second_servers(self._node, [call]):
            if stranger.node:
                raise second_one(stranger)
        if time.monotonic() > deadline:
            raise ParticipantSilentError(
                f'{call.server} did not answer {call.name} within {limit_s:g} s',
                component=call.server,
                hint=f'see the log of {call.server}',
            )


def _give_up(sent: Future) -> None:
    """Cancel a goal whose sender has gone on, once somebody has taken it."""
    if sent.exception() is None and sent.result() is not None and sent.result().accepted:
        sent.result().cancel_goal_async()


def _event_of(future: Future) -> threading.Event:
    done = threading.Event()
    future.add_done_callback(lambda _future: done.set())
    return done
