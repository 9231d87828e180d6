# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Kinds of safety conditions: satisfied, violated, not judged.

What is asked of every tick has no premise that could fail to happen: it is not judged when the
record is cut short, and what is asked of a flight when the UAV never flies.
"""

from __future__ import annotations

import numpy as np
import pytest
from kind_rows import Row, cut, gone, grounded
from trace_builder import building, flight, world, zone
from trace_cases import Case, agent, ground_case, hover_case, spec

from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.scenario import Behavior
from aurora_core.spec.vocabulary import BehaviorKind
from aurora_core.trace.layout import UavColumn, UavCommandColumn

T = 401  # 20 s


def _cars(x: float = 20.0, speed: float = 0.0) -> Case:
    """Two cars, 4.5 m long, the second one x m ahead of the first."""
    kind = BehaviorKind.DRIVE if speed else BehaviorKind.PARK
    return ground_case(Behavior(kind=kind), np.full(T, speed), car2=(x, np.full(T, speed)))


def _walker(speed: float) -> Case:
    case = _cars(speed=speed)
    case.run.agents[0].type = 'pedestrian'
    case.spec = spec(agents=(agent('car1', 'pedestrian'), agent('car2', 'car')))
    return case


def _jumping() -> Case:
    case = _cars(speed=5.0)
    case.run.agents[0].x[100:] += 4.0
    return case


def _state(column: UavColumn, value: float) -> Case:
    case = hover_case()
    case.run.flights[0].states[700, column] = value
    return case


def _command(column: UavCommandColumn, value: float) -> Case:
    case = hover_case()
    case.run.flights[0].commands[700, column] = value
    return case


def _on_ground() -> Case:
    return grounded(hover_case())


def _wall() -> Case:
    case = hover_case()
    case.world = world(buildings=(building(95.0, 21.0, 105.0, 30.0, 60.0),))
    return case


def _zone(x: float) -> Case:
    """The UAV hovers at (100, 0); a no-fly zone of 10 m x 10 m begins at x."""
    case = hover_case()
    case.world = world(zones=(zone(x, -5.0, x + 10.0, 5.0, 0.0, 200.0),))
    return case


def _pair(meets: bool = False) -> Case:
    """A second UAV stays over (200, 20.2); at tick 700 it may be 4 m beside the first one."""
    case = hover_case()
    second = flight(1401, (200.0, 20.2), 30.0, landing=900, id='uav2')
    if meets:
        second.states[700, UavColumn.X : UavColumn.Z + 1] = (104.0, 0.0, 30.0)
    case.run.flights.append(second)
    case.spec = spec(**{**dict(case.spec), 'uavs': ({'id': 'uav1'}, {'id': 'uav2'})})
    return case


def _long_flight() -> Case:
    """In the air from tick 1 on, down after 30 m at 0.1 m per tick: 1530 s."""
    ticks, landing = 31001, 30301
    case = hover_case()
    case.run.agents.clear()
    case.run.flights = [flight(ticks, (100.0, 0.0), 30.0, landing=landing)]
    case.run.ticks = ticks
    case.facts = case.facts.model_validate(dict(case.facts) | {'horizon_s': ticks * 0.05})
    (one,) = case.spec.missions
    case.spec = spec(uavs=case.spec.uavs, missions=(dict(one) | {'target': None},))
    return case


EMPTY, SHORT = Reason.EMPTY_PHASE, Reason.TRACE_SHORT
# In the air from tick 1 on; landing from 45 s on, 30 m down with 2 m/s.
FLOWN_S = 45.0 + 15.0
ROWS = (
    Row(id='safety.collision', make=_cars, margin=20.0 - 4.5),
    Row(id='safety.collision', make=lambda: _cars(4.5), margin=0.0, what='touching'),
    # 2 m overlap along, 1.8 m across: the lesser one parts them.
    Row(id='safety.collision', make=lambda: _cars(2.5), margin=-1.8),
    Row(id='safety.collision', make=lambda: cut(_cars(), 200), reason=SHORT),
    Row(id='safety.presence', make=_cars, margin=1.0 - 0.5),
    Row(id='safety.presence', make=lambda: gone(_cars(), 1, T - 1), margin=0.0 - 0.5),
    Row(id='safety.presence', make=lambda: cut(_cars(), 200), reason=SHORT),
    Row(id='safety.jump', make=lambda: _cars(speed=5.0), margin=60.0 - 5.0),
    Row(id='safety.jump', make=_jumping, margin=60.0 - (5.0 + 4.0 / 0.05)),
    Row(id='safety.jump', make=lambda: cut(_cars(), 200), reason=SHORT),
    # 50 m/s and 1 %; 3 m/s and 1 %.
    Row(id='safety.vehicle_speed', make=lambda: _cars(speed=50.0), margin=50.5 - 50.0),
    Row(id='safety.vehicle_speed', make=lambda: _cars(speed=51.0), margin=50.5 - 51.0),
    Row(id='safety.vehicle_speed', make=lambda: cut(_cars(), 200), reason=SHORT),
    Row(id='safety.pedestrian_speed', make=lambda: _walker(1.5), margin=3.03 - 1.5),
    Row(id='safety.pedestrian_speed', make=lambda: _walker(3.5), margin=3.03 - 3.5),
    # Landing beside the ego, whose side is at y = -15 + 0.9.
    Row(id='safety.clearance.uav1', make=hover_case, margin=14.1 - 3.0),
    Row(id='safety.clearance.uav1', make=_wall, margin=0.8 - 3.0),
    Row(id='safety.clearance.uav1', make=_on_ground, reason=EMPTY),
    Row(id='safety.clearance.uav1', make=lambda: cut(hover_case(), 800), reason=SHORT),
    # 120 m and 3 %.
    Row(id='safety.altitude_max.uav1', make=hover_case, margin=123.6 - 30.0),
    Row(
        id='safety.altitude_max.uav1',
        make=lambda: _state(UavColumn.Z, 125.0),
        margin=123.6 - 125.0,
    ),
    Row(id='safety.altitude_max.uav1', make=_on_ground, reason=EMPTY),
    # 3 m less 2 m.
    Row(id='safety.altitude_min.uav1', make=hover_case, margin=30.0 - 1.0),
    Row(id='safety.altitude_min.uav1', make=lambda: _state(UavColumn.Z, 0.5), margin=0.5 - 1.0),
    Row(id='safety.altitude_min.uav1', make=_on_ground, reason=EMPTY),
    Row(id='safety.altitude_command.uav1', make=hover_case, margin=30.0 - 3.0),
    Row(
        id='safety.altitude_command.uav1',
        make=lambda: _command(UavCommandColumn.Z, 121.0),
        margin=120.0 - 121.0,
    ),
    Row(id='safety.altitude_command.uav1', make=_on_ground, reason=EMPTY),
    # 18 m/s and 10 %; on its way the UAV flies 15 m/s.
    Row(id='safety.speed.uav1', make=hover_case, margin=19.8 - 15.0),
    Row(id='safety.speed.uav1', make=lambda: _state(UavColumn.VX, 20.0), margin=19.8 - 20.0),
    Row(id='safety.speed.uav1', make=_on_ground, reason=EMPTY),
    Row(id='safety.speed_command.uav1', make=hover_case, margin=18.0 - 15.0),
    Row(
        id='safety.speed_command.uav1',
        make=lambda: _command(UavCommandColumn.VY, 18.5),
        margin=18.0 - 18.5,
    ),
    Row(id='safety.speed_command.uav1', make=_on_ground, reason=EMPTY),
    # 5 m/s and 1 %; 3 m/s and 1 %.
    Row(id='safety.climb.uav1', make=hover_case, margin=5.05 - 4.0),
    Row(id='safety.climb.uav1', make=lambda: _state(UavColumn.VZ, 5.3), margin=5.05 - 5.3),
    Row(id='safety.climb.uav1', make=_on_ground, reason=EMPTY),
    Row(id='safety.descent.uav1', make=hover_case, margin=3.03 - 2.0),
    Row(id='safety.descent.uav1', make=lambda: _state(UavColumn.VZ, -3.5), margin=3.03 - 3.5),
    Row(id='safety.descent.uav1', make=_on_ground, reason=EMPTY),
    Row(id='safety.no_fly.uav1', make=lambda: _zone(110.0), margin=10.0),
    Row(id='safety.no_fly.uav1', make=lambda: _zone(95.0), margin=-5.0),
    Row(id='safety.no_fly.uav1', make=_on_ground, reason=EMPTY),
    # Nearest above their two homes.
    Row(id='safety.separation.uav1.uav2', make=_pair, margin=100.0 - 5.0),
    Row(id='safety.separation.uav1.uav2', make=lambda: _pair(meets=True), margin=4.0 - 5.0),
    Row(id='safety.separation.uav1.uav2', make=lambda: grounded(_pair()), reason=EMPTY),
    # 1500 s and 1 %.
    Row(id='safety.endurance.uav1', make=hover_case, margin=1515.0 - FLOWN_S, within=0.16),
    Row(id='safety.endurance.uav1', make=_long_flight, margin=1515.0 - 1530.0, within=0.16),
    Row(id='safety.endurance.uav1', make=_on_ground, reason=EMPTY),
)


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.name)
def test_safety_kinds(row: Row) -> None:
    row.check()
