# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a rosbag2 bag (MCAP) that survives a kill.

Everything goes to the kernel twice per simulated second, each time with a checkpoint of the digest
so far: the death of this process loses nothing of that. The disk is brought up to date once per
simulated second, unless that is too often, beside the work, for the death of the machine.

`metadata.yaml` is written beside it when the bag is closed, so that `ros2 bag` and `rosbags` read
it; a bag without one was never closed.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from mcap.records import Schema
from rosbags.serde import SerdeError

from aurora_core.errors import BagError
from aurora_core.trace.bag_metadata import (
    BagMetadata,
    RecordedTopic,
    file_sha256,
    offered,
    write_metadata,
)
from aurora_core.trace.checkpoints import CHECKPOINT, ContentDigest
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.disk_sync import DiskSync
from aurora_core.trace.mcap_file import Entry, McapFile
from aurora_core.trace.messages import EVENTS, TOPICS
from aurora_core.trace.records import ScenarioEventKind

# Simulated time after which what was written leaves this process, and is on the disk.
FLUSH_NS = 500_000_000
SYNC_NS = 1_000_000_000
# Topic, type name, encoding, simulated time of its tick (ns).
Message = tuple[str, str, bytes, int]
# Bytes of messages after which they do so anyway.
_PENDING_BYTES = 1 << 20


@dataclass(frozen=True, slots=True, kw_only=True)
class BagSummary:
    """What was written.

    Attributes:
        path: Folder of the bag.
        counts: Messages by topic.
        sha256: Of the MCAP file (hex).
    """

    path: Path
    counts: dict[str, int]
    sha256: str


@dataclass(slots=True)
class _Channel:
    number: int
    type_name: str
    count: int = 0


