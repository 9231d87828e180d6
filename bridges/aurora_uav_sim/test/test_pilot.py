# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Missions, the way home and failsafes, message by message: what MAVSDK does not provoke."""

from __future__ import annotations

import math
from typing import Any

import pytest
from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.autopilot import FlightMode
from aurora_uav_sim.mavlink_server import SimServer
from aurora_uav_sim.protocol import CMD_LOCKSTEP

ACCEPTED, REJECTED, DENIED = 0, 1, 2
ARM, TAKEOFF, SET_MODE, RETURN, START, CHECKS = 400, 22, 176, 20, 300, 401
NAN = math.nan
HEARTBEAT = mavlink.MAVLink_heartbeat_message(6, 8, 0, 0, 4, 3)
LATITUDE, LONGITUDE = 473_977_420, 85_455_940
# North by about 11 m.
STEP = 1000
WAYPOINT, LAND, JUMP, SPEED, CIRCLE_IN, POLYGON_IN = 16, 21, 177, 178, 5003, 5001


class Clock:
    """Steady time that a test moves, with a station that is heard all the while.

    Attributes:
        now_s: It.
        texts: What the vehicles said.
    """

    def __init__(self, server: SimServer, station: Any) -> None:
        self.server, self.station = server, station
        self.now_s = 0.0
        self.texts: list[str] = []
        self.messages: list[Any] = []
        self.heartbeats = True
        self.pass_s(0.0)

    def pass_s(self, duration_s: float) -> None:
        """Let time pass."""
        until_s = self.now_s + duration_s
        while True:
            if self.heartbeats:
                self.station.send(HEARTBEAT)
            step_s = min(until_s - self.now_s, 0.5)
            got = self.station.poll(self.now_s + 0.01, step_s)
            self.now_s += step_s + 0.01
            self.messages += got
            self.texts += [m.text for m in got if m.get_type() == 'STATUSTEXT']
            if self.now_s >= until_s:
                return


@pytest.fixture
def clock(server: SimServer, station: Any) -> Clock:
    return Clock(server, station)


def item(seq: int, command: int = WAYPOINT, north: int = 0, z: float = 10.0, **more: Any) -> Any:
    v = {'frame': 6, 'p1': 0.0, 'p2': 0.0, 'p4': NAN, 'type': 0, 'x': LATITUDE + north} | more
    return mavlink.MAVLink_mission_item_int_message(
        1, 1, seq, v['frame'], command, 0, 1, v['p1'], v['p2'], 0, v['p4'],
        v['x'], LONGITUDE, z, v['type'],
    )  # fmt: skip


def upload(station: Any, *items: Any, kind: int = 0) -> int:
    """Upload a plan as the protocol has it; return the result at its end."""
    (asked,) = station.send(mavlink.MAVLink_mission_count_message(1, 1, len(items), kind))
    while asked.get_type() == 'MISSION_REQUEST_INT':
        answers = station.send(items[asked.seq])
        asked = answers[0]
    assert asked.get_type() == 'MISSION_ACK'
    return int(asked.type)


def set_parameter(station: Any, name: bytes, value: float) -> None:
    answers = station.send(mavlink.MAVLink_param_set_message(1, 1, name, value, 9))
    assert answers[0].param_value == pytest.approx(value)


def set_whole(server: SimServer, attribute: str, value: float) -> None:
    setattr(server.vehicles[1].autopilot.settings, attribute, value)


def take_off(clock: Clock, height_m: float = 10.0) -> None:
    assert clock.station.result(ARM, 1) == ACCEPTED
    assert clock.station.result(TAKEOFF, 0, 0, 0, NAN, NAN, NAN, 488.0 + height_m) == ACCEPTED
    clock.pass_s(10.0)
    assert clock.server.vehicles[1].autopilot.body.z == pytest.approx(height_m, abs=0.5)


def mode(clock: Clock) -> FlightMode:
    return clock.server.vehicles[1].autopilot.mode


