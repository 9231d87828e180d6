# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands above the flight modes while stand-alone: missions, the way home, failsafes.

In lockstep there is no pilot: the executor flies, and these would make a trace depend on them.

Source: PX4 user guide, safety (failsafes), return mode, position mode.
"""

from __future__ import annotations

from collections.abc import Callable
from math import radians
from typing import TYPE_CHECKING, Any

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.autopilot import ACCEPTED, Answer, FlightMode, Result
from aurora_uav_sim.battery import Battery, Charge
from aurora_uav_sim.fence import Breach, Fence, read_fence
from aurora_uav_sim.mission import Mission
from aurora_uav_sim.plan_items import Item, Refusal, Step, read_step
from aurora_uav_sim.way_home import WayHome

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle

# Sticks nearer to their middle than this are in it.
_DEAD_BAND = 0.05
_STICK = 1000.0
# What an action setting asks for, by its number in PX4.
_DATA_LINK_ACTIONS = {1: 'hold', 2: 'return', 3: 'land'}
_FENCE_ACTIONS = {2: 'hold', 3: 'return', 5: 'land'}
_OFFBOARD_ACTIONS = {3: 'return', 4: 'land', 5: 'hold'}
_NO_PILOT = Answer(Result.TEMPORARILY_REJECTED, 'Not in lockstep')


class Pilot:
    """Of one vehicle.

    Attributes:
        active: Off in lockstep.
        vehicle: Whom it flies.
        battery: Discharged in the air, filled by a restart.
        mission: Uploaded, or empty.
        fence_items: As they were uploaded.
        breach: Side of the fence that is crossed now (breaches: how often so far).
        link_silent_s: Since a ground station was heard, None: never was.
        outbox: Messages for everybody who listens.
    """

    def __init__(self, vehicle: Vehicle) -> None:
        self.vehicle = vehicle
        self.active = True
        self.outbox: list[Any] = []
        self.battery = Battery(vehicle.autopilot.settings)
        self.clear()

    def clear(self) -> None:
        """Forget mission and fence too."""
        self.mission = Mission()
        self.fence_items: tuple[Item, ...] = ()
        self._fence = Fence()
        self.restart()

    def restart(self) -> None:
        """Begin as after power-on; mission and fence are kept, the battery is full."""
        self.battery.fill()
        self.breach = Breach.NONE
        self.breaches = 0
        self.breach_ms = 0
        self.link_silent_s: float | None = None
        self.home_is_set = False
        self._charge = Charge.OK
        self._link_lost = False
        self._was_armed = False
        self._way_home: WayHome | None = None
        self._sticks: tuple[float, float, float, float] | None = None
        self._sticks_s = 0.0
        self._wind = (0.0, 0.0)
        self.mission.select(0)
        self.outbox.clear()

    # Words ------------------------------------------------------------------------------------

    def say(self, text: str, severity: int = mavlink.MAV_SEVERITY_INFO) -> None:
        """Tell the ground stations in words (cut at 50 bytes)."""
        self.tell(mavlink.MAVLink_statustext_message(severity, text.encode('ascii')[:50]))

    def tell(self, message: Any) -> None:
        """Tell every ground station."""
        self.outbox.append(message)

    def tell_mission(self) -> None:
        """Tell which item is next."""
        self.tell(self.mission_current())

    def mission_current(self) -> Any:
        """MISSION_CURRENT."""
        mission, mode = self.mission, self.vehicle.autopilot.mode
        # PX4: the total is 65535 without a mission.
        total = len(mission.items) or 0xFFFF
        running = 1 if mode is FlightMode.MISSION else 2
        return mavlink.MAVLink_mission_current_message(
            mission.current, total, mission.state(mode), running
        )

    # Commands ---------------------------------------------------------------------------------

    def arming_reasons(self) -> list[str]:
        """Return why the vehicle may not be armed now, empty when it may."""
        autopilot = self.vehicle.autopilot
        reason = autopilot.arming_reason()
        reasons = [reason] if reason else []
        if not self.active:
            return reasons
        if self.battery.charge >= Charge.CRITICAL:
            reasons.append('battery is critical')
        if autopilot.settings.fence_action and self._beyond() is not Breach.NONE:
            reasons.append('outside the geofence')
        if autopilot.settings.data_link_loss_action and self._data_link_lost():
            reasons.append('no ground station')
        return reasons

    def arm(self) -> Answer:
        """Arm, or say the first reason why not."""
        reasons = [] if self.vehicle.autopilot.armed else self.arming_reasons()
        if reasons:
            return Answer(Result.TEMPORARILY_REJECTED, f'Arming denied: {reasons[0]}')
        return self.vehicle.autopilot.arm()

    def fly_mission(self) -> Answer:
        """Begin the mission, or go on with it."""
        if not self.active:
            return _NO_PILOT
        if not self.mission.items:
            return Answer(Result.TEMPORARILY_REJECTED, 'Mission denied: no mission')
        autopilot = self.vehicle.autopilot
        if autopilot.mode is not FlightMode.MISSION:
            autopilot.enter(FlightMode.MISSION)
            self.mission.start()
            self.tell_mission()
        return ACCEPTED

    def select_item(self, at: int) -> Answer:
        """Make an item of the mission the next one."""
        if not self.active:
            return _NO_PILOT
        if not self.mission.select(at):
            return Answer(Result.DENIED, f'Mission has no item {at}')
        if self.vehicle.autopilot.mode is FlightMode.MISSION:
            self.mission.start()
        self.tell_mission()
        return ACCEPTED

    def return_home(self) -> Answer:
        """Fly home and land there."""
        autopilot = self.vehicle.autopilot
        if not self.active:
            return _NO_PILOT
        if not autopilot.armed or autopilot.landed:
            return Answer(Result.TEMPORARILY_REJECTED, 'Return denied: not flying')
        if autopilot.mode is not FlightMode.RETURN:
            autopilot.enter(FlightMode.RETURN)
            self._way_home = WayHome(self.vehicle)
        return ACCEPTED

    def position(self) -> Answer:
        """Fly by the sticks, which have to be moved already (PX4's rule)."""
        if not self.active:
            return _NO_PILOT
        if not self._sticks_alive():
            return Answer(Result.TEMPORARILY_REJECTED, 'Position mode denied: no sticks')
        if self.vehicle.autopilot.mode is not FlightMode.POSITION:
            self.vehicle.autopilot.enter(FlightMode.POSITION)
        return ACCEPTED

    def take_sticks(self, forward: float, right: float, up: float, turn: float) -> None:
        """Take the sticks, -1 to 1 each; turn clockwise seen from above."""
        self._sticks = forward, right, up, turn
        self._sticks_s = self.vehicle.autopilot.time_s

    def take_mission(self, items: tuple[Item, ...]) -> Refusal | None:
        """Take an uploaded mission whole, or say why not."""
        steps: list[Step] = []
        for at, item in enumerate(items):
            step = read_step(item, self.vehicle, len(items))
            if isinstance(step, Refusal):
                return Refusal(step.result, f'Mission denied: item {at}: {step.reason}')
            if step.xy is not None and not self._may_go(step):
                reason = f'Mission denied: item {at}: outside the geofence'
                return Refusal(mavlink.MAV_MISSION_DENIED, reason)
            steps.append(step)
        if self.vehicle.autopilot.mode is FlightMode.MISSION:
            self.vehicle.autopilot.hold()
        self.mission = Mission(items, tuple(steps))
        self.tell_mission()
        return None

    def take_fence(self, items: tuple[Item, ...]) -> Refusal | None:
        """Take an uploaded fence whole, or say why not."""
        fence = read_fence(items, self.vehicle)
        if isinstance(fence, Refusal):
            return Refusal(fence.result, f'Fence denied: {fence.reason}')
        self.fence_items, self._fence = items, fence
        return None

    def _may_go(self, step: Step) -> bool:
        vehicle = self.vehicle
        if step.xy is None or not vehicle.autopilot.settings.fence_action:
            return True
        home = vehicle.home
        z = home[2] if step.z is None else step.z + (home[2] if step.above_home else 0.0)
        return self._fence.breach((*step.xy, z), home, vehicle.autopilot.settings) is Breach.NONE

    # Time -------------------------------------------------------------------------------------

    def step(self, h: float) -> None:
        """Look after the vehicle; `h` seconds have passed."""
        if not self.active:
            return
        autopilot = self.vehicle.autopilot
        self._blow()
        if autopilot.armed and not self._was_armed and not self.home_is_set:
            # PX4: home is where it was armed, unless somebody said otherwise.
            self.vehicle.home = (autopilot.body.x, autopilot.body.y, autopilot.body.z)
        self._was_armed = autopilot.armed
        if not autopilot.landed:
            self.battery.step(h, autopilot.body, autopilot.wind)
            self._watch()
        if autopilot.mode is FlightMode.RETURN and self._way_home is not None:
            self._way_home.step(h)
        elif autopilot.mode is FlightMode.POSITION:
            self._follow_sticks()
        self.mission.step(self, h)

    def _blow(self) -> None:
        settings = self.vehicle.autopilot.settings
        wind = settings.wind_east_mps, settings.wind_north_mps
        if wind != self._wind:
            self._wind = wind
            self.vehicle.autopilot.wind.set(*wind, 0.0, 0.0)

    # Failsafes --------------------------------------------------------------------------------

    def _watch(self) -> None:
        autopilot = self.vehicle.autopilot
        settings = autopilot.settings
        if autopilot.offboard_lost:
            autopilot.offboard_lost = False
            action = _OFFBOARD_ACTIONS[int(settings.offboard_loss_action)]
            self._fall_back('offboard set-points lost', action)
        lost = self._data_link_lost()
        if lost and not self._link_lost:
            action = _DATA_LINK_ACTIONS.get(int(settings.data_link_loss_action), '')
            if action:
                self._fall_back('ground station lost', action)
        self._link_lost = lost
        self._watch_battery()
        breach = self._beyond()
        if breach is not Breach.NONE and self.breach is Breach.NONE and settings.fence_action:
            self.breaches += 1
            self.breach_ms = int(autopilot.time_s * 1000.0)
            action = _FENCE_ACTIONS.get(int(settings.fence_action), '')
            self._fall_back('geofence crossed', action)
        self.breach = breach

    def _watch_battery(self) -> None:
        charge = self.battery.charge
        if charge <= self._charge:
            return
        self._charge = charge
        wanted = self.vehicle.autopilot.settings.low_battery_action
        action = ''
        if charge >= Charge.CRITICAL and wanted == 2:
            action = 'land'
        elif charge >= Charge.CRITICAL and wanted == 3:
            action = 'land' if charge is Charge.EMERGENCY else 'return'
        self._fall_back(f'battery {charge.name.lower()}', action)

    def _fall_back(self, reason: str, action: str) -> None:
        """Say what happened and act; nothing interrupts a landing, only that a return."""
        autopilot = self.vehicle.autopilot
        mode = autopilot.mode
        kept = mode is FlightMode.LAND or (mode is FlightMode.RETURN and action != 'land')
        deed = f': {action}' if action and not kept else ''
        self.say(f'Failsafe: {reason}{deed}', mavlink.MAV_SEVERITY_CRITICAL)
        if action and not kept:
            acts: dict[str, Callable[[], Answer]] = {
                'hold': autopilot.hold, 'land': autopilot.land, 'return': self.return_home,
            }  # fmt: skip
            acts[action]()

    def _beyond(self) -> Breach:
        vehicle = self.vehicle
        body = vehicle.autopilot.body
        return self._fence.breach(
            (body.x, body.y, body.z), vehicle.home, vehicle.autopilot.settings
        )

    def _data_link_lost(self) -> bool:
        limit_s = self.vehicle.autopilot.settings.data_link_loss_s
        return self.link_silent_s is None or self.link_silent_s > limit_s

    # Sticks -----------------------------------------------------------------------------------

    def _sticks_alive(self) -> bool:
        autopilot = self.vehicle.autopilot
        silent_s = autopilot.time_s - self._sticks_s
        return self._sticks is not None and silent_s <= autopilot.settings.sticks_loss_s

    def _follow_sticks(self) -> None:
        autopilot = self.vehicle.autopilot
        if self._sticks is None or not self._sticks_alive():
            autopilot.hold()
            self.say('Failsafe: sticks lost: hold', mavlink.MAV_SEVERITY_CRITICAL)
            return
        forward, right, up, turn = (
            value if abs(value) > _DEAD_BAND else 0.0 for value in self._sticks
        )
        settings = autopilot.settings
        speed = settings.manual_mps
        vxy, heading = self.vehicle.body_velocity(
            speed * forward, speed * right, radians(turn * settings.manual_yaw_dps)
        )
        climb = settings.auto_climb_mps if up > 0.0 else settings.auto_descent_mps
        autopilot.steer(vxy, up * climb, heading)


def sticks_of(m: Any) -> tuple[float, float, float, float]:
    """Return (forward, right, up, turn) of a MANUAL_CONTROL, -1 to 1; its thrust has no sign."""
    values = (m.x / _STICK, m.y / _STICK, (m.z - 500.0) / 500.0, m.r / _STICK)
    forward, right, up, turn = (min(max(value, -1.0), 1.0) for value in values)
    return forward, right, up, turn
