# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of grounding and execution: how things are done, never what counts as done."""

from __future__ import annotations

import json

from pydantic import BaseModel, ConfigDict, ValidationError

from aurora_core.errors import ConfigError
from aurora_core.knowledge.config_files import config_path


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)


class AnchorWeights(_Table):
    """Weights of the joint anchor score (paper, eq. (2)); equal by default."""

    road: float
    air: float
    sense: float
    comm: float


class GroundingSettings(_Table):
    """How places are searched."""

    weights: AnchorWeights
    anchor_spacing_m: float
    anchors_scored: int
    sample_spacing_m: float
    clearance_m: float  # planned clearance, above the limit
    pattern_shift_m: float
    target_speed_mps: float  # a tracked target is slowed to this
    convoy_speed_factor_behind: float
    bearings: int
    spot_clearance_m: float
    spot_search_m: float
    spot_spacing_m: float
    background_radius_m: tuple[float, float]
    background_gap_m: float


class FlightDefaults(_Table):
    """Reference motion of the UAVs; below the limits, so that realised values stay inside."""

    speed_max_mps: float
    acceleration_mps2: float
    climb_mps: float
    descent_mps: float
    corner_speed_mps: float
    position_gain_hz: float


class RunSettings(_Table):
    """Lockstep and style of driving."""

    dt_s: float
    settle_s: float  # after the last thing is done, before the run ends
    sight_period_s: float
    convoy_lane_change_mode: int  # SUMO bit set
    tailgate_speed_factor: float
    tailgate_time_gap_s: float
    tailgate_min_gap_m: float


class Settings(_Table):
    """The file `settings.json`."""

    grounding: GroundingSettings
    flight: FlightDefaults
    run: RunSettings


def load_settings() -> Settings:
    """Read `settings.json` of the configuration.

    Raises:
        ConfigError: The file is missing or out of its schema.
    """
    path = config_path('settings.json')
    try:
        return Settings.model_validate(json.loads(path.read_text(encoding='utf-8')))
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except (json.JSONDecodeError, ValidationError) as err:
        raise ConfigError(
            f'{path} is not valid: {err}', hint='compare with the shipped file'
        ) from err
