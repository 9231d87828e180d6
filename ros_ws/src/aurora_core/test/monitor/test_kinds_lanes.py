# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds about lanes and about yielding: satisfied, violated, not judged.

The street has two lanes along +x, at y = 0 and y = 3.3, each 3.3 m wide, with a limit of 10 m/s.
"""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from kind_rows import Row, gone
from trace_builder import FloatArray, number
from trace_cases import Case, ground_case, spec

from aurora_core.knowledge.world import CentreLine
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import AgentType, LaneSide
from aurora_core.spec.vocabulary import BehaviorKind as B

T = 401  # 20 s
TICK = np.arange(T)


def _steady(mps: float) -> FloatArray:
    return np.full(T, mps)


def _street(case: Case, lanes: int = 2) -> Case:
    case.world = replace(
        case.world,
        lanes=tuple(
            CentreLine(
                lane_id=f'a_{k}',
                street_name='',
                points=np.array([(-500.0, 3.3 * k), (1000.0, 3.3 * k)]),
                width_m=3.3,
                speed_limit_mps=10.0,
            )
            for k in range(lanes)
        ),
    )
    return case


def _changes(*ticks: int, lanes: int = 2, side: LaneSide | None = None) -> Case:
    """A car goes to the other lane at each of the ticks, first to the left."""
    behavior = Behavior(kind=B.CHANGE_LANE, side=side)
    case = _street(ground_case(behavior, _steady(5.0)), lanes)
    for tick in ticks:
        y = case.run.agents[0].y
        y[tick:] = 3.3 - y[tick:]
    return case


def _told(side: LaneSide) -> Case:
    """A car that is told at 9 s to go to a side goes to the left at 10 s."""
    case = _street(ground_case(Behavior(kind=B.DRIVE), _steady(5.0)))
    case.run.agents[0].y[200:] = 3.3
    trigger = {'on': 'time', 'at_s': number(9.0, Unit.SECOND)}
    action = {'do': 'change_lane', 'agent': 'car1', 'side': side}
    event = {'id': 'e1', 'trigger': trigger, 'action': action}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


def _run(mps: float, lanes: int = 2) -> Case:
    return _street(ground_case(Behavior(kind=B.EMERGENCY_RUN), _steady(mps)), lanes)


def _yields(own: FloatArray, other: float, x: float = -30.0, y: float = 3.3) -> Case:
    """car1 begins at 0; car2 comes from x beside it, with a steady speed."""
    behavior = Behavior(kind=B.YIELD, target='car2')
    case = ground_case(behavior, own, car2=(x, _steady(other)))
    case.run.agents[1].y[:] = y
    return case


def _lets_cross(
    own: FloatArray, walks_from_s: float, over: float = 5.0, on_m: float = 40.0
) -> Case:
    """car1 begins at 0; so far on a person walks at 1 m/s over its way, from right to left."""
    case = ground_case(Behavior(kind=B.YIELD, target='ped1'), own, ped1=(on_m, _steady(0.0)))
    person = case.spec.agents[1].model_copy(update={'type': AgentType.PEDESTRIAN})
    case.spec = case.spec.model_copy(update={'agents': (case.spec.agents[0], person)})
    case.run.agents[1].type = 'pedestrian'
    case.run.agents[1].y[:] = np.clip(0.05 * (TICK - 20 * walks_from_s) - 5.0, -5.0, over)
    return case


def _slows_to(end_mps: float, asked_mps: float = 5.0, bound: Bound = Bound.EXACTLY) -> Case:
    """From 10 m/s after 10 s."""
    asked = number(asked_mps, Unit.METRE_PER_SECOND, explicit=True)
    behavior = Behavior(kind=B.SLOW, speed_mps=asked.model_copy(update={'bound': bound}))
    return ground_case(behavior, np.where(TICK < 200, 10.0, end_mps))


SLOWS = np.where(TICK < 100, 8.0, 2.0)
WAITS = np.where(TICK < 200, 0.0, 8.0)
STOPS = np.where(TICK < 60, 8.0, np.where(TICK < 200, 0.0, 8.0))
NEVER, GONE = Reason.PREMISE_NEVER, Reason.TARGET_GONE
ROWS = (
    # 2 s are asked: from tick 200 to tick 400.
    Row(id='car1.change_lane', make=lambda: _changes(200), margin=10.0 - 2.0),
    Row(id='car1.change_lane', make=_changes, margin=0.0 - 2.0),
    # Back after 1 s: neither this nor the way back is a change that was kept.
    Row(id='car1.change_lane', make=lambda: _changes(200, 220), margin=1.0 - 2.0, what='back'),
    # Overtaken on the other lane, and back.
    Row(id='car1.change_lane', make=lambda: _changes(100, 200), margin=10.0 - 2.0, what='twice'),
    Row(id='car1.change_lane', make=lambda: _changes(200, lanes=1), reason=NEVER),
    # To the left for 10 s, to the right never, or for 5 s after 5 s on the left.
    Row(
        id='car1.change_lane',
        make=lambda: _changes(200, side=LaneSide.LEFT),
        margin=10.0 - 2.0,
        what='left',
    ),
    Row(id='car1.change_lane', make=lambda: _changes(side=LaneSide.LEFT), margin=0.0 - 2.0),
    Row(id='e1.lane', make=lambda: _told(LaneSide.LEFT), margin=10.0 - 2.0),
    Row(id='e1.lane', make=lambda: _told(LaneSide.RIGHT), margin=0.0 - 2.0, what='not-right'),
    *(
        Row(id='car1.change_lane', make=partial(_changes, 200, lanes=1, side=side), reason=NEVER)
        for side in LaneSide
    ),
    Row(
        id='car1.change_lane',
        make=lambda: _changes(200, side=LaneSide.RIGHT),
        margin=0.0 - 2.0,
        what='not-right',
    ),
    Row(
        id='car1.change_lane',
        make=lambda: _changes(200, 300, side=LaneSide.RIGHT),
        margin=5.0 - 2.0,
        what='right-at-last',
    ),
    Row(id='car1.change_lane', make=lambda: gone(_changes(200), 0, 0), reason=GONE),
    # 1 m/s above the limit is asked.
    Row(id='car1.emergency_run', make=lambda: _run(12.0), margin=2.0 - 1.0),
    Row(id='car1.emergency_run', make=lambda: _run(9.5), margin=-0.5 - 1.0),
    Row(id='car1.emergency_run', make=lambda: _run(0.0), reason=NEVER),
    Row(id='car1.emergency_run', make=lambda: _run(12.0, lanes=0), reason=NEVER, what='no-street'),
    # 5 m/s after 7 m/s, within 1 m/s; at most 5 m/s is at most 6 m/s.
    Row(id='car1.slow.speed', make=lambda: _slows_to(4.5), margin=1.0 - 0.5),
    Row(id='car1.slow.speed', make=lambda: _slows_to(7.5), margin=1.0 - 2.5),
    Row(id='car1.slow.speed', make=lambda: _slows_to(2.0), margin=1.0 - 3.0, what='too-slow'),
    Row(
        id='car1.slow.speed',
        make=lambda: _slows_to(2.0, bound=Bound.AT_MOST),
        margin=6.0 - 2.0,
        what='at-most',
    ),
    Row(id='car1.slow.speed', make=lambda: _slows_to(9.0, 9.0), reason=NEVER),
    # 2 m/s less are asked before the other one has passed.
    Row(id='car1.yield', make=lambda: _yields(SLOWS, 10.0), margin=6.0 - 2.0),
    Row(id='car1.yield', make=lambda: _yields(WAITS, 10.0), margin=8.0 - 2.0, what='waits'),
    Row(id='car1.yield', make=lambda: _yields(_steady(8.0), 14.0), margin=0.0 - 2.0),
    # It has passed at 0.6 s already, long before the brakes.
    Row(id='car1.yield', make=lambda: _yields(SLOWS, 14.0, -3.0), margin=0.0 - 2.0, what='late'),
    Row(id='car1.yield', make=lambda: _yields(_steady(0.0), 10.0), reason=NEVER),
    # 99 steps of 0.05 s at 8 m/s, then 2 m/s; the other one gains 0.4 m a step, up to 45 m.
    Row(id='car1.yield.passed', make=lambda: _yields(SLOWS, 10.0), margin=45.0, within=0.4),
    Row(id='car1.yield.passed', make=lambda: _yields(_steady(8.0), 8.0), margin=-30.0),
    # Somewhere else, or ahead all the time.
    Row(id='car1.yield.passed', make=lambda: _yields(SLOWS, 10.0, y=60.0), reason=NEVER),
    Row(
        id='car1.yield.passed',
        make=lambda: _yields(SLOWS, 10.0, 30.0),
        reason=NEVER,
        what='ahead',
    ),
    # 2 m beyond the way at 7 s, when the car has driven 59 steps and is 2.25 m long before its
    # middle; whom it does not wait for is behind it by then.
    Row(
        id='car1.yield.passed',
        make=lambda: _lets_cross(STOPS, 0.0),
        margin=40.0 - 59 * 0.4 - 2.25,
        within=0.5,
        what='on-foot',
    ),
    Row(
        id='car1.yield.passed',
        make=lambda: _lets_cross(_steady(8.0), 0.0),
        margin=40.0 - 140 * 0.4 - 2.25,
        within=0.5,
        what='not-let-cross',
    ),
    # Whoever turns round in the middle of the street has not been let over it.
    Row(
        id='car1.yield.passed',
        make=lambda: _lets_cross(STOPS, 0.0, over=1.0),
        margin=-1.0,
        what='turns-round',
    ),
    Row(id='car1.yield', make=lambda: _lets_cross(STOPS, 0.0), margin=8.0 - 2.0, what='on-foot'),
    Row(id='car1.yield', make=lambda: _lets_cross(WAITS, 0.0), margin=8.0 - 2.0, what='waits'),
    # Nobody lets anybody pass who is farther away than 45 m.
    Row(
        id='car1.yield',
        make=lambda: _lets_cross(WAITS, 0.0, on_m=60.0),
        margin=0.0 - 2.0,
        what='waits-far-away',
    ),
    Row(
        id='car1.yield',
        make=lambda: _lets_cross(STOPS, 0.0, on_m=90.0),
        margin=0.0 - 2.0,
        what='slows-far-away',
    ),
    Row(
        id='car1.yield',
        make=lambda: _lets_cross(_steady(8.0), 0.0),
        margin=0.0 - 2.0,
        what='not-let-cross',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_lane_kinds(row: Row) -> None:
    row.check()
