# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Modes, arming and landing detection."""

from __future__ import annotations

import pytest

from aurora_uav_sim.autopilot import Autopilot, FlightMode, Result, Target
from aurora_uav_sim.wind import wind_stream

H = 0.01
STATE = (
    *('x', 'y', 'z', 'vx', 'vy', 'vz', 'qw', 'qx', 'qy', 'qz', 'p', 'q', 'r'),
    *('f0', 'f1', 'f2', 'f3', 'on_ground'),
)


def run(autopilot: Autopilot, duration_s: float) -> None:
    for _ in range(round(duration_s / H)):
        autopilot.step(H)


def target(x: float = 0.0, y: float = 0.0, z: float = 20.0) -> Target:
    return Target((x, y), z, (0.0, 0.0), 0.0, (0.0, 1.0))


def stream(autopilot: Autopilot, duration_s: float, wanted: Target) -> None:
    for _ in range(round(duration_s / 0.05)):
        autopilot.set_target(wanted)
        run(autopilot, 0.05)


@pytest.fixture
def flying() -> Autopilot:
    autopilot = Autopilot()
    assert autopilot.arm().result is Result.ACCEPTED
    assert autopilot.takeoff(20.0).result is Result.ACCEPTED
    run(autopilot, 15.0)
    return autopilot


def test_starts_disarmed_and_landed() -> None:
    autopilot = Autopilot()
    run(autopilot, 5.0)
    assert (autopilot.armed, autopilot.landed) == (False, True)
    assert autopilot.body.z == 0.0


def test_takeoff_climbs_within_the_limits_and_holds(flying: Autopilot) -> None:
    assert flying.mode is FlightMode.HOLD
    assert not flying.landed
    assert flying.body.z == pytest.approx(20.0, abs=0.2)
    run(flying, 10.0)
    assert flying.body.z == pytest.approx(20.0, abs=0.05)


def test_takeoff_and_landing_keep_the_contract_speeds() -> None:
    autopilot = Autopilot()
    autopilot.arm()
    autopilot.takeoff(60.0)
    fastest = 0.0
    for _ in range(3000):
        autopilot.step(H)
        fastest = max(fastest, autopilot.body.vz)
    # No overshoot past 5 m/s up, 3 m/s down, nor past the height.
    assert 3.5 < fastest < 5.0
    autopilot.land()
    slowest, touchdown = 0.0, 0.0
    while autopilot.armed:
        before = autopilot.body.vz
        autopilot.step(H)
        slowest = min(slowest, autopilot.body.vz)
        if autopilot.body.on_ground and touchdown == 0.0:
            touchdown = before
    assert -3.0 < slowest < -2.0
    assert -1.0 < touchdown < -0.3
    assert autopilot.landed
    assert autopilot.body.z == 0.0


def test_takeoff_before_arming_waits_for_it() -> None:
    """A ground station sends take-off first and arms then."""
    autopilot = Autopilot()
    assert autopilot.takeoff(10.0).result is Result.ACCEPTED
    run(autopilot, 2.0)
    assert autopilot.body.z == 0.0
    autopilot.arm()
    run(autopilot, 10.0)
    assert autopilot.body.z == pytest.approx(10.0, abs=0.3)


def test_repeated_takeoff_changes_nothing() -> None:
    once, often = Autopilot(), Autopilot()
    for autopilot in (once, often):
        autopilot.arm()
        autopilot.takeoff(10.0)
    for _ in range(300):
        once.step(H)
        often.takeoff(10.0)
        often.step(H)
    assert once.body.z == often.body.z


@pytest.mark.parametrize('height', [0.0, -3.0, float('nan'), float('inf')])
def test_takeoff_to_nowhere_is_denied(height: float) -> None:
    autopilot = Autopilot()
    autopilot.arm()
    assert autopilot.takeoff(height).result is Result.DENIED
    assert autopilot.mode is FlightMode.HOLD


def test_arming_is_refused_in_the_air_and_lying_on_the_side(flying: Autopilot) -> None:
    flying.disarm(force=True)
    assert flying.arm().result is Result.TEMPORARILY_REJECTED
    fallen = Autopilot()
    fallen.body.qw, fallen.body.qx = 0.9, 0.43588989435
    assert fallen.arm().result is Result.TEMPORARILY_REJECTED


def test_disarming_in_the_air_needs_force(flying: Autopilot) -> None:
    assert flying.disarm().result is Result.TEMPORARILY_REJECTED
    assert flying.armed
    assert flying.disarm(force=True).result is Result.ACCEPTED
    run(flying, 5.0)
    assert flying.landed


