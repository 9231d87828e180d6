# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Rigid-body dynamics of a quadrotor with motor lag, drag, wind and flat ground.

Plain Python scalars: for one vehicle they are 14 times faster than numpy. Only + - * / and sqrt,
so the same inputs give the same bits on every machine.

Motors, X layout, seen from above: 0 front right, 1 rear left (both turn counter-clockwise),
2 front left, 3 rear right (both clockwise). Source: PX4 airframe reference, Quadrotor x.
"""

from __future__ import annotations

from math import sqrt

from aurora_uav_sim.parameters import GRAVITY_MPS2, MultirotorParameters

# Share of the tilt that remains after one step on the legs.
_LEVELLING = 0.8


class Multirotor:
    """State and one step of the vehicle; ENU metres around its own local origin, body FLU.

    Attributes:
        x: Position east of the local origin, m (y north, z above ground, of the centre; the legs
            touch at z = 0).
        vx: Velocity east, m/s (vy north, vz up).
        qw: Attitude quaternion, body FLU to ENU (qw, qx, qy, qz).
        p: Body rates about forward, left and up, rad/s (p, q, r).
        f0: Thrust of motor 0, N (f0 to f3).
        on_ground: The legs carry the vehicle.
    """

    __slots__ = (
        '_drag1', '_drag2', '_friction', '_inverse_jx', '_inverse_jy', '_inverse_jz',
        '_inverse_mass', '_jx', '_jy', '_jz', '_lag', '_moment', '_offset',
        'f0', 'f1', 'f2', 'f3', 'on_ground', 'p', 'parameters', 'q', 'qw', 'qx', 'qy', 'qz', 'r',
        'vx', 'vy', 'vz', 'x', 'y', 'z',
    )  # fmt: skip

    def __init__(self, parameters: MultirotorParameters) -> None:
        self.parameters = parameters
        self._inverse_mass = 1.0 / parameters.mass_kg
        self._jx = parameters.inertia_roll_kgm2
        self._jy = parameters.inertia_pitch_kgm2
        self._jz = parameters.inertia_yaw_kgm2
        self._inverse_jx = 1.0 / self._jx
        self._inverse_jy = 1.0 / self._jy
        self._inverse_jz = 1.0 / self._jz
        self._lag = parameters.motor_lag_s
        self._offset = parameters.motor_offset_m
        self._moment = parameters.yaw_moment_m
        self._drag1 = parameters.drag_linear_nspm
        self._drag2 = parameters.drag_quadratic_ns2pm2
        self._friction = parameters.ground_friction
        self.reset()

    def reset(self, half_yaw_sine: float = 0.0, half_yaw_cosine: float = 1.0) -> None:
        """Stand at the local origin with the motors off.

        Args:
            half_yaw_sine: Sine of half the ENU yaw.
            half_yaw_cosine: Cosine of half the ENU yaw.
        """
        self.x = self.y = self.z = 0.0
        self.vx = self.vy = self.vz = 0.0
        self.qw, self.qx, self.qy, self.qz = half_yaw_cosine, 0.0, 0.0, half_yaw_sine
        self.p = self.q = self.r = 0.0
        self.f0 = self.f1 = self.f2 = self.f3 = 0.0
        self.on_ground = True

    def step(
        self,
        h: float,
        motors_n: tuple[float, float, float, float],
        wind_x: float,
        wind_y: float,
        wind_z: float,
    ) -> None:
        """Advance by `h` seconds.

        Motors: implicit Euler (stable for every h). Rotation: explicit midpoint for the rates,
        second-order quaternion step with the midpoint rate. Translation: mean of old and new
        velocity, exact for constant acceleration.

        Args:
            h: Step in s.
            motors_n: Commanded thrust of motors 0 to 3, N.
            wind_x: Wind towards east, m/s.
            wind_y: Wind towards north, m/s.
            wind_z: Wind upwards, m/s.
        """
        gain = h / (self._lag + h)
        c0, c1, c2, c3 = motors_n
        self.f0 = f0 = self.f0 + (c0 - self.f0) * gain
        self.f1 = f1 = self.f1 + (c1 - self.f1) * gain
        self.f2 = f2 = self.f2 + (c2 - self.f2) * gain
        self.f3 = f3 = self.f3 + (c3 - self.f3) * gain
        thrust = f0 + f1 + f2 + f3
        offset = self._offset
        torque_x = offset * (f1 + f2 - f0 - f3)
        torque_y = offset * (f1 + f3 - f0 - f2)
        torque_z = self._moment * (f2 + f3 - f0 - f1)

        # Rates: w' = J^-1 (torque - w x J w), midpoint.
        jx, jy, jz = self._jx, self._jy, self._jz
        ix, iy, iz = self._inverse_jx, self._inverse_jy, self._inverse_jz
        p, q, r = self.p, self.q, self.r
        half = 0.5 * h
        pm = p + half * ix * (torque_x - (jz - jy) * q * r)
        qm = q + half * iy * (torque_y - (jx - jz) * r * p)
        rm = r + half * iz * (torque_z - (jy - jx) * p * q)
        self.p = p + h * ix * (torque_x - (jz - jy) * qm * rm)
        self.q = q + h * iy * (torque_y - (jx - jz) * rm * pm)
        self.r = r + h * iz * (torque_z - (jy - jx) * pm * qm)

        # Attitude: q (1 - t^2/8) + q * (0, w) h/2, scaled back to length 1.
        w, x, y, z = self.qw, self.qx, self.qy, self.qz
        a, b, c = half * pm, half * qm, half * rm
        k = 1.0 - 0.5 * (a * a + b * b + c * c)
        nw = k * w - a * x - b * y - c * z
        nx = k * x + a * w + c * y - b * z
        ny = k * y + b * w + a * z - c * x
        nz = k * z + c * w + b * x - a * y
        scale = 1.0 / sqrt(nw * nw + nx * nx + ny * ny + nz * nz)
        self.qw = w = nw * scale
        self.qx = x = nx * scale
        self.qy = y = ny * scale
        self.qz = z = nz * scale

        # Forces: thrust along body z, drag against the air, gravity.
        vx, vy, vz = self.vx, self.vy, self.vz
        ux, uy, uz = vx - wind_x, vy - wind_y, vz - wind_z
        drag = self._drag1 + self._drag2 * sqrt(ux * ux + uy * uy + uz * uz)
        inverse_mass = self._inverse_mass
        ax = inverse_mass * (2.0 * (x * z + w * y) * thrust - drag * ux)
        ay = inverse_mass * (2.0 * (y * z - w * x) * thrust - drag * uy)
        az = inverse_mass * ((1.0 - 2.0 * (x * x + y * y)) * thrust - drag * uz) - GRAVITY_MPS2
        if self.on_ground:
            if az <= 0.0:
                self._rest(h, ax, ay, -az)
                return
            self.on_ground = False
        self.vx = nvx = vx + h * ax
        self.vy = nvy = vy + h * ay
        self.vz = nvz = vz + h * az
        self.x += half * (vx + nvx)
        self.y += half * (vy + nvy)
        height = self.z + half * (vz + nvz)
        self.z = height
        if height <= 0.0 and nvz <= 0.0:
            self.z = 0.0
            self.vz = 0.0
            self.on_ground = True

    def _rest(self, h: float, ax: float, ay: float, normal_mps2: float) -> None:
        """Stand or slide on the legs: friction against sliding, tilt dies out, rates are zero."""
        vx = self.vx + h * ax
        vy = self.vy + h * ay
        speed = sqrt(vx * vx + vy * vy)
        grip = h * self._friction * normal_mps2
        keep = 1.0 - grip / speed if speed > grip else 0.0
        self.x += 0.5 * h * (self.vx + vx * keep)
        self.y += 0.5 * h * (self.vy + vy * keep)
        self.vx, self.vy, self.vz = vx * keep, vy * keep, 0.0
        self.z = 0.0
        x, y = self.qx * _LEVELLING, self.qy * _LEVELLING
        w, z = self.qw, self.qz
        scale = 1.0 / sqrt(w * w + x * x + y * y + z * z)
        self.qw, self.qx, self.qy, self.qz = w * scale, x * scale, y * scale, z * scale
        self.p = self.q = self.r = 0.0
