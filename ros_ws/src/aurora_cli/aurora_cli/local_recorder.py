# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a run in one process as the recorder of the graph would."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain, starmap

from aurora_core.agsg.message import agsg_message
from aurora_core.execution.step_output import StepOutput
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.agsg import Agsg
from aurora_core.ports.simulators import FloatArray
from aurora_core.trace import messages
from aurora_core.trace.bag_writer import SYNC_NS, BagWriter, Message
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.messages import MessageBuilder, time_ns
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.roster import Roster
from aurora_core.trace.tick_encoding import TickEncoder

# One run per bag: the stamp that tells runs of a graph apart is constant here.
_RUN_NUMBER = 1
# Topics of every tick, and what goes over them.
_GROUND_STATE, _UAV_STATE = messages.GROUND_STATE, messages.UAV_STATE
_GROUND_COMMAND, _UAV_COMMAND = messages.GROUND_COMMAND, messages.UAV_COMMAND
_GROUND_STATE_TYPE, _UAV_STATE_TYPE, _GROUND_COMMAND_TYPE, _UAV_COMMAND_TYPE = (
    messages.TOPICS[topic] for topic in (_GROUND_STATE, _UAV_STATE, _GROUND_COMMAND, _UAV_COMMAND)
)


class LocalRecorder:
    """Writes the messages of a run as the ROS recorder would, some ticks at a time.

    Ticks are encoded together, as many as leave the process together anyway: between two steps
    of the simulators each of them would find the caches full of something else.
    """

    def __init__(self, writer: BagWriter, definitions: MessageDefinitions, dt_s: float) -> None:
        self._writer = writer
        self._definitions = definitions
        self._build = MessageBuilder(definitions, _RUN_NUMBER, dt_s)
        self._encode = TickEncoder(definitions, _RUN_NUMBER, dt_s)
        self._dt = dt_s
        self._ticks: list[tuple[int, FloatArray, FloatArray, StepOutput]] = []
        self._together = max(1, round(SYNC_NS / 1e9 / dt_s))

    def prologue(
        self, run_id: str, roster: Roster, world: WorldModel, agsg: Agsg | None = None
    ) -> None:
        """Write graph, roster and world.

        Args:
            run_id: Of the run.
            roster: Who takes part.
            world: Of the run.
            agsg: What is executed; None: no graph is, so nothing says what was to happen.
        """
        header, create = self._build.header(0), self._definitions.create
        if agsg is not None:
            graph = agsg_message(create, header, run_id, agsg)
            self._writer.write_all([self._message(messages.AGSG, 0, graph)])
        self._writer.write_all(
            self._message(topic, 0, value)
            for topic, value in (
                (messages.ROSTER, self._build.roster(run_id, roster)),
                (messages.WORLD, world_message(self._definitions, header, run_id, world)),
            )
        )

    def add(self, tick: int, ground: FloatArray, uav: FloatArray, output: StepOutput) -> None:
        """Take the states of a tick, its records and the commands for the next one.

        The arrays are kept for a while, so they must not change afterwards.
        """
        self._ticks.append((tick, ground, uav, output))
        # The first tick and each phase of a mission are out at once.
        if tick == 0 or output.events or len(self._ticks) >= self._together:
            self.close()

    def close(self) -> None:
        """Write what was taken and is not written yet; more may come."""
        if self._ticks:
            ticks, self._ticks = self._ticks, []
            self._writer.write_all(chain.from_iterable(starmap(self._messages, ticks)))

    def _messages(
        self, tick: int, ground: FloatArray, uav: FloatArray, output: StepOutput
    ) -> Iterator[Message]:
        """Yield the messages of a tick in the order in which the graph sends them."""
        encode, has_uavs = self._encode, len(uav) > 0
        at_ns = time_ns(tick, self._dt)
        yield _GROUND_STATE, _GROUND_STATE_TYPE, encode.rows(_GROUND_STATE, tick, ground), at_ns
        if has_uavs:
            yield _UAV_STATE, _UAV_STATE_TYPE, encode.rows(_UAV_STATE, tick, uav), at_ns
        for link in output.links:
            yield self._message(messages.COMM, tick, self._build.link(link))
        for sight in output.sights:
            yield self._message(messages.SENSING, tick, self._build.sight(sight))
        for event in output.events:
            yield self._message(messages.EVENTS, tick, self._build.event(event))
        after = tick + 1
        at_ns = time_ns(after, self._dt)
        cdr = encode.ground_commands(after, output.ground_commands)
        yield _GROUND_COMMAND, _GROUND_COMMAND_TYPE, cdr, at_ns
        if has_uavs:
            cdr = encode.rows(_UAV_COMMAND, after, output.uav_commands)
            yield _UAV_COMMAND, _UAV_COMMAND_TYPE, cdr, at_ns

    def _message(self, topic: str, tick: int, value: object) -> Message:
        cdr = self._definitions.encode(messages.TOPICS[topic], value)
        return topic, messages.TOPICS[topic], cdr, time_ns(tick, self._dt)
