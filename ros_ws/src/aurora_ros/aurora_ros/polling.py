# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that are drained by their owner instead of waking the executor per message."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rclpy.callback_groups import CallbackGroup
from rclpy.subscription import Subscription


class PolledGroup(CallbackGroup):
    """A callback group of which the executor never runs anything."""

    def can_execute(self, entity: Any) -> bool:
        """Refuse, so that the entity is not waited for."""
        return False

    def beginning_execution(self, entity: Any) -> bool:
        """Refuse."""
        return False

    def ending_execution(self, entity: Any) -> None:
        """Do nothing."""


def drain(subscription: Subscription) -> Iterator[Any]:
    """Take everything that has arrived (bytes when the subscription is raw)."""
    handle = subscription.handle
    with handle:
        while (taken := handle.take_message(subscription.msg_type, subscription.raw)) is not None:
            yield taken[0]
