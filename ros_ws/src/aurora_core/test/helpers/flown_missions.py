# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Missions, and a UAV that flies them as it is told."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from aurora_core.mission.machine import MissionMachine, TargetMotion
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.mission.setpoint import FlightSettings
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import (
    UAV_WIDTH,
    UavColumn,
    UavCommandColumn,
    UavMode,
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


def hover_plan(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.HOVER,
        'altitude_m': 30.0,
        'hover_point': (40.0, 0.0, 30.0),
        'duration_s': 4.0,
        'capture_horizontal_m': 1.0,
    }
    return MissionPlan(**(fields | changes))


def route_plan(mission_id: str = 'm1', **changes: Any) -> MissionPlan:
    fields: dict[str, Any] = {
        'id': mission_id,
        'mode': MissionMode.NAVIGATE,
        'altitude_m': 30.0,
        'waypoints': ((30.0, 0.0, 30.0), (60.0, 0.0, 30.0), (60.0, 30.0, 30.0)),
        'speed_mps': 8.0,
    }
    return MissionPlan(**(fields | changes))


def machine_of(*missions: MissionPlan, **changes: Any) -> MissionMachine:
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


class Follower:
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


def land_at(follower: Follower, spot: tuple[float, float] = HOME, altitude: float = 30.0) -> None:
    machine = follower.machine
    for _ in range(6000):
        if machine.needs_landing_spot():
            machine.set_landing_spot(spot, altitude)
        if machine.landed:
            return
        follower.step()
    raise AssertionError('never landed')
