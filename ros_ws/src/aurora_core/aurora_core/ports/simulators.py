# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The two simulators as core sees them: load, read, advance by one tick, close.

Both protocols are implemented by the clients in `bridges/`; the ROS bridge nodes and the local
engine drive the same clients, so there is one behaviour and one set of numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Protocol

import numpy as np
import numpy.typing as npt

from aurora_core.trace.commands import GroundCommand

FloatArray = npt.NDArray[np.float64]

# Free space between the kerb-side border of a traffic lane and the flank of a parked vehicle (m).
KERB_CLEARANCE_M = 0.3


def kerb_offset_m(lane_width_m: float, vehicle_width_m: float) -> float:
    """Return how far right of a traffic lane's centre line a parked vehicle's centre stands."""
    return 0.5 * lane_width_m + 0.5 * vehicle_width_m + KERB_CLEARANCE_M


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundAgentLoad:
    """A ground agent to place at t = 0.

    Attributes:
        agent_id: Name in roster and trace.
        type_name: vType id (`config/maps/vtypes.add.xml`).
        is_person: Pedestrian (walks on `edges`) or vehicle (drives along `edges`).
        edges: Planned route, first = where it stands.
        lane_id: Lane of the reference point (vehicles); persons: '' = the sidewalk of `edges[0]`.
        lane_position_m: Arc length along the centre line of `lane_id` of the CENTRE of the
            vehicle's box. May be less than half the vehicle's length: the front bumper is what
            SUMO is told. Persons: along the sidewalk, in its middle.
        speed_mps: Speed at t = 0.
        arrival_position_m: Persons: where on the last edge the walk ends, standing (None: with one
            edge the person stands where it is, with more it goes to the middle of the last).
        speed_factor: Factor on speed limits (driving style).
        time_gap_s: Desired headway, None = of the type.
        min_gap_m: Gap at standstill, None = of the type.
        lane_change_mode: SUMO bit set; None = SUMO's default.
        acceleration_mps2: It accelerates no harder; None = as its type does.
        parked: Stands beside the traffic lanes and never moves: right of `lane_id` where its class
            may drive on that lane, in the middle of `lane_id` elsewhere (parking lane, sidewalk).
        runs_red: Drives on at a red light where nobody is in its way.
        lateral_m: Persons: so far left of the middle of the sidewalk.
        way_xy_m: Persons: from their place they walk along this line (x, y in m, ENU map frame)
            over the street, where no crosswalk is, and stand at its end; vehicles let them pass.
    """

    agent_id: str
    type_name: str
    is_person: bool
    edges: tuple[str, ...]
    lane_id: str
    lane_position_m: float
    speed_mps: float = 0.0
    arrival_position_m: float | None = None
    speed_factor: float = 1.0
    time_gap_s: float | None = None
    min_gap_m: float | None = None
    lane_change_mode: int | None = None
    acceleration_mps2: float | None = None
    parked: bool = False
    runs_red: bool = False
    lateral_m: float = 0.0
    way_xy_m: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundLoad:
    """Everything the ground simulator needs for one run."""

    map_name: str
    net_path: Path
    vtypes_path: Path
    map_digest: str
    dt_s: float
    seed: int
    agents: tuple[GroundAgentLoad, ...]
    weather: str = 'clear'


@dataclass(frozen=True, slots=True, kw_only=True)
class UavHome:
    """Where a UAV stands at t = 0 (ENU map frame, on the ground)."""

    uav_id: str
    system_id: int
    x_m: float
    y_m: float
    yaw_enu_rad: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AirLoad:
    """Everything the air simulator needs for one run."""

    dt_s: float
    seed: int
    homes: tuple[UavHome, ...]
    origin_lat_deg: float
    origin_lon_deg: float
    origin_alt_m: float = 0.0
    wind_mean_east_mps: float = 0.0
    wind_mean_north_mps: float = 0.0
    wind_gust_mps: float = 0.0


class GroundSimulator(Protocol):
    """Ground traffic in lockstep."""

    def load(self, load: GroundLoad) -> None:
        """Place everything exactly; afterwards `state` is the spawned state of tick 0.

        Raises:
            GroundSimulatorError: The map does not load, an agent cannot be inserted exactly
                where asked (named), or a number is out of range.
        """

    def state(self) -> FloatArray:
        """Return the packed state (N, GROUND_WIDTH) of the current tick."""

    def advance(self, tick: int, commands: tuple[GroundCommand, ...]) -> FloatArray:
        """Apply the commands stamped `tick`, advance to tick * dt, return the packed state."""

    def show_uavs(self, rows: FloatArray) -> None:
        """Show UAVs, packed states (M, UAV_WIDTH): no state of the ground depends on it."""

    def close(self) -> None:
        """Free the simulation; safe to call twice."""


class AirSimulator(Protocol):
    """Multirotors in lockstep."""

    def load(self, load: AirLoad) -> None:
        """Reset, set homes, wind and seed; afterwards `state` is tick 0, on the ground.

        Raises:
            AirSimulatorError: The simulator is silent or refuses.
        """

    def state(self) -> FloatArray:
        """Return the packed state (M, UAV_WIDTH) of the current tick."""

    def advance(self, tick: int, commands: FloatArray) -> FloatArray:
        """Apply commands (M, UAV_COMMAND_WIDTH) stamped `tick`, advance, return the state."""

    def close(self) -> None:
        """Free the link; safe to call twice."""
