# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A mission under way: item after item, with what a ground station is told of it."""

from __future__ import annotations

from enum import Enum, IntEnum
from math import sqrt
from typing import TYPE_CHECKING

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim import plan_items
from aurora_uav_sim.autopilot import FlightMode
from aurora_uav_sim.plan_items import Item, Step

if TYPE_CHECKING:
    from aurora_uav_sim.pilot import Pilot

# Nearer than this a vehicle does not turn towards where it goes.
_TURN_M = 1.0


class MissionState(IntEnum):
    """The numbers of MISSION_STATE."""

    NONE = 1
    NOT_STARTED = 2
    ACTIVE = 3
    PAUSED = 4
    COMPLETE = 5


class _Phase(Enum):
    BEGIN = 0  # nothing done for the item yet
    LIFT = 1  # straight up from the ground
    GO = 2  # on the way
    STAY = 3  # there, waiting
    LANDING = 4


class Mission:
    """The items of a vehicle, which one it is at, and how far it has come.

    Attributes:
        items: As they were uploaded.
        current: Item that is flown, or would be.
    """

    def __init__(self, items: tuple[Item, ...] = (), steps: tuple[Step, ...] = ()) -> None:
        self.items = items
        self._steps = steps
        self._started = self._complete = False
        self._restart(0)

    def _restart(self, at: int) -> None:
        self.current = at
        self._phase = _Phase.BEGIN
        self._stay_s = 0.0
        self._speed: float | None = None
        self._jumps = [step.repeats for step in self._steps]
        self._complete = False

    def select(self, at: int) -> bool:
        """Make an item the next one; whether there is such an item."""
        if not 0 <= at < len(self.items):
            return False
        self._restart(at)
        return True

    def start(self) -> None:
        """Begin, or go on with the item where it was left."""
        if self._complete:
            self._restart(0)
        self._started = True
        self._phase = _Phase.BEGIN

    @property
    def lands(self) -> bool:
        """Landing, as its item says (the flight mode is then LAND)."""
        return self._phase is _Phase.LANDING

    def state(self, mode: FlightMode) -> MissionState:
        """Return how far it is, in the flight mode that is on."""
        if not self.items:
            return MissionState.NONE
        if self._complete:
            return MissionState.COMPLETE
        if mode is FlightMode.MISSION or self.lands:
            return MissionState.ACTIVE
        return MissionState.PAUSED if self._started else MissionState.NOT_STARTED

    def step(self, pilot: Pilot, h: float) -> None:
        """Fly on for `h` seconds."""
        autopilot = pilot.vehicle.autopilot
        if self.lands:
            if autopilot.landed:
                self._done(pilot)
            elif autopilot.mode is not FlightMode.LAND:
                self._phase = _Phase.BEGIN
            return
        if autopilot.mode is not FlightMode.MISSION or not autopilot.armed:
            return
        # Several items may take no time; a loop of jumps must not hold the process.
        for _ in range(len(self._steps) + 1):
            if not self._fly(pilot, h):
                return

    def _fly(self, pilot: Pilot, h: float) -> bool:
        """Act on the current item; whether the next one is to begin at once."""
        vehicle = pilot.vehicle
        step = self._steps[self.current]
        if step.command == plan_items.SPEED:
            self._speed = step.value if step.value > 0.0 else None
            return self._done(pilot)
        if step.command == plan_items.JUMP:
            return self._jump(pilot, step)
        if step.command == plan_items.RETURN:
            self._complete = self.current == len(self._steps) - 1
            pilot.return_home()
            return False
        if self._phase is _Phase.BEGIN:
            self._begin(pilot, step)
        if self._phase is _Phase.LIFT and self._arrived(pilot, None, self._lift_z(pilot, step)):
            self._go(pilot, step)
        xy = None if step.command == plan_items.TAKEOFF else step.xy
        if self._phase is _Phase.GO and self._arrived(pilot, xy, self._z(pilot, step), step):
            if step.command == plan_items.LAND:
                vehicle.autopilot.land(xy)
                self._phase = _Phase.LANDING
                return False
            self._phase = _Phase.STAY
            self._stay_s = 0.0
        elif self._phase is _Phase.STAY:
            self._stay_s += h
        if self._phase is not _Phase.STAY or step.command == plan_items.LOITER:
            return False
        return self._stay_s >= step.stay_s and self._done(pilot)

    def _begin(self, pilot: Pilot, step: Step) -> None:
        if pilot.vehicle.autopilot.landed and step.command != plan_items.LAND:
            self._phase = _Phase.LIFT
            pilot.vehicle.autopilot.aim(None, self._lift_z(pilot, step), None, None)
        else:
            self._go(pilot, step)

    def _go(self, pilot: Pilot, step: Step) -> None:
        self._phase = _Phase.GO
        autopilot = pilot.vehicle.autopilot
        xy, yaw = step.xy, step.sin_cos_yaw
        if step.command == plan_items.TAKEOFF:
            xy = None
        if xy is not None and yaw is None:
            dx, dy = xy[0] - autopilot.body.x, xy[1] - autopilot.body.y
            distance = sqrt(dx * dx + dy * dy)
            if distance > _TURN_M:
                yaw = dy / distance, dx / distance
        autopilot.aim(xy, self._z(pilot, step), yaw, self._speed)

    def _z(self, pilot: Pilot, step: Step) -> float | None:
        if step.z is None or not step.above_home:
            return step.z
        return step.z + pilot.vehicle.home[2]

    def _lift_z(self, pilot: Pilot, step: Step) -> float:
        """Height of the climb from the ground: that of the item, at least the setting's."""
        vehicle = pilot.vehicle
        least = vehicle.home[2] + vehicle.autopilot.settings.takeoff_altitude_m
        z = self._z(pilot, step)
        if z is None or step.command != plan_items.TAKEOFF:
            return least if z is None else max(z, least)
        return z

    def _arrived(
        self, pilot: Pilot, xy: tuple[float, float] | None, z: float | None,
        step: Step | None = None,
    ) -> bool:  # fmt: skip
        body, settings = pilot.vehicle.autopilot.body, pilot.vehicle.autopilot.settings
        within = settings.acceptance_m
        if step is not None and step.within_m is not None:
            within = step.within_m
        if xy is not None and (body.x - xy[0]) ** 2 + (body.y - xy[1]) ** 2 > within * within:
            return False
        return z is None or abs(body.z - z) <= settings.altitude_acceptance_m

    def _jump(self, pilot: Pilot, step: Step) -> bool:
        if self._jumps[self.current] == 0:
            return self._done(pilot)
        if self._jumps[self.current] > 0:
            self._jumps[self.current] -= 1
        self._set_current(pilot, int(step.value))
        return True

    def _done(self, pilot: Pilot) -> bool:
        """Tell that the item was reached and take the next one; whether there is one."""
        pilot.tell(mavlink.MAVLink_mission_item_reached_message(self.current))
        if self.current + 1 < len(self._steps):
            self._set_current(pilot, self.current + 1)
            return True
        self._complete = True
        self._phase = _Phase.BEGIN
        if pilot.vehicle.autopilot.mode is FlightMode.MISSION:
            pilot.vehicle.autopilot.hold()
        pilot.say('Mission finished')
        pilot.tell_mission()
        return False

    def _set_current(self, pilot: Pilot, at: int) -> None:
        self.current = at
        self._phase = _Phase.BEGIN
        pilot.tell_mission()
