# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Frames: the same bytes as pymavlink, and nothing that arrives can do harm."""

from __future__ import annotations

import random
import struct
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim import wire
from aurora_uav_sim.wire import Decoder, Frame, Newer, PlainNewer, Sequence, split

f32 = st.floats(width=32, allow_nan=False)
u8 = st.integers(0, 255)
u32 = st.integers(0, 2**32 - 1)


def frame_of(message: Any, sequence: int = 0) -> bytes:
    sender = Sequence(1, 1)
    sender.seq = sequence
    return sender.encode(message)


@given(u8, u32, st.lists(f32, min_size=6, max_size=6))
def test_position_is_packed_as_pymavlink_does(
    sequence: int, time_ms: int, values: list[float]
) -> None:
    sender = Sequence(7, 1)
    sender.seq = sequence
    fast = wire.LOCAL_POSITION.frame(sender, time_ms, *values)
    sender.seq = sequence
    message = mavlink.MAVLink_local_position_ned_message(time_ms, *values)
    assert fast == sender.encode(message)
    assert sender.seq == (sequence + 1) % 256


@given(u32, st.lists(f32, min_size=7, max_size=7))
def test_attitude_is_packed_as_pymavlink_does(time_ms: int, values: list[float]) -> None:
    message = mavlink.MAVLink_attitude_quaternion_message(time_ms, *values)
    fast = wire.ATTITUDE.frame(Sequence(1, 1), time_ms, *values, 0.0, 0.0, 0.0, 0.0)
    assert fast == frame_of(message)


@given(st.lists(f32, min_size=7, max_size=7), st.integers(0, 65535), u8, u8, u8)
def test_command_is_packed_as_pymavlink_does(
    values: list[float], command: int, system: int, component: int, confirmation: int
) -> None:
    message = mavlink.MAVLink_command_long_message(
        system, component, command, confirmation, *values
    )
    fast = wire.COMMAND_LONG.frame(
        Sequence(1, 1), *values, command, system, component, confirmation
    )
    assert fast == frame_of(message)


def test_the_other_fast_messages_are_packed_as_pymavlink_does() -> None:
    sender = Sequence(1, 1)
    ack = mavlink.MAVLink_command_ack_message(400, 1, 0, -5, 245, 191)
    assert wire.COMMAND_ACK.frame(sender, 400, 1, 0, -5, 245, 191) == frame_of(ack)
    named = mavlink.MAVLink_named_value_int_message(5, b'AURSTATUS', 77)
    assert wire.NAMED_INT.frame(sender, 5, 77, b'AURSTATUS') == frame_of(named, 1)
    fields = [float(i) for i in range(11)]
    point = mavlink.MAVLink_set_position_target_local_ned_message(9, 1, 1, 1, 0x9C0, *fields)
    fast = wire.SET_POINT.frame(sender, 9, *fields, 0x9C0, 1, 1, 1)
    assert fast == frame_of(point, 2)
    assert wire.SET_POINT.unpack(next(split(fast)).payload)[1:12] == tuple(fields)


@given(st.binary(max_size=300))
def test_without_fastcrc_the_checksum_is_the_same(data: bytes) -> None:
    assert wire.slow_crc16(data) == wire.crc16(data)


def test_mavlink_1_is_read_too() -> None:
    old = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    raw = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(old, force_mavlink1=True)
    frame = next(split(raw))
    assert (frame.message_id, frame.system_id, frame.component_id) == (0, 255, 190)
    assert Decoder().decode(frame).type == 6  # type: ignore[union-attr]


def test_signed_frames_are_read() -> None:
    sender = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    sender.signing.secret_key = bytes(32)
    sender.signing.sign_outgoing = True
    raw = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3).pack(sender)
    frames = list(split(raw + frame_of(mavlink.MAVLink_ping_message(1, 2, 0, 0))))
    assert [f.message_id for f in frames] == [0, 4]


