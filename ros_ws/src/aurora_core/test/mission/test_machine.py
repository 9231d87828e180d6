# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The state machine goes from phase to phase on realised predicates only."""

from __future__ import annotations

import itertools
from functools import partial
from math import sqrt
from typing import Any

import numpy as np
import pytest
from flown_missions import (
    DT_S,
    SETTINGS,
    Follower,
    hover_plan,
    land_at,
    machine_of,
    route_plan,
)

from aurora_core.mission.machine import TargetMotion
from aurora_core.mission.plan import MissionPlan
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import (
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
    UavPhase,
)


def _track(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.TRACK,
        'target': 'car1',
        'altitude_m': 30.0,
        'duration_s': 4.0,
    }
    return MissionPlan(**(fields | changes))


def test_before_the_start_it_idles() -> None:
    machine = machine_of(hover_plan())
    follower = Follower(machine)
    follower.step()
    assert machine.phase_name == 'idle'
    assert follower.rows[1][UavCommandColumn.MODE] == UavMode.IDLE
    assert machine.mission is None


def test_a_uav_without_missions_never_leaves_the_ground() -> None:
    machine = machine_of()
    machine.start()
    follower = Follower(machine)
    for _ in range(20):
        follower.step()
    assert follower.phases() == [UavPhase.IDLE]
    assert max(s[UavColumn.Z] for s in follower.states) == 0.0


def test_hover_from_take_off_to_landing() -> None:
    machine = machine_of(hover_plan())
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.needs_landing_spot()
    land_at(follower)
    assert follower.phases() == [0, UavPhase.ASCENT, UavPhase.MISSION, UavPhase.LANDING]
    modes = {int(r[UavCommandColumn.MODE]) for r in follower.rows}
    assert modes == {UavMode.IDLE, UavMode.TAKEOFF, UavMode.OFFBOARD, UavMode.LAND}
    assert follower.states[-1][UavColumn.ARMED] == 0.0
    follower.step()
    assert follower.rows[-1][UavCommandColumn.MODE] == UavMode.IDLE  # landed: no more commands
    assert all(r[UavCommandColumn.YAW] == 0.5 for r in follower.rows[1:])


def test_ascent_ends_with_the_first_sample_inside_the_altitude_tolerance() -> None:
    machine = machine_of(hover_plan(ascent_tolerance_m=2.0))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.ascended_tick is not None)
    tick = machine.ascended_tick
    assert tick is not None
    assert follower.states[tick][UavColumn.Z] >= 28.0
    assert follower.states[tick - 1][UavColumn.Z] < 28.0
    # The command for the next tick is the mission's, and it starts from where the UAV is.
    assert follower.first_row(UavPhase.MISSION) == tick + 1
    step = follower.rows[tick + 1][:4] - follower.rows[tick][:4]
    assert abs(step[UavCommandColumn.X]) < 0.1
    assert follower.rows[tick + 1][UavCommandColumn.Z] == pytest.approx(28.0, abs=0.2)


def test_ascent_waits_for_the_altitude_however_long_it_takes() -> None:
    machine = machine_of(hover_plan())
    machine.start()
    state = np.zeros(UAV_WIDTH)
    state[UavColumn.Z] = 27.9
    for tick in range(3000):
        row = machine.step(tick, state, None)
        assert row[UavCommandColumn.MODE] == UavMode.TAKEOFF
        assert row[UavCommandColumn.TAKEOFF_ALTITUDE] == 30.0
    assert machine.phase == UavPhase.ASCENT


@pytest.mark.parametrize('duration_s', [0.05, 1.0, 4.0, 4.02, 0.3, 29.95])
def test_hover_lasts_exactly_its_duration_from_capture(duration_s: float) -> None:
    machine = machine_of(hover_plan(duration_s=duration_s))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.missions_done)
    capture = machine.capture_tick
    assert capture is not None
    state = follower.states[capture]
    assert sqrt((state[0] - 40.0) ** 2 + state[1] ** 2) <= 1.0
    before = follower.states[capture - 1]
    assert sqrt((before[0] - 40.0) ** 2 + before[1] ** 2) > 1.0
    ticks = follower.first_row(UavPhase.LANDING) - capture
    assert ticks == int(np.ceil(duration_s / DT_S - 1e-9))
    assert abs(ticks * DT_S - duration_s) < DT_S


