# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read a bag back into a trace and a world, and say in what state the recording is.

A damaged bag is read as far as it goes; it never raises for damage, only when there is nothing
that could be judged at all. `docs/bags.md` has the table of what counts as which state.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from mcap.records import Channel, DataEnd, Message, Metadata, Schema
from rosbags.serde import SerdeError

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.air_clock import AIR_CLOCKS, AirClock, read_clocks
from aurora_core.trace.bag_content import (
    RERUN,
    BagContent,
    Damage,
    StoredMessage,
    content_of,
)
from aurora_core.trace.bag_metadata import METADATA, BagMetadata, file_sha256, read_metadata
from aurora_core.trace.checkpoints import CHECKPOINT, RECOVERY, ContentDigest, read_checkpoint
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.mcap_scan import Defect, scan
from aurora_core.trace.schema_check import check_schema
from aurora_core.trace.tick_encoding import TickDecoder
from aurora_core.trace.trace import Integrity

__all__ = [
    'BagContent',
    'StoredBag',
    'StoredMessage',
    'bag_folder',
    'content_of',
    'read_bag',
    'read_stored',
]

# The longest run that is possible (30 min, 200 agents, 10 UAVs) has half of it.
_CONTENT_LIMIT = 1 << 30
# More notes of one kind say nothing more.
_NOTES = 5


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredBag:
    """What a bag's files hold, as far as they can be read.

    Attributes:
        folder: Of the bag.
        messages: In the order of the file.
        damage: Of the files; what is wrong with the content shows in `content_of`.
        air_clocks: Of autopilots that kept their own time.
    """

    folder: Path
    messages: tuple[StoredMessage, ...]
    damage: tuple[tuple[Integrity, str], ...]
    air_clocks: tuple[AirClock, ...] = ()


def bag_files(path: Path) -> tuple[Path, ...]:
    """Return the MCAP files that a bag folder, its metadata or an MCAP file name.

    Raises:
        BagError: There is no bag.
    """
    # What is named is the bag, a pipe too: who opens it says what is wrong.
    if path.exists() and not path.is_dir() and path.name != METADATA:
        return (path,)
    folder = path if path.is_dir() else path.parent
    files = tuple(sorted(folder.glob('*.mcap')))
    if not files:
        raise BagError(f'no MCAP bag in {path}', hint='name a folder such as runs/<run_id>/bag.0')
    return files


def bag_folder(path: Path) -> Path:
    """Return the bag folder of a path that may name the bag or a file in it.

    Raises:
        BagError: There is no bag.
    """
    return bag_files(path)[0].parent


def read_bag(path: Path, definitions: MessageDefinitions) -> BagContent:
    """Read a bag.

    Args:
        path: Folder of the bag, or its MCAP file.
        definitions: Layouts of the messages.

    Raises:
        BagError: There is no bag, or it lacks the roster or the world.
    """
    bag = read_stored(path, definitions)
    return content_of(bag.messages, bag.damage, str(path), bag.air_clocks)


def read_stored(path: Path, definitions: MessageDefinitions) -> StoredBag:
    """Read the messages of a bag without judging them.

    Args:
        path: Folder of the bag, or its MCAP file.
        definitions: Layouts of the messages.

    Raises:
        BagError: There is no bag, or it holds more than any recording.
    """
    files = bag_files(path)
    damage: Damage = []
    stored: list[StoredMessage] = []
    clocks: tuple[AirClock, ...] = ()
    for file in files:
        reading = FileReading(file, definitions)
        stored += reading.messages()
        damage += reading.damage
        clocks = reading.air_clocks or clocks
    return StoredBag(
        folder=files[0].parent, messages=tuple(stored), damage=tuple(damage), air_clocks=clocks
    )


