# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of placements, of every relation: satisfied, violated, not judged.

car1 is placed relative to car2, which stands at (0, 0) and heads east, or to a place.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, gone
from trace_builder import box_ring, number
from trace_cases import Case, ground_case, spec

from aurora_core.knowledge.world import CentreLine, NamedPlace, Surface, SurfaceKind
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind, Relation

STILL = np.zeros(401)
TOWER = 'landmark:Tower'


def _placed(relation: Relation, of: str, x: float, y: float, asked_m: float | None = None) -> Case:
    """car1 stands at (x, y); a carriageway goes up to y = 5, a crosswalk from x = 40 to 44."""
    case = ground_case(Behavior(kind=BehaviorKind.PARK), STILL, car2=(0.0, STILL))
    car = case.run.agents[0]
    car.x[:], car.y[:], car.route = x, y, ((x, y), (x + 5000.0, y))
    distance = None if asked_m is None else number(asked_m, explicit=True)
    placement = Placement(relation=relation, of=of, distance_m=distance)
    agents = (dict(case.spec.agents[0]) | {'placements': (placement,)}, case.spec.agents[1])
    case.spec = spec(agents=agents)
    crosswalk = Surface(
        surface_id='c',
        kind=SurfaceKind.CROSSING,
        ring=np.array(box_ring(40.0, -5.0, 44.0, 5.0)),
    )
    case.world = replace(
        case.world,
        surfaces=(*case.world.surfaces, crosswalk),
        places=tuple(
            NamedPlace(name=name, x_m=100.0, y_m=2.0) for name in (TOWER, 'intersection')
        ),
        lanes=tuple(
            CentreLine(
                lane_id=lane,
                street_name='',
                points=np.array([(-500.0, y), (1000.0, y)]),
                width_m=3.3,
                speed_limit_mps=10.0,
            )
            for lane, y in (('a_0', 0.0), ('a_1', 3.3), ('b_0', -50.0))
        ),
    )
    return case


def _heading(case: Case, x: float, y: float) -> Case:
    case.run.agents[0].heading = (x, y)
    return case


def _comes_by_again(case: Case) -> Case:
    """Let the route turn round and come by the tower again, nearer than the first time."""
    case.run.agents[0].route = ((40.0, 0.0), (300.0, 0.0), (300.0, 2.5), (-900.0, 2.5))
    return case


def _rows(
    relation: Relation, of: str, good: tuple[float, ...], bad: tuple[float, ...], what: str = ''
) -> tuple[Row, ...]:
    """Three rows; `good` and `bad` are x, y and the margin."""
    id = 'car1.placed'
    name = f'{relation.value}-{of}' + (f'-{what}' if what else '')
    return (
        Row(id=id, make=lambda: _placed(relation, of, *good[:2]), margin=good[2], what=name),
        Row(id=id, make=lambda: _placed(relation, of, *bad[:2]), margin=bad[2], what=name),
        Row(
            id=id,
            make=lambda: gone(_placed(relation, of, *good[:2]), 0, 0),
            reason=Reason.TARGET_GONE,
            what=name,
        ),
    )


def _parks(*stretches: tuple[float, float]) -> Case:
    """car1 is to drive to the tower and to park there; it drives so fast for so many seconds."""
    speed = np.concatenate([np.full(round(s * 20.0), v) for v, s in stretches])
    case = ground_case(Behavior(kind=BehaviorKind.PARK), speed[:401])
    goes = (Behavior(kind=BehaviorKind.DRIVE), Behavior(kind=BehaviorKind.PARK, target=TOWER))
    case.spec = spec(agents=(dict(case.spec.agents[0]) | {'behaviors': goes},))
    case.world = replace(case.world, places=(NamedPlace(name=TOWER, x_m=100.0, y_m=2.0),))
    return case


# 0.1 m/s is at rest, for 2 s and from then on.
_PARKED = (
    Row(id='car1.park2', make=lambda: _parks((10.0, 10.0), (0.0, 11.0)), margin=0.1, what='stays'),
    Row(
        id='car1.park2',
        make=lambda: _parks((10.0, 10.0), (0.0, 5.0), (4.0, 6.0)),
        margin=0.1 - 4.0,
        what='drives-on',
    ),
    Row(
        id='car1.park2',
        make=lambda: _parks((10.0, 5.0), (0.0, 16.0)),
        reason=Reason.PREMISE_NEVER,
        what='stops-before',
    ),
)