def test_a_lost_item_is_asked_for_again_and_the_upload_ends(clock: Clock, station: Any) -> None:
    (asked,) = station.send(mavlink.MAVLink_mission_count_message(1, 1, 2))
    assert asked.seq == 0
    clock.pass_s(3.0)
    again = [m for m in clock.messages if m.get_type() == 'MISSION_REQUEST_INT']
    assert again
    assert {m.seq for m in again} == {0}
    (asked,) = station.send(item(0))
    assert asked.seq == 1
    # Twice, or another one than asked for: the missing one is asked for.
    assert [m.seq for m in station.send(item(0))] == [1]
    clock.pass_s(10.0)
    ends = [m.type for m in clock.messages if m.get_type() == 'MISSION_ACK']
    assert ends == [mavlink.MAV_MISSION_OPERATION_CANCELLED]
    assert clock.server.vehicles[1].pilot.mission.items == ()


@pytest.mark.parametrize(
    ('bad', 'result'),
    [
        (item(1, 203), mavlink.MAV_MISSION_UNSUPPORTED),
        (item(1, frame=1), mavlink.MAV_MISSION_UNSUPPORTED_FRAME),
        (item(1, x=2_000_000_000), mavlink.MAV_MISSION_INVALID_PARAM5_X),
        (item(1, z=-5.0), mavlink.MAV_MISSION_INVALID_PARAM7),
        (item(1, z=NAN), mavlink.MAV_MISSION_INVALID_PARAM7),
        (item(1, JUMP, p1=7.0), mavlink.MAV_MISSION_INVALID_PARAM1),
        (item(1, SPEED, p1=1.0, p2=NAN), mavlink.MAV_MISSION_INVALID_PARAM2),
    ],
)
def test_a_mission_is_taken_whole_or_not(
    clock: Clock, station: Any, bad: Any, result: int
) -> None:
    assert upload(station, item(0)) == 0
    assert upload(station, item(0), bad, item(2)) == result
    assert len(clock.server.vehicles[1].pilot.mission.items) == 1
    clock.pass_s(0.1)
    assert any(t.startswith('Mission denied: item 1') for t in clock.texts)


def test_a_loop_of_jumps_does_not_hold_the_process(clock: Clock, station: Any) -> None:
    assert upload(station, item(0, JUMP, p1=1.0, p2=-1.0), item(1, JUMP, p1=0.0, p2=-1.0)) == 0
    assert station.result(ARM, 1) == ACCEPTED
    assert station.result(START) == ACCEPTED
    clock.pass_s(1.0)
    assert clock.server.vehicles[1].autopilot.body.z == 0.0


def test_jumps_repeat_and_the_mission_lands(clock: Clock, station: Any) -> None:
    plan = [
        item(0), item(1, north=STEP), item(2, JUMP, p1=0.0, p2=1.0),
        item(3, LAND, north=STEP, z=0.0),
    ]  # fmt: skip
    assert upload(station, *plan) == 0
    assert station.result(ARM, 1) == ACCEPTED
    assert station.result(START) == ACCEPTED
    clock.pass_s(60.0)
    reached = [m.seq for m in clock.messages if m.get_type() == 'MISSION_ITEM_REACHED']
    assert reached == [0, 1, 0, 1, 2, 3]
    vehicle = clock.server.vehicles[1]
    assert not vehicle.autopilot.armed
    assert vehicle.autopilot.body.y == pytest.approx(11.1, abs=0.3)
    assert 'Mission finished' in clock.texts


@pytest.mark.parametrize(
    ('action', 'then'), [(3, FlightMode.RETURN), (4, FlightMode.LAND), (5, FlightMode.HOLD)]
)
def test_what_follows_when_set_points_stop(
    server: SimServer, clock: Clock, station: Any, action: int, then: FlightMode
) -> None:
    take_off(clock)
    set_whole(server, 'offboard_loss_action', action)
    for _ in range(3):
        station.send(
            mavlink.MAVLink_set_position_target_local_ned_message(
                0, 1, 1, 1, 0x9C0, 20.0, 0, -10.0, 0, 0, 0, 0, 0, 0, 0.0, 0
            )
        )
        clock.pass_s(0.02)
    assert station.result(SET_MODE, 1, 6, 0) == ACCEPTED
    assert mode(clock) is FlightMode.OFFBOARD
    clock.pass_s(1.5)
    assert mode(clock) is then
    assert any('offboard set-points lost' in t for t in clock.texts)