class FileReading:
    """One pass over one file.

    Args:
        file: The MCAP file; its metadata lies beside it.
        definitions: Layouts of the messages.

    Attributes:
        damage: What is wrong, once `messages` has come to its end.
        defects: Those that are in the structure of the file.
        metadata: Of the recording, None when there is none that can be read.
        air_clocks: Of autopilots that kept their own time.
    """

    def __init__(self, file: Path, definitions: MessageDefinitions) -> None:
        self._file = file
        self._definitions = definitions
        self._decoder = TickDecoder(definitions)
        self._schemas: dict[int, Schema] = {}
        # Type of the messages of a channel, '' for one that is left alone, and its topic.
        self._channels: dict[int, tuple[str, str, bytes]] = {}
        self._counts: dict[str, int] = {}
        self._content = ContentDigest()
        # Not in that digest yet: many are taken in at once sooner than one by one.
        self._fresh: list[tuple[bytes, int, bytes | memoryview]] = []
        # Of all messages, the earliest and latest simulated time.
        self._first_ns: int | None = None
        self._last_ns = 0
        # Messages that are filed under another time than they are stamped with.
        self._misfiled = 0
        self._checked_ns = 0
        # Not matched by the messages before it; explained by a later one that is.
        self._checkpoints_fail: list[str] = []
        self._checkpoints_changed: list[str] = []
        self._checkpoint_seen = self._final_seen = False
        self._ended = False
        self._foreign: Damage = []
        self._undecoded: list[str] = []
        self._nameless = 0
        self._recovery: Damage = []
        self.damage: Damage = []
        self.defects: list[Defect] = []
        self.metadata: BagMetadata | None = None
        self.air_clocks: tuple[AirClock, ...] = ()

    def messages(self) -> Iterator[StoredMessage]:
        """Yield what the topics of a trace carry; afterwards `damage` is complete."""
        size = 0
        try:
            for record in scan(self._file):
                if isinstance(record, Message):
                    message = self._message(record)
                    if message is not None:
                        size += len(record.data)
                        if size > _CONTENT_LIMIT:
                            raise BagError(
                                f'{self._file} holds more than {_CONTENT_LIMIT >> 20} MB of '
                                'messages, which no run has',
                                hint=RERUN,
                            )
                        yield message
                elif isinstance(record, Defect):
                    self.defects.append(record)
                elif isinstance(record, Schema):
                    self._schemas.setdefault(record.id, record)
                elif isinstance(record, Channel):
                    self._open(record)
                elif isinstance(record, Metadata):
                    self._note(record)
                elif isinstance(record, DataEnd):
                    self._ended = True
        except OSError as err:
            self.damage.append((Integrity.UNKNOWN, f'{self._file.name} cannot be read: {err}'))
        self._judge()

    def _open(self, channel: Channel) -> None:
        if channel.id in self._channels:
            return
        topic = channel.topic
        type_name = messages.TOPICS.get(topic, '')
        if type_name:
            problem = self._layout_problem(channel, type_name)
            if problem:
                self._foreign.append((Integrity.UNKNOWN, f'foreign schema on {topic}: {problem}'))
                type_name = ''
        self._channels[channel.id] = (type_name, topic, topic.encode('utf-8'))

    def _layout_problem(self, channel: Channel, type_name: str) -> str:
        if channel.message_encoding != 'cdr':
            return f'its messages are encoded as {channel.message_encoding[:20]!r}, expected cdr'
        schema = self._schemas.get(channel.schema_id)
        if schema is None:
            return 'the bag does not define it'
        foreign = check_schema(schema, type_name, self._definitions)
        return '' if foreign is None else foreign.text

    def _message(self, record: Message) -> StoredMessage | None:
        channel = self._channels.get(record.channel_id)
        if channel is None:
            self._nameless += 1
            return None
        type_name, topic, name = channel
        self._fresh.append((name, record.log_time, record.data))
        number = self._counts.get(topic, 0)
        self._counts[topic] = number + 1
        first_ns = record.log_time if self._first_ns is None else self._first_ns
        self._first_ns = min(first_ns, record.log_time)
        self._last_ns = max(self._last_ns, record.log_time)
        if not type_name:
            return None
        try:
            value = self._decoder.decode(type_name, record.data)
        except (SerdeError, MemoryError, OverflowError) as err:
            self._undecoded.append(
                f'{topic}: message {number} at {record.log_time / 1e9:.2f} s cannot be decoded '
                f'({err})'
            )
            return None
        stamp = value.header.stamp
        stamp_ns = stamp.sec * 1_000_000_000 + stamp.nanosec
        self._misfiled += not stamp_ns == record.log_time == record.publish_time
        return StoredMessage(topic, record.data, value)

    def _note(self, record: Metadata) -> None:
        if record.name == RECOVERY:
            kind, note = record.metadata.get('integrity', ''), record.metadata.get('note', '')
            known = kind in (Integrity.ALTERED, Integrity.TRUNCATED)
            self._recovery.append(
                (
                    Integrity(kind) if known else Integrity.UNKNOWN,
                    f'recovered from a damaged bag: {note[:500]}',
                )
            )
        elif record.name == AIR_CLOCKS:
            try:
                self.air_clocks = read_clocks(record.metadata)
            except ValueError:
                self._foreign.append((Integrity.ALTERED, 'the record of the clocks is damaged'))
        elif record.name == CHECKPOINT:
            self._checkpoint_seen = True
            self._take_in()
            try:
                checkpoint = read_checkpoint(record.metadata)
            except ValueError:
                self._checkpoints_fail.append('a checkpoint cannot be read')
                return
            self._final_seen |= checkpoint.final
            if checkpoint == self._content.checkpoint(final=checkpoint.final):
                # What failed before was the checkpoint, not what it is about.
                if self._checkpoints_fail:
                    self._checkpoints_fail.clear()
                    self._checkpoints_changed.append(
                        f'a checkpoint between {self._checked_ns / 1e9:.2f} s and '
                        f'{checkpoint.time_ns / 1e9:.2f} s was changed'
                    )
                self._checked_ns = checkpoint.time_ns
            elif not self._checkpoints_fail:
                self._checkpoints_fail.append(
                    f'messages between {self._checked_ns / 1e9:.2f} s and '
                    f'{checkpoint.time_ns / 1e9:.2f} s are not those that were recorded'
                )

    def _take_in(self) -> None:
        self._content.add(self._fresh)
        self._fresh.clear()

    def _judge(self) -> None:
        """Say what the state of the file is, from everything that was seen."""
        self._take_in()
        cut = any(defect.cut for defect in self.defects)
        damage: Damage = [*self._recovery, *self._foreign[:_NOTES]]
        self.metadata = self._metadata(damage)
        if self.metadata is not None:
            damage += self._compare_with(self.metadata, cut)
        for defect in self.defects:
            kind = Integrity.TRUNCATED if defect.cut else Integrity.ALTERED
            damage.append((kind, f'{self._file.name}: {_told(defect)}'))
        if self._nameless:
            damage.append(
                (Integrity.ALTERED, f'{self._nameless} messages are on no topic that is named')
            )
        damage += [(Integrity.ALTERED, note) for note in self._undecoded[:_NOTES]]
        if not self.defects and not self._nameless:
            notes = [*self._checkpoints_changed[:_NOTES], *self._checkpoints_fail]
            damage += [(Integrity.ALTERED, note) for note in notes]
            if self._checkpoint_seen and self._ended and not self._final_seen:
                damage.append((Integrity.ALTERED, 'the last checkpoint is missing'))
        self.damage += damage

    def _metadata(self, damage: Damage) -> BagMetadata | None:
        try:
            return read_metadata(self._file.parent)
        except FileNotFoundError:
            damage.append(
                (Integrity.UNKNOWN, f'{METADATA} is missing: there is no digest to compare with')
            )
        except OSError as err:
            damage.append((Integrity.UNKNOWN, f'{METADATA} cannot be read: {err}'))
        except ValueError as err:
            damage.append((Integrity.ALTERED, f'{METADATA} is damaged: {str(err)[:200]}'))
        return None

    def _compare_with(self, metadata: BagMetadata, cut: bool) -> Damage:
        if metadata.file_name != self._file.name:
            return [
                (
                    Integrity.ALTERED,
                    f'{METADATA} is about {metadata.file_name!r}, not {self._file.name!r}',
                )
            ]
        if not metadata.sha256:
            return [(Integrity.UNKNOWN, f'{METADATA} carries no digest: another program wrote it')]
        if metadata.recovered_from and not self._recovery:
            return [(Integrity.ALTERED, 'the note of its recovery was removed')]
        if file_sha256(self._file) != metadata.sha256:
            return self._changed(metadata, cut)
        if metadata.content_sha256 and (
            metadata.content_sha256 != self._content.checkpoint().sha256
        ):
            return [(Integrity.ALTERED, 'the messages are not those that were recorded')]
        if metadata.content_sha256 and not self._checkpoint_seen:
            return [(Integrity.ALTERED, 'the checkpoints of the recording are missing')]
        if self._misfiled:
            note = f'{self._misfiled} messages are filed under another time than their own'
            return [(Integrity.ALTERED, note)]
        if self._told_otherwise(metadata):
            return [(Integrity.ALTERED, f'{METADATA} tells of other messages than are there')]
        return []

    def _told_otherwise(self, metadata: BagMetadata) -> bool:
        """Tell whether topics, types, numbers or times of the messages are not as told."""
        types = {topic: kind for kind, topic, _ in self._channels.values() if kind}
        told = {name: topic.type_name for name, topic in metadata.topics.items()}
        counts = {name: topic.count for name, topic in metadata.topics.items() if topic.count}
        span_ns = (self._first_ns or 0, self._last_ns)
        return (
            counts != self._counts
            or any(told.get(topic) != kind for topic, kind in types.items())
            or span_ns != (metadata.first_ns, metadata.last_ns)
        )

    def _changed(self, metadata: BagMetadata, cut: bool) -> Damage:
        size = self._file.stat().st_size
        whole = metadata.file_bytes
        if cut and all(defect.cut for defect in self.defects):
            was = f': {size} bytes of {whole}' if whole is not None and size < whole else ''
            return [(Integrity.TRUNCATED, f'{self._file.name} was cut short{was}')]
        note = f'{self._file.name} does not match the digest of its recording'
        checkpoints = self._checkpoints_fail or self._checkpoints_changed
        if self.defects or self._nameless or self._undecoded or checkpoints:
            return [(Integrity.ALTERED, note)]
        # Nothing that was read shows it: look where a reader of messages need not look.
        for record in scan(self._file, check_index=True):
            if isinstance(record, Defect):
                return [(Integrity.ALTERED, f'{note}: {record}')]
        if metadata.content_sha256 == self._content.checkpoint().sha256:
            note += '; every message is as recorded: the change is in its header or index'
        return [(Integrity.ALTERED, note)]


def _told(defect: Defect) -> str:
    text = str(defect)
    if defect.start_ns is not None and defect.end_ns is not None:
        text += f', {defect.start_ns / 1e9:.2f} s to {defect.end_ns / 1e9:.2f} s'
    if defect.messages:
        text += f', {defect.messages} messages lost'
    return text
