# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distances along a way, also from where it begins."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from aurora_bench.checker.paths import ahead_of

STREET = np.array([[0.0, 0.0], [200.0, 0.0]])


def _scene(**begins: float) -> Any:
    """Bodies that stand on one street at so many metres, each with the rest of it as its plan."""
    places = {name: np.full((5, 2), (x_m, 0.0)) for name, x_m in begins.items()}
    plans = {name: np.array([[x_m, 0.0], STREET[1]]) for name, x_m in begins.items()}
    return SimpleNamespace(
        memory={},
        bodies={name: SimpleNamespace(route_xy_m=plan) for name, plan in plans.items()},
        xy=places.__getitem__,
        heading=lambda _: np.tile((1.0, 0.0), (5, 1)),
        is_person=lambda _: False,
    )


@pytest.mark.parametrize('gap_m', [0.5, 3.0, 7.99, 8.0, 8.01, 40.0])
def test_who_is_behind_where_a_way_begins_is_so_far_behind(gap_m: float) -> None:
    scene = _scene(front=50.0 + gap_m, rear=50.0)
    for of, to, sign in (('rear', 'front', -1.0), ('front', 'rear', 1.0)):
        ahead, beside = ahead_of(scene, of, to, np.array([0]))
        assert ahead[0] == pytest.approx(sign * gap_m, abs=0.01)
        assert beside[0] == pytest.approx(0.0, abs=0.01)


def test_who_begins_at_one_place_is_neither_ahead_nor_behind() -> None:
    ahead, _ = ahead_of(_scene(one=50.0, other=50.0), 'one', 'other', np.array([0]))
    assert ahead[0] == pytest.approx(0.0, abs=0.01)
