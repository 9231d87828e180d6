# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who has the key commands; whoever has it not looks on. pymavlink is the judge of the bytes."""

from __future__ import annotations

import math
import os
import socket
from dataclasses import astuple
from pathlib import Path
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.protocol import CMD_LOCKSTEP, CMD_STEP
from aurora_uav_sim.signed_server import SignedServer
from aurora_uav_sim.signing import KEY_FILE_VARIABLE, KeyFileError, Signer, now_units, signer_from
from aurora_uav_sim.wire import Sequence

KEY, OTHER = bytes(range(32)), bytes(32)
HEARTBEAT = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3)
ARM = mavlink.MAVLink_command_long_message(1, 1, 400, 0, 1, 0, 0, 0, 0, 0, 0)


def frame(message: Any = HEARTBEAT, *, count: int = 1) -> bytes:
    sequence = Sequence(255, 190)
    return b''.join(sequence.encode(message) for _ in range(count))


def pymavlink_with(key: bytes) -> Any:
    link = mavlink.MAVLink(None, srcSystem=255, srcComponent=190)
    link.robust_parsing = True
    link.signing.secret_key = key
    link.signing.sign_outgoing = True
    link.signing.timestamp = now_units()
    return link


@pytest.mark.parametrize('message', [HEARTBEAT, ARM, mavlink.MAVLink_ping_message(0, 1, 0, 0)])
def test_pymavlink_accepts_what_we_sign_with_its_key_only(message: Any) -> None:
    sent = Signer(KEY).sign(frame(message, count=3))
    right, wrong = pymavlink_with(KEY), pymavlink_with(OTHER)
    kinds = [m.get_type() for m in right.parse_buffer(bytearray(sent))]
    assert kinds == [message.get_type()] * 3
    assert {m.get_type() for m in wrong.parse_buffer(bytearray(sent))} == {'BAD_DATA'}


def test_we_accept_what_pymavlink_signs_with_our_key_only() -> None:
    link = pymavlink_with(KEY)
    sent = bytes(HEARTBEAT.pack(link))
    assert Signer(KEY).signed_part(sent) == sent
    assert Signer(OTHER).parts(sent) == (b'', b'')


def test_a_signature_counts_once_and_in_order() -> None:
    sender, receiver = Signer(KEY), Signer(KEY)
    first, second = sender.sign(frame()), sender.sign(frame())
    assert receiver.signed_part(first) == first
    assert receiver.signed_part(second) == second
    assert receiver.parts(first + second) == (b'', b'')


def test_every_changed_byte_is_found_and_a_forged_time_not_believed() -> None:
    sender, receiver = Signer(KEY), Signer(KEY)
    sent = sender.sign(frame(ARM))
    for place in range(len(sent)):
        for bit in (0x01, 0x80):
            changed = bytearray(sent)
            changed[place] ^= bit
            assert receiver.signed_part(bytes(changed)) == b''
    assert receiver.signed_part(sent) == sent


def test_an_old_recording_opens_no_new_stream() -> None:
    old = Signer(KEY, now=lambda: now_units() - 61 * 100_000).sign(frame())
    recent = Signer(KEY, now=lambda: now_units() - 30 * 100_000).sign(frame())
    assert Signer(KEY).signed_part(old) == b''
    assert Signer(KEY).signed_part(recent) == recent


def test_a_clock_that_jumps_back_stops_nobody() -> None:
    times = iter([now_units(), 0, 5])
    sender, receiver = Signer(KEY, now=lambda: next(times)), Signer(KEY)
    for _ in range(3):
        sent = sender.sign(frame())
        assert receiver.signed_part(sent) == sent


def results(datagrams: list[bytes]) -> list[int]:
    reader = mavlink.MAVLink(None)
    reader.robust_parsing = True
    found = [m for d in datagrams for m in reader.parse_buffer(bytearray(d)) or []]
    return [m.result for m in found if m.get_type() == 'COMMAND_ACK']


def command(number: int, *parameters: float) -> Any:
    filled = [*parameters, *([0.0] * (7 - len(parameters)))]
    return mavlink.MAVLink_command_long_message(1, 1, number, 0, *filled)


