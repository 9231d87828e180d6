# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`WorldModel`: all that a verdict needs to know of the world; it travels in the bag."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum

import numpy as np
import numpy.typing as npt

from aurora_core.knowledge.limits import Limits
from aurora_core.knowledge.map_types import Building, NoFlyZone

FloatArray = npt.NDArray[np.float64]


class SurfaceKind(IntEnum):
    """Kinds of ground surfaces."""

    DRIVING = 0
    CROSSING = 1
    SIDEWALK = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """A polygon of one kind; rings (K, 2) in metres, ENU map frame, not closed."""

    surface_id: str
    kind: SurfaceKind
    ring: FloatArray
    holes: tuple[FloatArray, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class CentreLine:
    """Centre line (K, 2) of a driving lane in driving direction."""

    lane_id: str
    street_name: str
    points: FloatArray
    width_m: float
    speed_limit_mps: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SignalPost:
    """A signalised junction."""

    junction_id: str
    x_m: float
    y_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class NamedPlace:
    """A place that the scenario may refer to: `landmark:<name>`, or `intersection` as grounded."""

    name: str
    x_m: float
    y_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Wind:
    """Mean wind vector (ENU, the direction it blows to) and gust amplitude."""

    mean_east_mps: float = 0.0
    mean_north_mps: float = 0.0
    gust_mps: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldModel:
    """The measured world of one run.

    Attributes:
        map_digest: sha256 (hex) of the map's files.
        conditions_json: The success conditions of the run, canonical JSON.
        limits: The limits in force.
        lane_boxes: Least x and y, then greatest x and y of the carriageway of each lane, (L, 4).
    """

    map_name: str
    map_digest: str
    origin_lat_deg: float
    origin_lon_deg: float
    weather: str
    time_of_day: str
    wind: Wind
    buildings: tuple[Building, ...]
    no_fly_zones: tuple[NoFlyZone, ...]
    surfaces: tuple[Surface, ...]
    lanes: tuple[CentreLine, ...]
    signals: tuple[SignalPost, ...]
    limits: Limits
    places: tuple[NamedPlace, ...] = ()
    conditions_json: str = '[]'
    lane_boxes: FloatArray = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, 'lane_boxes', _lane_boxes(self.lanes))

    @property
    def sensing_range_m(self) -> float:
        """Sensing range of a UAV camera in this weather at this time of day."""
        return self.limits.sensing_range(self.weather, self.time_of_day)


def _lane_boxes(lanes: tuple[CentreLine, ...]) -> FloatArray:
    if not lanes:
        return np.zeros((0, 4))
    points = np.concatenate([lane.points for lane in lanes])
    ends = np.cumsum([len(lane.points) for lane in lanes])
    begins = np.concatenate([[0], ends[:-1]])
    reach = np.array([lane.width_m / 2.0 for lane in lanes])[:, None]
    low = np.minimum.reduceat(points, begins, axis=0) - reach
    high = np.maximum.reduceat(points, begins, axis=0) + reach
    return np.hstack([low, high])
