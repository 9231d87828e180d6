# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read a bag back into a trace and a world, and say in what state the recording is.

A damaged bag is read as far as it goes; it never raises for damage, only when there is nothing
that could be judged at all.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import yaml
import zstandard
from mcap.exceptions import McapError
from mcap.records import Channel, DataEnd, Message, Schema
from mcap.stream_reader import StreamReader
from rosbags.serde import SerdeError

from aurora_core.errors import BagError
from aurora_core.knowledge.world import WorldModel
from aurora_core.trace import messages
from aurora_core.trace.bag_writer import file_sha256
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.hashing import world_sha256
from aurora_core.trace.layout import GROUND_WIDTH, UAV_COMMAND_WIDTH, UAV_WIDTH
from aurora_core.trace.messages_world import read_world
from aurora_core.trace.records import EventRecord, LinkRecord
from aurora_core.trace.roster import Roster
from aurora_core.trace.trace import Integrity, Trace

Damage = list[tuple[Integrity, str]]
_T = TypeVar('_T')

# What the MCAP and CDR decoders raise on damaged bytes; a damaged length asks for any memory.
UNREADABLE = (
    McapError,
    SerdeError,
    zstandard.ZstdError,
    struct.error,
    ValueError,
    LookupError,
    AssertionError,
    EOFError,
    MemoryError,
    OverflowError,
)
# A tick number this many times beyond the number of stored ticks is damage, not a gap.
_TICKS_AHEAD = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class BagContent:
    """A bag's content.

    Attributes:
        trace: States, commands and claims, with the integrity of the recording.
        world: The measured world.
        agsg_message: The last Agsg message (decoded), None when there is none.
    """

    trace: Trace
    world: WorldModel
    agsg_message: Any


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredMessage:
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
class StoredBag:
    """What a bag's files hold, as far as they can be read.

    Attributes:
        folder: Of the bag.
        messages: In the order of the file.
        damage: Of the files; what is wrong with the content shows in `content_of`.
    """

    folder: Path
    messages: tuple[StoredMessage, ...]
    damage: tuple[tuple[Integrity, str], ...]


def bag_folder(path: Path) -> Path:
    """Return the bag folder of a path that may name the bag or a file in it.

    Raises:
        BagError: There is no bag.
    """
    folder = path if path.is_dir() else path.parent
    if not any(folder.glob('*.mcap')):
        raise BagError(f'no MCAP bag in {path}', hint='name a folder such as runs/<run_id>/bag.0')
    return folder


def read_bag(path: Path, definitions: MessageDefinitions) -> BagContent:
    """Read a bag.

    Args:
        path: Folder of the bag.
        definitions: Layouts of the messages.

    Raises:
        BagError: There is no bag, or it lacks the roster or the world.
    """
    bag = read_stored(path, definitions)
    return content_of(bag.messages, bag.damage, where=str(bag.folder))


def read_stored(path: Path, definitions: MessageDefinitions) -> StoredBag:
    """Read the messages of a bag without judging them.

    Args:
        path: Folder of the bag.
        definitions: Layouts of the messages.

    Raises:
        BagError: There is no bag.
    """
    folder = bag_folder(path)
    damage: Damage = []
    stored: list[StoredMessage] = []
    for file in sorted(folder.glob('*.mcap')):
        damage += _check_digest(folder, file)
        stored += _messages(file, definitions, damage)
    return StoredBag(folder=folder, messages=tuple(stored), damage=tuple(damage))


def content_of(
    stored: Iterable[StoredMessage], known_damage: Iterable[tuple[Integrity, str]], where: str
) -> BagContent:
    """Return the trace and the world that messages hold.

    Args:
        stored: Messages of one run; of one topic in the order in which they were published.
        known_damage: What is known to be wrong with them.
        where: Where they come from, for errors.

    Raises:
        BagError: Roster or world is missing or damaged.
    """
    damage: Damage = list(known_damage)
    decoded: dict[str, list[Any]] = {topic: [] for topic in messages.TOPICS}
    for message in stored:
        decoded[message.topic].append(message.value)
    if not decoded[messages.ROSTER] or not decoded[messages.WORLD]:
        why = damage[0][1] if damage else 'the recording never started'
        raise BagError(
            f'{where} holds no roster and world, so nothing can be judged: {why}',
            hint='run the scenario again',
        )
    roster = _required(messages.read_roster, decoded[messages.ROSTER][-1], where)
    if not roster.dt_s > 0.0:
        raise BagError(f'{where}: the time step of the roster is {roster.dt_s} s')
    world = _required(read_world, decoded[messages.WORLD][-1], where)
    if world_sha256(world) != str(decoded[messages.WORLD][-1].digest):
        damage.append((Integrity.ALTERED, 'the world does not match its digest'))
    agsg = decoded[messages.AGSG][-1] if decoded[messages.AGSG] else None
    return BagContent(trace=_trace(roster, decoded, damage), world=world, agsg_message=agsg)


