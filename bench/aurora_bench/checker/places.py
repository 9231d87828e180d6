# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where the named and the general places of a recorded world are."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from aurora_bench.checker.junctions import junctions
from aurora_bench.checker.recording import FloatArray, Lane, World

GENERAL = ('intersection', 'crosswalk', 'sidewalk', 'roadside', 'main_road')
LANDMARK = 'landmark:'
# Where one comes to a landmark on the road.
APPROACH = 'approach:'
# A landmark so near to its building is at it.
BESIDE_M = 1.0


@dataclass(frozen=True, slots=True)
class Spot:
    """One place that a name can mean: its position and its outline (None: a bare point)."""

    x_m: float
    y_m: float
    outline: Any | None = None

    @property
    def xy(self) -> FloatArray:
        """Return the position."""
        return np.array([self.x_m, self.y_m])


class Places:
    """Looks names of places up; a kind of place (a crosswalk) has many spots.

    Args:
        world: The recorded world.
    """

    def __init__(self, world: World) -> None:
        self.world = world

    @functools.cache  # noqa: B019 - lives as long as one check
    def spots(self, name: str) -> tuple[Spot, ...]:
        """Return all spots of a name, those that the run chose first; none when it is unknown."""
        folded = name.casefold().strip()
        chosen = [
            Spot(x, y)
            for n, x, y in self.world.places
            if n.casefold().removeprefix(LANDMARK) == folded
        ]
        match folded:
            case 'intersection':
                near = [s for s in chosen if self._at_junction(s)]
                return (*near, *self._junctions())
            case 'crosswalk':
                crossings = tuple(_spot(p) for _, p in self.world.crossings)
                near = [s for s in chosen if any(_off(s, c) <= 3.0 for c in crossings)]
                return (*near, *crossings)
            case 'sidewalk':
                return tuple(_spot(p) for _, p in self.world.sidewalks)
            case 'roadside':
                return tuple(_spot(p.boundary.buffer(3.0)) for _, p in self.world.driving)
            case 'main_road':
                return tuple(
                    _spot(shapely.LineString(lane.xy_m).buffer(lane.width_m / 2.0))
                    for lane in self.main_lanes()
                )
        outlines = [b.polygon for b in self.world.buildings if b.name.casefold() == folded]
        if chosen:
            return tuple(_landmark(s, outlines) for s in chosen)
        if outlines:
            return tuple(_spot(p) for p in outlines)
        street = [lane for lane in self.world.lanes if lane.street.casefold() == folded]
        return tuple(
            _spot(shapely.LineString(lane.xy_m).buffer(lane.width_m / 2.0)) for lane in street
        )

    def known(self, name: str) -> bool:
        """Return whether the world has a place of this name or kind."""
        return bool(self.spots(name))

    def is_region(self, name: str) -> bool:
        """Return whether a name means any point of an area rather than a position."""
        folded = name.casefold().strip()
        return folded in {'sidewalk', 'roadside', 'main_road'} or any(
            lane.street.casefold() == folded for lane in self.world.lanes
        )

    def chosen(self, name: str) -> tuple[Spot, ...]:
        """Return the spots that the run itself chose for a kind of place, else all."""
        spots = self.spots(name)
        if name.casefold().strip() in {'intersection', 'crosswalk'}:
            own = tuple(s for s in spots if s.outline is None)
            return own or spots
        return spots

    @functools.cache  # noqa: B019
    def area(self, name: str) -> Any:
        """Return the union of the outlines of a name (empty when it has none)."""
        return shapely.union_all([s.outline for s in self.spots(name) if s.outline is not None])

    def approaches(self, name: str) -> tuple[Spot, ...]:
        """Return where one comes to a landmark on the road."""
        folded = f'{APPROACH}{name.casefold().strip().removeprefix(LANDMARK)}'
        return tuple(Spot(x, y) for n, x, y in self.world.places if n.casefold() == folded)

    def distance(self, name: str, xy: FloatArray) -> FloatArray:
        """Return (n,) metres from points to the nearest position (of an area: to the area)."""
        if not self.known(name):
            return np.full(len(xy), np.nan)
        if self.is_region(name):
            return self.outline_distance(name, xy)
        spots = np.array([s.xy for s in self.chosen(name)])
        return np.asarray(np.linalg.norm(xy[:, None] - spots[None], axis=2).min(axis=1))

    def outline_distance(self, name: str, xy: FloatArray, *, on_road: bool = False) -> FloatArray:
        """Return (n,) metres from points to the nearest outline; 0 inside, to a bare position.

        Args:
            name: The place.
            xy: (n, 2) the points.
            on_road: They are of a body on the ground that is to be at the place: it may be where
                the road comes to it.
        """
        best = np.full(len(xy), np.inf)
        if not self.area(name).is_empty:
            best = np.asarray(shapely.distance(self.area(name), shapely.points(xy)))
        for spot in (*self.spots(name), *(self.approaches(name) if on_road else ())):
            if spot.outline is None or not self.is_region(name):
                best = np.minimum(best, np.linalg.norm(xy - spot.xy, axis=1))
        return best

    def main_lanes(self) -> tuple[Lane, ...]:
        """Return the lanes that surely belong to a main road.

        The contract does not say which road is one: they are the widest and fastest of the map,
        and whatever street the run has marked as one.
        """
        lanes = self.world.lanes
        marked = [(x, y) for n, x, y in self.world.places if n.casefold() == 'main_road']
        if not lanes:
            return ()
        fastest = max(lane.limit_mps for lane in lanes)
        streets = {lane.street for lane in lanes if lane.limit_mps >= fastest - 0.01}
        for x, y in marked:
            nearest = min(lanes, key=lambda c: _line_distance(c, x, y))
            streets.add(nearest.street)
        return tuple(lane for lane in lanes if lane.street in streets)

    @functools.cache  # noqa: B019
    def carriageway(self) -> Any:
        """Return all ground that vehicles drive on."""
        return shapely.union_all([p for _, p in self.world.driving])

    @functools.cache  # noqa: B019
    def road(self) -> Any:
        """Return carriageways and crossings together."""
        parts = [p for _, p in (*self.world.driving, *self.world.crossings)]
        return shapely.union_all(parts)

    def _at_junction(self, spot: Spot) -> bool:
        junctions = self._junctions()
        return not junctions or any(_off(spot, j) <= 5.0 for j in junctions)

    @functools.cache  # noqa: B019
    def _junctions(self) -> tuple[Spot, ...]:
        """Return where lanes of three or more arms meet, and every signalled junction."""
        found = junctions(self.world.lanes, self.carriageway())
        spots = [Spot(x, y, outline) for x, y, outline in found]
        alone = [
            Spot(x, y, shapely.Point(x, y).buffer(10.0))
            for _, x, y in self.world.signals
            if not any(np.hypot(x - s.x_m, y - s.y_m) < 30.0 for s in spots)
        ]
        return (*spots, *alone)


def _spot(polygon: Any) -> Spot:
    centre = polygon.centroid
    return Spot(float(centre.x), float(centre.y), polygon)


def _off(spot: Spot, other: Spot) -> float:
    """Return how far a position is outside of the outline of another spot."""
    return float(shapely.distance(shapely.Point(spot.x_m, spot.y_m), other.outline))


def _landmark(spot: Spot, outlines: list[Any]) -> Spot:
    """Return a landmark with its outline: a point beside its building is none that it is at."""
    point = shapely.Point(spot.x_m, spot.y_m)
    outline = min(outlines, key=lambda o: o.distance(point), default=None)
    if outline is not None and outline.distance(point) > BESIDE_M:
        return _spot(outline)
    return Spot(spot.x_m, spot.y_m, outline)


def _line_distance(lane: Lane, x: float, y: float) -> float:
    return float(shapely.LineString(lane.xy_m).distance(shapely.Point(x, y)))