def _stops(tower_x: float, end_mps: float = 0.0) -> Case:
    """car1 stands for 3 s, drives 100 m and stops, or not; it is to stop at the tower."""
    speed = np.concatenate([np.zeros(60), np.full(200, 10.0), np.full(141, end_mps)])
    case = ground_case(Behavior(kind=BehaviorKind.STOP, target=TOWER), speed)
    case.world = replace(case.world, places=(NamedPlace(name=TOWER, x_m=tower_x, y_m=0.0),))
    return case


# Its front may be 15 m away, 2.25 m ahead of its middle. Where it set out it has not stopped.
_STOPPED = (
    Row(id='car1.stop.at', make=lambda: _stops(95.0), margin=17.25 - 5.0, what='there'),
    Row(id='car1.stop.at', make=lambda: _stops(0.0), margin=17.25 - 100.0, what='elsewhere'),
    Row(
        id='car1.stop.at',
        make=lambda: _stops(0.0, 5.0),
        reason=Reason.PREMISE_NEVER,
        what='drives-on',
    ),
)


def _drives_to(tower_x: float, kind: BehaviorKind = BehaviorKind.DRIVE) -> Case:
    """car1 drives 100 m, and is to drive to the tower."""
    speed = np.concatenate([np.full(200, 10.0), np.zeros(201)])
    case = ground_case(Behavior(kind=kind, target=TOWER), speed)
    case.world = replace(case.world, places=(NamedPlace(name=TOWER, x_m=tower_x, y_m=0.0),))
    return case


def _approaches(way_m: float) -> Case:
    """car1 comes so far along the street to where that leads to the tower, 60 m beside it."""
    case = _drives_to(100.0, BehaviorKind.APPROACH)
    case.run.agents[0].x[:] += 100.0 - way_m
    places = (
        NamedPlace(name=TOWER, x_m=100.0, y_m=60.0),
        NamedPlace(name='approach:Tower', x_m=100.0, y_m=0.0),
    )
    case.world = replace(case.world, places=places)
    return case


# Who is there from the beginning has not gone there, however far it drives then; 10 m are asked.
_GONE_TO = (
    Row(id='car1.drive.nearer', make=lambda: _drives_to(95.0), margin=95.0 - 10.0, what='comes'),
    Row(id='car1.drive.nearer', make=lambda: _drives_to(2.0), margin=2.0 - 10.0, what='leaves'),
    Row(id='car1.drive.nearer', make=lambda: _drives_to(-9.0), margin=0.0 - 10.0, what='away'),
    Row(
        id='car1.drive.nearer',
        make=lambda: gone(_drives_to(95.0), 0, 0),
        reason=Reason.TARGET_GONE,
        what='gone',
    ),
    Row(id='car1.approach', make=lambda: _approaches(25.0), margin=25.0 - 10.0, what='on-road'),
    Row(id='car1.approach', make=lambda: _approaches(4.0), margin=4.0 - 10.0, what='on-road'),
)

