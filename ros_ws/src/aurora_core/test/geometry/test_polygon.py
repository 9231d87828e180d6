# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Plane polygons against shapely."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.polygon import Polygon, PolygonSet, segment_inside_fraction

Rings = tuple[FloatArray, tuple[FloatArray, ...]]
Footprints = Callable[[int], list[Rings]]
SEED = st.integers(0, 2**32 - 1)
PROPERTY = settings(derandomize=True, deadline=None, max_examples=60)
SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


def make(rings: list[Rings]) -> PolygonSet:
    return PolygonSet(Polygon(ring, holes) for ring, holes in rings)


def oracle(rings: list[Rings]) -> list[shapely.Polygon]:
    return [shapely.Polygon(ring, holes) for ring, holes in rings]


@PROPERTY
@given(seed=SEED, grid=st.booleans())
def test_signed_distance_is_shapelys(
    grid_footprints: Footprints, star_footprints: Footprints, seed: int, grid: bool
) -> None:
    rings = (grid_footprints if grid else star_footprints)(seed)
    rng = np.random.default_rng(seed + 1)
    xy = rng.integers(-5, 66, (60, 2)) * 1.0 if grid else rng.random((60, 2)) * 80.0 - 20.0
    points = shapely.points(xy)
    parts = [
        np.where(shapely.covers(area, points), -1.0, 1.0) * area.boundary.distance(points)
        for area in oracle(rings)
    ]
    expected = np.minimum(np.min(parts, axis=0), 50.0)
    assert make(rings).signed_distance(xy) == pytest.approx(expected, abs=1e-9)


@PROPERTY
@given(seed=SEED)
def test_contains_is_shapelys_off_the_boundary(
    grid_footprints: Footprints, star_footprints: Footprints, seed: int
) -> None:
    rng = np.random.default_rng(seed)
    for rings in (grid_footprints(seed), star_footprints(seed)):
        xy = rng.random((80, 2)) * 80.0 - 10.0
        expected = shapely.contains(shapely.unary_union(oracle(rings)), shapely.points(xy))
        assert make(rings).contains(xy).tolist() == expected.tolist()


def test_a_point_on_shared_boundaries_is_in_exactly_one_tile() -> None:
    tiles = [
        PolygonSet([Polygon(SQUARE + np.array([10.0 * i, 10.0 * j]))])
        for i in range(3)
        for j in range(3)
    ]
    xy = np.array([[x, y] for x in range(5, 26) for y in range(5, 26)], dtype=np.float64)
    count = np.sum([tile.contains(xy) for tile in tiles], axis=0)
    assert count.tolist() == [1] * len(xy)


@PROPERTY
@given(seed=SEED, grid=st.booleans())
def test_inside_fraction_is_shapelys(
    grid_footprints: Footprints, star_footprints: Footprints, seed: int, grid: bool
) -> None:
    rings = (grid_footprints if grid else star_footprints)(seed)
    rng = np.random.default_rng(seed + 1)
    area = shapely.unary_union(oracle(rings))
    polygons = make(rings)
    for _ in range(8):
        p, q = rng.random((2, 2)) * 90.0 - 15.0
        if grid:  # through corners, with ends on walls
            p, q = np.round(p / 5.0) * 5.0, np.round(q / 5.0) * 5.0 + [0.0, 1.0]
        line = shapely.LineString([p, q])
        expected = line.intersection(area).length / line.length
        if grid and p[0] == q[0] and p[0] % 10.0 == 0.0:
            continue  # along a wall: half-open, tested below
        assert polygons.segment_inside_fraction(p, q) == pytest.approx(expected, abs=1e-9)


def test_inside_fraction_of_overlapping_polygons_counts_once() -> None:
    polygons = PolygonSet([Polygon(SQUARE), Polygon(SQUARE + np.array([5.0, 0.0]))])
    assert polygons.segment_inside_fraction([-5.0, 5.0], [25.0, 5.0]) == pytest.approx(0.5)