def test_disarms_itself_when_nothing_happens() -> None:
    autopilot = Autopilot()
    autopilot.arm()
    run(autopilot, 9.5)
    assert autopilot.armed
    run(autopilot, 1.0)
    assert not autopilot.armed


def test_land_on_the_ground_disarms_soon() -> None:
    autopilot = Autopilot()
    autopilot.arm()
    autopilot.land()
    run(autopilot, 3.0)
    assert not autopilot.armed
    assert autopilot.land().result is Result.ACCEPTED
    assert autopilot.mode is FlightMode.HOLD


def test_flies_again_after_landing(flying: Autopilot) -> None:
    flying.land()
    run(flying, 25.0)
    assert not flying.armed
    assert flying.arm().result is Result.ACCEPTED
    flying.takeoff(5.0)
    run(flying, 8.0)
    assert flying.body.z == pytest.approx(5.0, abs=0.3)


def test_offboard_needs_a_stream(flying: Autopilot) -> None:
    assert flying.offboard().result is Result.TEMPORARILY_REJECTED
    assert flying.mode is FlightMode.HOLD
    flying.set_target(target())
    run(flying, 1.5)
    # The stream has dried up.
    assert flying.offboard().result is Result.TEMPORARILY_REJECTED
    flying.set_target(target())
    assert flying.offboard().result is Result.ACCEPTED


def test_offboard_follows(flying: Autopilot) -> None:
    flying.set_target(target())
    flying.offboard()
    stream(flying, 15.0, target(30.0, -20.0, 25.0))
    body = flying.body
    assert (body.x, body.y, body.z) == pytest.approx((30.0, -20.0, 25.0), abs=0.1)


def test_smooth_motion_is_followed_closely(flying: Autopilot) -> None:
    """Speeding up to 14 m/s and stopping at 3 m/s^2, climbing meanwhile."""
    body = flying.body
    x, z, v, worst, fastest = 0.0, 20.0, 0.0, 0.0, 0.0
    flying.set_target(target())
    flying.offboard()
    for k in range(500):
        acceleration = 3.0 if v < 14.0 and k < 200 else -3.0 if v > 0.0 and k >= 200 else 0.0
        climb = 1.0 if k < 200 else 0.0
        v = min(max(v + acceleration * 0.05, 0.0), 14.0)
        x, z = x + v * 0.05, z + climb * 0.05
        flying.set_target(Target((x, 0.0), z, (v, 0.0), climb, (0.0, 1.0)))
        run(flying, 0.05)
        worst = max(worst, abs(body.x - x))
        fastest = max(fastest, body.vx)
    assert worst < 0.8
    assert fastest < 14.5
    assert (body.x, body.z) == pytest.approx((x, z), abs=0.1)


def test_a_jump_of_the_set_point_is_no_acceleration(flying: Autopilot) -> None:
    flying.set_target(target())
    flying.offboard()
    run(flying, 0.05)
    flying.set_target(Target((0.0, 0.0), 20.0, (8.0, 0.0), 0.0, (0.0, 1.0)))
    assert flying._set_point.ax == 0.0
    run(flying, 0.05)
    flying.set_target(Target((0.4, 0.0), 20.0, (8.1, 0.0), 0.0, (0.0, 1.0)))
    assert flying._set_point.ax == pytest.approx(2.0)
    flying.hold()
    assert flying._set_point.ax == 0.0


def test_losing_the_stream_brakes_and_holds(flying: Autopilot) -> None:
    flying.set_target(target())
    flying.offboard()
    stream(flying, 3.0, target(200.0))
    speed = flying.body.vx
    assert speed > 5.0
    run(flying, 1.1)
    assert flying.mode is FlightMode.HOLD
    run(flying, 15.0)
    x = flying.body.x
    run(flying, 3.0)
    assert flying.body.x == pytest.approx(x, abs=0.05)
    assert flying.armed


def test_arming_in_offboard_lifts_off_and_lands_by_set_point() -> None:
    autopilot = Autopilot()
    autopilot.set_target(target(z=3.0))
    autopilot.offboard()
    assert autopilot.arm().result is Result.ACCEPTED
    stream(autopilot, 5.0, target(z=3.0))
    assert autopilot.body.z == pytest.approx(3.0, abs=0.1)
    stream(autopilot, 10.0, target(z=-1.0))
    assert autopilot.landed
    assert not autopilot.armed


