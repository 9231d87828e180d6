# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read the records of an MCAP file that may be damaged: every defect with its place, no surprise.

The reader of the `mcap` package stops at the first defect and believes the lengths that a file
states. This one checks every length against the file and every chunk against its checksum, takes
nothing from a chunk that fails it, goes on behind it, and never holds more than one chunk.

Source: MCAP specification, https://mcap.dev/spec (records, opcodes, CRC fields).
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from io import BytesIO
from pathlib import Path
from typing import BinaryIO

import zstandard
from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile, McapError
from mcap.opcode import Opcode
from mcap.records import (
    Channel,
    DataEnd,
    Footer,
    Header,
    Message,
    MessageIndex,
    Metadata,
    Schema,
    Statistics,
)

from aurora_core.files import BAG_BYTES, open_regular

MAGIC = b'\x89MCAP0\r\n'
# Our chunks have a megabyte and one message more; a record that is longer is not believed.
CHUNK_LIMIT = 64 << 20

_HEAD = struct.Struct('<BQ')
_MESSAGE = struct.Struct('<HIQQ')
# Plain number: before Python 3.12 a member is slow to look up, and each message asks.
_MESSAGE_OPCODE = int(Opcode.MESSAGE)
_CHUNK = struct.Struct('<QQQII')
_ZSTD = b'\x04\x00\x00\x00zstd'
_ZSTD_AT = _HEAD.size + _CHUNK.size - 4  # offset of that mark in a chunk record
_WINDOW = 1 << 20
_ZEROES = 16
# A file made to deceive may hold any number of false chunk starts.
_TRIES = 64
_KNOWN = frozenset(int(opcode) for opcode in Opcode)
_BROKEN = (McapError, struct.error, ValueError, LookupError, OverflowError)

Record = Schema | Channel | Message | Metadata | DataEnd | Footer | Header | Statistics


@dataclass(frozen=True, slots=True, kw_only=True)
class Defect:
    """Something that is not as it was written.

    Attributes:
        offset: Byte in the file.
        text: What, for people.
        cut: The file ends there although more was to come.
        messages: Number of messages that were lost with it, None when nobody can tell.
        start_ns: Simulated time at which the loss begins, None when nobody can tell.
        end_ns: Simulated time at which it ends.
    """

    offset: int
    text: str
    cut: bool = False
    messages: int | None = 0
    start_ns: int | None = None
    end_ns: int | None = None

    def __str__(self) -> str:
        return f'{self.text} (byte {self.offset})'


class _Exact(ReadDataStream):
    """Raises where the stream of the package returns fewer bytes than were asked for."""

    def read(self, length: int) -> bytes:
        data = super().read(length)
        if len(data) < length:
            raise EndOfFile
        return data


def scan(path: Path, *, check_index: bool = False) -> Iterator[Record | Defect]:
    """Yield the records of a file and its defects, in the order of the file.

    Args:
        path: The file.
        check_index: Compare the message indexes with the messages too (costs time).

    Raises:
        OSError: The file cannot be read at all.
    """
    with open_regular(path, BAG_BYTES) as stream:
        yield from _Scan(stream, path.stat().st_size, check_index).run()