def test_hover_that_is_never_captured_never_ends() -> None:
    machine = machine_of(hover_plan())
    machine.start()
    state = np.zeros(UAV_WIDTH)
    state[UavColumn.Z] = 30.0  # stuck far from the point
    for tick in range(4000):
        machine.step(tick, state, None)
    assert not machine.captured
    assert machine.phase == UavPhase.MISSION


def _driving(tick: int) -> TargetMotion:
    return _moving(20.0 + 10.0 * tick * DT_S, 8.0, 10.0)


def _moving(x_m: float, y_m: float, speed_mps: float) -> TargetMotion:
    """Along +x."""
    return TargetMotion(
        x_m=x_m, y_m=y_m, vx_mps=speed_mps, vy_mps=0.0, heading_x=1.0, heading_y=0.0
    )


def test_track_follows_at_its_offset() -> None:
    plan = _track(standoff_m=35.0, offset_m=(0.0, 35.0), capture_horizontal_m=5.0, duration_s=12.0)
    machine = machine_of(plan)
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured, _driving)
    capture = machine.capture_tick
    assert capture is not None
    follower.until(lambda: machine.missions_done, _driving)
    last = follower.states[-2]
    target = _driving(follower.tick - 1)
    assert last[0] - target.x_m == pytest.approx(0.0, abs=1.0)
    assert last[1] - target.y_m == pytest.approx(35.0, abs=1.0)
    assert follower.first_row(UavPhase.LANDING) - capture == 240
    x, y = follower.states[capture][:2]
    seen = _driving(capture)
    assert abs(sqrt((x - seen.x_m) ** 2 + (y - seen.y_m) ** 2) - 35.0) <= 5.0


def test_track_keeps_to_its_side_when_the_target_turns() -> None:
    plan = _track(
        standoff_m=20.0,
        offset_m=(-20.0, 0.0),
        offset_turns=True,
        capture_horizontal_m=5.0,
        duration_s=60.0,
    )
    machine = machine_of(plan)
    machine.start()
    follower = Follower(machine)
    corner = 1200

    def driving(tick: int) -> TargetMotion:
        if tick < corner:
            return _moving(20.0 + 8.0 * tick * DT_S, 8.0, 8.0)
        north = 8.0 + 8.0 * (tick - corner) * DT_S
        return TargetMotion(
            x_m=20.0 + 8.0 * corner * DT_S,
            y_m=north,
            vx_mps=0.0,
            vy_mps=8.0,
            heading_x=0.0,
            heading_y=1.0,
        )

    follower.until(lambda: follower.tick == corner - 1, driving)
    before, seen = follower.states[-1], driving(corner - 1)
    assert (before[0] - seen.x_m, before[1] - seen.y_m) == pytest.approx((-20.0, 0.0), abs=1.0)
    follower.until(lambda: follower.tick == corner + 200, driving)
    after, seen = follower.states[-1], driving(corner + 200)
    assert (after[0] - seen.x_m, after[1] - seen.y_m) == pytest.approx((0.0, -20.0), abs=1.0)
    speeds = [
        np.hypot(*row[UavCommandColumn.VX : UavCommandColumn.VY + 1]) for row in follower.rows
    ]
    assert max(speeds) <= SETTINGS.speed_max_mps + 1e-9