def _required(read: Callable[[Any], _T], message: Any, where: str) -> _T:
    """Read what every judgement needs.

    Raises:
        BagError: Its content is damaged.
    """
    try:
        return read(message)
    except (ValueError, LookupError) as err:
        raise BagError(
            f'{where}: {type(message).__name__} is damaged, so nothing can be judged: {err}',
            hint='run the scenario again',
        ) from err


def _check_digest(folder: Path, file: Path) -> Damage:
    metadata = folder / 'metadata.yaml'
    try:
        info = yaml.safe_load(metadata.read_text(encoding='utf-8'))['rosbag2_bagfile_information']
        expected = info['custom_data']['aurora_file_sha256']
    except OSError:
        return [(Integrity.TRUNCATED, 'metadata.yaml is missing: the recording was not closed')]
    except (yaml.YAMLError, LookupError, TypeError, ValueError):
        return [(Integrity.ALTERED, 'metadata.yaml is damaged')]
    if file_sha256(file) != expected:
        return [(Integrity.ALTERED, f'{file.name} does not match the digest of its recording')]
    return []


def _messages(
    file: Path, definitions: MessageDefinitions, damage: Damage
) -> Iterator[StoredMessage]:
    """Yield the messages as far as the file can be read, in file order."""
    schemas: dict[int, Schema] = {}
    channels: dict[int, Channel] = {}
    ended = False
    try:
        with file.open('rb') as stream:
            size = file.stat().st_size
            for record in StreamReader(stream, record_size_limit=size).records:
                if isinstance(record, Schema):
                    schemas[record.id] = record
                    _check_layout(record, definitions, damage)
                elif isinstance(record, Channel):
                    channels[record.id] = record
                elif isinstance(record, DataEnd):
                    ended = True
                elif isinstance(record, Message) and record.channel_id in channels:
                    channel = channels[record.channel_id]
                    type_name = messages.TOPICS.get(channel.topic)
                    if type_name is None:
                        continue
                    if schemas[channel.schema_id].name != type_name:
                        damage.append(
                            (Integrity.ALTERED, f'{channel.topic} has a foreign message type')
                        )
                        continue
                    yield StoredMessage(
                        topic=channel.topic,
                        cdr=record.data,
                        value=definitions.decode(type_name, record.data),
                    )
    except OSError as err:
        damage.append((Integrity.TRUNCATED, f'{file.name} cannot be read: {err}'))
    except UNREADABLE as err:
        damage.append((Integrity.TRUNCATED, f'{file.name} breaks off: {type(err).__name__}'))
    else:
        if not ended:
            damage.append((Integrity.TRUNCATED, f'{file.name} has no end'))


def _check_layout(schema: Schema, definitions: MessageDefinitions, damage: Damage) -> None:
    if schema.name not in messages.TOPICS.values():
        return
    if schema.data != definitions.text(schema.name).encode('utf-8'):
        damage.append((Integrity.UNKNOWN, f'{schema.name} was recorded with another layout'))