class _Scan:
    def __init__(self, stream: BinaryIO, size: int, check_index: bool) -> None:
        self._stream = stream
        self._size = size
        self._check_index = check_index
        # Of the last chunk; None when it was damaged.
        self._index: dict[int, list[tuple[int, int]]] | None = None
        self._ended = False
        self._footer = False

    def run(self) -> Iterator[Record | Defect]:
        offset = len(MAGIC)
        if self._read(0, len(MAGIC)) != MAGIC:
            found = self._resync(0)
            if found is None:
                yield Defect(offset=0, text=self._no_bag(), cut=self._size == 0, messages=None)
                return
            yield Defect(offset=0, text='the file does not begin as an MCAP file', messages=None)
            offset = found
        while offset < self._size and not self._footer:
            head = self._read(offset, _HEAD.size)
            opcode, length = _HEAD.unpack(head) if len(head) == _HEAD.size else (0, self._size)
            after = offset + _HEAD.size + length
            broken = self._broken_frame(opcode, offset, length)
            found = self._resync(offset + 1) if broken is not None else None
            if broken is None:
                yield from self._record(opcode, offset, length)
                offset = after
            elif found is None:
                yield broken
                return
            else:
                text = f'{found - offset} bytes that are no records'
                yield Defect(offset=offset, text=text, messages=None)
                offset = found
        yield from self._end(offset)

    def _end(self, offset: int) -> Iterator[Defect]:
        if not self._footer:
            yield Defect(
                offset=offset,
                text='the recording was never closed: the file has no end',
                cut=True,
                messages=None if not self._ended else 0,
            )
            return
        tail = self._read(offset, len(MAGIC))
        if tail != MAGIC:
            yield Defect(
                offset=offset, text='the mark at the end of the file is missing', cut=True
            )
        elif offset + len(MAGIC) < self._size:
            rest = self._size - offset - len(MAGIC)
            yield Defect(offset=offset + len(MAGIC), text=f'{rest} bytes follow the end')

    def _no_bag(self) -> str:
        if self._size == 0:
            return 'the file is empty'
        start = self._read(0, 16)
        if MAGIC.startswith(start[: len(MAGIC)]) and self._size < len(MAGIC):
            return 'the file breaks off in its first bytes'
        return f'this is no MCAP file: it begins with {start!r}'

    def _broken_frame(self, opcode: int, offset: int, length: int) -> Defect | None:
        """Return what is wrong when there is no whole record at an offset."""
        after = offset + _HEAD.size + length
        if opcode == 0 and self._is_zero_from(offset):
            text = f'the last {self._size - offset} bytes are zero'
        elif after > self._size:
            text = f'the file breaks off inside a record of {after - offset} bytes'
        elif opcode in _KNOWN and self._goes_on(opcode, after):
            return None
        else:
            text = f'a record of kind {opcode:#04x} and {length} bytes that none can follow'
        # Behind the end of the data is only the index: nothing that was measured is lost with it.
        return Defect(offset=offset, text=text, cut=True, messages=0 if self._ended else None)

    def _goes_on(self, opcode: int, offset: int) -> bool:
        """Tell whether a record, the end or the edge of a cut file stands at an offset.

        A length with a flipped bit would else skip over sound chunks, or end inside of one.
        """
        if opcode == Opcode.FOOTER or offset + _HEAD.size > self._size:
            return True
        first = self._read(offset, 1)[0]
        return first in _KNOWN or (first == 0 and self._is_zero_from(offset))

    def _record(self, opcode: int, offset: int, length: int) -> Iterator[Record | Defect]:
        if opcode == Opcode.MESSAGE_INDEX and not self._check_index:
            return
        if length > CHUNK_LIMIT:
            yield Defect(
                offset=offset,
                text=f'a record of {length} bytes is longer than any that is recorded',
                messages=None,
            )
            return
        body = self._read(offset + _HEAD.size, length)
        try:
            if opcode == Opcode.CHUNK:
                yield from self._chunk(body, offset)
            elif opcode == Opcode.MESSAGE_INDEX:
                self._compare_index(MessageIndex.read(_stream(body)))
            else:
                record = _parse(opcode, body)
                if isinstance(record, Footer):
                    self._footer = True
                    yield from self._check_summary(record, offset)
                self._ended |= isinstance(record, DataEnd)
                if record is not None:
                    yield record
        except _BROKEN as err:
            kind = Opcode(opcode).name.lower().replace('_', ' ')
            lost = None if opcode in (Opcode.MESSAGE, Opcode.SCHEMA, Opcode.CHANNEL) else 0
            text = f'a damaged {kind} record ({_what(err)})'
            yield Defect(offset=offset, text=text, messages=lost)

    def _chunk(self, body: bytes, offset: int) -> Iterator[Record | Defect]:
        self._index = None
        records, start_ns, end_ns, problem = _unpack_chunk(body)
        if problem:
            known = start_ns <= end_ns
            end = offset + _HEAD.size + len(body)
            yield Defect(
                offset=offset,
                text=f'a damaged chunk of messages: {problem}',
                messages=self._indexed_messages(end),
                # A file system that lost its last pages leaves zeroes there.
                cut=not any(body[-_ZEROES:]) and self._is_zero_from(end),
                start_ns=start_ns if known else None,
                end_ns=end_ns if known else None,
            )
            return
        at = 0
        times = []
        index: dict[int, list[tuple[int, int]]] = {}
        while at < len(records):
            opcode, length = _HEAD.unpack_from(records, at)
            content = at + _HEAD.size
            if content + length > len(records):
                raise ValueError('a record reaches beyond its chunk')
            if opcode == _MESSAGE_OPCODE:
                if length < _MESSAGE.size:
                    raise ValueError('a message without a head')
                channel, sequence, log_ns, publish_ns = _MESSAGE.unpack_from(records, content)
                if self._check_index:
                    index.setdefault(channel, []).append((log_ns, at))
                    times.append(log_ns)
                data = records[content + _MESSAGE.size : content + length]
                yield Message(channel, log_ns, data, publish_ns, sequence)
            elif opcode in (Opcode.SCHEMA, Opcode.CHANNEL):
                record = _parse(opcode, records[content : content + length])
                if record is not None:
                    yield record
            at = content + length
        self._index = index
        if times and (min(times), max(times)) != (start_ns, end_ns):
            yield Defect(offset=offset, text='the times of a chunk are not those of its messages')

    def _compare_index(self, found: MessageIndex) -> None:
        if self._index is not None and self._index.get(found.channel_id) != found.records:
            raise ValueError('it does not fit the messages')

    def _indexed_messages(self, offset: int) -> int | None:
        """Return how many messages the indexes behind a chunk name, None without any."""
        count, seen = 0, False
        while True:
            head = self._read(offset, _HEAD.size)
            if len(head) < _HEAD.size:
                break
            opcode, length = _HEAD.unpack(head)
            if opcode != Opcode.MESSAGE_INDEX or length > self._size - offset:
                break
            count += max(0, length - 6) // 16
            seen = True
            offset += _HEAD.size + length
        return count if seen else None

    def _check_summary(self, footer: Footer, offset: int) -> Iterator[Defect]:
        if footer.summary_crc == 0 or not self._ended:
            return
        start = footer.summary_start if footer.summary_start else offset
        covered = offset + _HEAD.size + 16
        crc, at = 0, start
        while at < covered:
            piece = self._read(at, min(_WINDOW, covered - at))
            crc = zlib.crc32(piece, crc)
            at += max(1, len(piece))
        if start > offset or crc != footer.summary_crc:
            yield Defect(offset=start, text='the summary at the end fails its checksum')

    def _resync(self, offset: int) -> int | None:
        """Return where the next sound chunk begins."""
        tries = 0
        while offset < self._size:
            window = self._read(offset, _WINDOW + len(_ZSTD))
            mark = window.find(_ZSTD)
            while mark >= 0 and tries < _TRIES:
                start = offset + mark - _ZSTD_AT
                if start >= 0 and self._is_chunk(start):
                    return start
                tries += 1
                mark = window.find(_ZSTD, mark + 1)
            offset += _WINDOW
        return None

    def _is_chunk(self, offset: int) -> bool:
        head = self._read(offset, _HEAD.size)
        if len(head) < _HEAD.size:
            return False
        opcode, length = _HEAD.unpack(head)
        if opcode != Opcode.CHUNK or length > min(CHUNK_LIMIT, self._size - offset):
            return False
        try:
            return not _unpack_chunk(self._read(offset + _HEAD.size, length))[3]
        except _BROKEN:
            return False

    def _is_zero_from(self, offset: int) -> bool:
        while offset < self._size:
            piece = self._read(offset, _WINDOW)
            if piece.count(0) != len(piece):
                return False
            offset += len(piece)
        return True

    def _read(self, offset: int, length: int) -> bytes:
        self._stream.seek(offset)
        return self._stream.read(length)


