# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From the messages of one run to its trace and world, and what is wrong with them.

Works on anything that the bytes can say: what cannot be used is left out and named.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeVar

import numpy as np
import numpy.typing as npt

from aurora_core.errors import BagError
from aurora_core.knowledge.world import WorldModel
from aurora_core.trace import messages
from aurora_core.trace.air_clock import AirClock
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.hashing import world_sha256
from aurora_core.trace.layout import GROUND_WIDTH, UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_core.trace.messages_world import read_world
from aurora_core.trace.records import EventRecord, LinkRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Integrity, Trace

Damage = list[tuple[Integrity, str]]
_T = TypeVar('_T')

RERUN = 'run the scenario again'
# A tick number this many times beyond the number of stored ticks is damage, not a gap.
_TICKS_AHEAD = 4
# Beyond this a position, speed or rate is none; its square is still a number.
_LARGEST = 1e12
# Time steps of the lockstep that a roster may name.
_DT_S = (1e-3, 1.0)
# Arrays of the longest run that is possible (30 min, 200 agents, 10 UAVs) have 0.5 GB.
_ARRAY_BYTES = 2 << 30
_NOTES = 12
_SECOND_NS = 1_000_000_000
_BAD_VALUES = (ValueError, LookupError, TypeError, ArithmeticError, AttributeError)


class StoredMessage(NamedTuple):
    """A message of a trace.

    Attributes:
        topic: One of `messages.TOPICS`.
        cdr: Its bytes as they came off the wire.
        value: The same, decoded.
    """

    topic: str
    cdr: bytes
    value: Any


@dataclass(frozen=True, slots=True, kw_only=True)
class BagContent:
    """A bag's content.

    Attributes:
        trace: States, commands and claims, with the integrity of the recording.
        world: The measured world.
        agsg_message: The last Agsg message (decoded), None when there is none.
        air_clocks: Of autopilots that kept their own time; () of a run in lockstep.
    """

    trace: Trace
    world: WorldModel
    agsg_message: Any
    air_clocks: tuple[AirClock, ...] = ()


def content_of(
    stored: Iterable[StoredMessage],
    known_damage: Iterable[tuple[Integrity, str]],
    where: str,
    air_clocks: tuple[AirClock, ...] = (),
) -> BagContent:
    """Return the trace and the world that messages hold.

    Args:
        stored: Messages of one run; of one topic in the order in which they were published.
        known_damage: What is known to be wrong with them.
        where: Where they come from, for errors.
        air_clocks: Of autopilots that kept their own time.

    Raises:
        BagError: Roster or world is missing or damaged.
    """
    decoded: dict[str, list[Any]] = {topic: [] for topic in messages.TOPICS}
    once: dict[str, set[bytes]] = {messages.ROSTER: set(), messages.WORLD: set()}
    for message in stored:
        decoded[message.topic].append(message.value)
        if message.topic in once:
            once[message.topic].add(bytes(message.cdr))
    damage: Damage = list(known_damage)
    damage += [
        (Integrity.ALTERED, f'{topic}: {len(texts)} different ones are recorded')
        for topic, texts in once.items()
        if len(texts) > 1
    ]
    for topic, name in ((messages.ROSTER, 'roster'), (messages.WORLD, 'world')):
        if not decoded[topic]:
            why = note_of(damage) or 'the recording never started'
            raise BagError(
                f'{where} holds no {name}, so nothing can be judged: {why}',
                hint=RERUN,
            )
    roster = _required(messages.read_roster, decoded[messages.ROSTER][-1], where)
    _check_roster(roster, where)
    world = _required(read_world, decoded[messages.WORLD][-1], where)
    if world_sha256(world) != str(decoded[messages.WORLD][-1].digest):
        damage.append((Integrity.ALTERED, f'{messages.WORLD}: it does not match its digest'))
    agsg = decoded[messages.AGSG][-1] if decoded[messages.AGSG] else None
    trace = _Assembly(roster, decoded, damage, where).trace()
    return BagContent(trace=trace, world=world, agsg_message=agsg, air_clocks=air_clocks)


def worst(damage: Iterable[tuple[Integrity, str]]) -> Integrity:
    """Return the one state of a recording that damage leaves."""
    found = {kind for kind, _ in damage}
    for kind in (Integrity.ALTERED, Integrity.TRUNCATED, Integrity.UNKNOWN):
        if kind in found:
            return kind
    return Integrity.INTACT


def note_of(damage: Iterable[tuple[Integrity, str]]) -> str:
    """Return what is damaged in one line, the first things first."""
    notes = list(dict.fromkeys(note for _, note in damage))
    more = [f'and {len(notes) - _NOTES} more'] if len(notes) > _NOTES else []
    text = '; '.join([*notes[:_NOTES], *more])
    # Names out of a bag must not steer the terminal that they are shown in.
    return ''.join(c if c.isprintable() else '?' for c in text)


