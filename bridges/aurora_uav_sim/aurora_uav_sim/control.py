# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The cascade position, velocity, attitude, body rate, motors; no trigonometry.

Source: structure after the PX4 multicopter position, attitude and rate controllers; attitude
error split into tilt and yaw after Brescianini, Hehn, D'Andrea, "Nonlinear quadrocopter attitude
control" (2013); braking law after ArduPilot's `sqrt_controller`.
"""

from __future__ import annotations

from math import sqrt

from aurora_uav_sim.multirotor import Multirotor
from aurora_uav_sim.parameters import GRAVITY_MPS2, ControlParameters

Motors = tuple[float, float, float, float]
MOTORS_OFF: Motors = (0.0, 0.0, 0.0, 0.0)


class SetPoint:
    """What the controller is to follow; ENU around the local origin.

    Attributes:
        x: Position, m (y, z).
        vx: Velocity feed-forward, m/s (vy, vz).
        ax: Acceleration feed-forward, m/s^2 (ay, az).
        cos_yaw: Cosine of the ENU yaw (sin_yaw: sine).
        follow_xy: Follow the horizontal position, or only the velocity.
        follow_z: Follow the height, or only the climb rate.
        speed_limit: Largest horizontal speed, m/s (climb_limit, descent_limit: vertical).
    """

    __slots__ = ('ax', 'ay', 'az', 'climb_limit', 'cos_yaw', 'descent_limit', 'follow_xy',
                 'follow_z', 'sin_yaw', 'speed_limit', 'vx', 'vy', 'vz', 'x', 'y',
                 'z')  # fmt: skip

    def __init__(self, parameters: ControlParameters) -> None:
        self.speed_limit = parameters.horizontal_speed_limit_mps
        self.climb_limit = parameters.climb_limit_mps
        self.descent_limit = parameters.descent_limit_mps
        self.x = self.y = self.z = 0.0
        self.vx = self.vy = self.vz = 0.0
        self.ax = self.ay = self.az = 0.0
        self.cos_yaw = 1.0
        self.sin_yaw = 0.0
        self.follow_xy = True
        self.follow_z = True


def braking_speed(distance_m: float, gain_hz: float, braking_mps2: float) -> float:
    """Return the speed from which a stop within `distance_m` is possible.

    Linear near the goal, square root further out, smooth where they meet.

    Args:
        distance_m: Distance to the goal, >= 0.
        gain_hz: Slope near the goal, 1/s.
        braking_mps2: Deceleration to plan with, > 0.
    """
    linear_m = braking_mps2 / (gain_hz * gain_hz)
    if distance_m <= linear_m:
        return gain_hz * distance_m
    return sqrt(2.0 * braking_mps2 * (distance_m - 0.5 * linear_m))


def clip(value: float, limit: float) -> float:
    """Return `value` within +- `limit` (0 for a negative limit)."""
    if limit < 0.0:
        return 0.0
    return limit if value > limit else -limit if value < -limit else value


class Controller:
    """One vehicle's controller; keeps only the velocity integrators between steps."""

    __slots__ = ('_body', '_c', '_drag1', '_drag2', '_integral_x', '_integral_y', '_integral_z',
                 '_jx', '_jy', '_jz', '_mass', '_max_n', '_min_n', '_roll_share',
                 '_yaw_share')  # fmt: skip

    def __init__(self, body: Multirotor, parameters: ControlParameters) -> None:
        self._body = body
        self._c = parameters
        b = body.parameters
        self._mass = b.mass_kg
        self._drag1 = b.drag_linear_nspm
        self._drag2 = b.drag_quadratic_ns2pm2
        self._jx, self._jy, self._jz = (
            b.inertia_roll_kgm2,
            b.inertia_pitch_kgm2,
            b.inertia_yaw_kgm2,
        )
        self._max_n = b.motor_max_thrust_n
        self._min_n = parameters.thrust_min_fraction * b.motor_max_thrust_n
        self._roll_share = 0.25 / b.motor_offset_m
        self._yaw_share = 0.25 / b.yaw_moment_m
        self.reset()

    def reset(self) -> None:
        """Forget the integrators."""
        self._integral_x = self._integral_y = self._integral_z = 0.0

    def update(self, h: float, s: SetPoint) -> Motors:
        """Return the thrust of the four motors in N for the next step of `h` seconds."""
        c = self._c
        body = self._body

        # Position to velocity.
        vx, vy, vz = s.vx, s.vy, s.vz
        if s.follow_xy:
            ex, ey = s.x - body.x, s.y - body.y
            distance = sqrt(ex * ex + ey * ey)
            if distance > 0.0:
                k = braking_speed(distance, c.position_gain_hz, c.braking_mps2) / distance
                vx += k * ex
                vy += k * ey
        if s.follow_z:
            ez = s.z - body.z
            if ez >= 0.0:
                vz += braking_speed(ez, c.position_gain_hz, c.vertical_braking_mps2)
            else:
                vz -= braking_speed(-ez, c.position_gain_hz, c.vertical_braking_mps2)
        speed = sqrt(vx * vx + vy * vy)
        if speed > s.speed_limit:
            k = s.speed_limit / speed
            vx *= k
            vy *= k
            speed = s.speed_limit
        if vz > s.climb_limit:
            vz = s.climb_limit
        elif vz < -s.descent_limit:
            vz = -s.descent_limit

        # Velocity to acceleration, with the drag of the wanted velocity in calm air fed forward.
        evx, evy, evz = vx - body.vx, vy - body.vy, vz - body.vz
        gain = c.velocity_gain_hz
        ax = gain * evx + self._integral_x + s.ax
        ay = gain * evy + self._integral_y + s.ay
        az = gain * evz + self._integral_z + s.az
        limit = c.horizontal_acceleration_limit_mps2
        size = sqrt(ax * ax + ay * ay)
        saturated = size > limit
        if saturated:
            k = limit / size
            ax *= k
            ay *= k
        limit = c.vertical_acceleration_limit_mps2
        saturated_z = not -limit <= az <= limit
        if saturated_z:
            az = limit if az > 0.0 else -limit
        mass = self._mass
        drag = self._drag1 + self._drag2 * sqrt(speed * speed + vz * vz)
        fx = mass * ax + drag * vx
        fy = mass * ay + drag * vy
        fz = mass * (az + GRAVITY_MPS2) + drag * vz
        sideways = sqrt(fx * fx + fy * fy)
        limit = c.tan_tilt_limit * fz
        if sideways > limit:
            saturated = True
            k = limit / sideways
            fx *= k
            fy *= k

        # Integrators stand still while the demand is cut and would grow further.
        step = h * c.velocity_integral_hz2
        limit = c.integral_limit_mps2
        if not saturated or ax * evx + ay * evy < 0.0:
            total = self._integral_x + step * evx
            self._integral_x = clip(total, limit) if not -limit <= total <= limit else total
            total = self._integral_y + step * evy
            self._integral_y = clip(total, limit) if not -limit <= total <= limit else total
        if not saturated_z or az * evz < 0.0:
            total = self._integral_z + step * evz
            self._integral_z = clip(total, limit) if not -limit <= total <= limit else total
        return self._attitude(fx, fy, fz, s.cos_yaw, s.sin_yaw)

    def _attitude(self, fx: float, fy: float, fz: float, cos_yaw: float, sin_yaw: float) -> Motors:
        """Turn the wanted force (ENU, N) and yaw into motor thrusts."""
        c = self._c
        body = self._body
        w, x, y, z = body.qw, body.qx, body.qy, body.qz
        # Columns of the rotation matrix: the body axes in the map frame.
        xx, xy, xz = 1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)
        yx, yy, yz = 2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)
        zx, zy, zz = 2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)
        thrust = fx * zx + fy * zy + fz * zz
        inverse = 1.0 / sqrt(fx * fx + fy * fy + fz * fz + 1e-12)
        # The wanted thrust direction seen from the body: its cross product with body z.
        rate_x = -c.attitude_gain_hz * (fx * yx + fy * yy + fz * yz) * inverse
        rate_y = c.attitude_gain_hz * (fx * xx + fy * xy + fz * xz) * inverse
        limit = c.tilt_rate_limit_radps
        if not -limit <= rate_x <= limit:
            rate_x = clip(rate_x, limit)
        if not -limit <= rate_y <= limit:
            rate_y = clip(rate_y, limit)
        # Heading error as twice the sine of its half: monotonic up to half a turn.
        flat = 1.0 / sqrt(xx * xx + xy * xy + 1e-12)
        cross = (xx * sin_yaw - xy * cos_yaw) * flat
        dot = (xx * cos_yaw + xy * sin_yaw) * flat
        error = 2.0 if cross >= 0.0 else -2.0
        if dot > -0.999:
            error = cross * sqrt(2.0 / (1.0 + dot))
        limit = c.yaw_rate_limit_radps
        rate_z = c.yaw_gain_hz * error * zz
        if not -limit <= rate_z <= limit:
            rate_z = clip(rate_z, limit)

        # Rates to torques, gyroscopic moment compensated.
        p, q, r = body.p, body.q, body.r
        jx, jy, jz = self._jx, self._jy, self._jz
        torque_x = jx * c.rate_gain_hz * (rate_x - p) + (jz - jy) * q * r
        torque_y = jy * c.rate_gain_hz * (rate_y - q) + (jx - jz) * r * p
        torque_z = jz * c.yaw_rate_gain_hz * (rate_z - r) + (jy - jx) * p * q
        return self._mix(thrust, torque_x, torque_y, torque_z)

    def _mix(self, thrust: float, torque_x: float, torque_y: float, torque_z: float) -> Motors:
        """Share thrust and torques among the motors; roll and pitch win over height and yaw."""
        low, high = self._min_n, self._max_n
        roll = self._roll_share * torque_x
        pitch = self._roll_share * torque_y
        # The motors get base -+ (roll + pitch) and base +- (roll - pitch).
        both, difference = roll + pitch, roll - pitch
        reach = both if both >= 0.0 else -both
        if difference > reach:
            reach = difference
        elif -difference > reach:
            reach = -difference
        base = 0.25 * thrust
        if base < low + reach:
            base = low + reach
        if base > high - reach:
            base = high - reach
        # Yaw gets what is left between the busiest motor and its limits.
        room = base - reach - low
        if high - reach - base < room:
            room = high - reach - base
        yaw = self._yaw_share * torque_z
        if not -room <= yaw <= room:
            yaw = clip(yaw, room)
        f0, f1 = base - both - yaw, base + both - yaw
        f2, f3 = base + difference + yaw, base - difference + yaw
        if room < 0.0:
            # Roll and pitch alone ask for more than the motors have.
            return (
                min(max(f0, low), high),
                min(max(f1, low), high),
                min(max(f2, low), high),
                min(max(f3, low), high),
            )
        return f0, f1, f2, f3


def fly(
    controller: Controller,
    body: Multirotor,
    set_point: SetPoint,
    wind: tuple[float, float, float],
    h: float,
    steps: int,
) -> int:
    """Fly physics steps in steady wind; the one that ends on the ground is the last.

    Args:
        controller: Of the body.
        body: What flies.
        set_point: What is followed meanwhile.
        wind: ENU, m/s.
        h: Step in s.
        steps: How many at most, one or more.

    Returns:
        How many were flown.
    """
    for flown in range(1, steps + 1):
        body.step(h, controller.update(h, set_point), *wind)
        if body.on_ground:
            return flown
    return steps
