# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`metadata.yaml` comes back as it was written, is written whole, never believed blindly."""

from __future__ import annotations

import errno
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from aurora_core.trace.bag_metadata import (
    METADATA,
    BagMetadata,
    RecordedTopic,
    read_metadata,
    write_metadata,
)

WRITTEN = BagMetadata(
    file_name='bag.0_0.mcap',
    sha256='12' * 32,
    file_bytes=1234,
    content_sha256='00' * 32,
    recovered_from='11' * 32,
    first_ns=0,
    last_ns=0,
    topics={'/t': RecordedTopic(type_name='std_msgs/msg/String', type_hash='RIHS01_1', count=3)},
)


def test_what_is_written_is_read(tmp_path: Path) -> None:
    write_metadata(tmp_path, WRITTEN)
    assert read_metadata(tmp_path) == WRITTEN
    plain = replace(WRITTEN, recovered_from='', file_bytes=None)
    write_metadata(tmp_path, plain)
    assert read_metadata(tmp_path) == plain
    assert [path.name for path in tmp_path.iterdir()] == [METADATA]


def test_a_full_disk_leaves_the_old_file_and_no_half_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_metadata(tmp_path, WRITTEN)

    def full(_descriptor: int) -> None:
        raise OSError(errno.ENOSPC, 'No space left on device')

    monkeypatch.setattr('os.fsync', full)
    with pytest.raises(OSError, match='No space'):
        write_metadata(tmp_path, replace(WRITTEN, sha256=''))
    assert read_metadata(tmp_path) == WRITTEN
    assert [path.name for path in tmp_path.iterdir()] == [METADATA]


@pytest.mark.parametrize(
    'change',
    [
        lambda text: '',
        lambda text: '[' * 100_000,
        lambda text: 'rosbag2_bagfile_information: []',
        lambda text: text.replace('relative_file_paths', 'other'),
        lambda text: text.replace("'1234'", 'many'),
        lambda text: text.replace('message_count: 3', 'message_count: many'),
        lambda text: text + '#' * (2 << 20),
        lambda text: '!!python/object/apply:os.system ["true"]',
    ],
)
def test_what_is_no_metadata_is_a_value_error(tmp_path: Path, change: Any) -> None:
    write_metadata(tmp_path, WRITTEN)
    path = tmp_path / METADATA
    path.write_text(change(path.read_text()))
    with pytest.raises(ValueError):
        read_metadata(tmp_path)
