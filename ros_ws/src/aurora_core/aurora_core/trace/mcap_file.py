# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write an MCAP file chunk by chunk (https://mcap.dev/spec).

`mcap.writer` walks through every field of every message, which took a quarter of a local run. Here
the messages of a chunk are packed in one go; whatever is not a message is a record of `mcap`.
"""

from __future__ import annotations

import struct
import zlib
from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import BinaryIO

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    Header,
    McapRecord,
    Metadata,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

_MAGIC = b'\x89MCAP0\r\n'
_COMPRESSION = 'zstd'
# As few bytes as level 1 in two thirds of its time: the rows of a tick repeat what is eight bytes
# long, and a table of 4 KiB stays beside what the simulators keep in the caches.
_PARAMETERS = zstandard.ZstdCompressionParameters(
    window_log=17,
    hash_log=10,
    chain_log=10,
    min_match=7,
    strategy=zstandard.STRATEGY_FAST,
    write_content_size=1,
)
# Opcode, length of what follows, first and last time, bytes and checksum before compression, name
# of the compression, bytes of what it gave.
_CHUNK_HEAD = struct.Struct('<BQQQQII4sQ')
_CHUNK_FIELDS = _CHUNK_HEAD.size - 9  # what the length counts beside the data
# Opcode, length of what follows, channel, sequence, log time, publish time.
_MESSAGE_HEAD = struct.Struct('<BQHIQQ')
_MESSAGE_FIELDS = _MESSAGE_HEAD.size - 9  # what the length counts beside the data
_INDEX_HEAD = struct.Struct('<BQHI')
# A message of a chunk: channel (number that `add_channel` returned), sequence of that channel, log
# time and publish time (ns), encoding.
Entry = tuple[int, int, int, bytes]


class McapFile:
    """An MCAP file with Zstandard chunks and every index; what it writes is never buffered here.

    Args:
        stream: Binary, at its beginning.
        library: Named in the header.

    Raises:
        OSError: From every method: the stream cannot be written.
    """

    def __init__(self, stream: BinaryIO, *, library: str) -> None:
        self._stream = stream
        self._compressor = zstandard.ZstdCompressor(compression_params=_PARAMETERS)
        self._schemas: list[Schema] = []
        self._channels: list[Channel] = []
        self._chunks: list[ChunkIndex] = []
        self._metadata: list[MetadataIndex] = []
        self._counts: dict[int, int] = {}
        self._times_ns: tuple[int, int] | None = None
        # Schemas and channels for the head of the next chunk.
        self._head = bytearray()
        stream.write(_MAGIC + _bytes(Header(profile='ros2', library=library)))

    def add_schema(self, name: str, encoding: str, data: bytes) -> int:
        """Define a schema and return its number."""
        schema = Schema(id=len(self._schemas) + 1, name=name, encoding=encoding, data=data)
        self._schemas.append(schema)
        self._head += _bytes(schema)
        return schema.id

    def add_channel(
        self, topic: str, encoding: str, schema: int, metadata: Mapping[str, str]
    ) -> int:
        """Define a channel and return its number."""
        number = len(self._channels) + 1
        channel = Channel(
            id=number,
            topic=topic,
            message_encoding=encoding,
            schema_id=schema,
            metadata=dict(metadata),
        )
        self._channels.append(channel)
        self._counts[number] = 0
        self._head += _bytes(channel)
        return number

    def add_chunk(self, messages: Sequence[Entry]) -> None:
        """Write messages as one chunk with its indexes; nothing for none."""
        if not messages:
            return
        content, offsets = self._content(messages)
        times_ns = [message[2] for message in messages]
        first_ns, last_ns = min(times_ns), max(times_ns)
        compressed = self._compressor.compress(content)
        head = _CHUNK_HEAD.pack(
            Opcode.CHUNK, _CHUNK_FIELDS + len(compressed), first_ns, last_ns, len(content),
            zlib.crc32(content), len(_COMPRESSION), _COMPRESSION.encode(), len(compressed),
        )  # fmt: skip
        chunk_length = len(head) + len(compressed)
        start = self._stream.tell()
        index_offsets: dict[int, int] = {}
        indexes = bytearray()
        for channel, pairs in offsets.items():
            index_offsets[channel] = start + chunk_length + len(indexes)
            indexes += _message_index(channel, pairs)
            self._counts[channel] += len(pairs) // 2
        self._stream.write(b''.join((head, compressed, indexes)))
        self._chunks.append(
            ChunkIndex(
                message_start_time=first_ns,
                message_end_time=last_ns,
                chunk_start_offset=start,
                chunk_length=chunk_length,
                message_index_offsets=index_offsets,
                message_index_length=len(indexes),
                compression=_COMPRESSION,
                compressed_size=len(compressed),
                uncompressed_size=len(content),
            )
        )
        known_ns = self._times_ns or (first_ns, last_ns)
        self._times_ns = min(known_ns[0], first_ns), max(known_ns[1], last_ns)

    def add_metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Write a Metadata record."""
        offset = self._stream.tell()
        record = _bytes(Metadata(name=name, metadata=dict(values)))
        self._stream.write(record)
        self._metadata.append(MetadataIndex(offset=offset, length=len(record), name=name))

    def finish(self) -> None:
        """Write summary and footer; the stream stays open."""
        self._stream.write(bytes(self._head) + _bytes(DataEnd(data_section_crc=0)))
        self._head.clear()
        start = self._stream.tell()
        summary = bytearray()
        groups = bytearray()
        for opcode, records in self._summary():
            content = _bytes(*records)
            if content:
                offset = SummaryOffset(
                    group_opcode=opcode,
                    group_start=start + len(summary),
                    group_length=len(content),
                )
                summary += content
                groups += _bytes(offset)
        offsets_start = start + len(summary)
        summary += groups
        # The checksum covers the footer up to itself.
        footer = struct.pack('<BQQQ', Opcode.FOOTER, 8 + 8 + 4, start, offsets_start)
        summary_crc = zlib.crc32(footer, zlib.crc32(summary))
        end = Footer(
            summary_start=start, summary_offset_start=offsets_start, summary_crc=summary_crc
        )
        self._stream.write(bytes(summary) + _bytes(end) + _MAGIC)

    def _content(self, messages: Sequence[Entry]) -> tuple[bytes, dict[int, list[int]]]:
        """Return the records of a chunk, and by channel time and place of each in turn."""
        parts = [bytes(self._head)]
        self._head.clear()
        place = len(parts[0])
        offsets: dict[int, list[int]] = defaultdict(list)
        pack, message = _MESSAGE_HEAD.pack, int(Opcode.MESSAGE)
        for channel, sequence, time_ns, data in messages:
            offsets[channel] += (time_ns, place)
            length = _MESSAGE_FIELDS + len(data)
            parts += (pack(message, length, channel, sequence, time_ns, time_ns), data)
            place += 9 + length
        return b''.join(parts), offsets

    def _summary(self) -> Iterable[tuple[Opcode, Sequence[McapRecord]]]:
        first_ns, last_ns = self._times_ns or (0, 0)
        statistics = Statistics(
            attachment_count=0,
            channel_count=len(self._channels),
            channel_message_counts={n: count for n, count in self._counts.items() if count},
            chunk_count=len(self._chunks),
            message_count=sum(self._counts.values()),
            message_start_time=first_ns,
            message_end_time=last_ns,
            metadata_count=len(self._metadata),
            schema_count=len(self._schemas),
        )
        return (
            (Opcode.SCHEMA, self._schemas),
            (Opcode.CHANNEL, self._channels),
            (Opcode.STATISTICS, [statistics]),
            (Opcode.CHUNK_INDEX, self._chunks),
            (Opcode.METADATA_INDEX, self._metadata),
        )


def _bytes(*records: McapRecord) -> bytes:
    builder = RecordBuilder()
    for record in records:
        record.write(builder)
    end: Callable[[], bytes] = builder.end
    return end()


def _message_index(channel: int, pairs: Sequence[int]) -> bytes:
    """Return a MessageIndex of times and places in turn."""
    size = 8 * len(pairs)
    head = _INDEX_HEAD.pack(Opcode.MESSAGE_INDEX, 2 + 4 + size, channel, size)
    return head + struct.pack(f'<{len(pairs)}Q', *pairs)
