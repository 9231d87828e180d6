# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a trace as the recorder would: every digest is that of what is in the bag."""

from __future__ import annotations

import shutil
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from mcap.records import Schema

from aurora_bench.mutation.mutant import Mutant
from aurora_core.agsg.message import agsg_message
from aurora_core.trace import messages
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.messages import MessageBuilder, time_ns
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.tick_encoding import TickEncoder

_RUN_NUMBER = 1
# A topic that no trace has.
_OTHER = '/somebody/else'


def write_bag(
    mutant: Mutant, folder: Path, definitions: MessageDefinitions, *, other_topics: bool = False
) -> Path:
    """Return the folder of a new bag; it takes the place of the one before.

    Args:
        mutant: What to write.
        folder: Where.
        definitions: Layouts of the messages.
        other_topics: With messages of somebody else among them.
    """
    bag = folder / mutant.base.bag.name
    shutil.rmtree(bag, ignore_errors=True)
    dt_s = mutant.base.trace.roster.dt_s
    with BagWriter(bag, definitions) as writer:
        if other_topics:
            schema = Schema(
                id=0, name='std_msgs/msg/String', encoding='ros2msg', data=b'string data'
            )
            writer.define(_OTHER, schema)
        for topic, tick, cdr in _messages(mutant, definitions):
            writer.write(topic, messages.TOPICS[topic], cdr, time_ns(tick, dt_s))
            if other_topics and tick % 50 == 0:
                text = b'\0\1\0\0\6\0\0\0hello\0'
                writer.write(_OTHER, 'std_msgs/msg/String', text, time_ns(tick, dt_s))
    return bag


def _messages(mutant: Mutant, definitions: MessageDefinitions) -> Iterator[tuple[str, int, bytes]]:
    trace, dt_s = mutant.trace, mutant.base.trace.roster.dt_s
    build = MessageBuilder(definitions, _RUN_NUMBER, dt_s)
    encode = TickEncoder(definitions, _RUN_NUMBER, dt_s)
    header = build.header(0)

    def put(topic: str, tick: int, message: Any) -> tuple[str, int, bytes]:
        return topic, tick, definitions.encode(messages.TOPICS[topic], message)

    yield put(messages.AGSG, 0, agsg_message(definitions.create, header, 'run', mutant.agsg))
    yield put(messages.ROSTER, 0, build.roster('run', trace.roster))
    yield put(messages.WORLD, 0, world_message(definitions, header, 'run', mutant.world))

    last = trace.ticks - 1
    links, sights, events = (
        _by_tick(records, last) for records in (trace.links, trace.sights, trace.events)
    )
    for tick in range(trace.ticks):
        if tick not in trace.missing_ticks:
            yield from (
                (topic, tick, encode.rows(topic, tick, rows[tick]))
                for topic, rows in (
                    (messages.GROUND_STATE, trace.ground),
                    (messages.UAV_STATE, trace.uav),
                )
            )
        yield from (put(messages.COMM, tick, build.link(r)) for r in links.get(tick, ()))
        yield from (put(messages.SENSING, tick, build.sight(r)) for r in sights.get(tick, ()))
        yield from (put(messages.EVENTS, tick, build.event(r)) for r in events.get(tick, ()))
        after = tick + 1
        if after < trace.ticks:
            commands = trace.ground_commands[after]
            yield messages.GROUND_COMMAND, after, encode.ground_commands(after, commands)
            rows = encode.rows(messages.UAV_COMMAND, after, trace.uav_commands[after])
            yield messages.UAV_COMMAND, after, rows


def _by_tick(records: Iterable[Any], last: int) -> dict[int, list[Any]]:
    """Return the records by the tick to write them at: what claims to be later comes last."""
    by_tick: dict[int, list[Any]] = {}
    for record in records:
        by_tick.setdefault(min(record.tick, last), []).append(record)
    return by_tick
