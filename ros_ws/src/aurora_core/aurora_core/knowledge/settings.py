# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Settings of grounding and execution: how things are done, never what counts as done."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from aurora_core.document import first_problem, omitted
from aurora_core.errors import ConfigError
from aurora_core.files import CONFIG_BYTES, read_json
from aurora_core.knowledge.config_files import config_path
from aurora_core.knowledge.limits import NotNegative, Positive

Count = Annotated[int, Field(ge=1)]


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra='forbid', allow_inf_nan=False)


class AnchorWeights(_Table):
    """Weights of the joint anchor score (paper, eq. (2)); equal by default."""

    road: NotNegative
    air: NotNegative
    sense: NotNegative
    comm: NotNegative

    @model_validator(mode='after')
    def _some_weight(self) -> Self:
        if self.road + self.air + self.sense + self.comm <= 0.0:
            raise ValueError('weights: one of road, air, sense, comm has to be above 0')
        return self


class SpeedSettings(_Table):
    """Speeds of drivers that what the request says leaves open."""

    above_awaited_mps: NotNegative = 0.7  # who has to be faster than a number
    below_cap_mps: NotNegative = 0.5  # who is never to be faster than a number
    before_gain_mps: NotNegative = 5.0  # below the speed that one is to accelerate to
    least_before_gain_mps: NotNegative = 3.0  # but not slower than that
    unsaid_mps: Positive = 7.0  # before one accelerates, nobody says to what or from what
    before_slowing_mps: NotNegative = 4.0  # above the speed that one is to slow down to
    taken_over_mps: Positive = 7.0  # at most, of whom another UAV takes over
    emergency_factor: Positive = 1.2  # what an emergency run makes of speed limits
    emergency_over_mps: Positive = 1.5  # above the limit, of one that a UAV tracks
    trackable_mps: Positive = 15.5  # at most, of whom a UAV tracks and no speed is stated


class PersonSettings(_Table):
    """How persons stand and walk."""

    walking_mps: Positive = 1.4  # unless the request says another
    abreast_m: Positive = 0.65  # between two side by side on a sidewalk
    body_m: NotNegative = 0.4  # room round the middle of one
    inside_bound_m: NotNegative = 1.0  # how far inside a bound on a distance one stands


class GroundingSettings(_Table):
    """How places are searched."""

    weights: AnchorWeights
    anchor_spacing_m: Positive
    anchors_scored: Count
    sample_spacing_m: Positive
    clearance_m: NotNegative  # planned clearance, above the limit
    turn_sample_m: Positive
    turn_cosine: float  # a change of heading beyond this is a turn
    turns_bad: Count  # as many turns on the way leave nothing of the score for a straight road
    pattern_shifts_m: Annotated[tuple[float, ...], Field(min_length=1)]
    target_speed_mps: Positive  # a tracked target is slowed to this
    convoy_speed_factor_behind: Positive
    chased_speed_factor: Positive  # of the front one of two vehicles that are to meet
    close_encounter_m: NotNegative  # closer than this the rear one has to tailgate
    home_spacing_m: NotNegative
    bearings: Count
    spot_clearance_m: NotNegative
    spot_search_m: Positive
    spot_spacing_m: Positive
    background_radius_m: tuple[NotNegative, Positive]
    background_gap_m: NotNegative
    traffic_reach_share: Positive  # of `traffic_radius_m`; traffic does not leave it if it can
    # What came later has a default: recordings made before are judged by what held then.
    longest_way_m: Positive = omitted(2500.0)  # to a place that no street leads straight on to
    passing_m: NotNegative = omitted(150.0)  # who lets others pass, and they, go the same way
    inside_bound_m: NotNegative = omitted(2.0)  # how far inside a bound a vehicle stands
    speeds: SpeedSettings = omitted(SpeedSettings())
    persons: PersonSettings = omitted(PersonSettings())


class FlightDefaults(_Table):
    """Reference motion of the UAVs; below the limits, so that realised values stay inside."""

    speed_max_mps: Positive
    acceleration_mps2: Positive
    climb_mps: Positive
    descent_mps: Positive
    corner_speed_mps: Positive
    position_gain_hz: Positive


class DrivingStyle(_Table):
    """How drivers are led that follow, overtake or change lane; gaps are bumper to bumper."""

    overtake_out_m: Positive = 30.0  # one pulls out this close behind the other one
    overtake_in_m: NotNegative = 10.0  # and in again this far ahead of it
    overtake_lane_s: Positive = 60.0  # the lane to pass on is kept so long: longer than it takes
    follow_gap_m: NotNegative = 3.0  # the gap that is kept: so much, and
    follow_gap_s: NotNegative = 2.0  # what is driven in so long
    follow_gain_hz: Positive = 0.4  # how fast one comes up to it
    follow_lost_m: Positive = 80.0  # from so far away nobody keeps a gap
    lane_free_m: NotNegative = 5.0  # a lane is free where nobody on it is nearer than this,
    lane_free_s: NotNegative = 2.0  # now or after so much time


class RunSettings(_Table):
    """Lockstep and style of driving."""

    dt_s: Positive
    settle_s: NotNegative  # after the last thing is done, before the run ends
    sight_period_s: Positive
    convoy_lane_change_mode: Annotated[int, Field(ge=0)]  # SUMO bit set
    tailgate_speed_factor: Positive
    tailgate_time_gap_s: Positive
    tailgate_min_gap_m: NotNegative
    driving: DrivingStyle = omitted(DrivingStyle())


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
        return Settings.model_validate(read_json(path, CONFIG_BYTES))
    except OSError as err:
        raise ConfigError(f'{path} cannot be read: {err}', hint='run make setup') from err
    except ValueError as err:  # not UTF-8, not JSON, or out of the schema
        raise ConfigError(
            f'{path} is not valid: {first_problem(err)}', hint='compare with the shipped file'
        ) from err
