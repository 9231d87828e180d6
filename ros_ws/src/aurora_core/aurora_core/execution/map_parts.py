# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What every run on a map shares, built once: its share of the recorded world, and its solids."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely

from aurora_core.geometry.sight_line import SightLine
from aurora_core.grounding.airspace import Airspace
from aurora_core.grounding.places import approach_point
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Landmark
from aurora_core.knowledge.world import CentreLine, SignalPost, Surface, SurfaceKind
from aurora_core.spec.reference import APPROACH, LANDMARK


@dataclass(frozen=True, slots=True, kw_only=True)
class MapParts:
    """Parts of a map.

    Attributes:
        airspace: What stands in the way of a flight.
        sight_line: Its buildings as occluders.
        surfaces: Carriageways and crossings.
        sidewalks: Recorded where a request speaks of them.
        lanes: Centre lines for cars.
        signals: Junctions with signals.
        landmarks: x, y in m by `landmark:<name>`, and by `approach:<name>` where one that is in
            a building is reached on the road.
        grounds: The same of areas and bus stops; recorded where a request names them.
    """

    airspace: Airspace
    sight_line: SightLine
    surfaces: tuple[Surface, ...]
    sidewalks: tuple[Surface, ...]
    lanes: tuple[CentreLine, ...]
    signals: tuple[SignalPost, ...]
    landmarks: dict[str, tuple[float, float]]
    grounds: dict[str, tuple[float, float]]


def map_parts(map_model: MapModel, airspace: Airspace | None = None) -> MapParts:
    """Return the parts of a map, with its airspace when that exists already."""
    network = map_model.network
    if airspace is None:
        airspace = Airspace(map_model.buildings, map_model.zones)
    crossings = (
        Surface(surface_id=c.id, kind=SurfaceKind.CROSSING, ring=np.array(c.polygon))
        for c in network.crossings
    )
    driving = _areas('carriageway', SurfaceKind.DRIVING, network.carriageway)
    return MapParts(
        airspace=airspace,
        sight_line=SightLine(airspace.sight),
        surfaces=(*driving, *crossings),
        sidewalks=_areas('sidewalk', SurfaceKind.SIDEWALK, network.sidewalk_area),
        lanes=tuple(
            CentreLine(
                lane_id=lane.id,
                street_name=network.edge(lane.edge_id).street_name,
                points=np.array(lane.polyline),
                width_m=lane.width_m,
                speed_limit_mps=lane.speed_limit_mps,
            )
            for lane in network.driving_lanes('passenger')
        ),
        signals=tuple(
            SignalPost(junction_id=j.id, x_m=j.x_m, y_m=j.y_m)
            for j in sorted(network.junctions.values(), key=lambda j: j.id)
            if j.has_signal
        ),
        landmarks=dict(_landmarks(map_model, map_model.landmarks)),
        grounds=dict(_landmarks(map_model, map_model.grounds)),
    )


def _landmarks(
    map_model: MapModel, marks: Iterable[Landmark]
) -> Iterator[tuple[str, tuple[float, float]]]:
    for mark in marks:
        here, before = (mark.x_m, mark.y_m), approach_point(map_model, mark.name)
        yield f'{LANDMARK}{mark.name}', here
        if before != here:
            yield f'{APPROACH}{mark.name}', before


def _areas(name: str, kind: SurfaceKind, area: shapely.MultiPolygon) -> tuple[Surface, ...]:
    if area.is_empty:
        return ()
    _, points, (ends, rings, _) = shapely.to_ragged_array([area])
    # Without the last point of each ring, which is its first one.
    lines = [points[a : b - 1].copy() for a, b in itertools.pairwise(ends.tolist())]
    return tuple(
        Surface(surface_id=f'{name}_{k}', kind=kind, ring=lines[a], holes=tuple(lines[a + 1 : b]))
        for k, (a, b) in enumerate(itertools.pairwise(rings.tolist()))
    )
