# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`metadata.yaml` of a rosbag2 bag: written when a recording is closed.

Its absence says that a recording was not closed, its digest whether it was changed since.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from aurora_core.files import BAG_BYTES, UnreadableFileError, open_regular, read_bytes

METADATA = 'metadata.yaml'
METADATA_VERSION = 9
LATCHED = ('/aurora/agsg', '/aurora/roster', '/aurora/world', '/aurora/verdict')

_SHA256 = 'aurora_file_sha256'
_BYTES = 'aurora_file_bytes'
_CONTENT = 'aurora_content_sha256'
_RECOVERED = 'aurora_recovered_from'
# Ours has some 5 kB; what is much longer is not read at all.
_SIZE_LIMIT = 1 << 20
_DEPTH_LIMIT = 50


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedTopic:
    """One topic of a bag.

    Attributes:
        type_name: e.g. `aurora_msgs/msg/Roster`.
        type_hash: RIHS01.
        count: Number of messages.
    """

    type_name: str
    type_hash: str
    count: int


@dataclass(frozen=True, slots=True, kw_only=True)
class BagMetadata:
    """What is known of a closed recording.

    Attributes:
        file_name: The MCAP file.
        sha256: Of the file (hex); '' in a bag of another program.
        file_bytes: Its length, None when it is not told.
        content_sha256: Running digest over all messages; '' when it is not told.
        recovered_from: Digest of the damaged file that this bag was recovered from, else ''.
        first_ns: Earliest simulated time.
        last_ns: Latest simulated time.
        topics: By name.
    """

    file_name: str
    sha256: str
    file_bytes: int | None
    content_sha256: str
    recovered_from: str = ''
    first_ns: int = 0
    last_ns: int = 0
    topics: Mapping[str, RecordedTopic] = field(default_factory=dict)


def write_metadata(folder: Path, metadata: BagMetadata) -> None:
    """Write `metadata.yaml` whole: temporary name, fsync, rename.

    Raises:
        OSError: The disk is full.
    """
    temporary = folder / f'{METADATA}.part'
    try:
        with temporary.open('w', encoding='utf-8') as stream:
            yaml.dump(_document(metadata), stream, Dumper=_DUMPER, sort_keys=True)
            stream.flush()
            os.fsync(stream.fileno())
        temporary.replace(folder / METADATA)
    finally:
        temporary.unlink(missing_ok=True)


def read_metadata(folder: Path) -> BagMetadata:
    """Read `metadata.yaml`.

    Raises:
        OSError: There is none, or it cannot be read.
        ValueError: It is not what a bag has.
    """
    path = folder / METADATA
    try:
        text = read_bytes(path, _SIZE_LIMIT)
        _check_form(text)
        document = yaml.load(text, Loader=_LOADER)  # noqa: S506  (a safe loader)  # nosec B506
        info = document['rosbag2_bagfile_information']
        custom = info.get('custom_data') or {}
        length = custom.get(_BYTES)
        first_ns = int(info['starting_time']['nanoseconds_since_epoch'])
        return BagMetadata(
            file_name=str(info['relative_file_paths'][0]),
            sha256=str(custom.get(_SHA256, '')),
            file_bytes=None if length is None else int(length),
            content_sha256=str(custom.get(_CONTENT, '')),
            recovered_from=str(custom.get(_RECOVERED, '')),
            first_ns=first_ns,
            last_ns=first_ns + int(info['duration']['nanoseconds']),
            topics={
                str(entry['topic_metadata']['name']): RecordedTopic(
                    type_name=str(entry['topic_metadata']['type']),
                    type_hash=str(entry['topic_metadata'].get('type_description_hash', '')),
                    count=int(entry['message_count']),
                )
                for entry in info['topics_with_message_count']
            },
        )
    except UnreadableFileError as err:
        raise ValueError(err.message) from err
    except (yaml.YAMLError, LookupError, TypeError, AttributeError) as err:
        raise ValueError(f'{type(err).__name__}: {err}') from err


def file_sha256(path: Path) -> str:
    """Return the sha256 (hex) of a file."""
    with open_regular(path, BAG_BYTES) as stream:
        return hashlib.file_digest(stream, 'sha256').hexdigest()


def qos(topic: str) -> dict[str, object]:
    """Return the QoS profile that a topic was offered with, as rosbag2 writes it."""
    forever = {'sec': 9223372036, 'nsec': 854775807}
    latched = topic in LATCHED
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


@cache
def offered(topic: str) -> str:
    """Return the YAML in which a recording says how a topic was offered."""
    return str(yaml.dump([qos(topic)], Dumper=_DUMPER))


def _check_form(text: bytes) -> None:
    """Refuse what is nested deeply or tells a key twice.

    The loader in C recurses, and dies when the stack ends; of two values readers take different
    ones.

    Raises:
        ValueError: It is nested deeply, or a key is there twice.
        YAMLError: It is no YAML.
    """
    # Of each open collection the keys so far, None for a list, and whether a key comes next.
    within: list[tuple[set[str] | None, bool]] = []
    for event in yaml.parse(text, Loader=_LOADER):
        if isinstance(event, yaml.CollectionEndEvent):
            within.pop()
        elif isinstance(event, yaml.NodeEvent):
            if within and (keys := within[-1][0]) is not None:
                is_key = within[-1][1]
                within[-1] = keys, not is_key
                if is_key and isinstance(event, yaml.ScalarEvent):
                    if event.value in keys:
                        raise ValueError(f'it tells {event.value!r} twice')
                    keys.add(event.value)
            if isinstance(event, yaml.CollectionStartEvent):
                within.append((set() if isinstance(event, yaml.MappingStartEvent) else None, True))
                if len(within) > _DEPTH_LIMIT:
                    raise ValueError(f'it is nested more than {_DEPTH_LIMIT} deep')


def _document(metadata: BagMetadata) -> dict[str, object]:
    total = sum(topic.count for topic in metadata.topics.values())
    start = {'nanoseconds_since_epoch': metadata.first_ns}
    length = {'nanoseconds': metadata.last_ns - metadata.first_ns}
    custom = {_SHA256: metadata.sha256, _CONTENT: metadata.content_sha256}
    if metadata.file_bytes is not None:
        custom[_BYTES] = str(metadata.file_bytes)
    if metadata.recovered_from:
        custom[_RECOVERED] = metadata.recovered_from
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
            'relative_file_paths': [metadata.file_name],
            'files': [
                {
                    'path': metadata.file_name,
                    'starting_time': start,
                    'duration': length,
                    'message_count': total,
                }
            ],
            'topics_with_message_count': [
                {
                    'message_count': topic.count,
                    'topic_metadata': {
                        'name': name,
                        'type': topic.type_name,
                        'serialization_format': 'cdr',
                        'offered_qos_profiles': [qos(name)],
                        'type_description_hash': topic.type_hash,
                    },
                }
                for name, topic in sorted(metadata.topics.items())
            ],
            'custom_data': custom,
        }
    }


def _safe(kind: str) -> Any:
    # The C versions are ten times as fast; a PyYAML without them works alike.
    return getattr(yaml, f'CSafe{kind}', getattr(yaml, f'Safe{kind}'))


_LOADER = _safe('Loader')
_DUMPER = _safe('Dumper')
