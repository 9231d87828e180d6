# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Wait until publishers have their subscribers: a volatile writer drops what nobody matched."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping

from rclpy.publisher import Publisher

from aurora_core.errors import ExecutionError

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