class BagWriter:
    """Writes one bag.

    Args:
        directory: Folder to create; it must not exist.
        definitions: Layouts of the messages.
        recovered_from: Digest of the damaged file that the messages are from, '' for a recording.

    Raises:
        BagError: The folder exists or cannot be created.
    """

    def __init__(
        self, directory: Path, definitions: MessageDefinitions, *, recovered_from: str = ''
    ) -> None:
        self._directory = directory
        self._definitions = definitions
        self._recovered_from = recovered_from
        self._file_name = f'{directory.name}_0.mcap'
        self._channels: dict[str, _Channel] = {}
        self._schemas: dict[str, int] = {}
        self._content = ContentDigest()
        self._checked = 0
        # What has not left this process, and topic names by channel number for its digest.
        self._pending: list[Entry] = []
        self._pending_bytes = 0
        self._names: dict[int, bytes] = {}
        self._first_ns: int | None = None
        self._last_ns = 0
        # The first tick after 0 is a flush: graph, roster and world are out at once.
        self._flushed_ns = 1 - FLUSH_NS
        self._synced_ns = 1 - SYNC_NS
        self._closed = False
        try:
            directory.mkdir(parents=True)
            self._stream = (directory / self._file_name).open('wb')
        except OSError as err:
            raise BagError(
                f'cannot create the bag {directory}: {err}',
                hint='choose another output folder or free some space',
            ) from err
        self._sync = DiskSync(self._stream.fileno())
        try:
            self._file = McapFile(self._stream, library='aurora')
        except OSError as err:
            raise self._failure(err) from err

    def __enter__(self) -> BagWriter:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        # After a failed write there is nothing to finish: the bag stays without metadata.
        if not self._closed:
            self.close()

    @property
    def closed(self) -> bool:
        """Whether it was closed, or has given up after a failed write."""
        return self._closed

    def write(self, topic: str, type_name: str, cdr: bytes, time_ns: int) -> None:
        """Append a message.

        Args:
            topic: Topic name.
            type_name: e.g. `aurora_msgs/msg/Tick`.
            cdr: Encoding as it came off the wire.
            time_ns: Simulated time of its tick.

        Raises:
            BagError: The disk is full or the file cannot be written, or the bag is closed.
        """
        self.write_all(((topic, type_name, cdr, time_ns),))

    def write_all(self, messages: Iterable[Message]) -> None:
        """Append messages one after the other; they leave this process together or not at all.

        Raises:
            BagError: As `write`.
        """
        pending, channels = self._pending, self._channels
        first_ns, last_ns, size = self._first_ns, self._last_ns, self._pending_bytes
        phase_ns: int | None = None
        for topic, type_name, cdr, time_ns in messages:
            if self._closed:
                self._refuse_closed(f'takes no message on {topic}')
            channel = channels.get(topic) or self._define(topic, type_name)
            pending.append((channel.number, channel.count, time_ns, cdr))
            channel.count += 1
            size += len(cdr)
            if first_ns is None or time_ns < first_ns:
                first_ns = time_ns
            if time_ns > last_ns:
                last_ns = time_ns
            if topic == EVENTS and self._begins_phase(cdr):
                phase_ns = time_ns
        self._first_ns, self._last_ns, self._pending_bytes = first_ns, last_ns, size
        if last_ns - self._flushed_ns >= FLUSH_NS or size > _PENDING_BYTES:
            self._guard(lambda: self._bring(to_disk=last_ns - self._synced_ns >= SYNC_NS))
        if phase_ns is not None:
            # With the next tick: what belongs to this one is still to come.
            self._flushed_ns = min(self._flushed_ns, phase_ns + 1 - FLUSH_NS)
            self._synced_ns = min(self._synced_ns, phase_ns + 1 - SYNC_NS)

    def define(self, topic: str, schema: Schema, encoding: str = 'cdr') -> None:
        """Define a topic by a foreign schema; without it the topic gets ours.

        Raises:
            BagError: The bag is closed.
        """
        self._refuse_closed(f'takes no topic {topic}')
        if topic not in self._channels:
            self._open(topic, schema, encoding)

    def flush(self) -> None:
        """Hand everything written so far to the operating system, and ask the disk for it.

        Raises:
            BagError: The disk is full or broken.
        """
        self._guard(lambda: self._bring(to_disk=True))

    def note(self, name: str, values: Mapping[str, str]) -> None:
        """Add an MCAP Metadata record.

        Raises:
            BagError: The disk is full, or the bag is closed.
        """
        self._refuse_closed(f'takes no note {name}')
        self._guard(lambda: self._file.add_metadata(name, values))

    def close(self) -> BagSummary:
        """Finish the bag and write its metadata.

        Raises:
            BagError: The disk is full, or the bag was closed before (also by a failed write).
        """
        self._refuse_closed('is not closed again')
        self._closed = True
        try:
            digest = self._finish()
        except OSError as err:
            raise self._failure(err) from err
        counts = {topic: channel.count for topic, channel in self._channels.items()}
        return BagSummary(path=self._directory, counts=counts, sha256=digest)

    def _bring(self, *, to_disk: bool) -> None:
        self._write_pending()
        if self._content.messages > self._checked:
            self._checkpoint(final=False)
        self._stream.flush()
        self._flushed_ns = self._last_ns
        if to_disk:
            self._sync.request()
            self._synced_ns = self._last_ns

    def _write_pending(self) -> None:
        names = self._names
        self._content.add([(names[channel], at, cdr) for channel, _, at, cdr in self._pending])
        self._file.add_chunk(self._pending)
        self._pending.clear()
        self._pending_bytes = 0

    def _checkpoint(self, *, final: bool) -> None:
        self._checked = self._content.messages
        self._file.add_metadata(CHECKPOINT, self._content.checkpoint(final=final).record())

    def _begins_phase(self, cdr: bytes) -> bool:
        try:
            event = self._definitions.decode(TOPICS[EVENTS], cdr)
        except SerdeError:
            return False
        return int(event.kind) == ScenarioEventKind.PHASE

    def _finish(self) -> str:
        self._write_pending()
        self._checkpoint(final=True)
        self._file.finish()
        self._stream.flush()
        self._sync.close()
        os.fsync(self._stream.fileno())
        self._stream.close()
        path = self._directory / self._file_name
        digest = file_sha256(path)
        write_metadata(
            self._directory,
            BagMetadata(
                file_name=self._file_name,
                sha256=digest,
                file_bytes=path.stat().st_size,
                content_sha256=self._content.checkpoint().sha256,
                recovered_from=self._recovered_from,
                first_ns=self._first_ns or 0,
                last_ns=self._last_ns,
                topics={
                    topic: RecordedTopic(
                        type_name=channel.type_name,
                        type_hash=self._definitions.type_hash(channel.type_name),
                        count=channel.count,
                    )
                    for topic, channel in self._channels.items()
                },
            ),
        )
        return digest

    def _define(self, topic: str, type_name: str) -> _Channel:
        text = self._definitions.text(type_name).encode('utf-8')
        return self._open(
            topic, Schema(id=0, name=type_name, encoding='ros2msg', data=text), 'cdr'
        )

    def _open(self, topic: str, schema: Schema, encoding: str) -> _Channel:
        if schema.name not in self._schemas:
            self._schemas[schema.name] = self._file.add_schema(
                schema.name, schema.encoding, schema.data
            )
        number = self._file.add_channel(
            topic,
            encoding,
            self._schemas[schema.name],
            {'offered_qos_profiles': offered(topic)},
        )
        self._names[number] = topic.encode('utf-8')
        channel = _Channel(number, schema.name)
        self._channels[topic] = channel
        return channel

    def _refuse_closed(self, what: str) -> None:
        if self._closed:
            raise BagError(
                f'the bag {self._directory} is closed and {what}', hint='open a new bag'
            )

    def _guard(self, action: Callable[[], object]) -> None:
        try:
            action()
        except OSError as err:
            raise self._failure(err) from err

    def _failure(self, err: OSError) -> BagError:
        # What follows a lost write could not be read: nothing more goes into the file.
        self._closed = True
        self._sync.close()
        with suppress(OSError):
            self._stream.close()
        return BagError(
            f'cannot write the bag {self._directory}: {err}', hint='free some space on the disk'
        )
