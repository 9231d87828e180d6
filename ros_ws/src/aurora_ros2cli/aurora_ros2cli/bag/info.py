# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 bag info`."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from pathlib import Path

import yaml
from rosbags.rosbag2 import Reader

from aurora_ros2cli.bag.reading import add_bag_arguments, opened
from aurora_ros2cli.output import emit

_INDENT = ' ' * 19
_STORAGE = {'.mcap': 'mcap', '.db3': 'sqlite3'}
_NS = 1_000_000_000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the options."""
    add_bag_arguments(parser)
    parser.add_argument(
        '-t', '--topic-name', action='store_true', help='Only display topic names.'
    )
    parser.add_argument(
        '-v', '--verbose', action='store_true', help='Accepted; services are not recorded here'
    )


def main(arguments: argparse.Namespace) -> int:
    """Print what a bag holds.

    Raises:
        CliError: If it cannot be read.
    """
    path = arguments.bag_path
    with opened(path) as reader:
        if arguments.topic_name:
            for name in sorted(reader.topics):
                emit(name)
            return 0
        files, storage, base = _files(path)
        size = sum((base / name).stat().st_size for name in files)
        lines = list(summary(reader, files, storage, size))
    emit('\n' + '\n'.join(lines))
    return 0


def _files(path: Path) -> tuple[list[str], str, Path]:
    if path.is_dir():
        text = (path / 'metadata.yaml').read_text(encoding='utf-8')
        information = yaml.safe_load(text)['rosbag2_bagfile_information']
        names = [Path(name).name for name in information['relative_file_paths']]
        return names, str(information['storage_identifier']), path
    return [path.name], _STORAGE.get(path.suffix, 'unknown'), path.parent


def summary(reader: Reader, files: list[str], storage: str, size: int) -> Iterator[str]:
    """Yield the lines of the table.

    Args:
        reader: An open bag.
        files: Names of its files.
        storage: Storage identifier.
        size: Of all files (bytes).
    """
    # rosbags counts to just after the last message.
    empty = reader.message_count == 0
    start_ns = 0 if empty else reader.start_time
    duration_ns = 0 if empty else reader.duration - 1
    yield f'Files:             {f"{chr(10)}{_INDENT}".join(files)}'
    yield f'Bag size:          {file_size(size)}'
    yield f'Storage id:        {storage}'
    yield f'ROS Distro:        {reader.ros_distro or "unknown"}'
    yield f'Duration:          {seconds(duration_ns)}s'
    yield f'Start:             {time_point(start_ns)}'
    yield f'End:               {time_point(start_ns + duration_ns)}'
    yield f'Messages:          {reader.message_count}'
    topics = [
        f'Topic: {name} | Type: {topic.msgtype} | Count: {topic.msgcount} | '
        'Serialization Format: cdr'
        for name, topic in sorted(reader.topics.items())
    ]
    yield f'Topic information: {f"{chr(10)}{_INDENT}".join(topics)}'
    yield 'Service:           0'
    yield 'Service information: '


def seconds(nanoseconds: int) -> str:
    """Return a time in seconds with nine decimals."""
    return f'{nanoseconds // _NS}.{nanoseconds % _NS:09d}'


def time_point(nanoseconds: int) -> str:
    """Return a date and time of day in the local zone, then the seconds since 1970."""
    local = time.localtime(nanoseconds // _NS)
    day = f'{time.strftime("%b", local)} {local.tm_mday:2d} {local.tm_year}'
    fraction = f'{nanoseconds % _NS:09d}'
    return f'{day} {time.strftime("%H:%M:%S", local)}.{fraction} ({seconds(nanoseconds)})'


def file_size(size: int) -> str:
    """Return a number of bytes with a unit of 1024 each."""
    value = float(size)
    units = ['B', 'KiB', 'MiB', 'GiB', 'TiB']
    while value >= 1024 and len(units) > 1:
        value /= 1024
        units.pop(0)
    return f'{size} B' if units[0] == 'B' else f'{value:.1f} {units[0]}'
