# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the simulated vehicle is made of and how its controller is tuned.

The vehicle is a 1.5 kg quadrotor in X layout of the size of the 3DR Iris, with body drag low
enough to exceed every contract limit by 15 % or more (20.7 m/s, +5.75 m/s, -3.45 m/s, 138 m).
"""

from __future__ import annotations

from dataclasses import dataclass

# Standard gravity. Source: CODATA / ISO 80000-3.
GRAVITY_MPS2 = 9.80665

# Longest physics step. The fastest pole is the motor (20 ms), so 10 ms with an implicit motor
# step is stable, and a 0.05 s tick is five steps.
MAX_SUBSTEP_S = 0.010


@dataclass(frozen=True, slots=True, kw_only=True)
class MultirotorParameters:
    """The rigid body and its motors.

    Attributes:
        mass_kg: Take-off mass.
        inertia_roll_kgm2: About body x. Source for the three: PX4 sitl_gazebo, iris model.
        inertia_pitch_kgm2: About body y.
        inertia_yaw_kgm2: About body z.
        motor_offset_m: Distance of each motor from body x and from body y (X layout).
        motor_max_thrust_n: 5.84e-6 * 1100^2 N. Source: PX4 sitl_gazebo, iris motor model.
        motor_lag_s: First-order time constant of thrust. Source: mean of the rise (12.5 ms) and
            fall (25 ms) constants of the same model.
        yaw_moment_m: Reaction torque over thrust. Source: the same model, moment constant.
        drag_linear_nspm: Rotor and body drag, linear part, N per m/s.
        drag_quadratic_ns2pm2: Quadratic part, N per (m/s)^2; 0.5 * 1.225 kg/m^3 * 0.02 m^2.
        ground_friction: Friction coefficient of the legs on the ground.
    """

    mass_kg: float = 1.5
    inertia_roll_kgm2: float = 0.029125
    inertia_pitch_kgm2: float = 0.029125
    inertia_yaw_kgm2: float = 0.055225
    motor_offset_m: float = 0.18
    motor_max_thrust_n: float = 7.07
    motor_lag_s: float = 0.02
    yaw_moment_m: float = 0.06
    drag_linear_nspm: float = 0.15
    drag_quadratic_ns2pm2: float = 0.012
    ground_friction: float = 0.6


@dataclass(frozen=True, slots=True, kw_only=True)
class ControlParameters:
    """Gains and limits of the cascade: position, velocity, attitude, body rate.

    The gains are ours: each loop is about two and a half times as fast as the one around it (rate
    18, attitude 7, velocity 3.2, position 1.3 rad/s).

    Attributes:
        position_gain_hz: Horizontal and vertical position error to velocity, 1/s.
        velocity_gain_hz: Velocity error to acceleration, 1/s.
        velocity_integral_hz2: Integral of velocity error to acceleration, 1/s^2.
        integral_limit_mps2: Largest acceleration that an integrator may hold.
        attitude_gain_hz: Tilt error to roll and pitch rate, 1/s.
        yaw_gain_hz: Yaw error to yaw rate, 1/s.
        rate_gain_hz: Roll and pitch rate error to angular acceleration, 1/s.
        yaw_rate_gain_hz: Yaw rate error to angular acceleration, 1/s.
        tilt_rate_limit_radps: Largest commanded roll or pitch rate.
        yaw_rate_limit_radps: Largest commanded yaw rate.
        tan_tilt_limit: Tangent of the largest commanded tilt (1 = 45 degrees, PX4's default).
        horizontal_speed_limit_mps: Largest commanded horizontal speed.
        climb_limit_mps: Largest commanded climb rate.
        descent_limit_mps: Largest commanded descent rate.
        horizontal_acceleration_limit_mps2: Largest commanded horizontal acceleration.
        vertical_acceleration_limit_mps2: Largest commanded vertical acceleration.
        braking_mps2: Deceleration that the position loop plans with, horizontal.
        vertical_braking_mps2: The same, vertical.
        thrust_min_fraction: Idle thrust of a motor while armed, share of its maximum.
    """

    position_gain_hz: float = 1.3
    velocity_gain_hz: float = 3.2
    velocity_integral_hz2: float = 0.8
    integral_limit_mps2: float = 4.0
    attitude_gain_hz: float = 7.0
    yaw_gain_hz: float = 2.5
    rate_gain_hz: float = 18.0
    yaw_rate_gain_hz: float = 6.0
    tilt_rate_limit_radps: float = 4.0
    yaw_rate_limit_radps: float = 1.6
    tan_tilt_limit: float = 1.0
    horizontal_speed_limit_mps: float = 21.5
    climb_limit_mps: float = 6.0
    descent_limit_mps: float = 3.6
    horizontal_acceleration_limit_mps2: float = 8.0
    vertical_acceleration_limit_mps2: float = 5.0
    braking_mps2: float = 4.0
    vertical_braking_mps2: float = 3.0
    thrust_min_fraction: float = 0.03
