# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Signs of life: published by every node, watched by those who wait for others.

Everything here runs on steady time: a timer on simulated time would stop with `/clock`.
"""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from rclpy.callback_groups import CallbackGroup
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.event_handler import QoSLivelinessChangedInfo, QoSSubscriptionEventType
from rclpy.exceptions import InvalidHandle
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node

from aurora_msgs.msg import Heartbeat
from aurora_ros import interfaces
from aurora_ros.polling import PolledGroup, drain
from aurora_ros.processes import ProcessState, is_dumping_core, pid_space, process_state
from aurora_ros.qos import HEARTBEATS_HEARD, LIVELINESS_LEASE_S

PERIOD_S = 0.5
# Between two looks at what others said: half of their period, far below the lease.
_LOOK_S = 0.25


class HeartbeatPublisher:
    """Publishes one node's sign of life from a thread of its own, once `start` was called.

    Args:
        node: Its name is the name in the message.
    """

    def __init__(self, node: Node) -> None:
        topic = interfaces.HEARTBEAT
        self._publisher = node.create_publisher(topic.type, topic.name, topic.qos)
        self._message = Heartbeat(
            node=node.get_name(), state=Heartbeat.IDLE, pid=os.getpid(), pid_space=pid_space()
        )
        self._steps = 0
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name='heartbeat', daemon=True)

    def start(self) -> None:
        """Begin to publish; the node is complete and serves from now on."""
        if not self._thread.is_alive() and not self._stop.is_set():
            self._thread.start()

    def busy(self, run_number: int) -> None:
        """Say that a run has begun, at once: whoever is called next knows of which run it is."""
        self._message.state = Heartbeat.BUSY
        self._message.run_number = run_number
        self._message.detail = ''
        if self._thread.is_alive():
            self._say()

    def at(self, tick: int) -> None:
        """Say which tick was handled last."""
        self._message.tick = tick

    def came_further(self) -> None:
        """Say that work for which there is no tick goes on: whoever waits for it goes on, too."""
        self._steps += 1
        self._message.detail = f'step {self._steps} of its work'

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
        if self._thread.is_alive():
            self._thread.join(timeout=PERIOD_S)

    def _run(self) -> None:
        while not self._stop.is_set() and self._say():
            self._stop.wait(PERIOD_S)

    def _say(self) -> bool:
        """Publish; return whether that is still possible."""
        try:
            self._publisher.publish(self._message)
        except (InvalidHandle, rclpy_implementation.RCLError):
            return False  # the node is being shut down under us
        return True


@dataclass(slots=True)
class _Heard:
    """What is known of one node.

    Attributes:
        at_s: Steady time of the last sign of life.
        pid: Process id, 0 when the process cannot be looked at from here.
        started: Start time of the process, to tell it from a later one with its id; 0 when it
            had ended before it could be looked at.
        further_s: Steady time at which it said last that its work has come further.
        detail: What it said then.
        busy: Whether the last heartbeat said so.
        run_number: That the last heartbeat named.
    """

    at_s: float
    pid: int = 0
    started: int = 0
    further_s: float = float('-inf')
    detail: str = ''
    busy: bool = False
    run_number: int = 0


class HeartbeatWatch:
    """Knows which nodes are alive.

    Of a process that shares our process ids the kernel tells at once whether it has ended or was
    stopped. Of any other, the middleware tells within the liveliness lease that somebody went
    away, but not who; the messages tell who: dead is who is silent for longer than the lease
    while the middleware has lost a publisher since it was heard last.

    Args:
        node: Subscribes for it.
        clock: Steady seconds.
        group: Callback group of the subscription.
        look: Gives the state of a process.
        dumps: Tells whether a process has crashed and is being written to a core file.
    """

    def __init__(
        self,
        node: Node,
        clock: Callable[[], float] = time.monotonic,
        *,
        group: CallbackGroup | None = None,
        look: Callable[[int], ProcessState | None] = process_state,
        dumps: Callable[[int], bool] = is_dumping_core,
    ) -> None:
        self._clock = clock
        self._look = look
        self._dumps = dumps
        self._heard: dict[str, _Heard] = {}
        self._lost_at_s = float('-inf')
        topic = interfaces.HEARTBEAT
        self._subscription = node.create_subscription(
            topic.type,
            topic.name,
            self._on_heartbeat,
            HEARTBEATS_HEARD,
            # A dozen nodes speak twice a second each, and an executor that wakes for every word
            # of theirs does little else in a graph at rest. So they are taken together, by a
            # timer and by whoever asks.
            callback_group=PolledGroup(),
        )
        handle = self._subscription.handle
        with handle:
            self._liveliness = rclpy_implementation.EventHandle(
                handle, QoSSubscriptionEventType.RCL_SUBSCRIPTION_LIVELINESS_CHANGED
            )
        self._taking = threading.Lock()
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node.create_timer(_LOOK_S, self.look, callback_group=group, clock=steady)

    def is_dead(self, name: str) -> bool:
        """Return whether a node that was heard before has ended, was stopped or has gone."""
        return bool(self.cause_of_death(name))

    def cause_of_death(self, name: str) -> str:
        """Return what happened to a node that was heard before; empty while it lives."""
        self.look()
        heard = self._heard.get(name)
        if heard is None:
            return ''
        silent_s = self._clock() - heard.at_s
        silent = silent_s > LIVELINESS_LEASE_S + PERIOD_S
        if not heard.pid:
            return 'fell silent' if silent and self._lost_at_s > heard.at_s else ''
        state = self._look(heard.pid)
        if state is None or state.started != heard.started:
            return f'died (process {heard.pid})'
        # Somebody who looks at it with a debugger for a moment does no harm.
        if silent and state.stopped:
            return f'was stopped (process {heard.pid})'
        return f'crashed (process {heard.pid})' if silent and self._dumps(heard.pid) else ''

    def was_heard(self, name: str) -> bool:
        """Return whether a node has ever given a sign of life."""
        self.look()
        return name in self._heard

    def heard_since(self, name: str, since_s: float) -> bool:
        """Return whether a node has given a sign of life after a steady time."""
        self.look()
        heard = self._heard.get(name)
        return heard is not None and heard.at_s > since_s

    def is_busy(self, name: str) -> bool:
        """Return whether a node said last that a run is going on."""
        self.look()
        heard = self._heard.get(name)
        return heard is not None and heard.busy

    def run_number(self, name: str) -> int:
        """Return the run that a node said last is going on, 0 when none is."""
        self.look()
        heard = self._heard.get(name)
        return heard.run_number if heard is not None and heard.busy else 0

    def process(self, name: str) -> tuple[int, int]:
        """Return process id and start time of a node, (0, 0) when they are not known."""
        self.look()
        heard = self._heard.get(name)
        return (heard.pid, heard.started) if heard is not None else (0, 0)

    def came_further_s(self, name: str) -> float:
        """Return the steady time at which a node said last that long work of it goes on."""
        self.look()
        heard = self._heard.get(name)
        return float('-inf') if heard is None else heard.further_s

    def hear(self, name: str) -> None:
        """Take in any sign of life: a heartbeat, or the answer to a call."""
        heard = self._heard.get(name)
        if heard is None:
            self._heard[name] = _Heard(self._clock())
        else:
            heard.at_s = self._clock()

    def look(self) -> None:
        """Hear what has arrived; whoever comes meanwhile waits until it was heard.

        Heard is when it was looked for: who compares that with a moment looks at that moment.
        """
        with self._taking, suppress(InvalidHandle, rclpy_implementation.RCLError):
            # Nothing is heard any more while the node is being shut down.
            for message in drain(self._subscription):
                self._on_heartbeat(message)
            with self._liveliness:
                info = self._liveliness.take_event()
            if info is not None:
                self._on_liveliness(info)

    def _on_heartbeat(self, message: Heartbeat) -> None:
        self.hear(message.node)
        heard = self._heard[message.node]
        heard.busy = message.state == Heartbeat.BUSY
        heard.run_number = int(message.run_number)
        if message.detail and message.detail != heard.detail:
            heard.detail, heard.further_s = message.detail, heard.at_s
        pid = int(message.pid) if message.pid_space and message.pid_space == pid_space() else 0
        if pid != heard.pid:
            state = self._look(pid) if pid else None
            heard.pid, heard.started = pid, state.started if state is not None else 0

    def _on_liveliness(self, info: QoSLivelinessChangedInfo) -> None:
        if info.alive_count_change < 0 or info.not_alive_count_change > 0:
            self._lost_at_s = self._clock()
