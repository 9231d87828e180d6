# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A flight to a place is flown at its stated height all the way, once that is come to."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import Any

import pytest
from kind_rows import Row, grounded
from trace_builder import TOLERANCES, Run, building, flight, number, world
from trace_cases import Case, facts_of, mission, spec

from aurora_core.knowledge.world import NamedPlace
from aurora_core.outcomes.schedule import MissionFacts
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Unit
from aurora_core.spec.scenario import Uav
from aurora_core.spec.vocabulary import MissionMode, Pattern

# The second mission begins with this tick, 200 m before its place, and lands with the other.
BEGINS, LANDS, TICKS = 600, 1310, 1801
HIGH_M, ASKED_M = 70.0, 40.0
FROM, TO = (100.0, 0.0), (300.0, 0.0)
PLACE = 'landmark:City Hall'
# It flies and sinks so far in a tick (m).
ACROSS_M, DOWN_M = 0.5, 0.1
SINKS = 300


def _flies_to(
    sinks_at_m: float,
    *,
    slant: bool = False,
    roof: bool = False,
    hovers: bool = False,
    **asked: object,
) -> Case:
    """A drone hovers 70 m high, then flies 200 m to a place where it is to be 40 m high.

    Args:
        sinks_at_m: So far on its way it sinks to that.
        slant: It sinks all along instead.
        roof: A building of 60 m stands below the way, from 2 m to 140 m of it.
        hovers: It is told to hover there after that way, for 10 s.
        asked: More of the second mission.
    """

    def path(k: int) -> tuple[float, float, float]:
        ticks = max(0, k - BEGINS)
        before = round(sinks_at_m / ACROSS_M)
        sunk = min(max(0, ticks - before), SINKS)
        way_m = min(ACROSS_M * (ticks if slant else ticks - sunk), 200.0)
        height_m = HIGH_M - 30.0 * way_m / 200.0 if slant else HIGH_M - DOWN_M * sunk
        return FROM[0] + way_m, 0.0, height_m

    one = flight(TICKS, FROM, HIGH_M, path, landing=LANDS, later=(BEGINS,))
    first = mission(
        'm1', MissionMode.HOVER, altitude_m=number(HIGH_M), duration_s=number(10.0, Unit.SECOND)
    )
    there = {
        'target': PLACE,
        'pattern': Pattern.WAYPOINTS,
        'waypoint_count': number(1.0, Unit.ONE),
        'altitude_m': number(ASKED_M, explicit=True),
    }
    second = mission('m2', MissionMode.NAVIGATE, **(there | asked))
    hover = MissionFacts(
        mission='m1', uav='uav1', mode=MissionMode.HOVER, altitude_m=HIGH_M, duration_s=10.0,
        hover_point=(*FROM, HIGH_M),
    )  # fmt: skip
    way = MissionFacts(
        mission='m2', uav='uav1', mode=MissionMode.NAVIGATE, altitude_m=ASKED_M,
        waypoints=((*TO, ASKED_M),), transit_m=200.0,
    )  # fmt: skip
    if hovers:
        second = mission(
            'm2',
            MissionMode.HOVER,
            target=PLACE,
            altitude_m=number(ASKED_M, explicit=True),
            duration_s=number(10.0, Unit.SECOND),
            way_at_altitude=True,
        )
        way = MissionFacts(
            mission='m2', uav='uav1', mode=MissionMode.HOVER, altitude_m=ASKED_M, duration_s=10.0,
            hover_point=(*TO, ASKED_M), transit_m=200.0,
        )  # fmt: skip
    below = (building(102.0, -50.0, 240.0, 50.0, 60.0),) if roof else ()
    return Case(
        spec=spec(uavs=(Uav(id='uav1'),), missions=(first, second)),
        facts=facts_of(hover, way, horizon_s=90.0),
        world=replace(world(below), places=(NamedPlace(name=PLACE, x_m=TO[0], y_m=TO[1]),)),
        run=Run(ticks=TICKS, flights=[one]),
    )


# Metres count from 5 m on, up to where it captures, 3 m before its place: 6 to 197.
COUNTED = 192
WAY = 'm2.way_altitude'
ROWS = (
    Row(id=WAY, make=partial(_flies_to, 0.0), margin=0.05, what='first'),
    Row(id=WAY, make=partial(_flies_to, 4.0), margin=0.05, what='while-it-brakes'),
    Row(id=WAY, make=partial(_flies_to, 200.0), margin=-0.95, what='at-the-end'),
    Row(
        id=WAY,
        make=partial(_flies_to, 200.0, hovers=True),
        margin=-0.95,
        what='at-the-end-before-a-hover',
    ),
    # From 42 m on it is as asked: that is with 13.3 m to go, of which 3 m do not count.
    Row(
        id=WAY,
        make=partial(_flies_to, 0.0, slant=True),
        margin=11.0 / COUNTED - 0.95,
        within=1.5 / COUNTED,
        what='all-along',
    ),
    Row(
        id=WAY,
        make=partial(_flies_to, 105.0),
        margin=92.0 / COUNTED - 0.95,
        within=1.5 / COUNTED,
        what='half-way',
    ),
    # Over the roof, and 5 m beside it, there is no room at 40 m: 145 m of the way do not count.
    Row(id=WAY, make=partial(_flies_to, 145.0, roof=True), margin=52.0 / 53.0 - 0.95, what='roof'),
    Row(
        id=WAY,
        make=partial(_flies_to, 170.0, roof=True),
        margin=27.0 / 52.0 - 0.95,
        within=1.5 / 52.0,
        what='too-late-behind-a-roof',
    ),
    Row(id=WAY, make=lambda: grounded(_flies_to(0.0)), reason=Reason.EMPTY_PHASE),
    # 200 m at 8 m/s, and 30 m down at 1.8 m/s before that, do not count.
    Row(
        id='m2.capture',
        make=partial(_flies_to, 0.0),
        margin=30.0 - (694 * 0.05 - 200.0 / 8.0 - 30.0 / 1.8),
        within=0.06,
        what='down-first',
    ),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_the_height_of_a_way(row: Row) -> None:
    row.check()


def _ids(**asked: Any) -> set[str]:
    row = Row(id=WAY, make=partial(_flies_to, 0.0, **asked))
    return {c.id for c in row.conditions()}


def test_a_height_that_nobody_states_is_not_that_of_the_way() -> None:
    assert WAY in _ids()
    assert WAY not in _ids(altitude_m=number(ASKED_M))


def test_the_tolerances_that_the_margins_were_worked_out_with() -> None:
    assert TOLERANCES.phase_follow_m == 5.0
    assert TOLERANCES.waypoint_horizontal_m == 3.0
    assert TOLERANCES.altitude_share == 0.95
