# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signs of life: published by every node, watched by those who wait for others.

Everything here runs on steady time: a timer on simulated time would stop with `/clock`.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable

from rclpy.event_handler import QoSLivelinessChangedInfo, SubscriptionEventCallbacks
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from aurora_msgs.msg import Heartbeat
from aurora_ros import interfaces
from aurora_ros.qos import LIVELINESS_LEASE_S

PERIOD_S = 0.5


class HeartbeatPublisher:
    """Publishes one node's sign of life from a thread of its own.

    Args:
        node: Its name is the name in the message.
    """

    def __init__(self, node: Node) -> None:
        topic = interfaces.HEARTBEAT
        self._publisher = node.create_publisher(topic.type, topic.name, topic.qos)
        self._message = Heartbeat(node=node.get_name(), state=Heartbeat.IDLE)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name='heartbeat', daemon=True)
        self._thread.start()

    def busy(self, run_number: int) -> None:
        """Say that a run has begun."""
        self._message.state = Heartbeat.BUSY
        self._message.run_number = run_number
        self._message.detail = ''

    def at(self, tick: int) -> None:
        """Say which tick was handled last."""
        self._message.tick = tick

    def idle(self) -> None:
        """Say that no run is going on."""
        self._message.state = Heartbeat.IDLE
        self._message.tick = 0
        self._message.detail = ''

    def failed(self, detail: str) -> None:
        """Say that the node failed and why."""
        self._message.state = Heartbeat.FAILED
        self._message.detail = detail

    def close(self) -> None:
        """Stop the thread."""
        self._stop.set()
        self._thread.join(timeout=PERIOD_S)

    def _run(self) -> None:
        while True:
            try:
                self._publisher.publish(self._message)
            except (InvalidHandle, rclpy_implementation.RCLError):
                return  # the node is being shut down under us
            if self._stop.wait(PERIOD_S):
                return


class HeartbeatWatch:
    """Knows which nodes are alive.

    The middleware tells within the liveliness lease that somebody went away, but not who; the
    messages tell who. A node counts as dead when it is silent for longer than the lease and the
    middleware has lost a publisher since it was heard last.

    Args:
        node: Subscribes for it.
        clock: Steady seconds.
    """

    def __init__(self, node: Node, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._heard: dict[str, float] = {}
        self._lost_at = float('-inf')
        topic = interfaces.HEARTBEAT
        self._subscription = node.create_subscription(
            topic.type,
            topic.name,
            self._on_heartbeat,
            topic.qos,
            event_callbacks=SubscriptionEventCallbacks(liveliness=self._on_liveliness),
        )

    def is_dead(self, name: str) -> bool:
        """Return whether a node that was heard before has gone."""
        heard = self._heard.get(name)
        if heard is None:
            return False
        silent_s = self._clock() - heard
        return silent_s > LIVELINESS_LEASE_S + PERIOD_S and self._lost_at > heard

    def hear(self, name: str) -> None:
        """Take in any sign of life: a heartbeat, or the answer to a call."""
        self._heard[name] = self._clock()

    def _on_heartbeat(self, message: Heartbeat) -> None:
        self.hear(message.node)

    def _on_liveliness(self, info: QoSLivelinessChangedInfo) -> None:
        if info.alive_count_change < 0 or info.not_alive_count_change > 0:
            self._lost_at = self._clock()
