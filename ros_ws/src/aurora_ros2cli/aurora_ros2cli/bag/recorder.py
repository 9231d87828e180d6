# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Subscriptions that are drained into a bag.

They are polled instead of waking an executor for each message, which would cost more than
storing it.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from rosgraph_msgs.msg import Clock

from aurora_ros2cli.bag.profiles import DEPTH, stored
from aurora_ros2cli.bag.writer import BagFolder, RecordedTopic
from aurora_ros2cli.errors import CliError
from aurora_ros2cli.graph import is_hidden
from aurora_ros2cli.qos import matching_profile
from aurora_ros2cli.types import load_type

_NS = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class Selection:
    """Which topics are recorded.

    Attributes:
        topics: By full name.
        every: All that are there.
        pattern: Those whose name contains it.
        excluded: Never these.
        excluded_pattern: Never those whose name contains it.
        hidden: Whether hidden topics count among all.
    """

    topics: frozenset[str] = frozenset()
    every: bool = False
    pattern: re.Pattern[str] | None = None
    excluded: frozenset[str] = frozenset()
    excluded_pattern: re.Pattern[str] | None = None
    hidden: bool = False

    def takes(self, topic: str) -> bool:
        """Whether a topic is recorded."""
        if topic in self.excluded:
            return False
        if self.excluded_pattern is not None and self.excluded_pattern.search(topic):
            return False
        if topic in self.topics:
            return True
        if is_hidden(topic) and not self.hidden:
            return False
        return self.every or (self.pattern is not None and bool(self.pattern.search(topic)))


class Recorder:
    """Records topics into a bag.

    Args:
        node: A node that knows the graph.
        output: Folder of the bag; must not exist.
        selection: What to record.
        simulated: Whether messages are stamped with `/clock` instead of their arrival.

    Raises:
        CliError: If the bag cannot be made.
    """

    def __init__(self, node: Node, output: Path, selection: Selection, *, simulated: bool) -> None:
        self._node = node
        self._selection = selection
        self._clock = None
        self._now_ns: int | None = None
        if simulated:
            self._clock = node.create_subscription(
                Clock, '/clock', _never_called, qos_profile_sensor_data
            )
        self._taps: dict[str, Any] = {}
        self._refused: set[str] = set()
        self._bag = BagFolder(output, os.environ.get('ROS_DISTRO', 'unknown'))

    def log(self, text: str) -> None:
        """Tell the user, on standard error."""
        self._node.get_logger().info(text)

    def subscribe(self) -> None:
        """Subscribe every selected topic that somebody publishes and that is not recorded yet."""
        for topic, types in self._node.get_topic_names_and_types():
            if topic in self._taps or topic in self._refused:
                continue
            offers = self._node.get_publishers_info_by_topic(topic)
            if not offers or not self._selection.takes(topic):
                continue
            try:
                self._tap(topic, types, offers)
            except CliError as err:
                self._refused.add(topic)
                self._node.get_logger().warning(f"Topic '{topic}' is not recorded: {err}")
                continue
            self.log(f"Subscribed to topic '{topic}'")

    def _tap(self, topic: str, types: list[str], offers: list[Any]) -> None:
        if len(types) != 1:
            raise CliError(f'it has more than one type: [{", ".join(types)}]')
        message_type = load_type(types[0], types[0].split('/')[1])
        self._bag.add(
            RecordedTopic(
                name=topic,
                type_name=types[0],
                type_hash=str(offers[0].topic_type_hash),
                profiles=tuple(stored(offer.qos_profile) for offer in offers),
            )
        )
        self._taps[topic] = self._node.create_subscription(
            message_type,
            topic,
            _never_called,
            matching_profile(self._node, topic, depth=DEPTH),
            raw=True,
        )

    def drain(self) -> None:
        """Store everything that has arrived."""
        self._follow_clock()
        for topic, tap in self._taps.items():
            with tap.handle:
                while (taken := tap.handle.take_message(tap.msg_type, True)) is not None:
                    data, info = taken
                    log_ns = info['received_timestamp']
                    if self._clock is not None:
                        if self._now_ns is None:
                            continue  # as rosbag2: nothing before the first /clock
                        log_ns = self._now_ns
                    self._bag.write(
                        topic, data, log_ns=log_ns, publish_ns=info['source_timestamp']
                    )

    def flush(self) -> None:
        """Bring everything stored so far to the disk."""
        self._bag.flush()

    def close(self) -> None:
        """Store what has arrived meanwhile and finish the bag."""
        self.drain()
        self._bag.close()
        self.log(f'{self._bag.message_count} messages recorded')

    def _follow_clock(self) -> None:
        if self._clock is None:
            return
        with self._clock.handle:
            while (taken := self._clock.handle.take_message(Clock, False)) is not None:
                self._now_ns = taken[0].clock.sec * _NS + taken[0].clock.nanosec


def _never_called(_message: Any) -> None:
    """Stand where rclpy wants a callback: the subscription is drained instead."""
