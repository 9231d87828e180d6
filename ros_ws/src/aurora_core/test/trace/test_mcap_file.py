# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What `McapFile` writes, read by `mcap` itself: by index and in order, with checksums."""

from __future__ import annotations

import zlib
from io import BytesIO

from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from mcap.records import ChunkIndex, Footer, Message
from mcap.stream_reader import StreamReader

from aurora_core.trace.mcap_file import Entry, McapFile

TOPICS = ('/a', '/b', '/c')
TIMES = st.integers(min_value=0, max_value=2**63)
MESSAGES = st.tuples(
    st.integers(min_value=1, max_value=len(TOPICS)), TIMES, st.binary(max_size=99)
)
CHUNKS = st.lists(st.lists(MESSAGES, max_size=12), max_size=5)


def written(chunks: list[list[Entry]], notes: int = 0) -> bytes:
    stream = BytesIO()
    file = McapFile(stream, library='test')
    schema = file.add_schema('pkg/msg/Type', 'ros2msg', b'int32 x')
    for topic in TOPICS:
        file.add_channel(topic, 'cdr', schema, {'offered_qos_profiles': ''})
    for chunk in chunks:
        file.add_chunk(chunk)
    for number in range(notes):
        file.add_metadata('note', {'number': str(number)})
    file.finish()
    return stream.getvalue()


def numbered(chunks: list[list[tuple[int, int, bytes]]]) -> list[list[Entry]]:
    numbers = dict.fromkeys(range(1, len(TOPICS) + 1), -1)

    def entry(channel: int, time_ns: int, data: bytes) -> Entry:
        numbers[channel] += 1
        return channel, numbers[channel], time_ns, data

    return [[entry(*message) for message in chunk] for chunk in chunks]


@given(CHUNKS)
def test_messages_come_back_by_index_and_from_front_to_back(
    chunks: list[list[tuple[int, int, bytes]]],
) -> None:
    entries = numbered(chunks)
    file = written(entries)
    wanted = [entry for chunk in entries for entry in chunk]

    stream = StreamReader(BytesIO(file), validate_crcs=True)
    read = [record for record in stream.records if isinstance(record, Message)]
    assert [(m.channel_id, m.sequence, m.log_time, m.data) for m in read] == wanted
    assert all(m.publish_time == m.log_time for m in read)

    reader = make_reader(BytesIO(file), validate_crcs=True)
    for number, topic in enumerate(TOPICS, start=1):
        found = [
            (channel.id, message.sequence, message.log_time, message.data)
            for _, channel, message in reader.iter_messages(topics=[topic])
        ]
        assert sorted(found) == sorted(entry for entry in wanted if entry[0] == number)


def test_the_summary_says_what_is_there() -> None:
    chunks = [
        [(1, 0, 50, b'first'), (2, 0, 10, b'')],
        [],
        [(1, 1, 70, b'x' * 100_000)],
    ]
    file = written(chunks, notes=2)
    summary = make_reader(BytesIO(file)).get_summary()
    assert summary is not None
    assert summary.statistics is not None
    statistics = summary.statistics
    assert (statistics.message_count, statistics.chunk_count) == (3, 2)
    assert (statistics.schema_count, statistics.channel_count) == (1, 3)
    assert statistics.metadata_count == 2
    assert dict(statistics.channel_message_counts) == {1: 2, 2: 1}
    assert (statistics.message_start_time, statistics.message_end_time) == (10, 70)
    assert [channel.topic for channel in summary.channels.values()] == list(TOPICS)
    for index in summary.chunk_indexes:
        at = file[index.chunk_start_offset :]
        assert at[0] == 6  # opcode of a chunk
        assert len(at[: index.chunk_length]) == index.chunk_length
        for offset in index.message_index_offsets.values():
            assert file[offset] == 7  # opcode of a message index
    assert summary.chunk_indexes[1].compressed_size < 1000
    notes = list(make_reader(BytesIO(file)).iter_metadata())
    assert [note.metadata['number'] for note in notes] == ['0', '1']


def test_checksum_of_the_summary_is_that_of_the_footer() -> None:
    records = list(StreamReader(BytesIO(written([[(1, 0, 1, b'a')]]))).records)
    footer = records[-1]
    assert isinstance(footer, Footer)
    assert footer.summary_crc
    assert any(isinstance(record, ChunkIndex) for record in records)
    file = written([[(1, 0, 1, b'a')]])
    checked = file[footer.summary_start : -8 - 4]  # up to the checksum in the footer
    assert zlib.crc32(checked) == footer.summary_crc
