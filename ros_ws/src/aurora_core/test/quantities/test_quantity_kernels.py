# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kernels: one tick and the whole run agree to the bit; bearings; durations in ticks."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.quantities import instant, kernels, motion
from aurora_core.quantities.angle import bearing_error_deg, compass_bearing_deg
from aurora_core.quantities.instant_sight import InstantSight
from aurora_core.quantities.phases import tracked
from aurora_core.quantities.sight import radio_sight_series, sight_series
from aurora_core.quantities.ticks import first_tick, last_tick, longest_stretch, whole_ticks
from aurora_core.quantities.view import RunView
from aurora_core.spec.parameter import Bound
from aurora_core.trace.layout import UavColumn


@pytest.fixture(name='view', scope='module')
def _view(tb: ModuleType) -> RunView:
    rng = np.random.default_rng(7)
    ticks = 300
    run = tb.Run(ticks=ticks)
    for name, kind in (('ego', 'car'), ('bus1', 'bus'), ('walker1', 'pedestrian')):
        speed = np.cumsum(rng.normal(size=ticks) * 0.2) + 8.0
        one = tb.driver(name, kind, float(rng.normal() * 30.0), speed, y=float(rng.normal() * 8.0))
        one.y = one.y + np.cumsum(rng.normal(size=ticks) * 0.05)
        one.present = (np.arange(ticks) < 260).astype(float) if name == 'walker1' else None
        run.agents.append(one)
    run.flights = [tb.flight(ticks, (3.0, 9.0), 30.0, lambda k: (2.0 * k * 0.05, 5.0, 30.0))]
    blocks = (tb.building(10.0, 8.0, 30.0, 20.0, 25.0), tb.building(-40.0, 3.0, -20.0, 7.0, 12.0))
    return RunView(run.trace(), tb.world(buildings=blocks))


@pytest.mark.parametrize('pair', [('ego', 'bus1'), ('uav1', 'ego'), ('uav1', 'walker1')])
def test_distances_at_one_tick_have_the_bits_of_the_series(
    view: RunView, pair: tuple[str, str]
) -> None:
    series = motion.distance(view, *pair)
    trace = view.trace
    for tick in range(0, 260, 7):
        a, b = (
            instant.body_point(trace.roster, trace.ground[tick], trace.uav[tick], name)
            for name in pair
        )
        assert a is not None
        assert b is not None
        assert instant.distance_m(a, b) == series[tick]


def test_a_body_that_is_gone_has_no_point(view: RunView) -> None:
    trace = view.trace
    assert instant.body_point(trace.roster, trace.ground[270], trace.uav[270], 'walker1') is None
    assert instant.body_point(trace.roster, trace.ground[270], trace.uav[270], 'nobody') is None


@pytest.mark.parametrize(
    ('observer', 'target'),
    [
        ('uav1', 'ego'),
        ('uav1', 'bus1'),
        ('uav1', 'walker1'),
        ('ego', 'bus1'),
        ('bus1', 'ego'),
        ('walker1', 'bus1'),
        ('ego', 'uav1'),
    ],
)
def test_sight_at_one_tick_has_the_bits_of_the_series(
    view: RunView, observer: str, target: str
) -> None:
    series = sight_series(view, observer, target)
    radio = radio_sight_series(view, observer, target)
    trace = view.trace
    assert series.visible.any() or not series.visible.all()
    for tick in range(0, 300, 7):
        ground, uav = trace.ground[tick], trace.uav[tick]
        seen = InstantSight(view.geometry, trace.roster).see(observer, target, ground, uav)
        assert seen == (bool(series.visible[tick]), series.slant_range_m[tick])
        free = instant.radio_sight(view.geometry, trace.roster, ground, uav, observer, target)
        assert free is bool(radio[tick])


def test_speed_altitude_and_tracking_at_one_tick_have_the_bits_of_the_series(
    view: RunView,
) -> None:
    trace = view.trace
    uav, ego = view.body('uav1'), view.body('ego')
    away = float(motion.horizontal_distance(view, 'uav1', 'ego')[200])
    rule = kernels.TrackRule(standoff_m=away, horizontal_m=5.0, altitude_m=30.0, vertical_m=5.0)
    series = tracked(view, uav, 'ego', rule)
    assert series.any()
    assert not series.all()
    for tick in range(0, 300, 3):
        row, ground = trace.uav[tick, 0], trace.ground[tick, 0]
        assert instant.uav_speed_mps(row) == motion.speed(view, uav)[tick]
        assert instant.ground_speed_mps(ground) == motion.speed(view, ego)[tick]
        assert instant.altitude_m(row) == motion.altitude(view, uav)[tick]
        assert instant.tracked(rule, row, ground) is bool(series[tick])


def test_one_sided_errors() -> None:
    assert kernels.bound_error(43.0, 40.0, Bound.EXACTLY) == 3.0
    assert kernels.bound_error(43.0, 40.0, Bound.AT_LEAST) == -3.0
    assert kernels.bound_error(43.0, 40.0, Bound.AT_MOST) == 3.0


def test_sight_points_of_the_contract(view: RunView) -> None:
    assert view.sight_point('walker1')[0, 2] == 1.0
    assert view.sight_point('bus1')[0, 2] == 1.6
    assert view.sight_point('uav1')[5, 2] == view.trace.uav[5, 0, UavColumn.Z]


@settings(max_examples=300, deadline=None, derandomize=True)
@given(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3))
def test_bearings_agree_with_the_library(east: float, north: float) -> None:
    bearing = float(compass_bearing_deg(np.array([east]), np.array([north]))[0])
    expected = float(np.degrees(np.arctan2(east, north))) % 360.0
    off = abs(bearing - expected)
    assert min(off, 360.0 - off) < 1e-11
    assert 0.0 <= bearing < 360.0


def test_bearings_in_the_four_directions() -> None:
    east = np.array([0.0, 1.0, 0.0, -1.0, 1.0, 0.0])
    north = np.array([1.0, 0.0, -1.0, 0.0, 1.0, 0.0])
    found = compass_bearing_deg(east, north)
    assert found == pytest.approx([0.0, 90.0, 180.0, 270.0, 45.0, 0.0], abs=1e-12)
    assert bearing_error_deg(np.array([350.0, 20.0]), 5.0) == pytest.approx([15.0, 15.0])


def test_durations_in_ticks() -> None:
    assert whole_ticks(0.15, 0.05) == 3
    assert whole_ticks(0.11, 0.05) == 3
    assert whole_ticks(0.0, 0.05) == 0


def test_searches_in_time() -> None:
    mask = np.array([False, True, False, True, False])
    assert first_tick(mask) == 1
    assert first_tick(mask, 2) == 3
    assert first_tick(mask, 2, 3) is None
    assert first_tick(mask, 9) is None
    assert last_tick(mask) == 3
    assert last_tick(mask, 0, 3) == 1
    assert last_tick(mask[:1]) is None
    assert longest_stretch(mask) == (1, 2), 'of equal ones the first'
    assert longest_stretch(np.array([True, False, True, True])) == (2, 4)
    assert longest_stretch(mask[:1]) is None
