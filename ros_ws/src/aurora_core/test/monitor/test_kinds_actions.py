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
from action_cases import (
    AT_S,
    HOME,
    TICK,
    T,
    ascends,
    changed,
    lands,
    never_due,
    to_speed,
    told_car,
    told_uav,
)
from kind_rows import Row, cut, stated
from trace_builder import flight, number, world
from trace_cases import Case, ground_case, spec

from aurora_core.knowledge.world import CentreLine
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind


def _loses(do: str) -> Callable[[int, float], Case]:
    """From 10 m/s with 5 m/s^2."""

    def make(tick: int, at_s: float) -> Case:
        return told_car(do, np.maximum(10.0 - 0.25 * np.maximum(TICK - tick + 1, 0), 0.0), at_s)

    return make


def _gains(do: str) -> Callable[[int, float], Case]:
    """From rest with 10 m/s^2: at the tick it has set off."""

    def make(tick: int, at_s: float) -> Case:
        return told_car(do, np.minimum(0.51 * np.maximum(TICK - tick + 1, 0), 12.0), at_s)

    return make


def _changes_lane(tick: int, at_s: float, back: int = T, lanes: int = 2) -> Case:
    case = told_car('change_lane', np.full(T, 5.0), at_s)
    case.run.agents[0].y[tick:back] = 3.3
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
            for k in range(lanes)
        ),
    )
    return case


def _slides(tick: int) -> Case:
    """It takes 3 s to get to the other lane, which shows after the tick."""
    case = _changes_lane(T, AT_S)
    case.run.agents[0].y[:] = np.clip(3.3 / 60 * (TICK - tick), 0.0, 3.3)
    return case


def _waits() -> Case:
    """It stands from 14 s to 18 s."""
    case = _changes_lane(365, AT_S)
    case.run.agents[0].speed[280:360] = 0.0
    at_s = number(AT_S, Unit.SECOND, explicit=True)
    return changed(case, trigger={'on': 'time', 'at_s': at_s})


def _crosses(tick: int, at_s: float) -> Case:
    """A person steps onto the carriageway, which begins at y = 0: 0.5 s are allowed for that."""
    case = told_car('cross', np.full(T, 1.5), at_s)
    case.run.agents[0].x[:] = 0.0
    case.run.agents[0].y[:] = 0.075 * (TICK - tick) + 0.01
    case.world = world(streets=((-50.0, 0.0, 50.0, 7.0),))
    return case


def _sets_out(stands_s: float | None = None) -> Case:
    """A person stands 3 m from the carriageway up to 15 s, and is on it 2 s later.

    He does so for a time of his own, or until an event says that he crosses.
    """
    case = _crosses(340, AT_S)
    person = case.run.agents[0]
    person.speed[:300], person.y[:300] = 0.0, person.y[300]
    if stands_s is None:
        return case
    lasts = number(stands_s, Unit.SECOND, explicit=True)
    waits = Behavior(kind=BehaviorKind.WAIT, duration_s=lasts)
    agents = (dict(case.spec.agents[0]) | {'behaviors': (waits,)},)
    case.spec = spec(**{**dict(case.spec), 'agents': agents})
    trigger = {'on': 'behavior_done', 'who': 'car1', 'behavior': BehaviorKind.WAIT}
    return changed(case, trigger=trigger)


def _returns(tick: int, at_s: float, away_m: float = 0.0) -> Case:
    """It is told to return, and comes down over its start or `away_m` east of it."""
    one = flight(1401, HOME, 30.0, lambda _k: (HOME[0] + away_m, HOME[1], 30.0), landing=tick)
    return told_uav({'do': 'return_home'}, one, at_s)


def _next_mission(tick: int, at_s: float) -> Case:
    one = flight(1401, HOME, 30.0, landing=900, later=(tick,))
    return told_uav({'do': 'change_mission', 'mission': 'm2'}, one, at_s, 'm2')


def _untold(case: Case) -> Case:
    return changed(case, trigger=None)


def _stands() -> Case:
    return told_car('stop', np.zeros(T), AT_S)


def _after_2_s(case: Case) -> Case:
    return changed(case, delay_s=number(2.0, Unit.SECOND, explicit=True))


def _waits_5_s(do: str, tick: int, *, at_junction: bool = False) -> Case:
    """It is to wait 5 s, until 20 s, and slows down with 5 m/s^2 from the tick on."""
    speed = np.maximum(10.0 - 0.25 * np.maximum(np.arange(500) - tick + 1, 0), 0.0)
    case = changed(told_car(do, speed, AT_S), delay_s=number(5.0, Unit.SECOND, explicit=True))
    if at_junction:
        lane = CentreLine(
            lane_id='a_0',
            street_name='',
            points=np.array([(-100.0, 0.0), (180.0, 0.0)]),
            width_m=3.3,
            speed_limit_mps=10.0,
        )
        case.world = replace(case.world, lanes=(lane,))
    return case


