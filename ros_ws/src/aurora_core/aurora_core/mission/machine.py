# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The mission state machine of one UAV: ascend, missions in order, land or hold.

Every transition waits for a realised predicate (altitude reached, captured, route flown, landed),
never for a fixed delay. Source: paper, "Temporal planning".
"""

from __future__ import annotations

from copy import copy
from math import ceil
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.mission.crossing import Crossing
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.mission.setpoint import FlightSettings, PursuitReference, RouteReference
from aurora_core.mission.staying import Staying
from aurora_core.mission.turning_offset import TurningOffset
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavColumn, UavMode, UavPhase

FloatArray = npt.NDArray[np.float64]

# Plain numbers: members of an enum cost more to look up than what is done with them.
_IDLE = int(UavPhase.IDLE)
_ASCENT = int(UavPhase.ASCENT)
_MISSION = int(UavPhase.MISSION)
_HOLDING = int(UavPhase.HOLDING)
_LANDING = int(UavPhase.LANDING)
_X, _Y, _Z = int(UavColumn.X), int(UavColumn.Y), int(UavColumn.Z)
_VX, _VY, _VZ = int(UavColumn.VX), int(UavColumn.VY), int(UavColumn.VZ)
_ARMED, _LANDED = int(UavColumn.ARMED), int(UavColumn.LANDED)

_MODE_IDLE, _MODE_TAKEOFF = float(UavMode.IDLE), float(UavMode.TAKEOFF)
_MODE_OFFBOARD, _MODE_LAND = float(UavMode.OFFBOARD), float(UavMode.LAND)
_NAVIGATE, _TRACK = MissionMode.NAVIGATE, MissionMode.TRACK

# The UAV counts as arrived when it is this close to the last point of a way (m).
ARRIVED_M = 1.0

# The reference of a UAV that is so little below its altitude starts at the altitude (m).
_NEAR_LOWEST_M = 0.3

# A UAV that does not land has done what is asked once it has held its place so long (s).
HOLD_S = 5.0


class TargetMotion(NamedTuple):
    """What a mission needs to know of its target: position, velocity, heading (unit), ENU."""

    x_m: float
    y_m: float
    vx_mps: float
    vy_mps: float
    heading_x: float
    heading_y: float


class MissionMachine:
    """State machine of one UAV; `step` is called once a tick and returns the command row.

    Args:
        plan: What to fly.
        settings: Limits of the reference motion.
        dt_s: Time step.

    Attributes:
        plan: What it flies.
        stays_up: Something has to happen before it may land: its last mission goes on until then.
        done: It has landed, or held its place long enough where it is not to land.
        way_there: To its mission.
        staying: Its mission is to stay where it is.
    """

    def __init__(self, plan: UavPlan, settings: FlightSettings, dt_s: float) -> None:
        self.plan = plan
        self._settings = self._usual = settings
        self._dt = dt_s
        self.phase = _IDLE
        self.ascended_tick: int | None = None
        self.capture_tick: int | None = None
        self.first_capture_tick: int | None = None
        self.captured_missions: set[str] = set()
        self.landed = False
        self._pursuit = PursuitReference(plan.home_x_m, plan.home_y_m, 0.0)
        self._route: RouteReference | None = None
        self._flown: MissionPlan | None = None
        self._turning: TurningOffset | None = None
        self.staying: Staying | None = None
        self._landing_spot: tuple[float, float] | None = None
        self._return_altitude_m = 0.0
        self._descending = self._waits = self._airborne = False
        self._climb: tuple[float, float, float] | None = None
        self._index = self._laps = 0
        self._way: tuple[tuple[float, float, float], ...] = ()
        self._level_m: float | None = None
        self._hold: tuple[float, float, float] = (plan.home_x_m, plan.home_y_m, 0.0)
        self._held_ticks = 0
        self.stays_up = self.done = False
        self.way_there = Crossing(None)

    @property
    def mission(self) -> MissionPlan | None:
        """The mission that is flown now, None before and after."""
        index, count = self.phase - _MISSION, len(self.plan.missions)
        flies = self.phase < _LANDING and 0 <= index < count
        return self.plan.missions[index] if flies else None

    @property
    def followed(self) -> str | None:
        """The body whose motion the next step needs, None when there is none.

        A UAV that waits for its way to a landing spot stays with the target of its last mission,
        among the other UAVs that follow it.
        """
        mission = self._flown if self.needs_landing_spot() else self.mission
        if self.phase == _ASCENT:  # the first sample at its altitude may be the capture as well
            mission = self.plan.missions[self._index]
        tracks = mission is not None and mission.mode is _TRACK
        return mission.target if mission is not None and tracks else None

    @property
    def missions_done(self) -> bool:
        """Whether the last mission has ended (landing, or holding for good, may go on)."""
        last = self._index == len(self.plan.missions) - 1
        return self.phase == _LANDING or (self.phase == _HOLDING and last)

    @property
    def is_landing(self) -> bool:
        """Whether it is on its way home, or down again."""
        return self.phase == _LANDING

    @property
    def climbs_first(self) -> bool:
        """Whether it climbs as told before its way home."""
        return self._climb is not None

    @property
    def on_mission(self) -> bool:
        """Whether it has left the ground, and its missions are not over."""
        return self.phase != _IDLE and not self.missions_done

    @property
    def waits_on_ground(self) -> bool:
        """Whether an event has to let it begin its first mission."""
        return self.phase == _IDLE

    @property
    def patrols(self) -> bool:
        """Whether it is on a route that an event is to end."""
        mission = self.mission
        if mission is None or mission.mode is not _NAVIGATE:
            return False
        return mission.until_event

    @property
    def is_on_first_lap(self) -> bool:
        """Whether it has not yet flown once the route that an event is to end."""
        return self.patrols and self._laps == 0

    def has_begun(self, mission_id: str) -> bool:
        """Tell whether a mission is flown or over."""
        index = [mission.id for mission in self.plan.missions].index(mission_id)
        return self.phase >= _MISSION and index <= self._index

    @property
    def captured(self) -> bool:
        """Whether the present mission's tolerance has been met since its ascent."""
        return self.capture_tick is not None

    def start(self) -> None:
        """Leave the ground with the next command, unless its first mission waits for an event."""
        missions = self.plan.missions
        self.phase = _ASCENT if missions and not missions[0].waits else _IDLE

    @property
    def landing_spot(self) -> tuple[float, float] | None:
        """Where it will land, once that is chosen."""
        return self._landing_spot

    @property
    def phase_name(self) -> str:
        """The present phase in words: idle, ascent, the mission's id, or landing."""
        mission = self.mission
        return UavPhase(self.phase).name.lower() if mission is None else mission.id

    def land_now(self) -> None:
        """End the missions; the landing begins with the next step."""
        if _IDLE < self.phase < _LANDING:
            self._begin(_LANDING)

    def change_to(self, mission_id: str) -> None:
        """Begin a mission with the next step, or after the ascent; one that is over stays over."""
        index = [mission.id for mission in self.plan.missions].index(mission_id)
        if self.phase in (_IDLE, _ASCENT):
            self.phase, self._index = _ASCENT, index
        elif self.phase < _LANDING and index > self._index:
            self._begin(_MISSION + index)

    def climb_to(self, altitude_m: float, vertical_mps: float | None = None) -> None:
        """Go on at another altitude; after the missions climb before the way to a landing spot.

        The next mission has its own altitude again, unless it keeps the one before. Without a
        vertical speed it is as fast as ever.
        """
        self._settings = self._usual.climbing(vertical_mps)
        if self.phase == _LANDING and not self._descending:
            self._climb = (self._pursuit.x, self._pursuit.y, altitude_m)
            self._landing_spot = None
            return
        if self.phase == _HOLDING:
            self._hold = (*self._hold[:2], altitude_m)
        if _IDLE < self.phase < _LANDING:
            self._level_m = altitude_m

    def stop_point(self, state: FloatArray) -> tuple[float, float]:
        """Return where it would come to rest, braking from its present velocity (x, y in m)."""
        row: list[float] = state.tolist()
        speed = norm2(row[_VX], row[_VY])
        braking_s = speed / (2.0 * self._settings.acceleration_mps2)
        return row[_X] + braking_s * row[_VX], row[_Y] + braking_s * row[_VY]

    def needs_landing_spot(self) -> bool:
        """Whether the executor has to choose a landing spot now."""
        landing = self.phase == _LANDING
        return landing and self._landing_spot is None and self._climb is None

    def way_home(
        self, state: FloatArray, spot: tuple[float, float], duration_s: float, step_s: float
    ) -> list[tuple[float, float]]:
        """Return where it would be on its way to a landing spot, step by step (x, y in m)."""
        reference = copy(self._pursuit)
        if not self._airborne:
            reference = PursuitReference(*state[_X : _Z + 1].tolist())
        points = [(reference.x, reference.y)]
        for _ in range(round(duration_s / step_s)):
            reference.step((*spot, reference.z), (0.0, 0.0), self._settings, step_s)
            points.append((reference.x, reference.y))
        return points

    def set_landing_spot(self, spot: tuple[float, float], altitude_m: float) -> None:
        """Fly to `spot` (x, y in m, ENU) at `altitude_m` above ground and land there."""
        self._landing_spot = spot
        self._return_altitude_m = altitude_m

    def step(self, tick: int, state: FloatArray, target: TargetMotion | None) -> FloatArray:
        """Evaluate the predicates on the state of `tick`, return the command row for tick + 1.

        Args:
            tick: Tick of the state.
            state: (UAV_WIDTH,) row of this UAV.
            target: Motion of the body that is `followed`, None when there is none.

        Returns:
            (UAV_COMMAND_WIDTH,) command row.
        """
        row: list[float] = state.tolist()
        if self.phase == _ASCENT:
            self._check_ascended(tick, row)
        mission = self.mission
        if mission is not None:
            self._fly(mission, tick, row, target)
        if self.phase == _HOLDING:
            self._stay()
        if self.phase == _LANDING:
            self._fly_home(row, target)
        return self._command(row)

    def _first_altitude_m(self) -> float:
        return float(self.plan.missions[0].altitude_m)

    def _check_ascended(self, tick: int, state: list[float]) -> None:
        z = state[_Z]
        if abs(z - self._first_altitude_m()) <= self.plan.missions[0].ascent_tolerance_m:
            self.ascended_tick = tick
            self._start_reference(state)
            self._begin(_MISSION + self._index)

    def _start_reference(self, state: list[float]) -> None:
        x, y, z = state[_X : _Z + 1]
        # Nobody commands less than the altitude, which may be the lowest one that is allowed.
        first_m = self._first_altitude_m()
        z = first_m if 0.0 < first_m - z <= _NEAR_LOWEST_M else z
        self._pursuit = PursuitReference(x, y, z)
        self._pursuit.vz = state[_VZ]
        self._airborne = True

    def _begin(self, phase: int) -> None:
        if phase == _HOLDING:
            self._hold = self._pursuit.rest_point(self._settings)
            self._held_ticks = 0
        elif phase != _LANDING:
            self._index, self._laps = phase - _MISSION, 0
            mission = self.plan.missions[self._index]
            self.capture_tick = self._turning = None
            self.staying = None if mission.rest_mps is None else Staying(mission.rest_mps)
            if not mission.keeps_level and self.phase != _ASCENT:
                self._settings = self._usual
                self._level_m = None  # what is asked for during the ascent still counts
            self.way_there = Crossing(mission.over_m, level=mission.level_way and self._index > 0)
        self.phase = phase
        self._route = None

    def _next_phase(self) -> int:
        index = self._index + 1
        if index < len(self.plan.missions):
            return _HOLDING if self.plan.missions[index].waits else _MISSION + index
        return _LANDING if self.plan.lands else _HOLDING

    def _stay(self) -> None:
        self._pursuit.step(self._hold, (0.0, 0.0), self._settings, self._dt)
        self._held_ticks += 1
        self.done = self.missions_done and self._held_ticks * self._dt >= HOLD_S

    def altitude_m(self, mission: MissionPlan) -> float:
        """Return how high a mission is flown (m above ground), as events have told it since."""
        return mission.altitude_m if self._level_m is None else self._level_m

    def _fly(
        self, mission: MissionPlan, tick: int, state: list[float], target: TargetMotion | None
    ) -> None:
        self._flown = mission
        if mission.mode is _NAVIGATE:
            finished = self._fly_route(mission, tick, state)
        else:
            finished = self._fly_hold(mission, tick, state, target)
        if finished:
            self._begin(self._next_phase())

    def _fly_hold(
        self, mission: MissionPlan, tick: int, state: list[float], target: TargetMotion | None
    ) -> bool:
        goal, velocity = self._goal(mission, target)
        if self.capture_tick is None and self._meets(mission, state, goal, target):
            self._capture(mission, tick)
        if self._phase_over(mission, tick):
            return True
        if self.capture_tick is None:
            rest = self._pursuit.rest_point(self._settings)[:2]
            goal, velocity = self.way_there.goal(self._pursuit, rest, (goal, velocity))
        self._pursuit.step(goal, velocity, self._settings, self._dt)
        return False

    def _goal(
        self, mission: MissionPlan, target: TargetMotion | None
    ) -> tuple[tuple[float, float, float], tuple[float, float]]:
        """Return the point of a holding mission and its velocity; asked once a tick."""
        z_m = self.altitude_m(mission)
        if mission.hover_point is not None:
            x_m, y_m, _ = mission.hover_point
            return (x_m, y_m, z_m), (0.0, 0.0)
        if self.staying is not None:
            x_m, y_m = self.staying.goal(self._pursuit.rest_point(self._settings)[:2])
            return (x_m, y_m, z_m), (0.0, 0.0)
        if target is None:  # it is gone: hold where the reference is
            return (self._pursuit.x, self._pursuit.y, z_m), (0.0, 0.0)
        velocity = (target.vx_mps, target.vy_mps)
        x_m, y_m = mission.offset_m
        if mission.offset_turns:
            if self._turning is None:
                self._turning = TurningOffset(mission.offset_m, self._settings, self._dt)
            heading = (target.heading_x, target.heading_y)
            (x_m, y_m), (round_x, round_y) = self._turning.step(velocity, heading)
            velocity = (velocity[0] + round_x, velocity[1] + round_y)
        return (target.x_m + x_m, target.y_m + y_m, z_m), velocity

    def _capture(self, mission: MissionPlan, tick: int) -> None:
        self.capture_tick = tick
        self.captured_missions.add(mission.id)
        if self.first_capture_tick is None:
            self.first_capture_tick = tick

    def _meets(
        self,
        mission: MissionPlan,
        state: list[float],
        goal: tuple[float, float, float],
        target: TargetMotion | None,
    ) -> bool:
        x, y, z = state[_X : _Z + 1]
        stays_m = None if self.staying is None else self.staying.away_m(state)
        if abs(z - self.altitude_m(mission)) > mission.capture_altitude_m:
            return False
        if stays_m is not None:
            return stays_m <= mission.capture_horizontal_m
        if mission.mode is _TRACK:
            if target is None:
                return False
            away = norm2(x - target.x_m, y - target.y_m)
            return abs(away - mission.standoff_m) <= mission.capture_horizontal_m
        return norm2(x - goal[0], y - goal[1]) <= mission.capture_horizontal_m

    def _phase_over(self, mission: MissionPlan, tick: int) -> bool:
        """Whether the command for tick + 1 is the first of the next phase."""
        if mission.duration_s is None or mission.until_event or self._held_up():
            return False
        return self._has_lasted(mission.duration_s, tick)

    def _has_lasted(self, duration_s: float, tick: int) -> bool:
        """Whether a mission has gone on for so long, at tick + 1, since its capture."""
        if self.capture_tick is None:
            return False
        return (tick + 1) - self.capture_tick >= ceil(duration_s / self._dt - 1e-9)

    def _fly_route(self, mission: MissionPlan, tick: int, state: list[float]) -> bool:
        first = mission.waypoints[0]
        if self._level_m is not None:
            first = (*first[:2], self._level_m)
        x, y, z = state[_X : _Z + 1]
        if self._route is None:
            away_m, off_m = norm2(x - first[0], y - first[1]), abs(z - first[2])
            captured = away_m <= mission.capture_horizontal_m
            if self.capture_tick is None and captured and off_m <= mission.capture_altitude_m:
                self._capture(mission, tick)
            if away_m <= ARRIVED_M and off_m <= ARRIVED_M:
                self._way = mission.waypoints
                self._route = RouteReference(self._way, mission.speed_mps)
            else:
                rest, still = self._pursuit.rest_point(self._settings)[:2], (0.0, 0.0)
                goal, velocity = self.way_there.goal(self._pursuit, rest, (first, still))
                self._pursuit.step(goal, velocity, self._settings, self._dt, mission.way_mps)
                return False
        self._route.step(self._settings, self._dt)
        self._pursuit.x, self._pursuit.y = self._route.x, self._route.y
        self._pursuit.vx, self._pursuit.vy = self._route.vx, self._route.vy
        if self._level_m is None:
            self._pursuit.z, self._pursuit.vz = self._route.z, self._route.vz
        else:
            self._pursuit.step_vertical(self._level_m, self._settings, self._dt)
        last = mission.waypoints[-1]
        if not self._route.done:
            return False
        goes_on = self.stays_up or self._next_phase() != _LANDING
        if self.patrols and goes_on:  # once more, or back again, until its event
            self._laps += 1
            self._way = self._way if self._way[0] == self._way[-1] else self._way[::-1]
            self._route = RouteReference(self._way, mission.speed_mps)
            return False
        if self._held_up():
            return False
        if mission.duration_s is not None:
            return self._has_lasted(mission.duration_s, tick)
        return norm2(x - last[0], y - last[1]) <= ARRIVED_M

    def _held_up(self) -> bool:
        """Whether it is to stay on its last mission although that is over."""
        return self.stays_up and self._next_phase() == _LANDING

    def _fly_home(self, state: list[float], target: TargetMotion | None) -> None:
        if not self._airborne:  # told to land while still climbing
            self._start_reference(state)
        if self._climb is not None:
            self._pursuit.step(self._climb, (0.0, 0.0), self._settings, self._dt)
            if abs(state[_Z] - self._climb[2]) <= ARRIVED_M:
                self._climb = None
            return
        if self._landing_spot is None:
            if self._waits:  # the way is not free yet
                goal, velocity = self._waiting_goal(target)
                self._pursuit.step(goal, velocity, self._settings, self._dt)
            self._waits = True
            return
        x, y = state[_X], state[_Y]
        spot = self._landing_spot
        if not self._descending:
            climbing = state[_Z] < self._return_altitude_m - ARRIVED_M
            # Climb first, then across: the way was checked at the return altitude.
            across = (self._pursuit.x, self._pursuit.y) if climbing else spot
            goal = (across[0], across[1], self._return_altitude_m)
            self._pursuit.step(goal, (0.0, 0.0), self._settings, self._dt)
        slow = norm2(state[_VX], state[_VY]) <= 0.5
        if not self._descending and norm2(x - spot[0], y - spot[1]) <= 0.5 and slow:
            self._descending = True
        if self._descending and state[_LANDED] > 0.5 and state[_ARMED] < 0.5:
            self.landed = self.done = True

    def _waiting_goal(
        self, target: TargetMotion | None
    ) -> tuple[tuple[float, float, float], tuple[float, float]]:
        if target is not None and self._flown is not None:
            return self._goal(self._flown, target)
        return (self._pursuit.x, self._pursuit.y, self._pursuit.z), (0.0, 0.0)

    def _command(self, state: list[float]) -> FloatArray:
        """Return the command row; the order is that of `UavCommandColumn`."""
        yaw, phase = self.plan.home_yaw_enu_rad, float(self.phase)
        if self.phase == _IDLE or self.landed:
            here = state[_X : _Z + 1]
            return np.array([_MODE_IDLE, *here, 0.0, 0.0, 0.0, yaw, 0.0, phase])
        if self.phase == _ASCENT:
            z, home = self._first_altitude_m(), (self.plan.home_x_m, self.plan.home_y_m)
            return np.array([_MODE_TAKEOFF, *home, z, 0.0, 0.0, 0.0, yaw, z, phase])
        mode = _MODE_LAND if self._descending else _MODE_OFFBOARD
        r = self._pursuit
        return np.array([mode, r.x, r.y, r.z, r.vx, r.vy, r.vz, yaw, 0.0, phase])
