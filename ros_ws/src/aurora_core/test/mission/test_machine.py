# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The state machine goes from phase to phase on realised predicates only."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from functools import partial
from math import sqrt
from typing import Any

import numpy as np
import pytest

from aurora_core.mission.machine import MissionMachine, TargetMotion
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import (
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
    UavPhase,
)

DT_S = 0.05
SETTINGS = FlightSettings(
    speed_max_mps=16.5,
    acceleration_mps2=4.0,
    climb_mps=4.0,
    descent_mps=2.5,
    corner_speed_mps=1.5,
    position_gain_hz=0.8,
)
HOME = (5.0, -5.0)


def _hover(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.HOVER,
        'altitude_m': 30.0,
        'hover_point': (40.0, 0.0, 30.0),
        'duration_s': 4.0,
        'capture_horizontal_m': 1.0,
    }
    return MissionPlan(**(fields | changes))


def _track(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.TRACK,
        'target': 'car1',
        'altitude_m': 30.0,
        'duration_s': 4.0,
    }
    return MissionPlan(**(fields | changes))


def _route(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.NAVIGATE,
        'altitude_m': 30.0,
        'waypoints': ((30.0, 0.0, 30.0), (60.0, 0.0, 30.0), (60.0, 30.0, 30.0)),
        'speed_mps': 8.0,
    }
    return MissionPlan(**(fields | changes))


def _machine(*missions: MissionPlan, **changes: Any) -> MissionMachine:
    plan = UavPlan(
        id='uav1',
        system_id=1,
        home_x_m=HOME[0],
        home_y_m=HOME[1],
        home_yaw_enu_rad=0.5,
        landing_spots=(HOME,),
        missions=missions,
        safe_altitude_m=60.0,
        **changes,
    )
    return MissionMachine(plan, SETTINGS, DT_S)


class _Follower:
    """A UAV that does at once what it is told, and climbs and sinks at a fixed rate."""

    def __init__(self, machine: MissionMachine) -> None:
        self.machine = machine
        self.state = np.zeros(UAV_WIDTH)
        self.state[UavColumn.X : UavColumn.Y + 1] = HOME
        self.state[UavColumn.QW] = self.state[UavColumn.LANDED] = 1.0
        self.tick = 0
        self.rows: list[Any] = [np.zeros(10)]  # row k was applied to reach tick k
        self.states = [self.state.copy()]

    def step(self, target: TargetMotion | None = None) -> None:
        row = self.machine.step(self.tick, self.state, target)
        self.tick += 1
        self._obey(row)
        self.rows.append(row)
        self.states.append(self.state.copy())

    def until(
        self,
        done: Callable[[], bool],
        target: Callable[[int], TargetMotion | None] = lambda _tick: None,
        limit: int = 6000,
    ) -> None:
        for _ in range(limit):
            if done():
                return
            self.step(target(self.tick))
        raise AssertionError(f'not done after {limit} ticks, phase {self.machine.phase_name}')

    def _obey(self, row: Any) -> None:
        s, mode = self.state, int(row[UavCommandColumn.MODE])
        before = s[UavColumn.X : UavColumn.Z + 1].copy()
        if mode == UavMode.TAKEOFF:
            s[UavColumn.Z] = min(row[UavCommandColumn.TAKEOFF_ALTITUDE], s[UavColumn.Z] + 0.1)
        elif mode == UavMode.OFFBOARD:
            s[UavColumn.X : UavColumn.Z + 1] = row[UavCommandColumn.X : UavCommandColumn.Z + 1]
        elif mode == UavMode.LAND:
            s[UavColumn.Z] = max(0.0, s[UavColumn.Z] - 0.1)
        s[UavColumn.VX : UavColumn.VZ + 1] = (s[UavColumn.X : UavColumn.Z + 1] - before) / DT_S
        s[UavColumn.LANDED] = float(s[UavColumn.Z] <= 0.0)
        s[UavColumn.ARMED] = float(
            mode != UavMode.IDLE and not (mode == UavMode.LAND and s[UavColumn.Z] <= 0.0)
        )
        s[UavColumn.MODE] = mode

    def phases(self) -> list[int]:
        """Return the phases of the command rows, each once."""
        seen: list[int] = []
        for row in self.rows:
            phase = int(row[UavCommandColumn.PHASE])
            if not seen or seen[-1] != phase:
                seen.append(phase)
        return seen

    def first_row(self, phase: int) -> int:
        """Return the tick of the first command of a phase."""
        return next(k for k, r in enumerate(self.rows) if r[UavCommandColumn.PHASE] == phase)


