# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clearance in space against shapely and against samples of surfaces and flight paths."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import AuroraError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.obstacles import ObstacleField, point_box_distance
from aurora_core.geometry.prism import Prism

Rings = tuple[FloatArray, tuple[FloatArray, ...]]
Footprints = Callable[[int], list[Rings]]
Point = tuple[float, float, float]
SEED = st.integers(0, 2**32 - 1)
PROPERTY = settings(derandomize=True, deadline=None, max_examples=50)
SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
L_SHAPE = np.array([[0, 0], [30, 0], [30, 10], [10, 10], [10, 30], [0, 30]], dtype=np.float64)
TOWER = Prism('tower', SQUARE, (), 0.0, 20.0)
BRIDGE = Prism('bridge', SQUARE, (), 6.0, 9.0)
COURT = Prism('court', SQUARE * 4.0, (SQUARE * 2.0 + 10.0,), 0.0, 15.0)


def prisms_of(rings: list[Rings], seed: int) -> list[Prism]:
    rng = np.random.default_rng(seed)
    made = []
    for k, (ring, holes) in enumerate(rings):
        base = 0.0 if rng.random() < 0.6 else 5.0 * float(rng.integers(1, 3))
        made.append(Prism(f'p{k}', ring, holes, base, base + 5.0 * float(rng.integers(1, 5))))
    return made


def oracle_clearance(prisms: list[Prism], xyz: FloatArray) -> FloatArray:
    """Least signed distance by shapely's plane distances and the height difference."""
    points = shapely.points(xyz[:, :2])
    best = np.full(len(xyz), math.inf)
    for prism in prisms:
        area = shapely.Polygon(prism.ring_xy, prism.holes_xy)
        aside = np.where(shapely.covers(area, points), -1.0, 1.0) * area.boundary.distance(points)
        under = prism.base_m - xyz[:, 2] if prism.base_m > 0.0 else -math.inf
        beyond = np.maximum(xyz[:, 2] - prism.top_m, under)
        both = (aside > 0.0) & (beyond > 0.0)
        signed = np.where(both, np.hypot(aside, beyond), np.maximum(aside, beyond))
        best = np.minimum(best, signed)
    return best


def at(field: ObstacleField, point: Point | FloatArray) -> float:
    return float(field.clearance_series(np.array([point]), math.inf)[0])


@PROPERTY
@given(seed=SEED, grid=st.booleans())
def test_clearance_is_the_oracles(
    grid_footprints: Footprints, star_footprints: Footprints, seed: int, grid: bool
) -> None:
    prisms = prisms_of((grid_footprints if grid else star_footprints)(seed), seed)
    xyz = np.random.default_rng(seed).random((80, 3)) * [90.0, 90.0, 40.0] - [15.0, 15.0, 0.0]
    xyz[40:] = np.round(xyz[40:] / 5.0) * 5.0  # on walls, roofs, edges and corners
    expected = oracle_clearance(prisms, xyz)
    field = ObstacleField(prisms)
    assert field.clearance_series(xyz, 500.0) == pytest.approx(expected, abs=1e-9)
    short = field.clearance_series(xyz, 4.0)
    assert short == pytest.approx(np.minimum(expected, 4.0), abs=1e-9)


