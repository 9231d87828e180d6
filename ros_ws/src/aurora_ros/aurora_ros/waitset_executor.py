# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A single-threaded executor with a short way for streams.

The stock executor builds a wait set of every entity and a coroutine per callback: most of the cost
of a tick. Here the messages of streams (QoS keep all: states, commands, ticks) are waited for in a
wait set of those subscriptions alone while they flow, and their callbacks are called directly.
Everything else (services, timers, actions, events, single messages such as heartbeats) goes the
stock way: at once while no stream flows, some times a second while one does.

Being woken costs more than a message. A node that needs several messages before it can go on says
which one it lacks (`awaited`); the others are taken when that one comes.
"""

from __future__ import annotations

import inspect
import time
from collections.abc import Callable
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
from rclpy.qos import HistoryPolicy
from rclpy.subscription import Subscription

from aurora_ros.polling import PolledGroup

_HOT_S = 0.02  # how long after a message of a stream the next one is waited for in the short way
_STOCK_PERIOD_S = 0.1  # how long everything else may wait meanwhile
_STOCK_CALLBACKS = 100  # at most, before subscriptions have their turn again
_HOT_NS = int(_HOT_S * 1e9)
_BURST = 100  # messages of one subscription before the others have their turn


def is_supported() -> bool:
    """Return whether this rclpy has the wait set that the short way is built on."""
    return all(
        hasattr(_rclpy.WaitSet, name) for name in ('clear_entities', 'add_subscription', 'wait')
    ) and hasattr(_rclpy.Subscription, 'take_message')


class WaitSetExecutor(SingleThreadedExecutor):
    """Runs callbacks in the thread that calls `spin_once`; see the module.

    Args:
        context: None: the default one.
        awaited: Asked before each wait in the short way: the one subscription without whose next
            message nothing can go on, or None when any message matters.
    """

    def __init__(
        self,
        *,
        context: Context | None = None,
        awaited: Callable[[], Subscription | None] = lambda: None,
    ) -> None:
        self._stale = True
        self._awaited = awaited
        self._hot_until_s = 0.0
        self._stock_due_s = 0.0
        self._leaving_out_messages = False
        self._entered: list[Any] = []
        self._streams: tuple[Subscription, ...] = ()
        self._wait_set: Any = None
        super().__init__(context=context)

    def wake(self) -> None:
        """Notice that an entity was created or destroyed, or that the context has ended."""
        self._stale = True
        super().wake()

    def can_execute(self, entity: Any) -> bool:
        """Leave out what the short way looks after while it does."""
        if self._leaving_out_messages and entity in self._streams:
            return False
        return bool(super().can_execute(entity))

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
        if isinstance(entity, Subscription) and _is_stream(entity):
            self._hot_until_s = time.monotonic() + _HOT_S
        return True

    def _spin_hot(self) -> None:
        """Take messages directly; look after everything else when it is due."""
        if self._stale:
            self._rebuild()
        wait_set = self._wait_set
        wait_set.clear_entities()
        awaited = self._awaited()
        for subscription in (awaited,) if awaited in self._streams else self._streams:
            wait_set.add_subscription(subscription.handle)
        wait_set.wait(_HOT_NS)
        took = False
        for subscription in self._streams:
            took = self._take(subscription) or took
        now_s = time.monotonic()
        if took:
            self._hot_until_s = now_s + _HOT_S
        if now_s >= self._stock_due_s:
            self._stock_due_s = now_s + _STOCK_PERIOD_S
            self._spin_stock_without_messages()

    def _spin_stock_without_messages(self) -> None:
        """Serve whatever else is ready."""
        self._leaving_out_messages = True
        try:
            for _ in range(_STOCK_CALLBACKS):
                if not self._spin_stock(0.0):
                    break
        finally:
            self._leaving_out_messages = False

    def _take(self, subscription: Subscription) -> bool:
        """Call back with what has arrived; return whether there was anything."""
        for count in range(_BURST):
            if self._stale:
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
        streams = []
        for node in self.get_nodes():
            for subscription in node.subscriptions:
                if not _is_stream(subscription):
                    continue
                try:
                    subscription.handle.__enter__()
                except InvalidHandle:
                    continue
                self._entered.append(subscription.handle)
                streams.append(subscription)
        self._streams = tuple(streams)
        context: Any = self._context.handle
        with context:
            self._wait_set = _rclpy.WaitSet(len(streams), 0, 0, 0, 0, 0, context)

    def _release(self) -> None:
        """Allow the subscriptions that were waited for to be destroyed."""
        for handle in self._entered:
            handle.__exit__(None, None, None)
        self._entered.clear()
        self._streams = ()


def _is_stream(subscription: Subscription) -> bool:
    """Return whether the callback of a subscription is called in the short way."""
    return (
        subscription.qos_profile.history == HistoryPolicy.KEEP_ALL
        and not isinstance(subscription.callback_group, PolledGroup)
        and not inspect.iscoroutinefunction(subscription.callback)
        and subscription._callback_type is Subscription.CallbackType.MessageOnly
    )
