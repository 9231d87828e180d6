# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Peeking into serialised messages, against the real serialiser."""

from __future__ import annotations

import pytest

pytest.importorskip('rclpy')

from rclpy.serialization import serialize_message
from rosgraph_msgs.msg import Clock

from aurora_core.errors import BagError
from aurora_core.trace.definitions import message_definitions
from aurora_msgs.msg import GroundState, LinkEvent, Roster
from aurora_ros import cdr
from aurora_ros.conversions.time import header

RUN = 2**63 + 5


@pytest.mark.parametrize('frame_id', ['', 'a', 'map', 'mapp', 'a_longer_frame'])
def test_run_and_tick_follow_a_header_of_any_length(frame_id: str) -> None:
    message = GroundState(header=header(1201, 0.05), run_number=RUN, tick=1201)
    message.header.frame_id = frame_id
    data = serialize_message(message)
    assert cdr.run_and_tick(data) == (RUN, 1201)
    assert cdr.time_ns(data) == 60_050_000_000


def test_other_messages_begin_alike() -> None:
    link = LinkEvent(header=header(3, 0.05), run_number=9, tick=3, link='x')
    assert cdr.run_and_tick(serialize_message(link)) == (9, 3)
    clock = Clock()
    clock.clock.sec, clock.clock.nanosec = 7, 50_000_000
    assert cdr.time_ns(serialize_message(clock)) == 7_050_000_000


@pytest.mark.parametrize('run_id', ['', 'r', '20260131T120000Z-0a1b2c'])
def test_run_id(run_id: str) -> None:
    assert cdr.run_id(serialize_message(Roster(header=header(0, 0.05), run_id=run_id))) == run_id


def test_the_bytes_of_the_local_engine_read_the_same() -> None:
    definitions = message_definitions()
    stamp = definitions.create('builtin_interfaces/msg/Time', sec=1, nanosec=2)
    data = definitions.encode(
        'aurora_msgs/msg/TickDone',
        definitions.create(
            'aurora_msgs/msg/TickDone', run_number=1, tick=2, participant='x', finished=False
        ),
    )
    assert data[:2] == b'\x00\x01', 'little-endian plain CDR'
    clock = definitions.create('rosgraph_msgs/msg/Clock', clock=stamp)
    assert cdr.time_ns(definitions.encode('rosgraph_msgs/msg/Clock', clock)) == 1_000_000_002


@pytest.mark.parametrize('length', [0, 3, 4, 11, 15, 20, 27])
def test_a_cut_message_is_an_error_of_the_bag(length: int) -> None:
    data = serialize_message(GroundState(header=header(1, 0.05), run_number=1, tick=1))
    with pytest.raises(BagError, match='expected a message'):
        cdr.run_and_tick(data[:length])


def test_a_cut_run_id_is_an_error_of_the_bag() -> None:
    data = serialize_message(Roster(header=header(0, 0.05), run_id='abcdef'))
    with pytest.raises(BagError, match='expected a text of 7 bytes'):
        cdr.run_id(data[:29])
