# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which samples a condition is about: several missions, two UAVs, a place as target."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, grounded, stated
from trace_builder import Run, building, driver, flight, number, world
from trace_cases import Case, agent, facts_of, hover_case, judge, mission, result, spec

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Span, Unit
from aurora_core.spec.scenario import Uav, UavMission
from aurora_core.spec.vocabulary import MissionMode

T = 1401
FIRST, SECOND, LANDING = (100.0, 0.0), (140.0, 0.0), 1000
FIRST_SPAN, SECOND_SPAN = Span(start=0, end=20), Span(start=20, end=40)
CITY_HALL = 'landmark:City Hall'


def _facts(id: str, mode: MissionMode, **values: object) -> MissionFacts:
    base = {'mission': id, 'uav': 'uav1', 'mode': mode, 'altitude_m': 30.0, 'duration_s': 20.0}
    return MissionFacts.model_validate(base | values)


def two_missions(second_altitude: float = 30.0, *, begins: int = 600) -> Case:
    """Hovers at (100, 0), from tick `begins` on follows car1, which stands at (140, 0)."""

    def path(k: int) -> tuple[float, float, float]:
        x, y = FIRST if k < begins else SECOND
        return x, y, 30.0 if k < begins else second_altitude

    one = flight(T, FIRST, 30.0, path, landing=LANDING, later=(begins,))
    car = driver('car1', 'car', SECOND[0], np.zeros(T))
    request = spec(
        agents=(agent('car1', 'car'),),
        uavs=(Uav(id='uav1'),),
        missions=(
            mission('m1', MissionMode.HOVER, span=FIRST_SPAN),
            mission(
                'm2',
                MissionMode.TRACK,
                target='car1',
                span=SECOND_SPAN,
                altitude_m=number(second_altitude),
            ),
        ),
    )
    facts = facts_of(
        _facts('m1', MissionMode.HOVER, hover_point=(*FIRST, 30.0)),
        _facts('m2', MissionMode.TRACK, altitude_m=second_altitude, standoff_m=0.0),
        horizon_s=70.0,
    )
    return Case(
        spec=request,
        facts=facts,
        world=world(),
        run=Run(ticks=T, agents=[car], flights=[one]),
    )


def _ordered(first: str, then: str, *, at_s: float = 10.0, goal_m: float = 40.0) -> Case:
    """The car is told to stand at a time; after its missions the UAV climbs; in an order."""
    case = two_missions(40.0)
    stands = {
        'id': 'e1',
        'trigger': {'on': 'time', 'at_s': number(at_s, Unit.SECOND)},
        'action': {'do': 'stop', 'agent': 'car1'},
    }
    climbs = {
        'id': 'e2',
        'trigger': {'on': 'mission_done', 'uav': 'uav1'},
        'action': {'do': 'ascend', 'uav': 'uav1', 'altitude_m': number(goal_m)},
    }
    order = {'id': 'o1', 'first': first, 'then': then}
    case.spec = spec(**{**dict(case.spec), 'events': (stands, climbs), 'orders': (order,)})
    return case


def _climbs_first() -> Case:
    """The UAV is 40 m high at tick 500 already, 100 ticks before its first mission ends."""
    case = _ordered('m1', 'e2')
    case.run.flights[0].states[500, 2] = 40.0
    return case


def _said(case: Case, span: Span) -> Case:
    """The condition c1 stands in this clause."""
    (one,) = case.spec.conditions
    case.spec = spec(**{**dict(case.spec), 'conditions': (dict(one) | {'span': span},)})
    return case


def _altitude(op: str, value: float, **more: float) -> Case:
    return stated(two_missions(40.0), 'altitude', ('uav1',), op, value, **more)


def _car(quantity: str, op: str, value: float) -> Case:
    return stated(two_missions(40.0), quantity, ('uav1', 'car1'), op, value)


def _seen_from_both() -> Case:
    case = stated(two_missions(), 'visible_time', ('uav1', CITY_HALL), '>=', 30.0)
    case.world = replace(world(), places=(NamedPlace(name=CITY_HALL, x_m=120.0, y_m=30.0),))
    return case


