# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rows of the trace and MAVLink fields."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import pytest

from aurora_core.ports.simulators import AirLoad, UavHome
from aurora_core.trace.layout import (
    UAV_COMMAND_WIDTH,
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
)
from aurora_uav_bridge import conversions
from aurora_uav_bridge.errors import CommandRangeError
from aurora_uav_sim.autopilot import Target
from aurora_uav_sim.set_point import SetPointReader

HOME = UavHome(uav_id='uav_7', system_id=7, x_m=100.0, y_m=-50.0)
NAN, INF = math.nan, math.inf
LOAD = AirLoad(dt_s=0.05, seed=1, homes=(HOME,), origin_lat_deg=48.0, origin_lon_deg=11.0)


def command(**changes: float) -> list[float]:
    row = [0.0] * UAV_COMMAND_WIDTH
    row[UavCommandColumn.X], row[UavCommandColumn.Y] = HOME.x_m, HOME.y_m
    for name, value in changes.items():
        row[UavCommandColumn[name]] = value
    return row


def test_a_command_row_arrives_as_the_same_target() -> None:
    """Across the border and back: our packing, the simulator's reading."""
    row = command(MODE=2, X=103.0, Y=-46.0, Z=20.0, VX=1.0, VY=2.0, VZ=0.5, YAW=0.25)
    fields = conversions.set_point_fields(HOME, 9, row)
    assert (fields[0], fields[13]) == (9, 7)
    target = SetPointReader().read(fields)
    assert isinstance(target, Target)
    assert (target.xy, target.z) == ((3.0, 4.0), 20.0)
    assert (target.vxy, target.vz) == ((1.0, 2.0), 0.5)
    assert target.sin_cos_yaw == pytest.approx((math.sin(0.25), math.cos(0.25)))


@pytest.mark.parametrize('name', [c.name for c in UavCommandColumn if c <= 8])
@pytest.mark.parametrize('bad', [NAN, INF, -INF, 1e30])
def test_a_bad_field_is_refused_with_uav_and_field(name: str, bad: float) -> None:
    with pytest.raises(CommandRangeError) as refused:
        conversions.check_command(HOME, 3, command(**{name: bad}))
    message = str(refused.value)
    assert 'uav_7' in message
    assert f', {name}: ' in message
    assert 'tick 3' in message
    assert refused.value.code == 423


@pytest.mark.parametrize('mode', [0.5, -1.0, 4.0, 9.0])
def test_modes_that_cannot_be_commanded_are_refused(mode: float) -> None:
    with pytest.raises(CommandRangeError, match=r'MODE: expected one of 0 .IDLE., 1 .TAKEOFF.'):
        conversions.check_command(HOME, 3, command(MODE=mode))


def test_range_is_measured_from_the_home() -> None:
    assert conversions.check_command(HOME, 1, command(X=20_000.0, MODE=2)) is UavMode.OFFBOARD
    far = dataclasses.replace(HOME, x_m=-500_000.0)
    with pytest.raises(CommandRangeError, match='X: expected a number from -520000'):
        conversions.check_command(far, 1, command(X=0.0))


@pytest.mark.parametrize(
    ('name', 'bad'),
    [
        ('dt_s', NAN),
        ('dt_s', 0.0),
        ('dt_s', -0.05),
        ('dt_s', 5.0),
        ('dt_s', 0.0333333),
        ('seed', -1),
        ('seed', 2**64),
        ('origin_lat_deg', NAN),
        ('origin_lat_deg', 90.0),
        ('origin_lon_deg', 181.0),
        ('origin_alt_m', INF),
        ('wind_mean_east_mps', NAN),
        ('wind_mean_north_mps', 51.0),
        ('wind_gust_mps', -1.0),
        ('wind_gust_mps', NAN),
    ],
)
def test_a_bad_load_is_refused_by_name(name: str, bad: Any) -> None:
    with pytest.raises(CommandRangeError, match=f'air load, {name}: '):
        conversions.check_load(dataclasses.replace(LOAD, **{name: bad}))


@pytest.mark.parametrize(
    ('name', 'bad'),
    [
        ('x_m', NAN),
        ('y_m', INF),
        ('yaw_enu_rad', NAN),
        ('yaw_enu_rad', 1e9),
        ('system_id', 0),
        ('system_id', 65),
    ],
)
def test_a_bad_home_is_refused_by_name(name: str, bad: Any) -> None:
    home = dataclasses.replace(HOME, **{name: bad})
    with pytest.raises(CommandRangeError, match=f'home of uav_7, {name}: '):
        conversions.check_load(dataclasses.replace(LOAD, homes=(home,)))


def test_doubled_system_ids_and_too_many_uavs_are_refused() -> None:
    with pytest.raises(CommandRangeError, match='system id 7 is used twice'):
        conversions.check_load(dataclasses.replace(LOAD, homes=(HOME, HOME)))
    many = tuple(dataclasses.replace(HOME, system_id=i) for i in range(1, 22))
    with pytest.raises(CommandRangeError, match='at most 20 UAVs, found 21'):
        conversions.check_load(dataclasses.replace(LOAD, homes=many))


@pytest.mark.parametrize(('dt_s', 'us'), [(0.05, 50_000), (0.1, 100_000), (0.02, 20_000)])
def test_tick_length(dt_s: float, us: int) -> None:
    assert conversions.check_load(dataclasses.replace(LOAD, dt_s=dt_s)) == us


def test_state_row_is_enu_around_the_home() -> None:
    half = math.sqrt(0.5)
    row = conversions.state_row(
        HOME,
        (5, 2.0, 1.0, -3.0, 5.0, 4.0, -6.0),
        # FRD to NED, level, nose to the east: 90 degrees clockwise from north.
        (5, half, 0.0, 0.0, half, 0.1, 0.2, 0.3, 0.0, 0.0, 0.0, 0.0),
        (UavMode.LAND, True, False),
    )
    assert len(row) == UAV_WIDTH
    assert row[: UavColumn.QW] == [101.0, -48.0, 3.0, 4.0, 5.0, 6.0]
    assert row[UavColumn.QW : UavColumn.P] == pytest.approx([1.0, 0.0, 0.0, 0.0])
    assert row[UavColumn.P : UavColumn.ARMED] == [0.1, -0.2, -0.3]
    assert row[UavColumn.ARMED :] == [1.0, 3.0, 0.0]


def test_all_finite() -> None:
    assert conversions.all_finite([[0.0, 1.0], [2.0]])
    assert not conversions.all_finite([[0.0], [NAN]])