def _waiting(do: str, tick: int) -> Callable[[], Case]:
    return lambda: _waits_5_s(do, tick)


def _sets_off(tick: int) -> Case:
    """It has to stand until 15 s."""
    return _gains('start')(tick, AT_S)


def _starts_again(tick: int, do: str = 'stop') -> Case:
    """It stops, or brakes, at 5 s and is to start again 10 s after it stands, which is at 7 s."""
    stands = np.maximum(10.0 - 0.25 * np.maximum(TICK - 100, 0), 0.0)
    case = ground_case(Behavior(kind=BehaviorKind.DRIVE), np.where(tick <= TICK, 5.0, stands))
    stop = {
        'id': 'e0',
        'trigger': {'on': 'time', 'at_s': number(5.0, Unit.SECOND)},
        'action': {'do': do, 'agent': 'car1'},
    }
    start = {
        'id': 'e1',
        'trigger': {'on': 'event_done', 'event': 'e0', 'after_s': number(8.0, Unit.SECOND)},
        'action': {'do': 'start', 'agent': 'car1'},
    }
    case.spec = spec(**{**dict(case.spec), 'events': (stop, start)})
    return case


def _yields(speed_mps: float, *, triggered: bool = True) -> Case:
    """car1 stands or drives; car2 comes from 50 m behind with 5 m/s and may get ahead."""
    speed = np.full(T, speed_mps)
    case = ground_case(Behavior(kind=BehaviorKind.DRIVE), speed, car2=(-50.0, np.full(T, 5.0)))
    event = {
        'id': 'e1',
        'trigger': {
            'on': 'distance_below',
            'a': 'car1',
            'b': 'car2',
            'value_m': number(60.0 if triggered else 0.001),
        },
        'action': {'do': 'yield', 'agent': 'car1'},
    }
    case.run.agents[1].y[:] = 1.0
    case.spec = spec(**{**dict(case.spec), 'events': (event,)})
    return case


ACTIONS: dict[str, Callable[[int, float], Case]] = {
    **{do: _loses(do) for do in ('brake', 'stop', 'slow', 'yield')},
    **{do: _gains(do) for do in ('accelerate', 'start')},
    'change_lane': _changes_lane,
    'cross': _crosses,
    'land': lands,
    'return_home': _returns,
    'ascend': ascends,
    'change_mission': _next_mission,
}


def _rows(do: str, make: Callable[[int, float], Case]) -> tuple[Row, ...]:
    most_s = 0.5 if do == 'cross' else 1.0
    return (
        Row(id='e1.within', make=lambda: make(310, AT_S), margin=most_s - 0.5, what=do),
        Row(id='e1.within', make=lambda: make(360, AT_S), margin=most_s - 3.0, what=do),
        Row(
            id='e1.within',
            make=lambda: make(310, 99.0),
            reason=Reason.PREMISE_NEVER,
            what=do,
        ),
    )


NEVER = Reason.PREMISE_NEVER
# Down it goes with 0.1 m per tick, and 0.6 of 3 m/s need 8.3 s for 15 m.
DESCENDED = (
    Row(id='e1.within', make=lambda: ascends(310, AT_S, 15.0, 15.0), margin=0.5, what='descends'),
    Row(
        id='e1.within',
        make=lambda: ascends(310, AT_S, 15.0),
        margin=1.0 - 29.95,
        within=0.2,
        what='climbs-instead',
    ),
    Row(
        id='e1.completed',
        make=lambda: ascends(310, AT_S, 15.0, 15.0),
        margin=2.0 - (7.0 - 15.0 / 1.8),
        within=0.06,
        what='descends',
    ),
)
# It is within 2 m of 60 m after 140 steps of 0.2 m; 0.6 of 5 m/s need 10 s, 13.3 s to 70 m.
CLIMBED = (
    Row(
        id='e1.completed',
        make=lambda: ascends(310, AT_S),
        margin=2.0 - (7.5 - 10.0),
        within=0.06,
        what='climb',
    ),
    Row(
        id='e1.completed',
        make=lambda: ascends(310, AT_S, 70.0),
        margin=2.0 - (1101 * 0.05 - 40.0 / 3.0),
        within=0.06,
        what='climb',
    ),
    Row(id='e1.completed', make=lambda: ascends(310, 99.0), reason=NEVER, what='climb'),
)
# Told to wait 8 s: who climbs after 1 s, and for 7.5 s, has not waited.
WAIT_S = number(8.0, Unit.SECOND, explicit=True)
CLIMBED_LATER = tuple(
    Row(id='e1.within', make=make, margin=9.0 - waited_s, what='climb-after-a-wait')
    for make, waited_s in (
        (lambda: changed(ascends(462, AT_S), delay_s=WAIT_S), 8.1),
        (lambda: changed(ascends(320, AT_S), delay_s=WAIT_S), 1101 * 0.05),
    )
)


