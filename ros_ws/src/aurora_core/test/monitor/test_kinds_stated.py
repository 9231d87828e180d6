# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of conditions that the prompt states: satisfied, violated, not judged.

Ground cases: car1 drives away from car2 with 5 m/s, from 20 m to 120 m within 20 s. In flight: the
UAV of `hover_case` is at 30 m from tick 150 on and hovers up to tick 900 (45 s).
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from kind_rows import Row, cut, done_at, gone, grounded, stated
from trace_cases import Case, convoy_case, ground_case, hover_case, survey_case, tailgate_case

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import UavColumn

T = 401  # 20 s
CARS = ('car1', 'car2')
UP, SEEN = ('uav1',), ('uav1', 'bus1')
# The tracking phase of the convoy, see test_kinds_missions.py.
TRACKED_S = (1050 - 247) * 0.05


def _cars(quantity: str, of: tuple[str, ...], op: str, value: float, **more: float) -> Case:
    case = ground_case(
        Behavior(kind=BehaviorKind.DRIVE), np.full(T, 5.0), car2=(-20.0, np.zeros(T))
    )
    return stated(case, quantity, of, op, value, **more)


def _cars_late(**more: float) -> Case:
    """The same, with car2 gone after 10 s."""
    return gone(_cars('distance', CARS, '<=', 500.0, **more), 1, 200)


def _hover(quantity: str, of: tuple[str, ...], op: str, value: float, **more: float) -> Case:
    return stated(hover_case(drift=1.75), quantity, of, op, value, **more)


def _convoy(quantity: str, op: str, value: float, **more: float) -> Case:
    return stated(convoy_case(), quantity, SEEN, op, value, **more)


def _hidden(quantity: str, value: float, **more: float) -> Case:
    """The bus is absent from tick 600 to tick 699."""
    return gone(_convoy(quantity, '>=', value, **more), 1, 600, 700)


def _bus_gone(quantity: str, value: float) -> Case:
    return gone(_convoy(quantity, '>=', value), 1, 50)


def _event(op: str, value: float, *, happens: bool = True) -> Case:
    """The alert is sent at 32.25 s."""
    return stated(tailgate_case(keeps_away=not happens), 'event_time', ('e1',), op, value)


