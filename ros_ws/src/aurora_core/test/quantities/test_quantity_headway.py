# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Headway and time to collision: the executor sees tick by tick what the monitor sees later."""

from __future__ import annotations

from types import ModuleType

import numpy as np
import pytest

from aurora_core.quantities.headway import NONE_S, PairWatch, pair_series
from aurora_core.quantities.view import RunView

T = 200


def _view(tb: ModuleType, own_mps: float, lead_mps: float, y: float = 0.0) -> RunView:
    run = tb.Run(
        ticks=T,
        agents=[
            tb.driver('ego', 'car', 0.0, np.full(T, own_mps)),
            tb.driver('van1', 'car', 44.5, np.full(T, lead_mps)),
        ],
    )
    run.agents[1].y[:] = y
    return RunView(run.trace(), tb.world())


@pytest.mark.parametrize(
    ('own_mps', 'lead_mps', 'y', 'headway_s', 'ttc_s'),
    [
        (10.0, 8.0, 0.0, 4.0, 20.0),
        (10.0, 12.0, 0.0, 4.0, NONE_S),
        (0.5, 0.0, 0.0, NONE_S, 80.0),
        (10.0, 8.0, 3.3, NONE_S, NONE_S),  # in the lane beside
    ],
)
def test_both_at_the_start(
    tb: ModuleType, own_mps: float, lead_mps: float, y: float, headway_s: float, ttc_s: float
) -> None:
    view = _view(tb, own_mps, lead_mps, y)
    assert pair_series(view, 'headway', 'ego', 'van1')[0] == pytest.approx(headway_s)
    assert pair_series(view, 'ttc', 'ego', 'van1')[0] == pytest.approx(ttc_s)


@pytest.mark.parametrize('measure', ['headway', 'ttc'])
def test_tick_by_tick_the_same_bits(tb: ModuleType, measure: str) -> None:
    view = _view(tb, 10.0, 8.0)
    watch = PairWatch(view.trace.roster, measure, 'ego', 'van1')  # type: ignore[arg-type]
    each = [watch.step(ground) for ground in view.trace.ground]
    assert each == pair_series(view, measure, 'ego', 'van1').tolist()  # type: ignore[arg-type]
