# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The simulator as ground stations and other programs meet it, stand-alone."""

from __future__ import annotations

import math
import random
from collections import Counter
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.commands import HANDLERS
from aurora_uav_sim.mavlink_server import MAX_LINKS, SimServer
from aurora_uav_sim.protocol import CMD_LOCKSTEP, CMD_SEED, CMD_STEP, CMD_WIND

ACCEPTED, REJECTED, DENIED, UNSUPPORTED = 0, 1, 2, 3
ARM, TAKEOFF, LAND = 400, 22, 21
SET_MODE, REPOSITION, SET_HOME, REBOOT = 176, 192, 179, 246
REQUEST_MESSAGE, SET_INTERVAL, GET_INTERVAL = 512, 511, 510
RALLY = int(mavlink.MAV_MISSION_TYPE_RALLY)
NAN = math.nan
HEARTBEAT = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3)


def names(messages: list[Any]) -> list[str]:
    return [m.get_type() for m in messages]


def set_point(system: int = 1, x: float = 0.0, z: float = -20.0, **changes: Any) -> Any:
    values = {'frame': 1, 'mask': 0x9C0} | changes
    return mavlink.MAVLink_set_position_target_local_ned_message(
        0, system, 1, values['frame'], values['mask'], x, 0, z, 0, 0, 0, 0, 0, 0, 0.0, 0
    )


def climb(server: SimServer, station: Any, system: int = 1) -> None:
    server.poll(0.0)
    assert station.result(ARM, 1, system=system) == ACCEPTED
    assert station.result(TAKEOFF, 0, 0, 0, NAN, NAN, NAN, 488.0 + 20.0, system=system) == ACCEPTED
    station.poll(0.0, 12.0)


def test_take_off_fly_and_land(server: SimServer, station: Any) -> None:
    climb(server, station)
    body = server.vehicles[1].autopilot.body
    assert body.z == pytest.approx(20.0, abs=0.2)
    assert server.vehicles[2].autopilot.body.z == 0.0
    assert station.result(LAND, 0, 0, 0, NAN, NAN, NAN, 0) == ACCEPTED
    station.poll(12.0, 25.0)
    assert body.z == 0.0
    assert not server.vehicles[1].autopilot.armed


def test_telemetry_says_what_the_vehicle_does(server: SimServer, station: Any) -> None:
    climb(server, station)
    station.send(HEARTBEAT)
    last = {}
    for m in station.poll(12.0, 1.0):
        if m.get_srcSystem() == 1:
            last[m.get_type()] = m
    body = server.vehicles[1].autopilot.body
    assert last['HEARTBEAT'].base_mode & 128
    assert last['HEARTBEAT'].autopilot == 12
    assert last['HEARTBEAT'].custom_mode == 4 << 16 | 3 << 24
    assert last['LOCAL_POSITION_NED'].z == pytest.approx(-body.z, abs=1e-3)
    assert last['GLOBAL_POSITION_INT'].relative_alt == pytest.approx(body.z * 1e3, abs=2)
    assert last['GLOBAL_POSITION_INT'].alt == pytest.approx((488.0 + body.z) * 1e3, abs=2)
    # The vehicle looks east.
    assert last['GLOBAL_POSITION_INT'].hdg == pytest.approx(9000, abs=5)
    assert last['ATTITUDE'].yaw == pytest.approx(math.pi / 2, abs=1e-3)
    assert last['ATTITUDE_QUATERNION'].q1 == pytest.approx(math.sqrt(0.5), abs=1e-3)
    assert last['EXTENDED_SYS_STATE'].landed_state == mavlink.MAV_LANDED_STATE_IN_AIR
    assert last['GPS_RAW_INT'].fix_type == 3
    assert last['GPS_RAW_INT'].lat == pytest.approx(473977420, abs=5)
    assert last['HOME_POSITION'].altitude == 488000
    needed = mavlink.MAV_SYS_STATUS_SENSOR_3D_GYRO | mavlink.MAV_SYS_STATUS_SENSOR_GPS
    assert last['SYS_STATUS'].onboard_control_sensors_health & needed == needed


