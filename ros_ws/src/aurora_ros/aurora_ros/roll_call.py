# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ask several nodes at once whether they are there; from a worker thread, in milliseconds."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterable
from typing import Any

from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.client import Client
from rclpy.node import Node
from rclpy.task import Future

from aurora_core.errors import AuroraError, ParticipantSilentError
from aurora_ros import interfaces
from aurora_ros.errors import read_error
from aurora_ros.heartbeat import HeartbeatWatch

_LOOK_S = 0.02
_REPEAT_S = 0.5  # a question to a server that is just starting is lost


class Question:
    """One node's roll call.

    Args:
        name: Of the node.
        client: Of its service.
        watch: Tells that it has died.
        answered: Called when the answer is there.
    """

    def __init__(
        self,
        name: str,
        client: Client,
        watch: HeartbeatWatch,
        answered: Callable[[], None] = lambda: None,
    ) -> None:
        self._name = name
        self._client = client
        self._watch = watch
        self._answered = answered
        self._futures: list[Future] = []
        self._repeat_at_s = 0.0
        self.asked_at_s = time.monotonic()
        self.response: Any = None

    @property
    def is_settled(self) -> bool:
        """Whether there is an answer, or none will come."""
        return self.response is not None or self._watch.is_dead(self._name)

    def ask(self) -> None:
        """Ask, or ask again when no answer came for a while."""
        now_s = time.monotonic()
        if now_s < self._repeat_at_s or not self._client.service_is_ready():
            return
        self._repeat_at_s = now_s + _REPEAT_S
        future = self._client.call_async(self._client.srv_type.Request())
        self._futures.append(future)
        future.add_done_callback(self._on_done)

    def end(self, limit_s: float) -> AuroraError | None:
        """Stop waiting and return what is wrong with the node, None when it is present."""
        for future in self._futures:
            self._client.remove_pending_request(future)
        if self.response is not None:
            return read_error(self.response, self._name)
        cause = self._watch.cause_of_death(self._name)
        return ParticipantSilentError(
            f'{self._name} {cause}'
            if cause
            else f'{self._name} did not answer the roll call within {limit_s:g} s',
            component=self._name,
            hint=f'see the log of {self._name}; is it running in this ROS_DOMAIN_ID?',
        )

    def _on_done(self, future: Future) -> None:
        if not future.cancelled() and future.exception() is None:
            self.response = future.result()
            self._answered()


class RollCall:
    """Clients for the roll call of several nodes.

    Args:
        node: Its executor must be spinning in another thread than the caller's.
        watch: Tells early who has died.
        names: The nodes.
    """

    def __init__(self, node: Node, watch: HeartbeatWatch, names: Iterable[str]) -> None:
        self._node = node
        self._watch = watch
        group = ReentrantCallbackGroup()
        self._clients: dict[str, Client] = {}
        for name in names:
            call = interfaces.roll_call(name)
            self._clients[name] = node.create_client(call.type, call.name, callback_group=group)

    def question(self, name: str, answered: Callable[[], None] = lambda: None) -> Question:
        """Return a question to one node, not yet asked."""
        return Question(name, self._clients[name], self._watch, answered)

    def absent(
        self,
        names: Iterable[str],
        limit_s: float,
        *,
        cancelled: Callable[[], bool] = lambda: False,
    ) -> dict[str, AuroraError]:
        """Ask nodes at once and wait until all have answered, at most until the limit.

        Args:
            names: Whom to ask, in the order of the result.
            limit_s: Wall-clock limit for all together.
            cancelled: True ends the wait.

        Returns:
            What is wrong with each node that is not present.
        """
        news = threading.Event()
        questions = {name: self.question(name, news.set) for name in names}
        deadline_s = time.monotonic() + limit_s
        while time.monotonic() < deadline_s and self._node.context.ok() and not cancelled():
            waiting = [one for one in questions.values() if not one.is_settled]
            if not waiting:
                break
            for one in waiting:
                one.ask()
            news.wait(_LOOK_S)
            news.clear()
        ended = ((name, one.end(limit_s)) for name, one in questions.items())
        return {name: error for name, error in ended if error is not None}
