# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The lattice is never free where the exact check says blocked."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from aurora_core.errors import MapError
from aurora_core.geometry.obstacles import ObstacleField
from aurora_core.geometry.polygon import Polygon, PolygonSet
from aurora_core.grounding.airspace import Airspace, building_prisms
from aurora_core.knowledge.height_lattice import HeightLattice, height_lattice
from aurora_core.knowledge.map_model import MapModel

CLEARANCE_M = 3.0
POINTS = 20_000


@pytest.fixture(scope='module')
def lattice(downtown: MapModel) -> HeightLattice:
    return height_lattice(downtown, CLEARANCE_M)


def _points(downtown: MapModel, seed: int) -> np.ndarray:
    west, south, east, north = downtown.bounds_m
    draws = np.random.default_rng(seed).random((POINTS, 3))
    return draws * (east - west, north - south, 140.0) + (west, south, 0.0)


def _field(downtown: MapModel) -> ObstacleField:
    return ObstacleField(building_prisms(downtown.buildings))


def test_what_it_frees_keeps_the_clearance(downtown: MapModel, lattice: HeightLattice) -> None:
    points = _points(downtown, 1)
    free = points[:, 2] >= lattice.free_above_m(points[:, :2])
    assert 0.5 < free.mean() < 1.0
    clearance_m = _field(downtown).clearance_series(points[free], CLEARANCE_M + 1.0)
    assert clearance_m.min() >= CLEARANCE_M
    assert downtown.zones
    for zone in downtown.zones:
        inside = PolygonSet([Polygon(np.asarray(zone.ring))]).contains(points[:, :2])
        assert (points[free & inside][:, 2] > zone.ceiling_m).all()


def test_just_above_every_cell_the_clearance_is_kept(
    downtown: MapModel, lattice: HeightLattice
) -> None:
    points = _points(downtown, 2)
    points[:, 2] = lattice.free_above_m(points[:, :2])
    points = points[points[:, 2] > 0.0]
    clearance_m = _field(downtown).clearance_series(points, CLEARANCE_M + 1.0)
    assert clearance_m.min() >= CLEARANCE_M


def test_it_does_not_block_all_of_the_air(downtown: MapModel, lattice: HeightLattice) -> None:
    points = _points(downtown, 3)
    exact = _field(downtown).clearance_series(points, CLEARANCE_M + 1.0) >= CLEARANCE_M
    blocked = points[:, 2] < lattice.free_above_m(points[:, :2])
    assert (blocked & exact).mean() < 0.1


def test_off_the_grid_nothing_is_known_to_be_free(lattice: HeightLattice) -> None:
    outside = np.array([(lattice.west_m - 1.0, lattice.south_m + 1.0), (1e6, 1e6)])
    assert np.isinf(lattice.free_above_m(outside)).all()


def test_a_way_that_it_frees_keeps_the_clearance(
    downtown: MapModel, lattice: HeightLattice
) -> None:
    draws = np.random.default_rng(5)
    west, south, east, north = downtown.bounds_m
    air = Airspace(downtown.buildings, downtown.zones)
    freed = 0
    for _ in range(1500):
        start = draws.uniform((west, south, 3.0), (east, north, 120.0))
        end = start + draws.uniform((-150.0, -150.0, -30.0), (150.0, 150.0, 30.0))
        if draws.random() < 0.5:
            end[2] = start[2]
        if lattice.frees_way(start, end):
            freed += 1
            way = (tuple(start.tolist()), tuple(end.tolist()))
            assert air.way_clearance_m(way) >= lattice.clearance_m, (start, end)
    assert 150 < freed < 1350


def test_ways_are_free_with_it_where_they_are_without(
    downtown: MapModel, lattice: HeightLattice
) -> None:
    draws = np.random.default_rng(6)
    west, south, east, north = downtown.bounds_m
    plain = Airspace(downtown.buildings, downtown.zones)
    quick = Airspace(downtown.buildings, downtown.zones, lattice)
    found = set()
    for _ in range(300):
        height_m = float(draws.uniform(5.0, 90.0))
        ends = draws.uniform((west, south), (east, north), (2, 2)).tolist()
        way = tuple((x, y, height_m) for x, y in ends)
        free = quick.way_is_free(way, CLEARANCE_M)
        assert free == plain.way_is_free(way, CLEARANCE_M)
        found.add(free)
    assert found == {True, False}


def test_arrays_come_back_the_same(lattice: HeightLattice) -> None:
    again = HeightLattice.of_arrays(lattice.arrays())
    assert (again.west_m, again.clearance_m) == (lattice.west_m, lattice.clearance_m)
    assert (again.free_above_dm == lattice.free_above_dm).all()


@pytest.mark.parametrize(
    'arrays',
    [
        {},
        {'frame_m': np.zeros(4)},
        {'frame_m': np.zeros(3), 'free_above_dm': np.zeros((2, 2), dtype=np.uint16)},
        {'frame_m': np.ones(4), 'free_above_dm': np.zeros((2, 2))},
    ],
)
def test_arrays_that_are_no_lattice_are_refused(arrays: dict[str, np.ndarray]) -> None:
    with pytest.raises(MapError, match='lattice'):
        HeightLattice.of_arrays(arrays)


def test_a_large_map_has_larger_cells_that_free_no_more(downtown: MapModel) -> None:
    west, south, east, north = downtown.bounds_m
    wide = replace(downtown, bounds_m=(west, south, east + 50_000.0, north + 50_000.0))
    large = height_lattice(wide, CLEARANCE_M)
    assert large.free_above_dm.size <= 1_000_000
    assert large.cell_m > 5.0
    points = _points(downtown, 3)
    free = points[:, 2] >= large.free_above_m(points[:, :2])
    assert free.mean() > 0.1
    clearance_m = _field(downtown).clearance_series(points[free], CLEARANCE_M + 1.0)
    assert clearance_m.min() >= CLEARANCE_M
