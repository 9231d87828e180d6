# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Limits, tolerances and conditions' defaults: configuration that every verdict names."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated, Self, TypeVar

from pydantic import BaseModel, ConfigDict, Field, model_validator

from aurora_core.document import first_problem, omitted
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, UavMission
from aurora_core.spec.scene import World
from aurora_core.spec.vocabulary import Pattern, TimeOfDay, Weather

# A limit or tolerance of zero would forbid everything; a share lies in (0, 1].
Positive = Annotated[float, Field(gt=0.0)]
NotNegative = Annotated[float, Field(ge=0.0)]
Share = Annotated[float, Field(gt=0.0, le=1.0)]
Range = tuple[NotNegative, NotNegative]

# Share of the greatest climb rate that a climb has on average, with its beginning and its end.
_CLIMB_SHARE = 0.6
# Ascents to 30, 40 and 50 m were flown at this share of it.
_ASCENT_SHARE = 0.8
# A UAV is at its altitude so much later than its climb at a steady rate takes (s).
LEVELS_OFF_S = 1.0


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)


class Limits(_Table):
    """Limits of the simulated world; a value equal to a limit is inside it."""

    uav_altitude_min_m: NotNegative
    uav_altitude_max_m: Positive
    uav_speed_max_mps: Positive
    uav_climb_max_mps: Positive
    uav_descent_max_mps: Positive
    uav_endurance_s: Positive
    uav_standoff_max_m: NotNegative
    clearance_min_m: NotNegative
    separation_min_m: NotNegative
    sensing_range_m: dict[str, Positive]  # by weather
    sensing_factor: dict[str, Positive]  # by time of day
    tracking_horizontal_m: Positive
    tracking_altitude_m: Positive
    link_range_sight_m: Positive
    link_range_blocked_m: NotNegative
    # towards its range a link that states neither range nor loss loses more: ten times as much
    # with so much less received; 0: nothing is lost inside, as before 2026-11-29
    link_decade_db: NotNegative = omitted(0.0)
    vehicle_speed_max_mps: Positive
    pedestrian_speed_max_mps: Positive
    duration_min_s: NotNegative
    duration_max_s: Positive
    horizon_inferred_min_s: NotNegative
    wind_mean_mps: dict[str, NotNegative]  # by weather
    wind_gust_mps: dict[str, NotNegative]  # by weather
    wind_max_mps: NotNegative = omitted(15.0)  # mean of a wind that a request names
    gust_max_mps: NotNegative = omitted(20.0)  # the same at the height of a gust
    # drag of the multirotor over its mass: for each m/s through the air, and for its square
    uav_drag_hz: NotNegative = omitted(0.1)
    uav_drag_per_m: NotNegative = omitted(0.008)
    uavs_max: Annotated[int, Field(ge=0)]
    agents_max: Annotated[int, Field(ge=0)]

    @model_validator(mode='after')
    def _complete(self) -> Self:
        for name in ('sensing_range_m', 'wind_mean_mps', 'wind_gust_mps', 'sensing_factor'):
            table = getattr(self, name)
            wanted = tuple(TimeOfDay if name == 'sensing_factor' else Weather)
            lacking = [w.value for w in wanted if w.value not in table]
            if lacking:
                raise ValueError(f'{name} lacks {", ".join(lacking)}')
        for low, high in (
            ('uav_altitude_min_m', 'uav_altitude_max_m'),
            ('duration_min_s', 'duration_max_s'),
        ):
            if getattr(self, low) > getattr(self, high):
                raise ValueError(f'{low} is above {high}')
        return self

    def sensing_range(self, weather: str, time_of_day: str) -> float:
        """Return the camera's sensing range in metres for weather and time of day."""
        return self.sensing_range_m[weather] * self.sensing_factor[time_of_day]

    def canonical_json(self) -> str:
        """Return the byte-exact JSON text that travels in the bag."""
        return json.dumps(self.model_dump(mode='json'), sort_keys=True, separators=(',', ':'))


class Tolerance(_Table):
    """The larger of an absolute and a relative tolerance."""

    absolute: NotNegative
    relative: NotNegative

    def of(self, value: float, *, approximate: bool = False) -> float:
        """Return the tolerance of `value` in its own unit ("about" widens to 10 %)."""
        relative = max(self.relative, 0.10) if approximate else self.relative
        return max(self.absolute, relative * abs(value))


