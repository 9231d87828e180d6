# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What stands on a map beside the road network. Positions are ENU map metres.

Rings are open (the first point is not repeated) and counter-clockwise, holes clockwise.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import shapely

from aurora_core.knowledge.net_types import Points


@dataclass(frozen=True, slots=True, kw_only=True)
class Building:
    """A prism from the ground up.

    Args:
        id: Unique on the map.
        ring: Outline.
        holes: Courtyards.
        height_m: Height above ground.
        height_source: Where the height comes from (design, tag, levels, …).
        kind: house, block, tower, ….
        name: Name as people say it; empty for most.
        box_m: West, south, east and north end of its outline.
    """

    id: str
    ring: Points
    holes: tuple[Points, ...]
    height_m: float
    height_source: str
    kind: str
    name: str
    box_m: tuple[float, float, float, float] = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        east, north = zip(*self.ring, strict=True) if self.ring else ((math.nan,),) * 2
        box_m = (min(east), min(north), max(east), max(north))
        object.__setattr__(self, 'box_m', box_m)

    @property
    def centre(self) -> tuple[float, float]:
        """The centroid of its outline."""
        point = shapely.Polygon(self.ring).centroid
        return float(point.x), float(point.y)

    def has_in_box(self, x_m: float, y_m: float, gap_m: float = 0.0) -> bool:
        """Tell whether a point is inside the box around it, or so near: a quick first look."""
        west, south, east, north = self.box_m
        beside = west - gap_m <= x_m <= east + gap_m
        return beside and south - gap_m <= y_m <= north + gap_m

    def is_below(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point is inside its outline."""
        return bool(shapely.Polygon(self.ring).contains(shapely.Point(x_m, y_m)))


@dataclass(frozen=True, slots=True, kw_only=True)
class NoFlyZone:
    """Air that no UAV may enter, between two heights above ground."""

    id: str
    name: str
    ring: Points
    floor_m: float
    ceiling_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Area:
    """A named piece of ground (park, plaza, school zone, helipad, water)."""

    id: str
    name: str
    kind: str
    ring: Points


@dataclass(frozen=True, slots=True, kw_only=True)
class Landmark:
    """A place that people name.

    Args:
        name: Unique name, such as Mercy Hospital.
        kind: hospital, fire_station, police_station, city_hall, school, park, tower, stadium,
            market, station.
        x_m: East.
        y_m: North.
        approach_lane_id: Traffic lane from which a vehicle reaches it.
        approach_pos_m: Simulator position on that lane abreast of it.
    """

    name: str
    kind: str
    x_m: float
    y_m: float
    approach_lane_id: str
    approach_pos_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class BusStop:
    """A stop on a traffic lane, from and to positions along it (metres)."""

    id: str
    name: str
    lane_id: str
    start_pos_m: float
    end_pos_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ParkingPlace:
    """One place of a parking row: its centre, unit heading and size."""

    x_m: float
    y_m: float
    heading_east: float
    heading_north: float
    length_m: float
    width_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class ParkingArea:
    """A row of kerbside places beside a traffic lane.

    Args:
        id: Id in the simulator.
        name: Name as people say it.
        lane_id: Traffic lane from which it is entered.
        start_pos_m: First position along that lane.
        end_pos_m: Last position along that lane.
        places: Places in driving order.
    """

    id: str
    name: str
    lane_id: str
    start_pos_m: float
    end_pos_m: float
    places: tuple[ParkingPlace, ...]