def test_finds_the_good_frames_among_rubbish() -> None:
    good = [frame_of(mavlink.MAVLink_ping_message(i, i, 0, 0), i) for i in range(5)]
    mixed = b'\xfd\x09' + good[0] + b'\x00\xfe\xfd' + good[1] + good[2][:-3] + good[3] + b'\xfd'
    mixed += good[4]
    assert [f.sequence for f in split(mixed)] == [0, 1, 3, 4]


def test_a_cut_frame_does_not_wait_for_the_next_datagram() -> None:
    good = frame_of(mavlink.MAVLink_ping_message(1, 1, 0, 0))
    assert list(split(good[:-1])) == []
    assert len(list(split(good))) == 1


@given(st.integers(0, 26), st.integers(1, 255))
def test_a_changed_byte_is_noticed(position: int, change: int) -> None:
    good = bytearray(frame_of(mavlink.MAVLink_ping_message(2**63 - 1, 2**31 - 1, 1, 1)))
    assert len(good) == 26
    position = min(position, len(good) - 1)
    good[position] ^= change
    assert list(split(bytes(good))) == []


@given(st.binary(max_size=600))
def test_random_bytes_pass_without_harm(data: bytes) -> None:
    decoder = Decoder()
    for frame in split(data):
        decoder.decode(frame)


def test_every_message_with_random_payload_decodes_or_is_refused() -> None:
    rng = random.Random(5)
    decoder = Decoder()
    for message_id in mavlink.mavlink_map:
        for length in (1, 20, 255):
            raw = wire.pack(0, 1, 1, message_id, rng.randbytes(length))
            for frame in split(raw):
                decoder.decode(frame)
    # And it still works after all that.
    good = next(split(frame_of(mavlink.MAVLink_ping_message(1, 42, 0, 0))))
    assert decoder.decode(good).seq == 42  # type: ignore[union-attr]


def test_a_refused_frame_does_not_block_the_decoder() -> None:
    decoder = Decoder()
    bad = Frame(0, 0, 1, 1, b'', b'\xfd\xff' + bytes(20))
    assert decoder.decode(bad) is None
    good = next(split(frame_of(mavlink.MAVLink_ping_message(1, 42, 0, 0))))
    assert decoder.decode(good).seq == 42  # type: ignore[union-attr]


def test_huge_datagrams_are_dropped() -> None:
    good = frame_of(mavlink.MAVLink_ping_message(1, 1, 0, 0))
    assert list(split(good + bytes(wire.MAX_DATAGRAM))) == []


def numbered(sequence: int, system: int = 1) -> Frame:
    return Frame(0, sequence, system, 1, b'', b'')


@pytest.mark.parametrize('make', [Newer, PlainNewer])
def test_newer_lets_each_frame_through_once_and_in_order(make: type[PlainNewer]) -> None:
    newer = make()
    assert [newer.accept(numbered(n)) for n in (5, 6, 6, 5, 9, 7)] == [
        True, True, False, False, True, False,
    ]  # fmt: skip


@pytest.mark.parametrize('make', [Newer, PlainNewer])
def test_newer_wraps_and_keeps_senders_apart(make: type[PlainNewer]) -> None:
    newer = make()
    assert newer.accept(numbered(250))
    assert newer.accept(numbered(3))
    assert not newer.accept(numbered(251))
    assert newer.accept(numbered(251, system=2))


def test_both_filters_let_the_same_frames_through() -> None:
    chance = random.Random(4)
    filters = Newer(), PlainNewer()
    for _ in range(5000):
        frame = Frame(0, chance.randrange(256), chance.randrange(3), chance.randrange(2), b'', b'')
        assert filters[0].accept(frame) == filters[1].accept(frame)


