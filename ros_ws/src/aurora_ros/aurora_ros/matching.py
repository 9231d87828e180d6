# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is there: a volatile writer drops what nobody matched."""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Callable, Collection, Mapping

from rclpy.node import Node
from rclpy.publisher import Publisher

from aurora_core.errors import ExecutionError
from aurora_ros.interfaces import Topic

_POLL_S = 0.005


def wait_until(is_true: Callable[[], bool], limit_s: float, poll_s: float = _POLL_S) -> bool:
    """Poll on steady time; return whether the condition came true within the limit."""
    deadline = time.monotonic() + limit_s
    while not is_true():
        if time.monotonic() > deadline:
            return False
        time.sleep(poll_s)
    return True


def await_subscribers(wanted: Mapping[Publisher, int], *, limit_s: float, component: str) -> None:
    """Wait until each publisher has at least so many subscribers.

    Args:
        wanted: Publisher and least number of its subscribers.
        limit_s: Wall-clock limit.
        component: Node that publishes, named in the error.

    Raises:
        ExecutionError: Somebody is missing after the limit.
    """

    def lacking() -> list[str]:
        return [
            f'{publisher.topic_name} ({publisher.get_subscription_count()} of {count})'
            for publisher, count in wanted.items()
            if publisher.get_subscription_count() < count
        ]

    if not wait_until(lambda: not lacking(), limit_s):
        raise ExecutionError(
            f'too few subscribers after {limit_s:g} s: {", ".join(lacking())}',
            component=component,
            hint='is every node of the graph running in this ROS_DOMAIN_ID?',
        )


def twins(node: Node, topic: Topic, names: Collection[str]) -> list[str]:
    """Return which of the named nodes the middleware knows more than once.

    Args:
        node: Asks, and shares its namespace with the others.
        topic: One that each of them publishes once.
        names: Node names without namespace.
    """
    counts = Counter(
        info.node_name
        for info in node.get_publishers_info_by_topic(node.resolve_topic_name(topic.name))
        if info.node_namespace == node.get_namespace()
    )
    return [name for name in names if counts[name] > 1]
