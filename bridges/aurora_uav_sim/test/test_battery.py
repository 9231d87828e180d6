# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The battery: what flights take from it, and when it is empty."""

from __future__ import annotations

from math import pi, sqrt

import pytest

from aurora_uav_sim.battery import Battery, flight_power_w
from aurora_uav_sim.multirotor import Multirotor
from aurora_uav_sim.parameters import GRAVITY_MPS2, EnergyParameters, installed_model
from aurora_uav_sim.settings import AutopilotSettings
from aurora_uav_sim.wind import Wind

ENERGY = installed_model().energy


def _body(forward_mps: float = 0.0, up_mps: float = 0.0, lean: float = 0.0) -> Multirotor:
    """A level or leaning body (tangent of half its pitch) whose rotors carry its weight."""
    body = Multirotor(installed_model().body)
    scale = 1.0 / sqrt(1.0 + lean * lean)
    body.qw, body.qy = scale, lean * scale
    body.vx, body.vz = forward_mps, up_mps
    upright = 1.0 - 2.0 * body.qy * body.qy
    share = 0.25 * installed_model().body.mass_kg * GRAVITY_MPS2 / upright
    body.f0 = body.f1 = body.f2 = body.f3 = share
    return body


def _wind(east_mps: float) -> Wind:
    wind = Wind()
    wind.set(east_mps, 0.0, 0.0, 0.0)
    return wind


def test_a_hover_takes_what_momentum_theory_says() -> None:
    weight_n = installed_model().body.mass_kg * GRAVITY_MPS2
    disc_m2 = 4.0 * pi * ENERGY.rotor_radius_m**2
    ideal_w = weight_n * sqrt(weight_n / (2.0 * 1.225 * disc_m2))
    found = flight_power_w(_body(), _wind(0.0), ENERGY)
    assert found == pytest.approx(ideal_w / ENERGY.efficiency, rel=1e-12)


def test_air_from_the_side_helps_and_climbing_costs() -> None:
    calm, hover = _wind(0.0), flight_power_w(_body(), _wind(0.0), ENERGY)
    assert flight_power_w(_body(forward_mps=8.0), calm, ENERGY) < hover
    assert flight_power_w(_body(), _wind(-8.0), ENERGY) == flight_power_w(
        _body(forward_mps=8.0), calm, ENERGY
    )
    weight_n = installed_model().body.mass_kg * GRAVITY_MPS2
    climb = flight_power_w(_body(up_mps=5.0), calm, ENERGY)
    # Lifting alone is weight times speed; the rotors' own loss falls, but by less.
    assert hover < climb < hover + 5.0 * weight_n / ENERGY.efficiency
    assert flight_power_w(_body(up_mps=-3.0), calm, ENERGY) == hover


def test_drag_is_paid_for() -> None:
    """Leaning into the air, the rotors push against it: force times speed at least."""
    body = _body(forward_mps=18.0, lean=0.2)
    pushed_n = 4.0 * body.f0 * 2.0 * body.qw * body.qy
    assert flight_power_w(body, _wind(0.0), ENERGY) > pushed_n * 18.0 / ENERGY.efficiency


def test_motors_that_stand_take_nothing() -> None:
    assert flight_power_w(Multirotor(installed_model().body), _wind(5.0), ENERGY) == 0.0


def test_it_empties_by_power_and_keeps_a_reserve() -> None:
    battery = Battery(AutopilotSettings())
    assert (battery.left_s, battery.flight_current_a) == (0.0, 0.0)  # nobody can tell yet
    body, calm = _body(), _wind(0.0)
    usable_s = 3600.0 * ENERGY.battery_wh * ENERGY.usable_share
    usable_s /= flight_power_w(body, calm, ENERGY)
    flown_s = 0.0
    while not battery.is_flown:
        battery.step(1.0, body, calm)
        flown_s += 1.0
    assert flown_s == pytest.approx(usable_s, abs=1.0)
    assert battery.share == pytest.approx(1.0 - ENERGY.usable_share, abs=0.001)
    assert battery.charge.name == 'LOW'
    left_s = usable_s * battery.share / ENERGY.usable_share
    assert battery.left_s == pytest.approx(left_s, rel=0.01)
    for _ in range(round(battery.left_s) + 1):
        battery.step(1.0, body, calm)
    assert battery.share == 0.0
    assert battery.charge.name == 'EMERGENCY'


def test_a_set_drain_counts_however_it_flies() -> None:
    settings = AutopilotSettings(battery_endurance_s=100.0, battery_floor_percent=20.0)
    battery = Battery(settings)
    battery.step(10.0, _body(up_mps=5.0), _wind(0.0))
    assert battery.share == pytest.approx(0.9)
    assert battery.left_s == pytest.approx(90.0)
    battery.step(500.0, _body(), _wind(0.0))
    assert battery.share == pytest.approx(0.2)


def test_a_worse_rotor_takes_more() -> None:
    worse = EnergyParameters(
        battery_wh=ENERGY.battery_wh,
        usable_share=ENERGY.usable_share,
        rotor_radius_m=ENERGY.rotor_radius_m / 2.0,
        efficiency=ENERGY.efficiency,
    )
    calm = _wind(0.0)
    assert flight_power_w(_body(), calm, worse) == pytest.approx(
        2.0 * flight_power_w(_body(), calm, ENERGY)
    )
