# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`AuroraNode`: a plain node with heartbeat and services whose errors travel as codes."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import Any, TypeVar

from rclpy.callback_groups import CallbackGroup, ReentrantCallbackGroup
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.service import Service
from rclpy.subscription import Subscription

from aurora_core.errors import AuroraError
from aurora_ros.errors import write_error
from aurora_ros.heartbeat import HeartbeatPublisher
from aurora_ros.interfaces import NAMESPACE, Call, Topic, roll_call

_Request = TypeVar('_Request')
_Response = TypeVar('_Response')


class EndpointsMixin:
    """Create endpoints from the interface table instead of by name, type and QoS."""

    roll_call_service: Service | None = None

    def publisher(self: Any, topic: Topic) -> Publisher:
        """Return a publisher of a topic."""
        created: Publisher = self.create_publisher(topic.type, topic.name, topic.qos)
        return created

    def subscription(
        self: Any,
        topic: Topic,
        callback: Callable[[Any], None],
        *,
        raw: bool = False,
        group: CallbackGroup | None = None,
    ) -> Subscription:
        """Return a subscription of a topic; `raw` gives the bytes as they came off the wire."""
        created: Subscription = self.create_subscription(
            topic.type, topic.name, callback, topic.qos, raw=raw, callback_group=group
        )
        return created

    @property
    def awaited(self) -> Subscription | None:
        """The one subscription without whose next message the node cannot go on.

        Messages of others need not wake it meanwhile. None: any message matters.
        """
        return None

    def request_stop(self) -> None:
        """Begin to end what is under way; the node still serves until `is_idle`."""

    @property
    def is_idle(self) -> bool:
        """Whether nothing is under way that should be brought to an end before the exit."""
        return True

    def check_presence(self) -> None:
        """Answer a roll call: a node without anything behind it is present by answering.

        Raises:
            AuroraError: Something that a run needs of this node is missing.
        """

    def serve_roll_call(self: Any) -> None:
        """Answer roll calls; the last endpoint to be made, so who reaches it reaches all."""
        call = roll_call(self.get_name())

        def answer(_request: Any, response: Any) -> Any:
            self.check_presence()
            return response

        self.roll_call_service = self.create_service(
            call.type, call.name, answering(self, answer), callback_group=ReentrantCallbackGroup()
        )

    def serve(
        self: Any,
        call: Call,
        handler: Callable[[_Request, _Response], _Response],
        *,
        group: CallbackGroup | None = None,
    ) -> None:
        """Serve a service; an `AuroraError` becomes the response's code and text."""
        self.create_service(call.type, call.name, answering(self, handler), callback_group=group)


class AuroraNode(EndpointsMixin, Node):
    """A plain node of the graph.

    Args:
        name: Node name inside the namespace `aurora`.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name, namespace=NAMESPACE)
        self.heartbeat = HeartbeatPublisher(self)

    def destroy_node(self) -> None:
        """Stop the heartbeat and destroy the node."""
        self.heartbeat.close()
        super().destroy_node()


def answering(
    node: Node, handler: Callable[[_Request, _Response], _Response]
) -> Callable[[_Request, _Response], _Response]:
    """Wrap a service handler so that the caller always gets an answer."""

    def callback(request: _Request, response: _Response) -> _Response:
        try:
            return handler(request, response)
        except AuroraError as err:
            node.get_logger().error(f'{err.component}: {err}')
            write_error(response, err)
        except Exception as err:  # noqa: BLE001 - a defect: logged here, and the caller is told
            node.get_logger().error(traceback.format_exc())
            write_error(response, defect(err, node.get_name()))
        return response

    return callback


def defect(err: Exception, component: str) -> AuroraError:
    """Return an exception that nobody expected as an error of a component."""
    return AuroraError(
        f'{type(err).__name__}: {err}',
        component=component,
        hint=f'this is a defect of AURORA; the traceback is in the log of {component}',
    )
