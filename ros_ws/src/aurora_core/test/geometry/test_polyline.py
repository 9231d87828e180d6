# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes: arc length and place, also where a route crosses or repeats itself."""

from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray, FloatLike
from aurora_core.geometry.polyline import Polyline

SEED = st.integers(0, 2**32 - 1)
PROPERTY = settings(derandomize=True, deadline=None, max_examples=80)
STREET = Polyline([[0.0, 0.0], [100.0, 0.0], [100.0, 50.0]])
SQUARE = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]]
EIGHT = [[0, 0], [100, 0], [100, 60], [50, 60], [50, -60], [0, -60]]  # crosses itself at (50, 0)


def drive(route: Polyline, s: FloatArray, lateral: float = 0.0) -> FloatArray:
    """Places beside the route at given arc lengths."""
    rows = []
    for value in s:
        x, y, tx, ty = route.at(float(value))
        rows.append((x - lateral * ty, y + lateral * tx))
    return np.array(rows).reshape(len(rows), 2)


@PROPERTY
@given(seed=SEED)
def test_at_and_project_are_shapelys(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = rng.random((int(rng.integers(2, 9)), 2)) * 100.0
    route, line = Polyline(points), shapely.LineString(points)
    assert route.length_m == pytest.approx(line.length)
    for s in rng.random(5) * line.length:
        assert route.at(s)[:2] == pytest.approx(line.interpolate(s).coords[0], abs=1e-9)
    for x, y in rng.random((5, 2)) * 140.0 - 20.0:
        s, lateral = route.project(x, y)
        point = shapely.Point(x, y)
        assert s == pytest.approx(line.project(point), abs=1e-7)
        assert abs(lateral) == pytest.approx(line.distance(point), abs=1e-9)


def test_tangent_is_of_the_segment_after_a_corner_and_ends_are_limits() -> None:
    assert STREET.at(100.0) == (100.0, 0.0, 0.0, 1.0)
    assert STREET.at(-7.0) == (0.0, 0.0, 1.0, 0.0)
    assert STREET.at(999.0) == (100.0, 50.0, 0.0, 1.0)


def test_lateral_is_positive_to_the_left() -> None:
    assert STREET.project(40.0, 3.0) == (40.0, 3.0)
    assert STREET.project(40.0, -3.0) == (40.0, -3.0)
    assert STREET.project(97.0, 30.0) == (130.0, 3.0)


def test_repeated_points_are_dropped() -> None:
    route = Polyline([[0, 0], [0, 0], [10, 0], [10, 0], [10, 5]])
    assert route.points.tolist() == [[0, 0], [10, 0], [10, 5]]
    assert route.cumulative_m.tolist() == [0.0, 10.0, 15.0]


def test_before_the_start_and_after_the_end() -> None:
    assert STREET.project(-5.0, 0.0) == (0.0, 5.0)
    assert STREET.project(-5.0, 2.0, extend=True) == (-5.0, 2.0)
    assert STREET.project(100.0, 58.0, extend=True) == (158.0, 0.0)
    assert STREET.project(100.0, 58.0) == (150.0, 8.0)


def test_a_window_hides_the_other_branch() -> None:
    route = Polyline(EIGHT)  # passes (50, 0) at s = 50 and s = 270
    assert route.project(50.0, 0.0)[0] == 50.0
    assert route.project(50.0, 0.0, near_s=262.0)[0] == 270.0
    assert route.project(50.0, 0.0, near_s=100.0, window_m=20.0) == (80.0, 30.0)
    assert route.project(50.0, 0.0, near_s=-90.0, window_m=20.0)[0] == 0.0
    assert route.project(0.0, 0.0, near_s=900.0, window_m=20.0)[0] == route.length_m


@PROPERTY
@given(seed=SEED, lateral=st.floats(-2.0, 2.0))
def test_progress_on_a_crossing_route_is_what_was_driven(seed: int, lateral: float) -> None:
    rng = np.random.default_rng(seed)
    route = Polyline(EIGHT)
    speed = rng.choice([0.0, 0.2, 0.7, 2.5], 600)  # stops in between
    s = np.minimum(np.cumsum(speed), route.length_m)
    found = route.project_series(drive(route, s, lateral))
    assert np.abs(found - s).max() <= 2.0 * abs(lateral) + 1e-6  # corners are cut by the offset
    if lateral == 0.0:
        assert found == pytest.approx(s, abs=1e-9)


def test_laps_count_on() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:] + lap[1:])
    s = np.arange(0.0, 1200.0, 0.6)
    assert route.project_series(drive(route, s)) == pytest.approx(s, abs=1e-6)