def test_stream_rates(server: SimServer, station: Any) -> None:
    server.poll(0.0)
    station.send(HEARTBEAT)
    seen = Counter(m.get_type() for m in station.poll(0.01, 5.0) if m.get_srcSystem() == 1)
    assert 5 <= seen['HEARTBEAT'] <= 6
    for name in ('GLOBAL_POSITION_INT', 'LOCAL_POSITION_NED', 'ATTITUDE', 'ATTITUDE_QUATERNION'):
        assert 50 <= seen[name] <= 52


def test_nobody_gets_telemetry_who_did_not_speak_or_fell_silent(
    server: SimServer, station: Any
) -> None:
    assert station.poll(0.0, 2.0) == []
    station.send(HEARTBEAT)
    assert station.poll(2.0, 2.0)
    station.poll(4.0, 9.0)
    assert station.poll(14.0, 2.0) == []


def test_watchers_get_telemetry_unasked() -> None:
    watched = SimServer((1,), ['qgc'])
    for i in range(2000):
        sent = watched.poll(0.01 * i)
    assert sum(where == 'qgc' for where, _ in watched.poll(30.0)) == 1
    assert sent is not None


def test_message_intervals(server: SimServer, station: Any) -> None:
    station.send(HEARTBEAT)
    server.poll(0.0)
    assert station.result(SET_INTERVAL, 30, 20_000) == ACCEPTED
    assert station.result(SET_INTERVAL, 31, -1) == ACCEPTED
    seen = Counter(m.get_type() for m in station.poll(0.01, 2.0) if m.get_srcSystem() == 1)
    assert 95 <= seen['ATTITUDE'] <= 102
    assert seen['ATTITUDE_QUATERNION'] == 0
    (answer,) = [m for m in station.command(GET_INTERVAL, 30) if m.get_type() != 'COMMAND_ACK']
    assert (answer.message_id, answer.interval_us) == (30, 20000)
    assert station.result(SET_INTERVAL, 31, 0) == ACCEPTED
    (answer,) = [m for m in station.command(GET_INTERVAL, 31) if m.get_type() != 'COMMAND_ACK']
    assert answer.interval_us == 100_000
    assert station.result(SET_INTERVAL, 9999, 0) == UNSUPPORTED
    assert station.result(SET_INTERVAL, NAN, 0) == DENIED
    assert station.result(SET_INTERVAL, 30, NAN) == DENIED


def test_messages_on_request(station: Any) -> None:
    for number, name in ((148, 'AUTOPILOT_VERSION'), (242, 'HOME_POSITION'), (0, 'HEARTBEAT')):
        assert sorted(names(station.command(REQUEST_MESSAGE, number))) == sorted(
            ['COMMAND_ACK', name]
        )
    assert station.result(REQUEST_MESSAGE, 12345) == UNSUPPORTED
    assert station.result(REQUEST_MESSAGE, math.inf) == DENIED
    version = station.command(520, 1)
    assert 'AUTOPILOT_VERSION' in names(version)
    capabilities = next(m for m in version if m.get_type() == 'AUTOPILOT_VERSION').capabilities
    assert capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MAVLINK2
    assert capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_INT
    # No rally points: it must not claim them.
    assert not capabilities & mavlink.MAV_PROTOCOL_CAPABILITY_MISSION_RALLY


def test_every_unknown_command_is_answered_unsupported(station: Any) -> None:
    known = {*HANDLERS, REQUEST_MESSAGE, SET_INTERVAL, GET_INTERVAL, 520}
    ours = {CMD_STEP, CMD_LOCKSTEP}
    for command in set(mavlink.enums['MAV_CMD']) - known - ours:
        if command <= 65535:
            assert station.result(command, 1, 1, 1, 1, 1, 1, 1) == UNSUPPORTED
    assert station.result(CMD_WIND, 1, 1, 0, 0) == UNSUPPORTED
    assert station.result(CMD_SEED, 1, 0, 0, 0) == UNSUPPORTED
    assert station.result(CMD_STEP, 1) == DENIED


