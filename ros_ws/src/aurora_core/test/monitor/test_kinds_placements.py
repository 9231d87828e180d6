# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where somebody starts, and stays, beside others: satisfied, violated, not judged."""

from __future__ import annotations

import numpy as np
import pytest
from kind_rows import Row, cut, gone
from trace_builder import number
from trace_cases import Case, convoy_case, ground_case, ramp, spec, tailgate_case

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind as B
from aurora_core.spec.vocabulary import Relation

T = 401  # 20 s
STILL = np.zeros(T)
GONE, SHORT, NEVER = Reason.TARGET_GONE, Reason.TRACE_SHORT, Reason.PREMISE_NEVER


def _bus(x: float) -> Case:
    """The bus is asked 20 m ahead of the ego; here it is at x."""
    case = convoy_case()
    case.run.agents[1].x += x - 20.0
    return case


def _kept(bound: Bound, mps: float = 10.0, *, throughout: bool = False) -> Case:
    """The bus starts 20 m ahead, drives at `mps`, and is to keep 20 m, or 20.5 m at most."""
    top = mps / 10.0
    asked_m = 20.5 if bound is Bound.AT_MOST else 20.0
    case = convoy_case(bus1=ramp(1401, 0, 10.0) * top)
    bus = case.spec.agents[1]
    distance = number(asked_m, explicit=True, bound=bound)
    place = bus.placements[0].model_copy(update={'distance_m': distance, 'throughout': throughout})
    agents = list(case.spec.agents)
    agents[1] = bus.model_copy(update={'placements': (place,)})
    case.spec = case.spec.model_copy(update={'agents': tuple(agents)})
    return case


def _bus_gone() -> Case:
    return gone(convoy_case(), 1, 0, 4)


def _leaves_route() -> Case:
    """The bus leaves the route of the ego half-way to the landing command at tick 1050."""
    case = convoy_case()
    case.run.agents[1].y[525:] = 30.0
    return case


def _bearing(degrees: float) -> Case:
    """car1 stands 20 m east of the ego and is asked at some bearing near it."""
    case = ground_case(Behavior(kind=B.PARK), STILL, ego=(-20.0, STILL))
    place = Placement(
        relation=Relation.NEAR,
        of='ego',
        bearing_deg=number(degrees, Unit.DEGREE, explicit=True),
    )
    agents = (dict(case.spec.agents[0]) | {'placements': (place,)}, case.spec.agents[1])
    case.spec = spec(agents=agents)
    return case


def _van(shift: float = 0.0, moves: bool = True) -> Case:
    """The van is asked 45 m behind the ego at t = 0 and when it starts to close."""
    case = tailgate_case(keeps_away=not moves)
    van = case.run.agents[1]
    van.x -= shift
    if not moves:
        van.x[:], van.speed[:] = -45.0, 0.0
    return case


ROWS = (
    Row(id='bus1.placed', make=convoy_case, margin=20.0),
    Row(id='bus1.placed', make=lambda: _bus(-12.0), margin=-12.0),
    Row(id='bus1.placed', make=_bus_gone, reason=GONE),
    # 1 m is allowed on 20 m.
    Row(id='bus1.placed.distance', make=convoy_case, margin=1.0),
    Row(id='bus1.placed.distance', make=lambda: _bus(17.0), margin=1.0 - 3.0),
    Row(id='bus1.placed.distance', make=_bus_gone, reason=GONE),
    Row(id='bus1.placed.kept', make=convoy_case, margin=1.0 - 0.8),
    Row(id='bus1.placed.kept', make=_leaves_route, margin=0.5 - 0.8),
    Row(id='bus1.placed.kept', make=lambda: cut(convoy_case(), 900), reason=SHORT),
    # All along instead of for 80 % of the time.
    Row(
        id='bus1.placed.kept',
        make=lambda: _kept(Bound.EXACTLY, throughout=True),
        margin=0.0,
        what='throughout',
    ),
    # At 11 m/s it is 0.5 m farther away after 2.25 s.
    Row(id='bus1.placed.distance_kept', make=lambda: _kept(Bound.AT_MOST), margin=1.0 - 0.8),
    Row(
        id='bus1.placed.distance_kept',
        make=lambda: _kept(Bound.AT_MOST, 11.0),
        margin=45 / 1050 - 0.8,
        within=0.01,
    ),
    Row(id='bus1.placed.distance_kept', make=lambda: _kept(Bound.AT_LEAST, 11.0), margin=0.2),
    # 1 m more is allowed: at 10.01 m/s all the time, at 10.5 m/s for 4.5 s.
    Row(
        id='bus1.placed.distance_kept',
        make=lambda: _kept(Bound.EXACTLY, 10.01, throughout=True),
        margin=0.0,
        what='throughout',
    ),
    Row(
        id='bus1.placed.distance_kept',
        make=lambda: _kept(Bound.EXACTLY, 10.5, throughout=True),
        margin=4.5 / 52.5 - 1.0,
        within=0.02,
        what='throughout',
    ),
    Row(
        id='bus1.placed.distance_kept',
        make=lambda: cut(_kept(Bound.AT_MOST), 900),
        reason=SHORT,
    ),
    # Told with motion: for 80 % of the time in which the bus is faster than 2 m/s.
    Row(id='bus1.placed.distance_kept', make=lambda: _kept(Bound.EXACTLY), margin=0.2),
    Row(
        id='bus1.placed.distance_kept',
        make=lambda: _kept(Bound.EXACTLY, 11.0),
        margin=44 / 1031 - 0.8,
    ),
    Row(id='bus1.placed.distance_kept', make=lambda: _kept(Bound.EXACTLY, 0.1), reason=NEVER),
    # East is 90 degrees; 15 are allowed.
    Row(id='car1.placed.bearing', make=lambda: _bearing(100.0), margin=15.0 - 10.0),
    Row(id='car1.placed.bearing', make=lambda: _bearing(60.0), margin=15.0 - 30.0),
    Row(id='car1.placed.bearing', make=lambda: gone(_bearing(90.0), 1, 0), reason=GONE),
    Row(id='van1.tailgate.from_start', make=_van, margin=1.0),
    Row(id='van1.tailgate.from_start', make=lambda: _van(3.0), margin=1.0 - 3.0),
    Row(id='van1.tailgate.from_start', make=lambda: gone(_van(), 1, 0, 9), reason=GONE),
    Row(id='van1.tailgate.from_closing', make=_van, margin=1.0, within=0.01),
    Row(id='van1.tailgate.from_closing', make=lambda: _van(3.0), margin=1.0 - 3.0, within=0.01),
    Row(id='van1.tailgate.from_closing', make=lambda: _van(moves=False), reason=NEVER),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_placement_kinds(row: Row) -> None:
    row.check()