def test_there_and_back_on_the_same_street() -> None:
    route = Polyline([[0.0, 0.0], [200.0, 0.0], [200.0, 3.5], [0.0, 3.5]])
    s = np.arange(0.0, route.length_m, 0.7)
    assert route.project_series(drive(route, s)) == pytest.approx(s, abs=1e-6)


def test_standing_still_stays() -> None:
    route = Polyline(EIGHT)
    xy = np.vstack((drive(route, np.arange(0.0, 270.1, 1.0)), np.tile([50.0, 0.0], (200, 1))))
    assert (route.project_series(xy)[-200:] == 270.0).all()


def test_start_in_the_middle_is_found() -> None:
    s = np.arange(60.0, 140.0, 1.0)
    assert STREET.project_series(drive(STREET, s)) == pytest.approx(s, abs=1e-9)


def test_start_on_the_expected_lap() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:])
    xy = drive(route, np.array([50.0, 51.0]))
    assert route.project_series(xy).tolist() == [50.0, 51.0]
    assert route.project_series(xy, start_s=430.0).tolist() == [450.0, 451.0]


def test_start_before_the_route() -> None:
    xy = np.stack((np.arange(-30.0, 30.0, 0.5), np.full(120, 1.0)), axis=1)
    assert STREET.project_series(xy) == pytest.approx(np.maximum(xy[:, 0], 0.0))
    assert STREET.project_series(xy, extend=True) == pytest.approx(xy[:, 0])


def test_going_on_after_the_end() -> None:
    xy = np.stack((np.full(60, 100.0), np.arange(20.0, 80.0, 1.0)), axis=1)
    assert STREET.project_series(xy).max() == 150.0
    assert STREET.project_series(xy, extend=True) == pytest.approx(100.0 + xy[:, 1])


def test_a_detour_rejoins_the_same_lap() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:])
    leave, rejoin = drive(route, np.arange(0.0, 40.0)), drive(route, np.arange(260.0, 300.0))
    corners = np.array([[40.0, 0.0], [40.0, 100.0]])  # straight through the block
    share = np.arange(0.0, 1.0, 0.01)[:, None]
    detour = corners[0] + share * (corners[1] - corners[0])
    found = route.project_series(np.vstack((leave, detour, rejoin)))
    assert found[-40:] == pytest.approx(np.arange(260.0, 300.0), abs=1e-6)


def test_absent_samples_are_skipped() -> None:
    xy = drive(STREET, np.arange(0.0, 20.0))
    xy[5:9] = np.nan
    found = STREET.project_series(xy)
    assert np.isnan(found[5:9]).all()
    assert found[9:] == pytest.approx(np.arange(9.0, 20.0))
    assert np.isnan(STREET.project_series(np.full((3, 2), np.nan))).all()


@pytest.mark.parametrize('points', [[[1.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]], np.zeros((0, 2))])
def test_no_length_is_refused(points: FloatLike) -> None:
    with pytest.raises(MapError, match='two different points'):
        Polyline(points)


def test_points_must_be_finite() -> None:
    with pytest.raises(MapError, match='finite'):
        Polyline([[0.0, 0.0], [math.inf, 0.0]])