def test_capture_asks_for_altitude_too() -> None:
    machine = machine_of(_track(capture_altitude_m=2.0))
    machine.start()
    state = np.zeros(UAV_WIDTH)
    state[UavColumn.Z] = 28.5
    here = _moving(0.0, 0.0, 0.0)
    machine.step(0, state, here)
    assert machine.ascended_tick == 0
    assert machine.capture_tick == 0
    machine = machine_of(_track(capture_altitude_m=1.0))
    machine.start()
    machine.step(0, state, here)
    assert machine.phase == UavPhase.MISSION
    assert not machine.captured
    machine = machine_of(_track(ascent_tolerance_m=1.0))
    machine.start()
    machine.step(0, state, here)
    assert machine.phase == UavPhase.ASCENT


def test_losing_the_target_never_ends_the_phase() -> None:
    machine = machine_of(_track(duration_s=6.0))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured, _driving)
    capture = machine.capture_tick
    assert capture is not None
    follower.until(lambda: machine.missions_done)  # no target from here on
    assert follower.first_row(UavPhase.LANDING) - capture == 120
    speeds = [sqrt(s[UavColumn.VX] ** 2 + s[UavColumn.VY] ** 2) for s in follower.states]
    assert speeds[-2] < 0.1  # it has come to rest and holds


def test_a_target_that_is_gone_from_the_start_is_never_captured() -> None:
    machine = machine_of(_track())
    machine.start()
    follower = Follower(machine)
    for _ in range(2000):
        follower.step()
    assert not machine.captured
    assert machine.phase == UavPhase.MISSION
    assert follower.states[-1][UavColumn.Z] == pytest.approx(30.0, abs=0.1)


def test_route_is_captured_at_its_first_point_and_flown_to_its_last() -> None:
    machine = machine_of(route_plan())
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    capture = machine.capture_tick
    assert capture is not None
    x, y = follower.states[capture][:2]
    assert sqrt((x - 30.0) ** 2 + y**2) <= route_plan().capture_horizontal_m
    follower.until(lambda: machine.missions_done)
    for x, y, z in route_plan().waypoints:
        nearest = min(
            sqrt((s[0] - x) ** 2 + (s[1] - y) ** 2 + (s[2] - z) ** 2)
            for s in follower.states[capture:]
        )
        assert nearest < 0.3
    assert sqrt((follower.states[-1][0] - 60.0) ** 2 + (follower.states[-1][1] - 30.0) ** 2) <= 1.0


def test_route_does_not_end_before_the_uav_is_there() -> None:
    """The reference is done; a UAV that stays behind keeps the phase open."""
    machine = machine_of(route_plan())
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.captured)
    state = follower.state.copy()
    for tick in range(follower.tick, follower.tick + 2000):
        machine.step(tick, state, None)
    assert machine.phase == UavPhase.MISSION


def test_two_missions_in_order_each_with_its_own_capture() -> None:
    second = hover_plan('m2', altitude_m=50.0, hover_point=(-40.0, 20.0, 50.0), duration_s=2.0)
    machine = machine_of(route_plan(), second)
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.phase == UavPhase.MISSION + 1)
    first_capture = machine.first_capture_tick
    assert not machine.captured
    assert machine.phase_name == 'm2'
    follower.until(lambda: machine.missions_done)
    assert follower.phases() == [0, 1, 2, 3, UavPhase.LANDING]
    assert machine.first_capture_tick == first_capture
    capture = machine.capture_tick
    assert capture is not None
    assert capture > follower.first_row(UavPhase.MISSION + 1)
    assert abs(follower.states[capture][2] - 50.0) <= 2.0
    assert follower.first_row(UavPhase.LANDING) - capture == 40
    assert machine.phase_name == 'landing'


