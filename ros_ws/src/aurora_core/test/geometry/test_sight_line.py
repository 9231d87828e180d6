# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One line at a time: always the answer of `SightModel`, and seldom its work."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SightModel
from aurora_core.geometry.sight_line import SightLine

Rings = tuple[FloatArray, tuple[FloatArray, ...]]
Point = tuple[float, float, float]
SQUARE = np.array([[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]])
TOWER = Prism('tower', SQUARE, (), 0.0, 20.0)


class _Counting(SightModel):
    """Counts the lines that come through to the model."""

    asked = 0

    def clearance(self, observer_xyz: object, target_xyz: object) -> float:
        self.asked += 1
        return super().clearance(observer_xyz, target_xyz)  # type: ignore[arg-type]


@settings(derandomize=True, deadline=None, max_examples=80)
@given(seed=st.integers(0, 2**32 - 1), grid=st.booleans(), raised=st.booleans())
def test_the_answer_is_the_models(
    grid_footprints: Callable[[int], list[Rings]],
    star_footprints: Callable[[int], list[Rings]],
    seed: int,
    grid: bool,
    raised: bool,
) -> None:
    rng = np.random.default_rng(seed)
    rings = (grid_footprints if grid else star_footprints)(seed)
    prisms = [
        Prism(f'p{k}', ring, holes, 8.0 if raised else 0.0, 10.0 + 5.0 * float(rng.integers(0, 6)))
        for k, (ring, holes) in enumerate(rings)
    ]
    p, q = rng.random((2, 30, 3)) * [100.0, 100.0, 60.0] - [20.0, 20.0, 0.0]
    if grid:  # through corners, along walls, level with roofs, straight down
        p, q = np.round(p / 5.0) * 5.0, np.round(q / 5.0) * 5.0
    model = SightModel(prisms)
    line = SightLine(model)
    expected = model.clearance_series(p, q) > 0.0
    starts, ends = (tuple(map(tuple, points.tolist())) for points in (p, q))
    assert [line.free(a, b) for a, b in zip(starts, ends, strict=True)] == expected.tolist()


@pytest.mark.parametrize(
    ('p', 'q', 'free'),
    [
        ((-10.0, 5.0, 40.0), (30.0, 5.0, 40.0), True),  # high above
        ((-10.0, 5.0, 40.0), (-2.0, 5.0, 1.0), True),  # down to a place before the wall
        ((5.0, 5.0, 40.0), (5.0, 5.0, 25.0), True),  # straight down, above the roof
        ((-10.0, 15.0, 5.0), (20.0, 15.0, 5.0), True),  # beside
        ((500.0, 500.0, 5.0), (520.0, 500.0, 5.0), True),  # no building far and wide
    ],
)
def test_plain_lines_do_not_reach_the_model(p: Point, q: Point, free: bool) -> None:
    model = _Counting([TOWER])
    assert SightLine(model).free(p, q) is free
    assert model.asked == 0


@pytest.mark.parametrize(
    ('p', 'q', 'free'),
    [
        ((-10.0, 5.0, 5.0), (20.0, 5.0, 5.0), False),
        ((-10.0, 5.0, 20.0), (20.0, 5.0, 20.0), False),  # along the roof: touching is not free
        ((-5000.0, 5.0, 30.0), (5000.0, 5.0, 30.0), True),  # longer than what is looked at here
        ((math.nan, 5.0, 30.0), (20.0, 5.0, 30.0), False),
    ],
)
def test_the_model_decides_about_the_others(p: Point, q: Point, free: bool) -> None:
    model = _Counting([TOWER])
    assert SightLine(model).free(p, q) is free
    assert model.asked == 1