@pytest.mark.parametrize('bad', [NAN, math.inf, -math.inf, 3e38, 0.5])
def test_nonsense_parameters_never_raise_and_never_fly(station: Any, bad: float) -> None:
    for command in (*HANDLERS, REQUEST_MESSAGE, SET_INTERVAL, GET_INTERVAL, 520, CMD_LOCKSTEP):
        for place in range(7):
            values = [bad if i == place else 1.0 for i in range(7)]
            assert station.result(command, *values) in range(4)
        station.result(command, *[bad] * 7)
    station.poll(0.0, 1.0)
    for vehicle in station.server.vehicles.values():
        assert math.isfinite(vehicle.autopilot.body.z)
        assert vehicle.autopilot.body.z < 1.0


def test_modes(server: SimServer, station: Any) -> None:
    climb(server, station)
    autopilot = server.vehicles[1].autopilot
    # No mission was uploaded.
    assert station.result(SET_MODE, 1, 4, 4) == REJECTED
    # Nor does it follow anybody.
    assert station.result(SET_MODE, 1, 4, 8) == UNSUPPORTED
    assert station.result(SET_MODE, 1, 1, 0) == UNSUPPORTED
    assert station.result(SET_MODE, 0, 4, 3) == UNSUPPORTED
    assert station.result(SET_MODE, 1, 6, 0) == REJECTED
    for _ in range(3):
        station.send(set_point(x=30.0))
    assert station.result(SET_MODE, 1, 6, 0) == ACCEPTED
    for i in range(400):
        station.send(set_point(x=30.0))
        station.poll(12.0 + 0.05 * i, 0.04)
    # NED: x is north.
    assert (autopilot.body.x, autopilot.body.y) == pytest.approx((0.0, 30.0), abs=0.1)
    assert station.result(SET_MODE, 1, 4, 3) == ACCEPTED
    assert station.result(SET_MODE, 1, 4, 6) == ACCEPTED
    station.poll(32.0, 25.0)
    assert autopilot.landed


def test_a_refusal_comes_with_its_reason(station: Any) -> None:
    answers = station.command(SET_MODE, 1, 6, 0)
    assert names(answers) == ['COMMAND_ACK', 'STATUSTEXT']
    assert 'set-points' in answers[1].text


def test_set_points_of_an_unknown_kind_do_not_count_as_a_stream(
    server: SimServer, station: Any
) -> None:
    climb(server, station)
    for bad in (set_point(frame=8), set_point(mask=0), set_point(x=NAN), set_point(system=9)):
        station.send(bad)
    assert station.result(SET_MODE, 1, 6, 0) == REJECTED


def test_reposition(server: SimServer, station: Any) -> None:
    x, y = round((47.397742 + 1e-4) * 1e7), round(8.545594 * 1e7)

    def goto(frame: int, z: float, lat: int = x, flags: float = 1.0) -> int:
        answers = station.send(
            mavlink.MAVLink_command_int_message(
                1, 1, frame, REPOSITION, 0, 0, -1.0, flags, 0.0, NAN, lat, y, z
            )
        )
        return int(next(m for m in answers if m.get_type() == 'COMMAND_ACK').result)

    assert goto(0, 500.0) == REJECTED
    climb(server, station)
    assert goto(1, 500.0) == DENIED
    assert goto(0, 480.0) == DENIED
    assert goto(0, 500.0, lat=2_000_000_000) == DENIED
    assert goto(0, 500.0, lat=0) == DENIED
    assert goto(0, 500.0, flags=NAN) == DENIED
    assert goto(6, 12.0) == ACCEPTED
    station.poll(12.0, 20.0)
    body = server.vehicles[1].autopilot.body
    # 1e-4 degrees of latitude are 11.1 m.
    assert (body.x, body.y, body.z) == pytest.approx((0.0, 11.1, 12.0), abs=0.15)
    assert goto(0, 500.0, lat=2**31 - 1) == DENIED
    assert station.result(REPOSITION, -1, 1, 0, NAN, NAN, NAN, 508.0) == ACCEPTED


