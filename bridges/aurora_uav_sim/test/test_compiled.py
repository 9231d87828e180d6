# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The compiled physics step is the plain one to the last bit."""

from __future__ import annotations

import dataclasses
import importlib.util
import os
import random
from typing import Any

import pytest

from aurora_uav_sim import compiled, control, multirotor, wire
from aurora_uav_sim.native_code import PLAIN_VARIABLE, twin
from aurora_uav_sim.parameters import (
    ControlParameters,
    MultirotorParameters,
    installed_model,
)

MODEL = installed_model()

needs_compiled = pytest.mark.skipif(
    not compiled.IS_COMPILED, reason='the physics step is not compiled here'
)
STATE = (
    *('x', 'y', 'z', 'vx', 'vy', 'vz', 'qw', 'qx', 'qy', 'qz', 'p', 'q', 'r'),
    *('f0', 'f1', 'f2', 'f3', 'on_ground'),
)
INTEGRALS = ('_integral_x', '_integral_y', '_integral_z')
POINT = (
    *('x', 'y', 'z', 'vx', 'vy', 'vz', 'ax', 'ay', 'az', 'speed_limit', 'climb_limit'),
    *('descent_limit', 'cos_yaw', 'sin_yaw', 'follow_xy', 'follow_z'),
)


class Pair:
    """The same vehicle twice: plain and compiled."""

    def __init__(self, body: MultirotorParameters, limits: ControlParameters) -> None:
        self.bodies: list[Any] = [multirotor.Multirotor(body), compiled.Multirotor(body)]
        self.points: list[Any] = [control.SetPoint(limits), compiled.SetPoint(limits)]
        self.controllers: list[Any] = [
            control.Controller(self.bodies[0], limits),
            compiled.Controller(self.bodies[1], limits),
        ]

    def check(self) -> None:
        for names, (plain, fast) in (
            (STATE, self.bodies),
            (INTEGRALS, self.controllers),
            (POINT, self.points),
        ):
            found = {name: getattr(fast, name) for name in names}
            # repr tells -0.0 from 0.0 and every double from its neighbour.
            assert repr(found) == repr({name: getattr(plain, name) for name in names})


def throw(pair: Pair, chance: random.Random) -> None:
    """Put both into the same state, often beyond what a flight reaches."""
    wide = chance.choice((1e-3, 1.0, 30.0))
    state = {name: chance.gauss(0.0, wide) for name in STATE[:-1]}
    length = sum(state[name] ** 2 for name in ('qw', 'qx', 'qy', 'qz')) ** 0.5
    for name in ('qw', 'qx', 'qy', 'qz'):
        state[name] /= length
    state['z'] = abs(state['z']) if chance.random() < 0.8 else 0.0
    point = {name: chance.gauss(0.0, wide) for name in POINT[:9]}
    point |= {name: abs(chance.gauss(5.0, 5.0)) for name in POINT[9:12]}
    point |= {'cos_yaw': chance.uniform(-1.0, 1.0), 'sin_yaw': chance.uniform(-1.0, 1.0)}
    grounded = chance.random() < 0.2
    flags = {name: chance.random() < 0.8 for name in ('follow_xy', 'follow_z')}
    integrals = {name: chance.gauss(0.0, 3.0) for name in INTEGRALS}
    for number in range(2):
        for target, values in (
            (pair.bodies[number], {**state, 'on_ground': grounded}),
            (pair.points[number], {**point, **flags}),
            (pair.controllers[number], integrals),
        ):
            for name, value in values.items():
                setattr(target, name, value)


