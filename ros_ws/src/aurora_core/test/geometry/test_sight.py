# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Line of sight against shapely's intersections and against sampled lines."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import AuroraError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SIGHT_CLEAR_M, SightModel, box_sight_series

Rings = tuple[FloatArray, tuple[FloatArray, ...]]
Footprints = Callable[[int], list[Rings]]
Point = tuple[float, float, float]
SEED = st.integers(0, 2**32 - 1)
PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
TOWER = Prism('tower', SQUARE, (), 0.0, 20.0)
COURT = Prism('court', SQUARE * 4.0, (SQUARE * 2.0 + 10.0,), 0.0, 15.0)


def prisms_of(rings: list[Rings], seed: int, *, raised: bool = False) -> list[Prism]:
    rng = np.random.default_rng(seed)
    return [
        Prism(f'p{k}', ring, holes, 8.0 if raised else 0.0, 10.0 + 5.0 * float(rng.integers(0, 6)))
        for k, (ring, holes) in enumerate(rings)
    ]


def oracle(prisms: list[Prism], p: FloatArray, q: FloatArray) -> float:
    """Least height above the roof over shapely's intersection of line and closed footprint."""
    best = SIGHT_CLEAR_M
    plan = shapely.LineString([p[:2], q[:2]])
    for prism in prisms:
        common = plan.intersection(shapely.Polygon(prism.ring_xy, prism.holes_xy))
        if common.is_empty:
            continue
        places = shapely.get_coordinates(common)
        along = q[:2] - p[:2]
        t = (places - p[:2]) @ along / (along @ along)
        z = p[2] + t * (q[2] - p[2])
        margin = z.min() - prism.top_m
        if prism.base_m > 0.0:
            margin = max(margin, prism.base_m - z.max())
        best = min(best, margin)
    return float(best)


@PROPERTY
@given(seed=SEED, grid=st.booleans(), raised=st.booleans())
def test_margin_is_the_oracles(
    grid_footprints: Footprints,
    star_footprints: Footprints,
    seed: int,
    grid: bool,
    raised: bool,
) -> None:
    rings = (grid_footprints if grid else star_footprints)(seed)
    prisms = prisms_of(rings, seed, raised=raised)
    rng = np.random.default_rng(seed + 1)
    p, q = rng.random((2, 12, 3)) * [100.0, 100.0, 60.0] - [20.0, 20.0, 0.0]
    if grid:  # through corners, along walls, ends on walls
        p, q = np.round(p / 5.0) * 5.0, np.round(q / 5.0) * 5.0
        q[(p[:, :2] == q[:, :2]).all(axis=1), 0] += 5.0
    series = SightModel(prisms).clearance_series(p, q)
    expected = [oracle(prisms, p[k], q[k]) for k in range(12)]
    assert series == pytest.approx(expected, abs=1e-8)


@settings(PROPERTY, max_examples=25)
@given(seed=SEED)
def test_free_lines_have_no_sample_inside_and_blocked_ones_have(
    star_footprints: Footprints, seed: int
) -> None:
    prisms = prisms_of(star_footprints(seed), seed)
    model = SightModel(prisms)
    rng = np.random.default_rng(seed + 1)
    p, q = rng.random((2, 20, 3)) * [80.0, 80.0, 45.0] - [20.0, 20.0, 0.0]
    margin = model.clearance_series(p, q)
    share = np.linspace(0.0, 1.0, 2001)[:, None]
    for k in range(20):
        line = p[k] + share * (q[k] - p[k])
        inside = np.zeros(len(line), dtype=bool)
        points = shapely.points(line[:, :2])
        for prism in prisms:
            area = shapely.Polygon(prism.ring_xy, prism.holes_xy)
            inside |= shapely.contains(area, points) & (line[:, 2] < prism.top_m)
        if margin[k] > 0.0:
            assert not inside.any()
        elif margin[k] < -1.0:  # deep enough not to fall between two samples in height
            grown = [
                shapely.Polygon(b.ring_xy, b.holes_xy).buffer(0.05) for b in prisms
            ]  # a cut corner may be shorter than a step
            near = np.zeros(len(line), dtype=bool)
            for prism, area in zip(prisms, grown, strict=True):
                near |= shapely.contains(area, points) & (line[:, 2] < prism.top_m)
            assert near.any()


