# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`UavRecord`: what the multirotor does, as it was measured by flying it."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Self

from pydantic import ValidationError, model_validator

from aurora_core.document import Document, first_problem
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_path, config_root
from aurora_core.knowledge.limits import Limits, NotNegative, Positive, load_limits
from aurora_core.knowledge.measured_on import (
    check_made_of,
    measure_command,
    uav_basis,
    weather_winds,
)
from aurora_core.knowledge.settings import FlightDefaults, Settings, load_settings

RECORDS = ('knowledge', 'measured', 'multirotor.json')

# A limit leaves the vehicle this much to control itself with, as those of the contract do.
RESERVE = 1.15
# What is planned stays so far below a limit.
_PLANNED_SHARE = 0.92
# Whom it tracks drives so much slower than it is planned to fly: at most, and where nobody says
# how fast (m/s).
_ROOM_MPS = 1.0
_CAUGHT_UP_MPS = 3.0
_STEPS = 10.0  # limits that follow from a measurement are whole tenths


class BrakingRow(Document):
    """A stop from level flight: how far and how long, from the command on."""

    speed_mps: Positive
    distance_m: Positive
    time_s: Positive


class TurnRow(Document):
    """A right-angled corner flown at a speed: how far beyond the corner it gets."""

    speed_mps: Positive
    overshoot_m: NotNegative


class LagRow(Document):
    """A point that moves straight at a speed: how far behind it is followed in the end."""

    speed_mps: Positive
    lag_m: NotNegative


class DriftRow(Document):
    """A hover in wind: the greatest distance from the point that it is to keep."""

    mean_mps: NotNegative
    gust_mps: NotNegative
    drift_m: NotNegative


class EnduranceRow(Document):
    """A flight on one battery, the climb included: a hover, or there and back at a speed."""

    speed_mps: NotNegative
    mean_mps: NotNegative
    gust_mps: NotNegative
    endurance_s: Positive


class LinkRow(Document):
    """Messages over a distance: which share is received, with sight and past a wall?"""

    distance_m: Positive
    with_sight: NotNegative
    without_sight: NotNegative


class UavRecord(Document):
    """What the multirotor does; speeds are those that it keeps, not what is commanded.

    Attributes:
        speed_mps: Level flight, calm air.
        climb_mps: Upwards.
        descent_mps: Downwards, positive.
        acceleration_mps2: Average from a hover to 0.9 of the speed.
        braking_mps2: Average from the speed to a hover.
        endurances: Flights until the battery is empty but for its reserve.
        braking: Stops.
        turns: Corners.
        lags: Moving points.
        drifts: Hovers in wind.
        reach_sight_m: Greatest distance over which messages are received with sight.
        reach_blocked_m: The same past a wall.
        link: Messages, at the ranges of `limits.json`.
    """

    speed_mps: Positive
    climb_mps: Positive
    descent_mps: Positive
    acceleration_mps2: Positive
    braking_mps2: Positive
    endurances: tuple[EnduranceRow, ...]
    braking: tuple[BrakingRow, ...]
    turns: tuple[TurnRow, ...]
    lags: tuple[LagRow, ...]
    drifts: tuple[DriftRow, ...]
    reach_sight_m: NotNegative
    reach_blocked_m: NotNegative
    link: tuple[LinkRow, ...]

    @model_validator(mode='after')
    def _has_a_hover(self) -> Self:
        if (0.0, 0.0, 0.0) not in {(r.speed_mps, r.mean_mps, r.gust_mps) for r in self.endurances}:
            raise ValueError('endurances lack a hover in calm air')
        return self

    @property
    def hover_s(self) -> float:
        """Endurance of a hover in calm air, seconds."""
        return self.endurance_s(0.0, 0.0, 0.0)

    def endurance_s(self, speed_mps: float, mean_mps: float, gust_mps: float) -> float:
        """Return how long a battery lasts at a speed in a wind, seconds; 0 beyond those measured.

        It is that of the worst of the flights around: a little wind may take less than none.
        """
        speeds = _around(speed_mps, (r.speed_mps for r in self.endurances))
        rows = self.endurances
        stronger = [r for r in rows if r.mean_mps >= mean_mps and r.gust_mps >= gust_mps]
        weaker = [r for r in rows if r.mean_mps <= mean_mps and r.gust_mps <= gust_mps]
        found = [
            row.endurance_s
            for near, nearest in ((stronger, min), (weaker, max))
            for row in near
            if row.speed_mps in speeds
            and (row.mean_mps, row.gust_mps) == nearest((r.mean_mps, r.gust_mps) for r in near)
        ]
        return min(found) if stronger and speeds else 0.0

    def stop_m(self, speed_mps: float) -> float:
        """Return the way of a stop from a speed, metres."""
        return _at_least(((r.speed_mps, r.distance_m) for r in self.braking), speed_mps)

    def start_m(self, speed_mps: float) -> float:
        """Return the way from a hover to a speed, metres."""
        return speed_mps * speed_mps / (2.0 * self.acceleration_mps2)

    def overshoot_m(self, speed_mps: float) -> float:
        """Return how far beyond a corner it gets that is flown at a speed, metres."""
        return _at_least(((r.speed_mps, r.overshoot_m) for r in self.turns), speed_mps)

    def lag_m(self, speed_mps: float) -> float:
        """Return how far behind a point it is that moves at a speed, metres."""
        return _at_least(((r.speed_mps, r.lag_m) for r in self.lags), speed_mps)

    def drift_m(self, mean_mps: float, gust_mps: float) -> float:
        """Return how far from its point it gets in a wind, metres; infinite beyond the winds."""
        met = (r.drift_m for r in self.drifts if r.mean_mps >= mean_mps and r.gust_mps >= gust_mps)
        return min(met, default=math.inf)

    def received_m(self, *, with_sight: bool) -> float:
        """Return the greatest distance over which messages are received, metres."""
        return self.reach_sight_m if with_sight else self.reach_blocked_m


