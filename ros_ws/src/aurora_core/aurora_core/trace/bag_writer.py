# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a rosbag2 bag (MCAP) that survives a kill: flushed every simulated second.

A flush hands everything to the operating system, so the death of this process loses nothing of
it; the disk is brought up to date right after it, beside the work, for the death of the machine.

`mcap.writer` is used because the writer of `rosbags` keeps everything in memory until it closes.
`metadata.yaml` is written beside it so that `ros2 bag` and `rosbags` read the bag.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

import yaml
from mcap.writer import CompressionType, Writer

from aurora_core.errors import BagError
from aurora_core.trace.definitions import MessageDefinitions
from aurora_core.trace.disk_sync import DiskSync

METADATA_VERSION = 9
FLUSH_NS = 1_000_000_000

_LATCHED = ('/aurora/agsg', '/aurora/roster', '/aurora/world', '/aurora/verdict')


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


class BagWriter:
    """Writes one bag.

    Args:
        directory: Folder to create; it must not exist.
        definitions: Layouts of the messages.

    Raises:
        BagError: The folder exists or cannot be created.
    """

    def __init__(self, directory: Path, definitions: MessageDefinitions) -> None:
        self._directory = directory
        self._definitions = definitions
        self._file_name = f'{directory.name}_0.mcap'
        self._channels: dict[str, tuple[int, str]] = {}
        self._schemas: dict[str, int] = {}
        self._counts: dict[str, int] = {}
        self._first_ns: int | None = None
        self._last_ns = 0
        self._flushed_ns = 0
        self._closed = False
        try:
            directory.mkdir(parents=True)
            self._stream = (directory / self._file_name).open('wb')
        except OSError as err:
            raise BagError(
                f'cannot create the bag {directory}: {err}',
                hint='choose another output folder or free some space',
            ) from err
        # Zstandard chunks: a run of ten agents shrinks to a fifth, at the cost of microseconds.
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._sync = DiskSync(self._stream.fileno())
        self._guard(lambda: self._writer.start(profile='ros2', library='aurora'))

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
        if self._closed:
            raise BagError(
                f'the bag {self._directory} is closed and takes no message on {topic}',
                hint='open a new bag',
            )
        channel = self._channel(topic, type_name)
        count = self._counts[topic]
        try:
            self._writer.add_message(channel, time_ns, cdr, time_ns, count)
        except OSError as err:
            raise self._failure(err) from err
        self._counts[topic] = count + 1
        if self._first_ns is None or time_ns < self._first_ns:
            self._first_ns = time_ns
        if time_ns > self._last_ns:
            self._last_ns = time_ns
        if time_ns - self._flushed_ns >= FLUSH_NS:
            self._flushed_ns = time_ns
            self.flush()

    def flush(self) -> None:
        """Hand everything written so far to the operating system, and ask the disk for it.

        Raises:
            BagError: The disk is full or broken.
        """

        def bring() -> None:
            self._writer.flush()  # type: ignore[no-untyped-call]
            self._sync.request()

        self._guard(bring)

    def close(self) -> BagSummary:
        """Finish the bag and write its metadata.

        Raises:
            BagError: The disk is full, or the bag was closed before (also by a failed write).
        """
        if self._closed:
            raise BagError(f'the bag {self._directory} is closed', hint='open a new bag')
        self._closed = True

        def finish() -> str:
            self._writer.finish()  # type: ignore[no-untyped-call]
            self._stream.flush()
            self._sync.close()
            os.fsync(self._stream.fileno())
            self._stream.close()
            digest = file_sha256(self._directory / self._file_name)
            temporary = self._directory / 'metadata.yaml.part'
            with temporary.open('w', encoding='utf-8') as stream:
                yaml.safe_dump(self._metadata(digest), stream, sort_keys=True)
                stream.flush()
                os.fsync(stream.fileno())
            temporary.replace(self._directory / 'metadata.yaml')
            return digest

        try:
            digest = finish()
        except OSError as err:
            raise self._failure(err) from err
        return BagSummary(path=self._directory, counts=dict(self._counts), sha256=digest)

    def _channel(self, topic: str, type_name: str) -> int:
        if topic not in self._channels:
            if type_name not in self._schemas:
                text = self._definitions.text(type_name).encode('utf-8')
                self._schemas[type_name] = self._writer.register_schema(
                    name=type_name, encoding='ros2msg', data=text
                )
            channel = self._writer.register_channel(
                topic=topic,
                message_encoding='cdr',
                schema_id=self._schemas[type_name],
                metadata={'offered_qos_profiles': yaml.safe_dump([_qos(topic)])},
            )
            self._channels[topic] = (channel, type_name)
            self._counts[topic] = 0
        return self._channels[topic][0]

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

    def _metadata(self, digest: str) -> dict[str, object]:
        first = self._first_ns or 0
        total = sum(self._counts.values())
        start = {'nanoseconds_since_epoch': first}
        length = {'nanoseconds': self._last_ns - first}
        topics = [
            {
                'message_count': self._counts[topic],
                'topic_metadata': {
                    'name': topic,
                    'type': type_name,
                    'serialization_format': 'cdr',
                    'offered_qos_profiles': [_qos(topic)],
                    'type_description_hash': self._definitions.type_hash(type_name),
                },
            }
            for topic, (_, type_name) in sorted(self._channels.items())
        ]
        return {
            'rosbag2_bagfile_information': {
                'version': METADATA_VERSION,
                'storage_identifier': 'mcap',
                'ros_distro': 'jazzy',
                'compression_format': '',
                'compression_mode': '',
                'duration': length,
                'starting_time': start,
                'message_count': total,
                'relative_file_paths': [self._file_name],
                'files': [
                    {
                        'path': self._file_name,
                        'starting_time': start,
                        'duration': length,
                        'message_count': total,
                    }
                ],
                'topics_with_message_count': topics,
                'custom_data': {'aurora_file_sha256': digest},
            }
        }


def file_sha256(path: Path) -> str:
    """Return the sha256 (hex) of a file."""
    with path.open('rb') as stream:
        return hashlib.file_digest(stream, 'sha256').hexdigest()


def _qos(topic: str) -> dict[str, object]:
    forever = {'sec': 9223372036, 'nsec': 854775807}
    latched = topic in _LATCHED
    return {
        'history': 'keep_last' if latched else 'keep_all',
        'depth': 1 if latched else 0,
        'reliability': 'best_effort' if topic == '/clock' else 'reliable',
        'durability': 'transient_local' if latched else 'volatile',
        'deadline': forever,
        'lifespan': forever,
        'liveliness': 'automatic',
        'liveliness_lease_duration': forever,
        'avoid_ros_namespace_conventions': False,
    }
