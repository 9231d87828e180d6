# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of what must not be done: kept from, done nevertheless, not judged."""

from __future__ import annotations

import math

import numpy as np
import pytest
from kind_rows import Row, cut, done_at, gone
from trace_builder import FloatArray
from trace_cases import Case, ground_case, spec

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind as B

T = 401  # 20 s
TICK = np.arange(T)
STILL = np.zeros(T)
SHORT = Reason.TRACE_SHORT


def _not(kind: str, speed: FloatArray, other: tuple[float, float] | None = None) -> Case:
    """car1, with car2 so far ahead and so fast where it is about two, must not do something."""
    others = {} if other is None else {'car2': (other[0], np.full(T, other[1]))}
    case = ground_case(Behavior(kind=B.DRIVE), speed, **others)
    no = {'forbids': 'behavior', 'id': 'no1', 'agent': 'car1', 'kind': kind}
    no |= {} if other is None else {'target': 'car2'}
    case.spec = spec(**{**dict(case.spec), 'prohibitions': (no,)})
    return case


def _rests(seconds: float) -> FloatArray:
    """10 m/s, but standing for some time from 5 s on."""
    stands = (TICK >= 100) & (100 + round(seconds / 0.05) > TICK)
    return np.where(stands, 0.0, 10.0)


def _braking(mps2: float) -> FloatArray:
    return np.maximum(10.0 - np.maximum(TICK - 100, 0) * 0.05 * mps2, 0.0)


def _turning(case: Case, degrees: float) -> Case:
    """It heads east, and from 5 s on so much to the left of that."""
    later, angle = TICK >= 100, math.radians(degrees)
    heading = (np.where(later, math.cos(angle), 1.0), np.where(later, math.sin(angle), 0.0))
    case.run.agents[0].heading = heading
    return case


FAST = np.full(T, 10.0)

ROWS = (
    Row(id='no1.holds', what='no-stop', make=lambda: _not('stop', _rests(1.5)), margin=0.5),
    Row(id='no1.holds', what='stop', make=lambda: _not('stop', _rests(5.0)), margin=-3.0),
    Row(
        id='no1.holds',
        what='never-moves',
        make=lambda: _not('stop', STILL),
        reason=Reason.PREMISE_NEVER,
    ),
    Row(id='no1.holds', what='cut', make=lambda: cut(_not('stop', FAST), 200), reason=SHORT),
    Row(
        id='no1.holds', what='gently', make=lambda: _not('brake', _braking(3.0)), margin=3.96 - 3.0
    ),
    Row(
        id='no1.holds', what='brakes', make=lambda: _not('brake', _braking(5.0)), margin=3.96 - 5.0
    ),
    Row(
        id='no1.holds',
        what='gone',
        make=lambda: gone(_not('brake', FAST), 0, 0),
        reason=Reason.TARGET_GONE,
    ),
    Row(
        id='no1.holds',
        what='stays-behind',
        make=lambda: _not('overtake', FAST, (30.0, 10.0)),
        margin=30.0,
    ),
    Row(
        id='no1.holds',
        what='overtakes',
        make=lambda: _not('overtake', FAST, (30.0, 5.0)),
        margin=-70.0,
    ),
    # Who was ahead all along has overtaken nobody.
    Row(
        id='no1.holds',
        what='ahead-all-along',
        make=lambda: _not('overtake', FAST, (-30.0, 10.0)),
        margin=0.0,
    ),
    Row(id='no1.holds', what='no-cross', make=lambda: _not('cross', FAST), margin=3.0),
    Row(id='no1.holds', what='one-lane', make=lambda: _not('change_lane', FAST), margin=2.0),
    Row(
        id='no1.holds',
        what='bends',
        make=lambda: _turning(_not('turn_left', FAST), 40.0),
        margin=20.0,
    ),
    Row(
        id='no1.holds',
        what='turns-left',
        make=lambda: _turning(_not('turn_left', FAST), 90.0),
        margin=-30.0,
    ),
    Row(
        id='no1.holds',
        what='turns-to-the-other-side',
        make=lambda: _turning(_not('turn_right', FAST), 90.0),
        margin=60.0,
    ),
    Row(
        id='no1.holds',
        what='never-moves',
        make=lambda: _not('turn_left', STILL),
        margin=60.0,
    ),
    Row(id='no1.holds', what='done', make=lambda: done_at(_not('brake', FAST), 300), margin=3.96),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_kind(row: Row) -> None:
    row.check()