def test_home(server: SimServer, station: Any) -> None:
    vehicle = server.vehicles[1]
    assert station.result(SET_HOME, 0, 0, 0, NAN, 47.398, 8.546, 500.0) == ACCEPTED
    assert vehicle.home[1] == pytest.approx(28.7, abs=0.5)
    assert vehicle.home[2] == pytest.approx(12.0)
    # The vehicle itself stays.
    assert vehicle.autopilot.body.x == 0.0
    assert station.result(SET_HOME, 1) == ACCEPTED
    assert vehicle.home == (0.0, 0.0, 0.0)
    assert station.result(SET_HOME, 0, 0, 0, NAN, NAN, 8.546, 500.0) == DENIED
    assert station.result(SET_HOME, 0, 0, 0, NAN, 10.0, 8.546, 500.0) == DENIED


def test_reboot(server: SimServer, station: Any) -> None:
    climb(server, station)
    assert station.result(REBOOT, 1) == REJECTED
    assert station.result(LAND) == ACCEPTED
    station.poll(12.0, 25.0)
    assert station.result(REBOOT, 2) == UNSUPPORTED
    assert station.result(REBOOT, 0) == ACCEPTED
    assert server.vehicles[1].autopilot.time_s > 1.0
    assert station.result(REBOOT, 1) == ACCEPTED
    assert server.vehicles[1].autopilot.time_s == 0.0


def test_parameters(server: SimServer, station: Any) -> None:
    values = station.send(mavlink.MAVLink_param_request_list_message(1, 1))
    assert len(values) == values[0].param_count
    assert [v.param_index for v in values] == list(range(len(values)))
    (read,) = station.send(mavlink.MAVLink_param_request_read_message(1, 1, b'MPC_XY_CRUISE', -1))
    assert read.param_value == 5.0

    def set_value(name: bytes, value: float, kind: int = 9) -> list[Any]:
        message = mavlink.MAVLink_param_set_message(1, 1, name, value, kind)
        return list(station.send(message))

    (done,) = set_value(b'MPC_XY_CRUISE', 7.0)
    assert done.param_value == 7.0
    assert server.vehicles[1].autopilot.settings.cruise_mps == 7.0
    assert server.vehicles[2].autopilot.settings.cruise_mps == 5.0
    for value, kind in ((NAN, 9), (1e6, 9), (6.0, 6)):
        refused = set_value(b'MPC_XY_CRUISE', value, kind)
        assert names(refused) == ['PARAM_VALUE', 'STATUSTEXT']
        assert refused[0].param_value == 7.0
    assert names(set_value(b'NO_SUCH_THING', 1.0)) == ['STATUSTEXT']
    for index in (99, 32767):
        unknown = mavlink.MAVLink_param_request_read_message(1, 1, b'', index)
        assert names(station.send(unknown)) == ['STATUSTEXT']


def test_time_ping_and_missions(station: Any) -> None:
    sync = station.send(mavlink.MAVLink_timesync_message(0, 123))
    assert [m.ts1 for m in sync] == [123, 123]
    assert station.send(mavlink.MAVLink_timesync_message(5, 123)) == []
    ping = station.send(mavlink.MAVLink_ping_message(1, 7, 0, 0))
    assert [(m.seq, m.target_system) for m in ping] == [(7, 255), (7, 255)]
    assert station.send(mavlink.MAVLink_ping_message(1, 7, 255, 190)) == []
    (count,) = station.send(mavlink.MAVLink_mission_request_list_message(1, 1))
    assert (count.get_type(), count.count) == ('MISSION_COUNT', 0)
    (refusal,) = station.send(mavlink.MAVLink_mission_count_message(1, 1, 65535))
    assert (refusal.get_type(), refusal.type) == ('MISSION_ACK', mavlink.MAV_MISSION_NO_SPACE)
    (refusal,) = station.send(mavlink.MAVLink_mission_count_message(1, 1, 1, RALLY))
    assert (refusal.get_type(), refusal.type) == ('MISSION_ACK', mavlink.MAV_MISSION_UNSUPPORTED)


def test_addresses(server: SimServer, station: Any) -> None:
    acks = station.command(ARM, 1, system=0)
    assert [m.get_srcSystem() for m in acks] == [1, 2]
    assert station.command(ARM, 1, system=9) == []
    gimbal = mavlink.MAVLink_command_long_message(1, 154, ARM, 0, 0, 0, 0, 0, 0, 0, 0)
    assert station.send(gimbal) == []
    assert server.vehicles[1].autopilot.armed