EMPTY, GONE, SHORT = Reason.EMPTY_PHASE, Reason.TARGET_GONE, Reason.TRACE_SHORT
GROUND = (
    Row(id='c1.holds', make=lambda: _cars('distance', CARS, '>=', 15.0), margin=20.0 - 15.0),
    Row(id='c1.holds', make=lambda: _cars('distance', CARS, '<=', 100.0), margin=100.0 - 120.0),
    Row(id='c1.holds', make=_cars_late, reason=GONE),
    Row(
        id='c1.holds',
        make=lambda: _cars('horizontal_distance', CARS, '<=', 150.0),
        margin=150.0 - 120.0,
        what='plane',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('horizontal_distance', CARS, '>=', 30.0),
        margin=20.0 - 30.0,
        what='plane',
    ),
    Row(
        id='c1.holds',
        make=lambda: cut(_cars('horizontal_distance', CARS, '<=', 500.0), 300),
        reason=SHORT,
        what='plane',
    ),
    Row(id='c1.holds', make=lambda: _cars('separation', CARS, '>=', 20.0), margin=0.0),
    Row(id='c1.holds', make=lambda: _cars('separation', CARS, '>', 20.0), margin=0.0),
    Row(
        id='c1.holds',
        make=lambda: gone(_cars('separation', CARS, '>=', 1.0), 0, 0, 1),
        reason=GONE,
        what='apart',
    ),
    Row(id='c1.holds', make=lambda: _cars('speed', ('car1',), '<', 7.0), margin=7.0 - 5.0),
    Row(id='c1.holds', make=lambda: _cars('speed', ('car1',), '<', 5.0), margin=0.0),
    Row(id='c1.holds', make=lambda: _cars('speed', ('car1',), '<=', 5.0), margin=0.0),
    # `==` is within 1 m/s or 10 %.
    Row(id='c1.holds', make=lambda: _cars('speed', ('car1',), '==', 4.5), margin=1.0 - 0.5),
    Row(
        id='c1.holds',
        make=lambda: gone(_cars('speed', ('car1',), '<', 7.0), 0, 100),
        reason=GONE,
        what='speed',
    ),
    # The driver behind sees the one ahead all along (401 samples), who never sees it.
    Row(
        id='c1.holds',
        make=lambda: _cars('visible_time', CARS[::-1], '>=', 15.0),
        margin=T * 0.05 - 15.0,
        what='driver',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('visible_time', CARS, '>=', 1.0),
        margin=0.0 - 1.0,
        what='driver',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('visible_fraction', CARS[::-1], '>=', 0.9),
        margin=1.0 - 0.9,
        what='driver',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('visible_fraction', CARS, '>=', 0.5),
        margin=0.0 - 0.5,
        what='driver',
    ),
    # 25 m at 1 s; 30 m at 2 s.
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 25.0, by_s=2.0),
        margin=30.0 - 25.0,
        what='deadline',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 35.0, by_s=2.0),
        margin=30.0 - 35.0,
        what='deadline',
    ),
    # 4 s that begin by 2 s; by 18 or 30 s: the run is over before, the last 4 s begin at 16 s.
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 25.0, hold_s=4.0, by_s=2.0),
        margin=30.0 - 25.0,
        what='stretch-deadline',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 90.0, hold_s=4.0, by_s=18.0),
        margin=100.0 - 90.0,
        what='stretch-late-deadline',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 105.0, hold_s=4.0, by_s=30.0),
        margin=100.0 - 105.0,
        what='stretch-late-deadline',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 25.0, hold_s=30.0, by_s=30.0),
        reason=EMPTY,
        what='stretch-longer-than-the-run',
    ),
    # The best 4 s are the last ones, from 100 m on; the best 4 s under a limit the first ones.
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '>=', 90.0, hold_s=4.0),
        margin=100.0 - 90.0,
        what='stretch',
    ),
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '<=', 35.0, hold_s=4.0),
        margin=35.0 - 40.0,
        what='stretch',
    ),
    # 20 s have no stretch of 30 s.
    Row(
        id='c1.holds',
        make=lambda: _cars('distance', CARS, '<=', 500.0, hold_s=30.0),
        reason=EMPTY,
        what='stretch',
    ),
    # Up to 40 m for 4 s: 81 of 401 samples.
    Row(
        id='c1.share',
        make=lambda: _cars('distance', CARS, '<=', 40.0, fraction=0.2),
        margin=81 / 401 - 0.2,
    ),
    Row(
        id='c1.share',
        make=lambda: _cars('distance', CARS, '<=', 40.0, fraction=0.5),
        margin=81 / 401 - 0.5,
    ),
    Row(id='c1.share', make=lambda: _cars_late(fraction=0.5), reason=GONE),
    Row(
        id='c1.share',
        make=lambda: _cars('speed', ('car1',), '==', 4.5, fraction=0.9),
        margin=1.0 - 0.9,
        what='speed',
    ),
    Row(
        id='c1.share',
        make=lambda: _cars('speed', ('car1',), '>=', 6.0, fraction=0.9),
        margin=0.0 - 0.9,
        what='speed',
    ),
    # Always exactly 5 m/s.
    Row(
        id='c1.share',
        make=lambda: _cars('speed', ('car1',), '>=', 5.0, fraction=0.9),
        margin=1.0 - 0.9,
        what='threshold',
    ),
    Row(
        id='c1.share',
        make=lambda: _cars('speed', ('car1',), '>', 5.0, fraction=0.9),
        margin=0.0 - 0.9,
        what='threshold',
    ),
    Row(
        id='c1.share',
        make=lambda: gone(_cars('speed', ('car1',), '>=', 6.0, fraction=0.9), 0, 9),
        reason=GONE,
        what='speed',
    ),
)
CITY = ('uav1', 'landmark:City Hall')