EXACT = Tolerance(absolute=0.0, relative=0.0)


class Tolerances(_Table):
    """Tolerances of explicit numbers and thresholds of implied conditions."""

    placement_vehicle_m: Tolerance
    placement_other_m: Tolerance
    altitude_m: Tolerance
    altitude_share: Share
    standoff_m: Tolerance
    route_speed_mps: Tolerance
    walking_speed_mps: Tolerance = omitted(Tolerance(absolute=1.0, relative=0.1))
    route_speed_share: Share
    waypoint_horizontal_m: NotNegative
    duration_s: Tolerance
    bearing_deg: NotNegative
    pattern_centre_m: NotNegative
    orbit_deg: NotNegative  # on the turns of an orbit
    # a stated speed shows on a free road for so long; nothing was asked before 2026-11-28
    free_road_s: NotNegative = omitted(0.0)
    yield_m: NotNegative = omitted(45.0)  # farther apart nobody lets anybody pass
    side_deg: NotNegative = omitted(45.0)  # how far off its direction a side reaches
    return_m: NotNegative = omitted(3.0)  # how far from its start who returns may land
    outage_s: NotNegative = omitted(0.5)  # on both ends of an outage
    rate_share: Share = omitted(0.10)  # on the time between two reports
    # who is to slow down or stop was so fast right before, in a vehicle or on foot
    acts_from_mps: NotNegative = omitted(2.0)
    acts_from_on_foot_mps: NotNegative = omitted(0.5)
    acts_before_s: NotNegative = omitted(2.0)
    # how far off the wind that a flight shows may be: so much, and such a share of the gusts
    wind_blown_mps: NotNegative = omitted(0.5)
    wind_blown_gust_share: NotNegative = omitted(0.5)
    gust_blown_share: Share = omitted(0.4)  # of a gust that a flight shows at the least
    capture_s: NotNegative
    tracked_fraction: Share
    visible_fraction: Share
    hover_drift_calm_m: NotNegative
    hover_drift_wind_m: NotNegative
    event_delay_s: NotNegative
    delivery_s: NotNegative
    latency_steps: Annotated[int, Field(ge=0)]
    relation_fraction: Share
    follow_gap_moving_m: Range
    follow_gap_slow_m: Range
    follow_slow_mps: NotNegative
    follow_fraction: Share
    follow_after_s: NotNegative
    tailgate_time_gap_s: NotNegative
    tailgate_speed_mps: NotNegative
    tailgate_hold_s: NotNegative
    stop_speed_mps: NotNegative
    stop_hold_s: NotNegative
    brake_mps2: NotNegative
    slow_by_mps: NotNegative  # by how much an agent that slows down gets slower
    turn_deg: NotNegative  # change of heading that is a turn
    turn_within_s: NotNegative  # time that a turn may take: what takes longer is a bend
    crossing_m: NotNegative  # a carriageway that is crossed is at least so wide
    circulate_distance_m: NotNegative
    lane_hold_s: NotNegative  # how long a lane that was changed to is kept
    over_limit_mps: NotNegative  # by how much an emergency run exceeds the speed limit
    roadside_m: NotNegative  # how far from the edge of the carriageway the roadside reaches
    phase_change_s: NotNegative
    limit_margin: NotNegative
    jump_speed_mps: NotNegative
    touchdown_height_m: NotNegative  # a UAV that reports landed and is not higher is down
    over_carriageway_share: Share  # share of a leg's samples over a carriageway
    route_offset_m: NotNegative  # a body farther from a route is not on it
    route_acceleration_mps2: NotNegative  # acceleration and braking distances of route legs
    drive_distance_m: NotNegative  # way after which an agent counts as having driven
    approach_m: NotNegative  # by how much an approach shortens the distance
    traffic_radius_m: NotNegative  # around the anchor of a scene; vehicles in it are its traffic
    traffic_per_km: dict[str, NotNegative]  # vehicles per kilometre of street, by density
    traffic_least: NotNegative  # vehicles
    traffic_share: Range  # of these, on average over the run
    arrival_m: NotNegative  # an agent this close to a place is there
    # a person this close to the outline of a crosswalk has reached it; before: as any other place
    crosswalk_m: NotNegative | None = omitted(None)
    near_m: NotNegative  # "near" without a distance
    lane_offset_m: NotNegative  # offset inside one lane
    free_road_m: NotNegative  # with no leader or junction so near a driver keeps its speed
    moving_speed_mps: NotNegative  # an agent this fast has moved
    onset_mps2: NotNegative  # change of speed with which slowing down or speeding up begins
    action_speed_mps: Tolerance  # on the speed that an action is to end with
    # on a stated vertical speed
    vertical_mps: Tolerance = omitted(Tolerance(absolute=0.3, relative=0.1))
    headway_s: Tolerance = omitted(Tolerance(absolute=0.3, relative=0.15))  # on a stated headway
    # on a stated deceleration
    deceleration_mps2: Tolerance = omitted(Tolerance(absolute=0.3, relative=0.1))
    action_done_s: NotNegative  # how much later than physics allows an action may be complete
    slow_share: Share  # share of its speed to which an agent slows down when no speed is stated
    speed_gain_mps: NotNegative  # by how much an agent speeds up when no speed is stated
    start_speed_mps: NotNegative  # an agent this fast has set off
    phase_follow_m: NotNegative  # how close a UAV keeps to its set-point when a phase has changed
    link_statistics_from: Annotated[
        int, Field(ge=0)
    ]  # attempts before a link's losses are compared with its model


