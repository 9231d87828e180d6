# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Flight modes, arming and landing detection of one vehicle, PX4 flavour; no MAVLink here.

Source: PX4 user guide, flight modes (multicopter), offboard mode, safety.
"""

from __future__ import annotations

from enum import Enum, IntEnum
from math import sqrt
from typing import NamedTuple

from aurora_uav_sim.compiled import Controller, Multirotor, SetPoint, fly
from aurora_uav_sim.control import MOTORS_OFF, Motors
from aurora_uav_sim.parameters import installed_model
from aurora_uav_sim.settings import AutopilotSettings, restore_defaults
from aurora_uav_sim.wind import Wind

# Acceleration of the height ramps of take-off and landing.
_RAMP_MPS2 = 1.5
# Take-off is over when this close to its height and this slow.
_REACHED_M = 0.3
_REACHED_MPS = 0.3
# Landing slows down linearly over the last metres: speed = land_speed + slope * (height - 1 m).
_FLARE_SLOPE_HZ = 0.6
_FLARE_END_M = 1.0
# Ground contact for so long counts as landed.
_LANDED_S = 0.5
# Set-points that end later than this are alive for certain, whatever is rounded on the way.
_MARGIN_S = 1e-6
# Set-points further apart than this tell nothing about an acceleration.
_SMOOTH_S = 0.25
# A set-point less than this above the ground does not start a take-off from offboard mode.
_LIFT_M = 0.1
# Arming needs a vehicle that stands: cosine of 20 degrees.
_UPRIGHT = 0.94


class FlightMode(Enum):
    """Value: PX4 main and sub mode. Source: px4_custom_mode.h."""

    HOLD = (4, 3)
    TAKEOFF = (4, 2)
    MISSION = (4, 4)
    RETURN = (4, 5)
    LAND = (4, 6)
    POSITION = (3, 0)
    OFFBOARD = (6, 0)

    @property
    def custom_mode(self) -> int:
        """The `custom_mode` of HEARTBEAT."""
        main, sub = self.value
        return int(main) << 16 | int(sub) << 24


# Plain names: before Python 3.12 a member is slow to look up, and each physics step asks.
_HOLD, _TAKEOFF = FlightMode.HOLD, FlightMode.TAKEOFF
_LAND, _OFFBOARD = FlightMode.LAND, FlightMode.OFFBOARD
# In these somebody moves the set-point (`pilot`), from the ground as well.
_GUIDED = frozenset({FlightMode.MISSION, FlightMode.RETURN, FlightMode.POSITION})


class Result(IntEnum):
    """Answer to a command; the numbers of MAV_RESULT."""

    ACCEPTED = 0
    TEMPORARILY_REJECTED = 1
    DENIED = 2
    UNSUPPORTED = 3
    FAILED = 4


class Answer(NamedTuple):
    """Result of a command and, when refused, the reason for the pilot."""

    result: Result
    reason: str = ''


ACCEPTED = Answer(Result.ACCEPTED)


class Target(NamedTuple):
    """An offboard set-point, ENU around the local origin; None: not controlled.

    The position and the velocity are (x, y) and z apart, since one may be given without the
    other.
    """

    xy: tuple[float, float] | None
    z: float | None
    vxy: tuple[float, float] | None
    vz: float | None
    sin_cos_yaw: tuple[float, float] | None


class Autopilot:
    """One vehicle: body, controller, wind and mode logic.

    Attributes:
        body: The dynamics.
        wind: Wind at the vehicle.
        settings: What a ground station may set.
        mode: Flight mode.
        armed: Motors may turn.
        landed: On the ground, as the landing detector sees it.
        time_s: Simulated time since the last reset.
        offboard_lost: Offboard mode ended because its set-points stopped; whoever acts on it
            clears it.
    """

    def __init__(self) -> None:
        model = installed_model()
        self._limits = model.control
        self.body = Multirotor(model.body)
        self.wind = Wind()
        self.settings = AutopilotSettings()
        self._controller = Controller(self.body, self._limits)
        self.reset()

    def reset(self, half_yaw_sine: float = 0.0, half_yaw_cosine: float = 1.0) -> None:
        """Stand at the local origin, disarmed, with default settings (the wind is kept)."""
        self.body.reset(half_yaw_sine, half_yaw_cosine)
        self._controller.reset()
        restore_defaults(self.settings)
        self.mode = _HOLD
        self.armed = False
        self.landed = True
        self.time_s = 0.0
        self._set_point = SetPoint(self._limits)
        self._keep_heading()
        self._target: Target | None = None
        self._target_time_s = 0.0
        self.offboard_lost = False
        self._contact_s = 0.0
        self._idle_s = 0.0
        self._flown = False
        self._ramp_mps = 0.0
        self._takeoff_z = 0.0

    # Commands ---------------------------------------------------------------------------------

    def arm(self) -> Answer:
        """Arm, if the vehicle stands upright and its mode can start from the ground."""
        if self.armed:
            return ACCEPTED
        reason = self.arming_reason()
        if reason:
            return Answer(Result.TEMPORARILY_REJECTED, f'Arming denied: {reason}')
        self.armed = True
        self._flown = False
        self._idle_s = 0.0
        self._contact_s = 0.0
        self._controller.reset()
        if self.mode is _TAKEOFF:
            self._begin_takeoff()
        return ACCEPTED

    def arming_reason(self) -> str:
        """Return why the vehicle cannot be armed now, '' when it can."""
        body = self.body
        if not self.landed:
            return 'not landed'
        if 1.0 - 2.0 * (body.qx * body.qx + body.qy * body.qy) < _UPRIGHT:
            return 'not level'
        if self.mode is _OFFBOARD and not self.offboard_alive:
            return 'no offboard set-points'
        return ''

    def disarm(self, *, force: bool = False) -> Answer:
        """Disarm; in the air only by force."""
        if self.armed and not self.landed and not force:
            return Answer(Result.TEMPORARILY_REJECTED, 'Disarming denied: not landed')
        self._disarm()
        return ACCEPTED

    def takeoff(self, height_m: float) -> Answer:
        """Climb to a height above the local origin; waits for arming when disarmed."""
        if not 0.0 < height_m < 10000.0:
            return Answer(Result.DENIED, 'Take-off denied: height out of range')
        if self.mode is _TAKEOFF and height_m == self._takeoff_z:
            # A repeated command must not start the ramp again.
            return ACCEPTED
        self.mode = _TAKEOFF
        self._takeoff_z = height_m
        self._begin_takeoff()
        return ACCEPTED

    def land(self, xy: tuple[float, float] | None = None) -> Answer:
        """Descend and disarm after touchdown; nothing to do on the ground.

        Args:
            xy: Where, around the local origin, ENU, m; None: here.
        """
        if not self.armed or self.mode is _LAND:
            return ACCEPTED
        self.mode = _LAND
        self._stop_here()
        if xy is not None:
            self._set_point.x, self._set_point.y = xy
        self._ramp_mps = -self.body.vz
        self._set_point.follow_z = False
        return ACCEPTED

    def hold(self) -> Answer:
        """Brake and stay; on the ground wait for the next command."""
        if self.mode is not _HOLD:
            self.mode = _HOLD
            self._stop_here()
        return ACCEPTED

    def offboard(self) -> Answer:
        """Follow the streamed set-points; they must be flowing already (PX4's rule)."""
        if not self.offboard_alive:
            return Answer(Result.TEMPORARILY_REJECTED, 'Offboard denied: no set-points')
        if self.mode is not _OFFBOARD:
            self.mode = _OFFBOARD
            self._apply_target()
        return ACCEPTED

    def reposition(
        self,
        xy: tuple[float, float] | None,
        z: float | None,
        sin_cos_yaw: tuple[float, float] | None,
        speed_mps: float | None,
    ) -> Answer:
        """Fly to a point and hold there; None keeps what is.

        Args:
            xy: Goal around the local origin, ENU, m.
            z: Height above the local origin, m.
            sin_cos_yaw: Sine and cosine of the ENU yaw to keep.
            speed_mps: Horizontal speed.
        """
        if not self.armed or self.landed:
            return Answer(Result.TEMPORARILY_REJECTED, 'Reposition denied: not flying')
        self.mode = _HOLD
        self.aim(xy, z, sin_cos_yaw, speed_mps)
        return ACCEPTED

    def enter(self, mode: FlightMode) -> None:
        """Brake and stay in a mode whose set-points come from outside (`aim`, `steer`)."""
        self.mode = mode
        self._stop_here()

    def aim(
        self,
        xy: tuple[float, float] | None,
        z: float | None,
        sin_cos_yaw: tuple[float, float] | None,
        speed_mps: float | None,
    ) -> None:
        """Move the set-point to a point, in any mode; arguments as for `reposition`."""
        self._stop_here()
        s = self._set_point
        if xy is not None:
            s.x, s.y = xy
        if z is not None:
            s.z = z
        if sin_cos_yaw is not None:
            s.sin_yaw, s.cos_yaw = sin_cos_yaw
        if speed_mps is not None:
            self.limit_speed(speed_mps)

    def limit_speed(self, speed_mps: float) -> None:
        """Fly no faster than this, horizontally, on the way to the set-point."""
        limit = self._limits.horizontal_speed_limit_mps
        self._set_point.speed_limit = min(speed_mps, limit)

    def steer(
        self,
        vxy: tuple[float, float],
        vz: float,
        sin_cos_yaw: tuple[float, float] | None,
    ) -> None:
        """Fly with a velocity (ENU, m/s) and heading (None: the one that was asked for)."""
        s = self._set_point
        s.follow_xy = s.follow_z = False
        s.vx, s.vy = vxy
        s.vz = vz
        s.ax = s.ay = s.az = 0.0
        if sin_cos_yaw is not None:
            s.sin_yaw, s.cos_yaw = sin_cos_yaw

    def set_target(self, target: Target) -> None:
        """Take a streamed set-point; it acts in offboard mode."""
        old, silent_s = self._target, self.time_s - self._target_time_s
        self._target = target
        self._target_time_s = self.time_s
        if self.mode is not _OFFBOARD:
            return
        self._apply_target()
        if old is not None and 0.0 < silent_s <= _SMOOTH_S:
            self._anticipate(target, old, silent_s)

    def _anticipate(self, target: Target, old: Target, elapsed_s: float) -> None:
        """Feed the acceleration of a smoothly moving set-point forward; a jump has none."""
        s, limits = self._set_point, self._limits
        if target.xy is not None and target.vxy is not None and old.vxy is not None:
            ax = (target.vxy[0] - old.vxy[0]) / elapsed_s
            ay = (target.vxy[1] - old.vxy[1]) / elapsed_s
            limit = limits.horizontal_acceleration_limit_mps2
            if ax * ax + ay * ay <= limit * limit:
                s.ax, s.ay = ax, ay
        if target.z is not None and target.vz is not None and old.vz is not None:
            az = (target.vz - old.vz) / elapsed_s
            if abs(az) <= limits.vertical_acceleration_limit_mps2:
                s.az = az

    @property
    def offboard_alive(self) -> bool:
        """Set-points arrive often enough."""
        silent_s = self.time_s - self._target_time_s
        return self._target is not None and silent_s <= self.settings.offboard_loss_s

    # Time -------------------------------------------------------------------------------------

    def run(self, steps: int, h: float) -> None:
        """Advance the vehicle by `steps` physics steps of `h` seconds."""
        while steps > 0:
            if self._cruises(steps * h):
                wind, body = self.wind, self.body
                flown = fly(
                    self._controller, body, self._set_point, (wind.x, wind.y, wind.z), h, steps
                )
                for _ in range(flown):
                    self.time_s += h
                if body.on_ground:
                    self._on_ground(h)
                steps -= flown
            else:
                self.step(h)
                steps -= 1

    def _cruises(self, time_s: float) -> bool:
        """Tell whether nothing but physics happens for so long, unless it comes to the ground."""
        if not self.armed or self.landed or self._contact_s > 0.0 or not self.wind.is_steady:
            return False
        mode = self.mode
        if mode is _OFFBOARD:
            silent_s = self.time_s + time_s - self._target_time_s
            return silent_s < self.settings.offboard_loss_s - _MARGIN_S
        return mode is not _TAKEOFF and mode is not _LAND

    def step(self, h: float) -> None:
        """Advance the vehicle by one physics step of `h` seconds."""
        self.time_s += h
        body = self.body
        wind = self.wind
        wind.step(h)
        motors = self._command(h) if self.armed else MOTORS_OFF
        body.step(h, motors, wind.x, wind.y, wind.z)
        if body.on_ground:
            self._on_ground(h)
        elif self.landed or self._contact_s > 0.0:
            self.landed = False
            self._flown = True
            self._contact_s = 0.0

    def _command(self, h: float) -> Motors:
        """Return the motor thrusts of the current mode."""
        mode = self.mode
        if mode is _OFFBOARD:
            if not self.offboard_alive:
                self.hold()
                self.offboard_lost = True
        elif mode is _TAKEOFF:
            self._climb(h)
        elif mode is _LAND:
            self._descend(h)
        if self.landed and not self._wants_up():
            # Idle on the ground: no integrator may wind up against the legs.
            self._controller.reset()
            idle = self._limits.thrust_min_fraction * self.body.parameters.motor_max_thrust_n
            return idle, idle, idle, idle
        return self._controller.update(h, self._set_point)

    def _wants_up(self) -> bool:
        if self.mode is _TAKEOFF:
            return True
        if self.mode is not _OFFBOARD and self.mode not in _GUIDED:
            return False
        s = self._set_point
        return s.z > self.body.z + _LIFT_M if s.follow_z else s.vz > _LIFT_M

    def _on_ground(self, h: float) -> None:
        """Detect the landing and disarm when it has lasted."""
        if self._wants_up() and self.armed:
            self._contact_s = 0.0
            self._idle_s = 0.0
            return
        self._contact_s += h
        if self._contact_s >= _LANDED_S or not self.armed:
            self.landed = True
        if not self.armed or not self.landed:
            return
        self._idle_s += h
        settings = self.settings
        over = self._flown or self.mode is _LAND
        patience_s = settings.disarm_landed_s if over else settings.disarm_preflight_s
        if self._idle_s >= patience_s:
            self._disarm()

    def _disarm(self) -> None:
        self.armed = False
        self._controller.reset()
        self.mode = _HOLD
        self._stop_here()

    # Set-points of the modes --------------------------------------------------------------------

    def _keep_heading(self) -> None:
        body = self.body
        east = 1.0 - 2.0 * (body.qy * body.qy + body.qz * body.qz)
        north = 2.0 * (body.qx * body.qy + body.qw * body.qz)
        length = sqrt(east * east + north * north)
        if length > 0.0:
            self._set_point.cos_yaw = east / length
            self._set_point.sin_yaw = north / length

    def _stop_here(self) -> None:
        """Hold the point where braking from the present velocity ends."""
        body, s, limits = self.body, self._set_point, self._limits
        speed = sqrt(body.vx * body.vx + body.vy * body.vy)
        # Distance d from which `braking_speed(d)` is the present speed, linear part included.
        gain, braking = limits.position_gain_hz, limits.braking_mps2
        knee = braking / gain
        reach_s = 1.0 / gain
        if speed > knee:
            reach_s = 0.5 * (speed / braking + braking / (speed * gain * gain))
        s.x, s.y = body.x + body.vx * reach_s, body.y + body.vy * reach_s
        s.z = body.z
        s.vx = s.vy = s.vz = 0.0
        s.ax = s.ay = s.az = 0.0
        s.follow_xy = s.follow_z = True
        s.speed_limit = max(self.settings.cruise_mps, speed)
        s.climb_limit = self.settings.auto_climb_mps
        s.descent_limit = self.settings.auto_descent_mps
        self._keep_heading()

    def _begin_takeoff(self) -> None:
        self._stop_here()
        self._ramp_mps = max(self.body.vz, 0.0)
        # In the air, a lower take-off height means: stay at this one.
        self._takeoff_z = max(self._takeoff_z, self.body.z)

    def _climb(self, h: float) -> None:
        """Move the height set-point along a ramp that ends softly at the take-off height."""
        s = self._set_point
        left = self._takeoff_z - s.z
        braking = sqrt(2.0 * _RAMP_MPS2 * left) if left > 0.0 else 0.0
        speed = min(self._ramp_mps + h * _RAMP_MPS2, self.settings.takeoff_speed_mps, braking)
        s.z = min(s.z + h * speed, self._takeoff_z)
        s.az = (speed - self._ramp_mps) / h
        s.vz = self._ramp_mps = speed
        body = self.body
        if abs(self._takeoff_z - body.z) < _REACHED_M and abs(body.vz) < _REACHED_MPS:
            self.mode = _HOLD
            s.z, s.vz, s.az = self._takeoff_z, 0.0, 0.0

    def _descend(self, h: float) -> None:
        """Sink at the automatic descent rate, slower near the ground."""
        settings = self.settings
        flare = settings.land_speed_mps + _FLARE_SLOPE_HZ * (self.body.z - _FLARE_END_M)
        wanted = min(settings.auto_descent_mps, max(settings.land_speed_mps, flare))
        speed = min(self._ramp_mps + h * _RAMP_MPS2, wanted)
        self._set_point.az = (self._ramp_mps - speed) / h
        self._set_point.vz = -speed
        self._ramp_mps = speed

    def _apply_target(self) -> None:
        """Copy the streamed set-point; what it leaves open keeps still."""
        target, s, limits = self._target, self._set_point, self._limits
        if target is None:
            return
        s.follow_xy = target.xy is not None
        if target.xy is not None:
            s.x, s.y = target.xy
        s.follow_z = target.z is not None
        if target.z is not None:
            s.z = target.z
        s.vx, s.vy = target.vxy if target.vxy is not None else (0.0, 0.0)
        s.vz = target.vz if target.vz is not None else 0.0
        s.ax = s.ay = s.az = 0.0
        if target.sin_cos_yaw is not None:
            s.sin_yaw, s.cos_yaw = target.sin_cos_yaw
        s.speed_limit = limits.horizontal_speed_limit_mps
        s.climb_limit = limits.climb_limit_mps
        s.descent_limit = limits.descent_limit_mps
