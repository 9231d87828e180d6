# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What events order a UAV to: to land, to climb, to go on with another mission."""

from __future__ import annotations

from math import sqrt

import pytest
from flown_missions import (
    HOME,
    Follower,
    hover_plan,
    land_at,
    machine_of,
    route_plan,
)

from aurora_core.mission.plan import MissionPlan
from aurora_core.trace.layout import (
    UavColumn,
    UavCommandColumn,
    UavMode,
    UavPhase,
)


def test_landing_climbs_first_then_flies_across_then_sinks() -> None:
    machine = machine_of(hover_plan())
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.needs_landing_spot()
    start = follower.tick
    land_at(follower, spot=(-60.0, 10.0), altitude=60.0)
    assert machine.landing_spot == (-60.0, 10.0)
    flown = follower.states[start:]
    crossing = [s for s in flown if sqrt((s[0] - 40.0) ** 2 + s[1] ** 2) > 5.0 and s[2] > 0.0]
    away = [s for s in crossing if sqrt((s[0] + 60.0) ** 2 + (s[1] - 10.0) ** 2) > 5.0]
    assert min(s[2] for s in away) >= 59.0
    down = follower.states[-1]
    assert sqrt((down[0] + 60.0) ** 2 + (down[1] - 10.0) ** 2) <= 0.5
    assert machine.landed


def test_land_now_ends_a_mission() -> None:
    machine = machine_of(hover_plan(duration_s=600.0))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    machine.land_now()
    assert machine.missions_done
    land_at(follower)
    assert follower.phases()[-1] == UavPhase.LANDING


@pytest.mark.parametrize('last', [hover_plan('m2'), route_plan('m2')])
def test_a_uav_that_is_to_stay_up_goes_on_with_its_last_mission(last: MissionPlan) -> None:
    machine = machine_of(hover_plan(), last)
    machine.stays_up = True
    follower = Follower(machine)
    machine.start()
    follower.until(lambda: machine.mission is not None and machine.mission.id == 'm2')
    for _ in range(1200):  # 60 s: more than the phase and its way take
        follower.step()
    assert machine.phase == UavPhase.MISSION + 1
    machine.stays_up = False
    follower.step()
    assert machine.missions_done


def test_land_now_while_climbing_lands_from_where_the_uav_is() -> None:
    machine = machine_of(hover_plan())
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: follower.state[UavColumn.Z] > 15.0)
    height = float(follower.state[UavColumn.Z])
    machine.land_now()
    follower.step()
    assert machine.needs_landing_spot()
    machine.set_landing_spot(HOME, height)
    land_at(follower)
    # No dive: no set-point below the UAV before it lands.
    offboard = [r for r in follower.rows if r[UavCommandColumn.MODE] == UavMode.OFFBOARD]
    assert offboard
    assert all(abs(r[UavCommandColumn.Z] - height) < 2.0 for r in offboard)


@pytest.mark.parametrize('when', ['before', 'after'])
def test_land_now_on_the_ground_changes_nothing(when: str) -> None:
    machine = machine_of(hover_plan())
    follower = Follower(machine)
    if when == 'after':
        machine.start()
        follower.until(lambda: machine.missions_done)
        land_at(follower)
    machine.land_now()
    assert machine.phase_name == ('idle' if when == 'before' else 'landing')
    follower.step()
    assert follower.rows[-1][UavCommandColumn.MODE] == UavMode.IDLE


def test_a_mission_that_waits_is_held_for_where_the_one_before_ended() -> None:
    second = hover_plan('m2', hover_point=(-40.0, 20.0, 30.0), waits=True)
    machine = machine_of(hover_plan(), second)
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.phase == UavPhase.HOLDING)
    for _ in range(400):
        follower.step()
    assert machine.phase == UavPhase.HOLDING
    assert not machine.missions_done
    assert follower.state[:3] == pytest.approx([40.0, 0.0, 30.0], abs=0.5)
    machine.change_to('m2')
    follower.until(lambda: machine.missions_done)
    assert follower.state[:2] == pytest.approx([-40.0, 20.0], abs=1.0)
    assert machine.captured_missions == {'m1', 'm2'}


def test_an_event_ends_a_mission_at_once_and_never_goes_back() -> None:
    machine = machine_of(hover_plan(until_event=True), route_plan('m2', waits=True))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    for _ in range(400):  # five times as long as planned
        follower.step()
    assert machine.phase == UavPhase.MISSION
    machine.change_to('m2')
    follower.step()
    assert machine.phase == UavPhase.MISSION + 1
    machine.change_to('m1')
    follower.step()
    assert machine.phase == UavPhase.MISSION + 1


def test_a_first_mission_that_waits_keeps_a_uav_on_the_ground() -> None:
    machine = machine_of(hover_plan(waits=True))
    machine.start()
    follower = Follower(machine)
    for _ in range(100):
        follower.step()
    assert machine.waits_on_ground
    assert follower.state[UavColumn.Z] == 0.0
    machine.change_to('m1')
    follower.until(lambda: machine.captured)
    assert follower.phases() == [UavPhase.IDLE, UavPhase.ASCENT, UavPhase.MISSION]


@pytest.mark.parametrize('mission', [hover_plan(duration_s=20.0), route_plan(speed_mps=3.0)])
def test_a_climb_that_an_event_asks_for_lasts_to_the_end_of_the_mission(
    mission: MissionPlan,
) -> None:
    machine = machine_of(mission, hover_plan('m2', duration_s=10.0))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    machine.climb_to(45.0)
    follower.until(lambda: machine.phase == UavPhase.MISSION + 1)
    assert follower.state[UavColumn.Z] == pytest.approx(45.0, abs=0.5)
    follower.until(lambda: machine.missions_done)
    assert follower.state[UavColumn.Z] == pytest.approx(30.0, abs=0.5)


@pytest.mark.parametrize(('to_m', 'vertical_mps'), [(60.0, 1.5), (10.0, 0.8)])
def test_a_stated_vertical_speed_is_flown_for_that_climb_alone(
    to_m: float, vertical_mps: float
) -> None:
    machine = machine_of(hover_plan(duration_s=200.0))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    before = len(follower.rows)
    machine.climb_to(to_m, vertical_mps)
    follower.until(lambda: abs(follower.state[UavColumn.Z] - to_m) < 0.5)
    rates = [abs(r[UavCommandColumn.VZ]) for r in follower.rows[before:]]
    assert max(rates) == pytest.approx(vertical_mps)
    before = len(follower.rows)
    machine.climb_to(30.0)
    follower.until(lambda: abs(follower.state[UavColumn.Z] - 30.0) < 0.5)
    assert max(abs(r[UavCommandColumn.VZ]) for r in follower.rows[before:]) > 2.0


def test_a_uav_that_is_not_to_land_holds_its_place() -> None:
    machine = machine_of(hover_plan(), lands=False)
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.done)
    assert machine.missions_done
    assert not machine.landed
    assert follower.phases()[-1] == UavPhase.HOLDING
    assert follower.state[:3] == pytest.approx([40.0, 0.0, 30.0], abs=0.5)
