# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`GroundedScenario`: every relation of the request turned into places, routes and settings."""

from __future__ import annotations

from enum import StrEnum

from pydantic import FiniteFloat

from aurora_core.document import Document, omitted
from aurora_core.knowledge.basis import Basis
from aurora_core.mission.plan import UavPlan
from aurora_core.outcomes.repair import RepairPlan
from aurora_core.spec.parameter import Provenance

GROUNDING_VERSION = 1

Ring = tuple[tuple[FiniteFloat, FiniteFloat], ...]


class ReleaseOn(StrEnum):
    """What lets a held agent start to move."""

    START = 'start'  # at t = 0
    ASCENDED = 'ascended'  # a UAV has reached its mission altitude
    CAPTURED = 'captured'  # a UAV has captured its target
    LAPPED = 'lapped'  # a UAV has flown its route once
    OBSERVED = 'observed'  # a UAV has finished watching it
    NEARED = 'neared'  # another agent has come near
    PARTED = 'parted'  # another agent has drawn away
    WAITED = 'waited'  # so much time has passed
    EVENT = 'event'  # the event that lets it set off has happened
    NEVER = 'never'  # stands still


class AnchorScore(Document):
    """Terms of the joint anchor score, each in [0, 1].

    Source: paper, joint anchor score.
    """

    road: FiniteFloat
    air: FiniteFloat
    sense: FiniteFloat
    comm: FiniteFloat
    joint: FiniteFloat


class GroundedAgent(Document):
    """A ground agent at t = 0 and what it will do.

    Attributes:
        edges: Planned route.
        route_xy_m: Path of its reference point along the route, ENU map frame.
        lane_id: Lane of the reference point ('' for persons).
        lane_position_m: Arc length of the reference point (vehicles: box centre) along the centre
            line of that lane, as drawn; simulators may count a lane longer or shorter.
        release: When it may start to move.
        release_uav: The UAV whose state releases it.
        release_mission: The mission whose capture releases it.
        release_agent: The agent whose coming near, or drawing away, releases it ...
        release_within_m: ... and how near, or ...
        release_beyond_m: ... how far away that is.
        release_after_s: Or how long it waits.
        drive_speed_mps: Stated speed, held from the release on (None: drives with the traffic).
        acceleration_mps2: What its type can do from rest.
        deceleration_mps2: And to slow down, without emergency.
        parked: Stands beside the traffic, right of its lane.
        stop_lane_id: Where it comes to a stop by itself, '' when it does not.
        stop_position_m: Arc length there of its reference point.
        stop_s: How long it stands where it stops or halts; None: to the end, or until an event.
        runs_red: It drives on at a red light where nobody is in its way.
        lateral_m: Persons: so far left of the middle of the sidewalk.
        way_xy_m: Persons: their way over the street where no crosswalk is, ENU map frame.
        halt_xy_m: Persons: where they rest, once they have walked there: for `stop_s`, or until an
            event lets them go on; ENU map frame.
        top_speed_mps: It drives no faster by itself, whatever the street allows (None: not known).
        gentle_mps2: It accelerates no harder, so that who keeps a distance behind it can (None:
            as its type does).
    """

    id: str
    type_name: str
    is_person: bool
    length_m: FiniteFloat
    width_m: FiniteFloat
    height_m: FiniteFloat
    role: str
    edges: tuple[str, ...]
    route_xy_m: tuple[tuple[FiniteFloat, FiniteFloat], ...]
    lane_id: str
    lane_position_m: FiniteFloat
    x_m: FiniteFloat
    y_m: FiniteFloat
    heading_x: FiniteFloat
    heading_y: FiniteFloat
    speed_mps: FiniteFloat = 0.0
    speed_factor: FiniteFloat = 1.0
    time_gap_s: FiniteFloat | None = None
    min_gap_m: FiniteFloat | None = None
    lane_change_mode: int | None = None
    arrival_position_m: FiniteFloat | None = None
    release: ReleaseOn = ReleaseOn.START
    release_uav: str = ''
    release_mission: str = ''
    drive_speed_mps: FiniteFloat | None = None
    acceleration_mps2: FiniteFloat = 1.5
    deceleration_mps2: FiniteFloat = 1.5
    parked: bool = omitted(False)
    stop_lane_id: str = omitted('')
    stop_position_m: FiniteFloat = omitted(0.0)
    stop_s: FiniteFloat | None = omitted(None)
    gentle_mps2: FiniteFloat | None = omitted(None)
    top_speed_mps: FiniteFloat | None = omitted(None)
    runs_red: bool = omitted(False)
    lateral_m: FiniteFloat = omitted(0.0)
    way_xy_m: tuple[tuple[FiniteFloat, FiniteFloat], ...] = omitted(())
    halt_xy_m: tuple[FiniteFloat, FiniteFloat] | None = omitted(None)
    release_agent: str = omitted('')
    release_within_m: FiniteFloat = omitted(0.0)
    release_after_s: FiniteFloat = omitted(0.0)
    release_beyond_m: FiniteFloat = omitted(0.0)


class RealisedValue(Document):
    """Requested and realised value of a parameter, by its path in the specification."""

    path: str
    requested: FiniteFloat
    realised: FiniteFloat
    provenance: Provenance


class GroundedScenario(Document):
    """The grounded scenario of one iteration.

    Attributes:
        keep_out: Outlines (x, y in m, ENU map frame) that UAVs stay out of at any height.
    """

    schema_version: int = GROUNDING_VERSION
    map_name: str
    map_digest: str
    anchor_lane: str
    anchor_position_m: FiniteFloat
    score: AnchorScore
    candidates: int
    agents: tuple[GroundedAgent, ...]
    uavs: tuple[UavPlan, ...]
    keep_out: tuple[Ring, ...] = omitted(())
    realised: tuple[RealisedValue, ...] = ()
    unsupported: tuple[str, ...] = ()
    weather: str
    time_of_day: str
    wind_mean_east_mps: FiniteFloat = 0.0
    wind_mean_north_mps: FiniteFloat = 0.0
    wind_gust_mps: FiniteFloat = 0.0
    seed: int = 1
    # Version, limits, tolerances and settings that it was made with (older recordings: None), and
    # their digest.
    basis: Basis | None = None
    configuration: str = ''
    # Version of the executor that it is for (`execution.plan.EXECUTOR_VERSION`), 0 in old ones.
    executor_version: int = 0
    # What repair made otherwise than the first grounding; None where nothing.
    repair: RepairPlan | None = omitted(None)
