# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A single-threaded executor with a short way for subscriptions.

The stock executor builds a wait set of every entity and a coroutine per callback: most of the cost
of a tick. Here messages that follow each other closely are waited for in a wait set of the
subscriptions alone and their callbacks are called directly. Everything else (services, timers,
actions, events) goes the stock way: at once while no messages flow, every few milliseconds while
they do.
"""

from __future__ import annotations

import inspect
import time
from typing import Any

from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import (
    ConditionReachedException,
    ExternalShutdownException,
    SingleThreadedExecutor,
    TimeoutException,
)
from rclpy.impl.implementation_singleton import rclpy_implementation as _rclpy
from rclpy.subscription import Subscription

from aurora_ros.polling import PolledGroup

_HOT_S = 0.01  # how long after a message the next one is waited for in the short way
_STOCK_PERIOD_S = 0.02  # how long services and timers may wait meanwhile
_STOCK_CALLBACKS = 100  # at most, before subscriptions have their turn again
_BURST = 100  # messages of one subscription before the others have their turn


def is_supported() -> bool:
    """Return whether this rclpy has the wait set that the short way is built on."""
    return all(
        hasattr(_rclpy.WaitSet, name)
        for name in ('clear_entities', 'add_subscription', 'add_guard_condition', 'wait')
    ) and hasattr(_rclpy.Subscription, 'take_message')


class WaitSetExecutor(SingleThreadedExecutor):
    """Runs callbacks in the thread that calls `spin_once`; see the module.

    Args:
        context: None: the default one.
    """

    def __init__(self, *, context: Context | None = None) -> None:
        self._stale = True
        self._hot_until_s = 0.0
        self._stock_due_s = 0.0
        self._entered: list[Any] = []
        self._by_pointer: dict[int, Subscription] = {}
        self._wait_set: Any = None
        super().__init__(context=context)

    def wake(self) -> None:
        """Notice that an entity was created or destroyed, or that the context has ended."""
        self._stale = True
        super().wake()

    def spin_once(self, timeout_sec: float | None = None) -> None:
        """Wait for messages or other work and do it."""
        if self._stale:
            # A subscription that was destroyed lives on while we hold it.
            self._release()
        if timeout_sec is not None or time.monotonic() >= self._hot_until_s:
            self._spin_stock(timeout_sec)
            return
        try:
            self._spin_hot()
        except _rclpy.RCLError as err:
            # A signal ended the context between two calls of ours.
            if self._context.ok():
                raise
            raise ExternalShutdownException from err

    def shutdown(self, timeout_sec: float | None = None) -> bool:
        """Stop and let go of the subscriptions."""
        self._release()
        return bool(super().shutdown(timeout_sec))

    def _spin_stock(self, timeout_sec: float | None) -> bool:
        """Do one piece of work the stock way; return whether there was any."""
        entity: Any
        try:
            handler, entity, _ = self.wait_for_ready_callbacks(timeout_sec)
        except (TimeoutException, ConditionReachedException):
            return False
        handler()
        error = handler.exception()
        if error is not None:
            raise error
        if isinstance(entity, Subscription):
            self._hot_until_s = time.monotonic() + _HOT_S
        return True

    def _spin_hot(self) -> None:
        """Take messages directly; look after everything else when it is due."""
        if self._stale:
            self._rebuild()
        wait_set = self._wait_set
        wait_set.clear_entities()
        for subscription in self._by_pointer.values():
            wait_set.add_subscription(subscription.handle)
        guard = wait_set.add_guard_condition(self._guard.handle)
        interrupt = wait_set.add_guard_condition(self._sigint_gc.handle)
        wait_set.wait(int(_HOT_S * 1e9))
        took = False
        for pointer in wait_set.get_ready_entities('subscription'):
            took = self._take(self._by_pointer.get(pointer)) or took
        now_s = time.monotonic()
        if took:
            self._hot_until_s = now_s + _HOT_S
        woken = wait_set.is_ready('guard_condition', guard) or wait_set.is_ready(
            'guard_condition', interrupt
        )
        if woken or now_s >= self._stock_due_s:
            self._stock_due_s = now_s + _STOCK_PERIOD_S
            for _ in range(_STOCK_CALLBACKS):
                if not self._spin_stock(0.0):
                    break

    def _take(self, subscription: Subscription | None) -> bool:
        """Call back with what has arrived; return whether there was anything."""
        for count in range(_BURST):
            if subscription is None or self._stale:
                return count > 0
            taken = subscription.handle.take_message(subscription.msg_type, subscription.raw)
            if taken is None:
                return count > 0
            subscription.callback(taken[0])
        return True

    def _rebuild(self) -> None:
        """Make the wait set of the subscriptions that there are now."""
        self._stale = False
        self._release()
        for node in self.get_nodes():
            for subscription in node.subscriptions:
                if not _is_plain(subscription):
                    continue
                try:
                    subscription.handle.__enter__()
                except InvalidHandle:
                    continue
                self._entered.append(subscription.handle)
                self._by_pointer[subscription.handle.pointer] = subscription
        context: Any = self._context.handle
        with context:
            self._wait_set = _rclpy.WaitSet(len(self._by_pointer), 2, 0, 0, 0, 0, context)

    def _release(self) -> None:
        """Allow the subscriptions that were waited for to be destroyed."""
        for handle in self._entered:
            handle.__exit__(None, None, None)
        self._entered.clear()
        self._by_pointer.clear()


def _is_plain(subscription: Subscription) -> bool:
    """Return whether a callback may be called directly: a function of the message alone."""
    return (
        not isinstance(subscription.callback_group, PolledGroup)
        and not inspect.iscoroutinefunction(subscription.callback)
        and subscription._callback_type is Subscription.CallbackType.MessageOnly
    )