def _land(follower: _Follower, spot: tuple[float, float] = HOME, altitude: float = 30.0) -> None:
    machine = follower.machine
    for _ in range(6000):
        if machine.needs_landing_spot():
            machine.set_landing_spot(spot, altitude)
        if machine.landed:
            return
        follower.step()
    raise AssertionError('never landed')


def test_before_the_start_it_idles() -> None:
    machine = _machine(_hover())
    follower = _Follower(machine)
    follower.step()
    assert machine.phase_name == 'idle'
    assert follower.rows[1][UavCommandColumn.MODE] == UavMode.IDLE
    assert machine.mission is None


def test_a_uav_without_missions_never_leaves_the_ground() -> None:
    machine = _machine()
    machine.start()
    follower = _Follower(machine)
    for _ in range(20):
        follower.step()
    assert follower.phases() == [UavPhase.IDLE]
    assert max(s[UavColumn.Z] for s in follower.states) == 0.0


def test_hover_from_take_off_to_landing() -> None:
    machine = _machine(_hover())
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.needs_landing_spot()
    _land(follower)
    assert follower.phases() == [0, UavPhase.ASCENT, UavPhase.MISSION, UavPhase.LANDING]
    modes = {int(r[UavCommandColumn.MODE]) for r in follower.rows}
    assert modes == {UavMode.IDLE, UavMode.TAKEOFF, UavMode.OFFBOARD, UavMode.LAND}
    assert follower.states[-1][UavColumn.ARMED] == 0.0
    follower.step()
    assert follower.rows[-1][UavCommandColumn.MODE] == UavMode.IDLE  # landed: no more commands
    assert all(r[UavCommandColumn.YAW] == 0.5 for r in follower.rows[1:])


def test_ascent_ends_with_the_first_sample_inside_the_altitude_tolerance() -> None:
    machine = _machine(_hover(ascent_tolerance_m=2.0))
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_hover())
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
    machine = _machine(_hover(duration_s=duration_s))
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_hover())
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
    machine = _machine(plan)
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(plan)
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_track(capture_altitude_m=2.0))
    machine.start()
    state = np.zeros(UAV_WIDTH)
    state[UavColumn.Z] = 28.5
    here = _moving(0.0, 0.0, 0.0)
    machine.step(0, state, here)
    assert machine.ascended_tick == 0
    assert machine.capture_tick == 0
    machine = _machine(_track(capture_altitude_m=1.0))
    machine.start()
    machine.step(0, state, here)
    assert machine.phase == UavPhase.MISSION
    assert not machine.captured
    machine = _machine(_track(ascent_tolerance_m=1.0))
    machine.start()
    machine.step(0, state, here)
    assert machine.phase == UavPhase.ASCENT


def test_losing_the_target_never_ends_the_phase() -> None:
    machine = _machine(_track(duration_s=6.0))
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.captured, _driving)
    capture = machine.capture_tick
    assert capture is not None
    follower.until(lambda: machine.missions_done)  # no target from here on
    assert follower.first_row(UavPhase.LANDING) - capture == 120
    speeds = [sqrt(s[UavColumn.VX] ** 2 + s[UavColumn.VY] ** 2) for s in follower.states]
    assert speeds[-2] < 0.1  # it has come to rest and holds


def test_a_target_that_is_gone_from_the_start_is_never_captured() -> None:
    machine = _machine(_track())
    machine.start()
    follower = _Follower(machine)
    for _ in range(2000):
        follower.step()
    assert not machine.captured
    assert machine.phase == UavPhase.MISSION
    assert follower.states[-1][UavColumn.Z] == pytest.approx(30.0, abs=0.1)


