# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Lockstep as the wire sees it: only the owner's steps move time, and each only once."""

from __future__ import annotations

from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.protocol import (
    CMD_LOCKSTEP,
    CMD_SEED,
    CMD_STEP,
    CMD_WIND,
    OWNER_SILENCE_S,
    fleet_masks,
    unpack_status,
)

ACCEPTED, REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3
ARM, TAKEOFF, SET_HOME, REBOOT, REQUEST_MESSAGE = 400, 22, 179, 246, 512
NONCE = 4711


def enter(
    station: Any, nonce: int = NONCE, ids: tuple[int, ...] = (1, 2), us: int = 50_000
) -> int:
    return int(station.result(CMD_LOCKSTEP, 1, nonce, us, *fleet_masks(ids)))


def set_point(tick: int, system: int, z: float = 0.0) -> Any:
    return mavlink.MAVLink_set_position_target_local_ned_message(
        tick, system, 1, 1, 0x9C0, 0, 0, z, 0, 0, 0, 0, 0, 0, 0.0, 0
    )


def step_message(tick: float) -> Any:
    return mavlink.MAVLink_command_long_message(1, 1, CMD_STEP, 0, tick, 0, 0, 0, 0, 0, 0)


def step(station: Any, tick: int, ids: tuple[int, ...] = (1, 2)) -> list[Any]:
    data = b''.join(station.pack(set_point(tick, i)) for i in ids)
    data += station.pack(step_message(tick))
    return list(station.parse(station.server.handle(data, station.source)))


def ack_of(messages: list[Any]) -> Any:
    (ack,) = [m for m in messages if m.get_type() == 'COMMAND_ACK']
    return ack


def test_entering_stops_time_and_resets(server: SimServer, station: Any) -> None:
    server.poll(0.0)
    station.result(ARM, 1)
    assert enter(station) == ACCEPTED
    assert server.in_lockstep
    assert not server.vehicles[1].autopilot.armed
    server.poll(10.0)
    assert server.vehicles[1].autopilot.time_s == 0.0


def test_a_tick_answers_with_every_vehicle_and_then_the_acknowledgement(station: Any) -> None:
    enter(station)
    answers = step(station, 1)
    assert [m.get_type() for m in answers] == [
        'LOCAL_POSITION_NED', 'ATTITUDE_QUATERNION', 'NAMED_VALUE_INT',
        'LOCAL_POSITION_NED', 'ATTITUDE_QUATERNION', 'NAMED_VALUE_INT', 'COMMAND_ACK',
    ]  # fmt: skip
    assert {m.time_boot_ms for m in answers[:-1]} == {1}
    assert [m.get_srcSystem() for m in answers] == [1, 1, 1, 2, 2, 2, 1]
    ack = answers[-1]
    assert (ack.command, ack.result, ack.result_param2) == (CMD_STEP, ACCEPTED, 1)
    assert unpack_status(answers[2].value, NONCE) == (0, False, True)


def test_a_repeated_tick_is_answered_again_without_moving(server: SimServer, station: Any) -> None:
    enter(station)
    station.result(ARM, 1)
    station.result(TAKEOFF, 0, 0, 0, 0, 0, 0, 500.0)
    first = step(station, 1)
    time_s = server.vehicles[1].autopilot.time_s
    again = station.send(step_message(1))
    assert server.vehicles[1].autopilot.time_s == time_s == pytest.approx(0.05)
    assert [m.get_payload() for m in again] == [m.get_payload() for m in first]
    # New frames, so that the other side does not take them for duplicates.
    assert [m.get_seq() for m in again] != [m.get_seq() for m in first]


def test_the_state_of_tick_0_can_be_asked(station: Any) -> None:
    enter(station)
    answers = station.send(step_message(0))
    assert len(answers) == 7
    assert {m.time_boot_ms for m in answers[:-1]} == {0}


def test_a_missing_set_point_refuses_the_tick_and_is_asked_again(
    server: SimServer, station: Any
) -> None:
    enter(station)
    answers = step(station, 1, ids=(2,))
    assert len(answers) == 1
    ack = ack_of(answers)
    assert (ack.result, ack.result_param2) == (REJECTED, 1)
    assert server.vehicles[1].autopilot.time_s == 0.0
    # What came is kept; the rest completes the tick.
    assert ack_of(step(station, 1, ids=(1,))).result == ACCEPTED