@pytest.mark.parametrize(
    ('observer', 'target', 'margin'),
    [
        ((-10.0, 5.0, 40.0), (30.0, 5.0, 40.0), 20.0),  # level, above
        ((-10.0, 5.0, 30.0), (30.0, 5.0, 10.0), 0.0),  # touches the far roof edge: not free
        ((-10.0, 5.0, 5.0), (20.0, 5.0, 5.0), -15.0),
        ((-10.0, 15.0, 5.0), (20.0, 15.0, 5.0), SIGHT_CLEAR_M),  # passes beside
        ((-10.0, 5.0, 5.0), (-2.0, 5.0, 5.0), SIGHT_CLEAR_M),  # ends before the wall
        ((0.0, 20.0, 5.0), (20.0, 0.0, 5.0), -15.0),  # touches a corner
        ((10.0, -5.0, 5.0), (10.0, 15.0, 5.0), -15.0),  # along a wall
        ((10.0, 2.0, 5.0), (10.0, 8.0, 7.0), -15.0),  # along a part of a wall
        ((0.0, 2.0, 5.0), (0.0, 8.0, 7.0), -15.0),  # the same on the other side
        ((5.0, 5.0, 50.0), (5.0, 5.0, 26.0), 6.0),  # straight down on the roof
        ((5.0, 5.0, 50.0), (5.0, 5.0, 2.0), -18.0),  # straight down into it
        ((10.0, 5.0, 50.0), (10.0, 5.0, 2.0), -18.0),  # straight down the wall
        ((15.0, 5.0, 50.0), (15.0, 5.0, 2.0), SIGHT_CLEAR_M),
        ((2.0, 2.0, 30.0), (8.0, 8.0, 24.0), 4.0),  # within the footprint
        ((2.0, 2.0, 5.0), (8.0, 8.0, 4.0), -16.0),
        ((5.0, 5.0, 30.0), (30.0, 5.0, 1.0), 30.0 - 29.0 * 0.2 - 20.0),  # starts above the roof
        ((-10.0, 5.0, 119.0), (30.0, 5.0, 125.0), SIGHT_CLEAR_M),  # far above: as good as beside
        ((7.0, 7.0, 19.0), (7.0, 7.0, 19.0), -1.0),  # no line but a point
    ],
)
def test_known_lines_past_a_tower(observer: Point, target: Point, margin: float) -> None:
    model = SightModel([TOWER])
    assert model.clearance(observer, target) == pytest.approx(margin, abs=1e-9)
    assert model.clearance(target, observer) == pytest.approx(margin, abs=1e-9)


def test_a_courtyard_is_no_roof() -> None:
    model = SightModel([COURT])
    assert model.clearance((12.0, 20.0, 1.0), (28.0, 20.0, 2.0)) == SIGHT_CLEAR_M
    # over the roof of 15 m and down into the yard: over the inner wall at x = 10
    assert model.clearance((-10.0, 20.0, 45.0), (20.0, 20.0, 0.0)) == pytest.approx(0.0)
    assert model.clearance((-10.0, 20.0, 51.0), (20.0, 20.0, 0.0)) == pytest.approx(2.0)
    assert model.clearance((20.0, 20.0, 1.0), (60.0, 20.0, 1.0)) == -14.0


def test_a_notch_is_free() -> None:
    u_shape = [[0, 0], [30, 0], [30, 30], [20, 30], [20, 10], [10, 10], [10, 30], [0, 30]]
    model = SightModel([Prism('u', np.array(u_shape, dtype=np.float64), (), 0.0, 20.0)])
    assert model.clearance((15.0, 12.0, 1.0), (15.0, 60.0, 1.0)) == SIGHT_CLEAR_M
    assert model.clearance((15.0, 12.0, 1.0), (40.0, 20.0, 1.0)) == -19.0


def test_below_a_raised_prism_is_free() -> None:
    model = SightModel([Prism('bridge', SQUARE, (), 6.0, 9.0)])
    assert model.clearance((-10.0, 5.0, 2.0), (20.0, 5.0, 2.0)) == 4.0
    assert model.clearance((-10.0, 5.0, 2.0), (20.0, 5.0, 20.0)) < 0.0


def test_the_worst_building_counts() -> None:
    low = Prism('low', SQUARE - [20.0, 0.0], (), 0.0, 6.0)
    model = SightModel([low, TOWER])
    assert model.clearance((-30.0, 5.0, 12.0), (20.0, 5.0, 12.0)) == -8.0