def test_inside_fraction_along_a_shared_edge_is_whole() -> None:
    polygons = PolygonSet([Polygon(SQUARE), Polygon(SQUARE + np.array([0.0, 10.0]))])
    assert polygons.segment_inside_fraction([2.0, 10.0], [8.0, 10.0]) == 1.0


def test_inside_fraction_with_a_courtyard() -> None:
    hole = SQUARE * 0.2 + [4.0, 4.0]
    court = Polygon(SQUARE, (hole,))
    assert segment_inside_fraction([0.0, 5.0], [10.0, 5.0], court) == pytest.approx(0.8)
    both = PolygonSet([court, Polygon(hole)])
    assert segment_inside_fraction([0.0, 5.0], [10.0, 5.0], both) == pytest.approx(1.0)


@pytest.mark.parametrize(('point', 'share'), [([5.0, 5.0], 1.0), ([15.0, 5.0], 0.0)])
def test_inside_fraction_of_a_point(point: list[float], share: float) -> None:
    assert PolygonSet([Polygon(SQUARE)]).segment_inside_fraction(point, point) == share


def test_empty_set_contains_nothing() -> None:
    nothing = PolygonSet([])
    assert nothing.contains([[1.0, 1.0]]).tolist() == [False]
    assert nothing.signed_distance([[1.0, 1.0]], 30.0).tolist() == [30.0]
    assert nothing.segment_inside_fraction([0.0, 0.0], [1.0, 0.0]) == 0.0


def test_absent_rows_stay_absent() -> None:
    xy = [[np.nan, 1.0], [5.0, 5.0]]
    polygons = PolygonSet([Polygon(SQUARE)])
    assert polygons.contains(xy).tolist() == [False, True]
    distance = polygons.signed_distance(xy)
    assert np.isnan(distance[0])
    assert distance[1] == -5.0


def test_boundary_is_positive_zero() -> None:
    distance = PolygonSet([Polygon(SQUARE)]).signed_distance([[0.0, 5.0], [10.0, 10.0]])
    assert distance.tolist() == [0.0, 0.0]
    assert not np.signbit(distance).any()


def test_many_rows_equal_single_rows_to_the_bit(star_footprints: Footprints) -> None:
    polygons = make(star_footprints(3))
    xy = np.random.default_rng(4).random((5000, 2)) * 80.0 - 20.0  # several chunks, tree search
    series = polygons.signed_distance(xy)
    rows = range(0, 5000, 97)
    assert [polygons.signed_distance(xy[k : k + 1])[0] for k in rows] == series[rows].tolist()


def test_crossed_rings_are_refused() -> None:
    with pytest.raises(MapError, match='simple polygon'):
        Polygon(SQUARE[[0, 2, 1, 3]])


def test_a_polygon_of_many_edges_contains_what_all_its_edges_say() -> None:
    chance = np.random.default_rng(5)
    turn = np.sort(chance.uniform(0.0, 2.0 * np.pi, 3000))
    reach = chance.uniform(20.0, 100.0, (3000, 1))
    ring = reach * np.column_stack((np.cos(turn), np.sin(turn)))
    hole = ring[::7] * 0.1
    whole = shapely.Polygon(ring, [hole])
    area = PolygonSet([Polygon(ring, (hole,)), Polygon(np.array([[0, 0], [9, 0], [0, 9.0]]))])
    # Corners' heights too: there an edge begins and another one ends.
    points = np.column_stack((chance.uniform(-120, 120, 4000), chance.uniform(-120, 120, 4000)))
    points[::2, 1] = chance.choice(ring[:, 1], 2000)
    triangle = shapely.Polygon([[0, 0], [9, 0], [0, 9.0]])
    expected = shapely.contains_xy(whole, points) | shapely.contains_xy(triangle, points)
    assert (area.contains(points) == expected).all()
    assert 500 < np.count_nonzero(expected) < 3500
