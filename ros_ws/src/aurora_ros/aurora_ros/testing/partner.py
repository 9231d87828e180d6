# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A node inside the test process that plays missing partners and calls services."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher

from aurora_ros.call import Caller
from aurora_ros.heartbeat import HeartbeatWatch
from aurora_ros.interfaces import NAMESPACE, Call, Topic
from aurora_ros.matching import wait_until

LIMIT_S = 10.0


class Partner:
    """Publishes, collects and calls; its node is spun by a thread.

    Args:
        node: Node of the test.
    """

    def __init__(self, node: Node) -> None:
        self.node = node
        self._group = ReentrantCallbackGroup()
        self.watch = HeartbeatWatch(node)
        self._caller = Caller(node, self.watch)

    def publisher(self, topic: Topic, subscribers: int = 1) -> Publisher:
        """Return a publisher that has at least so many subscribers.

        Raises:
            AssertionError: They did not come.
        """
        publisher = self.node.create_publisher(topic.type, topic.name, topic.qos)
        if not wait_until(lambda: publisher.get_subscription_count() >= subscribers, LIMIT_S):
            raise AssertionError(f'nobody subscribes to {topic.name}')
        return publisher

    def on(self, topic: Topic, callback: Callable[[Any], None]) -> None:
        """Call back with every message of a topic."""
        self.node.create_subscription(
            topic.type, topic.name, callback, topic.qos, callback_group=self._group
        )

    def collect(self, topic: Topic) -> list[Any]:
        """Return a list that grows with every message of a topic."""
        messages: list[Any] = []
        self.on(topic, messages.append)
        return messages

    def serve(self, call: Call, handler: Callable[[Any, Any], Any]) -> None:
        """Serve a service as a fake."""
        self.node.create_service(call.type, call.name, handler, callback_group=self._group)

    def call(self, call: Call, limit_s: float = LIMIT_S, **fields: Any) -> Any:
        """Call a service.

        Raises:
            AuroraError: The response carries an error, or none came.
        """
        self._caller.prepare(call)
        return self._caller.service(call, call.type.Request(**fields), limit_s)

    def send_goal(self, call: Call, goal: Any, limit_s: float, **options: Any) -> Any:
        """Send a goal and return its result; see `Caller.action`."""
        self._caller.prepare(call)
        return self._caller.action(call, goal, limit_s, **options)


@contextmanager
def partner(domain: int) -> Iterator[Partner]:
    """Yield a partner in a domain."""
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Node('partner', namespace=NAMESPACE, context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=_spin, args=(executor,), daemon=True)
    thread.start()
    try:
        yield Partner(node)
    finally:
        rclpy.shutdown(context=context)
        thread.join(timeout=LIMIT_S)
        node.destroy_node()


def _spin(executor: SingleThreadedExecutor) -> None:
    try:
        executor.spin()
    except ExternalShutdownException:
        return