def _unpack_chunk(body: bytes) -> tuple[bytes, int, int, str]:
    """Return (records, first and last time in ns, what is wrong).

    Raises:
        struct.error: The body is shorter than its fields.
    """
    start_ns, end_ns, size, crc, name_length = _CHUNK.unpack_from(body)
    at = _CHUNK.size + name_length
    name = body[_CHUNK.size : at]
    (length,) = struct.unpack_from('<Q', body, at)
    data = body[at + 8 : at + 8 + length]
    problem = ''
    if at + 8 + length != len(body):
        problem = 'its lengths contradict each other'
    elif size > CHUNK_LIMIT:
        problem = f'it claims to hold {size} bytes'
    elif name == b'zstd':
        reader = zstandard.ZstdDecompressor(max_window_size=CHUNK_LIMIT)
        try:
            data = reader.stream_reader(data).read(size + 1)
        except (zstandard.ZstdError, MemoryError) as err:
            problem = f'it cannot be decompressed ({_what(err)})'
    elif name:
        problem = f'it is compressed as {name[:16]!r}, expected zstd or nothing'
    if not problem and len(data) != size:
        problem = (
            f'expected {size} bytes in it, found {len(data)}{"" if len(data) < size else "+"}'
        )
    if not problem and crc and zlib.crc32(data) != crc:
        problem = 'it fails its checksum'
    return data, start_ns, end_ns, problem


def _parse(opcode: int, body: bytes) -> Record | None:
    if opcode == Opcode.MESSAGE:
        channel, sequence, log_ns, publish_ns = _MESSAGE.unpack_from(body)
        return Message(
            channel_id=channel,
            log_time=log_ns,
            data=body[_MESSAGE.size :],
            publish_time=publish_ns,
            sequence=sequence,
        )
    readers = {
        Opcode.SCHEMA: Schema.read,
        Opcode.CHANNEL: Channel.read,
        Opcode.METADATA: Metadata.read,
        Opcode.DATA_END: DataEnd.read,
        Opcode.FOOTER: Footer.read,
        Opcode.HEADER: Header.read,
        Opcode.STATISTICS: Statistics.read,
    }
    reader = readers.get(Opcode(opcode))
    return None if reader is None else reader(_stream(body))


def _stream(body: bytes) -> _Exact:
    return _Exact(BytesIO(body))


def _what(err: Exception) -> str:
    return str(err) or type(err).__name__