def _stops_by(latest_s: float) -> Case:
    """It slows down at 5 s and stands from 17.65 s on; nobody says when it has to begin."""
    speed = np.maximum(10.0 - 0.1 * np.maximum(TICK - 100, 0), 8.0)
    case = changed(told_car('stop', np.where(TICK > 352, 0.0, speed), AT_S), trigger=None)
    return stated(case, 'event_time', ('e1',), '<=', latest_s)


STOPPED_BY = (
    Row(id='c1.holds', make=lambda: _stops_by(25.0), margin=25.0 - 17.65, what='stops-by'),
    Row(id='c1.holds', make=lambda: _stops_by(15.0), margin=15.0 - 17.65, what='stops-by'),
)
# 3 m are allowed.
RETURNED = (
    Row(id='e1.returned', make=lambda: _returns(310, AT_S, 2.0), margin=3.0 - 2.0),
    Row(id='e1.returned', make=lambda: _returns(310, AT_S, 9.0), margin=3.0 - 9.0),
    Row(id='e1.returned', make=lambda: _returns(1390, AT_S), reason=NEVER),
    Row(id='e1.returned', make=lambda: cut(_returns(310, AT_S), 350), reason=Reason.TRACE_SHORT),
)
# Without facts of its type an agent has 1.5 m/s^2; 2 s more are allowed.
ALLOWED_S, RATE = 2.0, 1.5


def _completed(make: Callable[[], Case], took_s: float, change_mps: float, what: str) -> Row:
    """An action that takes some seconds for a change of speed."""
    margin = ALLOWED_S - (took_s - change_mps / RATE)
    return Row(id='e1.completed', make=make, margin=margin, within=0.06, what=what)


