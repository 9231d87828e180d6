# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long somebody stands, moves or tailgates: satisfied, violated, not judged.

A duration may be missed by 0.5 s, who stands needs up to 1 s more to set off.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, gone
from pydantic import ValidationError
from trace_builder import FloatArray, number
from trace_cases import Case, ground_case, judge, result

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Parameter, Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind as B

TOWER = 'landmark:Tower'
LEAST, MOST = Bound.AT_LEAST, Bound.AT_MOST


def _for(seconds: float, bound: Bound = Bound.EXACTLY) -> Parameter:
    return number(seconds, Unit.SECOND, explicit=True, bound=bound)


def _speeds(*parts: tuple[float, float]) -> FloatArray:
    """20 s at speeds for times; the last one to the end."""
    each = [np.full(round(20.0 * seconds), mps) for mps, seconds in parts]
    return np.concatenate([*each, np.full(401, parts[-1][0])])[:401]


def _stands(seconds: float, kind: B = B.STOP, before_s: float = 5.0, **asked: object) -> Case:
    """car1 drives at 5 m/s, stands, and drives on; it is to stand for 6 s."""
    speed = _speeds((5.0, before_s), (0.0, seconds), (5.0, 1.0))
    behavior = Behavior(kind=kind, **{'duration_s': _for(6.0), **asked})  # type: ignore[arg-type]
    return ground_case(behavior, speed)


def _at_tower(x_m: float) -> Case:
    case = _stands(6.0, target=TOWER)
    case.world = replace(case.world, places=(NamedPlace(name=TOWER, x_m=x_m, y_m=0.0),))
    return case


_STANDING = (
    Row(id='car1.stop', make=lambda: _stands(6.0), margin=0.5, what='in-time'),
    Row(id='car1.stop', make=lambda: _stands(7.0), margin=0.5, what='sets-off-late'),
    Row(id='car1.stop', make=lambda: _stands(3.0), margin=0.5 - 3.0, what='too-short'),
    Row(id='car1.stop', make=lambda: _stands(10.0), margin=0.5 - 3.0, what='too-long'),
    Row(id='car1.stop', make=lambda: _stands(30.0), margin=0.5 - 6.0, what='stays-there'),
    Row(id='car1.stop', make=lambda: _stands(6.0, before_s=0.0), margin=0.5 - 6.0, what='before'),
    Row(id='car1.stop', make=lambda: _at_tower(25.0), margin=0.5, what='there'),
    Row(id='car1.stop', make=lambda: _at_tower(99.0), margin=0.5 - 6.0, what='elsewhere'),
    Row(id='car1.wait', make=lambda: _stands(6.0, B.WAIT, 0.0), margin=0.5, what='from-start'),
    Row(id='car1.park', make=lambda: _stands(3.0, B.PARK, 0.0), margin=0.5 - 3.0, what='short'),
    Row(
        id='car1.stop',
        make=lambda: _stands(8.0, duration_s=_for(6.0, LEAST)),
        margin=2.0,
        what='at-least',
    ),
    Row(
        id='car1.stop',
        make=lambda: _stands(5.9, duration_s=_for(6.0, LEAST)),
        margin=-0.1,
        what='less-than-least',
    ),
    Row(
        id='car1.stop',
        make=lambda: _stands(4.0, duration_s=_for(6.0, MOST)),
        margin=2.0,
        what='at-most',
    ),
    Row(
        id='car1.stop',
        make=lambda: _stands(0.0, duration_s=_for(6.0, MOST)),
        reason=Reason.PREMISE_NEVER,
        what='at-most-and-never',
    ),
    Row(id='car1.stop', make=lambda: gone(_stands(6.0), 0, 0), reason=Reason.TARGET_GONE),
)


def _drives(*parts: tuple[float, float], mps: float | None = None) -> Case:
    """car1 is to drive for 15 s."""
    asked = None if mps is None else number(mps, Unit.METRE_PER_SECOND, explicit=True)
    behavior = Behavior(kind=B.DRIVE, speed_mps=asked, duration_s=_for(15.0))
    return ground_case(behavior, _speeds(*parts))


def _follows(gap_m: float) -> Case:
    """car1 drives behind car2 all along, and is to follow it for 15 s."""
    behavior = Behavior(kind=B.FOLLOW, target='car2', duration_s=_for(15.0))
    speed = _speeds((5.0, 20.0))
    return ground_case(behavior, speed, car2=(gap_m, speed))


def _tailgates(seconds: float) -> Case:
    """car1 drives 4 m behind car2, which then gets away; it is to tailgate for 8 s."""
    behavior = Behavior(kind=B.TAILGATE, target='car2', duration_s=_for(8.0, LEAST))
    ahead = _speeds((5.0, seconds), (25.0, 1.0))
    return ground_case(behavior, _speeds((5.0, 20.0)), car2=(8.5, ahead))


_MOVING = (
    Row(id='car1.drive.time', make=lambda: _drives((5.0, 16.0), (0.0, 1.0)), margin=1.5),
    Row(
        id='car1.drive.time',
        make=lambda: _drives((5.0, 10.0), (0.0, 2.0), (5.0, 1.0)),
        margin=10.0 - 14.5,
        what='stops-between',
    ),
    # 4 of 5 samples have the speed in the 10 s around the first 8.
    Row(
        id='car1.drive.time',
        make=lambda: _drives((5.0, 8.0), (9.0, 1.0), mps=5.0),
        margin=10.0 - 14.5,
        within=1.1,
        what='gets-faster',
    ),
    Row(
        id='car1.drive.time',
        make=lambda: _drives((5.0, 20.0), mps=5.0),
        margin=401 / 20.0 - 14.5,
        what='at-speed',
    ),
    Row(
        id='car1.drive.time',
        make=lambda: gone(_drives((5.0, 20.0)), 0, 0),
        reason=Reason.TARGET_GONE,
    ),
    Row(id='car1.follow.time', make=lambda: _follows(20.0), margin=401 / 20.0 - 14.5),
    Row(id='car1.follow.time', make=lambda: _follows(90.0), margin=-14.5, what='too-far'),
    Row(id='car1.follow.time', make=lambda: gone(_follows(20.0), 0, 0), reason=Reason.TARGET_GONE),
)

ROWS = (*_STANDING, *_MOVING)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_lasting_kinds(row: Row) -> None:
    row.check()


@pytest.mark.parametrize(('seconds', 'holds'), [(9.0, True), (6.5, False)])
def test_who_tailgates_for_a_time_does_so_for_that_time(seconds: float, holds: bool) -> None:
    row = Row(id='car1.tailgate', make=lambda: _tailgates(seconds), margin=0.0)
    (condition,) = (c for c in row.conditions() if c.id == row.id)
    assert condition.hold_s == 8.0
    assert result(judge(row.make()), row.id).satisfied is holds


@pytest.mark.parametrize('kind', [B.CROSS, B.TURN_LEFT, B.OVERTAKE, B.CHANGE_LANE, B.BRAKE])
def test_what_is_over_at_once_has_no_duration(kind: B) -> None:
    with pytest.raises(ValidationError, match='lasts for no time'):
        Behavior(kind=kind, target='car2', duration_s=_for(5.0))


def test_nobody_ends_a_drive_in_time() -> None:
    with pytest.raises(ValidationError, match='at_most'):
        Behavior(kind=B.DRIVE, duration_s=_for(5.0, MOST))
