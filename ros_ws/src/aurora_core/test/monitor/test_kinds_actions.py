# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Every action of an event: it follows its trigger in time, too late, or is never asked for.

The event is triggered at 15 s, tick 300; 1 s is allowed.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row
from trace_builder import Flight, FloatArray, flight, number, world
from trace_cases import Case, facts_of, ground_case, hover_case, mission, spec

from aurora_core.conditions.plan_facts import MissionFacts
from aurora_core.knowledge.world import CentreLine
from aurora_core.monitor.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode

T = 401
TICK = np.arange(T)
AT_S = 15.0


def _event(case: Case, action: dict[str, object], at_s: float) -> Case:
    trigger = {'on': 'time', 'at_s': number(at_s, Unit.SECOND)}
    event = {'id': 'e1', 'trigger': trigger, 'action': action}
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


def _car(do: str, speed: FloatArray, at_s: float) -> Case:
    case = ground_case(Behavior(kind=BehaviorKind.DRIVE), speed)
    return _event(case, {'do': do, 'agent': 'car1'}, at_s)


def _loses(do: str) -> Callable[[int, float], Case]:
    """From 10 m/s with 5 m/s^2."""

    def make(tick: int, at_s: float) -> Case:
        return _car(do, np.maximum(10.0 - 0.25 * np.maximum(TICK - tick + 1, 0), 0.0), at_s)

    return make


def _gains(do: str) -> Callable[[int, float], Case]:
    """From rest with 2 m/s^2."""

    def make(tick: int, at_s: float) -> Case:
        return _car(do, 0.1 * np.maximum(TICK - tick + 1, 0), at_s)

    return make


def _changes_lane(tick: int, at_s: float) -> Case:
    case = _car('change_lane', np.full(T, 5.0), at_s)
    case.run.agents[0].y[tick:] = 3.3
    case.world = replace(
        case.world,
        lanes=tuple(
            CentreLine(
                lane_id=f'a_{k}',
                street_name='',
                points=np.array([(-10.0, 3.3 * k), (1000.0, 3.3 * k)]),
                width_m=3.3,
                speed_limit_mps=10.0,
            )
            for k in range(2)
        ),
    )
    return case


def _crosses(tick: int, at_s: float) -> Case:
    """A person steps onto the carriageway, which begins at y = 0."""
    case = _car('cross', np.full(T, 1.5), at_s)
    case.run.agents[0].x[:] = 0.0
    case.run.agents[0].y[:] = 0.075 * (TICK - tick) + 0.01
    case.world = world(streets=((-50.0, 0.0, 50.0, 7.0),))
    return case


def _flown(action: dict[str, object], one: Flight, at_s: float, *more: str) -> Case:
    case = hover_case()
    case.run.flights[:] = [one]
    missions = [mission(name, MissionMode.HOVER, target='ego') for name in ('m1', *more)]
    case.spec = spec(**{**dict(case.spec), 'missions': missions})
    case.facts = facts_of(
        *(
            MissionFacts(
                mission=m.id,
                uav='uav1',
                mode=MissionMode.HOVER,
                altitude_m=30.0,
                hover_point=(100.0, 0.0, 30.0),
                duration_s=30.0,
            )
            for m in missions
        ),
        horizon_s=70.0,
    )
    return _event(case, {'uav': 'uav1'} | action, at_s)


HOME = (100.0, 20.0)


def _lands(tick: int, at_s: float) -> Case:
    return _flown({'do': 'land'}, flight(1401, HOME, 30.0, landing=tick), at_s)


def _ascends(tick: int, at_s: float, asked_m: float = 60.0) -> Case:
    """It climbs to 30 m, and at the tick on to 60 m."""

    def path(k: int) -> tuple[float, float, float]:
        return (100.0, 0.0, 60.0 if k >= tick else 30.0)

    one = flight(1401, HOME, 30.0, path, landing=900)
    return _flown({'do': 'ascend', 'altitude_m': number(asked_m)}, one, at_s)


def _next_mission(tick: int, at_s: float) -> Case:
    one = flight(1401, HOME, 30.0, landing=900, later=(tick,))
    return _flown({'do': 'change_mission', 'mission': 'm2'}, one, at_s, 'm2')


ACTIONS: dict[str, Callable[[int, float], Case]] = {
    **{do: _loses(do) for do in ('brake', 'stop', 'slow', 'yield')},
    **{do: _gains(do) for do in ('accelerate', 'start')},
    'change_lane': _changes_lane,
    'cross': _crosses,
    'land': _lands,
    'ascend': _ascends,
    'change_mission': _next_mission,
}


def _rows(do: str, make: Callable[[int, float], Case]) -> tuple[Row, ...]:
    return (
        Row(id='e1.within', make=lambda: make(310, AT_S), margin=1.0 - 0.5, what=do),
        Row(id='e1.within', make=lambda: make(360, AT_S), margin=1.0 - 3.0, what=do),
        Row(
            id='e1.within',
            make=lambda: make(310, 99.0),
            reason=Reason.PREMISE_NEVER,
            what=do,
        ),
    )


ROWS = (
    *(row for do, make in ACTIONS.items() for row in _rows(do, make)),
    # 2 m or 3 % are allowed: 2.1 m of 70 m.
    Row(id='e1.altitude', make=lambda: _ascends(310, AT_S), margin=2.0, within=0.05),
    Row(
        id='e1.altitude',
        make=lambda: _ascends(310, AT_S, 70.0),
        margin=2.1 - 10.0,
        within=0.05,
    ),
    # It had begun to climb, to cross, to fly the mission before: that is not what was asked.
    Row(
        id='e1.within', make=lambda: _crosses(200, AT_S), margin=1.0 - 5.05, what='crossed-before'
    ),
    Row(
        id='e1.within',
        make=lambda: _next_mission(250, AT_S),
        margin=1.0 - 1101 * 0.05,
        what='flown-before',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_action_kinds(row: Row) -> None:
    row.check()
