# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Bounds of open values: the last column holds for ever after."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.stl.online_bounds import OPEN, by_limit, extended, preceded, since
from aurora_core.stl.windows import FloatArray

BOUNDS = np.array([[1.0, 0.0, -3.0], [2.0, 5.0, 7.0]])


@pytest.mark.parametrize(
    ('skipped', 'expected'),
    [(0, BOUNDS), (1, BOUNDS[:, 1:]), (2, BOUNDS[:, 2:]), (9, [[-3.0], [7.0]])],
)
def test_later_on(skipped: int, expected: FloatArray) -> None:
    assert np.array_equal(since(BOUNDS, skipped), expected)


def test_written_out() -> None:
    assert np.array_equal(extended(BOUNDS, 2), BOUNDS)
    longer = extended(BOUNDS, 5)
    assert longer.tolist() == [[1.0, 0.0, -3.0, -3.0, -3.0], [2.0, 5.0, 7.0, 7.0, 7.0]]


def test_final_values_have_no_width() -> None:
    bounds = preceded(np.array([4.0, 6.0]), BOUNDS)
    assert bounds.tolist() == [[4.0, 6.0, 1.0, 0.0, -3.0], [4.0, 6.0, 2.0, 5.0, 7.0]]


def test_each_limit_by_itself() -> None:
    def reversed_sum(a: FloatArray, b: FloatArray) -> FloatArray:
        return a[::-1] + b

    found = by_limit(reversed_sum, BOUNDS, BOUNDS)
    assert found.tolist() == [[-2.0, 0.0, -2.0], [9.0, 10.0, 9.0]]


def test_what_is_open_stays_open() -> None:
    with pytest.raises(ValueError, match='read-only'):
        OPEN[0, 0] = 0.0