@pytest.mark.parametrize('bad', [float('nan'), float('inf'), 1e7])
def test_a_bad_set_point_counts_as_missing(station: Any, bad: float) -> None:
    enter(station)
    station.send(set_point(1, 1, z=bad))
    station.send(set_point(1, 2))
    assert ack_of(station.send(step_message(1))).result == REJECTED


def test_set_points_of_another_tick_do_not_count(station: Any) -> None:
    enter(station)
    for tick in (0, 2, 7):
        station.send(set_point(tick, 1))
        station.send(set_point(tick, 2))
    assert ack_of(station.send(step_message(1))).result == REJECTED


@pytest.mark.parametrize('tick', [2, 5, -1, 0.5, float('nan'), float('inf')])
def test_ticks_out_of_order_are_denied(server: SimServer, station: Any, tick: float) -> None:
    enter(station)
    assert ack_of(station.send(step_message(tick))).result == DENIED
    assert server.vehicles[1].autopilot.time_s == 0.0


def test_an_old_tick_is_denied(station: Any) -> None:
    enter(station)
    step(station, 1)
    step(station, 2)
    assert ack_of(station.send(step_message(1))).result == DENIED


def test_stale_duplicates_do_not_act(server: SimServer, station: Any) -> None:
    enter(station)
    arm = station.pack(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, 0, 0, 0, 0, 0, 0))
    disarm = station.pack(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 0, 0, 0, 0, 0, 0, 0))
    assert len(server.handle(arm, station.source)) == 1
    assert len(server.handle(disarm, station.source)) == 1
    assert server.handle(arm, station.source) == []
    assert not server.vehicles[1].autopilot.armed


def test_only_the_owner_commands_but_others_may_look(
    server: SimServer, station: Any, other: Any
) -> None:
    enter(station)
    assert other.result(ARM, 1) == REJECTED
    assert other.result(CMD_STEP, 1) == DENIED
    other.send(set_point(1, 1))
    other.send(set_point(1, 2))
    assert ack_of(station.send(step_message(1))).result == REJECTED
    change = mavlink.MAVLink_param_set_message(1, 1, b'MPC_XY_CRUISE', 9.0, 9)
    assert other.send(change)[0].param_value == 5.0
    assert other.result(REQUEST_MESSAGE, 0) == ACCEPTED
    sent = server.poll(1.0)
    assert {where for where, _ in sent} == {'other'}


def test_a_session_that_is_owned_is_not_taken_over(
    server: SimServer, station: Any, other: Any
) -> None:
    server.poll(0.0)
    enter(station)
    step(station, 1)
    answers = other.command(CMD_LOCKSTEP, 1, 99, 50_000, *fleet_masks((1,)))
    assert ack_of(answers).result == REJECTED
    (text,) = [m.text for m in answers if m.get_type() == 'STATUSTEXT']
    assert text == 'Held by station'
    assert ack_of(step(station, 2)).result == ACCEPTED
    assert server.vehicles[1].autopilot.time_s == pytest.approx(0.1)
    # Free again once its owner has left.
    assert station.result(CMD_LOCKSTEP, 0, NONCE) == ACCEPTED
    assert enter(other, nonce=99, ids=(1,)) == ACCEPTED


def test_heartbeats_keep_a_session_and_silence_gives_it_away(
    server: SimServer, station: Any, other: Any
) -> None:
    server.poll(0.0)
    enter(station)
    for second in range(1, 20):
        station.send(mavlink.MAVLink_heartbeat_message(18, 8, 0, 0, 4, 3))
        server.poll(float(second))
    server.poll(19.0 + 0.9 * OWNER_SILENCE_S)
    assert enter(other, nonce=99, ids=(1,)) == REJECTED
    server.poll(19.0 + 1.1 * OWNER_SILENCE_S)
    assert server.in_lockstep, 'nobody wanted it: it goes on'
    assert enter(other, nonce=99, ids=(1,)) == ACCEPTED
    assert server.vehicles[1].autopilot.time_s == 0.0
    ack = ack_of(step(station, 1))
    assert (ack.result, ack.result_param2) == (DENIED, 0), 'the first is told'