def _two_uavs(apart_m: float, *, second_lands: int = 700) -> Case:
    """uav1 hovers at (100, 0); uav2 hovers beside it, up to tick `second_lands`."""
    case = hover_case()
    second = flight(
        T,
        (100.0 + apart_m, 20.2),
        30.0,
        lambda _k: (100.0 + apart_m, 0.0, 30.0),
        landing=second_lands,
        id='uav2',
    )
    case.run.flights.append(second)
    (first,) = case.spec.missions
    other = UavMission.model_validate(dict(first) | {'id': 'm2', 'uav': 'uav2'})
    (facts,) = case.facts.missions
    point = (100.0 + apart_m, 0.0, 30.0)
    case.facts = facts_of(
        facts,
        MissionFacts.model_validate(
            dict(facts) | {'mission': 'm2', 'uav': 'uav2', 'hover_point': point}
        ),
        horizon_s=70.0,
    )
    case.spec = spec(
        **{
            **dict(case.spec),
            'uavs': ({'id': 'uav1'}, {'id': 'uav2'}),
            'missions': (first, other),
        }
    )
    return case


def _closes_in(tick: int | None) -> Case:
    """uav2 may come within 4 m of uav1 at a tick; 10 m are asked."""
    case = _two_uavs(30.0)
    if tick is not None:
        x, y, z = case.run.flights[0].states[tick, :3]
        case.run.flights[1].states[tick, :3] = (x + 4.0, y, z)
    return stated(case, 'separation', ('uav1', 'uav2'), '>=', 10.0)


def _second_on_ground() -> Case:
    case = _closes_in(None)
    second = case.run.flights[1]
    second.states[:], second.commands[:] = second.states[0], 0.0
    return case


def _over_city_hall(*, hidden: bool = False) -> Case:
    """The UAV hovers 30 m above City Hall, or beside it and behind a tower."""
    case = hover_case()
    (one,) = case.spec.missions
    case.spec = spec(**{**dict(case.spec), 'missions': (dict(one) | {'target': CITY_HALL},)})
    y = -60.0 if hidden else 0.0
    towers = (building(80.0, -40.0, 120.0, -30.0, 80.0),) if hidden else ()
    place = NamedPlace(name=CITY_HALL, x_m=100.0, y_m=y)
    case.world = replace(world(buildings=towers), places=(place,))
    return case


def _tracks_city_hall(y: float) -> Case:
    """The UAV holds above (100, 0); City Hall, which it tracks, is at (100, y)."""
    case = _over_city_hall()
    case.spec = spec(
        uavs=case.spec.uavs,
        agents=case.spec.agents,
        missions=(mission('m1', MissionMode.TRACK, target=CITY_HALL),),
    )
    case.facts = facts_of(_facts('m1', MissionMode.TRACK, standoff_m=0.0), horizon_s=70.0)
    place = NamedPlace(name=CITY_HALL, x_m=100.0, y_m=y)
    case.world = replace(world(), places=(place,))
    return case


def _to_city_hall(op: str, value: float, **more: float) -> Case:
    pair = ('uav1', CITY_HALL)
    return stated(_over_city_hall(), 'horizontal_distance', pair, op, value, **more)


