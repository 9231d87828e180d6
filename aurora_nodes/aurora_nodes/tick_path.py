# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The executor's part of a tick: states in, one pure step, commands and records out."""

from __future__ import annotations

import threading
import traceback
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from rclpy.publisher import Publisher
from rclpy.subscription import Subscription

from aurora_core.errors import AuroraError, ParticipantSilentError
from aurora_core.execution.step_output import StepOutput, Stepper
from aurora_core.trace.layout import GROUND_WIDTH, UAV_WIDTH
from aurora_core.trace.messages import MessageBuilder
from aurora_msgs.msg import (
    Fault,
    GroundCommand,
    GroundState,
    SyncStatus,
    TickDone,
    UavCommand,
    UavState,
)
from aurora_nodes.state_join import StateJoin
from aurora_ros import interfaces as on
from aurora_ros.account import Account, told
from aurora_ros.conversions.states import Rows, unpack
from aurora_ros.conversions.time import restamp
from aurora_ros.errors import read_error, write_error
from aurora_ros.interfaces import Topic
from aurora_ros.lifecycle import ManagedNode
from aurora_ros.node import defect

GROUND, AIR = 'ground', 'air'
_BRIDGES = {GROUND: 'sumo_bridge', AIR: 'uav_bridge'}
_NO_UAVS = np.zeros((0, UAV_WIDTH))


@dataclass(kw_only=True)
class ActiveRun:
    """A run between `arm` and its end.

    Attributes:
        last_tick: Last tick that was stepped, -1 before the first.
        sent: Messages published for the bag, by full topic name.
        accounts: What each bridge should have done, by `GROUND` and `AIR`.
        ahead: What was told each of them for the next tick.
        flown: The commands to the UAVs.
        none_driven: Of a tick without commands to ground agents.
        stopping: Set to end the run with the next tick, which is then complete as all others.
        outcome: finished or horizon (of the step that ended the scenario), or cancelled.
        ended: Set when sync has finished or failed the run.
        error: Why it failed.
    """

    run_number: int
    dt_s: float
    builder: MessageBuilder
    stepper: Stepper
    has_uavs: bool
    on_tick: Callable[[int], None]
    last_tick: int = -1
    sent: Counter[str] = field(default_factory=Counter)
    accounts: dict[str, Account] = field(default_factory=dict)
    ahead: dict[str, bytes] = field(default_factory=dict)
    flown: Rows[UavCommand] = field(init=False)
    none_driven: GroundCommand = field(init=False)
    stopping: bool = False
    outcome: str = ''
    ended: threading.Event = field(default_factory=threading.Event)
    error: AuroraError | None = None

    def __post_init__(self) -> None:
        """Make the messages of most ticks, which are filled anew for each."""
        self.flown = Rows(UavCommand, self.run_number, self.dt_s)
        self.none_driven = self.builder.ground_commands(0, ())


