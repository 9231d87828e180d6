# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What belongs into a bag, on bytes made without ROS."""

from __future__ import annotations

import struct

import pytest

from aurora_core.errors import BagError
from aurora_nodes.recording import Belonging, RecordedTopic, Recording

RUN = 11
STATE = RecordedTopic(name='/aurora/ground/state', type_name='t', belonging=Belonging.EVERY_TICK)
COMMAND = RecordedTopic(
    name='/aurora/ground/command', type_name='t', belonging=Belonging.EVERY_TICK, first_tick=1
)
EVENTS = RecordedTopic(name='/aurora/events', type_name='t', belonging=Belonging.AT_TICK)
ROSTER = RecordedTopic(name='/aurora/roster', type_name='t', belonging=Belonging.BY_ID)
CLOCK = RecordedTopic(name='/clock', type_name='t', belonging=Belonging.CLOCK)


class Bag:
    def __init__(self) -> None:
        self.written: list[tuple[str, bytes, int]] = []
        self.flushes = 0

    def write(self, topic: str, type_name: str, cdr: bytes, time_ns: int) -> None:
        self.written.append((topic, cdr, time_ns))

    def flush(self) -> None:
        self.flushes += 1


def header(tick: int) -> bytes:
    return b'\x00\x01\x00\x00' + struct.pack(
        '<iII4s', tick // 20, tick % 20 * 50_000_000, 4, b'map\x00'
    )


def at_tick(tick: int, run_number: int = RUN) -> bytes:
    return header(tick) + struct.pack('<QQ', run_number, tick)


def by_id(run_id: str) -> bytes:
    text = run_id.encode() + b'\x00'
    return header(0) + struct.pack('<I', len(text)) + text


def clock(seconds: int) -> bytes:
    return b'\x00\x01\x00\x00' + struct.pack('<iI', seconds, 0)


@pytest.fixture
def bag() -> Bag:
    return Bag()


@pytest.fixture
def recording(bag: Bag) -> Recording:
    return Recording(bag, run_id='r1', run_number=RUN)


def test_the_bytes_are_kept_with_the_simulated_time(recording: Recording, bag: Bag) -> None:
    for tick in range(42):
        assert recording.store(STATE, at_tick(tick))
    assert bag.written[41] == (STATE.name, at_tick(41), 2_050_000_000)
    assert recording.stored_tick == 41


def test_another_run_is_not_stored(recording: Recording, bag: Bag) -> None:
    assert not recording.store(STATE, at_tick(0, RUN + 1))
    assert not recording.store(EVENTS, at_tick(0, RUN - 1))
    assert not recording.store(ROSTER, by_id('r2'))
    assert not bag.written
    assert recording.store(ROSTER, by_id('r1'))


def test_each_message_is_stored_once(recording: Recording, bag: Bag) -> None:
    recording.store(STATE, at_tick(0))
    assert not recording.store(STATE, at_tick(0))
    recording.store(STATE, at_tick(1))
    assert not recording.store(STATE, at_tick(0))
    assert len(bag.written) == 2


def test_several_records_of_one_tick_are_all_stored(recording: Recording) -> None:
    assert all(recording.store(EVENTS, at_tick(3)) for _ in range(3))
    assert recording.missing({EVENTS.name: 3}) == {}
    assert recording.excess({EVENTS.name: 2}) == {EVENTS.name: 1}


@pytest.mark.parametrize(('topic', 'first'), [(STATE, 0), (COMMAND, 1)])
def test_a_lost_sample_is_an_error(recording: Recording, topic: RecordedTopic, first: int) -> None:
    with pytest.raises(BagError, match=f'expected tick {first} on {topic.name}, found'):
        recording.store(topic, at_tick(first + 1))
    recording.store(topic, at_tick(first))
    with pytest.raises(BagError, match=f'expected tick {first + 1}'):
        recording.store(topic, at_tick(first + 2))


def test_the_slowest_stream_decides_what_is_acknowledged(recording: Recording) -> None:
    assert recording.stored_tick == -1
    for tick in range(5):
        recording.store(STATE, at_tick(tick))
    recording.store(COMMAND, at_tick(1))
    assert recording.stored_tick == 1


def test_missing_counts_down_to_nothing(recording: Recording) -> None:
    expected = {STATE.name: 2, EVENTS.name: 1, ROSTER.name: 0}
    assert recording.missing(expected) == {STATE.name: 2, EVENTS.name: 1}
    recording.store(STATE, at_tick(0))
    recording.store(STATE, at_tick(1))
    assert recording.missing(expected) == {EVENTS.name: 1}
    recording.store(EVENTS, at_tick(1))
    assert recording.missing(expected) == {}


def test_the_clock_begins_at_zero_and_only_goes_on(recording: Recording, bag: Bag) -> None:
    assert not recording.store(CLOCK, clock(60)), 'of the run before'
    assert recording.store(CLOCK, clock(0))
    assert recording.store(CLOCK, clock(1))
    assert not recording.store(CLOCK, clock(1))
    assert not recording.store(CLOCK, clock(0))
    assert recording.stored_tick == -1, 'the clock is not a stream of the run'
    assert len(bag.written) == 2


def test_flush_reaches_the_bag(recording: Recording, bag: Bag) -> None:
    recording.flush()
    assert bag.flushes == 1