def _near_city_hall(quantity: str, op: str, value: float, **more: float) -> Case:
    case = stated(hover_case(drift=1.75), quantity, CITY, op, value, **more)
    place = NamedPlace(name=CITY[1], x_m=120.0, y_m=90.0)
    case.world = replace(case.world, places=(place,))
    return case


def _away_m() -> float:
    """Least distance of the flying UAV of `hover_case` from City Hall, which is a point there."""
    x, y = 120.0, 90.0
    uav = hover_case(drift=1.75).run.trace().uav[:, 0]
    flies = (uav[:, UavColumn.LANDED] < 0.5) | (uav[:, UavColumn.Z] > 0.3)
    return float(np.hypot(uav[flies, 0] - x, uav[flies, 1] - y).min())


def _flown_s() -> float:
    uav = hover_case(drift=1.75).run.trace().uav[:, 0]
    flies = (uav[:, UavColumn.LANDED] < 0.5) | (uav[:, UavColumn.Z] > 0.3)
    return float(flies.sum()) * 0.05


IN_THE_AIR = (
    Row(
        id='c1.holds',
        make=lambda: _near_city_hall('clearance', '>=', 1.0),
        margin=_away_m() - 1.0,
        within=1e-6,
    ),
    Row(
        id='c1.holds',
        make=lambda: _near_city_hall('clearance', '>=', 5000.0),
        margin=_away_m() - 5000.0,
        within=1e-6,
    ),
    Row(
        id='c1.holds',
        make=lambda: grounded(_near_city_hall('clearance', '>=', 1.0)),
        reason=EMPTY,
        what='clearance',
    ),
    Row(
        id='c1.share',
        make=lambda: _near_city_hall('clearance', '>=', 1.0, fraction=0.5),
        margin=0.5,
        what='clearance',
    ),
    Row(
        id='c1.share',
        make=lambda: _near_city_hall('clearance', '>=', 5000.0, fraction=0.5),
        margin=-0.5,
        what='clearance',
    ),
    Row(
        id='c1.share',
        make=lambda: grounded(_near_city_hall('clearance', '>=', 1.0, fraction=0.5)),
        reason=EMPTY,
        what='clearance',
    ),
    # An endurance of 1500 s.
    Row(
        id='c1.holds',
        make=lambda: _hover('battery', UP, '>=', 0.8),
        margin=1.0 - _flown_s() / 1500.0 - 0.8,
        within=1e-6,
    ),
    Row(
        id='c1.holds',
        make=lambda: _hover('battery', UP, '>=', 0.999),
        margin=1.0 - _flown_s() / 1500.0 - 0.999,
        within=1e-6,
    ),
    Row(
        id='c1.holds',
        make=lambda: grounded(_hover('battery', UP, '>=', 0.8)),
        reason=EMPTY,
        what='battery',
    ),
    Row(
        id='c1.share',
        make=lambda: _hover('battery', UP, '>=', 0.8, fraction=0.5),
        margin=0.5,
        what='battery',
    ),
    Row(
        id='c1.share',
        make=lambda: _hover('battery', UP, '<=', 0.8, fraction=0.5),
        margin=-0.5,
        what='battery',
    ),
    Row(
        id='c1.share',
        make=lambda: grounded(_hover('battery', UP, '>=', 0.8, fraction=0.5)),
        reason=EMPTY,
        what='battery',
    ),
)
FLIGHT = (
    Row(id='c1.holds', make=lambda: _hover('altitude', UP, '<=', 35.0), margin=35.0 - 30.0),
    Row(id='c1.holds', make=lambda: _hover('altitude', UP, '>=', 40.0), margin=30.0 - 40.0),
    Row(
        id='c1.holds',
        make=lambda: grounded(_hover('altitude', UP, '<=', 35.0)),
        reason=EMPTY,
        what='altitude',
    ),
    Row(
        id='c1.share',
        make=lambda: _hover('altitude', UP, '<=', 35.0, fraction=0.9),
        margin=1.0 - 0.9,
        what='altitude',
    ),
    Row(
        id='c1.share',
        make=lambda: _hover('altitude', UP, '>=', 40.0, fraction=0.9),
        margin=0.0 - 0.9,
        what='altitude',
    ),
    Row(
        id='c1.share',
        make=lambda: grounded(_hover('altitude', UP, '<=', 35.0, fraction=0.9)),
        reason=EMPTY,
        what='altitude',
    ),
    Row(
        id='c1.holds', make=lambda: _hover('hover_drift', UP, '<=', 1.75), margin=0.0, within=1e-9
    ),
    Row(id='c1.holds', make=lambda: _hover('hover_drift', UP, '<', 1.5), margin=1.5 - 1.75),
    Row(
        id='c1.holds',
        make=lambda: grounded(_hover('hover_drift', UP, '<=', 1.0)),
        reason=EMPTY,
        what='drift',
    ),
    # Farthest from the ego at capture, 1.45 m short of the hover point that is 15 m from it.
    Row(
        id='c1.holds',
        make=lambda: _hover('distance', ('uav1', 'ego'), '<=', 40.0),
        margin=40.0 - math.hypot(30.0, 15.0 + 1.45),
        what='flight',
    ),
    Row(id='c1.holds', make=lambda: _convoy('tracked_fraction', '>=', 0.9), margin=1.0 - 0.9),
    Row(
        id='c1.holds',
        make=lambda: _hidden('tracked_fraction', 0.9),
        margin=1.0 - 100 * 0.05 / TRACKED_S - 0.9,
        within=0.001,
    ),
    Row(id='c1.holds', make=lambda: _bus_gone('tracked_fraction', 0.1), reason=GONE, what='track'),
    Row(id='c1.holds', make=lambda: _convoy('visible_fraction', '>', 0.9), margin=1.0 - 0.9),
    Row(
        id='c1.holds',
        make=lambda: _hidden('visible_fraction', 0.9),
        margin=1.0 - 100 * 0.05 / TRACKED_S - 0.9,
        within=0.001,
        what='sight',
    ),
    Row(id='c1.holds', make=lambda: _bus_gone('visible_fraction', 0.1), reason=GONE, what='sight'),
    Row(
        id='c1.holds',
        make=lambda: _convoy('visible_time', '>=', 20.0),
        margin=TRACKED_S - 20.0,
        within=0.06,
    ),
    Row(
        id='c1.holds',
        make=lambda: _hidden('visible_time', 40.0),
        margin=TRACKED_S - 5.0 - 40.0,
        within=0.06,
    ),
    Row(id='c1.holds', make=lambda: _bus_gone('visible_time', 1.0), reason=GONE, what='seconds'),
    # The longer stretch is the one from capture to tick 600 or from tick 700 to tick 1050.
    Row(
        id='c1.holds',
        make=lambda: _hidden('visible_time', 17.0, hold_s=17.0),
        margin=(600 - 247) * 0.05 - 17.0,
        within=0.06,
        what='unbroken',
    ),
    Row(
        id='c1.holds',
        make=lambda: _hidden('visible_time', 20.0, hold_s=20.0),
        margin=(600 - 247) * 0.05 - 20.0,
        within=0.06,
        what='unbroken',
    ),
    Row(
        id='c1.holds',
        make=lambda: grounded(_convoy('visible_time', '>=', 1.0, hold_s=1.0)),
        reason=EMPTY,
        what='unbroken',
    ),
    Row(id='c1.holds', make=lambda: _event('<=', 40.0), margin=40.0 - 32.25),
    Row(id='c1.holds', make=lambda: _event('<=', 30.0), margin=30.0 - 32.25),
    Row(
        id='c1.holds',
        make=lambda: _event('<=', 40.0, happens=False),
        reason=Reason.PREMISE_NEVER,
    ),
    Row(
        id='c1.holds',
        make=lambda: done_at(_hover('altitude', UP, '<=', 35.0), 700),
        margin=35.0 - 30.0,
        what='ends-in-flight',
    ),
    Row(
        id='c1.holds',
        make=lambda: stated(survey_case(), 'altitude', UP, '>=', 29.0),
        margin=30.0 - 29.0,
        what='route',
    ),
)
ROWS = GROUND + IN_THE_AIR + FLIGHT


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_stated_kinds(row: Row) -> None:
    row.check()
