# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every record of a sound file, every defect of a damaged one, one chunk in memory at most."""

from __future__ import annotations

import struct
import tracemalloc
from collections.abc import Callable
from pathlib import Path

import pytest
import zstandard
from mcap.records import Footer, Header, Message
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer

from aurora_core.trace.mcap_scan import MAGIC, Defect, scan

MARK = b'\x04\x00\x00\x00zstd'
TO_MARK = 9 + 32  # bytes of a chunk record before its compression: head, times, size, checksum


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Five chunks of twenty messages."""
    path = tmp_path / 'a.mcap'
    with path.open('wb') as stream:
        writer = Writer(stream, compression=CompressionType.ZSTD)
        writer.start(profile='ros2', library='test')
        channel = writer.register_channel('/t', 'cdr', 0)
        for k in range(100):
            writer.add_message(channel, k * 10**9, bytes([k]) * 300, k * 10**9, k)
            if k % 20 == 19:
                writer.flush()  # type: ignore[no-untyped-call]
                writer.add_metadata('note', {'k': str(k)})
        writer.finish()  # type: ignore[no-untyped-call]
    return path


def _numbers(path: Path) -> list[int]:
    return [r.sequence for r in scan(path) if isinstance(r, Message)]


def _defects(path: Path, *, check_index: bool = False) -> list[Defect]:
    return [r for r in scan(path, check_index=check_index) if isinstance(r, Defect)]


def _chunks(data: bytes | bytearray) -> list[int]:
    """Return where the chunk records begin."""
    found, at = [], data.find(MARK)
    while at >= 0:
        found.append(at - TO_MARK + 4)
        at = data.find(MARK, at + 1)
    return [offset for offset in found if data[offset] == 6]


def test_a_sound_file_has_the_records_that_mcap_reads_and_no_defect(file: Path) -> None:
    found = list(scan(file, check_index=True))
    with file.open('rb') as stream:
        expected = [r for r in StreamReader(stream).records if isinstance(r, Message)]
    assert [r for r in found if isinstance(r, Message)] == expected
    assert not [r for r in found if isinstance(r, Defect)]
    assert isinstance(found[0], Header)
    assert isinstance(found[-1], Footer)


def test_a_chunk_that_fails_its_checksum_is_left_out_and_the_next_one_is_read(file: Path) -> None:
    data = bytearray(file.read_bytes())
    start = _chunks(data)[2]
    data[start + 25] ^= 1  # its uncompressed size
    file.write_bytes(data)
    assert _numbers(file) == [k for k in range(100) if not 40 <= k < 60]
    [defect] = _defects(file)
    assert (defect.offset, defect.messages, defect.cut) == (start, 20, False)
    assert (defect.start_ns, defect.end_ns) == (40 * 10**9, 59 * 10**9)


@pytest.mark.parametrize('length', [0, 5, 1 << 20, (1 << 64) - 1])
def test_a_wrong_length_does_not_hide_what_follows(file: Path, length: int) -> None:
    data = bytearray(file.read_bytes())
    start = _chunks(data)[1]
    data[start + 1 : start + 9] = struct.pack('<Q', length)
    file.write_bytes(data)
    assert _numbers(file) == [k for k in range(100) if not 20 <= k < 40]
    assert any(defect.offset == start for defect in _defects(file))


def test_every_cut_is_a_cut_and_keeps_every_whole_chunk(file: Path) -> None:
    whole = file.read_bytes()
    begins = _chunks(whole)
    for offset in range(0, len(whole), 37):
        file.write_bytes(whole[:offset])
        defects = _defects(file)
        assert defects
        assert defects[-1].cut, offset
        sure = sum(begin <= offset for begin in begins[1:]) * 20
        assert len(_numbers(file)) >= sure, offset


def test_zeroes_at_the_end_count_as_cut(file: Path) -> None:
    whole = file.read_bytes()
    half = _chunks(whole)[3] + 60  # inside of the fourth chunk
    file.write_bytes(whole[:half].ljust(len(whole), b'\0'))
    assert _numbers(file) == list(range(60))
    assert all(defect.cut for defect in _defects(file))


@pytest.mark.parametrize(
    ('data', 'said'),
    [
        (b'', 'empty'),
        (MAGIC[:3], 'first bytes'),
        (b'#!/bin/sh\necho hello\n', 'no MCAP file'),
        (bytes(5000), 'no MCAP file'),
    ],
)
def test_what_is_no_bag_is_called_so(file: Path, data: bytes, said: str) -> None:
    file.write_bytes(data)
    [defect] = _defects(file)
    assert said in defect.text


def test_a_changed_index_is_found_when_it_is_looked_for(file: Path) -> None:
    data = bytearray(file.read_bytes())
    index = data.index(b'\x07', _chunks(data)[0] + TO_MARK + 12)
    while struct.unpack_from('<Q', data, index + 1)[0] != 6 + 16 * 20:
        index = data.index(b'\x07', index + 1)
    data[index + 20] ^= 4
    file.write_bytes(data)
    assert _defects(file) == []
    [defect] = _defects(file, check_index=True)
    assert defect.offset == index


def test_a_changed_summary_and_what_follows_the_end(file: Path) -> None:
    whole = file.read_bytes()
    data = bytearray(whole)
    data[whole.rindex(b'/t')] ^= 1
    file.write_bytes(data)
    assert 'summary' in _defects(file)[0].text
    file.write_bytes(whole + b'more')
    assert '4 bytes follow the end' in _defects(file)[0].text
    file.write_bytes(whole[:-8] + b'notmagic')
    assert 'mark at the end' in _defects(file)[0].text


def _chunk(size: int, data: bytes) -> bytes:
    body = struct.pack('<QQQI', 0, 0, size, 0) + MARK + struct.pack('<Q', len(data)) + data
    return b'\x06' + struct.pack('<Q', len(body)) + body


@pytest.mark.parametrize('claimed', [100, 1 << 40, (1 << 64) - 1])
def test_a_chunk_that_unpacks_to_more_than_it_may(
    file: Path, claimed: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr('aurora_core.trace.mcap_scan.CHUNK_LIMIT', 1 << 20)
    packed = zstandard.ZstdCompressor(level=1).compress(bytes(32 << 20))
    file.write_bytes(MAGIC + _chunk(claimed, packed) + file.read_bytes()[8:])
    tracemalloc.start()
    defects, count = _defects(file), len(_numbers(file))
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert 'a damaged chunk' in defects[0].text
    assert count == 100
    assert peak < 8 << 20


def test_any_number_of_false_chunks_takes_no_time(
    file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[int] = []

    def never(_self: object, offset: int) -> bool:
        looked.append(offset)
        return False

    monkeypatch.setattr('aurora_core.trace.mcap_scan._Scan._is_chunk', never)
    file.write_bytes(MAGIC + b'\xff' * 60 + MARK * 10_000)
    assert _defects(file)[0].cut
    assert len(looked) <= 64


def test_random_damage_never_raises_and_never_makes_up_a_message(
    file: Path, fuzz: Callable[[bytes, int], bytes]
) -> None:
    whole = file.read_bytes()
    known = {r.data for r in scan(file) if isinstance(r, Message)}
    for seed in range(150):
        file.write_bytes(fuzz(whole, seed))
        found = list(scan(file, check_index=True))
        # Not every bit is under a checksum of the format; messages are.
        assert {r.data for r in found if isinstance(r, Message)} <= known, seed