# With 5 m/s^2 from 15 s on; the run ends at 20 s.
COMPLETED = (
    _completed(lambda: to_speed('stop', 0.0), 2.0, 10.0, 'stop'),
    # Within 1 m/s of 4 m/s; to half of 10 m/s; 4 m/s more.
    _completed(lambda: to_speed('slow', 4.0, 4.0), 1.0, 6.0, 'slow-to'),
    _completed(lambda: to_speed('slow', 5.0), 1.0, 5.0, 'slow-half'),
    _completed(lambda: to_speed('accelerate', 14.0), 0.8, 4.0, 'gain'),
    _completed(lambda: to_speed('brake', 5.0, 5.0), 0.8, 5.0, 'brake-to'),
    _completed(lambda: to_speed('slow', 9.5, 8.0), 5.05, 2.0, 'slow-never'),
    # 3 s are needed to change lane.
    Row(id='e1.completed', make=lambda: _changes_lane(310, AT_S), margin=ALLOWED_S - (0.5 - 3.0)),
    Row(id='e1.completed', make=lambda: _changes_lane(T, AT_S), margin=ALLOWED_S - (5.05 - 3.0)),
    Row(id='e1.completed', make=lambda: _changes_lane(310, 99.0), reason=NEVER, what='lane'),
    _completed(lambda: to_speed('start', 1.0, 2.5, from_mps=0.0), 5.05, 2.5, 'start-never'),
    # There was no time left for it.
    Row(id='e1.completed', make=lambda: to_speed('stop', 1.0), margin=-0.05, what='stop-short'),
    Row(id='e1.completed', make=lambda: never_due('stop', 0.0), reason=NEVER),
    # Without a trigger it may come at any time, but who stands all along has not stopped.
    Row(id='e1.completed', make=lambda: _untold(to_speed('stop', 0.0)), margin=2.0, what='untold'),
    Row(id='e1.completed', make=lambda: _untold(_stands()), reason=NEVER, what='stands'),
    Row(id='e1.happens', make=lambda: _untold(_stands()), reason=NEVER, what='stands'),
    # Who stands when it is told to stop has nothing to do.
    Row(id='e1.within', make=_stands, margin=1.0, what='stands'),
)
# 2 s are asked on the other lane.
LANE = (
    Row(id='e1.within', make=lambda: _slides(310), margin=1.0 - 0.55, what='slides'),
    Row(id='e1.within', make=lambda: _slides(320), margin=1.0 - 1.05, what='slides'),
    # That it stands when it is due, or has no other lane, excuses nobody.
    Row(id='e1.within', make=_waits, margin=1.0 - 3.25, what='waits'),
    Row(id='e1.time', make=_waits, margin=0.5 - 3.25, what='waits'),
    Row(id='e1.completed', make=lambda: _slides(310), margin=2.0 - 0.2, what='slides'),
    Row(id='e1.lane', make=lambda: _changes_lane(310, AT_S), margin=4.5 - 2.0),
    Row(id='e1.lane', make=lambda: _changes_lane(310, AT_S, back=330), margin=1.0 - 2.0),
    Row(id='e1.lane', make=lambda: _changes_lane(T, AT_S), margin=0.0 - 2.0, what='never'),
    Row(id='e1.lane', make=lambda: _changes_lane(310, 99.0), reason=NEVER),
    *(
        Row(id=name, make=lambda: _changes_lane(T, AT_S, lanes=1), margin=margin, what='one-lane')
        for name, margin in (('e1.lane', -2.0), ('e1.within', 1.0 - 2.05), ('e1.completed', -0.05))
    ),
)
# It has to stand until 15 s, or from when it has stopped until it is to start again.
SET_OFF = (
    Row(id='e1.at_rest', make=lambda: _sets_off(310), margin=0.1),
    Row(id='e1.at_rest', make=lambda: _sets_off(296), margin=0.1 - 0.51 * 5),
    Row(id='e1.at_rest', make=lambda: _gains('start')(310, 99.0), reason=NEVER),
    Row(id='e1.at_rest', make=lambda: _starts_again(305), margin=0.1, what='again'),
    Row(id='e1.at_rest', make=lambda: _starts_again(250), margin=0.1 - 5.0, what='again'),
    Row(id='e1.at_rest', make=lambda: _starts_again(305, 'brake'), margin=0.1, what='brakes'),
    Row(id='e1.not_before', make=lambda: _sets_off(296), margin=-0.2, what='start'),
)
# 2 s after the trigger: at once is too early, and braking that goes on is none that begins.
DELAYED = (
    Row(
        id='e1.within',
        make=lambda: _after_2_s(to_speed('brake', 0.0)),
        margin=3.0 - 5.05,
        within=0.06,
        what='delayed-at-once',
    ),
    Row(
        id='e1.within',
        make=lambda: _after_2_s(_loses('brake')(345, AT_S)),
        margin=3.0 - 2.25,
        within=0.06,
        what='delayed',
    ),
    *(
        Row(id='e1.waits', make=_waiting(do, 400), margin=0.05, what=do)
        for do in ('stop', 'slow', 'brake')
    ),
    # It stands after 2 s, drives half as fast after 1 s, brakes at once.
    *(
        Row(
            id='e1.waits',
            make=_waiting(do, 310),
            margin=0.5 + took_s - 4.5,
            within=0.06,
            what=f'{do}-at-once',
        )
        for do, took_s in (('stop', 2.0), ('slow', 0.95), ('brake', 0.0))
    ),
    # It slows down for the junction, and what it did before it was told is no action.
    Row(
        id='e1.waits',
        make=lambda: _waits_5_s('stop', 310, at_junction=True),
        margin=0.05,
        what='junction',
    ),
    Row(id='e1.waits', make=lambda: _waits_5_s('stop', 100), margin=0.05, what='stood-before'),
    Row(
        id='e1.waits',
        make=lambda: changed(
            _waits_5_s('stop', 310), trigger={'on': 'time', 'at_s': number(99.0, Unit.SECOND)}
        ),
        reason=NEVER,
    ),
)

ROWS = (
    *(row for do, make in ACTIONS.items() for row in _rows(do, make)),
    # 2 m or 3 % are allowed: 2.1 m of 70 m.
    Row(id='e1.altitude', make=lambda: ascends(310, AT_S), margin=2.0, within=0.05),
    Row(
        id='e1.altitude',
        make=lambda: ascends(310, AT_S, 70.0),
        margin=2.1 - 10.0,
        within=0.05,
    ),
    *COMPLETED,
    *CLIMBED,
    *CLIMBED_LATER,
    *STOPPED_BY,
    *DESCENDED,
    *RETURNED,
    *LANE,
    *SET_OFF,
    *DELAYED,
    Row(id='e1.passed', make=lambda: _yields(0.0), margin=50.0, within=0.3),
    Row(id='e1.passed', make=lambda: _yields(5.0), margin=-50.0, within=0.3),
    Row(id='e1.passed', make=lambda: _yields(0.0, triggered=False), reason=NEVER),
    # It had begun to climb, to cross, to fly the mission before: that is not what was asked.
    Row(
        id='e1.within', make=lambda: _crosses(200, AT_S), margin=0.5 - 5.05, what='crossed-before'
    ),
    # Who sets off then is not on the road then; whose own wait is over has done what was asked.
    Row(id='e1.within', make=_sets_out, margin=0.5 - 2.0, what='sets-out'),
    Row(
        id='e1.within',
        make=lambda: _sets_out(14.9),
        margin=1.0 - 0.35,
        what='sets-out-after-a-wait',
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