def _trace(roster: Roster, decoded: dict[str, list[Any]], damage: Damage) -> Trace:
    n, m = len(roster.agents), len(roster.uavs)
    ground_states = _by_tick(decoded[messages.GROUND_STATE], damage)
    uav_states = _by_tick(decoded[messages.UAV_STATE], damage)
    last = _last_tick(ground_states, uav_states, damage)
    ground = np.full((last + 1, n, GROUND_WIDTH), np.nan)
    uav = np.full((last + 1, m, UAV_WIDTH), np.nan)
    uav_commands = np.zeros((last + 1, m, UAV_COMMAND_WIDTH))
    ground_commands: list[tuple[GroundCommand, ...]] = [()] * (last + 1)
    for tick in [t for t in ground_states if t <= last]:
        ground[tick] = _rows(ground_states[tick], GROUND_WIDTH, n, damage)
    for tick in [t for t in uav_states if t <= last]:
        uav[tick] = _rows(uav_states[tick], UAV_WIDTH, m, damage)
    # Commands for the tick after the last one are recorded too; nothing came of them.
    flown = _by_tick(decoded[messages.UAV_COMMAND], damage)
    for tick in [t for t in flown if 0 < t <= last]:
        uav_commands[tick] = _rows(flown[tick], UAV_COMMAND_WIDTH, m, damage)
    driven = _by_tick(decoded[messages.GROUND_COMMAND], damage)
    for tick in [t for t in driven if 0 < t <= last]:
        for commands in _values(messages.read_ground_commands, [driven[tick]], damage):
            ground_commands[tick] = commands
    missing = tuple(
        t
        for t in range(last + 1)
        if t not in ground_states
        or (m > 0 and t not in uav_states)
        or (t > 0 and t not in driven)
        or (m > 0 and t > 0 and t not in flown)
    )
    if missing:
        damage.append((Integrity.TRUNCATED, f'{len(missing)} ticks are incomplete'))
    links = sorted(
        _values(messages.read_link, decoded[messages.COMM], damage), key=lambda r: r.sequence
    )
    events = sorted(
        _values(messages.read_event, decoded[messages.EVENTS], damage), key=lambda r: r.sequence
    )
    sights = sorted(
        _values(messages.read_sight, decoded[messages.SENSING], damage),
        key=lambda r: (r.tick, r.observer, r.target),
    )
    _check_sequence(links, 'message ledger', damage)
    _check_sequence(events, 'scenario events', damage)
    return Trace(
        roster=roster,
        ground=ground,
        uav=uav,
        uav_commands=uav_commands,
        ground_commands=tuple(ground_commands),
        links=tuple(links),
        sights=tuple(sights),
        events=tuple(events),
        missing_ticks=missing,
        integrity=_worst(damage),
        integrity_note='; '.join(dict.fromkeys(note for _, note in damage)),
    )


def _worst(damage: Damage) -> Integrity:
    found = {kind for kind, _ in damage}
    for kind in (Integrity.ALTERED, Integrity.TRUNCATED, Integrity.UNKNOWN):
        if kind in found:
            return kind
    return Integrity.INTACT


def _by_tick(stored: list[Any], damage: Damage) -> dict[int, Any]:
    by_tick = {int(x.tick): x for x in stored}
    if len(by_tick) < len(stored):
        kind = type(stored[0]).__name__
        damage.append((Integrity.ALTERED, f'a tick is recorded twice ({kind})'))
    return by_tick


def _last_tick(ground: dict[int, Any], uav: dict[int, Any], damage: Damage) -> int:
    """Return the last tick with states, -1 without any; tick numbers out of reach are damage."""
    ticks = sorted({*ground, *uav})
    reach = _TICKS_AHEAD * (len(ticks) + 1)
    near = [t for t in ticks if t <= reach]
    if len(near) < len(ticks):
        damage.append((Integrity.ALTERED, f'{len(ticks) - len(near)} tick numbers are damaged'))
    return near[-1] if near else -1


def _values(read: Callable[[Any], _T], stored: list[Any], damage: Damage) -> Iterator[_T]:
    """Yield the records that can be read."""
    for message in stored:
        try:
            yield read(message)
        except ValueError as err:
            damage.append((Integrity.ALTERED, f'{type(message).__name__} is damaged: {err}'))


def _check_sequence(
    records: list[LinkRecord] | list[EventRecord], name: str, damage: Damage
) -> None:
    """Records are numbered from 0: a gap is a lost record."""
    if [r.sequence for r in records] != list(range(len(records))):
        damage.append((Integrity.TRUNCATED, f'records of the {name} are missing'))


def _rows(message: Any, width: int, count: int, damage: Damage) -> messages.FloatArray:
    if len(message.data) != width * count:
        damage.append((Integrity.ALTERED, f'tick {int(message.tick)} has a wrong number of rows'))
        return np.full((count, width), np.nan)
    return messages.read_rows(message, width)