_T = TypeVar('_T', bound=_Table)


def hover_drift_limit_m(world: World, limits: Limits, tolerances: Tolerances) -> float:
    """Return the drift allowed while hovering in a world: more in wind, its own or a named one."""
    windy = _is_windy(world, limits)
    return tolerances.hover_drift_wind_m if windy else tolerances.hover_drift_calm_m


def rest_mps(world: World, limits: Limits, tolerances: Tolerances) -> float:
    """Return the speed over ground below which a UAV is at rest, m/s: gusts move one that is."""
    windy = _is_windy(world, limits)
    return tolerances.start_speed_mps if windy else tolerances.stop_speed_mps


def _is_windy(world: World, limits: Limits) -> bool:
    weather = world.weather.value
    mean_mps = limits.wind_mean_mps[weather]
    if world.wind_mps is not None:
        mean_mps = world.wind_mps.value
    gust_mps = limits.wind_gust_mps[weather]
    if world.gust_mps is not None:
        gust_mps = world.gust_mps.value
    return mean_mps > 0.0 or gust_mps > 0.0


def climb_share_mps(limits: Limits) -> float:
    """Return the rate that a climb has on average where the vehicle climbs at the limit."""
    return _CLIMB_SHARE * limits.uav_climb_max_mps


def ascent_s(height_m: float, limits: Limits) -> float:
    """Return how long an ascent takes where nothing holds it up, about (s)."""
    return LEVELS_OFF_S + height_m / (_ASCENT_SHARE * limits.uav_climb_max_mps)


def descent_share_mps(limits: Limits) -> float:
    """Return the rate that a descent has on average where the vehicle sinks at the limit."""
    return _CLIMB_SHARE * limits.uav_descent_max_mps


def hover_capture_m(spec: ScenarioSpec, uav: str, limits: Limits, tolerances: Tolerances) -> float:
    """Return how near a UAV has to come to its hover point before its hover begins, metres.

    It is the drift allowed in the weather, or a stated one that is less: who is to stay within
    1.5 m does not begin 2 m away.
    """
    stated = (
        c.value.value
        for c in spec.conditions
        if c.quantity == QuantityName.HOVER_DRIFT and uav in c.of and c.op in ('<', '<=')
    )
    return min((hover_drift_limit_m(spec.world, limits, tolerances), *stated))


def pattern_off_m(mission: UavMission, tolerances: Tolerances) -> float:
    """Return how far from its target the middle of a pattern may be, metres.

    Who goes round something keeps its radius from that, not from a point beside it.
    """
    radius = mission.radius_m
    if mission.pattern is not Pattern.ORBIT or radius is None:
        return tolerances.pattern_centre_m
    off_m = tolerances.standoff_m.of(radius.value, approximate=radius.approximate)
    return min(tolerances.pattern_centre_m, off_m)


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
        return kind.model_validate(read_json(path, CONFIG_BYTES))
    except OSError as err:
        raise ConfigError(f'{path.name} cannot be read: {err}', hint='run make setup') from err
    except ValueError as err:  # not UTF-8, not JSON, or out of the schema
        raise ConfigError(
            f'{path} is not valid: {first_problem(err)}', hint='compare with the shipped file'
        ) from err
