# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bags written anew, with every digest of their own: what contradicts itself in them is seen."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from mcap.reader import make_reader

from aurora_core.trace import messages
from aurora_core.trace.bag_metadata import METADATA
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.bag_writer import BagWriter, Message
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.trace import Integrity, Trace

DEFINITIONS = message_definitions()
_TICK_NS = 50_000_000


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


def _stored(bag: Path) -> Iterator[Message]:
    with next(bag.glob('*.mcap')).open('rb') as stream:
        for _, channel, one in make_reader(stream).iter_messages(log_time_order=False):
            yield channel.topic, messages.TOPICS[channel.topic], one.data, one.log_time


def _with_ground_states(one: Message, change: Callable[[Any], Any]) -> Message:
    topic, kind, data, time_ns = one
    if topic != messages.GROUND_STATE:
        return one
    return topic, kind, DEFINITIONS.encode(kind, change(DEFINITIONS.decode(kind, data))), time_ns


def _later(state: Any) -> Any:
    stamp = dataclasses.replace(state.header.stamp, nanosec=state.header.stamp.nanosec ^ 1)
    return dataclasses.replace(state, header=dataclasses.replace(state.header, stamp=stamp))


def _elsewhere(state: Any) -> Any:
    header = dataclasses.replace(state.header, frame_id='odom')
    return dataclasses.replace(state, header=header)


def _of_another_run(state: Any) -> Any:
    return dataclasses.replace(state, run_number=state.run_number + 1)


def _filed_later(one: Message) -> Message:
    topic, kind, data, time_ns = one
    return topic, kind, data, time_ns + _TICK_NS * (topic == messages.UAV_STATE)


@pytest.mark.parametrize(
    ('change', 'said'),
    [
        (lambda one: _with_ground_states(one, _later), 'stamped with another time or frame'),
        (lambda one: _with_ground_states(one, _elsewhere), 'stamped with another time or frame'),
        (lambda one: _with_ground_states(one, _of_another_run), 'stamped by 2 runs'),
        (_filed_later, 'filed under another time'),
    ],
    ids=['stamp', 'frame', 'run', 'filed'],
)
def test_messages_that_contradict_themselves_are_altered(
    change: Callable[[Message], Message], said: str, bag: Path, tmp_path: Path
) -> None:
    with BagWriter(tmp_path / 'again', DEFINITIONS) as writer:
        writer.write_all(change(one) for one in _stored(bag))
    trace = read_bag(tmp_path / 'again', DEFINITIONS).trace
    assert trace.integrity is Integrity.ALTERED
    assert said in trace.integrity_note


def test_a_second_roster_that_is_another_one_is_seen(bag: Path, tmp_path: Path) -> None:
    stored = list(_stored(bag))
    topic, kind, data, _ = next(one for one in stored if one[0] == messages.ROSTER)
    roster = DEFINITIONS.decode(kind, data)
    other = dataclasses.replace(roster, agents=roster.agents[:0])
    with BagWriter(tmp_path / 'again', DEFINITIONS) as writer:
        writer.write_all([(topic, kind, DEFINITIONS.encode(kind, other), 0), *stored])
    trace = read_bag(tmp_path / 'again', DEFINITIONS).trace
    assert trace.integrity is Integrity.ALTERED
    assert '/aurora/roster: 2 different ones' in trace.integrity_note


@pytest.mark.parametrize(
    ('pattern', 'instead'),
    [
        (r'message_count: 45', 'message_count: 44'),
        (r'type: aurora_msgs/msg/GroundState', 'type: std_msgs/msg/String'),
        (r'nanoseconds: \d+', 'nanoseconds: 1'),
        (r'nanoseconds_since_epoch: \d+', 'nanoseconds_since_epoch: 99'),
    ],
    ids=['number', 'type', 'duration', 'start'],
)
def test_metadata_about_other_messages_is_altered(pattern: str, instead: str, bag: Path) -> None:
    path = bag / METADATA
    text = path.read_text(encoding='utf-8')
    changed = re.sub(pattern, instead, text)
    assert changed != text
    path.write_text(changed, encoding='utf-8')
    trace = read_bag(bag, DEFINITIONS).trace
    assert trace.integrity is Integrity.ALTERED
    assert 'tells of other messages' in trace.integrity_note
