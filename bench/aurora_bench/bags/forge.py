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

# (topic, number of the message on its topic, bytes) -> the bytes to write, as often as they stand.
Change = Callable[[str, int, bytes], tuple[bytes, ...]]
# (name, encoding, text) of a schema -> what to write.
Redefine = Callable[[str, str, bytes], tuple[str, str, bytes]]


def mcap_of(folder: Path) -> Path:
    """Return the MCAP file of a bag folder."""
    return next(folder.glob('*.mcap'))


def rewrite(
    source: Path,
    target: Path,
    change: Change = lambda _topic, _number, data: (data,),
    redefine: Redefine = lambda name, encoding, data: (name, encoding, data),
) -> None:
    """Copy an MCAP file record by record; notes (checkpoints) stay as and where they are."""
    schemas: dict[int, Schema] = {}
    ids: dict[int, int] = {}
    topics: dict[int, str] = {}
    counts: dict[str, int] = {}
    with source.open('rb') as stream, target.open('wb') as sink:
        writer = Writer(sink)
        writer.start(profile='ros2', library='aurora')
        for record in StreamReader(stream).records:
            if isinstance(record, Schema):
                schemas[record.id] = record
            elif isinstance(record, Channel) and record.id not in ids:
                schema = schemas[record.schema_id]
                name, encoding, data = redefine(schema.name, schema.encoding, schema.data)
                number = writer.register_schema(name=name, encoding=encoding, data=data)
                ids[record.id] = writer.register_channel(
                    record.topic, record.message_encoding, number, record.metadata
                )
                topics[record.id] = record.topic
            elif isinstance(record, Metadata):
                writer.flush()  # type: ignore[no-untyped-call]
                writer.add_metadata(record.name, record.metadata)
            elif isinstance(record, Message):
                topic = topics[record.channel_id]
                number = counts.get(topic, 0)
                counts[topic] = number + 1
                for data in change(topic, number, record.data):
                    writer.add_message(
                        ids[record.channel_id],
                        record.log_time,
                        data,
                        record.publish_time,
                        record.sequence,
                    )
        writer.finish()  # type: ignore[no-untyped-call]


def stamp(folder: Path) -> None:
    """Write the digest and the length of the present file into the metadata."""
    path, file = folder / METADATA, mcap_of(folder)
    text = path.read_text(encoding='utf-8')
    text = re.sub(r'(aurora_file_sha256: ).*', rf'\g<1>{file_sha256(file)}', text)
    text = re.sub(r'(aurora_file_bytes: ).*', rf"\g<1>'{file.stat().st_size}'", text)
    path.write_text(text, encoding='utf-8')
