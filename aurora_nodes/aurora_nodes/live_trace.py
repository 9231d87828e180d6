# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LiveTrace`: the ticks of a run that is heard, handed over once they are complete. No ROS.

For the outlook while the run goes on; the verdict is computed from the bytes of the whole run.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from aurora_core.agsg.message import read_agsg
from aurora_core.errors import BagError
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace import messages
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.layout import GROUND_WIDTH, UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_core.trace.messages_world import read_world
from aurora_core.trace.roster import Roster
from aurora_core.trace.tick_encoding import TickDecoder
from aurora_core.trace.trace import FloatArray, Trace
from aurora_nodes.live_run import LiveRun
from aurora_ros import cdr as wire

_STATES = (messages.GROUND_STATE, messages.UAV_STATE)
_COMMANDS = (messages.GROUND_COMMAND, messages.UAV_COMMAND)
_RECORDS = (messages.COMM, messages.SENSING, messages.EVENTS)


@dataclass(frozen=True, slots=True, kw_only=True)
class LiveScene:
    """What a run is about; it is published before tick 0."""

    roster: Roster
    world: WorldModel
    spec: ScenarioSpec
    conditions: tuple[Condition, ...]


class LiveTrace:
    """Turns what a `LiveRun` holds into parts of a trace.

    Args:
        run: The run that is heard.
        definitions: Layouts of the messages.
    """

    def __init__(self, run: LiveRun, definitions: MessageDefinitions) -> None:
        self._run = run
        self._decoder = TickDecoder(definitions)
        self._looked_at: dict[str, int] = {}
        self._at: dict[str, dict[int, Any]] = {topic: {} for topic in (*_STATES, *_COMMANDS)}
        self._records: dict[str, list[Any]] = {topic: [] for topic in _RECORDS}
        self._next = 0

    def scene(self) -> LiveScene | None:
        """Return what the run is about, None while that has not been heard.

        Raises:
            AuroraError: It cannot be read.
        """
        rosters = self._run.since(messages.ROSTER, 0)
        if not rosters:
            return None
        run_id = wire.run_id(rosters[-1])
        found = {}
        for topic in (messages.ROSTER, messages.WORLD, messages.AGSG):
            own = [c for c in self._run.since(topic, 0) if wire.run_id(c) == run_id]
            if not own:
                return None
            found[topic] = self._decoder.decode(messages.TOPICS[topic], own[-1])
        world = read_world(found[messages.WORLD])
        graph = read_agsg(found[messages.AGSG])
        return LiveScene(
            roster=messages.read_roster(found[messages.ROSTER]),
            world=world,
            spec=graph.realised_spec,
            conditions=graph.conditions,
        )

    def next_part(self, roster: Roster, stop: int) -> Trace | None:
        """Return the complete ticks before `stop` that were not handed over yet, None for none.

        Args:
            roster: Of the run.
            stop: First tick that may still lack a claim.

        Raises:
            BagError: A message does not fit the roster.
        """
        for topic in (*self._at, *self._records):
            self._hear(topic)
        first = self._next
        while self._next < stop and self._complete(self._next, roster):
            self._next += 1
        if self._next == first:
            return None
        ticks = range(first, self._next)
        links = self._taken(messages.COMM, _by_sequence)
        sights = self._taken(messages.SENSING, _by_name)
        events = self._taken(messages.EVENTS, _by_sequence)
        ground, uav = messages.GROUND_STATE, messages.UAV_STATE
        flown = messages.UAV_COMMAND
        driven = self._at[messages.GROUND_COMMAND]
        part = Trace(
            roster=roster,
            ground=self._rows(ground, ticks, len(roster.agents), GROUND_WIDTH),
            uav=self._rows(uav, ticks, len(roster.uavs), UAV_WIDTH),
            uav_commands=self._rows(flown, ticks, len(roster.uavs), UAV_COMMAND_WIDTH),
            ground_commands=tuple(
                messages.read_ground_commands(driven[tick]) if tick else () for tick in ticks
            ),
            links=tuple(map(messages.read_link, links)),
            sights=tuple(map(messages.read_sight, sights)),
            events=tuple(map(messages.read_event, events)),
        )
        for by_tick in self._at.values():
            for tick in ticks:
                by_tick.pop(tick, None)
        return part

    def _hear(self, topic: str) -> None:
        """Decode what has come on a topic since the last look."""
        new = self._run.since(topic, self._looked_at.get(topic, 0))
        self._looked_at[topic] = self._looked_at.get(topic, 0) + len(new)
        for cdr in new:
            if wire.run_and_tick(cdr)[0] != self._run.run_number:
                continue
            message: Any = self._decoder.decode(messages.TOPICS[topic], cdr)
            if topic in self._at:
                self._at[topic].setdefault(int(message.tick), message)
            else:
                self._records[topic].append(message)

    def _complete(self, tick: int, roster: Roster) -> bool:
        needed = [messages.GROUND_STATE]
        needed += [messages.UAV_STATE] if roster.uavs else []
        if tick:  # nothing was commanded to reach tick 0
            needed += [messages.GROUND_COMMAND]
            needed += [messages.UAV_COMMAND] if roster.uavs else []
        return all(tick in self._at[topic] for topic in needed)

    def _rows(self, topic: str, ticks: range, count: int, width: int) -> FloatArray:
        rows = np.zeros((len(ticks), count, width))
        stored = self._at[topic]
        for k, tick in enumerate(ticks):
            if count == 0 or (tick == 0 and topic in _COMMANDS):
                continue
            data = stored[tick].data
            if len(data) != count * width:
                raise BagError(
                    f'{topic}: expected {count * width} numbers at tick {tick}, found {len(data)}'
                )
            rows[k] = np.asarray(data, dtype=np.float64).reshape(count, width)
        return rows

    def _taken(self, topic: str, order: Callable[[Any], Any]) -> list[Any]:
        """Return the records of ticks that are handed over, and forget them."""
        mine = [record for record in self._records[topic] if int(record.tick) < self._next]
        self._records[topic] = [r for r in self._records[topic] if int(r.tick) >= self._next]
        return sorted(mine, key=order)


def _by_sequence(record: Any) -> int:
    return int(record.sequence)


def _by_name(sight: Any) -> tuple[int, str, str]:
    return int(sight.tick), str(sight.observer), str(sight.target)
