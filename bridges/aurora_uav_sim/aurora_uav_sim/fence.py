# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The geofence: polygons and circles to stay in or out of, and a cylinder around home."""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, NamedTuple

from pymavlink.dialects.v20 import common as mavlink

from aurora_uav_sim.commands import whole
from aurora_uav_sim.plan_items import Item, Refusal, place_of
from aurora_uav_sim.settings import AutopilotSettings

if TYPE_CHECKING:
    from aurora_uav_sim.vehicle import Vehicle

_POLYGON_IN = int(mavlink.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_INCLUSION)
_POLYGON_OUT = int(mavlink.MAV_CMD_NAV_FENCE_POLYGON_VERTEX_EXCLUSION)
_CIRCLE_IN = int(mavlink.MAV_CMD_NAV_FENCE_CIRCLE_INCLUSION)
_CIRCLE_OUT = int(mavlink.MAV_CMD_NAV_FENCE_CIRCLE_EXCLUSION)

Point = tuple[float, float]


class Breach(IntEnum):
    """Which side was crossed; the numbers of FENCE_BREACH."""

    NONE = 0
    HEIGHT = 2
    BOUNDARY = 3


class _Area(NamedTuple):
    """A polygon, or a circle when it has one corner. ENU around the local origin, m."""

    inside: bool
    corners: tuple[Point, ...]
    radius_m: float = 0.0

    def holds(self, x: float, y: float) -> bool:
        if len(self.corners) == 1:
            ((cx, cy),) = self.corners
            return (x - cx) ** 2 + (y - cy) ** 2 <= self.radius_m**2
        crossings = 0
        for (ax, ay), (bx, by) in zip(
            self.corners, (*self.corners[1:], self.corners[0]), strict=True
        ):
            if (ay > y) != (by > y) and x < ax + (y - ay) / (by - ay) * (bx - ax):
                crossings += 1
        return crossings % 2 == 1


class Fence:
    """What a ground station drew; inside means in some inclusion and in no exclusion.

    Source: PX4 user guide, geofence.
    """

    def __init__(self, areas: tuple[_Area, ...] = ()) -> None:
        self._areas = areas

    def boundary_holds(self, x: float, y: float) -> bool:
        """Return whether a point is inside the drawn areas."""
        wanted = [a for a in self._areas if a.inside]
        if wanted and not any(a.holds(x, y) for a in wanted):
            return False
        return not any(a.holds(x, y) for a in self._areas if not a.inside)

    def breach(
        self, at: tuple[float, float, float], home: tuple[float, float, float],
        settings: AutopilotSettings,
    ) -> Breach:  # fmt: skip
        """Return which side a place is beyond.

        Args:
            at: ENU around the local origin, m.
            home: Likewise.
            settings: With the cylinder around home.
        """
        dx, dy, height_m = (a - b for a, b in zip(at, home, strict=True))
        if settings.fence_height_m and height_m > settings.fence_height_m:
            return Breach.HEIGHT
        radius_m = settings.fence_radius_m
        if radius_m and dx * dx + dy * dy > radius_m * radius_m:
            return Breach.BOUNDARY
        return Breach.NONE if self.boundary_holds(at[0], at[1]) else Breach.BOUNDARY


def read_fence(items: tuple[Item, ...], vehicle: Vehicle) -> Fence | Refusal:
    """Return the fence that a plan of fence items draws."""
    areas: list[_Area] = []
    at = 0
    while at < len(items):
        item = items[at]
        if item.command in (_CIRCLE_IN, _CIRCLE_OUT):
            centre = place_of(item, vehicle)
            if centre is None or not 0.0 < item.p1 < 1e6:
                return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1, 'fence circle')
            areas.append(_Area(item.command == _CIRCLE_IN, (centre,), item.p1))
            at += 1
            continue
        if item.command not in (_POLYGON_IN, _POLYGON_OUT):
            return Refusal(mavlink.MAV_MISSION_UNSUPPORTED, f'fence command {item.command}')
        count = whole(item.p1)
        corners = items[at : at + (count or 0)]
        if count is None or count < 3 or len(corners) < count:
            return Refusal(mavlink.MAV_MISSION_INVALID_PARAM1, 'fence corners')
        places = [place_of(corner, vehicle) for corner in corners]
        if any(corner.command != item.command for corner in corners) or None in places:
            return Refusal(mavlink.MAV_MISSION_INVALID, 'fence polygon')
        areas.append(_Area(item.command == _POLYGON_IN, tuple(p for p in places if p)))
        at += count
    return Fence(tuple(areas))