def test_how_long_an_owner_may_be_silent_is_a_setting(station: Any) -> None:
    server = SimServer((1, 2), owner_silence_s=10.0)
    kind = type(station)
    station, other = kind(server, 'station'), kind(server, 'other')
    server.poll(0.0)
    enter(station)
    server.poll(0.01)
    server.poll(9.0)
    assert enter(other, nonce=99) == REJECTED
    server.poll(11.0)
    assert enter(other, nonce=99) == ACCEPTED


def test_the_owner_is_its_ids_as_well_as_its_address(server: SimServer, station: Any) -> None:
    enter(station)
    stranger = type(station)(server, station.source)
    stranger.mav.srcSystem = 7
    stranger.command(ARM, 1)
    stranger.send(set_point(1, 1))
    stranger.send(set_point(1, 2))
    acks = [
        ack_of(stranger.command(CMD_LOCKSTEP, *rest)).result
        for rest in ((1, 99, 50_000, *fleet_masks((1, 2))), (0, NONCE))
    ]
    assert acks == [REJECTED, DENIED]
    assert ack_of(stranger.send(step_message(0))).result == DENIED
    assert ack_of(station.send(step_message(1))).result == REJECTED, 'its set-points are not there'
    assert not server.vehicles[1].autopilot.armed


@pytest.mark.parametrize('ticks', [0, 3])
def test_nobody_but_the_owner_prepares_or_commands(
    server: SimServer, station: Any, other: Any, ticks: int
) -> None:
    enter(station)
    for tick in range(1, ticks + 1):
        step(station, tick)
    wind = server.vehicles[1].autopilot.wind.x
    home = server.vehicles[1].home
    for command, *parameters in (
        (CMD_WIND, 1.0, 2.0, 0.0, 3.0),
        (CMD_SEED, 1, 2, 3, 4),
        (SET_HOME, 0, 0, 0, 90.0, 48.0, 11.0, 100.0),
        (REBOOT, 1),
        (ARM, 1),
        (TAKEOFF, 0, 0, 0, 0, 0, 0, 500.0),
    ):
        assert other.result(command, *parameters) == REJECTED
    assert server.vehicles[1].autopilot.wind.x == wind
    assert server.vehicles[1].home == home
    assert ack_of(step(station, ticks + 1)).result == ACCEPTED


def test_a_late_duplicate_of_an_old_session_is_denied(
    server: SimServer, station: Any, other: Any
) -> None:
    enter(station, nonce=1)
    station.result(CMD_LOCKSTEP, 0, 1)
    enter(other, nonce=2)
    step(other, 1)
    assert enter(station, nonce=1) == DENIED
    assert enter(station, nonce=2) == DENIED
    assert server.vehicles[1].autopilot.time_s > 0.0
    # Entering twice with the same nonce is one entering.
    assert enter(other, nonce=2) == ACCEPTED
    assert server.vehicles[1].autopilot.time_s > 0.0


def test_a_late_step_of_an_older_session_does_not_act(server: SimServer, station: Any) -> None:
    """Its tick fits, its set-points are all there, and it comes from the right place."""
    enter(station, nonce=1)
    late = [station.pack(set_point(1, system)) for system in (1, 2)]
    late.append(station.pack(step_message(1)))
    assert enter(station, nonce=2) == ACCEPTED
    assert [server.handle(frame, station.source) for frame in late] == [[], [], []]
    assert server.vehicles[1].autopilot.time_s == 0.0
    assert ack_of(step(station, 1)).result == ACCEPTED


def test_a_new_client_on_the_same_port_counts_from_0_again(station: Any) -> None:
    enter(station, nonce=1)
    for _ in range(5):
        station.send(step_message(0))
    station.mav.seq = 0
    assert enter(station, nonce=2) == ACCEPTED
    assert ack_of(step(station, 1)).result == ACCEPTED


def test_acknowledgements_name_the_session(station: Any) -> None:
    answers = station.command(CMD_LOCKSTEP, 1, NONCE, 50_000, *fleet_masks((1,)))
    assert ack_of(answers).result_param2 == NONCE
    assert ack_of(station.command(ARM, 1)).result_param2 == NONCE


def test_preparation_ends_with_the_first_step(server: SimServer, station: Any) -> None:
    enter(station)
    preparations = (
        (CMD_WIND, 1.0, 2.0, 0.0, 3.0),
        (CMD_SEED, 1, 2, 3, 4),
        (SET_HOME, 0, 0, 0, 90.0, 48.0, 11.0, 100.0),
        (REBOOT, 1),
    )
    for command, *parameters in preparations:
        assert station.result(command, *parameters) == ACCEPTED
    assert server.vehicles[1].autopilot.wind.x == 2.0
    assert server.vehicles[1].altitude_m == 100.0
    step(station, 1)
    for command, *parameters in preparations:
        assert station.result(command, *parameters) == DENIED