def _around(value: float, known: Iterable[float]) -> frozenset[float]:
    """Return the next smaller and the next greater of the known values; nothing outside them."""
    values = sorted(known)
    if not values or not values[0] <= value <= values[-1]:
        return frozenset()
    return frozenset((max(v for v in values if v <= value), min(v for v in values if v >= value)))


def _at_least(rows: Iterable[tuple[float, float]], speed_mps: float) -> float:
    """Return the figure of the next speed that was measured; beyond the last one, of that one."""
    figures = sorted(rows)
    return next((f for v, f in figures if v >= speed_mps), figures[-1][1] if figures else 0.0)


def load_uav_record() -> UavRecord:
    """Read the record of the multirotor.

    Raises:
        ConfigError: The file is missing, out of its schema, or was measured of another model.
    """
    path = config_root().joinpath(*RECORDS)
    hint = f'measure: {measure_command()}'
    try:
        table = read_json(path, CONFIG_BYTES)
        record = UavRecord.model_validate(table['multirotor'])
        made = dict(table['made_of'])
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint=hint) from err
    except ValidationError as err:
        raise ConfigError(f'{path} is not valid: {first_problem(err)}', hint=hint) from err
    except (ValueError, LookupError, TypeError) as err:
        raise ConfigError(f'{path} is not valid: {err!r}', hint=hint) from err
    limits = load_limits(config_path('limits.json'))
    check_made_of(path, made, uav_basis(load_settings().run.dt_s, limits))
    return record


def possible_limits(limits: Limits, record: UavRecord) -> Limits:
    """Return limits that a vehicle can be asked to keep up to: with a reserve to what it does."""
    most = {
        'uav_speed_max_mps': record.speed_mps,
        'uav_climb_max_mps': record.climb_mps,
        'uav_descent_max_mps': record.descent_mps,
        'uav_endurance_s': record.hover_s,
    }
    found = {
        name: min(getattr(limits, name), max(1.0, math.floor(_STEPS * value / RESERVE)) / _STEPS)
        for name, value in most.items()
    }
    found |= {
        name: min(getattr(limits, name), reach_m)
        for name, reach_m in (
            ('link_range_sight_m', max(record.reach_sight_m, 1.0 / _STEPS)),
            ('link_range_blocked_m', record.reach_blocked_m),
        )
    }
    return Limits.model_validate(limits.model_dump() | found)


def limits_in_force(limits: Limits, record: UavRecord) -> tuple[str, ...]:
    """Return in sentences which limits are lower in force than the configured ones."""
    configured, possible = limits.model_dump(), possible_limits(limits, record).model_dump()
    return tuple(
        f'{name} is {possible[name]:g} in force, not {configured[name]:g}: the multirotor does no '
        'more'
        for name in configured
        if possible[name] != configured[name]
    )


def possible_settings(settings: Settings, limits: Limits, record: UavRecord) -> Settings:
    """Return settings that ask nothing of a vehicle that it was not measured to do.

    Args:
        settings: As configured.
        limits: As configured; the possible ones follow from the record.
        record: Of the vehicle.
    """
    flight = within(settings.flight, limits, record)
    style = settings.grounding
    trackable_mps = max(flight.speed_max_mps - _ROOM_MPS, flight.speed_max_mps / 2.0)
    followed_mps = max(flight.speed_max_mps - _CAUGHT_UP_MPS, flight.speed_max_mps / 2.0)
    grounding = style.model_dump() | {
        'clearance_m': planned_clearance_m(settings, limits, record),
        'target_speed_mps': min(style.target_speed_mps, followed_mps),
        'speeds': style.speeds.model_dump()
        | {'trackable_mps': min(style.speeds.trackable_mps, trackable_mps)},
    }
    return Settings.model_validate(
        settings.model_dump() | {'flight': flight, 'grounding': grounding}
    )


def planned_clearance_m(settings: Settings, limits: Limits, record: UavRecord) -> float:
    """Return what planned ways keep from obstacles: the vehicle leaves them in wind and corners.

    A weather whose wind carries it farther than a tracked target may be missed counts for none:
    there the vehicle is nowhere where it is to be, and the check doubts its hovers.

    Args:
        settings: As configured: the clearance is at least theirs.
        limits: Clearance that has to be kept, and the wind of every weather.
        record: Of the vehicle.
    """
    drifts = (record.drift_m(*wind) for wind in weather_winds(limits).values())
    drift_m = max((d for d in drifts if d <= limits.tracking_horizontal_m), default=0.0)
    aside_m = record.overshoot_m(settings.flight.corner_speed_mps) + drift_m
    needed_m = limits.clearance_min_m + aside_m
    return max(settings.grounding.clearance_m, needed_m)


def within(flight: FlightDefaults, limits: Limits, record: UavRecord) -> FlightDefaults:
    """Return the reference motion, nowhere beyond what the multirotor was measured to do."""
    possible = possible_limits(limits, record)
    return FlightDefaults.model_validate(
        flight.model_dump()
        | {
            'speed_max_mps': min(
                flight.speed_max_mps, _PLANNED_SHARE * possible.uav_speed_max_mps
            ),
            'climb_mps': min(flight.climb_mps, _PLANNED_SHARE * possible.uav_climb_max_mps),
            'descent_mps': min(flight.descent_mps, _PLANNED_SHARE * possible.uav_descent_max_mps),
            'acceleration_mps2': min(flight.acceleration_mps2, record.acceleration_mps2),
        }
    )