def test_stray_and_changed_datagrams_change_nothing(server: SimServer, station: Any) -> None:
    rng = random.Random(11)
    server.poll(0.0)
    good = station.pack(mavlink.MAVLink_command_long_message(1, 1, ARM, 0, 1, 0, 0, 0, 0, 0, 0))
    before = server.vehicles[1].autopilot.body.x
    for i in range(2000):
        kind = i % 3
        if kind == 0:
            data = rng.randbytes(rng.randrange(300))
        else:
            mutable = bytearray(good)
            mutable[rng.randrange(len(mutable))] ^= rng.randrange(1, 256)
            data = bytes(mutable) if kind == 1 else bytes(mutable[: rng.randrange(len(mutable))])
        assert server.handle(data, ('stray', i)) == []
    assert not server.vehicles[1].autopilot.armed
    assert server.vehicles[1].autopilot.body.x == before
    assert server.poll(0.01) == []


def test_random_but_intact_frames_never_raise(server: SimServer, station: Any) -> None:
    from aurora_uav_sim import wire

    rng = random.Random(12)
    messages = list(mavlink.mavlink_map)
    for i in range(3000):
        payload = rng.randbytes(rng.choice((1, 9, 30, 255)))
        # Half of them are addressed to a vehicle.
        raw = wire.pack(i & 0xFF, 255, 190, rng.choice(messages), payload)
        server.handle(raw, 'fuzzer')
    for i in range(300):
        server.poll(0.01 * i)
    for vehicle in server.vehicles.values():
        assert math.isfinite(vehicle.autopilot.body.z)
    assert station.result(REQUEST_MESSAGE, 0) == ACCEPTED


@pytest.mark.parametrize('fill', ['random', 'nan', 'ones'])
def test_intact_frames_of_strangers_change_nothing_in_a_session(
    server: SimServer, station: Any, fill: str
) -> None:
    """Every message of the dialect, also from the owner's address with wrong ids and numbers."""
    from aurora_uav_sim import wire

    assert station.result(CMD_LOCKSTEP, 1, 7, 50_000, 3, 0, 0, 0) == ACCEPTED
    rng = random.Random(13)
    before = [vehicle.autopilot.body.z for vehicle in server.vehicles.values()]
    for number, message_id in enumerate(list(mavlink.mavlink_map) * 3):
        payload = {
            'random': rng.randbytes(255), 'nan': b'\x00\x00\xc0\x7f' * 63, 'ones': b'\xff' * 255
        }[fill]  # fmt: skip
        raw = wire.pack(number & 0xFF, rng.randrange(1, 255), 99, message_id, payload)
        server.handle(raw, 'stranger')
        server.handle(raw, station.source)
        server.handle(raw + raw[: rng.randrange(len(raw))], station.source)
    server.poll(0.5)
    assert server.in_lockstep
    assert [vehicle.autopilot.body.z for vehicle in server.vehicles.values()] == before
    assert {vehicle.autopilot.time_s for vehicle in server.vehicles.values()} == {0.0}
    assert not any(vehicle.autopilot.armed for vehicle in server.vehicles.values())
    # The session goes on as if nothing had been.
    for system in (1, 2):
        message = mavlink.MAVLink_set_position_target_local_ned_message(
            1, system, 1, 1, 0x9C0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0
        )
        station.send(message)
    assert station.result(CMD_STEP, 1) == ACCEPTED


def test_many_sources_do_not_pile_up(server: SimServer, station: Any) -> None:
    server.poll(0.0)
    beat = station.pack(HEARTBEAT)
    for i in range(500):
        server.handle(beat, ('flood', i))
    assert len({where for where, _ in server.poll(0.02)}) <= MAX_LINKS


def test_a_stall_is_not_caught_up(server: SimServer) -> None:
    server.poll(0.0)
    server.poll(100.0)
    assert server.vehicles[1].autopilot.time_s <= 0.26


def test_real_time_is_kept(server: SimServer) -> None:
    for i in range(1001):
        server.poll(5.0 + 0.013 * i)
    assert server.vehicles[1].autopilot.time_s == pytest.approx(13.0, abs=0.011)
