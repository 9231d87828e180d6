# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A UAV on its way to what moves flies over what stands between, or round it."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from aurora_core.execution.detours import Detours
from aurora_core.grounding.airspace import Airspace
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.mission.machine import MissionMachine, TargetMotion
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UAV_WIDTH, UavColumn, UavCommandColumn

CLEAR_M, TOP_M = 3.0, 120.0
HERE, GOAL = (0.0, 0.0, 30.0), (300.0, 0.0, 30.0)
Ring = tuple[tuple[float, float], ...]
WALL = ((140.0, -50.0), (160.0, -50.0), (160.0, 50.0), (140.0, 50.0))
SHUT = ((-20.0, -20.0), (20.0, -20.0), (20.0, 20.0), (-20.0, 20.0))


def _building(height_m: float, ring: Ring = WALL) -> Airspace:
    tower = Building(
        id='b',
        ring=ring,
        holes=(),
        height_m=height_m,
        height_source='design',
        kind='block',
        name='',
    )
    return Airspace((tower,), ())


def _zone(ring: Ring) -> Airspace:
    return Airspace((), (NoFlyZone(id='z', name='', ring=ring, floor_m=0.0, ceiling_m=1e4),))


def test_a_free_way_is_straight() -> None:
    assert Detours(_building(20.0), CLEAR_M, TOP_M).is_straight(HERE, GOAL)


@pytest.mark.parametrize('airspace', [_building(40.0), _building(119.0), _zone(WALL)])
def test_what_stands_between_is_kept_clear_of(airspace: Airspace) -> None:
    detours = Detours(airspace, CLEAR_M, TOP_M)
    assert not detours.is_straight(HERE, GOAL)
    way = detours.way(HERE, GOAL)
    assert way
    for leg in pairwise((HERE, *way, GOAL)):
        assert airspace.way_clearance_m(leg) >= CLEAR_M
    assert max(point[2] for point in way) <= TOP_M


def test_a_long_low_building_is_flown_over_and_a_tall_one_round() -> None:
    long = ((140.0, -150.0), (160.0, -150.0), (160.0, 150.0), (140.0, 150.0))
    low = Detours(_building(32.0, long), CLEAR_M, TOP_M).way(HERE, GOAL)
    tall = Detours(_building(119.0, long), CLEAR_M, TOP_M).way(HERE, GOAL)
    assert {point[2] for point in low} == {40.0}
    assert {point[2] for point in tall} == {30.0}
    assert max(abs(point[1]) for point in tall) > 150.0


def test_before_a_goal_in_a_zone_it_waits_outside() -> None:
    airspace = _zone(SHUT)
    way = Detours(airspace, CLEAR_M, TOP_M).way(GOAL, (0.0, 0.0, 30.0))
    assert way
    for leg in pairwise((GOAL, *way)):
        assert airspace.way_clearance_m(leg) >= CLEAR_M


def _flown(
    airspace: Airspace, *missions: MissionPlan, car: TargetMotion | None = None, then: str = ''
) -> tuple[MissionMachine, list[tuple[float, ...]]]:
    """Fly missions with perfect control for a minute; an event may begin another one after 5 s."""
    detours = Detours(airspace, CLEAR_M, TOP_M)
    plan = UavPlan(
        id='uav1', system_id=1, home_x_m=0.0, home_y_m=0.0, landing_spots=((0.0, 0.0),),
        missions=missions, safe_altitude_m=120.0,
    )  # fmt: skip
    flight = FlightSettings(
        speed_max_mps=16.5, acceleration_mps2=4.0, climb_mps=4.0, descent_mps=2.5,
        corner_speed_mps=1.5, position_gain_hz=0.8,
    )  # fmt: skip
    machine, state, path = MissionMachine(plan, flight, 0.05), np.zeros(UAV_WIDTH), []
    state[UavColumn.Z] = 30.0
    machine.start()
    for tick in range(1200):
        if then and tick == 100:
            machine.change_to(then)
        detours.look_ahead(tick, 0.05, machine, state, car)
        row = machine.step(tick, state, car)
        state[UavColumn.X : UavColumn.VZ + 1] = row[UavCommandColumn.X : UavCommandColumn.VZ + 1]
        path.append(tuple(state[UavColumn.X : UavColumn.Z + 1].tolist()))
        if machine.missions_done:
            break
    return machine, path


CAR = TargetMotion(x_m=300.0, y_m=0.0, vx_mps=0.0, vy_mps=0.0, heading_x=1.0, heading_y=0.0)


def test_who_is_past_what_stood_between_does_not_climb_over_it_any_more() -> None:
    # The plan says over it, and what is looked at on the way leads round it.
    airspace = _building(60.0)
    mission = MissionPlan(
        id='m1', mode=MissionMode.TRACK, target='car1', altitude_m=30.0, over_m=70.0
    )
    machine, path = _flown(airspace, mission, car=CAR)
    assert machine.captured
    assert airspace.points_clearance_m(np.array(path)) >= CLEAR_M
    assert max(z for x, _, z in path if x > 170.0) < 31.0


@pytest.mark.parametrize('route', [(), ((300.0, 0.0, 30.0), (340.0, 0.0, 30.0))])
def test_who_is_sent_elsewhere_in_the_middle_of_a_tracking_keeps_clear(
    route: tuple[tuple[float, float, float], ...],
) -> None:
    near = TargetMotion(x_m=10.0, y_m=0.0, vx_mps=0.0, vy_mps=0.0, heading_x=1.0, heading_y=0.0)
    tracking = MissionPlan(id='m1', mode=MissionMode.TRACK, target='car1', altitude_m=30.0)
    where = {'hover_point': GOAL, 'duration_s': 5.0} if not route else {'waypoints': route}
    mode = MissionMode.NAVIGATE if route else MissionMode.HOVER
    later = MissionPlan(id='m2', mode=mode, altitude_m=30.0, waits=True, **where)
    airspace = _building(119.0)
    machine, path = _flown(airspace, tracking, later, car=near, then='m2')
    assert 'm2' in machine.captured_missions
    assert airspace.points_clearance_m(np.array(path)) >= CLEAR_M


@pytest.mark.parametrize(('top_m', 'low_m'), [(0.1, 15.0), (14.0, 30.0)])
def test_who_stays_where_it_is_stays_as_high_over_a_roof(top_m: float, low_m: float) -> None:
    under = TargetMotion(x_m=10.0, y_m=0.0, vx_mps=0.0, vy_mps=0.0, heading_x=1.0, heading_y=0.0)
    tracking = MissionPlan(id='m1', mode=MissionMode.TRACK, target='car1', altitude_m=30.0)
    stays = MissionPlan(
        id='m2', mode=MissionMode.HOVER, altitude_m=15.0, rest_mps=0.5, waits=True, duration_s=5.0
    )
    airspace = _building(top_m, SHUT)
    machine, path = _flown(airspace, tracking, stays, car=under, then='m2')
    assert ('m2' in machine.captured_missions) is (low_m == 15.0)
    assert min(z for _, _, z in path) == pytest.approx(low_m, abs=2.1)
