# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Progress along a route, also where the route crosses or repeats itself."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.polyline import Polyline
from aurora_core.geometry.route_follower import RouteFollower

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


def progress(
    route: Polyline, xy: FloatArray, start_s: float = 0.0, *, extend: bool = False
) -> FloatArray:
    """What a follower says of all samples at once."""
    return RouteFollower(route, start_s, extend=extend).follow(xy)


@PROPERTY
@given(seed=SEED, lateral=st.floats(-2.0, 2.0))
def test_progress_on_a_crossing_route_is_what_was_driven(seed: int, lateral: float) -> None:
    rng = np.random.default_rng(seed)
    route = Polyline(EIGHT)
    speed = rng.choice([0.0, 0.2, 0.7, 2.5], 600)  # stops in between
    s = np.minimum(np.cumsum(speed), route.length_m)
    found = progress(route, drive(route, s, lateral))
    assert np.abs(found - s).max() <= 2.0 * abs(lateral) + 1e-6  # corners are cut by the offset
    if lateral == 0.0:
        assert found == pytest.approx(s, abs=1e-9)


def test_laps_count_on() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:] + lap[1:])
    s = np.arange(0.0, 1200.0, 0.6)
    assert progress(route, drive(route, s)) == pytest.approx(s, abs=1e-6)


def test_there_and_back_on_the_same_street() -> None:
    route = Polyline([[0.0, 0.0], [200.0, 0.0], [200.0, 3.5], [0.0, 3.5]])
    s = np.arange(0.0, route.length_m, 0.7)
    assert progress(route, drive(route, s)) == pytest.approx(s, abs=1e-6)


def test_standing_still_stays() -> None:
    route = Polyline(EIGHT)
    xy = np.vstack((drive(route, np.arange(0.0, 270.1, 1.0)), np.tile([50.0, 0.0], (200, 1))))
    assert (progress(route, xy)[-200:] == 270.0).all()


def test_start_in_the_middle_is_found() -> None:
    s = np.arange(60.0, 140.0, 1.0)
    assert progress(STREET, drive(STREET, s)) == pytest.approx(s, abs=1e-9)


def test_start_on_the_expected_lap() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:])
    xy = drive(route, np.array([50.0, 51.0]))
    assert progress(route, xy).tolist() == [50.0, 51.0]
    assert progress(route, xy, start_s=430.0).tolist() == [450.0, 451.0]


def test_start_before_the_route() -> None:
    xy = np.stack((np.arange(-30.0, 30.0, 0.5), np.full(120, 1.0)), axis=1)
    assert progress(STREET, xy) == pytest.approx(np.maximum(xy[:, 0], 0.0))
    assert progress(STREET, xy, extend=True) == pytest.approx(xy[:, 0])


def test_going_on_after_the_end() -> None:
    xy = np.stack((np.full(60, 100.0), np.arange(20.0, 80.0, 1.0)), axis=1)
    assert progress(STREET, xy).max() == 150.0
    assert progress(STREET, xy, extend=True) == pytest.approx(100.0 + xy[:, 1])


def test_a_detour_rejoins_the_same_lap() -> None:
    lap = [*SQUARE, [0.0, 0.0]]
    route = Polyline(lap + lap[1:])
    leave, rejoin = drive(route, np.arange(0.0, 40.0)), drive(route, np.arange(260.0, 300.0))
    corners = np.array([[40.0, 0.0], [40.0, 100.0]])  # straight through the block
    share = np.arange(0.0, 1.0, 0.01)[:, None]
    detour = corners[0] + share * (corners[1] - corners[0])
    found = progress(route, np.vstack((leave, detour, rejoin)))
    assert found[-40:] == pytest.approx(np.arange(260.0, 300.0), abs=1e-6)


def test_absent_samples_are_skipped() -> None:
    xy = drive(STREET, np.arange(0.0, 20.0))
    xy[5:9] = np.nan
    found = progress(STREET, xy)
    assert np.isnan(found[5:9]).all()
    assert found[9:] == pytest.approx(np.arange(9.0, 20.0))
    assert np.isnan(progress(STREET, np.full((3, 2), np.nan))).all()


@PROPERTY
@given(seed=SEED)
def test_in_one_call_or_in_many_the_same_bits(seed: int) -> None:
    rng = np.random.default_rng(seed)
    route = Polyline(EIGHT)
    xy = drive(route, np.cumsum(rng.random(80) * 6.0)) + rng.normal(0.0, 4.0, (80, 2))
    xy[rng.random(80) < 0.1] = np.nan
    follower = RouteFollower(route, 12.0, extend=True)
    cuts = np.sort(rng.integers(0, 81, 5))
    parts = [follower.follow(part) for part in np.split(xy, cuts)]
    whole = progress(route, xy, 12.0, extend=True)
    assert np.concatenate(parts).tobytes() == whole.tobytes()