class TickPath:
    """Subscriptions and publishers of the lockstep, all served by the node's own thread.

    Args:
        node: The executor.
    """

    def __init__(self, node: ManagedNode) -> None:
        self._node = node
        self._run: ActiveRun | None = None
        self._join = StateJoin(0, ())
        self._publishers = {
            topic: node.publisher(topic)
            for topic in (
                on.GROUND_COMMAND,
                on.UAV_COMMAND,
                on.COMM,
                on.SENSING,
                on.EVENTS,
                on.TICK_DONE,
                on.FAULT,
            )
        }
        self._states = {
            GROUND: node.subscription(on.GROUND_STATE, self._on_ground),
            AIR: node.subscription(on.UAV_STATE, self._on_uav),
        }
        node.subscription(on.SYNC_STATUS, self._on_sync_status)

    @property
    def awaited(self) -> Subscription | None:
        """The state that the next step lacks; None between runs."""
        return None if self._run is None else self._states[self._join.missing]

    def listeners(self, with_uavs: bool, *, observers: int) -> dict[Publisher, int]:
        """Return the publishers and how many must listen to each before tick 0.

        Args:
            with_uavs: Whether there are any.
            observers: How many hear all of the run.
        """
        # Commands: bridge and observers; records: observers; done: sync, and who counts the
        # writers here.
        counts = dict.fromkeys((on.COMM, on.SENSING, on.EVENTS), observers)
        counts |= {on.GROUND_COMMAND: 1 + observers, on.TICK_DONE: 1 + 1}
        if with_uavs:
            counts[on.UAV_COMMAND] = 1 + observers
        return {self._publishers[topic]: count for topic, count in counts.items()}

    def arm(self, run: ActiveRun) -> None:
        """Begin to answer the states of a run."""
        self._join = StateJoin(run.run_number, (GROUND, AIR) if run.has_uavs else (GROUND,))
        self._run = run

    def disarm(self) -> None:
        """Ignore every state."""
        self._run = None

    def _on_ground(self, message: GroundState) -> None:
        self._take(GROUND, message, GROUND_WIDTH)

    def _on_uav(self, message: UavState) -> None:
        self._take(AIR, message, UAV_WIDTH)

    def _take(self, source: str, message: GroundState | UavState, width: int) -> None:
        run = self._run
        if run is None or message.run_number != run.run_number:
            return
        try:
            rows = unpack(message.data, width, f'{source} state')
            ready = self._join.put(source, message.run_number, message.tick, rows)
            if ready is None:
                return
            tick, states = ready
            ahead, run.ahead = run.ahead, {}
            output = run.stepper.step(tick, states[GROUND], states.get(AIR, _NO_UAVS))
            self._publish(run, tick, output)
            for name, account in run.accounts.items():
                account.add(ahead.get(name, b''), states[name].data)
        except AuroraError as err:
            self._fail(run, err)
        except Exception as err:  # noqa: BLE001 - a defect: it ends the run, not the node
            self._node.get_logger().error(traceback.format_exc())
            self._fail(run, defect(err, self._node.get_name()))

    def _publish(self, run: ActiveRun, tick: int, output: StepOutput) -> None:
        builder = run.builder
        finished = output.finished or run.stopping
        if not finished:
            # Before the word that the tick is done, so that no bridge has to wait a second time.
            if run.has_uavs:
                flown = run.flown.at(tick + 1, output.uav_commands)
                self._send(run, on.UAV_COMMAND, flown)
                run.ahead[AIR] = told(flown)
            if output.ground_commands:
                commands = builder.ground_commands(tick + 1, output.ground_commands)
            else:
                commands = run.none_driven
                restamp(commands, tick + 1, run.dt_s)
            self._send(run, on.GROUND_COMMAND, commands)
            run.ahead[GROUND] = told(commands)
        self._publishers[on.TICK_DONE].publish(
            TickDone(
                run_number=run.run_number,
                tick=tick,
                participant=self._node.get_name(),
                finished=finished,
            )
        )
        # The clock goes on while the rest is written: nobody's next tick depends on it.
        for link in output.links:
            self._send(run, on.COMM, builder.link(link))
        for sight in output.sights:
            self._send(run, on.SENSING, builder.sight(sight))
        for event in output.events:
            self._send(run, on.EVENTS, builder.event(event))
        run.last_tick = tick
        run.outcome = output.outcome or ('cancelled' if run.stopping else '')
        self._node.heartbeat.at(tick)
        run.on_tick(tick)

    def _send(self, run: ActiveRun, topic: Topic, message: object) -> None:
        self._publishers[topic].publish(message)
        run.sent[topic.full_name] += 1

    def _on_sync_status(self, message: SyncStatus) -> None:
        run = self._run
        if run is None or message.run_number != run.run_number:
            return
        if message.state == SyncStatus.FAILED:
            run.error = self._blame(run, message)
        if message.state in (SyncStatus.FAILED, SyncStatus.FINISHED):
            self.disarm()
            run.ended.set()

    def _blame(self, run: ActiveRun, message: SyncStatus) -> AuroraError | None:
        """Return why sync gave up; the clock knows only that this node was silent, not why."""
        error = read_error(message, message.failed_participant or 'sync')
        lacking = self._join.lacking
        # Of a tick that was stepped the states had come: then this node itself was too slow.
        waited = run.last_tick < message.tick and bool(lacking)
        if waited and message.failed_participant == self._node.get_name():
            name = _BRIDGES[lacking[0]]
            return ParticipantSilentError(
                f'{name} sent no state of tick {message.tick} in time',
                component=name,
                hint=f'see the log of {name}',
            )
        return error

    def _fail(self, run: ActiveRun, err: AuroraError) -> None:
        """Tell sync; the run ends here whether sync hears it or not."""
        self.disarm()
        message = Fault(run_number=run.run_number, node=self._node.get_name())
        write_error(message, err)
        self._publishers[on.FAULT].publish(message)
        run.error = err
        run.ended.set()