def test_route_is_captured_at_its_first_point_and_flown_to_its_last() -> None:
    machine = _machine(_route())
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.captured)
    capture = machine.capture_tick
    assert capture is not None
    x, y = follower.states[capture][:2]
    assert sqrt((x - 30.0) ** 2 + y**2) <= _route().capture_horizontal_m
    follower.until(lambda: machine.missions_done)
    for x, y, z in _route().waypoints:
        nearest = min(
            sqrt((s[0] - x) ** 2 + (s[1] - y) ** 2 + (s[2] - z) ** 2)
            for s in follower.states[capture:]
        )
        assert nearest < 0.3
    assert sqrt((follower.states[-1][0] - 60.0) ** 2 + (follower.states[-1][1] - 30.0) ** 2) <= 1.0


def test_route_does_not_end_before_the_uav_is_there() -> None:
    """The reference is done; a UAV that stays behind keeps the phase open."""
    machine = _machine(_route())
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.captured)
    state = follower.state.copy()
    for tick in range(follower.tick, follower.tick + 2000):
        machine.step(tick, state, None)
    assert machine.phase == UavPhase.MISSION


def test_two_missions_in_order_each_with_its_own_capture() -> None:
    second = _hover('m2', altitude_m=50.0, hover_point=(-40.0, 20.0, 50.0), duration_s=2.0)
    machine = _machine(_route(), second)
    machine.start()
    follower = _Follower(machine)
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
    second = _hover('m2', hover_point=(-40.0, 20.0, 30.0), duration_s=2.0)
    machine = _machine(_track(), second)
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.missions_done, _driving)
    _land(follower, spot=(0.0, 0.0), altitude=45.0)
    rows = [r for r in follower.rows if r[UavCommandColumn.MODE] == UavMode.OFFBOARD]
    for a, b in itertools.pairwise(rows):
        move = (
            b[UavCommandColumn.X : UavCommandColumn.Z + 1]
            - a[UavCommandColumn.X : UavCommandColumn.Z + 1]
        )
        assert sqrt(move[0] ** 2 + move[1] ** 2) <= SETTINGS.speed_max_mps * DT_S + 1e-9
        assert -SETTINGS.descent_mps * DT_S - 1e-9 <= move[2] <= SETTINGS.climb_mps * DT_S + 1e-9


def test_landing_climbs_first_then_flies_across_then_sinks() -> None:
    machine = _machine(_hover())
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.needs_landing_spot()
    start = follower.tick
    _land(follower, spot=(-60.0, 10.0), altitude=60.0)
    assert machine.landing_spot == (-60.0, 10.0)
    flown = follower.states[start:]
    crossing = [s for s in flown if sqrt((s[0] - 40.0) ** 2 + s[1] ** 2) > 5.0 and s[2] > 0.0]
    away = [s for s in crossing if sqrt((s[0] + 60.0) ** 2 + (s[1] - 10.0) ** 2) > 5.0]
    assert min(s[2] for s in away) >= 59.0
    down = follower.states[-1]
    assert sqrt((down[0] + 60.0) ** 2 + (down[1] - 10.0) ** 2) <= 0.5
    assert machine.landed


def test_land_now_ends_a_mission() -> None:
    machine = _machine(_hover(duration_s=600.0))
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.captured)
    machine.land_now()
    assert machine.missions_done
    _land(follower)
    assert follower.phases()[-1] == UavPhase.LANDING


@pytest.mark.parametrize('last', [_hover('m2'), _route('m2')])
def test_a_uav_that_is_to_stay_up_goes_on_with_its_last_mission(last: MissionPlan) -> None:
    machine = _machine(_hover(), last)
    machine.stays_up = True
    follower = _Follower(machine)
    machine.start()
    follower.until(lambda: machine.mission is not None and machine.mission.id == 'm2')
    for _ in range(1200):  # 60 s: more than the phase and its way take
        follower.step()
    assert machine.phase == UavPhase.MISSION + 1
    machine.stays_up = False
    follower.step()
    assert machine.missions_done


def test_land_now_while_climbing_lands_from_where_the_uav_is() -> None:
    machine = _machine(_hover())
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: follower.state[UavColumn.Z] > 15.0)
    height = float(follower.state[UavColumn.Z])
    machine.land_now()
    follower.step()
    assert machine.needs_landing_spot()
    machine.set_landing_spot(HOME, height)
    _land(follower)
    # No dive: no set-point below the UAV before it lands.
    offboard = [r for r in follower.rows if r[UavCommandColumn.MODE] == UavMode.OFFBOARD]
    assert offboard
    assert all(abs(r[UavCommandColumn.Z] - height) < 2.0 for r in offboard)


