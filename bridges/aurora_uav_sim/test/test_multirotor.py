# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The rigid body against closed-form mechanics."""

from __future__ import annotations

import dataclasses
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_uav_sim.multirotor import Multirotor
from aurora_uav_sim.parameters import GRAVITY_MPS2, MultirotorParameters, installed_model

PARAMETERS = installed_model().body
NO_DRAG = dataclasses.replace(PARAMETERS, drag_linear_nspm=0.0, drag_quadratic_ns2pm2=0.0)
H = 0.01
OFF = (0.0, 0.0, 0.0, 0.0)


def flying(parameters: MultirotorParameters = NO_DRAG) -> Multirotor:
    body = Multirotor(parameters)
    body.z = 1000.0
    body.on_ground = False
    return body


def test_free_fall_is_exact_parabola() -> None:
    body = flying()
    body.vx = 3.0
    for _ in range(200):
        body.step(H, OFF, 0.0, 0.0, 0.0)
    assert body.z == pytest.approx(1000.0 - 0.5 * GRAVITY_MPS2 * 2.0**2, abs=1e-9)
    assert body.x == pytest.approx(6.0, abs=1e-9)
    assert body.vz == pytest.approx(-2.0 * GRAVITY_MPS2, abs=1e-9)


def angular_momentum_enu(body: Multirotor) -> tuple[float, float, float]:
    p = PARAMETERS
    a, b, c = body.p * p.inertia_roll_kgm2, body.q * 0.05, body.r * p.inertia_yaw_kgm2
    w, x, y, z = body.qw, body.qx, body.qy, body.qz
    return (
        (1 - 2 * (y * y + z * z)) * a + 2 * (x * y - w * z) * b + 2 * (x * z + w * y) * c,
        2 * (x * y + w * z) * a + (1 - 2 * (x * x + z * z)) * b + 2 * (y * z - w * x) * c,
        2 * (x * z - w * y) * a + 2 * (y * z + w * x) * b + (1 - 2 * (x * x + y * y)) * c,
    )


def test_torque_free_rotation_keeps_momentum_and_energy() -> None:
    """Three different moments of inertia, so that the body tumbles."""
    body = flying(dataclasses.replace(NO_DRAG, inertia_pitch_kgm2=0.05))
    body.p, body.q, body.r = 2.0, 0.1, 1.0

    def energy() -> float:
        return 0.029125 * body.p**2 + 0.05 * body.q**2 + 0.055225 * body.r**2

    momentum, before = angular_momentum_enu(body), energy()
    for _ in range(500):
        body.step(H, OFF, 0.0, 0.0, 0.0)
    size = math.sqrt(sum(m * m for m in momentum))
    assert energy() == pytest.approx(before, rel=2e-3)
    assert angular_momentum_enu(body) == pytest.approx(momentum, abs=5e-3 * size)
    norm = body.qw**2 + body.qx**2 + body.qy**2 + body.qz**2
    assert norm == pytest.approx(1.0, abs=1e-12)


def test_hover_thrust_carries_the_weight() -> None:
    body = flying(PARAMETERS)
    hover = PARAMETERS.mass_kg * GRAVITY_MPS2 / 4.0
    body.f0 = body.f1 = body.f2 = body.f3 = hover
    for _ in range(500):
        body.step(H, (hover, hover, hover, hover), 0.0, 0.0, 0.0)
    assert body.vz == pytest.approx(0.0, abs=1e-9)
    assert (body.p, body.q, body.r) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ('motors', 'axis', 'sign'),
    [
        # Left motors stronger: roll to the right, which is positive about forward.
        ((1.0, 1.2, 1.2, 1.0), 'p', 1),
        # Rear motors stronger: nose down, which is positive about left.
        ((1.0, 1.2, 1.0, 1.2), 'q', 1),
        # Clockwise motors stronger: the body turns counter-clockwise.
        ((1.0, 1.0, 1.2, 1.2), 'r', 1),
    ],
)
def test_each_pair_of_motors_turns_its_axis(
    motors: tuple[float, float, float, float], axis: str, sign: int
) -> None:
    body = flying()
    body.step(H, motors, 0.0, 0.0, 0.0)
    rates = {'p': body.p, 'q': body.q, 'r': body.r}
    assert rates.pop(axis) * sign > 1e-4
    assert list(rates.values()) == pytest.approx([0.0, 0.0], abs=1e-12)


def test_terminal_velocity() -> None:
    """Weight = k1 v + k2 v^2."""
    body = flying(PARAMETERS)
    for _ in range(6000):
        body.z = 1000.0
        body.step(H, OFF, 0.0, 0.0, 0.0)
    k1, k2 = PARAMETERS.drag_linear_nspm, PARAMETERS.drag_quadratic_ns2pm2
    weight = PARAMETERS.mass_kg * GRAVITY_MPS2
    expected = (-k1 + math.sqrt(k1 * k1 + 4.0 * k2 * weight)) / (2.0 * k2)
    assert -body.vz == pytest.approx(expected, rel=1e-6)


def test_wind_carries_a_falling_body() -> None:
    body = flying(PARAMETERS)
    for _ in range(6000):
        body.z = 1000.0
        body.step(H, OFF, 4.0, -3.0, 0.0)
    assert (body.vx, body.vy) == pytest.approx((4.0, -3.0), abs=1e-3)


def test_motor_lag_is_first_order() -> None:
    body = flying()
    command = (5.0, 5.0, 5.0, 5.0)
    for _ in range(2000):
        body.step(1e-5, command, 0.0, 0.0, 0.0)
    # One time constant: 63 %.
    assert body.f0 == pytest.approx(5.0 * (1.0 - math.exp(-1.0)), rel=1e-3)


def test_stays_on_the_ground_without_thrust() -> None:
    body = Multirotor(PARAMETERS)
    for _ in range(100):
        body.step(H, (2.0, 2.0, 2.0, 2.0), 8.0, 0.0, 0.0)
    assert (body.x, body.y, body.z) == (0.0, 0.0, 0.0)
    assert body.on_ground


def test_falls_onto_the_ground_and_comes_to_rest_level() -> None:
    body = flying(PARAMETERS)
    body.z, body.vx = 0.5, 2.0
    body.qw, body.qx = math.cos(0.1), math.sin(0.1)
    for _ in range(200):
        body.step(H, OFF, 0.0, 0.0, 0.0)
    assert body.on_ground
    assert (body.z, body.vx, body.vz, body.p) == (0.0, 0.0, 0.0, 0.0)
    assert body.qx == pytest.approx(0.0, abs=1e-6)
    assert body.x > 0.5


motor = st.floats(0.0, PARAMETERS.motor_max_thrust_n)


@settings(max_examples=50, deadline=None)
@given(st.lists(st.tuples(motor, motor, motor, motor), min_size=1, max_size=50))
def test_any_thrust_keeps_the_state_finite(
    commands: list[tuple[float, float, float, float]],
) -> None:
    body = Multirotor(PARAMETERS)
    for command in commands:
        for _ in range(5):
            body.step(H, command, 5.0, 5.0, 1.0)
    state = (body.x, body.y, body.z, body.vx, body.vy, body.vz, body.p, body.q, body.r)
    assert all(math.isfinite(value) for value in state)
    assert body.z >= 0.0
    norm = body.qw**2 + body.qx**2 + body.qy**2 + body.qz**2
    assert norm == pytest.approx(1.0, abs=1e-9)
