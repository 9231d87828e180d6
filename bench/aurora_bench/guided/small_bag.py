# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A bag of a few ticks, and what a short list of edits makes of it."""

from __future__ import annotations

import io
import struct
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

from mcap.records import Channel, Message, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType, Writer

from aurora_bench.bags.forge import mcap_of

_PROMPT = 'A drone hovers over an intersection at 30 m for 5 seconds.'
_MAP = 'junction'
_COMMAND = 'from aurora_cli.main import main; main()'
_KEPT = 10  # messages of each topic
# Mode of all edits, topic, number of the message, offset, length of the new bytes.
_HEAD = struct.Struct('<BBHIB')
_MOST_EDITS = 40


@dataclass(frozen=True, slots=True, kw_only=True)
class SmallBag:
    """A small recording.

    Attributes:
        channels: With their schemas.
        messages: Of each channel.
        whole: The file that they make.
    """

    channels: tuple[tuple[Schema, Channel], ...]
    messages: tuple[tuple[Message, ...], ...]
    whole: bytes

    @classmethod
    def recorded(cls, folder: Path) -> SmallBag:
        """Return the beginning of a run that is flown for it.

        Args:
            folder: For the run.
        """
        # In a process of its own: instrumented, a run takes minutes.
        options = ['--map', _MAP, '--no-repair', '--out', str(folder / 'runs')]
        subprocess.run(
            [sys.executable, '-c', _COMMAND, 'run', _PROMPT, *options],
            capture_output=True, check=True,
        )  # fmt: skip
        path = mcap_of(next((folder / 'runs').glob('*/bag.0')))
        schemas: dict[int, Schema] = {}
        channels: dict[int, Channel] = {}
        kept: dict[int, list[Message]] = {}
        with path.open('rb') as stream:
            for record in StreamReader(stream).records:
                if isinstance(record, Schema):
                    schemas[record.id] = record
                elif isinstance(record, Channel):
                    channels[record.id] = record
                elif isinstance(record, Message):
                    these = kept.setdefault(record.channel_id, [])
                    if len(these) < _KEPT:
                        these.append(record)
        ids = [number for number in channels if number in kept]
        pairs = tuple((schemas[channels[k].schema_id], channels[k]) for k in ids)
        messages = tuple(tuple(kept[k]) for k in ids)
        return cls(channels=pairs, messages=messages, whole=_file(pairs, messages))

    def changed(self, data: bytes) -> bytes:
        """Return the file after the edits that `data` lists, one after the other.

        The first byte says whether they change messages, in a file whose checksums are right, or
        the file.
        """
        if data[:1] and data[0] % 2:
            whole = bytearray(self.whole)
            for _, _, offset, new in _edits(data):
                at = offset % len(whole)
                whole[at : at + len(new)] = new
            return bytes(whole)
        messages = [list(these) for these in self.messages]
        for topic, number, offset, new in _edits(data):
            these = messages[topic % len(messages)]
            old = these[number % len(these)]
            content = bytearray(old.data)
            at = offset % (len(content) + 1)
            content[at : at + len(new)] = new
            these[number % len(these)] = Message(
                channel_id=old.channel_id,
                log_time=old.log_time,
                publish_time=old.publish_time,
                sequence=old.sequence,
                data=bytes(content),
            )
        return _file(self.channels, tuple(tuple(these) for these in messages))


def _edits(data: bytes) -> list[tuple[int, int, int, bytes]]:
    found: list[tuple[int, int, int, bytes]] = []
    at = 0
    while at + _HEAD.size <= len(data) and len(found) < _MOST_EDITS:
        _, topic, number, offset, length = _HEAD.unpack_from(data, at)
        at += _HEAD.size
        found.append((topic, number, offset, data[at : at + length]))
        at += length
    return found


def _file(
    channels: tuple[tuple[Schema, Channel], ...], messages: tuple[tuple[Message, ...], ...]
) -> bytes:
    sink = io.BytesIO()
    writer = Writer(sink, compression=CompressionType.NONE)
    writer.start(profile='ros2', library='aurora')
    for (schema, channel), these in zip(channels, messages, strict=True):
        number = writer.register_schema(
            name=schema.name, encoding=schema.encoding, data=schema.data
        )
        ident = writer.register_channel(
            channel.topic, channel.message_encoding, number, channel.metadata
        )
        for message in these:
            writer.add_message(
                ident, message.log_time, message.data, message.publish_time, message.sequence
            )
    writer.finish()  # type: ignore[no-untyped-call]
    return sink.getvalue()