@pytest.mark.parametrize('when', ['before', 'after'])
def test_land_now_on_the_ground_changes_nothing(when: str) -> None:
    machine = _machine(_hover())
    follower = _Follower(machine)
    if when == 'after':
        machine.start()
        follower.until(lambda: machine.missions_done)
        _land(follower)
    machine.land_now()
    assert machine.phase_name == ('idle' if when == 'before' else 'landing')
    follower.step()
    assert follower.rows[-1][UavCommandColumn.MODE] == UavMode.IDLE


def test_a_mission_that_waits_is_held_for_where_the_one_before_ended() -> None:
    second = _hover('m2', hover_point=(-40.0, 20.0, 30.0), waits=True)
    machine = _machine(_hover(), second)
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_hover(until_event=True), _route('m2', waits=True))
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_hover(waits=True))
    machine.start()
    follower = _Follower(machine)
    for _ in range(100):
        follower.step()
    assert machine.waits_on_ground
    assert follower.state[UavColumn.Z] == 0.0
    machine.change_to('m1')
    follower.until(lambda: machine.captured)
    assert follower.phases() == [UavPhase.IDLE, UavPhase.ASCENT, UavPhase.MISSION]


@pytest.mark.parametrize('mission', [_hover(duration_s=20.0), _route(speed_mps=3.0)])
def test_a_climb_that_an_event_asks_for_lasts_to_the_end_of_the_mission(
    mission: MissionPlan,
) -> None:
    machine = _machine(mission, _hover('m2', duration_s=10.0))
    machine.start()
    follower = _Follower(machine)
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
    machine = _machine(_hover(duration_s=200.0))
    machine.start()
    follower = _Follower(machine)
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


def test_a_hover_without_a_place_brakes_and_stays_where_that_ends() -> None:
    stays = _hover('m2', hover_point=None, rest_mps=0.5, waits=True)
    machine = _machine(_track(until_event=True), stays)
    machine.start()
    follower = _Follower(machine)
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
    stays = _hover('m2', hover_point=None, rest_mps=0.5, keeps_level=keeps, waits=True)
    machine = _machine(_hover(), stays)
    machine.start()
    follower = _Follower(machine)
    phase = UavPhase.MISSION if told == 'on mission' else UavPhase.HOLDING
    follower.until(lambda: machine.phase == phase and machine.captured)
    machine.climb_to(45.0)
    follower.until(lambda: machine.phase == UavPhase.HOLDING)
    for _ in range(200):
        follower.step()
    machine.change_to('m2')
    follower.until(lambda: machine.missions_done)
    assert follower.state[:3] == pytest.approx([40.0, 0.0, height_m], abs=0.6)


def test_a_uav_that_is_not_to_land_holds_its_place() -> None:
    machine = _machine(_hover(), lands=False)
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.done)
    assert machine.missions_done
    assert not machine.landed
    assert follower.phases()[-1] == UavPhase.HOLDING
    assert follower.state[:3] == pytest.approx([40.0, 0.0, 30.0], abs=0.5)


@pytest.mark.parametrize('duration_s', [20.0, 30.0])
def test_a_route_with_a_duration_ends_with_it(duration_s: float) -> None:
    machine = _machine(_route(duration_s=duration_s))
    machine.start()
    follower = _Follower(machine)
    follower.until(lambda: machine.missions_done)
    assert machine.capture_tick is not None
    lasted = follower.first_row(UavPhase.LANDING) - machine.capture_tick
    assert lasted == round(duration_s / DT_S)


def test_a_route_is_flown_again_until_its_event() -> None:
    square = ((30.0, 0.0, 30.0), (50.0, 0.0, 30.0), (50.0, 20.0, 30.0), (30.0, 0.0, 30.0))
    for waypoints in (square, _route().waypoints):
        machine = _machine(_route(waypoints=waypoints, until_event=True), _hover('m2', waits=True))
        machine.start()
        follower = _Follower(machine)
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