def city(count: int = 320) -> list[Prism]:
    rng = np.random.default_rng(11)
    made = []
    for k in range(count):
        corner = np.array([60.0 * (k % 18), 60.0 * (k // 18)]) + 8.0 * rng.random(2)
        size = 25.0 + 20.0 * rng.random(2)
        made.append(
            Prism(f'b{k}', SQUARE / 10.0 * size + corner, (), 0.0, 6.0 + 50.0 * rng.random())
        )
    return made


def lines(rows: int) -> tuple[FloatArray, FloatArray]:
    rng = np.random.default_rng(12)
    target = rng.random((rows, 3)) * [1000.0, 1000.0, 1.0]
    angle, reach = 2.0 * math.pi * rng.random(rows), 10.0 + 190.0 * rng.random(rows)
    offset = np.stack(
        (reach * np.cos(angle), reach * np.sin(angle), 20.0 + 40.0 * rng.random(rows))
    )
    return target + offset.T, target


def test_single_lines_equal_the_series_to_the_bit() -> None:
    model = SightModel(city())
    observer, target = lines(4500)
    series = model.clearance_series(observer, target)
    assert (series > 0.0).any()
    assert (series < 0.0).any()
    rows = range(0, 4500, 23)
    assert [model.clearance(observer[k], target[k]) for k in rows] == series[rows].tolist()


def test_city_margins_are_the_oracles() -> None:
    prisms = city()
    observer, target = lines(150)
    series = SightModel(prisms).clearance_series(observer, target)
    expected = [oracle(prisms, observer[k], target[k]) for k in range(150)]
    assert series == pytest.approx(expected, abs=1e-8)


def test_a_minute_of_sight_costs_no_more_steps_than_one_line(
    steps_of: Callable[[Callable[[], object]], int],
) -> None:
    model = SightModel(city())
    one, minute = (steps_of(partial(model.clearance_series, *lines(rows))) for rows in (1, 1200))
    assert minute < 2 * one


def test_absent_rows_stay_absent() -> None:
    model = SightModel([TOWER])
    far = [[50.0, 50.0, 5.0]] * 2
    series = model.clearance_series([[np.nan, 5.0, 5.0], [50.0, 60.0, 5.0]], far)
    assert np.isnan(series[0])
    assert series[1] == SIGHT_CLEAR_M
    absent = box_sight_series(
        far, far, [[np.nan, 0.0], [0.0, 0.0]], [[1.0, 0.0]] * 2, 5.0, 2.0, 1.5
    )
    assert np.isnan(absent[0])
    assert absent[1] == SIGHT_CLEAR_M


def test_unequal_series_are_refused() -> None:
    with pytest.raises(AuroraError, match='one length'):
        SightModel([TOWER]).clearance_series(np.zeros((3, 3)), np.zeros((2, 3)))


def test_without_buildings_everything_is_visible() -> None:
    model = SightModel([])
    assert model.clearance((0.0, 0.0, 1.0), (90.0, 0.0, 1.0)) == SIGHT_CLEAR_M


# Vehicles in between

BUS = {'length_m': 12.0, 'width_m': 2.5, 'height_m': 3.4}


@pytest.mark.parametrize(
    ('observer', 'target', 'margin'),
    [
        ((0.0, -20.0, 1.5), (0.0, 20.0, 1.5), -1.9),  # behind the bus
        ((0.0, -20.0, 41.5), (0.0, 20.0, 1.5), 21.5 - 1.25 - 3.4),  # from the air over it
        ((7.0, -20.0, 1.5), (7.0, 20.0, 1.5), SIGHT_CLEAR_M),  # ahead of it
        ((-20.0, 0.0, 1.5), (-8.0, 0.0, 1.5), SIGHT_CLEAR_M),  # ends behind its rear
        ((0.0, 0.0, 30.0), (0.0, 0.0, 5.0), 1.6),  # straight down on its roof
    ],
)
def test_known_lines_past_a_bus(observer: Point, target: Point, margin: float) -> None:
    series = box_sight_series([observer], [target], [[0.0, 0.0]], [[1.0, 0.0]], **BUS)
    assert series[0] == pytest.approx(margin, abs=1e-9)


@PROPERTY
@given(seed=SEED)
def test_a_box_hides_what_a_prism_of_its_corners_hides(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = 15
    centre, yaw = rng.random((rows, 2)) * 20.0, 7.0 * rng.random(rows)
    heading = np.stack((np.cos(yaw), np.sin(yaw)), axis=1)
    observer, target = rng.random((2, rows, 3)) * [30.0, 30.0, 8.0] - [5.0, 5.0, 0.0]
    series = box_sight_series(observer, target, centre, heading, **BUS)
    for k in range(rows):
        left = np.array([-heading[k, 1], heading[k, 0]])
        corners = [
            centre[k] + a * 6.0 * heading[k] + b * 1.25 * left
            for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))
        ]
        prism = Prism('bus', np.array(corners), (), 0.0, 3.4)
        assert series[k] == pytest.approx(oracle([prism], observer[k], target[k]), abs=1e-8)


def test_one_line_over_several_vehicles_of_their_own_sizes() -> None:
    series = box_sight_series(
        [[0.0, -20.0, 3.0]] * 2,
        [[0.0, 20.0, 3.0]] * 2,
        [[0.0, 0.0], [0.0, 8.0]],
        [[1.0, 0.0], [1.0, 0.0]],
        np.array([5.0, 12.0]),
        np.array([1.8, 2.5]),
        np.array([1.5, 3.4]),
    )
    assert series == pytest.approx([1.5, -0.4])
