# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Free spots on the ground where a UAV may start and land: off the street, clear of buildings."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import numpy as np
import shapely

from aurora_core import knowledge
from aurora_core.compiled import Compiled
from aurora_core.geometry.arrays import BoolArray, FloatArray
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.settings import GroundingSettings

Point2 = tuple[float, float]

# More than the distance of two shapes is rounded by.
_ROUNDING_M = 1e-6
# Places that are looked at in one go: most often one of the nearest is free.
_FEW, _MANY = 40, 400
# Spots of which is kept whether they are free, 0.2 kB each.
_KEPT = 50_000


def compiled_area(map_model: MapModel) -> Compiled:
    """Return what is built on a map (WKB), as set-up compiles it."""
    core = Path(knowledge.__file__).parent
    readers = ('map_files.py', 'net_reader.py', 'road_network.py', 'surfaces.py')
    return Compiled(
        name=f'built.{map_model.digest[:16]}',
        sources=(Path(__file__), *(core / name for name in readers)),
        key=f'{map_model.digest} {shapely.geos_version_string}',
        make=lambda: _built_area(map_model),
    )


def _built_area(map_model: MapModel) -> bytes:
    """Return buildings, zones and streets from house line to house line as one shape (WKB)."""
    prisms = [b.ring for b in map_model.buildings] + [z.ring for z in map_model.zones]
    blocks = [shapely.make_valid(shapely.Polygon(ring)) for ring in prisms]
    area = shapely.union_all([*blocks, map_model.network.street_surface])
    return bytes(shapely.to_wkb(area))


class SpotFinder:
    """Finds the free spot next to a point, in a fixed order of candidates.

    Args:
        map_model: Map.
        settings: Clearance and search radius.
    """

    def __init__(self, map_model: MapModel, settings: GroundingSettings) -> None:
        self._settings = settings
        self._blocked = shapely.from_wkb(compiled_area(map_model).value())
        shapely.prepare(self._blocked)
        west, south, east, north = map_model.bounds_m
        self._bounds = (west, south, east, north)
        steps = int(settings.spot_search_m / settings.spot_spacing_m)
        offsets = [
            (i * settings.spot_spacing_m, j * settings.spot_spacing_m)
            for i in range(-steps, steps + 1)
            for j in range(-steps, steps + 1)
        ]
        offsets.sort(key=lambda o: (o[0] * o[0] + o[1] * o[1], o))
        self._offsets = np.array(offsets)
        self._known: dict[Point2, bool] = {}

    def near(self, x_m: float, y_m: float, count: int = 1) -> tuple[Point2, ...]:
        """Return up to `count` free spots, nearest first, at least two clearances apart.

        Args:
            x_m: ENU map frame.
            y_m: ENU map frame.
            count: How many.
        """
        # A fixed grid, so that the same place is found from every query point around.
        spacing = self._settings.spot_spacing_m
        base = np.array([round(x_m / spacing) * spacing, round(y_m / spacing) * spacing])
        found: list[Point2] = []
        apart = 2.0 * self._settings.spot_clearance_m
        start, size = 0, _FEW
        while start < len(self._offsets):
            points = self._offsets[start : start + size] + base
            start, size = start + size, _MANY
            free = ~self._is_blocked(points)
            for x, y in points[free].tolist():
                inside = (
                    self._bounds[0] <= x <= self._bounds[2]
                    and self._bounds[1] <= y <= self._bounds[3]
                )
                if inside and all(
                    sqrt((x - a) * (x - a) + (y - b) * (y - b)) >= apart for a, b in found
                ):
                    found.append((x, y))
                    if len(found) == count:
                        return tuple(found)
        return tuple(found)

    def _is_blocked(self, points: FloatArray) -> BoolArray:
        """Return which points are nearer to what is built than the clearance.

        Points lie on one grid: those of a place are asked about again from all around it.
        """
        spots = [(x, y) for x, y in points.tolist()]
        new = [spot for spot in spots if spot not in self._known]
        if new:
            if len(self._known) > _KEPT:
                self._known = {spot: self._known[spot] for spot in spots if spot in self._known}
            self._known.update(zip(new, self._near_built(np.array(new)).tolist(), strict=True))
        return np.array([self._known[spot] for spot in spots])

    def _near_built(self, points: FloatArray) -> BoolArray:
        clearance_m = self._settings.spot_clearance_m
        spots = shapely.points(points)
        # Only the first geometry's index is used. With it the distance is rounded otherwise than
        # without, so that the few points just at the clearance are asked about again.
        blocked = shapely.dwithin(self._blocked, spots, clearance_m - _ROUNDING_M)
        (open_,) = np.nonzero(
            ~blocked & shapely.dwithin(self._blocked, spots, clearance_m + _ROUNDING_M)
        )
        blocked[open_] = shapely.dwithin(spots[open_], self._blocked, clearance_m)
        return np.asarray(blocked)
