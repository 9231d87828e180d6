# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of conditions on braking, headways and climbs: satisfied, violated, not judged."""

from __future__ import annotations

from functools import partial

import numpy as np
import pytest
from kind_rows import Row, cut, gone, stated
from trace_builder import flight, number
from trace_cases import Case, ground_case, hover_case, spec

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind

T = 401
TICK = np.arange(T)
NEVER, GONE = Reason.PREMISE_NEVER, Reason.TARGET_GONE
DRIVE = Behavior(kind=BehaviorKind.DRIVE)


def _slows(rate_mps2: float, end_mps: float = 0.0) -> np.ndarray:
    """From 10 m/s from tick 301 on."""
    return np.maximum(10.0 - rate_mps2 * 0.05 * np.maximum(TICK - 300, 0), end_mps)


def _brakes(
    rate_mps2: float,
    asked_mps2: float,
    do: str = 'brake',
    bound: Bound = Bound.EXACTLY,
    *,
    end_mps: float = 0.0,
    value_mps: float | None = None,
    at_s: float = 15.0,
) -> Case:
    case = ground_case(DRIVE, _slows(rate_mps2, end_mps))
    hard = number(asked_mps2, Unit.METRE_PER_SECOND_SQUARED, explicit=True, bound=bound)
    action = {'do': do, 'agent': 'car1', 'deceleration_mps2': hard}
    if value_mps is not None:
        action['value_mps'] = number(value_mps, Unit.METRE_PER_SECOND, explicit=True)
    trigger = {'on': 'time', 'at_s': number(at_s, Unit.SECOND)}
    event = {'id': 'e1', 'trigger': trigger, 'action': action}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


def _hardest(op: str, value: float) -> Case:
    """Its hardest braking is with 5 m/s^2."""
    return stated(ground_case(DRIVE, _slows(5.0)), 'deceleration', ('car1',), op, value)


# `==` is within 0.3 m/s^2 or 10 %.
BRAKING = (
    Row(id='e1.deceleration', make=lambda: _brakes(3.0, 3.0), margin=0.3),
    Row(id='e1.deceleration', make=lambda: _brakes(6.0, 3.0), margin=0.3 - 3.0),
    Row(id='e1.deceleration', make=lambda: _brakes(3.0, 3.0, at_s=99.0), reason=NEVER),
    Row(
        id='e1.deceleration',
        make=lambda: _brakes(5.0, 5.2, 'stop'),
        margin=0.52 - 0.2,
        what='stop',
    ),
    Row(
        id='e1.deceleration',
        make=lambda: _brakes(4.0, 5.0, 'stop', Bound.AT_LEAST),
        margin=4.0 - 5.0,
        what='too-weakly',
    ),
    Row(
        id='e1.deceleration',
        make=lambda: _brakes(2.0, 1.5, 'slow', Bound.AT_MOST, end_mps=4.0, value_mps=4.0),
        margin=1.5 - 2.0,
        what='slow',
    ),
    # With 1 m/s^2 it takes 6 s to 4 m/s: as asked, and no delay.
    Row(
        id='e1.completed',
        make=lambda: _brakes(2.0, 2.0, 'slow', end_mps=4.0, value_mps=4.0),
        margin=2.0 - (2.5 - 6.0 / 1.7),
        within=0.06,
        what='as-gently',
    ),
    Row(id='c1.holds', make=lambda: _hardest('<=', 6.0), margin=6.0 - 5.0),
    Row(id='c1.holds', make=lambda: _hardest('<=', 3.0), margin=3.0 - 5.0),
    Row(id='c1.holds', make=lambda: _hardest('>=', 5.5), margin=5.0 - 5.5, what='at-least'),
    Row(id='c1.holds', make=lambda: gone(_hardest('<=', 6.0), 0, 0), reason=GONE),
)


def _behind(
    own_mps: np.ndarray | float, lead_mps: float, gap_m: float, **behavior: object
) -> Case:
    """car1 drives so far behind car2, bumper to bumper."""
    own = np.broadcast_to(np.asarray(own_mps, dtype=float), (T,)).copy()
    does = Behavior.model_validate({'kind': BehaviorKind.DRIVE, **behavior})
    return ground_case(does, own, car2=(gap_m + LENGTH_M, np.full(T, lead_mps)))


def _keeps(gap_m: float, asked_s: float, bound: Bound = Bound.EXACTLY, mps: float = 10.0) -> Case:
    """It follows at 10 m/s."""
    asked = number(asked_s, Unit.SECOND, explicit=True, bound=bound)
    return _behind(mps, mps, gap_m, kind=BehaviorKind.FOLLOW, target='car2', headway_s=asked)


def _headway(gap_m: float, op: str, value: float, **more: float) -> Case:
    return stated(_behind(10.0, 10.0, gap_m), 'time_headway', ('car1', 'car2'), op, value, **more)


def _closes(op: str, value: float, lead_mps: float = 8.0, gap_m: float = 50.0) -> Case:
    """At 10 m/s behind one at 8 m/s: from 50 m to 10 m in 20 s."""
    case = _behind(10.0, lead_mps, gap_m)
    return stated(case, 'time_to_collision', ('car1', 'car2'), op, value)


