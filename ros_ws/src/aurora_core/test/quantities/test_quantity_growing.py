# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run that goes on has the signals of the whole run, to the last bit."""

from __future__ import annotations

import itertools
from dataclasses import replace
from types import ModuleType

import numpy as np
import pytest

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import CentreLine
from aurora_core.quantities.contact import body_gap, no_fly_distance, obstacle_clearance
from aurora_core.quantities.growing import GrowingView
from aurora_core.quantities.motion import steps
from aurora_core.quantities.routes import along_route
from aurora_core.quantities.sight import radio_sight_series, sight_series
from aurora_core.quantities.view import RunView
from aurora_core.trace.commands import GroundCommand
from aurora_core.trace.layout import GroundCommandKind
from aurora_core.trace.trace import Trace


def test_every_costly_signal_in_parts_is_that_of_the_whole(tb: ModuleType) -> None:
    case = tb.tailgate_case()
    # The van is sent round the corner and back: its progress begins anew twice.
    north = _lane('north_0', (0.0, 0.0), (0.0, 400.0))
    east = _lane('east_0', (-50.0, 0.0), (900.0, 0.0))
    world = replace(tb.world(), lanes=(north, east))
    turns = {
        500: (GroundCommand(agent=1, kind=GroundCommandKind.SET_ROUTE, text='north'),),
        620: (GroundCommand(agent=1, kind=GroundCommandKind.SET_ROUTE, text='east'),),
    }
    case.run.ground_commands = turns
    trace = case.run.trace()
    whole = RunView(trace, world)
    for cuts in ([1, 2, 500, 620, 621, 1000], [37, 499, 501, 619], [1400]):
        growing, *rest = _parts(trace, cuts)
        view = GrowingView(growing, world)
        _signals(view)
        for part in rest:
            view.extend(part)
            _signals(view)
        assert view.ticks == whole.ticks
        assert _signals(view) == _signals(whole)


def test_only_what_is_new_is_worked_out(tb: ModuleType) -> None:
    trace = tb.tailgate_case().run.trace()
    first, second = _parts(trace, [900])
    view = GrowingView(first, tb.world())
    seen: list[int] = []

    def compute(part: RunView) -> tuple[np.ndarray]:
        seen.append(part.ticks)
        return (np.zeros(part.ticks),)

    view.series(('x',), compute)
    view.extend(second)
    view.series(('x',), compute)
    assert len(view.series(('x',), compute)[0]) == trace.ticks
    assert seen == [900, trace.ticks - 900]


def test_a_part_with_a_gap_or_of_another_run_is_refused(tb: ModuleType) -> None:
    first, second = _parts(tb.tailgate_case().run.trace(), [900])
    view = GrowingView(first, tb.world())
    broken = second.ground.copy()
    broken[3, 0, 0] = np.nan
    with pytest.raises(VerificationError, match='every state'):
        view.extend(replace(second, ground=broken))
    with pytest.raises(VerificationError, match='roster'):
        view.extend(tb.hover_case().run.trace())
    assert view.ticks == 900


def _lane(lane_id: str, *points: tuple[float, float]) -> CentreLine:
    return CentreLine(
        lane_id=lane_id,
        street_name='',
        points=np.array(points),
        width_m=3.2,
        speed_limit_mps=13.9,
    )


def _parts(trace: Trace, cuts: list[int]) -> list[Trace]:
    marks = [0, *cuts, trace.ticks]
    return [trace.states(a, b) for a, b in itertools.pairwise(marks)]


def _signals(view: RunView) -> list[bytes]:
    uav = view.body('uav1')
    along = along_route(view, view.body('van1'), view.body('ego'))
    sight = sight_series(view, 'uav1', 'van1')
    return [
        array.tobytes()
        for array in (
            along.lead_m,
            along.gap_m,
            along.offset_m,
            sight.slant_range_m,
            sight.clearance_m,
            sight.margin_m,
            sight.visible,
            radio_sight_series(view, 'uav1', 'ego'),
            body_gap(view).values,
            body_gap(view).which,
            obstacle_clearance(view, uav).values,
            obstacle_clearance(view, uav).which,
            no_fly_distance(view, uav),
            steps(view),
        )
    ]
