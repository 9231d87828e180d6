# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of route conditions: satisfied, violated, not judged.

`survey_case` flies a rectangle of 100 m x 60 m from tick 200 on in steps of 0.4 m: every corner is
a sample.
"""

from __future__ import annotations

import math
from dataclasses import replace

import pytest
from kind_rows import Row, gone, grounded
from trace_builder import DT_S, Run, flight, number, world
from trace_cases import Case, facts_of, judge, mission, spec, survey_case

from aurora_core.errors import VerificationError
from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Uav
from aurora_core.spec.vocabulary import MissionMode, Pattern

RADIUS_M = 40.0


def _corner(k: int) -> tuple[float, float, float]:
    angle = 2.0 * math.pi * (k % 36) / 36
    return RADIUS_M * math.cos(angle), RADIUS_M * math.sin(angle), 30.0


def _orbit(flown_m: float, turns: float = 8.0 * 35.0 / RADIUS_M / (2.0 * math.pi)) -> Case:
    """A drone starts below the first point of a circle of 40 m and flies one of `flown_m`.

    Unless told how often round it goes it flies at 8 m/s until it lands after 35 s.
    """
    ticks = 1401

    def path(k: int) -> tuple[float, float, float]:
        angle = min(max(0, k - 200) * DT_S * 8.0 / RADIUS_M, turns * 2.0 * math.pi)
        return flown_m * math.cos(angle), flown_m * math.sin(angle), 30.0

    request = spec(
        uavs=(Uav(id='uav1'),),
        missions=(
            mission(
                'm1',
                MissionMode.NAVIGATE,
                pattern=Pattern.ORBIT,
                radius_m=number(RADIUS_M, explicit=True),
            ),
        ),
    )
    facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.NAVIGATE,
            altitude_m=30.0,
            waypoints=tuple(_corner(k) for k in range(37)),
        ),
        horizon_s=70.0,
    )
    run = Run(ticks=ticks, flights=[flight(ticks, (RADIUS_M, 0.0), 30.0, path, landing=900)])
    return Case(spec=request, facts=facts, world=world(), run=run)


def _circling(asked_mps: float) -> Case:
    """An orbit that is asked with some speed and flown with 8 m/s."""
    case = _orbit(RADIUS_M)
    (plan,) = case.spec.missions
    speed = number(asked_mps, Unit.METRE_PER_SECOND, explicit=True)
    plan = plan.model_copy(update={'speed_mps': speed})
    case.spec = case.spec.model_copy(update={'missions': (plan,)})
    return case


def _turning(asked: float, flown: float, bound: Bound = Bound.EXACTLY) -> Case:
    """An orbit with a stated number of turns; the run is long enough for both."""
    case = _orbit(RADIUS_M, flown)
    (plan,) = case.spec.missions
    turns = number(asked, Unit.ONE, explicit=True, bound=bound)
    case.spec = spec(**{**dict(case.spec), 'missions': (dict(plan) | {'turns': turns},)})
    return case


def _short(flown_deg: float, lasts_s: float = 20.0) -> Case:
    """An orbit of 20 s, planned for 130 deg of its circle; at 18 m/s a lap takes longer.

    There is time for 8 m/s x (20 - 4 - 8 / 1.5) s on 40 m, 122.2 deg; in 10.2 s for 9.9 deg.
    """
    case = _orbit(RADIUS_M, flown_deg / 360.0)
    (plan,), (facts,) = case.spec.missions, case.facts.missions
    lasts = number(lasts_s, Unit.SECOND, explicit=True)
    case.spec = spec(**{**dict(case.spec), 'missions': (dict(plan) | {'duration_s': lasts},)})
    part = facts.model_copy(update={'waypoints': tuple(_corner(k) for k in range(14))})
    case.facts = case.facts.model_copy(update={'missions': (part,)})
    return case


def _way(end_x: float = 300.0, flown_mps: float = 8.0, points: int = 2) -> Case:
    """A way of 300 m from the old gate to the new one, or to the new one alone, at 8 m/s."""
    ticks = 1801
    names = ('landmark:Old Gate', 'landmark:New Gate')
    ends = ((0.0, 0.0, 30.0), (end_x, 0.0, 30.0))

    def path(k: int) -> tuple[float, float, float]:
        return min(max(0, k - 200) * DT_S * flown_mps, end_x), 0.0, 30.0

    landing = 221 + int(end_x / flown_mps / DT_S)
    single: dict[str, object] = {'waypoint_count': number(1.0, Unit.ONE)}
    plan = mission(
        'm1',
        MissionMode.NAVIGATE,
        pattern=Pattern.WAYPOINTS,
        target=names[1],
        speed_mps=number(8.0, Unit.METRE_PER_SECOND, explicit=True),
        **({'start': names[0]} if points == 2 else single),
    )
    facts = facts_of(
        MissionFacts(
            mission='m1',
            uav='uav1',
            mode=MissionMode.NAVIGATE,
            altitude_m=30.0,
            waypoints=ends[-points:],
        ),
        horizon_s=90.0,
    )
    run = Run(ticks=ticks, flights=[flight(ticks, (0.0, 0.0), 30.0, path, landing=landing)])
    gates = tuple(
        NamedPlace(name=name, x_m=x, y_m=y)
        for name, (x, y) in zip(names, ((4.0, 0.0), (300.0, 3.0)), strict=True)
    )
    return Case(
        spec=spec(uavs=(Uav(id='uav1'),), missions=(plan,)),
        facts=facts,
        world=replace(world(), places=gates),
        run=run,
    )


def _elsewhere() -> Case:
    case = survey_case()
    case.world = world(streets=((-1000.0, 500.0, 1000.0, 510.0),))
    return case


def _speed(value: float, **values: float) -> Case:
    asked = number(value, Unit.METRE_PER_SECOND, explicit=True)
    return survey_case(speed_mps=asked, **values)  # type: ignore[arg-type]


def _count(skip: int | None = None) -> Case:
    return survey_case(skip=skip, waypoint_count=number(4.0, Unit.ONE, explicit=True))


def _sized(**values: int) -> Case:
    size = (number(100.0, explicit=True), number(60.0, explicit=True))
    return survey_case(size_m=size, **values)


def _on_ground() -> Case:
    return grounded(_count())


EMPTY = Reason.EMPTY_PHASE
ROWS = (
    Row(id='m1.waypoints', make=survey_case, margin=3.0),
    # From (100, 0) straight to (0, 60): (100, 60) is passed at 60 * 100 / hypot(60, 100) m.
    Row(
        id='m1.waypoints',
        make=lambda: survey_case(skip=2),
        margin=3.0 - 6000.0 / math.hypot(60.0, 100.0),
        within=0.001,
    ),
    Row(id='m1.waypoints', make=_on_ground, reason=EMPTY),
    Row(id='m1.count', make=_count, margin=0.0),
    Row(id='m1.count', make=lambda: _count(skip=2), margin=3.0 - 4.0),
    Row(id='m1.count', make=_on_ground, reason=EMPTY),
    Row(id='m1.closed', make=survey_case, margin=3.0),
    # 200 steps of 0.4 m along the first leg, and no farther.
    Row(id='m1.closed', make=lambda: survey_case(stop_after=400), margin=3.0 - 80.0),
    Row(id='m1.closed', make=_on_ground, reason=EMPTY),
    # 320 m of way, done 3 m before its end, at tick 200 + 317 / 0.4 = 993; landing from 1021 on.
    Row(
        id='m1.completed', make=survey_case, margin=(1021 - 993) * 0.05, within=0.06, what='route'
    ),
    Row(id='m1.completed', make=lambda: survey_case(skip=2), margin=-0.05, what='route'),
    Row(id='m1.completed', make=_on_ground, reason=EMPTY, what='route'),
    # The first leg lies over the street y = 0, 10 m wide.
    Row(id='m1.over_streets', make=survey_case, margin=1.0 - 0.8),
    Row(id='m1.over_streets', make=_elsewhere, margin=0.0 - 0.8),
    Row(id='m1.over_streets', make=lambda: survey_case(stop_after=400), reason=EMPTY),
    # The centre of the rectangle is (50, 30), where the ego stands.
    Row(id='m1.centre', make=survey_case, margin=10.0),
    Row(id='m1.centre', make=lambda: survey_case(ego_x=62.0), margin=10.0 - 12.0),
    Row(id='m1.centre', make=lambda: gone(survey_case(), 0, 0), reason=Reason.TARGET_GONE),
    Row(id='m1.speed', make=lambda: _speed(8.0), margin=1.0 - 0.8),
    Row(id='m1.speed', make=lambda: _speed(8.0, speed=6.9), margin=0.0 - 0.8),
    # The chords of a circle are short, but nobody brakes between them.
    Row(id='m1.speed', make=lambda: _circling(8.0), margin=1.0 - 0.8, what='orbit'),
    Row(id='m1.speed', make=lambda: _circling(10.0), margin=0.0 - 0.8, what='orbit'),
    # The slowest that is still 13 m/s needs 46 m to be reached and 46 m to brake: a leg has 100 m.
    Row(id='m1.speed', make=lambda: _speed(13.0, speed=12.5), margin=1.0 - 0.8, what='short'),
    Row(id='m1.speed', make=lambda: _speed(13.0, speed=11.5), margin=0.0 - 0.8, what='short'),
    # 16 m/s need 69 m to be reached and 69 m to brake: no leg has that.
    Row(id='m1.speed', make=lambda: _speed(16.0), reason=EMPTY),
    # A way between two places: both ends, and its speed; to one place, the way there.
    Row(id='m1.start', make=_way, margin=10.0 - 4.0),
    Row(id='m1.end', make=_way, margin=10.0 - 3.0),
    Row(id='m1.end', make=lambda: _way(280.0), margin=10.0 - math.hypot(20.0, 3.0), within=0.001),
    Row(id='m1.speed', make=_way, margin=1.0 - 0.8, what='way'),
    Row(id='m1.speed', make=lambda: _way(points=1), margin=1.0 - 0.8, what='to-one'),
    Row(
        id='m1.speed',
        make=lambda: _way(flown_mps=6.5, points=1),
        margin=0.0 - 0.8,
        what='to-one-slowly',
    ),
    # 3 m are allowed at each end of the 100 m and of the 60 m.
    Row(id='m1.length', make=_sized, margin=6.0),
    Row(id='m1.length', make=lambda: _sized(stop_after=350), margin=6.0 - 40.0, within=0.5),
    Row(id='m1.length', make=lambda: grounded(_sized()), reason=EMPTY),
    Row(id='m1.width', make=_sized, margin=6.0),
    Row(id='m1.width', make=lambda: _sized(stop_after=450), margin=6.0 - 57.5, within=0.1),
    Row(id='m1.width', make=lambda: grounded(_sized()), reason=EMPTY),
    # 5 m are allowed on 40 m.
    Row(id='m1.radius', make=lambda: _orbit(42.0), margin=5.0 - 2.0),
    Row(id='m1.radius', make=lambda: _orbit(46.0), margin=5.0 - 6.0),
    Row(id='m1.radius', make=lambda: grounded(_orbit(42.0)), reason=EMPTY),
    # One turn, within 15 deg.
    Row(id='m1.turn', make=lambda: _orbit(40.0, 1.0), margin=15.0, within=0.1),
    Row(id='m1.turn', make=lambda: _orbit(40.0, 336.0 / 360.0), margin=15.0 - 24.0, within=0.1),
    Row(
        id='m1.turn',
        make=lambda: _orbit(40.0, 396.0 / 360.0),
        margin=15.0 - 36.0,
        within=0.1,
        what='farther',
    ),
    Row(id='m1.turn', make=lambda: grounded(_orbit(40.0, 1.0)), reason=EMPTY),
    Row(id='m1.turn', make=lambda: _short(2.0, 10.2), margin=2.0 - 4.97, within=0.1, what='none'),
    Row(id='m1.turn', make=lambda: _short(130.0), margin=130.0 - 107.2, within=0.1, what='part'),
    Row(id='m1.turn', make=lambda: _short(90.0), margin=90.0 - 107.2, within=0.1, what='less'),
    # A stated number of turns: neither fewer nor more, but for its bound.
    Row(id='m1.turn', make=lambda: _turning(1.1, 1.1), margin=15.0, within=0.1, what='stated'),
    Row(
        id='m1.turn',
        make=lambda: _turning(2.0, 1.0),
        margin=15.0 - 360.0,
        within=0.1,
        what='one-of-two',
    ),
    Row(
        id='m1.turn',
        make=lambda: _turning(1.0, 1.1, Bound.AT_LEAST),
        margin=36.0,
        within=0.1,
        what='at-least',
    ),
    Row(
        id='m1.turn',
        make=lambda: _turning(1.0, 1.1, Bound.AT_MOST),
        margin=-36.0,
        within=0.1,
        what='at-most',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_route_kinds(row: Row) -> None:
    row.check()


def test_an_explicit_radius_is_never_resized() -> None:
    case = _orbit(RADIUS_M)
    (plan,) = case.spec.missions
    asked = {'radius_m': number(RADIUS_M + 4.0, explicit=True)}
    case.spec = case.spec.model_copy(update={'missions': (plan.model_copy(update=asked),)})
    with pytest.raises(VerificationError, match=r'asks for a radius of 44.0 m'):
        judge(case)
