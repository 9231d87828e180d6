# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""No-fly zones: the same solids as obstacles, but of air."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.geometry.arrays import FloatArray, FloatLike
from aurora_core.geometry.obstacles import DEFAULT_CUTOFF_M, ObstacleField
from aurora_core.geometry.prism import Prism


class ZoneField:
    """No-fly zones; a prism's base is the zone's floor and its top the ceiling.

    Distances are positive outside every zone and negative inside one, as in `ObstacleField`.
    """

    def __init__(self, zones: Iterable[Prism]) -> None:
        self._field = ObstacleField(zones)

    @property
    def zones(self) -> tuple[Prism, ...]:
        """The zones, as given."""
        return self._field.prisms

    def distance(self, point_xyz: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M) -> float:
        """Return the signed distance of a point (3,) to the nearest zone, at most the cutoff."""
        return self._field.clearance(point_xyz, cutoff_m)

    def distance_series(self, points: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M) -> FloatArray:
        """Return the signed distances (T,) of points (T, 3) to the nearest zone."""
        return self._field.clearance_series(points, cutoff_m)

    def segment_distance(
        self, p_xyz: FloatLike, q_xyz: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M
    ) -> float:
        """Return the least distance of a straight segment to any zone, at most 0 on contact."""
        return self._field.segment_clearance(p_xyz, q_xyz, cutoff_m)

    def polyline_distance(self, points: FloatLike, cutoff_m: float = DEFAULT_CUTOFF_M) -> float:
        """Return the least distance of a flight path (K, 3) to any zone, at most 0 on contact."""
        return self._field.polyline_clearance(points, cutoff_m)

    def nearest(self, point_xyz: FloatLike) -> tuple[str, float]:
        """Return the id of the zone nearest to a point (3,) and the signed distance to it."""
        return self._field.nearest(point_xyz)