def test_what_follows_when_the_station_is_silent(
    server: SimServer, clock: Clock, station: Any
) -> None:
    set_whole(server, 'data_link_loss_action', 2)
    set_whole(server, 'data_link_loss_s', 5)
    take_off(clock)
    clock.pass_s(6.0)
    assert mode(clock) is FlightMode.HOLD
    clock.heartbeats = False
    clock.pass_s(6.0)
    assert mode(clock) in {FlightMode.RETURN, FlightMode.LAND}
    # Whoever comes back may take over; the failsafe does not fire again meanwhile.
    clock.heartbeats = True
    assert station.result(SET_MODE, 1, 4, 3) == ACCEPTED
    clock.pass_s(1.0)
    assert mode(clock) is FlightMode.HOLD


def test_sticks_fly_and_their_loss_holds(clock: Clock, station: Any) -> None:
    take_off(clock)
    assert station.result(SET_MODE, 1, 3, 0) == REJECTED
    ahead = mavlink.MAVLink_manual_control_message(1, 500, 0, 500, 0, 0)
    station.send(ahead)
    assert station.result(SET_MODE, 1, 3, 0) == ACCEPTED
    for _ in range(40):
        station.send(ahead)
        clock.pass_s(0.1)
    body = clock.server.vehicles[1].autopilot.body
    # It looks east; half a stick is half of MPC_VEL_MANUAL.
    assert (body.vx, body.vy) == pytest.approx((5.0, 0.0), abs=0.3)
    assert body.z == pytest.approx(10.0, abs=0.5)
    clock.pass_s(2.0)
    assert mode(clock) is FlightMode.HOLD
    assert any('sticks lost' in t for t in clock.texts)


def test_arming_says_every_reason(server: SimServer, clock: Clock, station: Any) -> None:
    server.vehicles[1].pilot.battery.share = 0.06
    far = item(0, CIRCLE_IN, north=5 * STEP, p1=20.0, type=1)
    assert upload(station, far, kind=1) == 0
    answers = station.command(ARM, 1)
    assert answers[0].result == REJECTED
    assert 'battery is critical' in answers[1].text
    assert station.result(CHECKS) == ACCEPTED
    clock.pass_s(0.1)
    assert 'Arming check: battery is critical' in clock.texts
    assert 'Arming check: outside the geofence' in clock.texts
    assert station.result(RETURN) == REJECTED


def test_a_mission_across_the_fence_is_refused(clock: Clock, station: Any) -> None:
    corners = [(-1, -1), (-1, 1), (1, 1)]
    for bad in ([item(0, POLYGON_IN, p1=3.0, type=1)], [item(0, WAYPOINT, type=1)]):
        assert upload(station, *bad, kind=1) != 0
    fence = [
        mavlink.MAVLink_mission_item_int_message(
            1, 1, i, 0, POLYGON_IN, 0, 1, 3.0, 0, 0, 0,
            LATITUDE + north * 5 * STEP, LONGITUDE + east * 5 * STEP, 0.0, 1,
        )
        for i, (north, east) in enumerate(corners)
    ]  # fmt: skip
    assert upload(station, *fence, kind=1) == 0
    # The triangle reaches 5 steps north only in the east.
    assert upload(station, item(0, north=3 * STEP)) == mavlink.MAV_MISSION_DENIED
    assert upload(station, item(0, north=-3 * STEP)) == 0
    (answer,) = [
        m
        for m in station.send(mavlink.MAVLink_mission_request_int_message(1, 1, 0, 1))
        if m.get_type() == 'MISSION_ITEM_INT'
    ]
    assert (answer.command, answer.x) == (POLYGON_IN, LATITUDE - 5 * STEP)


def test_the_wind_of_the_settings_blows(clock: Clock, station: Any) -> None:
    set_parameter(station, b'SIH_WIND_E', 4.0)
    take_off(clock)
    clock.pass_s(2.0)
    own = [m for m in clock.messages if m.get_srcSystem() == 1]
    told = next(m for m in reversed(own) if m.get_type() == 'WIND_COV')
    assert (told.wind_x, told.wind_y) == pytest.approx((0.0, 4.0))
    # It leans against it.
    assert clock.server.vehicles[1].autopilot.body.qy < -0.01


def test_in_lockstep_nobody_flies_but_its_owner(server: SimServer, station: Any) -> None:
    assert upload(station, item(0)) == 0
    answers = station.command(CMD_LOCKSTEP, 1, 7, 50_000, 1)
    assert answers[0].result == ACCEPTED
    assert station.result(START) == REJECTED
    assert station.result(RETURN) == REJECTED
    assert upload(station, item(0)) == mavlink.MAV_MISSION_DENIED
    assert server.vehicles[1].pilot.mission.items == ()
