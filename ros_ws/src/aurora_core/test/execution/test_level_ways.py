# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A way at a stated height: down at the nearest place that lets a UAV, then round at it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from aurora_core.execution.detours import Detours
from aurora_core.execution.level_ways import level_way
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.map_types import Building
from aurora_core.mission.machine import MissionMachine
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UAV_WIDTH, UavColumn, UavCommandColumn

CLEAR_M, TOP_M = 3.0, 120.0
Ring = tuple[tuple[float, float], ...]
# Below where it is; across the way; all round it.
ROOF = ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))
WALL = ((140.0, -50.0), (160.0, -50.0), (160.0, 50.0), (140.0, 50.0))
COURT = tuple(
    ((x0, y0), (x1, y0), (x1, y1), (x0, y1))
    for x0, y0, x1, y1 in (
        (-40.0, -40.0, 40.0, -30.0), (-40.0, 30.0, 40.0, 40.0),
        (-40.0, -40.0, -30.0, 40.0), (30.0, -40.0, 40.0, 40.0),
    )
)  # fmt: skip
HERE, GOAL = (0.0, 0.0, 70.0), (300.0, 0.0, 30.0)


def _air(*rings: Ring, height_m: float = 50.0) -> Airspace:
    solids = (
        Building(
            id=f'b{k}', ring=ring, holes=(), height_m=height_m, height_source='design',
            kind='block', name='',
        )
        for k, ring in enumerate(rings)
    )  # fmt: skip
    return Airspace(tuple(solids), ())


@pytest.mark.parametrize(
    ('airspace', 'off_m'),
    [(_air(), 0.0), (_air(WALL), 0.0), (_air(ROOF), 40.0), (_air(ROOF, WALL), 40.0),
     (_air(*COURT), 60.0)],
    ids=['free', 'wall', 'roof', 'roof-and-wall', 'court'],
)  # fmt: skip
def test_it_comes_to_its_height_first_and_keeps_clear(airspace: Airspace, off_m: float) -> None:
    way = level_way(airspace, HERE, GOAL, CLEAR_M)
    assert way[-1] == GOAL
    for leg in pairwise((HERE, *way)):
        assert airspace.way_clearance_m(leg) >= CLEAR_M
    level = [point for point in way if point[2] == GOAL[2]]
    above = [point for point in way if point[2] != GOAL[2]]
    assert all(point[2] == HERE[2] for point in above)
    assert max((abs(x) for x, _, _ in above), default=0.0) <= off_m
    assert level[0][:2] == (above[-1][:2] if above else HERE[:2])


def test_where_no_way_at_its_height_is_there_is_none() -> None:
    shut = ((280.0, -20.0), (320.0, -20.0), (320.0, 20.0), (280.0, 20.0))
    assert level_way(_air(shut), HERE, GOAL, CLEAR_M) == ()


@pytest.mark.parametrize('rings', [(), (WALL,), (ROOF, WALL), COURT])
@pytest.mark.parametrize('over_m', [None, 80.0])
def test_the_whole_way_is_flown_at_it(rings: tuple[Ring, ...], over_m: float | None) -> None:
    airspace = _air(*rings)
    detours = Detours(airspace, CLEAR_M, TOP_M)
    first = MissionPlan(
        id='m1', mode=MissionMode.HOVER, altitude_m=70.0, hover_point=HERE, duration_s=1.0
    )
    second = MissionPlan(
        id='m2', mode=MissionMode.NAVIGATE, altitude_m=30.0, waypoints=(GOAL,), over_m=over_m,
        level_way=True,
    )  # fmt: skip
    plan = UavPlan(
        id='uav1', system_id=1, home_x_m=0.0, home_y_m=0.0, landing_spots=((0.0, 0.0),),
        missions=(first, second), safe_altitude_m=120.0,
    )  # fmt: skip
    flight = FlightSettings(
        speed_max_mps=16.5, acceleration_mps2=4.0, climb_mps=4.0, descent_mps=2.5,
        corner_speed_mps=1.5, position_gain_hz=0.8,
    )  # fmt: skip
    machine, state, path = MissionMachine(plan, flight, 0.05), np.zeros(UAV_WIDTH), []
    state[UavColumn.Z] = 70.0
    machine.start()
    for tick in range(2400):
        detours.look_ahead(tick, 0.05, machine, state, None)
        row = machine.step(tick, state, None)
        state[UavColumn.X : UavColumn.VZ + 1] = row[UavCommandColumn.X : UavCommandColumn.VZ + 1]
        path.append(tuple(state[UavColumn.X : UavColumn.Z + 1].tolist()))
        if machine.missions_done:
            break
    assert 'm2' in machine.captured_missions
    assert airspace.points_clearance_m(np.array(path)) >= CLEAR_M
    out = [z for x, y, z in path if max(abs(x), abs(y)) > 65.0]
    assert max(out) <= 31.0
    assert min(out) >= 29.0