EMPTY = Reason.EMPTY_PHASE
# Captured with the end of the ascent, and with the 40th step of 0.75 m: 10 m before the car.
FIRST_TICKS, SECOND_TICKS = 600 - 141, 1000 - 639
MISSIONS = (
    # 30 m in the first mission, 40 m in the second: both count.
    Row(id='c1.holds', make=lambda: _altitude('<=', 50.0), margin=50.0 - 40.0),
    Row(id='c1.holds', make=lambda: _altitude('<=', 35.0), margin=35.0 - 40.0),
    Row(
        id='c1.share',
        make=lambda: _altitude('<=', 35.0, fraction=0.5),
        margin=FIRST_TICKS / (FIRST_TICKS + SECOND_TICKS) - 0.5,
        within=0.001,
    ),
    # A condition in the clause of one mission is about that one.
    Row(
        id='c1.holds',
        make=lambda: _said(_altitude('<=', 35.0), FIRST_SPAN),
        margin=35.0 - 30.0,
        what='first',
    ),
    Row(
        id='c1.holds',
        make=lambda: _said(_altitude('<=', 35.0), SECOND_SPAN),
        margin=35.0 - 40.0,
        what='second',
    ),
    # A distance from the tracked car is about the mission that tracks it: worst 2.5 m before it,
    # when the UAV has come up to 40 m after 50 ticks. At the hover point it is 50 m.
    Row(
        id='c1.holds',
        make=lambda: _car('distance', '<=', 45.0),
        margin=45.0 - math.hypot(2.5, 40.0),
    ),
    Row(id='c1.holds', make=lambda: _car('visible_fraction', '>=', 0.9), margin=1.0 - 0.9),
    Row(id='c1.holds', make=lambda: _car('tracked_fraction', '>=', 0.9), margin=1.0 - 0.9),
    # Sight of what no mission is about is summed up over both.
    Row(
        id='c1.holds',
        make=_seen_from_both,
        margin=(FIRST_TICKS + SECOND_TICKS) * 0.05 - 30.0,
        within=0.06,
    ),
    # The second mission is commanded when the first one ends, and captured 39 ticks later.
    Row(id='m2.order', make=two_missions, margin=0.0),
    # Its way, 39.25 m after the first step, takes so long at 8 m/s, which does not count.
    Row(id='m2.capture', make=two_missions, margin=30.0 - (39 * 0.05 - 39.25 / 8.0), within=0.06),
    # 80 m higher, by 0.2 m each tick: the climb at 3 m/s on average does not count either.
    Row(
        id='m2.capture',
        make=lambda: two_missions(110.0, begins=500),
        margin=30.0 - ((79.8 - 5.0) / 0.2 * 0.05 - 79.8 / 3.0),
        within=0.11,
        what='higher',
    ),
    Row(id='m1.completed', make=two_missions, margin=FIRST_TICKS * 0.05 - 19.5, within=0.06),
    Row(id='m2.completed', make=two_missions, margin=SECOND_TICKS * 0.05 - 19.5, within=0.06),
    Row(id='m2.order', make=lambda: two_missions(begins=1000), reason=EMPTY),
    Row(id='m2.tracked', make=lambda: two_missions(begins=1000), reason=EMPTY),
)
NEVER = Reason.PREMISE_NEVER
ORDERS = (
    # The second mission is commanded at 30 s.
    Row(id='o1.holds', make=lambda: _ordered('e1', 'm2'), margin=30.0 - 10.0, within=0.06),
    Row(
        id='o1.holds',
        make=lambda: _ordered('e1', 'm2', at_s=45.0),
        margin=30.0 - 45.0,
        within=0.06,
    ),
    Row(id='o1.holds', make=lambda: _ordered('e1', 'm2', at_s=500.0), reason=NEVER),
    # 39 m high 45 steps of 0.2 m after the first mission ends.
    Row(id='o1.holds', make=lambda: _ordered('m1', 'e2'), margin=45 * 0.05, within=0.06),
    Row(id='o1.holds', make=_climbs_first, margin=-100 * 0.05, within=0.06, what='climb'),
    Row(id='o1.holds', make=lambda: _ordered('m1', 'e2', goal_m=60.0), reason=NEVER, what='climb'),
)
UAVS = (
    Row(id='c1.holds', make=lambda: _closes_in(None), margin=30.0 - 10.0, what='apart'),
    Row(id='c1.holds', make=lambda: _closes_in(500), margin=4.0 - 10.0, what='both'),
    # uav2 lands already, uav1 still hovers.
    Row(id='c1.holds', make=lambda: _closes_in(800), margin=4.0 - 10.0, what='one'),
    Row(id='c1.holds', make=lambda: _closes_in(950), margin=30.0 - 10.0, what='none'),
    Row(id='c1.holds', make=_second_on_ground, reason=EMPTY, what='apart'),
    Row(id='safety.separation.uav1.uav2', make=lambda: _closes_in(950), margin=4.0 - 5.0),
    Row(id='m2.drift', make=lambda: _two_uavs(30.0), margin=2.0 - 1.45, within=1e-6),
    Row(id='m2.drift', make=_second_on_ground, reason=EMPTY),
    Row(id='m1.drift', make=_second_on_ground, margin=2.0 - 1.45),
    # Landing from 35 s on, 30 m with 2 m/s.
    Row(id='uav2.landed', make=lambda: _two_uavs(30.0), margin=70.0 - 50.0, within=0.06),
)
PLACES = (
    Row(id='m1.visible', make=_over_city_hall, margin=1.0 - 0.7),
    Row(id='m1.visible', make=lambda: _over_city_hall(hidden=True), margin=0.0 - 0.7),
    # Worst at capture, 1.45 m away.
    Row(id='c1.holds', make=lambda: _to_city_hall('<=', 5.0), margin=5.0 - 1.45),
    Row(id='c1.holds', make=lambda: _to_city_hall('<=', 1.0), margin=1.0 - 1.45),
    Row(id='c1.holds', make=lambda: grounded(_to_city_hall('<=', 5.0)), reason=EMPTY),
    Row(id='c1.share', make=lambda: _to_city_hall('<', 5.0, fraction=0.9), margin=1.0 - 0.9),
    Row(id='c1.share', make=lambda: _to_city_hall('>', 5.0, fraction=0.9), margin=0.0 - 0.9),
    Row(
        id='c1.share',
        make=lambda: grounded(_to_city_hall('<', 5.0, fraction=0.9)),
        reason=EMPTY,
    ),
    Row(id='m1.tracked', make=lambda: _tracks_city_hall(0.0), margin=1.0 - 0.8),
    # 10 m are allowed. It comes from y = 20.2 m past City Hall and is too far off at y < 0.5 m,
    # after 27 ticks; or it never comes near enough.
    Row(
        id='m1.tracked',
        make=lambda: _tracks_city_hall(10.5),
        margin=27 / (900 - 141) - 0.8,
        within=0.003,
    ),
    Row(id='m1.tracked', make=lambda: _tracks_city_hall(-12.0), reason=EMPTY),
)
ROWS = MISSIONS + ORDERS + UAVS + PLACES


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_phases_of_kinds(row: Row) -> None:
    row.check()


