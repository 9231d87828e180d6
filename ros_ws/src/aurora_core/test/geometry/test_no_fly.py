# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Zones have a floor and a ceiling."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.geometry.no_fly import ZoneField
from aurora_core.geometry.prism import Prism

DISC = np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 40.0], [0.0, 40.0]])
ZONES = ZoneField([Prism('helipad', DISC, (), 30.0, 80.0)])


@pytest.mark.parametrize(
    ('point', 'distance'),
    [
        ((20.0, 20.0, 25.0), 5.0),  # below the floor
        ((20.0, 20.0, 90.0), 10.0),  # above the ceiling
        ((45.0, 20.0, 50.0), 5.0),
        ((20.0, 20.0, 33.0), -3.0),
        ((300.0, 20.0, 50.0), 50.0),  # cutoff
    ],
)
def test_distance(point: tuple[float, float, float], distance: float) -> None:
    assert ZONES.distance(point) == distance
    assert ZONES.distance_series([point]).tolist() == [distance]


def test_paths() -> None:
    assert ZONES.segment_distance((-20.0, 20.0, 20.0), (60.0, 20.0, 20.0)) == 10.0
    assert ZONES.polyline_distance([(-20.0, 20.0, 20.0), (60.0, 20.0, 60.0)]) < 0.0
    assert ZONES.nearest((45.0, 20.0, 50.0)) == ('helipad', 5.0)
    assert ZONES.zones[0].prism_id == 'helipad'
