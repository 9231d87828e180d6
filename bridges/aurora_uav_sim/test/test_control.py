# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The controlled vehicle: does it fly what the contract may ask, with room to spare?"""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_uav_sim.arithmetic import sin_cos
from aurora_uav_sim.control import Controller, SetPoint, braking_speed
from aurora_uav_sim.multirotor import Multirotor
from aurora_uav_sim.parameters import installed_model
from aurora_uav_sim.wind import Wind, wind_stream

MODEL = installed_model()

H = 0.01
# Contract limits and the room that is asked above them.
ROOM = 1.15
SPEED_MPS, CLIMB_MPS, DESCENT_MPS, ALTITUDE_M = 18.0, 5.0, 3.0, 120.0


class Flight:
    """A vehicle in the air with its controller; `fly` runs it."""

    def __init__(self, height_m: float = 30.0) -> None:
        self.limits = MODEL.control
        self.body = Multirotor(MODEL.body)
        self.controller = Controller(self.body, self.limits)
        self.target = SetPoint(self.limits)
        self.wind = Wind()
        self.time_s = 0.0
        self.body.z = self.target.z = height_m
        self.body.on_ground = False
        self.fly(5.0)

    def fly(
        self,
        duration_s: float,
        lead: Callable[[float], None] | None = None,
        watch: Callable[[float], None] | None = None,
    ) -> None:
        body, wind = self.body, self.wind
        start_s = self.time_s
        for i in range(round(duration_s / H)):
            if lead is not None and i % 5 == 0:
                # Set-points come every 0.05 s, each for the end of its tick.
                lead(i * H + 0.05)
            motors = self.controller.update(H, self.target)
            wind.step(H)
            body.step(H, motors, wind.x, wind.y, wind.z)
            self.time_s = start_s + (i + 1) * H
            if watch is not None:
                watch((i + 1) * H)


def test_envelope_exceeds_the_contract_by_15_percent() -> None:
    flight = Flight()
    body = flight.body
    flight.target.x = 3000.0
    flight.fly(25.0)
    assert math.hypot(body.vx, body.vy) >= SPEED_MPS * ROOM
    assert abs(body.z - 30.0) < 1.0

    flight = Flight()
    body = flight.body
    flight.target.z = 500.0
    flight.fly(10.0)
    assert body.vz >= CLIMB_MPS * ROOM
    flight.fly(40.0)
    assert body.z >= ALTITUDE_M * ROOM
    flight.target.z = 0.0
    flight.fly(10.0)
    assert -body.vz >= DESCENT_MPS * ROOM


def test_envelope_while_climbing_fast_and_turning() -> None:
    """The limits hold together: full speed and full climb at once."""
    flight = Flight()
    body, target = flight.body, flight.target
    target.follow_xy = target.follow_z = False
    target.vx, target.vz = -SPEED_MPS * ROOM, CLIMB_MPS * ROOM
    target.sin_yaw, target.cos_yaw = sin_cos(2.0)
    flight.fly(20.0)
    assert -body.vx >= SPEED_MPS * ROOM * 0.995
    assert body.vz >= CLIMB_MPS * ROOM * 0.995


def test_holds_the_limit_speed_against_the_strongest_default_wind() -> None:
    flight = Flight()
    flight.wind.set(-6.0, 0.0, 0.0, 4.0)
    flight.wind.seed(wind_stream(4, 1))
    flight.target.follow_xy = False
    flight.target.vx = SPEED_MPS
    speeds: list[float] = []
    flight.fly(60.0, watch=lambda t: speeds.append(flight.body.vx) if t > 10.0 else None)
    assert min(speeds) > SPEED_MPS - 1.0
    assert abs(flight.body.z - 30.0) < 1.0


@pytest.mark.parametrize(('mean', 'gust', 'allowed'), [(0.0, 0.0, 2.0), (6.0, 4.0, 3.0)])
def test_hover_drift(mean: float, gust: float, allowed: float) -> None:
    flight = Flight()
    flight.wind.set(mean * 0.6, mean * 0.8, 0.0, gust)
    flight.wind.seed(wind_stream(1, 1))
    body = flight.body
    drift: list[float] = []
    flight.fly(
        60.0, watch=lambda _: drift.append(math.dist((body.x, body.y, body.z), (0, 0, 30.0)))
    )
    # The vehicle has room here too: a fifth of what is allowed.
    assert max(drift) < allowed / 5.0


def test_tracks_a_target_at_14_mps() -> None:
    flight = Flight()
    target, body = flight.target, flight.body

    def lead(t: float) -> None:
        target.x, target.vx = 14.0 * t, 14.0

    errors: list[float] = []
    flight.fly(
        30.0,
        lead,
        lambda t: errors.append(abs(body.x - 14.0 * t)) if t > 15.0 else None,
    )
    # Half of the 2 m that tracking may need.
    assert max(errors) < 1.0


