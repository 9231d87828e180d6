# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clearance and sight along planned flights, over the buildings and no-fly zones of a map."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from copy import copy
from functools import lru_cache

import numpy as np
import numpy.typing as npt
import shapely

from aurora_core.geometry.obstacles import ObstacleField
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SightModel
from aurora_core.grounding.ways_round import Point2, way_round
from aurora_core.knowledge.height_lattice import HeightLattice
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.outcomes.grounded import Ring

FloatArray = npt.NDArray[np.float64]

# Nothing flies as high (m).
_UNLIMITED_M = 1e4
# What is so near to a clearance is left to the exact check (m).
_ROUNDING_M = 1e-6


def building_prisms(buildings: Sequence[Building]) -> tuple[Prism, ...]:
    """Return the buildings as prisms standing on the ground."""
    return tuple(
        Prism(
            prism_id=b.id,
            ring_xy=np.asarray(b.ring, dtype=np.float64),
            holes_xy=tuple(np.asarray(h, dtype=np.float64) for h in b.holes),
            base_m=0.0,
            top_m=b.height_m,
        )
        for b in buildings
    )


def zone_prisms(zones: Sequence[NoFlyZone]) -> tuple[Prism, ...]:
    """Return the no-fly zones as prisms between floor and ceiling."""
    return tuple(
        Prism(
            prism_id=z.id,
            ring_xy=np.asarray(z.ring, dtype=np.float64),
            holes_xy=(),
            base_m=z.floor_m,
            top_m=z.ceiling_m,
        )
        for z in zones
    )


class Airspace:
    """What stands in the way of a flight, and of a view.

    Args:
        buildings: Of the map.
        zones: No-fly zones; they block flights, not views.
        lattice: Above which height the air over both is free, as it was measured.
    """

    def __init__(
        self,
        buildings: Sequence[Building],
        zones: Sequence[NoFlyZone],
        lattice: HeightLattice | None = None,
    ) -> None:
        self._solids = (tuple(buildings), tuple(zones))
        prisms = building_prisms(buildings)
        self._prisms = (*prisms, *zone_prisms(zones))
        self.obstacles = ObstacleField(self._prisms)
        self.sight = SightModel(prisms)
        self.highest_m = max((b.height_m for b in buildings), default=0.0)
        self._lattice = lattice
        self._segment = lru_cache(maxsize=4096)(self._segment_clearance)
        self._walls = lru_cache(maxsize=64)(self._walls_at)

    def keeping_out(self, rings: Sequence[Ring]) -> Airspace:
        """Return the airspace without the air over outlines (x, y in m), from the ground up."""
        if not rings:
            return self
        buildings, zones = self._solids
        more = tuple(
            NoFlyZone(
                id=f'keep_out_{k}',
                name='',
                ring=ring,
                floor_m=0.0,
                ceiling_m=_UNLIMITED_M,
            )
            for k, ring in enumerate(rings)
        )
        return Airspace(buildings, (*zones, *more))

    def level_way(
        self, start: Point2, end: Point2, height_m: float, clearance_m: float
    ) -> tuple[Point2, ...] | None:
        """Return the shortest way at one height that keeps a clearance, see `way_round`."""
        solids = [
            shapely.Polygon(prism.ring_xy)
            for prism in self._prisms
            if prism.base_m - clearance_m < height_m < prism.top_m + clearance_m
        ]
        return way_round(start, end, solids, clearance_m)

    def bars_level(self, way: Sequence[Point2], height_m: float, clearance_m: float) -> bool:
        """Tell, at little cost, whether a way at one height surely keeps less than a clearance.

        What ends below the way, or begins above it, is not asked: that is for the exact check.
        """
        near_m = clearance_m - _ROUNDING_M
        if near_m <= 0.0 or len(way) < 2:
            return False
        line = shapely.LineString(way)
        return len(self._walls(height_m).query(line, 'dwithin', near_m)) > 0

    def _walls_at(self, height_m: float) -> shapely.STRtree:
        """Return what stands at a height, as outlines: in the plane it is as far away."""
        return shapely.STRtree(
            [
                shapely.Polygon(prism.ring_xy, prism.holes_xy)
                for prism in self._prisms
                if prism.base_m <= height_m <= prism.top_m
            ]
        )

    def points_clearance_m(self, points: FloatArray) -> float:
        """Return the least clearance of points (T, 3), metres."""
        return float(np.min(self.obstacles.clearance_series(points)))

    def way_clearance_m(self, points: Sequence[tuple[float, float, float]]) -> float:
        """Return the least clearance along the straight legs between points (x, y, z in m)."""
        if len(points) == 1:
            return self.points_clearance_m(np.array([points[0]]))
        return min(self._segment(a, b) for a, b in itertools.pairwise(points))

    def way_is_free(
        self, points: Sequence[tuple[float, float, float]], clearance_m: float
    ) -> bool:
        """Tell whether the straight legs between points (x, y, z in m) keep a clearance.

        Where the lattice frees a leg, nothing else is asked: it never does where the exact
        check would not.
        """
        lattice = self._lattice
        if lattice is None or lattice.clearance_m < clearance_m:
            return self.way_clearance_m(points) >= clearance_m
        legs = zip(points, points[1:] or points, strict=False)
        return all(
            lattice.frees_way(np.array(a), np.array(b)) or self._segment(a, b) >= clearance_m
            for a, b in legs
        )

    def _segment_clearance(
        self, a: tuple[float, float, float], b: tuple[float, float, float]
    ) -> float:
        return float(self.obstacles.segment_clearance(np.array(a), np.array(b)))

    def is_inside(self, x_m: float, y_m: float) -> bool:
        """Tell whether a point is in a building, whatever its height."""
        return self.sight.around(x_m, y_m) is not self.sight

    def looking_at(self, x_m: float, y_m: float) -> Airspace:
        """Return the airspace for who looks at a place: its own building does not hide it."""
        found = copy(self)
        found.sight = self.sight.around(x_m, y_m)
        return found

    def seen_share(self, observers: FloatArray, targets: FloatArray, range_m: float) -> float:
        """Return the share of samples (T, 3) at which a target is in range and in sight."""
        return float(np.count_nonzero(self.seen(observers, targets, range_m))) / len(observers)

    def seen(
        self, observers: FloatArray, targets: FloatArray, range_m: float
    ) -> npt.NDArray[np.bool_]:
        """Return (T,) where a target is in range and in sight from observers (T, 3), metres."""
        d = targets - observers
        in_range = np.sqrt(d[:, 0] * d[:, 0] + d[:, 1] * d[:, 1] + d[:, 2] * d[:, 2]) <= range_m
        free = self.sight.clearance_series(observers, targets) > 0.0
        both: npt.NDArray[np.bool_] = in_range & free
        return both
