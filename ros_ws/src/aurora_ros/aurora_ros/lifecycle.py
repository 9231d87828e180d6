# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Managed nodes: configure and activate by themselves unless `autostart` is false."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import Any

from rclpy.action.client import ActionClient
from rclpy.action.server import ActionServer
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn

from aurora_core.errors import AuroraError, ExecutionError
from aurora_ros.heartbeat import HeartbeatPublisher
from aurora_ros.interfaces import NAMESPACE
from aurora_ros.node import EndpointsMixin


class ManagedNode(EndpointsMixin, LifecycleNode):
    """Base of the bridges, sync and executor.

    Subclasses override `configure`, `activate`, `deactivate` and `cleanup`; an exception in one
    of them fails the transition, and its traceback is logged (rclpy swallows it).

    Args:
        name: Node name inside the namespace `aurora`.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name, namespace=NAMESPACE)
        self.heartbeat = HeartbeatPublisher(self)
        self.wants_autostart = True
        self._active = False
        self._permanent: dict[Any, Callable[[Any], Any]] = {}
        self._first_error: Exception | None = None

    def configure(self) -> None:
        """Acquire what the node needs."""

    def activate(self) -> None:
        """Begin to serve."""

    def deactivate(self) -> None:
        """Give up a run that is going on."""

    def cleanup(self) -> None:
        """Release what `configure` acquired."""

    def autostart(self) -> None:
        """Configure and activate.

        Raises:
            AuroraError: A transition failed.
        """
        for transition in (self.trigger_configure, self.trigger_activate):
            if transition() != TransitionCallbackReturn.SUCCESS:
                if isinstance(self._first_error, AuroraError):
                    raise self._first_error
                raise ExecutionError(
                    f'{self.get_name()} did not start: {self._first_error!r}',
                    component=self.get_name(),
                )

    @property
    def is_active(self) -> bool:
        """Whether the node serves."""
        return self._active

    def require_active(self) -> None:
        """Refuse a call while the node is not active.

        Raises:
            ExecutionError: With the transition that is missing.
        """
        if not self._active:
            raise ExecutionError(
                f'{self.get_name()} is not active',
                component=self.get_name(),
                hint=f'ros2 lifecycle set /{NAMESPACE}/{self.get_name()} activate',
            )

    def check_presence(self) -> None:
        """Answer a roll call: only an active node is of use.

        Raises:
            ExecutionError: It is not active.
        """
        self.require_active()

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `configure`."""
        self._permanent = self._endpoints()
        return self._transition(self.configure)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `activate`."""
        result = self._transition(self.activate)
        self._active = result == TransitionCallbackReturn.SUCCESS
        return result

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `deactivate`."""
        self._active = False
        return self._transition(self.deactivate)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `cleanup` and destroy the endpoints that `configure` made."""
        return self._transition(self._clean_up)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `deactivate` and `cleanup`."""
        self._active = False
        self._transition(self.deactivate)
        return self._transition(self._clean_up)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Run `cleanup` after a defect; the node can be configured again."""
        self._active = False
        return self._transition(self._clean_up)

    def log_defect(self) -> None:
        """Log the traceback of the exception that is being handled."""
        self.get_logger().error(traceback.format_exc())

    def destroy_node(self) -> None:
        """Release everything and destroy the node."""
        self.heartbeat.close()
        self._active = False
        self._transition(self.deactivate)
        self._transition(self.cleanup)
        super().destroy_node()

    def _clean_up(self) -> None:
        self.cleanup()
        for endpoint, destroy in self._endpoints().items():
            if endpoint not in self._permanent and endpoint is not self.roll_call_service:
                destroy(endpoint)

    def _endpoints(self) -> dict[Any, Callable[[Any], Any]]:
        """Return every endpoint that there is now, with what destroys it."""
        found: dict[Any, Callable[[Any], Any]] = {}
        for endpoints, destroy in (
            (self.publishers, self.destroy_publisher),
            (self.subscriptions, self.destroy_subscription),
            (self.services, self.destroy_service),
            (self.clients, self.destroy_client),
            (self.timers, self.destroy_timer),
        ):
            found.update(dict.fromkeys(endpoints, destroy))
        for waitable in self.waitables:
            if isinstance(waitable, ActionServer | ActionClient):
                found[waitable] = lambda action: action.destroy()
        return found

    def _transition(self, action: Callable[[], None]) -> TransitionCallbackReturn:
        try:
            action()
        except AuroraError as err:
            self._first_error = self._first_error or err
            self.get_logger().error(f'{err.component}: {err}')
            return TransitionCallbackReturn.FAILURE
        except Exception as err:  # noqa: BLE001 - logged; the transition fails with ERROR
            self._first_error = self._first_error or err
            self.log_defect()
            return TransitionCallbackReturn.ERROR
        return TransitionCallbackReturn.SUCCESS