@pytest.mark.parametrize(
    ('command', 'parameters'),
    [
        (CMD_WIND, (float('nan'), 0, 0, 0)),
        (CMD_WIND, (0, 0, 0, -1)),
        (CMD_WIND, (0, 99, 0, 0)),
        (CMD_SEED, (0.5, 0, 0, 0)),
        (CMD_SEED, (65536, 0, 0, 0)),
        (CMD_SEED, (float('nan'), 0, 0, 0)),
        (SET_HOME, (0, 0, 0, 0, 95.0, 0, 0)),
        (SET_HOME, (0, 0, 0, 0, 0, 0, float('nan'))),
    ],
)
def test_bad_preparation_is_denied(
    station: Any, command: int, parameters: tuple[float, ...]
) -> None:
    enter(station)
    assert station.result(command, *parameters) == DENIED


def test_reboot_puts_the_vehicle_back(server: SimServer, station: Any) -> None:
    enter(station)
    station.result(SET_HOME, 0, 0, 0, 0.0, 48.0, 11.0, 100.0)
    vehicle = server.vehicles[1]
    pose = (vehicle.autopilot.body.qw, vehicle.autopilot.body.qz)
    # North is a quarter turn: half of it in the quaternion.
    assert pose == pytest.approx((0.5**0.5, 0.5**0.5))
    station.result(ARM, 1)
    assert station.result(REBOOT, 1) == ACCEPTED
    assert not vehicle.autopilot.armed
    assert (vehicle.autopilot.body.qw, vehicle.autopilot.body.qz) == pose
    assert station.result(REBOOT, 2) == UNSUPPORTED


@pytest.mark.parametrize(
    ('nonce', 'us', 'masks'),
    [
        (0, 50_000, (1, 0, 0, 0)),
        (0.5, 50_000, (1, 0, 0, 0)),
        (2**24, 50_000, (1, 0, 0, 0)),
        (1, 0, (1, 0, 0, 0)),
        (1, float('nan'), (1, 0, 0, 0)),
        (1, 2_000_000, (1, 0, 0, 0)),
        (1, 50_000, (0, 0, 0, 0)),
        (1, 50_000, (0xFFFF, 0xFFFF, 0, 0)),
        (1, 50_000, (65536, 0, 0, 0)),
        (1, 50_000, (1.5, 0, 0, 0)),
    ],
)
def test_bad_sessions_are_denied(
    server: SimServer, station: Any, nonce: float, us: float, masks: tuple[float, ...]
) -> None:
    assert station.result(CMD_LOCKSTEP, 1, nonce, us, *masks) == DENIED
    assert not server.in_lockstep


def test_leaving(server: SimServer, station: Any, other: Any) -> None:
    enter(station, ids=(3, 5))
    assert set(server.vehicles) == {3, 5}
    assert other.result(CMD_LOCKSTEP, 0, 123, system=3) == DENIED
    assert station.result(CMD_LOCKSTEP, 0, NONCE, system=3) == ACCEPTED
    assert not server.in_lockstep
    assert set(server.vehicles) == {1, 2}
    # The answer was lost: asked again.
    assert station.result(CMD_LOCKSTEP, 0, NONCE) == ACCEPTED
    assert station.result(CMD_LOCKSTEP, 7, NONCE + 1) == DENIED


def test_a_session_without_owner_ends(server: SimServer, station: Any, other: Any) -> None:
    server.poll(0.0)
    enter(station)
    server.poll(59.0)
    assert server.vehicles.keys() == {1, 2}
    assert ack_of(other.command(ARM, 1)).result == REJECTED
    server.poll(120.0)
    assert not server.in_lockstep
    assert ack_of(station.send(step_message(0))).result == DENIED


def test_tick_length_is_exact(server: SimServer, station: Any) -> None:
    """A tick that is no multiple of the physics step is cut into equal, shorter steps."""
    enter(station, ids=(1,), us=25_000)
    for tick in range(1, 41):
        step(station, tick, ids=(1,))
    assert server.vehicles[1].autopilot.time_s == pytest.approx(1.0, abs=1e-12)
