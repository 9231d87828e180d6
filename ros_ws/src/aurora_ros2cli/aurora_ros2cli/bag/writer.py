# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write a rosbag2 bag in MCAP that is readable up to the last second, however it ends."""

from __future__ import annotations

import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml
from mcap.writer import CompressionType, Writer

from aurora_ros2cli.bag.schema import schema_text
from aurora_ros2cli.errors import CliError

METADATA_VERSION = 9


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedTopic:
    """A topic of a bag.

    Attributes:
        name: Topic name.
        type_name: `package/msg/Name`.
        type_hash: RIHS01 hash of the type.
        profiles: Of its publishers, in the form of rosbag2.
    """

    name: str
    type_name: str
    type_hash: str
    profiles: tuple[dict[str, Any], ...]


class BagFolder:
    """One bag in one folder, with one MCAP file.

    Args:
        folder: Must not exist.
        distro: Name of the ROS distribution.

    Raises:
        CliError: If the folder exists or cannot be made.
    """

    def __init__(self, folder: Path, distro: str) -> None:
        self._folder = folder
        self._distro = distro
        self._file_name = f'{folder.name}_0.mcap'
        self._topics: dict[str, RecordedTopic] = {}
        self._channels: dict[str, int] = {}
        self._schemas: dict[str, int] = {}
        self._counts: dict[str, int] = {}
        self._first_ns: int | None = None
        self._last_ns = 0
        try:
            folder.mkdir(parents=True)
            self._stream = (folder / self._file_name).open('wb')
        except FileExistsError as err:
            raise CliError(f"[ERROR] [ros2bag]: Output folder '{folder}' already exists.") from err
        except OSError as err:
            raise CliError(f'[ERROR] [ros2bag]: {err}') from err
        self._writer = Writer(self._stream, compression=CompressionType.ZSTD)
        self._writer.start(profile='ros2', library='aurora_ros2cli')
        self._writer.add_metadata('rosbag2', {'ROS_DISTRO': distro})

    @property
    def message_count(self) -> int:
        """Messages written so far."""
        return sum(self._counts.values())

    def add(self, topic: RecordedTopic) -> None:
        """Take up a topic.

        Raises:
            CliError: If its type is not installed here.
        """
        if topic.type_name not in self._schemas:
            self._schemas[topic.type_name] = self._writer.register_schema(
                name=topic.type_name,
                encoding='ros2msg',
                data=schema_text(topic.type_name).encode('utf-8'),
            )
        self._channels[topic.name] = self._writer.register_channel(
            topic=topic.name,
            message_encoding='cdr',
            schema_id=self._schemas[topic.type_name],
            metadata={
                'offered_qos_profiles': yaml.safe_dump(list(topic.profiles)),
                'topic_type_hash': topic.type_hash,
            },
        )
        self._topics[topic.name] = topic
        self._counts[topic.name] = 0

    def write(self, topic: str, data: bytes, *, log_ns: int, publish_ns: int) -> None:
        """Append a message.

        Args:
            topic: A topic that was taken up.
            data: Encoding as it came off the wire.
            log_ns: When it arrived (ns since 1970, or simulated).
            publish_ns: When it was sent (ns).
        """
        self._writer.add_message(
            channel_id=self._channels[topic],
            log_time=log_ns,
            publish_time=publish_ns,
            data=data,
            sequence=self._counts[topic],
        )
        self._counts[topic] += 1
        self._first_ns = log_ns if self._first_ns is None else min(self._first_ns, log_ns)
        self._last_ns = max(self._last_ns, log_ns)

    def flush(self) -> None:
        """Bring everything written so far to the disk."""
        self._writer.flush()  # type: ignore[no-untyped-call]
        os.fsync(self._stream.fileno())

    def close(self) -> None:
        """Finish the file and write the metadata."""
        self._writer.finish()  # type: ignore[no-untyped-call]
        self._stream.flush()
        os.fsync(self._stream.fileno())
        self._stream.close()
        part = self._folder / 'metadata.yaml.part'
        with part.open('w', encoding='utf-8') as stream:
            yaml.safe_dump({'rosbag2_bagfile_information': self._metadata()}, stream)
            stream.flush()
            os.fsync(stream.fileno())
        part.replace(self._folder / 'metadata.yaml')

    def _metadata(self) -> dict[str, Any]:
        start_ns = self._first_ns or 0
        span = {
            'starting_time': {'nanoseconds_since_epoch': start_ns},
            'duration': {'nanoseconds': self._last_ns - start_ns if self._first_ns else 0},
            'message_count': self.message_count,
        }
        return {
            'version': METADATA_VERSION,
            'storage_identifier': 'mcap',
            **span,
            'topics_with_message_count': [
                {
                    'message_count': self._counts[topic.name],
                    'topic_metadata': {
                        'name': topic.name,
                        'type': topic.type_name,
                        'serialization_format': 'cdr',
                        'offered_qos_profiles': list(topic.profiles),
                        'type_description_hash': topic.type_hash,
                    },
                }
                for topic in self._topics.values()
            ],
            'compression_format': '',
            'compression_mode': '',
            'relative_file_paths': [self._file_name],
            'files': [{'path': self._file_name, **span}],
            'custom_data': None,
            'ros_distro': self._distro,
        }
