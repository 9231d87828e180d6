# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The solids of a world in the form that the signals need, built once per world."""

from __future__ import annotations

from functools import cached_property

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2, norm2_array
from aurora_core.geometry.obstacles import ObstacleField
from aurora_core.geometry.polygon import Polygon, PolygonSet
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SightModel
from aurora_core.geometry.sight_line import SightLine
from aurora_core.knowledge.map_types import Building
from aurora_core.knowledge.world import SurfaceKind, WorldModel
from aurora_core.spec.reference import APPROACH, LANDMARK, is_landmark
from aurora_core.spec.vocabulary import Place

FloatArray = npt.NDArray[np.float64]

# Nobody asks for a greater distance from a crosswalk (m).
_FAR_M = 1000.0


class WorldGeometry:
    """Sight, obstacles, zones and ground of one world; shared by executor and monitor.

    Args:
        world: The measured world.
        sight_line: Its buildings as occluders, when that exists already.
    """

    def __init__(self, world: WorldModel, sight_line: SightLine | None = None) -> None:
        self.world = world
        self._lines: dict[str, SightLine] = {}
        if sight_line is not None:
            self.sight_line = sight_line
            self.sight = sight_line.model

    @cached_property
    def _buildings(self) -> tuple[Prism, ...]:
        return tuple(
            Prism(
                building.id,
                np.asarray(building.ring, dtype=np.float64),
                tuple(np.asarray(hole, dtype=np.float64) for hole in building.holes),
                0.0,
                building.height_m,
            )
            for building in self.world.buildings
        )

    @cached_property
    def sight(self) -> SightModel:
        """Buildings as occluders."""
        return SightModel(self._buildings)

    @cached_property
    def sight_line(self) -> SightLine:
        """The same for one line at a time."""
        return SightLine(self.sight)

    @cached_property
    def obstacles(self) -> ObstacleField:
        """Buildings as obstacles."""
        return ObstacleField(self._buildings)

    @cached_property
    def zones(self) -> ObstacleField:
        """No-fly zones: the same solids as obstacles, from floor to ceiling, but of air."""
        return ObstacleField(
            Prism(
                zone.id,
                np.asarray(zone.ring, dtype=np.float64),
                (),
                zone.floor_m,
                zone.ceiling_m,
            )
            for zone in self.world.no_fly_zones
        )

    def surfaces(self, kind: SurfaceKind) -> PolygonSet:
        """Ground of one kind."""
        return self._surfaces[kind]

    @cached_property
    def _surfaces(self) -> dict[SurfaceKind, PolygonSet]:
        return {
            kind: PolygonSet(
                Polygon(
                    np.asarray(surface.ring, dtype=np.float64),
                    tuple(np.asarray(hole, dtype=np.float64) for hole in surface.holes),
                )
                for surface in self.world.surfaces
                if surface.kind is kind
            )
            for kind in SurfaceKind
        }

    def crosswalk_distance(self, xy: FloatArray) -> FloatArray:
        """Return the distance (T,) of points (T, 2) from the crosswalk of the scenario, metres.

        0 on it; of a world without the outline of one, that from its middle.
        """
        if self._crosswalk is not None:
            return np.maximum(0.0, self._crosswalk.signed_distance(xy, _FAR_M))
        x, y = self.place_point(Place.CROSSWALK) or (np.inf, np.inf)
        return norm2_array(xy[:, 0] - x, xy[:, 1] - y)

    @cached_property
    def _crosswalk(self) -> PolygonSet | None:
        point = self.place_point(Place.CROSSWALK)
        rings = [
            np.asarray(surface.ring, dtype=np.float64)
            for surface in self.world.surfaces
            if surface.kind is SurfaceKind.CROSSING
        ]
        if point is None or not rings:
            return None
        near = min(rings, key=lambda ring: norm2(*(ring.mean(axis=0) - point).tolist()))
        return PolygonSet([Polygon(near)])

    def place_point(self, place: str) -> tuple[float, float] | None:
        """Return the position of a place of this world, None when it has none of that name.

        Args:
            place: `landmark:<name>`, or a kind of place as the scenario was grounded.
        """
        return self._points.get(place)

    def approach_point(self, place: str) -> tuple[float, float] | None:
        """Return where a body on the ground is at a place: before the building that it is."""
        near = self._points.get(f'{APPROACH}{place.removeprefix(LANDMARK)}')
        return near if near is not None and is_landmark(place) else self.place_point(place)

    def is_itself(self, place: str) -> bool:
        """Tell whether a landmark is in its building; older worlds have the road before it."""
        return f'{APPROACH}{place.removeprefix(LANDMARK)}' in self._points

    def sight_to(self, place: str) -> SightLine:
        """Return what hides a body or place: all buildings but the one that a landmark is."""
        point = self.place_point(place) if is_landmark(place) else None
        model = self.sight if point is None else self.sight.around(*point)
        if model is self.sight:
            return self.sight_line
        if place not in self._lines:
            self._lines[place] = SightLine(model)
        return self._lines[place]

    @cached_property
    def _points(self) -> dict[str, tuple[float, float]]:
        return {place.name: (place.x_m, place.y_m) for place in reversed(self.world.places)}

    def building_of(self, place: str) -> Building | None:
        """Return the building that a landmark is, None for all other places."""
        name = place.removeprefix(LANDMARK) if is_landmark(place) else ''
        return next((b for b in self.world.buildings if name and b.name == name), None)