def _answers(on: str, threshold_s: float, tick: int) -> Case:
    """The same pair: 20 m behind at 15 s it is to brake, and does so from the tick on."""
    own = np.maximum(10.0 - 0.25 * np.maximum(TICK - tick + 1, 0), 0.0)
    case = _behind(own, 8.0, 50.0)
    limit = number(threshold_s, Unit.SECOND, explicit=True)
    trigger = {'on': on, 'a': 'car1', 'b': 'car2', 'value_s': limit}
    event = {'id': 'e1', 'trigger': trigger, 'action': {'do': 'brake', 'agent': 'car1'}}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


# Of two cars, half of each.
LENGTH_M = 4.5
HEADWAYS = (
    *(
        Row(
            id='e1.within',
            make=partial(_answers, on, limit_s, 300 + late),
            margin=1.0 - 0.05 * late,
            within=0.16,
            what=on,
        )
        for on, limit_s in (('headway_below', 2.0), ('ttc_below', 10.0))
        for late in (6, 30)
    ),
    Row(id='car1.follow.headway', make=lambda: _keeps(15.0, 1.5), margin=1.0 - 0.8),
    Row(id='car1.follow.headway', make=lambda: _keeps(15.0, 0.8), margin=0.0 - 0.8),
    Row(
        id='car1.follow.headway',
        make=lambda: _keeps(20.0, 2.5, Bound.AT_LEAST),
        margin=0.0 - 0.8,
        what='too-close',
    ),
    Row(id='car1.follow.headway', make=lambda: _keeps(15.0, 1.5, mps=0.0), reason=NEVER),
    Row(id='c1.holds', make=lambda: _headway(15.0, '>=', 1.0), margin=1.5 - 1.0, what='headway'),
    Row(id='c1.holds', make=lambda: _headway(15.0, '>=', 2.0), margin=1.5 - 2.0, what='headway'),
    Row(id='c1.holds', make=lambda: _headway(15.0, '<=', 2.0), margin=2.0 - 1.5, what='near'),
    Row(id='c1.holds', make=lambda: _headway(15.0, '<=', 1.0), reason=NEVER, what='near'),
    Row(
        id='c1.holds',
        make=lambda: gone(_headway(15.0, '>=', 1.0), 1, 0),
        reason=GONE,
        what='headway',
    ),
    Row(id='c1.holds', make=lambda: _closes('>=', 4.0), margin=5.0 - 4.0, what='ttc'),
    Row(id='c1.holds', make=lambda: _closes('>=', 6.0), margin=5.0 - 6.0, what='ttc'),
    Row(id='c1.holds', make=lambda: gone(_closes('>=', 4.0), 1, 0), reason=GONE, what='ttc'),
    # Who falls back never collides.
    Row(
        id='c1.holds',
        make=lambda: _closes('>=', 6.0, 12.0),
        margin=100.0 - 6.0,
        what='falls-back',
    ),
)


def _climbs(
    rate_mps: float, asked_mps: float, bound: Bound = Bound.EXACTLY, at_s: float = 15.0
) -> Case:
    """It climbs to 30 m, and from 15 s on goes to 60 m."""

    def path(k: int) -> tuple[float, float, float]:
        return (100.0, 0.0, min(60.0, 30.0 + rate_mps * 0.05 * max(0, k - 300)))

    case = hover_case()
    case.run.flights[:] = [flight(1401, (100.0, 20.0), 30.0, path, landing=1300)]
    asked = number(asked_mps, Unit.METRE_PER_SECOND, explicit=True, bound=bound)
    action = {'do': 'ascend', 'uav': 'uav1', 'altitude_m': number(60.0), 'vertical_mps': asked}
    trigger = {'on': 'time', 'at_s': number(at_s, Unit.SECOND)}
    event = {'id': 'e1', 'trigger': trigger, 'action': action}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


def _vertical(op: str, value: float) -> Case:
    """From its capture on it goes neither up nor down."""
    return stated(hover_case(), 'vertical_speed', ('uav1',), op, value)


CLIMBS = (
    Row(id='e1.vertical_speed', make=lambda: _climbs(1.5, 1.5), margin=0.3, within=0.05),
    Row(id='e1.vertical_speed', make=lambda: _climbs(3.0, 1.5), margin=0.3 - 1.5, within=0.1),
    Row(id='e1.vertical_speed', make=lambda: _climbs(1.5, 1.5, at_s=99.0), reason=NEVER),
    Row(
        id='e1.vertical_speed',
        make=lambda: _climbs(1.0, 2.0, Bound.AT_LEAST),
        margin=1.0 - 2.0,
        within=0.05,
        what='too-slowly',
    ),
    # With 1 m/s it needs its half minute.
    Row(
        id='e1.completed',
        make=lambda: _climbs(1.0, 1.0),
        margin=2.0 - (28.0 - 30.0 / 0.7),
        within=0.1,
        what='as-slowly',
    ),
    Row(id='c1.holds', make=lambda: _vertical('<=', 2.0), margin=2.0, within=0.1, what='level'),
    Row(
        id='c1.holds',
        make=lambda: _vertical('>=', 0.5),
        margin=0.0 - 0.5,
        within=0.1,
        what='level',
    ),
    Row(
        id='c1.holds',
        make=lambda: cut(_vertical('<=', 2.0), 100),
        reason=Reason.TRACE_SHORT,
        what='level',
    ),
)

ROWS = (*BRAKING, *HEADWAYS, *CLIMBS)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_kinds_of_dynamics(row: Row) -> None:
    row.check()