def test_clearance_is_the_distance_to_the_sampled_surface() -> None:
    side = np.arange(0.0, 10.01, 0.25)
    u, v = (grid.ravel() for grid in np.meshgrid(side, side))
    w = np.repeat(np.arange(0.0, 20.01, 0.25), len(side))
    s = np.tile(side, len(w) // len(side))
    surface = np.concatenate(
        (
            np.stack((u, v, np.full_like(u, 20.0)), axis=1),
            *(np.stack((s, np.full_like(s, y), w), axis=1) for y in (0.0, 10.0)),
            *(np.stack((np.full_like(s, x), s, w), axis=1) for x in (0.0, 10.0)),
        )
    )
    field = ObstacleField([TOWER])
    rng = np.random.default_rng(8)
    for point in rng.random((60, 3)) * [40.0, 40.0, 45.0] - [15.0, 15.0, 0.0]:
        sampled = np.sqrt(((surface - point) ** 2).sum(axis=1)).min()
        exact = abs(at(field, point))
        assert exact <= sampled + 1e-9
        assert sampled <= exact + 0.18


@pytest.mark.parametrize(
    ('point', 'distance'),
    [
        ((15.0, 5.0, 5.0), 5.0),  # beside
        ((5.0, 5.0, 27.0), 7.0),  # above
        ((13.0, 14.0, 5.0), 5.0),  # off an upright edge
        ((12.0, 13.0, 26.0), 7.0),  # off a roof corner
        ((5.0, 5.0, 18.0), -2.0),  # under the roof
        ((1.0, 5.0, 5.0), -1.0),  # behind a wall
        ((5.0, 5.0, 0.1), -5.0),  # the ground is no way out
        ((5.0, 5.0, 20.0), 0.0),
        ((10.0, 10.0, 3.0), 0.0),
    ],
)
def test_known_distances_to_a_tower(point: Point, distance: float) -> None:
    field = ObstacleField([TOWER])
    assert at(field, point) == pytest.approx(distance, abs=1e-12)


def test_under_a_raised_prism_is_outside() -> None:
    field = ObstacleField([BRIDGE])
    assert at(field, (5.0, 5.0, 2.0)) == 4.0
    assert at(field, (5.0, 5.0, 6.5)) == -0.5
    assert at(field, (5.0, 5.0, 12.0)) == 3.0


def test_a_courtyard_is_outside() -> None:
    assert at(ObstacleField([COURT]), (20.0, 18.0, 5.0)) == 8.0


def test_single_points_equal_the_series_to_the_bit(star_footprints: Footprints) -> None:
    field = ObstacleField(prisms_of(star_footprints(1), 1))
    xyz = np.random.default_rng(2).random((6000, 3)) * [100.0, 100.0, 40.0] - [20.0, 20.0, 0.0]
    series = field.clearance_series(xyz)
    rows = [k for k in range(0, 6000, 61) if series[k] < 50.0]
    assert len(rows) > 50
    assert [at(field, xyz[k]) for k in rows] == series[rows].tolist()


def test_tree_and_plain_search_find_the_same() -> None:
    rng = np.random.default_rng(3)
    prisms = [
        Prism(f'b{k}', SQUARE + rng.random(2) * 900.0, (), 0.0, 10.0 + 30.0 * rng.random())
        for k in range(200)
    ]
    field = ObstacleField(prisms)
    xyz = rng.random((300, 3)) * [900.0, 900.0, 60.0]
    expected = np.minimum(oracle_clearance(prisms, xyz), 50.0)
    series = field.clearance_series(xyz)
    assert series == pytest.approx(expected, abs=1e-9)
    assert [min(at(field, point), 50.0) for point in xyz] == series.tolist()


def test_absent_rows_stay_absent() -> None:
    field = ObstacleField([TOWER])
    series = field.clearance_series([[np.nan, 5.0, 5.0], [15.0, 5.0, np.inf], [15.0, 5.0, 5.0]])
    assert np.isnan(series[:2]).all()
    assert series[2] == 5.0
    assert math.isnan(field.segment_clearance((0.0, 0.0, math.nan), (50.0, 0.0, 5.0)))


def test_a_field_without_prisms_is_free() -> None:
    field = ObstacleField([])
    assert at(field, (0.0, 0.0, 0.0)) == math.inf
    assert field.clearance_series([[0.0, 0.0, 0.0]], 30.0).tolist() == [30.0]
    assert field.segment_clearance((0.0, 0.0, 1.0), (9.0, 0.0, 1.0)) == 50.0


@pytest.mark.parametrize(
    ('p', 'q', 'distance'),
    [
        ((-5.0, -5.0, 25.0), (15.0, 15.0, 25.0), 5.0),  # over the roof
        ((15.0, -5.0, 5.0), (15.0, 15.0, 5.0), 5.0),  # along a wall
        ((15.0, 15.0, 0.0), (15.0, 15.0, 40.0), math.sqrt(50.0)),  # climb beside a corner
        ((5.0, 5.0, 24.0), (5.0, 5.0, 40.0), 4.0),  # climb above the roof
        ((14.0, 5.0, 23.0), (14.0, 5.0, 23.0), 5.0),  # no segment but a point
        ((-10.0, 5.0, 20.0), (20.0, 5.0, 20.0), 0.0),  # sliding over the roof
        ((10.0, -5.0, 5.0), (10.0, 15.0, 5.0), 0.0),  # sliding along the wall
        ((10.0, 10.0, 30.0), (10.0, 10.0, 0.0), 0.0),  # down an upright edge
        ((0.0, -10.0, 5.0), (-10.0, 0.0, 5.0), math.sqrt(50.0)),
        ((5.0, -10.0, 30.0), (5.0, 20.0, 30.0), 10.0),
        ((5.0, -10.0, 10.0), (5.0, -2.0, 10.0), 2.0),
    ],
)
def test_known_segments_past_a_tower(p: Point, q: Point, distance: float) -> None:
    field = ObstacleField([TOWER])
    assert field.segment_clearance(p, q) == pytest.approx(distance, abs=1e-9)
    assert field.segment_clearance(q, p) == pytest.approx(distance, abs=1e-9)


@pytest.mark.parametrize(
    ('prism', 'p', 'q'),
    [
        (TOWER, (-10.0, 5.0, 5.0), (20.0, 5.0, 5.0)),  # through
        (TOWER, (2.0, 2.0, 5.0), (8.0, 8.0, 6.0)),  # wholly inside
        (TOWER, (5.0, 5.0, 30.0), (5.0, 5.0, 10.0)),  # down through the roof
        (BRIDGE, (5.0, 5.0, 1.0), (5.0, 5.0, 30.0)),  # up through both faces
        (COURT, (20.0, 20.0, 5.0), (20.0, 50.0, 5.0)),  # out of the courtyard
    ],
)
def test_a_segment_that_enters_is_negative(prism: Prism, p: Point, q: Point) -> None:
    assert ObstacleField([prism]).segment_clearance(p, q) < 0.0


@PROPERTY
@given(seed=SEED, grid=st.booleans())
def test_segments_are_as_near_as_their_nearest_point(
    grid_footprints: Footprints, star_footprints: Footprints, seed: int, grid: bool
) -> None:
    prisms = prisms_of((grid_footprints if grid else star_footprints)(seed), seed)
    field = ObstacleField(prisms)
    rng = np.random.default_rng(seed + 2)
    scale, shift = [100.0, 100.0, 40.0], [20.0, 20.0, 0.0]
    p, q = rng.random((2, 12, 3)) * scale - shift
    p[6:], q[6:] = np.round(p[6:] / 5.0) * 5.0, np.round(q[6:] / 5.0) * 5.0
    q[9] = p[9]
    q[10, :2] = p[10, :2]  # vertical
    share = np.linspace(0.0, 1.0, 801)[:, None]
    exact = [field.segment_clearance(p[k], q[k], 500.0) for k in range(12)]
    for k in range(12):
        sampled = oracle_clearance(prisms, p[k] + share * (q[k] - p[k])).min()
        half_step = float(np.linalg.norm(q[k] - p[k])) / 1600.0 + 1e-9
        if exact[k] > 0.0:
            assert exact[k] - 1e-9 <= sampled <= exact[k] + half_step
        else:
            assert sampled <= half_step
            assert exact[k] >= sampled - half_step


def test_segment_cutoff() -> None:
    field = ObstacleField([TOWER])
    assert field.segment_clearance((18.0, 0.0, 5.0), (18.0, 9.0, 5.0), 3.0) == 3.0


def test_segment_in_the_notch_of_a_concave_ring() -> None:
    field = ObstacleField([Prism('l', L_SHAPE, (), 0.0, 20.0)])
    assert field.segment_clearance((14.0, 13.0, 5.0), (25.0, 25.0, 5.0)) == pytest.approx(3.0)


# Boxes on the ground

AHEAD = [[1.0, 0.0]]


@pytest.mark.parametrize(
    ('point', 'distance'),
    [
        ((5.0, 0.0, 1.0), 2.5),
        ((0.0, 0.0, 4.5), 3.0),
        ((5.5, 5.0, 1.0), 5.0),  # corner, 3-4-5
        ((4.5, 2.0, 3.5), 3.0),  # 2-1-2 off the upper corner
        ((0.0, 0.0, 0.2), -1.0),  # the ground is no way out
        ((2.0, 0.0, 1.0), -0.5),
        ((2.5, 0.0, 1.0), 0.0),
    ],
)
def test_known_distances_to_a_box(point: Point, distance: float) -> None:
    found = point_box_distance([point], [[0.0, 0.0]], AHEAD, 5.0, 2.0, 1.5)
    assert found[0] == pytest.approx(distance, abs=1e-12)


@PROPERTY
@given(seed=SEED)
def test_box_is_a_prism_of_its_corners(seed: int) -> None:
    rng = np.random.default_rng(seed)
    yaw, centre = 7.0 * rng.random(), 20.0 * rng.random(2)
    heading = np.array([math.cos(yaw), math.sin(yaw)])
    left = np.array([-heading[1], heading[0]])
    corners = [centre + a * 6.0 * heading + b * 1.25 * left
               for a, b in ((1, 1), (-1, 1), (-1, -1), (1, -1))]  # fmt: skip
    field = ObstacleField([Prism('bus', np.array(corners), (), 0.0, 3.4)])
    points = rng.random((50, 3)) * [24.0, 24.0, 6.0]
    found = point_box_distance(
        points, np.tile(centre, (50, 1)), np.tile(heading, (50, 1)), 12.0, 2.5, 3.4
    )
    assert found == pytest.approx(field.clearance_series(points), abs=1e-9)


def test_box_series_keeps_absent_rows_and_refuses_unequal_lengths() -> None:
    points = [[0.0, 0.0, 5.0], [0.0, 0.0, 5.0]]
    centres = [[np.nan, 0.0], [0.0, 0.0]]
    found = point_box_distance(points, centres, AHEAD * 2, 5.0, 2.0, 1.5)
    assert np.isnan(found[0])
    assert found[1] == 3.5
    with pytest.raises(AuroraError, match='one length'):
        point_box_distance(points, centres, AHEAD, 5.0, 2.0, 1.5)
