# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bags that were changed with care, every checksum in order: seen, named, and never a danger."""

from __future__ import annotations

import re
import struct
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

from aurora_core.errors import BagError
from aurora_core.trace import messages
from aurora_core.trace.bag_reader import BagContent, read_bag
from aurora_core.trace.bag_writer import BagWriter
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.messages import MessageBuilder
from aurora_core.trace.messages_world import world_message
from aurora_core.trace.trace import Integrity, Trace

DEFINITIONS = message_definitions()


@pytest.fixture
def bag(
    tmp_path: Path,
    make_trace: Callable[..., Trace],
    make_world: Callable[..., Any],
    record: Callable[..., Any],
) -> Path:
    folder = tmp_path / 'bag.0'
    record(folder, make_trace(ticks=45), make_world())
    return folder


def _read(bag: Path) -> BagContent:
    return read_bag(bag, DEFINITIONS)


def _with_data(topic: str, data: bytes, value: float, at: int = 0) -> bytes:
    """Return a state with one number replaced."""
    name = messages.TOPICS[topic]
    message = DEFINITIONS.decode(name, data)
    numbers = message.data.copy()
    numbers[at] = value
    fields = {k: getattr(message, k) for k in ('header', 'run_number', 'tick')}
    return DEFINITIONS.encode(name, DEFINITIONS.create(name, **fields, data=numbers))


@pytest.mark.parametrize('stamped', [False, True])
def test_one_altered_message_is_found_and_its_half_second_named(
    bag: Path, forging: ModuleType, stamped: bool
) -> None:
    def change(topic: str, number: int, data: bytes) -> tuple[bytes, ...]:
        hit = (topic, number) == (messages.UAV_STATE, 25)
        return (_with_data(topic, data, 3.5) if hit else data,)

    forging.rewrite(bag, change)
    if stamped:
        forging.stamp(bag)
    trace = _read(bag).trace
    assert trace.uav[25, 0, 0] == 3.5, 'margins are recomputed from what is there'
    assert trace.integrity is Integrity.ALTERED
    assert 'messages between 1.05 s and 1.55 s are not those' in trace.integrity_note


def test_rewritten_without_a_change_only_the_digest_tells(bag: Path, forging: ModuleType) -> None:
    forging.rewrite(bag)
    trace = _read(bag).trace
    assert trace.integrity is Integrity.ALTERED
    assert 'every message is as recorded' in trace.integrity_note
    forging.stamp(bag)
    assert _read(bag).trace.integrity is Integrity.INTACT


def test_swapped_and_repeated_ticks_are_named(bag: Path, forging: ModuleType) -> None:
    held: list[bytes] = []

    def change(topic: str, number: int, data: bytes) -> tuple[bytes, ...]:
        if topic == messages.GROUND_STATE and number in (7, 8):
            held.append(data)
            return () if number == 7 else (held[1], held[0])
        return (data,) * (1 + ((topic, number) == (messages.UAV_STATE, 20)))

    forging.rewrite(bag, change)
    trace = _read(bag).trace
    assert trace.integrity is Integrity.ALTERED
    assert '/aurora/ground/state: tick 7 out of order' in trace.integrity_note
    assert '/aurora/uav/state: tick 20 recorded twice' in trace.integrity_note
    assert trace.missing_ticks == ()


@pytest.mark.parametrize('value', [float('nan'), float('inf'), -1e300])
def test_a_state_that_is_no_number_ends_what_can_be_judged(
    value: float, tmp_path: Path, make_trace: Callable[..., Trace], make_world: Any, record: Any
) -> None:
    trace = make_trace(ticks=30)
    trace.ground[12, 1, 3] = value
    record(tmp_path / 'bag.0', trace, make_world())
    found = _read(tmp_path / 'bag.0').trace
    assert found.integrity is Integrity.UNKNOWN
    assert '/aurora/ground/state: tick 12' in found.integrity_note
    assert '(first agent1)' in found.integrity_note
    assert found.missing_ticks == (12,)
    assert found.ground.tobytes() == trace.ground.tobytes(), 'the hash covers what is there'


@pytest.mark.parametrize('topic', [messages.UAV_STATE, messages.UAV_COMMAND])
def test_a_topic_that_is_not_there_is_named(topic: str, bag: Path, forging: ModuleType) -> None:
    forging.rewrite(bag, lambda found, _number, data: () if found == topic else (data,))
    trace = _read(bag).trace
    assert f'{topic}: no message that can be read' in trace.integrity_note
    assert trace.missing_ticks[0] in (0, 1)


