# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where do two recorded runs part? Decoded values to the last bit, as the trace hash sees them.

Within a tick the order is that of cause: the commands that lead to it, the states, then what the
executor says about it. Bodies are matched by their ids, not by their rows.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields
from enum import Enum, IntEnum
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.trace import messages
from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn
from aurora_core.trace.roster import RosterEntry
from aurora_core.trace.trace import Trace

Value = float | str | None


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueDifference:
    """One value that is not the same.

    Attributes:
        tick: Where.
        topic: Which stream.
        body: Id of the body (or of the message, event or observer) it belongs to.
        quantity: Which value.
        first: In the first run, None when it is not there.
        second: In the second run.
    """

    tick: int
    topic: str
    body: str
    quantity: str
    first: Value
    second: Value


@dataclass(frozen=True, slots=True, kw_only=True)
class StreamDifference:
    """How much of a stream differs.

    Attributes:
        ticks: Number of ticks with a difference.
        first: The first difference.
    """

    topic: str
    ticks: int
    first: ValueDifference


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceDifference:
    """Everything in which two traces differ.

    Attributes:
        first: The first differing value, None when there is none in the ticks of both.
        streams: Streams with a difference, in order of cause.
        final: Differences of the states at the last tick of both.
        roster: What differs in the rosters: (quantity, first, second).
    """

    first: ValueDifference | None
    streams: tuple[StreamDifference, ...]
    final: tuple[ValueDifference, ...]
    roster: tuple[tuple[str, Value, Value], ...]


def compare_traces(first: Trace, second: Trace) -> TraceDifference:
    """Compare two traces over the ticks that both have."""
    ticks = min(first.ticks, second.ticks)
    agents = _shared(first.roster.agents, second.roster.agents)
    uavs = _shared(first.roster.uavs, second.roster.uavs)
    packed = (
        (messages.UAV_COMMAND, first.uav_commands, second.uav_commands, uavs, UavCommandColumn),
        (messages.GROUND_STATE, first.ground, second.ground, agents, GroundColumn),
        (messages.UAV_STATE, first.uav, second.uav, uavs, UavColumn),
    )
    streams = [_commands(first, second, ticks)]
    streams += [
        _packed(topic, a, b, ticks, rows, columns) for topic, a, b, rows, columns in packed
    ]
    streams += [
        _records(messages.COMM, first.links, second.links, ticks, 'link'),
        _records(messages.SENSING, first.sights, second.sights, ticks, 'observer'),
        _records(messages.EVENTS, first.events, second.events, ticks, 'subject'),
    ]
    found = tuple(stream for stream in streams if stream is not None)
    final: list[ValueDifference] = []
    for topic, a, b, rows, columns in packed[1:]:
        if ticks:
            final += _at(topic, ticks - 1, a, b, rows, columns)
    return TraceDifference(
        first=min((s.first for s in found), key=lambda d: d.tick, default=None),
        streams=found,
        final=tuple(final),
        roster=tuple(_rosters(first, second)),
    )


_Rows = tuple[list[str], list[int], list[int]]


def _shared(first: Sequence[RosterEntry], second: Sequence[RosterEntry]) -> _Rows:
    """Return ids in both rosters with their rows in the first and in the second."""
    theirs = {entry.body_id: row for row, entry in enumerate(second)}
    rows = [
        (entry.body_id, row, theirs[entry.body_id])
        for row, entry in enumerate(first)
        if entry.body_id in theirs
    ]
    return [r[0] for r in rows], [r[1] for r in rows], [r[2] for r in rows]


def _packed(
    topic: str,
    first: npt.NDArray[np.float64],
    second: npt.NDArray[np.float64],
    ticks: int,
    rows: _Rows,
    columns: type[IntEnum],
) -> StreamDifference | None:
    _, ours, theirs = rows
    # As bits: what is no number is equal to itself, and the two zeroes differ.
    a = np.ascontiguousarray(first[:ticks, ours]).view(np.uint64)
    b = np.ascontiguousarray(second[:ticks, theirs]).view(np.uint64)
    differing = np.flatnonzero((a != b).any(axis=(1, 2)))
    if not len(differing):
        return None
    tick = int(differing[0])
    return StreamDifference(
        topic=topic,
        ticks=len(differing),
        first=next(_at(topic, tick, first, second, rows, columns)),
    )


