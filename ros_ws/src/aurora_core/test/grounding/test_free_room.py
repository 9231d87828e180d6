# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Free places keep the gap to everybody who has one, and are looked through from the centre."""

from __future__ import annotations

from collections.abc import Callable
from math import dist

import numpy as np
import pytest

from aurora_core.grounding.free_room import FreeRoom
from aurora_core.knowledge.map_model import MapModel

Maps = Callable[[str], MapModel]
GAP_M = 12.0


def test_places_are_nearest_first_and_never_near_who_stands_there(map_of: Maps) -> None:
    network = map_of('downtown').network
    lanes = list(network.driving_lanes('passenger'))
    first = lanes[0]
    x, y, _, _ = network.position_on_lane(first.id, first.length_m / 2.0)
    room = FreeRoom(network, (x, y), GAP_M)
    places = list(room.scanned(lanes, 3.0))
    assert [p[2] for p in places] == sorted(p[2] for p in places)

    taken: list[tuple[float, float]] = []
    for number in range(20):
        for found in (room.scanned(lanes, 3.0), room.drawn(lanes, 3.0, _generator(number))):
            lane, position_m, away_m = next(found)
            here = network.position_on_lane(lane.id, position_m)[:2]
            assert away_m == pytest.approx(dist(here, (x, y)))
            assert all(dist(here, other) >= GAP_M for other in taken)
            room.take(*here)
            taken.append(here)
    left = list(room.scanned(lanes, 3.0))
    assert 0 < len(left) < len(list(FreeRoom(network, (x, y), GAP_M).scanned(lanes, 3.0)))


def _generator(seed: int) -> np.random.Generator:
    return np.random.default_rng(seed)