def test_a_length_of_2_to_the_32_is_refused_before_any_memory_is_taken(
    bag: Path, forging: ModuleType
) -> None:
    def change(topic: str, number: int, data: bytes) -> tuple[bytes, ...]:
        if (topic, number) != (messages.GROUND_STATE, 9):
            return (data,)
        at = data.rindex(struct.pack('<I', 14))
        return (data[:at] + b'\xff\xff\xff\xff' + data[at + 4 :],)

    forging.rewrite(bag, change)
    trace = _read(bag).trace
    assert trace.missing_ticks == (9,)
    assert '/aurora/ground/state: message 9 at 0.45 s cannot be decoded' in trace.integrity_note


def test_a_foreign_schema_is_named_and_nothing_is_guessed(bag: Path, forging: ModuleType) -> None:
    def redefine(topic: str, schema: Any) -> tuple[str, str, bytes]:
        text = schema.data
        if topic == messages.UAV_STATE:
            text = text.replace(b'uint64 tick', b'uint64 when')
        return schema.name, schema.encoding, text

    forging.rewrite(bag, redefine=redefine)
    forging.stamp(bag)
    trace = _read(bag).trace
    assert trace.integrity is Integrity.UNKNOWN
    assert (
        'foreign schema on /aurora/uav/state: field 3 of aurora_msgs/msg/UavState is uint64 when, '
        'expected uint64 tick' in trace.integrity_note
    )
    assert np.isnan(trace.uav).all()


def test_a_bag_of_another_program_is_unknown(bag: Path) -> None:
    path = bag / 'metadata.yaml'
    lines = [line for line in path.read_text().splitlines() if not re.match(' +aurora_', line)]
    path.write_text('\n'.join(lines))
    trace = _read(bag).trace
    assert trace.integrity is Integrity.UNKNOWN
    assert 'carries no digest' in trace.integrity_note


@pytest.mark.parametrize('name', ['notes.txt', 'empty.mcap'])
def test_a_file_that_is_no_bag(name: str, bag: Path) -> None:
    path = bag.parent / name
    path.write_bytes(b'' if name.startswith('empty') else b'what a day\n')
    with pytest.raises(BagError, match='empty' if name.startswith('empty') else 'no MCAP file'):
        _read(path)


def test_a_file_of_a_bag_stands_for_it_and_a_second_one_is_seen(bag: Path) -> None:
    file = bag / 'bag.0_0.mcap'
    assert _read(file).trace.integrity is Integrity.INTACT
    assert _read(bag / 'metadata.yaml').trace.integrity is Integrity.INTACT
    (bag / 'bag.0_1.mcap').write_bytes(file.read_bytes())
    trace = _read(bag).trace
    assert trace.integrity is Integrity.ALTERED
    assert "is about 'bag.0_0.mcap', not 'bag.0_1.mcap'" in trace.integrity_note


@pytest.mark.parametrize('dt_s', [0.0, -1.0, float('nan'), 1e-300, 1e9])
def test_a_time_step_that_is_none(dt_s: float, tmp_path: Path, make_world: Any) -> None:
    build = MessageBuilder(DEFINITIONS, 1, 0.05)
    name = messages.TOPICS[messages.ROSTER]
    roster = DEFINITIONS.create(
        name, header=build.header(0), run_id='r', iteration=0, dt_s=dt_s, agents=[], uavs=[]
    )
    world = world_message(DEFINITIONS, build.header(0), 'r', make_world())
    with BagWriter(tmp_path / 'bag.0', DEFINITIONS) as writer:
        writer.write(messages.ROSTER, name, DEFINITIONS.encode(name, roster), 0)
        name = messages.TOPICS[messages.WORLD]
        writer.write(messages.WORLD, name, DEFINITIONS.encode(name, world), 0)
    with pytest.raises(BagError, match='time step'):
        _read(tmp_path / 'bag.0')


def test_more_bodies_than_memory(
    tmp_path: Path, make_trace: Any, make_world: Any, record: Any, monkeypatch: Any
) -> None:
    record(tmp_path / 'bag.0', make_trace(ticks=40, agents=3), make_world())
    monkeypatch.setattr('aurora_core.trace.bag_content._ARRAY_BYTES', 10_000)
    with pytest.raises(BagError, match='4 bodies over 40 ticks'):
        _read(tmp_path / 'bag.0')
    monkeypatch.setattr('aurora_core.trace.bag_reader._CONTENT_LIMIT', 1000)
    with pytest.raises(BagError, match='messages, which no run has'):
        _read(tmp_path / 'bag.0')
