# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`UavRecord`: what the multirotor does, as it was measured by flying it."""

from __future__ import annotations

from pydantic import ValidationError

from aurora_core.document import Document
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_root
from aurora_core.knowledge.limits import NotNegative, Positive
from aurora_core.knowledge.measured_on import check_made_of, measure_command, uav_basis
from aurora_core.knowledge.settings import FlightDefaults, load_settings

RECORDS = ('knowledge', 'measured', 'multirotor.json')


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
    """A point that moves straight at a speed: how far behind it is followed."""

    speed_mps: Positive
    lag_m: NotNegative


class DriftRow(Document):
    """A hover in wind: the greatest distance from the point that it is to keep."""

    mean_mps: NotNegative
    gust_mps: NotNegative
    drift_m: NotNegative


class LinkRow(Document):
    """A message over a distance: is it received, with sight and without?"""

    distance_m: Positive
    with_sight: bool
    without_sight: bool


class UavRecord(Document):
    """What the multirotor does; speeds are those that it keeps, not what is commanded.

    Attributes:
        speed_mps: Level flight, calm air.
        climb_mps: Upwards.
        descent_mps: Downwards, positive.
        acceleration_mps2: Average from a hover to 0.9 of the speed.
        braking_mps2: Average from the speed to a hover.
        power_w: Mean mechanical power of a hover, by momentum theory (see `endurance_s`).
        endurance_s: Flight on the battery of the model at that power.
        braking: Stops.
        turns: Corners.
        lags: Moving points.
        drifts: Hovers in wind.
        link: Messages, at the ranges of `limits.json`.
    """

    speed_mps: Positive
    climb_mps: Positive
    descent_mps: Positive
    acceleration_mps2: Positive
    braking_mps2: Positive
    power_w: Positive
    endurance_s: Positive
    braking: tuple[BrakingRow, ...]
    turns: tuple[TurnRow, ...]
    lags: tuple[LagRow, ...]
    drifts: tuple[DriftRow, ...]
    link: tuple[LinkRow, ...]


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
        first = err.errors()[0]
        where = '.'.join(str(part) for part in first['loc'])
        raise ConfigError(f'{path} is not valid: {where}: {first["msg"]}', hint=hint) from err
    except (ValueError, LookupError, TypeError) as err:
        raise ConfigError(f'{path} is not valid: {err!r}', hint=hint) from err
    check_made_of(path, made, uav_basis(load_settings().run.dt_s))
    return record


def within(flight: FlightDefaults, record: UavRecord) -> FlightDefaults:
    """Return the reference motion, nowhere beyond what the multirotor was measured to do."""
    return FlightDefaults.model_validate(
        flight.model_dump()
        | {
            'speed_max_mps': min(flight.speed_max_mps, record.speed_mps),
            'climb_mps': min(flight.climb_mps, record.climb_mps),
            'descent_mps': min(flight.descent_mps, record.descent_mps),
            'acceleration_mps2': min(flight.acceleration_mps2, record.acceleration_mps2),
        }
    )