@needs_compiled
@pytest.mark.parametrize('seed', range(4))
def test_every_step_from_any_state_has_the_same_bits(seed: int) -> None:
    chance = random.Random(seed)
    body = dataclasses.replace(
        MODEL.body, inertia_roll_kgm2=0.03, mass_kg=chance.uniform(1.0, 2.0)
    )
    limits = dataclasses.replace(MODEL.control, tan_tilt_limit=chance.uniform(0.3, 1.5))
    pair = Pair(body, limits)
    for _ in range(1000):
        throw(pair, chance)
        for _ in range(3):
            h = chance.choice((0.01, 0.004, 0.0077))
            wind = [chance.gauss(0.0, 5.0) for _ in range(3)]
            motors = [
                controller.update(h, point)
                for controller, point in zip(pair.controllers, pair.points, strict=True)
            ]
            assert repr(motors[0]) == repr(motors[1])
            for vehicle in pair.bodies:
                vehicle.step(h, motors[0], *wind)
            pair.check()


@needs_compiled
@pytest.mark.parametrize('seed', range(4))
def test_a_flight_of_several_steps_has_the_same_bits_and_ends_on_the_ground(seed: int) -> None:
    chance = random.Random(seed)
    pair = Pair(MODEL.body, MODEL.control)
    ended = set()
    for _ in range(600):
        throw(pair, chance)
        h, steps = chance.choice((0.01, 0.004, 0.0077)), chance.randrange(1, 40)
        wind = (chance.gauss(0.0, 5.0), chance.gauss(0.0, 5.0), 0.0)
        flown = [
            fly(controller, body, point, wind, h, steps)
            for fly, controller, body, point in zip(
                (control.fly, compiled.fly), pair.controllers, pair.bodies, pair.points,
                strict=True,
            )
        ]  # fmt: skip
        assert flown[0] == flown[1]
        pair.check()
        assert pair.bodies[0].on_ground or flown[0] == steps
        ended.add(flown[0] < steps)
    assert ended == {False, True}


@needs_compiled
def test_reset_is_the_same() -> None:
    pair = Pair(MODEL.body, MODEL.control)
    throw(pair, random.Random(1))
    for body, controller in zip(pair.bodies, pair.controllers, strict=True):
        body.reset(0.6, 0.8)
        controller.reset()
    pair.check()


@needs_compiled
def test_what_is_not_its_own_is_refused() -> None:
    limits = MODEL.control
    plain: Any = control.SetPoint(limits)
    body = compiled.Multirotor(MODEL.body)
    with pytest.raises(TypeError, match='compiled set-point'):
        compiled.Controller(body, limits).update(0.01, plain)
    wrong: Any = multirotor.Multirotor(MODEL.body)
    with pytest.raises(TypeError, match='compiled set-point'):
        compiled.Controller(wrong, limits).update(0.01, compiled.SetPoint(limits))
    short: Any = (1.0, 2.0)
    with pytest.raises(TypeError, match='four motors'):
        body.step(0.01, short, 0.0, 0.0, 0.0)
    for other in (plain, compiled.SetPoint(limits)):  # not a set-point of its own, not its body
        with pytest.raises(TypeError, match='its body'):
            compiled.fly(compiled.Controller(body, limits), wrong, other, (0.0, 0.0, 0.0), 0.01, 1)


def test_the_plain_step_is_used_when_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv(PLAIN_VARIABLE, '1')
    assert compiled._classes() == (multirotor.Multirotor, control.Controller, control.SetPoint)


@pytest.mark.parametrize('name', ['aurora_uav_flight', 'aurora_uav_wire'])
def test_a_twin_of_other_sources_is_not_used(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made = pytest.importorskip(name)
    monkeypatch.delenv(PLAIN_VARIABLE, raising=False)
    assert twin(name) is made
    monkeypatch.setattr(made, 'SOURCES', 'of others')
    assert twin(name) is None


def test_what_set_up_compiled_is_used() -> None:
    """Otherwise the tests above are left out and everybody flies in plain Python, unnoticed."""
    wanted = not os.environ.get(PLAIN_VARIABLE)
    for name, used in (
        ('aurora_uav_flight', compiled.IS_COMPILED),
        ('aurora_uav_wire', wire.IS_COMPILED),
    ):
        assert (importlib.util.find_spec(name) is not None and wanted) == used
