# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rewrite a bag with changes, every checksum of the file format in order again."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

from mcap.records import Channel, Message, Metadata, Schema
from mcap.stream_reader import StreamReader
from mcap.writer import Writer

from aurora_core.trace.bag_metadata import METADATA, file_sha256

# (topic, number of the message on its topic, bytes) -> what to write instead.
Change = Callable[[str, int, bytes], tuple[bytes, ...]]
# (topic, schema) -> (name, encoding, text) to write.
Redefine = Callable[[str, Schema], tuple[str, str, bytes]]


def mcap_of(folder: Path) -> Path:
    """Return the MCAP file of a bag folder."""
    return next(folder.glob('*.mcap'))


def as_it_is(_topic: str, _number: int, data: bytes) -> tuple[bytes, ...]:
    """Change nothing."""
    return (data,)


def rewrite(folder: Path, change: Change = as_it_is, redefine: Redefine | None = None) -> None:
    """Write the MCAP file of a bag anew; checkpoints stay as and where they are."""
    path = mcap_of(folder)
    schemas: dict[int, Schema] = {}
    channels: dict[int, tuple[int, str]] = {}
    counts: dict[str, int] = {}
    aside = path.with_suffix('.new')
    with path.open('rb') as stream, aside.open('wb') as sink:
        writer = Writer(sink)
        writer.start(profile='ros2', library='aurora')
        for record in StreamReader(stream).records:
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel) and record.id not in channels:
                schema = schemas[record.schema_id]
                name, encoding, data = (
                    redefine(record.topic, schema)
                    if redefine is not None
                    else (schema.name, schema.encoding, schema.data)
                )
                number = writer.register_schema(name=name, encoding=encoding, data=data)
                channel = writer.register_channel(record.topic, record.message_encoding, number)
                channels[record.id] = (channel, record.topic)
            elif isinstance(record, Metadata):
                writer.flush()  # type: ignore[no-untyped-call]
                writer.add_metadata(record.name, record.metadata)
            elif isinstance(record, Message):
                channel, topic = channels[record.channel_id]
                number = counts.get(topic, 0)
                counts[topic] = number + 1
                for data in change(topic, number, record.data):
                    writer.add_message(channel, record.log_time, data, record.publish_time, number)
        writer.finish()  # type: ignore[no-untyped-call]
    aside.replace(path)


def stamp(folder: Path) -> None:
    """Write digest and length of the present file into the metadata, as a forger would."""
    path, file = folder / METADATA, mcap_of(folder)
    text = path.read_text(encoding='utf-8')
    text = re.sub(r'(aurora_file_sha256: ).*', rf'\g<1>{file_sha256(file)}', text)
    text = re.sub(r'(aurora_file_bytes: ).*', rf"\g<1>'{file.stat().st_size}'", text)
    path.write_text(text, encoding='utf-8')