R = Relation
ROWS = (
    *_GONE_TO,
    *_STOPPED,
    *_rows(R.AHEAD, 'car2', (20.0, 0.0, 20.0), (-20.0, 0.0, -20.0)),
    *_rows(R.BEHIND, 'car2', (-20.0, 0.0, 20.0), (20.0, 0.0, -20.0)),
    # 10 m beside the route are allowed.
    *_rows(R.BEFORE, 'car2', (-20.0, 0.0, 20.0), (-20.0, 14.0, 10.0 - 14.0)),
    *_rows(R.BEFORE, TOWER, (40.0, 0.0, 60.0), (130.0, 0.0, -30.0)),
    *_rows(R.BEFORE, TOWER, (40.0, 2.0, 60.0), (40.0, -14.0, 10.0 - 16.0), 'beside'),
    Row(
        id='car1.placed',
        make=lambda: _comes_by_again(_placed(R.BEFORE, TOWER, 40.0, 0.0)),
        margin=60.0,
        what='before-a-place-that-the-route-passes-twice',
    ),
    # 1.75 m to each side of the middle of a lane; the next lane begins there.
    *_rows(R.SAME_LANE, 'car2', (30.0, 1.0, 0.75), (30.0, 3.3, 1.75 - 3.3)),
    *_rows(R.ADJACENT_LANE, 'car2', (30.0, 3.3, 1.75 - 0.2), (30.0, 0.0, 1.75 - 3.5)),
    *_rows(R.ADJACENT_LANE, 'car2', (0.0, -3.5, 1.75), (0.0, 7.0, 1.75 - 3.5), 'two-lanes-over'),
    Row(
        id='car1.placed',
        make=lambda: _heading(_placed(R.ADJACENT_LANE, 'car2', 0.0, 3.3), -1.0, 0.0),
        margin=-3.3,
        what='adjacent-oncoming',
    ),
    # Beyond the flank of car2, which is 1.8 m wide.
    *_rows(R.LEFT, 'car2', (0.0, 5.0, 4.1), (0.0, -5.0, -5.9)),
    *_rows(R.RIGHT, 'car2', (0.0, -5.0, 4.1), (0.0, 5.0, -5.9)),
    *_rows(R.RIGHT, 'car2', (-6.0, -1.0, 0.1), (-6.0, 0.0, -0.9), 'right-behind-it'),
    *_PARKED,
    # Two cars of 4.5 m.
    *_rows(R.BESIDE, 'car2', (1.0, 4.0, 4.5 - 1.0), (6.0, 4.0, 4.5 - 6.0)),
    *_rows(R.NEAR, 'car2', (30.0, 0.0, 20.0), (60.0, 0.0, -10.0)),
    *_rows(R.NEAR, TOWER, (70.0, 2.0, 20.0), (40.0, 2.0, -10.0)),
    *_rows(R.AT, 'car2', (10.0, 0.0, 5.0), (20.0, 0.0, -5.0)),
    *_rows(R.AT, TOWER, (90.0, 2.0, 5.0), (80.0, 2.0, -5.0)),
    *_rows(R.ON, 'intersection', (90.0, 2.0, 5.0), (80.0, 2.0, -5.0)),
    # Half a lane; a street with one lane is no main road.
    *_rows(R.ON, 'main_road', (0.0, 3.0, 1.65 - 0.3), (0.0, -50.0, 1.65 - 50.0)),
    *_rows(R.ON, 'crosswalk', (41.0, 0.0, 1.0), (30.0, 0.0, -10.0)),
    # 3 m on each side of the edge at y = 5.
    *_rows(R.ON, 'roadside', (0.0, 6.0, 2.0), (0.0, 9.0, -1.0)),
    *_rows(R.PARKED_AT, 'roadside', (0.0, 4.0, 2.0), (0.0, 0.0, 3.0 - 5.0)),
    *_rows(R.PARKED_AT, TOWER, (90.0, 2.0, 5.0), (80.0, 2.0, -5.0)),
    # The cosine of the headings.
    Row(
        id='car1.placed',
        make=lambda: _heading(_placed(R.ONCOMING, 'car2', 50.0, 4.0), -1.0, 0.0),
        margin=1.0,
        what='oncoming',
    ),
    Row(
        id='car1.placed',
        make=lambda: _placed(R.ONCOMING, 'car2', 50.0, 4.0),
        margin=-1.0,
        what='oncoming',
    ),
    Row(
        id='car1.placed',
        make=lambda: gone(_placed(R.ONCOMING, 'car2', 50.0, 4.0), 0, 0),
        reason=Reason.TARGET_GONE,
        what='oncoming',
    ),
    # 1 m or 2 % of 60 m.
    Row(
        id='car1.placed.distance',
        make=lambda: _placed(R.BEFORE, TOWER, 40.0, 0.0, 60.0),
        margin=1.2,
        what='before-place',
    ),
    Row(
        id='car1.placed.distance',
        make=lambda: _placed(R.BEFORE, 'car2', -55.0, 0.0, 60.0),
        margin=1.2 - 5.0,
        what='before-car',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_place_kinds(row: Row) -> None:
    row.check()