def test_corner_at_8_mps_passes_the_waypoint() -> None:
    flight = Flight()
    target, body = flight.target, flight.body

    def lead(t: float) -> None:
        s = 8.0 * t - 80.0
        target.x, target.y = (80.0 + s, 0.0) if s < 0.0 else (80.0, s)
        target.vx, target.vy = (8.0, 0.0) if s < 0.0 else (0.0, 8.0)

    nearest, heights = [1e9], []

    def watch(_: float) -> None:
        nearest[0] = min(nearest[0], math.hypot(body.x - 80.0, body.y))
        heights.append(abs(body.z - 30.0))

    flight.fly(20.0, lead, watch)
    assert nearest[0] < 3.0
    assert max(heights) < 1.0
    # Back on the line after the overshoot.
    assert abs(body.x - 80.0) < 0.3


def test_large_steps_do_not_overshoot() -> None:
    flight = Flight()
    flight.target.x, flight.target.z = 200.0, 60.0
    top = [0.0, 0.0]

    def watch(_: float) -> None:
        top[0] = max(top[0], flight.body.x)
        top[1] = max(top[1], flight.body.z)

    flight.fly(40.0, watch=watch)
    assert top[0] < 201.0
    assert top[1] < 60.3
    assert flight.body.x == pytest.approx(200.0, abs=0.05)


@pytest.mark.parametrize('yaw_deg', [0, 60, 179, -179, -90, 135])
def test_yaw_is_reached_from_east(yaw_deg: int) -> None:
    flight = Flight()
    yaw_rad = math.radians(yaw_deg)
    flight.target.sin_yaw, flight.target.cos_yaw = sin_cos(yaw_rad)
    flight.fly(6.0)
    body = flight.body
    gap = 2.0 * math.atan2(body.qz, body.qw) - yaw_rad
    assert math.sin(gap) == pytest.approx(0.0, abs=1e-2)
    assert math.cos(gap) > 0.99
    assert math.dist((body.x, body.y, body.z), (0.0, 0.0, 30.0)) < 0.2


def test_tilt_stays_within_its_limit() -> None:
    flight = Flight()
    steepest = [1.0]

    def watch(_: float) -> None:
        body = flight.body
        steepest[0] = min(steepest[0], 1.0 - 2.0 * (body.qx**2 + body.qy**2))

    flight.target.x, flight.target.y = 300.0, -300.0
    flight.fly(5.0, watch=watch)
    flight.target.x = -300.0
    flight.fly(10.0, watch=watch)
    # 45 degrees and a little for the overshoot of the attitude loop.
    assert math.degrees(math.acos(steepest[0])) < 50.0


def test_recovers_upside_down() -> None:
    flight = Flight(height_m=100.0)
    body = flight.body
    body.qw, body.qx, body.qy, body.qz = 0.05, math.sqrt(1.0 - 0.05**2), 0.0, 0.0
    body.p = 3.0
    flight.fly(10.0)
    assert body.z == pytest.approx(100.0, abs=1.0)
    assert 1.0 - 2.0 * (body.qx**2 + body.qy**2) > 0.99


@given(st.floats(-5.0, 40.0), st.floats(-20.0, 20.0), st.floats(-20.0, 20.0), st.floats(-5.0, 5.0))
def test_motors_stay_within_their_limits(
    thrust: float, torque_x: float, torque_y: float, torque_z: float
) -> None:
    body = MODEL.body
    controller = Controller(Multirotor(body), MODEL.control)
    motors = controller._mix(thrust, torque_x, torque_y, torque_z)
    low = MODEL.control.thrust_min_fraction * body.motor_max_thrust_n
    assert all(low - 1e-9 <= f <= body.motor_max_thrust_n + 1e-9 for f in motors)


def test_motors_make_the_torques_asked() -> None:
    body = MODEL.body
    f0, f1, f2, f3 = Controller(Multirotor(body), MODEL.control)._mix(14.7, 0.3, -0.2, 0.05)
    assert f0 + f1 + f2 + f3 == pytest.approx(14.7)
    assert body.motor_offset_m * (f1 + f2 - f0 - f3) == pytest.approx(0.3)
    assert body.motor_offset_m * (f1 + f3 - f0 - f2) == pytest.approx(-0.2)
    assert body.yaw_moment_m * (f2 + f3 - f0 - f1) == pytest.approx(0.05)


@given(st.floats(0.0, 1000.0))
def test_braking_speed_can_stop(distance_m: float) -> None:
    speed = braking_speed(distance_m, 1.3, 4.0)
    assert speed * speed / (2.0 * 4.0) <= distance_m + 1e-9
