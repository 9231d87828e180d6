# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Edges of all kinds: one sample, ends of the record, missing ticks, targets that leave."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from kind_rows import Row, cut, done_at, gone, grounded, stated
from trace_builder import flight
from trace_cases import Case, convoy_case, hover_case, judge, result, survey_case, tailgate_case

from aurora_core.outcomes.verdict import Reason, VerdictStatus

# See test_kinds_missions.py.
HOVER_CAPTURED = 165
EMPTY, GONE, SHORT = Reason.EMPTY_PHASE, Reason.TARGET_GONE, Reason.TRACE_SHORT
LOST = Reason.SAMPLES_MISSING


def _one_sample(**values: float) -> Case:
    """Landing is commanded one tick after capture: the phase has one sample."""
    case = hover_case()
    capture = round((result(judge(case), 'm1.capture').worst_time_s or 0.0) / 0.05)
    case = hover_case(landing=capture + 1)
    return stated(case, 'altitude', ('uav1',), '<=', 31.0, **values)


def _never_captures(leaves: int | None = None) -> Case:
    """The UAV tracks from 60 m aside, where 35 m are asked; the bus may leave."""
    case = convoy_case()
    bus = case.run.agents[1]
    case.run.flights[0] = flight(
        1401, (20.0, 60.0), 30.0, lambda k: (float(bus.x[k]), 60.0, 30.0), landing=1050
    )
    return case if leaves is None else gone(case, 1, leaves)


def _missing(case: Case, *ticks: int) -> Case:
    case.run.missing = ticks
    return case


ROWS = (
    Row(id='m1.drift', make=_one_sample, margin=2.0 - 1.45, what='one-sample'),
    Row(id='m1.altitude', make=_one_sample, margin=1.0 - 0.95, what='one-sample'),
    Row(id='m1.visible', make=_one_sample, margin=1.0 - 0.7, what='one-sample'),
    Row(id='m1.completed', make=_one_sample, margin=0.05 - 29.4, what='one-sample'),
    Row(id='c1.holds', make=_one_sample, margin=31.0 - 30.0, what='one-sample'),
    Row(
        id='c1.share',
        make=lambda: _one_sample(fraction=0.9),
        margin=1.0 - 0.9,
        what='one-sample',
    ),
    # One sample holds for no time at all, and is no stretch of one second.
    Row(id='c1.holds', make=lambda: _one_sample(hold_s=1.0), reason=EMPTY, what='one-sample'),
    # 36.75 s of hovering are no stretch of 60 s, though the run goes on for longer.
    Row(
        id='c1.holds',
        make=lambda: stated(hover_case(), 'altitude', ('uav1',), '<=', 99.0, hold_s=60.0),
        reason=EMPTY,
        what='long-stretch',
    ),
    # The target leaves before capture; after the phase that never captured; not at all.
    Row(id='m1.tracked', make=lambda: _never_captures(500), reason=GONE, what='never-captured'),
    Row(id='m1.tracked', make=lambda: _never_captures(1200), reason=EMPTY, what='never-captured'),
    Row(id='m1.tracked', make=_never_captures, reason=EMPTY, what='never-captured'),
    # It leaves at tick 450 of the phase from 247 to 1050: it was tracked up to then.
    Row(
        id='m1.tracked',
        make=lambda: gone(convoy_case(), 1, 450),
        margin=(450 - 247) / (1050 - 247) - 0.8,
        within=0.003,
        what='leaves',
    ),
    # The run is over, and the UAV is in the air: that is decided.
    Row(
        id='uav1.landed',
        make=lambda: done_at(hover_case(landing=None), 1000),
        margin=-0.05,
        what='run-over',
    ),
    Row(
        id='m1.capture',
        make=lambda: done_at(_stays_away(), 400),
        margin=-0.05,
        what='run-over',
    ),
    # Missing in the middle of the phase, or after its end.
    Row(id='m1.drift', make=lambda: _missing(hover_case(), 400), reason=LOST),
    Row(
        id='m1.drift',
        make=lambda: _missing(hover_case(drift=1.75), 901),
        margin=2.0 - 1.75,
        what='missing-later',
    ),
    Row(id='m1.capture', make=lambda: _missing(hover_case(), 100), reason=LOST),
    Row(id='uav1.landed', make=lambda: _missing(hover_case(), 1000), reason=LOST),
    Row(id='e1.delivered', make=lambda: _missing(tailgate_case(), 646), reason=LOST),
    Row(id='e1.within', make=lambda: _missing(tailgate_case(), 646), margin=1.0),
    Row(id='safety.presence', make=lambda: _missing(convoy_case(), 1400), reason=LOST),
    Row(id='bus1.placed', make=lambda: _missing(convoy_case(), 1), margin=20.0),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_edges_of_kinds(row: Row) -> None:
    row.check()


def _stays_away() -> Case:
    case = hover_case()
    case.run.flights[0] = flight(1401, (100.0, 20.2), 30.0)
    return case


@pytest.mark.parametrize('lose', [cut, _missing], ids=['cut', 'missing'])
@pytest.mark.parametrize('stop', [1, 150, 400, 700, 1000, 1300])
@pytest.mark.parametrize('make', [hover_case, convoy_case, survey_case, tailgate_case])
def test_a_lost_part_never_makes_a_condition_better(
    make: Callable[[], Case], stop: int, lose: Callable[[Case, int], Case]
) -> None:
    whole = {r.id: r for r in judge(make()).results}
    verdict = judge(lose(make(), stop))
    assert verdict.status is VerdictStatus.INCONCLUSIVE
    for found in verdict.results:
        assert found.satisfied is (found.margin is not None and found.margin >= 0.0)
        if found.margin is None:
            assert found.reason is not None
        else:
            assert math.isfinite(found.margin)
            # What has a margin was decided before: with the rest nothing changes about it.
            assert found.margin == whole[found.id].margin or not whole[found.id].satisfied


@pytest.mark.parametrize('make', [hover_case, convoy_case, survey_case, tailgate_case])
def test_a_flight_that_never_begins_satisfies_nothing_about_it(make: Callable[[], Case]) -> None:
    verdict = judge(grounded(make()))
    assert verdict.status is not VerdictStatus.VERIFIED
    for found in verdict.results:
        about_flight = found.id.startswith(('m1.', 'uav1.')) or found.id.endswith('.uav1')
        if about_flight and found.id not in ('m1.centre', 'm1.over'):  # where it was planned
            assert not found.satisfied, found.explanation
