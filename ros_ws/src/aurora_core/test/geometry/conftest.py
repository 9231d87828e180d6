# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Random footprints for the property tests: what shapely calls valid, in two characters.

Session fixtures that return functions of a seed: hypothesis draws the seed.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
import shapely

from aurora_core.geometry.arrays import FloatArray

Rings = tuple[FloatArray, tuple[FloatArray, ...]]
Footprints = Callable[[int], list[Rings]]


def _rings(polygon: shapely.Polygon) -> Rings:
    return (
        np.array(polygon.exterior.coords)[:-1],
        tuple(np.array(hole.coords)[:-1] for hole in polygon.interiors),
    )


@pytest.fixture(scope='session')
def grid_footprints() -> Footprints:
    """Unions of cells of a 6 x 6 grid of 10 m: exact touches, courtyards, notches, corners."""

    def make(seed: int) -> list[Rings]:
        rng = np.random.default_rng(seed)
        cells = [
            shapely.box(10 * i, 10 * j, 10 * i + 10, 10 * j + 10)
            for i in range(6)
            for j in range(6)
            if rng.random() < 0.55
        ]
        union = shapely.unary_union(cells or [shapely.box(0, 0, 10, 10)])
        return [_rings(part) for part in shapely.get_parts(union)]

    return make


@pytest.fixture(scope='session')
def star_footprints() -> Footprints:
    """Crooked concave stars, every other one with a courtyard of its own shape."""

    def make(seed: int) -> list[Rings]:
        rng = np.random.default_rng(seed)
        made: list[Rings] = []
        for k in range(4):
            count = int(rng.integers(4, 12))
            angle = 2.0 * math.pi * (np.arange(count) + 0.8 * rng.random(count)) / count
            radius = 5.0 + 10.0 * rng.random(count)
            centre = np.array([40.0 * (k % 2), 40.0 * (k // 2)]) + 4.0 * rng.random(2)
            spokes = np.stack((radius * np.cos(angle), radius * np.sin(angle)), axis=1)
            hole = centre + 0.4 * spokes
            made.append((centre + spokes, (hole,) if k % 2 else ()))
        return made

    return make
