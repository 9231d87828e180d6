# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Limits, tolerances and conditions' defaults: configuration that every verdict names."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ConfigDict, ValidationError

from aurora_core.errors import ConfigError


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)


class Limits(_Table):
    """Limits of the simulated world; a value equal to a limit is inside it."""

    uav_altitude_min_m: float
    uav_altitude_max_m: float
    uav_speed_max_mps: float
    uav_climb_max_mps: float
    uav_descent_max_mps: float
    uav_endurance_s: float
    uav_standoff_max_m: float
    clearance_min_m: float
    separation_min_m: float
    sensing_range_m: dict[str, float]  # by weather
    sensing_factor: dict[str, float]  # by time of day
    tracking_horizontal_m: float
    tracking_altitude_m: float
    link_range_sight_m: float
    link_range_blocked_m: float
    vehicle_speed_max_mps: float
    pedestrian_speed_max_mps: float
    duration_min_s: float
    duration_max_s: float
    horizon_inferred_min_s: float
    wind_mean_mps: dict[str, float]  # by weather
    wind_gust_mps: dict[str, float]  # by weather
    uavs_max: int
    agents_max: int

    def sensing_range(self, weather: str, time_of_day: str) -> float:
        """Return the camera's sensing range in metres for weather and time of day."""
        return self.sensing_range_m[weather] * self.sensing_factor[time_of_day]

    def canonical_json(self) -> str:
        """Return the byte-exact JSON text that travels in the bag."""
        return json.dumps(self.model_dump(mode='json'), sort_keys=True, separators=(',', ':'))


class Tolerance(_Table):
    """The larger of an absolute and a relative tolerance."""

    absolute: float
    relative: float

    def of(self, value: float, *, approximate: bool = False) -> float:
        """Return the tolerance of `value` in its own unit ("about" widens to 10 %)."""
        relative = max(self.relative, 0.10) if approximate else self.relative
        return max(self.absolute, relative * abs(value))


class Tolerances(_Table):
    """Tolerances of explicit numbers and thresholds of implied conditions."""

    placement_vehicle_m: Tolerance
    placement_other_m: Tolerance
    altitude_m: Tolerance
    altitude_share: float
    standoff_m: Tolerance
    route_speed_mps: Tolerance
    route_speed_share: float
    waypoint_horizontal_m: float
    duration_s: Tolerance
    bearing_deg: float
    pattern_centre_m: float
    capture_s: float
    tracked_fraction: float
    visible_fraction: float
    hover_drift_calm_m: float
    hover_drift_wind_m: float
    event_delay_s: float
    delivery_s: float
    latency_steps: int
    relation_fraction: float
    follow_gap_moving_m: tuple[float, float]
    follow_gap_slow_m: tuple[float, float]
    follow_slow_mps: float
    follow_fraction: float
    follow_after_s: float
    tailgate_time_gap_s: float
    tailgate_speed_mps: float
    tailgate_hold_s: float
    stop_speed_mps: float
    stop_hold_s: float
    brake_mps2: float
    circulate_distance_m: float
    phase_change_s: float
    limit_margin: float
    jump_speed_mps: float
    touchdown_height_m: float  # a UAV that reports landed and is not higher is down
    over_carriageway_share: float  # share of a leg's samples over a carriageway
    route_offset_m: float  # a body farther from a route is not on it
    route_acceleration_mps2: float  # acceleration and braking distances of route legs
    drive_distance_m: float  # way after which an agent counts as having driven
    approach_m: float  # by how much an approach shortens the distance
    near_m: float  # "near" without a distance
    lane_offset_m: float  # offset inside one lane
    moving_speed_mps: float  # an agent this fast has moved
    onset_mps2: float  # change of speed with which slowing down or speeding up begins
    phase_follow_m: float  # how close a UAV keeps to its set-point when a phase has changed
    link_statistics_from: int  # attempts before a link's losses are compared with its model


_T = TypeVar('_T', bound=_Table)


def load_limits(path: Path) -> Limits:
    """Read `limits.json`.

    Raises:
        ConfigError: The file is missing or out of its schema.
    """
    return _load(path, Limits)


def load_tolerances(path: Path) -> Tolerances:
    """Read `tolerances.json`.

    Raises:
        ConfigError: The file is missing or out of its schema.
    """
    return _load(path, Tolerances)


def _load(path: Path, kind: type[_T]) -> _T:
    try:
        return kind.model_validate(json.loads(path.read_text(encoding='utf-8')))
    except OSError as err:
        raise ConfigError(f'{path.name} cannot be read: {err}', hint='run make setup') from err
    except (json.JSONDecodeError, ValidationError) as err:
        raise ConfigError(
            f'{path} is not valid: {err}', hint='compare with the shipped file'
        ) from err