def _at(
    topic: str,
    tick: int,
    first: npt.NDArray[np.float64],
    second: npt.NDArray[np.float64],
    rows: _Rows,
    columns: type[IntEnum],
) -> Iterator[ValueDifference]:
    for name, ours, theirs in zip(*rows, strict=True):
        a, b = first[tick, ours], second[tick, theirs]
        for column in columns:
            if a[column].tobytes() != b[column].tobytes():
                yield ValueDifference(
                    tick=tick,
                    topic=topic,
                    body=name,
                    quantity=column.name.lower(),
                    first=float(a[column]),
                    second=float(b[column]),
                )


def _commands(first: Trace, second: Trace, ticks: int) -> StreamDifference | None:
    def named(trace: Trace) -> Callable[[int], list[tuple[str, dict[str, Value]]]]:
        agents = trace.roster.agents

        def at(tick: int) -> list[tuple[str, dict[str, Value]]]:
            return [
                (
                    agents[c.agent].body_id if c.agent < len(agents) else f'row {c.agent}',
                    {'kind': c.kind.name, 'value': c.value, 'value2': c.value2, 'text': c.text},
                )
                for c in trace.ground_commands[tick]
            ]

        return at

    return _listed(messages.GROUND_COMMAND, named(first), named(second), range(ticks))


def _records(
    topic: str, first: Sequence[Any], second: Sequence[Any], ticks: int, body: str
) -> StreamDifference | None:
    def named(records: Sequence[Any]) -> dict[int, list[tuple[str, dict[str, Value]]]]:
        by_tick: dict[int, list[tuple[str, dict[str, Value]]]] = {}
        for record in records:
            values = {f.name: _value(getattr(record, f.name)) for f in fields(record)}
            by_tick.setdefault(record.tick, []).append((str(getattr(record, body)), values))
        return by_tick

    a, b = named(first), named(second)
    return _listed(
        topic,
        lambda tick: a.get(tick, []),
        lambda tick: b.get(tick, []),
        sorted(t for t in {*a, *b} if t < ticks),
    )


def _listed(
    topic: str,
    first: Callable[[int], list[tuple[str, dict[str, Value]]]],
    second: Callable[[int], list[tuple[str, dict[str, Value]]]],
    ticks: Sequence[int],
) -> StreamDifference | None:
    found: ValueDifference | None = None
    count = 0
    for tick in ticks:
        a, b = first(tick), second(tick)
        difference = _of_lists(topic, tick, a, b)
        if difference is not None:
            found = found or difference
            count += 1
    return None if found is None else StreamDifference(topic=topic, ticks=count, first=found)


def _of_lists(
    topic: str,
    tick: int,
    first: list[tuple[str, dict[str, Value]]],
    second: list[tuple[str, dict[str, Value]]],
) -> ValueDifference | None:
    def difference(body: str, quantity: str, a: Value, b: Value) -> ValueDifference:
        return ValueDifference(
            tick=tick, topic=topic, body=body, quantity=quantity, first=a, second=b
        )

    for (body, a), (other, b) in zip(first, second, strict=False):
        if body != other:
            return difference(body, 'of', body, other)
        for quantity in a:
            if _bits(a[quantity]) != _bits(b[quantity]):
                return difference(body, quantity, a[quantity], b[quantity])
    if len(first) != len(second):
        longer = first if len(first) > len(second) else second
        body = longer[min(len(first), len(second))][0]
        return difference(body, 'records', float(len(first)), float(len(second)))
    return None


def _bits(value: Value) -> object:
    return np.float64(value).tobytes() if isinstance(value, float) else value


def _value(value: object) -> Value:
    if isinstance(value, Enum):
        return value.name
    if isinstance(value, bool):
        return str(value).lower()
    return float(value) if isinstance(value, int | float) else str(value)


def _rosters(first: Trace, second: Trace) -> Iterator[tuple[str, Value, Value]]:
    if first.roster.dt_s != second.roster.dt_s:
        yield 'time step', first.roster.dt_s, second.roster.dt_s
    for name, ours, theirs in (
        ('agent', first.roster.agents, second.roster.agents),
        ('uav', first.roster.uavs, second.roster.uavs),
    ):
        a = {entry.body_id: entry for entry in ours}
        b = {entry.body_id: entry for entry in theirs}
        for body in dict.fromkeys((*a, *b)):
            if body not in a or body not in b:
                there = ['there' if body in x else 'not there' for x in (a, b)]
                yield f'{name} {body}', there[0], there[1]
                continue
            for field in fields(RosterEntry):
                left, right = getattr(a[body], field.name), getattr(b[body], field.name)
                if left != right:
                    yield f'{field.name} of {name} {body}', str(left)[:200], str(right)[:200]
        if list(a) != list(b) and set(a) == set(b):
            yield f'order of the {name}s', ' '.join(a)[:200], ' '.join(b)[:200]