@pytest.mark.parametrize(
    ('at_s', 'asked_s', 'satisfied'),
    [(30.0, 60.0, True), (30.0, 5.0, False), (32.0, 60.0, False)],
)
def test_a_stated_length_holds_unless_an_event_ends_the_mission(
    at_s: float, asked_s: float, satisfied: bool
) -> None:
    """It leaves its first mission at 30 s: for its event, too late, or before that event."""
    case = two_missions()
    one, two = case.spec.missions
    lasts = one.model_copy(update={'duration_s': number(asked_s, Unit.SECOND, explicit=True)})
    change = {
        'id': 'e1',
        'trigger': {'on': 'time', 'at_s': number(at_s, Unit.SECOND)},
        'action': {'do': 'change_mission', 'uav': 'uav1', 'mission': 'm2'},
    }
    changed = {'missions': (lasts, two), 'events': (change,)}
    case.spec = spec(**{**dict(case.spec), **changed})
    found = result(judge(case), 'm1.duration')
    assert found.satisfied is satisfied
    assert ('until e1 ended it' in found.explanation) is satisfied


def test_a_landing_ends_a_mission_of_a_stated_length() -> None:
    """The last mission, of 60 s, is left for the landing at 50 s that an event asks for."""
    case = two_missions()
    one, two = case.spec.missions
    lasts = two.model_copy(update={'duration_s': number(60.0, Unit.SECOND, explicit=True)})
    for at_s, satisfied in ((50.0, True), (20.0, False)):
        land = {
            'id': 'e1',
            'trigger': {'on': 'time', 'at_s': number(at_s, Unit.SECOND)},
            'action': {'do': 'land', 'uav': 'uav1'},
        }
        changed = {'missions': (one, lasts), 'events': (land,)}
        case.spec = spec(**{**dict(case.spec), **changed})
        verdict = judge(case)
        assert verdict.status is not None
        assert result(verdict, 'e1.within').satisfied is satisfied
        assert result(verdict, 'm2.duration').satisfied
