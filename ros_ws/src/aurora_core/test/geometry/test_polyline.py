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


@pytest.mark.parametrize('points', [[[1.0, 1.0]], [[1.0, 1.0], [1.0, 1.0]], np.zeros((0, 2))])
def test_no_length_is_refused(points: FloatLike) -> None:
    with pytest.raises(MapError, match='two different points'):
        Polyline(points)


def test_points_must_be_finite() -> None:
    with pytest.raises(MapError, match='finite'):
        Polyline([[0.0, 0.0], [math.inf, 0.0]])


@PROPERTY
@given(seed=SEED)
def test_many_points_are_measured_as_few_are_bit_by_bit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    points = np.cumsum(rng.normal(scale=7.0, size=(int(rng.integers(32, 90)), 2)), axis=0)
    at_once = Polyline(points)
    one_by_one = Polyline(points[:2])
    one_by_one._measured_one_by_one(points)
    for name in ('_x', '_y', '_s', '_tx', '_ty', '_step'):
        assert getattr(at_once, name) == getattr(one_by_one, name)
    # A repeated point is left out, wherever it stands.
    again = np.repeat(points, rng.integers(1, 3, size=len(points)), axis=0)
    assert Polyline(again).points.tolist() == points.tolist()
    assert Polyline(again).cumulative_m.tolist() == at_once.cumulative_m.tolist()


@PROPERTY
@given(seed=SEED)
def test_places_together_are_the_places_one_by_one_bit_by_bit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    route = Polyline(np.cumsum(rng.normal(scale=7.0, size=(int(rng.integers(2, 60)), 2)), axis=0))
    s = rng.uniform(-5.0, route.length_m + 5.0, size=20)
    s[:3] = 0.0, route.length_m, route.cumulative_m[-2]
    assert route.at_each(s).tolist() == [list(route.at(v)) for v in s.tolist()]
    ahead = sorted(s.tolist())
    assert route.tangents_at(ahead) == [route.at(v)[2:] for v in ahead]