def test_set_points_never_jump() -> None:
    second = hover_plan('m2', hover_point=(-40.0, 20.0, 30.0), duration_s=2.0)
    machine = machine_of(_track(), second)
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.missions_done, _driving)
    land_at(follower, spot=(0.0, 0.0), altitude=45.0)
    rows = [r for r in follower.rows if r[UavCommandColumn.MODE] == UavMode.OFFBOARD]
    for a, b in itertools.pairwise(rows):
        move = (
            b[UavCommandColumn.X : UavCommandColumn.Z + 1]
            - a[UavCommandColumn.X : UavCommandColumn.Z + 1]
        )
        assert sqrt(move[0] ** 2 + move[1] ** 2) <= SETTINGS.speed_max_mps * DT_S + 1e-9
        assert -SETTINGS.descent_mps * DT_S - 1e-9 <= move[2] <= SETTINGS.climb_mps * DT_S + 1e-9


def test_a_hover_without_a_place_brakes_and_stays_where_that_ends() -> None:
    stays = hover_plan('m2', hover_point=None, rest_mps=0.5, waits=True)
    machine = machine_of(_track(until_event=True), stays)
    machine.start()
    follower = Follower(machine)
    target = partial(_driving_on, mps=8.0)
    follower.until(lambda: follower.tick == 900, target)
    machine.change_to('m2')
    x, y = follower.state[:2]
    follower.until(lambda: machine.captured, target)
    # Braking with half of 4 m/s^2 from 8 m/s: 8^2 / (2 * 2) = 16 m.
    braked = follower.states[machine.capture_tick or 0]
    assert braked[:3] == pytest.approx([x + 16.0, y, 30.0], abs=1.0)
    follower.until(lambda: machine.missions_done)
    assert follower.state[:2] == pytest.approx(braked[:2], abs=1.0)


def _driving_on(tick: int, mps: float) -> TargetMotion:
    return _moving(20.0 + mps * tick * DT_S, 8.0, mps)


@pytest.mark.parametrize('told', ['on mission', 'in between'])
@pytest.mark.parametrize(('keeps', 'height_m'), [(True, 45.0), (False, 30.0)])
def test_a_hover_without_a_place_is_as_high_as_the_uav_was_told(
    told: str, keeps: bool, height_m: float
) -> None:
    stays = hover_plan('m2', hover_point=None, rest_mps=0.5, keeps_level=keeps, waits=True)
    machine = machine_of(hover_plan(), stays)
    machine.start()
    follower = Follower(machine)
    phase = UavPhase.MISSION if told == 'on mission' else UavPhase.HOLDING
    follower.until(lambda: machine.phase == phase and machine.captured)
    machine.climb_to(45.0)
    follower.until(lambda: machine.phase == UavPhase.HOLDING)
    for _ in range(200):
        follower.step()
    machine.change_to('m2')
    follower.until(lambda: machine.missions_done)
    assert follower.state[:3] == pytest.approx([40.0, 0.0, height_m], abs=0.6)


@pytest.mark.parametrize('duration_s', [20.0, 30.0])
def test_a_route_with_a_duration_ends_with_it(duration_s: float) -> None:
    machine = machine_of(route_plan(duration_s=duration_s))
    machine.start()
    follower = Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.capture_tick is not None
    lasted = follower.first_row(UavPhase.LANDING) - machine.capture_tick
    assert lasted == round(duration_s / DT_S)


def test_a_route_is_flown_again_until_its_event() -> None:
    square = ((30.0, 0.0, 30.0), (50.0, 0.0, 30.0), (50.0, 20.0, 30.0), (30.0, 0.0, 30.0))
    for waypoints in (square, route_plan().waypoints):
        machine = machine_of(
            route_plan(waypoints=waypoints, until_event=True), hover_plan('m2', waits=True)
        )
        machine.start()
        follower = Follower(machine)
        follower.until(lambda: machine.captured)  # noqa: B023
        assert machine.is_on_first_lap
        follower.until(lambda: not machine.is_on_first_lap)  # noqa: B023
        for _ in range(400):
            follower.step()
        assert machine.phase == UavPhase.MISSION
        moved = [abs(s[UavColumn.VX]) + abs(s[UavColumn.VY]) for s in follower.states[-200:]]
        assert max(moved) > 1.0
        machine.change_to('m2')
        follower.until(lambda: machine.missions_done)  # noqa: B023
