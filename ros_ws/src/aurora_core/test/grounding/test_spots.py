# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Start and landing spots lie off the street, clear of buildings and apart from each other."""

from __future__ import annotations

from collections.abc import Callable
from itertools import combinations
from math import sqrt

import numpy as np
import pytest
import shapely

from aurora_core.grounding.spots import SpotFinder
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import Settings


@pytest.mark.parametrize('name', ['downtown', 'junction'])
def test_spots_are_clear_of_everything(
    name: str, map_of: Callable[[str], MapModel], settings: Settings
) -> None:
    the_map = map_of(name)
    finder = SpotFinder(the_map, settings.grounding)
    clear = settings.grounding.spot_clearance_m
    solids = [shapely.Polygon(b.ring) for b in the_map.buildings]
    solids += [shapely.Polygon(z.ring) for z in the_map.zones]
    west, south, east, north = the_map.bounds_m
    found = 0
    for fx in (0.2, 0.5, 0.7):
        for fy in (0.3, 0.5, 0.8):
            x, y = west + fx * (east - west), south + fy * (north - south)
            spots = finder.near(x, y, 3)
            found += len(spots)
            for spot in spots:
                point = shapely.Point(spot)
                assert min(point.distance(s) for s in solids) >= clear
                assert point.distance(the_map.network.street_surface) >= clear
                assert west <= spot[0] <= east
                assert south <= spot[1] <= north
                assert sqrt((spot[0] - x) ** 2 + (spot[1] - y) ** 2) <= (
                    1.5 * settings.grounding.spot_search_m
                )
            for a, b in combinations(spots, 2):
                assert sqrt((a[0] - b[0]) ** 2 + (a[1] - b[1]) ** 2) >= 2.0 * clear
    assert found >= 9


def test_nearest_first_and_the_same_from_anywhere_around(
    map_of: Callable[[str], MapModel], settings: Settings
) -> None:
    finder = SpotFinder(map_of('downtown'), settings.grounding)
    spots = finder.near(0.0, 0.0, 4)
    away = [sqrt(x * x + y * y) for x, y in spots]
    assert away == sorted(away)
    assert finder.near(0.4, -0.3, 4) == spots
    assert finder.near(0.0, 0.0, 1) == spots[:1]


def test_nowhere_near_there_is_nothing(
    map_of: Callable[[str], MapModel], settings: Settings
) -> None:
    finder = SpotFinder(map_of('junction'), settings.grounding)
    assert finder.near(5000.0, 5000.0, 3) == ()


@pytest.mark.parametrize('name', ['downtown', 'junction'])
def test_the_quick_way_decides_as_the_plain_one_also_just_at_the_clearance(
    name: str, map_of: Callable[[str], MapModel], settings: Settings
) -> None:
    the_map = map_of(name)
    finder = SpotFinder(the_map, settings.grounding)
    west, south, east, north = the_map.bounds_m
    xs, ys = np.meshgrid(np.arange(west, east, 20.0), np.arange(south, north, 5.0))
    points = np.column_stack([xs.ravel(), ys.ravel()])
    clear = settings.grounding.spot_clearance_m
    plain = shapely.dwithin(shapely.points(points), finder._blocked, clear)
    assert finder._is_blocked(points).tolist() == plain.tolist()