@pytest.mark.parametrize(
    'message',
    [
        ARM,
        command(22, 0, 0, 0, math.nan, math.nan, math.nan, 508.0),
        command(CMD_LOCKSTEP, 1, 7, 50_000, 1),
        command(CMD_STEP, 1),
        mavlink.MAVLink_command_int_message(1, 1, 6, 192, 0, 0, -1, 1, 0, 0, 0, 0, 508.0),
    ],
)
@pytest.mark.parametrize('key', [None, OTHER])
def test_without_the_key_nothing_is_commanded(message: Any, key: bytes | None) -> None:
    inner = SimServer()
    server = SignedServer(inner, Signer(KEY))
    sent = frame(message)
    out = server.handle(Signer(key).sign(sent) if key else sent, 'stranger')
    assert results(out) in ([2], [])  # DENIED, or no answer at all
    assert not inner.vehicles[1].autopilot.armed
    assert not inner.in_lockstep


def test_without_the_key_no_set_point_and_no_parameter_arrives() -> None:
    inner = SimServer()
    server, owner = SignedServer(inner, Signer(KEY)), Signer(KEY)
    settings = astuple(inner.vehicles[1].autopilot.settings)
    point = mavlink.MAVLink_set_position_target_local_ned_message(
        0, 1, 1, 1, 0x9C0, 5.0, 0, -20.0, 0, 0, 0, 0, 0, 0, 0.0, 0
    )
    parameter = mavlink.MAVLink_param_set_message(1, 1, b'MPC_XY_CRUISE', 3.0, 9)
    offboard = command(176, 1, 6, 0)
    server.handle(frame(point) + frame(parameter), 'stranger')
    assert results(server.handle(owner.sign(frame(offboard)), 'owner')) != [0]
    assert astuple(inner.vehicles[1].autopilot.settings) == settings
    server.handle(owner.sign(frame(point) + frame(parameter)), 'owner')
    assert results(server.handle(owner.sign(frame(offboard)), 'owner')) == [0]
    assert astuple(inner.vehicles[1].autopilot.settings) != settings


def test_without_the_key_one_may_look() -> None:
    server = SignedServer(SimServer(), Signer(KEY))
    server.handle(frame(HEARTBEAT), 'station')
    server.poll(0.0)
    sent = [out for i in range(200) for to, out in server.poll(0.01 * i) if to == 'station']
    reader = mavlink.MAVLink(None)
    seen = {m.get_type() for d in sent for m in reader.parse_buffer(bytearray(d)) or []}
    assert {'HEARTBEAT', 'GLOBAL_POSITION_INT'} <= seen


def test_with_the_key_the_same_is_commanded() -> None:
    inner = SimServer()
    server, owner = SignedServer(inner, Signer(KEY)), Signer(KEY)
    assert results(server.handle(owner.sign(frame(ARM)), 'owner')) == [0]
    assert inner.vehicles[1].autopilot.armed


def test_a_key_is_a_file_of_its_owner(tmp_path: Path) -> None:
    assert signer_from({}) is None
    assert signer_from({KEY_FILE_VARIABLE: ''}) is None
    file = tmp_path / 'key'
    file.write_bytes(KEY)
    named = {KEY_FILE_VARIABLE: str(file)}
    file.chmod(0o640)
    with pytest.raises(KeyFileError, match='chmod 600'):
        signer_from(named)
    file.chmod(0o600)
    assert isinstance(signer_from(named), Signer)
    for wrong in (b'', KEY[1:], KEY + b'x'):
        file.write_bytes(wrong)
        with pytest.raises(KeyFileError, match='32 bytes'):
            signer_from(named)
    file.unlink()
    with pytest.raises(KeyFileError, match='cannot be read'):
        signer_from(named)
    os.mkfifo(file, 0o600)
    with pytest.raises(KeyFileError, match='regular'):
        signer_from(named)
    with socket.socket(socket.AF_UNIX) as sock:
        sock.bind(str(tmp_path / 's'))
        with pytest.raises(KeyFileError):
            signer_from({KEY_FILE_VARIABLE: str(tmp_path / 's')})