def test_arming_in_offboard_without_stream_is_refused() -> None:
    autopilot = Autopilot()
    autopilot.set_target(target())
    autopilot.offboard()
    run(autopilot, 2.0)
    assert autopilot.arm().result is Result.TEMPORARILY_REJECTED


def test_velocity_alone_can_be_commanded(flying: Autopilot) -> None:
    flying.set_target(Target(None, 20.0, (3.0, 0.0), None, None))
    flying.offboard()
    stream(flying, 5.0, Target(None, 20.0, (3.0, 0.0), None, None))
    assert flying.body.vx == pytest.approx(3.0, abs=0.05)
    assert flying.body.z == pytest.approx(20.0, abs=0.1)


def test_reposition_flies_there_at_cruise_speed(flying: Autopilot) -> None:
    assert flying.reposition((40.0, 0.0), 15.0, None, None).result is Result.ACCEPTED
    fastest = 0.0
    for _ in range(2000):
        flying.step(H)
        fastest = max(fastest, flying.body.vx)
    assert flying.settings.cruise_mps * 0.95 < fastest < flying.settings.cruise_mps * 1.05
    assert (flying.body.x, flying.body.z) == pytest.approx((40.0, 15.0), abs=0.1)


def test_reposition_on_the_ground_is_refused() -> None:
    autopilot = Autopilot()
    autopilot.arm()
    answer = autopilot.reposition((10.0, 0.0), None, None, None)
    assert answer.result is Result.TEMPORARILY_REJECTED


def test_landing_at_speed_brakes_first(flying: Autopilot) -> None:
    flying.set_target(target())
    flying.offboard()
    stream(flying, 4.0, target(200.0))
    speed, x = flying.body.vx, flying.body.x
    flying.land()
    run(flying, 25.0)
    assert flying.landed
    assert flying.body.x - x < speed * speed / 4.0 + 5.0


def test_reset_forgets_everything(flying: Autopilot) -> None:
    flying.settings.cruise_mps = 9.0
    flying.reset()
    fresh = Autopilot()
    assert (flying.armed, flying.landed, flying.mode) == (False, True, FlightMode.HOLD)
    assert (flying.body.z, flying.time_s) == (0.0, 0.0)
    assert flying.settings == fresh.settings
    for autopilot in (flying, fresh):
        autopilot.arm()
        autopilot.takeoff(7.0)
        run(autopilot, 3.0)
    assert flying.body.z == fresh.body.z


def test_custom_modes_are_px4() -> None:
    assert FlightMode.OFFBOARD.custom_mode == 6 << 16
    assert FlightMode.HOLD.custom_mode == 4 << 16 | 3 << 24
    assert FlightMode.TAKEOFF.custom_mode == 4 << 16 | 2 << 24
    assert FlightMode.LAND.custom_mode == 4 << 16 | 6 << 24


def told(autopilot: Autopilot, tick: int) -> None:
    """Fly up, after set-points, into the ground, up again, without set-points, and land."""
    if tick == 1:
        autopilot.arm()
        autopilot.takeoff(8.0)
    if 200 <= tick < 500:
        down = 280 <= tick < 360
        autopilot.set_target(target(0.02 * tick, 3.0, -1.0 if down else 9.0))
    if tick == 201:
        autopilot.offboard()
    if tick == 700:
        autopilot.land()


@pytest.mark.parametrize('gust_mps', [0.0, 3.0])
def test_several_steps_at_once_are_as_many_single_ones(gust_mps: float) -> None:
    both = Autopilot(), Autopilot()
    for autopilot in both:
        autopilot.wind.set(2.0, -1.0, 0.0, gust_mps)
        autopilot.wind.seed(wind_stream(7, 1))
    seen = set()
    for tick in range(1100):
        for autopilot in both:
            told(autopilot, tick)
        both[0].run(5, H)
        for _ in range(5):
            both[1].step(H)
        states = [
            repr([getattr(a.body, n) for n in STATE] + [a.mode, a.armed, a.landed, a.time_s])
            for a in both
        ]
        assert states[0] == states[1]
        seen.add((both[0].mode, both[0].armed, both[0].landed))
        assert both[0].offboard_lost == both[1].offboard_lost
    assert both[0].offboard_lost
    assert {mode for mode, armed, landed in seen if armed and not landed} == {
        FlightMode.TAKEOFF, FlightMode.HOLD, FlightMode.OFFBOARD, FlightMode.LAND
    }  # fmt: skip
    assert (FlightMode.OFFBOARD, True, True) in seen  # it stood on the ground in between
    assert not both[0].armed  # and has landed
