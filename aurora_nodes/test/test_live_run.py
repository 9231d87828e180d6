# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a live observer keeps, acknowledges and misses, on bytes made without ROS."""

from __future__ import annotations

import struct

import pytest

pytest.importorskip('rclpy')

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.definitions import message_definitions
from aurora_nodes.live_run import WATCHED, LiveRun, RunTotals
from aurora_ros import interfaces as on

RUN = 11
GROUND, COMMAND, EVENTS = messages.GROUND_STATE, messages.GROUND_COMMAND, messages.EVENTS


def header(tick: int) -> bytes:
    return b'\x00\x01\x00\x00' + struct.pack(
        '<iII4s', tick // 20, tick % 20 * 50_000_000, 4, b'map\x00'
    )


def at_tick(tick: int, run_number: int = RUN) -> bytes:
    return header(tick) + struct.pack('<QQ', run_number, tick)


def by_id(run_id: str) -> bytes:
    text = run_id.encode() + b'\x00'
    return header(0) + struct.pack('<I', len(text)) + text


def totals(counts: dict[str, int]) -> RunTotals:
    return RunTotals(run_number=RUN, run_id='r1', iteration=0, counts=counts)


@pytest.fixture
def run() -> LiveRun:
    return LiveRun(RUN)


def test_everything_that_is_judged_is_heard() -> None:
    assert WATCHED.keys() == messages.TOPICS.keys()
    assert {topic.full_name: topic.type_name for topic in on.JUDGED} == messages.TOPICS


def test_the_slowest_stream_decides_what_is_acknowledged(run: LiveRun) -> None:
    assert run.stored_tick == -1
    run.keep(EVENTS, [at_tick(9)])
    assert run.stored_tick == -1, 'records do not come every tick'
    run.keep(GROUND, [at_tick(tick) for tick in range(5)])
    assert run.stored_tick == 4
    run.keep(COMMAND, [at_tick(1), at_tick(2)])
    assert run.stored_tick == 2


def test_another_run_is_neither_acknowledged_nor_counted(run: LiveRun) -> None:
    run.keep(GROUND, [at_tick(900, RUN - 1)])
    assert run.stored_tick == -1
    run.keep(GROUND, [at_tick(0), at_tick(901, RUN - 1), at_tick(1)])
    run.keep(messages.ROSTER, [by_id('r0'), by_id('r1')])
    assert run.stored_tick == 1
    assert run.missing(totals({GROUND: 2, messages.ROSTER: 1})) == {}


def test_missing_and_too_many_are_told_apart(run: LiveRun) -> None:
    run.keep(GROUND, [at_tick(0), at_tick(1), at_tick(1)])
    sent = totals({GROUND: 2, EVENTS: 1, '/aurora/verdict': 1})
    assert run.missing(sent) == {GROUND: -1, EVENTS: 1}
    run.keep(EVENTS, [at_tick(1)])
    assert run.missing(sent) == {GROUND: -1}


def test_a_document_of_the_run_that_came_twice_counts_once(run: LiveRun) -> None:
    document = by_id(totals({}).run_id)
    run.keep(messages.AGSG, [document, by_id('another'), document])
    assert run.missing(totals({messages.AGSG: 1})) == {}
    run.keep(messages.AGSG, [document + bytes(4)])
    assert run.missing(totals({messages.AGSG: 1})) == {messages.AGSG: -1}


def test_what_cannot_be_decoded_is_named(run: LiveRun) -> None:
    run.keep(messages.ROSTER, [by_id('r1')])
    with pytest.raises(BagError, match='a message on /aurora/roster cannot be decoded'):
        run.content(totals({messages.ROSTER: 1}), message_definitions())


def test_without_roster_and_world_nothing_is_judged(run: LiveRun) -> None:
    with pytest.raises(BagError, match='what was heard of run r1 holds no roster') as caught:
        run.content(totals({messages.ROSTER: 1}), message_definitions())
    assert '1 of 1 were not heard' in str(caught.value)
