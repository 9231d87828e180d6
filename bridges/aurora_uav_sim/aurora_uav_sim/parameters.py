# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the simulated vehicle is made of and how its controller is tuned.

The vehicle is a 1.5 kg quadrotor in X layout of the size of the 3DR Iris, with body drag low
enough to exceed every contract limit by 15 % or more (20.7 m/s, +5.75 m/s, -3.45 m/s, 138 m). Its
numbers are in `config/multirotor.json`; `aurora map measure` measures what it does with them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_path

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

    mass_kg: float
    inertia_roll_kgm2: float
    inertia_pitch_kgm2: float
    inertia_yaw_kgm2: float
    motor_offset_m: float
    motor_max_thrust_n: float
    motor_lag_s: float
    yaw_moment_m: float
    drag_linear_nspm: float
    drag_quadratic_ns2pm2: float
    ground_friction: float


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

    position_gain_hz: float
    velocity_gain_hz: float
    velocity_integral_hz2: float
    integral_limit_mps2: float
    attitude_gain_hz: float
    yaw_gain_hz: float
    rate_gain_hz: float
    yaw_rate_gain_hz: float
    tilt_rate_limit_radps: float
    yaw_rate_limit_radps: float
    tan_tilt_limit: float
    horizontal_speed_limit_mps: float
    climb_limit_mps: float
    descent_limit_mps: float
    horizontal_acceleration_limit_mps2: float
    vertical_acceleration_limit_mps2: float
    braking_mps2: float
    vertical_braking_mps2: float
    thrust_min_fraction: float


@dataclass(frozen=True, slots=True, kw_only=True)
class EnergyParameters:
    """What a flight takes from the battery (`battery.flight_power_w`).

    Attributes:
        battery_wh: Energy of the full battery; ours, so that the endurance of a hover exceeds the
            contract limit like every other figure.
        usable_share: Share of it that is flown.
        rotor_radius_m: Of each of the four rotors (the 10-inch propellers of the 3DR Iris).
        efficiency: Ideal power of a hover over electrical power, rotor and motor together.
    """

    battery_wh: float
    usable_share: float
    rotor_radius_m: float
    efficiency: float


@dataclass(frozen=True, slots=True, kw_only=True)
class MultirotorModel:
    """A vehicle: its body, how its controller is tuned, what its flight takes."""

    body: MultirotorParameters
    control: ControlParameters
    energy: EnergyParameters


MODEL_FILE = 'multirotor.json'
_Part = TypeVar('_Part', MultirotorParameters, ControlParameters, EnergyParameters)


def installed_model() -> MultirotorModel:
    """Return the vehicle of the configuration folder; the file is read once as long as it stays.

    Raises:
        ConfigError: The file is missing, or lacks a number, or has one that is not above 0.
    """
    path = config_path(MODEL_FILE)
    return _model(path, path.stat().st_mtime_ns)


@lru_cache(maxsize=4)
def _model(path: Path, _changed_ns: int) -> MultirotorModel:
    try:
        table = read_json(path, CONFIG_BYTES)
        return MultirotorModel(
            body=_part(MultirotorParameters, table['body']),
            control=_part(ControlParameters, table['control']),
            energy=_part(EnergyParameters, table['energy']),
        )
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except (ValueError, LookupError, TypeError) as err:
        raise ConfigError(
            f'{path} is not valid: {err}', hint='compare with the shipped file'
        ) from err


def _part(kind: type[_Part], row: Mapping[str, Any]) -> _Part:
    names = {field.name for field in fields(kind)}
    if set(row) != names:
        raise ValueError(f'expected {", ".join(sorted(names))}, found {", ".join(sorted(row))}')
    values = {name: float(row[name]) for name in row}
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0.0):
            raise ValueError(f'{name} = {value} has to be above 0')
    return kind(**values)