@pytest.mark.skipif(not wire.IS_COMPILED, reason='frames are not compiled here')
def test_compiled_frames_are_the_plain_ones() -> None:
    """Whole, changed, cut, signed, old, unknown and too long ones, with rubbish between."""
    rng = random.Random(7)
    found = 0
    for _ in range(3000):
        parts = []
        for _ in range(rng.randrange(5)):
            kind = rng.choice(list(mavlink.mavlink_map))
            payload = rng.randbytes(rng.randrange(40)) + bytes(rng.randrange(5))
            numbers = rng.randrange(256), rng.randrange(256), rng.randrange(256)
            frame = wire.plain_pack(*numbers, kind, payload)
            assert wire.pack(*numbers, kind, payload) == frame
            changed = bytearray(frame)
            if rng.random() < 0.4:
                changed[rng.randrange(len(frame))] = rng.choice((0, 1, 0xFD, 0xFE, 255))
            parts += [bytes(changed), rng.choice((b'', b'\xfe\x00', b'\xfd', rng.randbytes(9)))]
        datagram = b''.join(parts)[: rng.choice((None, -1, 30))]
        frames = list(wire.plain_split(datagram))
        assert list(split(datagram)) == frames
        assert all(type(frame) is Frame for frame in split(datagram))
        found += len(frames)
    assert found > 1000
    for wrong in ((256, 1, 1, 0, b''), (0, 1, 1, 0xFFFFFF, b''), (0, 1, 1, 0, b'x' * 256)):
        with pytest.raises((struct.error, ValueError, KeyError)):
            wire.plain_pack(*wrong)
        with pytest.raises((ValueError, KeyError)):
            wire.pack(*wrong)


KINDS = (
    mavlink.MAVLink_local_position_ned_message,
    mavlink.MAVLink_attitude_quaternion_message,
    mavlink.MAVLink_named_value_int_message,
    mavlink.MAVLink_command_ack_message,
    mavlink.MAVLink_command_long_message,
    mavlink.MAVLink_set_position_target_local_ned_message,
)


@pytest.mark.skipif(not wire.IS_COMPILED, reason='the frames are not compiled here')
@pytest.mark.parametrize('kind', KINDS)
def test_a_compiled_layout_packs_and_unpacks_the_same_bits(kind: Any) -> None:
    chance = random.Random(3)
    plain, fast = wire.PlainLayout(kind), wire.layout_of(kind)
    assert type(fast) is not type(plain)
    assert (fast.message_id, fast.size) == (plain.message_id, plain.size)
    senders = Sequence(9, 1), Sequence(9, 1)
    for _ in range(500):
        payload = bytes(chance.choice((0, chance.randrange(256))) for _ in range(plain.size))
        for piece in (payload, payload[: chance.randrange(plain.size)], payload + b'more'):
            # repr: some of the numbers are NaN.
            assert repr(fast.unpack(piece)) == repr(plain.unpack(piece))
        fields = plain.unpack(payload)
        frames = [
            layout.frame(sender, *fields)
            for layout, sender in zip((plain, fast), senders, strict=True)
        ]
        assert frames[0] == frames[1]
    assert senders[0].seq == senders[1].seq == 500 % 256


@pytest.mark.parametrize('make', [wire.PlainLayout, wire.layout_of])
def test_a_field_that_does_not_fit_is_refused(make: Any) -> None:
    sender = Sequence(1, 1)
    status = make(mavlink.MAVLink_named_value_int_message)
    for wrong in (
        (-1, 0, b''),
        (2**32, 0, b''),
        (0, 2**31, b''),
        (0, 1.5, b''),
        (0, 0, 'x'),
        (0,),
    ):
        with pytest.raises(struct.error):
            status.frame(sender, *wrong)
    place = make(mavlink.MAVLink_local_position_ned_message)
    with pytest.raises(struct.error):
        place.frame(sender, 1, 'x', 0.0, 0.0, 0.0, 0.0, 0.0)
    with pytest.raises(OverflowError):
        place.frame(sender, 1, 1e39, 0.0, 0.0, 0.0, 0.0, 0.0)
