# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A recording as arrays: what the checker judges, whoever made it (a bag or a test)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Any

import numpy as np
import numpy.typing as npt

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# Columns of GroundState (GroundState.msg).
X, Y, HEADING_X, HEADING_Y, SPEED, ACCELERATION, PRESENT = range(7)
GROUND_WIDTH = 7
# Columns of UavState (UavState.msg).
UX, UY, UZ, VX, VY, VZ = range(6)
LANDED = 15
UAV_WIDTH = 16
# Phases of UavCommand: mission k is MISSION + k.
IDLE, ASCENT, MISSION, HOLDING, LANDING = 0.0, 1.0, 2.0, 99.0, 100.0


class LinkKind(IntEnum):
    """LinkEvent.kind."""

    SENT = 0
    ATTEMPT_LOST = 1
    ATTEMPT_PASSED = 2
    DELIVERED = 3
    FAILED = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkEntry:
    """One line of the message ledger. `reason`: 1 by chance, 2 beyond the range."""

    time_s: float
    message: int
    sender: str
    receiver: str
    kind: LinkKind
    attempt: int = 0
    reason: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """One body of the roster; `row` counts ground bodies and UAVs each from 0."""

    body_id: str
    type_name: str
    row: int
    is_uav: bool = False
    is_person: bool = False
    role: str = 'other'
    length_m: float = 4.5
    width_m: float = 1.8
    height_m: float = 1.5
    route_xy_m: FloatArray = field(default_factory=lambda: np.zeros((0, 2)))


@dataclass(frozen=True, slots=True, kw_only=True)
class Prism:
    """A building, or a volume over a ring; `polygon` is a shapely polygon."""

    name: str
    polygon: Any
    floor_m: float = 0.0
    top_m: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lane:
    """Centre line of a driving lane, in driving direction."""

    lane_id: str
    street: str
    xy_m: FloatArray
    width_m: float = 3.3
    limit_mps: float = 13.89


@dataclass(frozen=True, slots=True, kw_only=True)
class World:
    """The recorded world. Surfaces are (id, shapely polygon)."""

    map_name: str = ''
    weather: str = 'clear'
    time_of_day: str = 'noon'
    wind_mps: tuple[float, float] = (0.0, 0.0)  # east, north: where the air goes
    gust_mps: float = 0.0
    buildings: tuple[Prism, ...] = ()
    zones: tuple[Prism, ...] = ()
    driving: tuple[tuple[str, Any], ...] = ()
    crossings: tuple[tuple[str, Any], ...] = ()
    sidewalks: tuple[tuple[str, Any], ...] = ()
    lanes: tuple[Lane, ...] = ()
    signals: tuple[tuple[str, float, float], ...] = ()
    places: tuple[tuple[str, float, float], ...] = ()
    limits: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """Everything of a run that the checker looks at; row k of the arrays is tick k.

    Attributes:
        ground: (ticks, ground bodies, 7), ENU metres and SI units.
        uav: (ticks, UAVs, 16).
        phase: (ticks, UAVs): phase of the command for the tick; the only thing of a command.
        ledger: Messages in the order of recording.
    """

    dt_s: float
    bodies: tuple[Body, ...]
    world: World
    ground: FloatArray
    uav: FloatArray
    phase: FloatArray
    ledger: tuple[LinkEntry, ...] = ()

    @property
    def ticks(self) -> int:
        """Return the number of recorded ticks, tick 0 included."""
        return int(max(self.ground.shape[0], self.uav.shape[0]))
