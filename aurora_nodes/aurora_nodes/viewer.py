# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run aurora_nodes viewer`: standard topics of the run that is going on, or of a replay.

It belongs to no run: it is started by whoever wants to look, and a graph without it is as fast as
it was. It only listens, best effort, so that nobody ever waits for it; what it misses it leaves
out. Nothing that it publishes is recorded or judged.
"""

from __future__ import annotations

import sys
import time
from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.publisher import Publisher

from aurora_core.knowledge.world import WorldModel
from aurora_core.report.standard_messages import TF_MESSAGE, Moment, Said, StandardMessages
from aurora_core.trace import messages
from aurora_core.trace.layout import GROUND_WIDTH, UAV_WIDTH
from aurora_core.trace.messages_world import read_world
from aurora_core.trace.records import EventRecord, LinkEventKind, LinkRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import FloatArray
from aurora_ros import interfaces as on
from aurora_ros import qos
from aurora_ros.conversions.messages import message_class
from aurora_ros.interfaces import NAMESPACE, Topic
from aurora_ros.parameters import declare, require_positive

# States of one tick whose others have not come are kept for so many ticks.
_KEPT_TICKS = 100
# What moves is shown for so long unless it moves on, ns of simulated time.
_SHOWN_NS = 1_000_000_000


@dataclass(frozen=True, kw_only=True)
class ViewerSettings:
    """See `config/viewer.param.yaml`."""

    rate_hz: float
    scene_s: float

    def __post_init__(self) -> None:
        require_positive(self, 'rate_hz', 'scene_s')


def make_message(kind: str, /, **fields: Any) -> Any:
    """Return a message of a generated class; bytes are what these classes take for them."""
    if kind == TF_MESSAGE and not has_transforms():
        return None
    for name, value in fields.items():
        if isinstance(value, np.ndarray) and value.dtype == np.uint8:
            fields[name] = array('B', value.tobytes())
    if kind == 'diagnostic_msgs/msg/DiagnosticStatus':
        fields['level'] = bytes([fields['level']])
    return message_class(kind)(**fields)


@cache
def has_transforms() -> bool:
    """Whether there is a class for /tf: no wheel brings tf2_msgs along."""
    try:
        message_class(TF_MESSAGE)
    except ImportError:
        return False
    return True


class Viewer(Node):
    """Turns the states of a run into standard topics."""

    def __init__(self) -> None:
        # A plain node: who beats the heart of the graph would be one of its writers.
        super().__init__('viewer', namespace=NAMESPACE)
        self._settings = declare(self, 'viewer', ViewerSettings)
        self._outlets: dict[str, Publisher] = {}
        self._rosters: dict[str, Roster] = {}
        self._worlds: dict[str, WorldModel] = {}
        self._roster: Roster | None = None
        self._said: StandardMessages | None = None
        self._forget()
        for topic, heard in (
            (on.ROSTER, self._on_roster),
            (on.WORLD, self._on_world),
        ):
            self.create_subscription(topic.type, topic.name, heard, topic.qos)
        for topic, heard in (
            (on.GROUND_STATE, self._on_ground),
            (on.UAV_STATE, self._on_uav),
            (on.COMM, self._on_link),
            (on.SENSING, self._on_sight),
            (on.EVENTS, self._on_event),
        ):
            self._listen(topic, heard)
        self.create_timer(self._settings.scene_s, self._tell_scene)
        if not has_transforms():
            self.get_logger().warning('tf2_msgs is not installed: /tf is left out')

    def _listen(self, topic: Topic, heard: Any) -> None:
        self.create_subscription(topic.type, topic.name, heard, qos.GLIMPSE)

    def _forget(self) -> None:
        self._run_number = -1
        self._parts: dict[int, dict[str, FloatArray]] = {}
        self._seen: dict[tuple[str, str], bool] = {}
        self._sent: list[LinkRecord] = []
        self._happened: list[EventRecord] = []
        self._next_s = 0.0

    def _on_roster(self, message: Any) -> None:
        self._rosters = {message.run_id: messages.read_roster(message)}
        self._begin(message.run_id)

    def _on_world(self, message: Any) -> None:
        self._worlds = {message.run_id: read_world(message)}
        self._begin(message.run_id)

    def _begin(self, run_id: str) -> None:
        """Begin with a run once both roster and world of it are known."""
        roster, world = self._rosters.get(run_id), self._worlds.get(run_id)
        if roster is None or world is None:
            return
        self._forget()
        self._roster = roster
        self._said = StandardMessages(make_message, roster, world, shown_ns=_SHOWN_NS)
        # All of them now: who looks is found before the run begins.
        for topic, kind in self._said.topics().items():
            if topic not in self._outlets and (kind != TF_MESSAGE or has_transforms()):
                self._outlets[topic] = self.create_publisher(message_class(kind), topic, qos.VIEW)
        self._tell_scene()

    def _tell_scene(self) -> None:
        if self._said is not None:
            self._publish(self._said.scene())

    def _on_ground(self, message: Any) -> None:
        self._part(message, 'ground', GROUND_WIDTH)

    def _on_uav(self, message: Any) -> None:
        self._part(message, 'uav', UAV_WIDTH)

    def _part(self, message: Any, what: str, width: int) -> None:
        """Keep the states of a tick; say the moment once both are there."""
        if self._roster is None:
            return
        if message.run_number != self._run_number:
            # What was claimed before the first states of a run belongs to it.
            if self._run_number >= 0:
                self._forget()
            self._run_number = message.run_number
        tick = int(message.tick)
        parts = self._parts.setdefault(tick, {})
        parts[what] = messages.read_rows(message, width)
        if not self._roster.uavs:
            parts['uav'] = np.zeros((0, UAV_WIDTH))
        if not self._roster.agents:
            parts['ground'] = np.zeros((0, GROUND_WIDTH))
        if len(parts) == 2:
            self._say(messages.time_ns(tick, self._roster.dt_s), parts)
            # Older ones never become whole.
            self._parts = {t: p for t, p in self._parts.items() if t > tick}
        elif len(self._parts) > _KEPT_TICKS:
            self._parts.pop(min(self._parts))

    def _say(self, time_ns: int, parts: dict[str, FloatArray]) -> None:
        now_s = time.monotonic()
        if self._said is None or self._roster is None or now_s < self._next_s:
            return
        counts = len(parts['ground']), len(parts['uav'])
        if counts != (len(self._roster.agents), len(self._roster.uavs)):
            return
        self._next_s = now_s + 1.0 / self._settings.rate_hz
        moment = Moment(
            time_ns=time_ns,
            ground=parts['ground'],
            uav=parts['uav'],
            sent=tuple(self._sent),
            seen=dict(self._seen),
            happened=tuple(self._happened),
        )
        self._sent.clear()
        self._happened.clear()
        for said in self._said.at(moment):
            self._publish(said)

    def _publish(self, said: Said) -> None:
        topic, _, message = said
        if topic in self._outlets:
            self._outlets[topic].publish(message)

    def _on_link(self, message: Any) -> None:
        record = messages.read_link(message)
        if record.kind is LinkEventKind.SENT:
            self._sent.append(record)

    def _on_sight(self, message: Any) -> None:
        sight = messages.read_sight(message)
        self._seen[(sight.observer, sight.target)] = sight.visible

    def _on_event(self, message: Any) -> None:
        self._happened.append(messages.read_event(message))


def main(arguments: Sequence[str] | None = None) -> int:
    """Serve until Ctrl-C or SIGTERM; exit code 0."""
    rclpy.init(args=list(arguments) if arguments is not None else sys.argv)
    try:
        rclpy.spin(Viewer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
    return 0


if __name__ == '__main__':
    sys.exit(main())