def _required(read: Callable[[Any], _T], message: Any, where: str) -> _T:
    """Read what every judgement needs.

    Raises:
        BagError: Its content is damaged.
    """
    try:
        return read(message)
    except _BAD_VALUES as err:
        name = type(message).__name__.rpartition('__')[2]
        raise BagError(
            f'{where}: the {name} message is damaged, so nothing can be judged: {err}', hint=RERUN
        ) from err


def _check_roster(roster: Roster, where: str) -> None:
    low, high = _DT_S
    if not low <= roster.dt_s <= high:
        raise BagError(
            f'{where}: expected a time step from {low:g} to {high:g} s in the roster, found '
            f'{roster.dt_s} s',
            hint=RERUN,
        )
    names = Counter(entry.body_id for entry in (*roster.agents, *roster.uavs))
    twice = [name for name, count in names.most_common(3) if count > 1]
    if twice:
        raise BagError(f'{where}: the roster names {", ".join(twice)} twice', hint=RERUN)


class _Assembly:
    """Puts decoded messages in their places."""

    def __init__(
        self, roster: Roster, decoded: dict[str, list[Any]], damage: Damage, where: str
    ) -> None:
        self._roster = roster
        self._decoded = decoded
        self._damage = damage
        self._where = where
        self._runs: set[int] = set()

    def trace(self) -> Trace:
        n, m = len(self._roster.agents), len(self._roster.uavs)
        ground_states = self._by_tick(messages.GROUND_STATE)
        uav_states = self._by_tick(messages.UAV_STATE)
        last = self._last_tick(ground_states, uav_states)
        size = 8 * (last + 1) * (n * GROUND_WIDTH + m * (UAV_WIDTH + UAV_COMMAND_WIDTH))
        if size > _ARRAY_BYTES:
            raise BagError(
                f'{self._where}: a roster of {n + m} bodies over {last + 1} ticks is beyond '
                'anything that is recorded',
                hint=RERUN,
            )
        driven = self._by_tick(messages.GROUND_COMMAND)
        flown = self._by_tick(messages.UAV_COMMAND)
        if len(self._runs) > 1:
            self._found(Integrity.ALTERED, f'the messages are stamped by {len(self._runs)} runs')
        ground, bad_ground = self._rows(
            messages.GROUND_STATE, ground_states, last, n, GROUND_WIDTH
        )
        uav, bad_uav = self._rows(messages.UAV_STATE, uav_states, last, m, UAV_WIDTH)
        # Commands for the tick after the last one are recorded too; nothing came of them.
        commands, bad_flown = self._rows(
            messages.UAV_COMMAND, flown, last, m, UAV_COMMAND_WIDTH, first=1
        )
        commands[:1] = 0.0
        ground_commands: list[tuple[GroundCommand, ...]] = [()] * (last + 1)
        bad_driven = set()
        for tick in [t for t in driven if 0 < t <= last]:
            read = list(
                self._values(
                    messages.GROUND_COMMAND, messages.read_ground_commands, [driven[tick]]
                )
            )
            ground_commands[tick] = read[0] if read else ()
            bad_driven |= set() if read else {tick}
        lacks = {
            messages.GROUND_STATE: [t for t in range(last + 1) if t not in ground_states],
            messages.UAV_STATE: [t for t in range(last + 1) if m and t not in uav_states],
            messages.GROUND_COMMAND: [t for t in range(1, last + 1) if t not in driven],
            messages.UAV_COMMAND: [t for t in range(1, last + 1) if m and t not in flown],
        }
        for topic, ticks in lacks.items():
            if ticks and not self._decoded[topic]:
                self._found(Integrity.UNKNOWN, f'{topic}: no message that can be read')
            elif ticks:
                self._found(Integrity.TRUNCATED, f'{topic}: {_ticks(ticks)} missing')
        missing = bad_ground | bad_uav | bad_flown | bad_driven
        missing = missing.union(*lacks.values())
        links, events = self._links(), self._events()
        sights = sorted(
            self._values(messages.SENSING, messages.read_sight, self._decoded[messages.SENSING]),
            key=lambda r: (r.tick, r.observer, r.target),
        )
        return Trace(
            roster=self._roster,
            ground=ground,
            uav=uav,
            uav_commands=commands,
            ground_commands=tuple(ground_commands),
            links=tuple(links),
            sights=tuple(sights),
            events=tuple(events),
            missing_ticks=tuple(sorted(missing)),
            integrity=worst(self._damage),
            integrity_note=note_of(self._damage),
        )

    def _found(self, kind: Integrity, note: str) -> None:
        self._damage.append((kind, note))

    def _by_tick(self, topic: str) -> dict[int, Any]:
        """Return the messages by tick; of a tick that is there twice the first counts."""
        by_tick: dict[int, Any] = {}
        twice, late, off, last = [], [], [], -1
        for message in self._decoded[topic]:
            tick = int(message.tick)
            self._runs.add(int(message.run_number))
            header = message.header
            stamp_ns = header.stamp.sec * _SECOND_NS + header.stamp.nanosec
            asked_ns = messages.time_ns(tick, self._roster.dt_s)
            if stamp_ns != asked_ns or header.frame_id != messages.FRAME_ID:
                off.append(tick)
            if tick in by_tick:
                twice.append(tick)
                continue
            by_tick[tick] = message
            if tick < last:
                late.append(tick)
            last = max(last, tick)
        if twice:
            self._found(Integrity.ALTERED, f'{topic}: {_ticks(twice)} recorded twice')
        if late:
            self._found(Integrity.ALTERED, f'{topic}: {_ticks(late)} out of order')
        if off:
            text = f'{topic}: {_ticks(off)} stamped with another time or frame'
            self._found(Integrity.ALTERED, text)
        return by_tick

    def _last_tick(self, ground: dict[int, Any], uav: dict[int, Any]) -> int:
        """Return the last tick with states, -1 without any."""
        ticks = sorted({*ground, *uav})
        reach = _TICKS_AHEAD * (len(ticks) + 1)
        near = [t for t in ticks if t <= reach]
        if len(near) < len(ticks):
            far = ticks[len(near)]
            self._found(
                Integrity.ALTERED, f'states of tick {far} among {len(near)} ticks: no such tick'
            )
        return near[-1] if near else -1

    def _rows(
        self,
        topic: str,
        stored: dict[int, Any],
        last: int,
        count: int,
        width: int,
        first: int = 0,
    ) -> tuple[npt.NDArray[np.float64], set[int]]:
        """Return the packed rows (T, count, width), NaN where missing, and the unusable ticks."""
        rows = np.full((last + 1, count, width), np.nan)
        wrong = []
        for tick in [t for t in stored if first <= t <= last]:
            data = stored[tick].data
            if len(data) == width * count:
                rows[tick] = np.asarray(data, dtype=np.float64).reshape(count, width)
            else:
                wrong.append((tick, len(data)))
        if wrong:
            tick, length = wrong[0]
            self._found(
                Integrity.ALTERED,
                f'{topic}: {_ticks([t for t, _ in wrong])} of a wrong number of rows '
                f'(expected {width * count} numbers, found {length})',
            )
        with np.errstate(invalid='ignore'):
            usable = (np.abs(rows) <= _LARGEST).all(axis=(1, 2))
        bad = {t for t in stored if first <= t <= last and not usable[t]} - {t for t, _ in wrong}
        if bad:
            tick = min(bad)
            with np.errstate(invalid='ignore'):
                row = int(np.argmin((np.abs(rows[tick]) <= _LARGEST).all(axis=1)))
            names = self._roster.agents if topic == messages.GROUND_STATE else self._roster.uavs
            self._found(
                Integrity.UNKNOWN,
                f'{topic}: {_ticks(sorted(bad))} not a number or beyond all bounds '
                f'(first {names[row].body_id})',
            )
        return rows, bad | {t for t, _ in wrong}

    def _values(self, topic: str, read: Callable[[Any], _T], stored: list[Any]) -> Iterator[_T]:
        """Yield the records that can be read."""
        for message in stored:
            try:
                yield read(message)
            except _BAD_VALUES as err:
                self._found(
                    Integrity.ALTERED, f'{topic}: tick {int(message.tick)} is damaged: {err}'
                )

    def _links(self) -> list[LinkRecord]:
        stored = self._decoded[messages.COMM]
        records = list(self._values(messages.COMM, messages.read_link, stored))
        self._check_sequence(messages.COMM, records)
        return sorted(records, key=lambda r: r.sequence)

    def _events(self) -> list[EventRecord]:
        stored = self._decoded[messages.EVENTS]
        records = list(self._values(messages.EVENTS, messages.read_event, stored))
        self._check_sequence(messages.EVENTS, records)
        return sorted(records, key=lambda r: r.sequence)

    def _check_sequence(self, topic: str, records: list[LinkRecord] | list[EventRecord]) -> None:
        """Records are numbered from 0 in the order of the file: a gap is a lost record."""
        numbers = [record.sequence for record in records]
        if numbers == list(range(len(numbers))):
            return
        if sorted(numbers) == list(range(len(numbers))):
            self._found(Integrity.ALTERED, f'{topic}: records out of order')
        elif len(set(numbers)) < len(numbers):
            self._found(Integrity.ALTERED, f'{topic}: a record is there twice')
        else:
            there = set(numbers)
            gap = next(k for k in range(len(numbers) + 1) if k not in there)
            self._found(Integrity.TRUNCATED, f'{topic}: record {gap} is missing')


def _ticks(ticks: list[int]) -> str:
    """Name ticks in a few words."""
    if len(ticks) == 1:
        return f'tick {ticks[0]}'
    if ticks[-1] - ticks[0] == len(ticks) - 1:
        return f'ticks {ticks[0]} to {ticks[-1]}'
    return f'{len(ticks)} ticks from {ticks[0]} on'
