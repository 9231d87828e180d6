# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Solids that cannot be meant are refused with their name; arrays inside cannot change."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.prism import Prism

SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])


def test_prism_keeps_its_own_read_only_copy() -> None:
    ring = SQUARE.copy()
    prism = Prism('b1', ring, (), 0.0, 12.0)
    ring[0, 0] = 99.0
    assert prism.ring_xy[0, 0] == 0.0
    with pytest.raises(ValueError, match='read-only'):
        prism.ring_xy[0, 0] = 1.0


@pytest.mark.parametrize(
    ('ring', 'message'),
    [
        (SQUARE[:2], 'at least 3 points'),
        (np.vstack((SQUARE, SQUARE[:1])), 'not closed'),
        (np.array([[0.0, 0.0], [1.0, np.nan], [1.0, 1.0]]), 'finite coordinates'),
        (SQUARE[[0, 2, 1, 3]], 'simple polygon'),
        (np.array([[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]), 'simple polygon'),
        (np.zeros((4, 3)), 'at least 3 points'),
    ],
)
def test_bad_ring_is_refused(ring: FloatArray, message: str) -> None:
    with pytest.raises(MapError, match=f'b7.*{message}'):
        Prism('b7', ring, (), 0.0, 12.0)


def test_hole_outside_its_ring_is_refused() -> None:
    with pytest.raises(MapError, match='simple polygon'):
        Prism('b1', SQUARE, (SQUARE + 50.0,), 0.0, 12.0)


@pytest.mark.parametrize(
    ('base', 'top', 'message'),
    [
        (5.0, 5.0, 'above the base'),
        (-3.0, -1.0, 'above the base and the ground'),
        (0.0, np.inf, 'finite heights'),
        (np.nan, 3.0, 'finite heights'),
    ],
)
def test_bad_heights_are_refused(base: float, top: float, message: str) -> None:
    with pytest.raises(MapError, match=message):
        Prism('b1', SQUARE, (), base, top)
