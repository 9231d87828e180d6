# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`LaneSamples`: what is around every ten metres of every lane of a map, as arrays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any, Self

import numpy as np
import numpy.typing as npt
import shapely

from aurora_core.errors import MapError
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Building
from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int32]
SmallFloats = npt.NDArray[np.float32]
Table = npt.NDArray[Any]

SPACING_M = 10.0
# How far a walkway or a building is looked for.
WALKWAY_REACH_M = 20.0
BUILDING_REACH_M = 60.0
# Values are kept to this, which is far below what a lane is wide.
_RESOLUTION_M = 0.01
# Headings of two lanes that are beside each other and opposite differ by more (cosine).
_AGAINST = -0.9
_OPPOSITE_REACH_M = 30.0
NO_LANE = -1


@dataclass(frozen=True, kw_only=True)
class LaneSamples:
    """Samples in the order of lanes and along each; arrays have one entry per sample.

    Lanes are named by their place in `lane_ids`, `NO_LANE` where there is none; distances are in
    metres along the lane or straight, infinite where nothing is within reach.

    Attributes:
        lane_ids: Lanes that some vehicle may drive on, outside junctions, sorted.
        lane: Lane of each sample.
        arc_m: Place on its centre line.
        x_m: East (y_m north), ENU map frame.
        heading_x: Unit heading, east (heading_y north).
        left: Lane to the left for vehicles (right: to the right), same direction.
        opposite: Nearest lane of the other direction of the same street.
        limit_mps: Speed limit.
        junction_m: Way to the junction at the end of the lane.
        crossing_m: Way to the crossing in front of that junction's middle.
        walkway_m: Distance to the nearest walkway.
        building_m: Distance to the nearest building.
    """

    lane_ids: tuple[str, ...]
    lane: IntArray
    arc_m: SmallFloats
    x_m: SmallFloats
    y_m: SmallFloats
    heading_x: SmallFloats
    heading_y: SmallFloats
    left: IntArray
    right: IntArray
    opposite: IntArray
    limit_mps: SmallFloats
    junction_m: SmallFloats
    crossing_m: SmallFloats
    walkway_m: SmallFloats
    building_m: SmallFloats

    def __len__(self) -> int:
        return len(self.lane)

    def arrays(self) -> dict[str, Table]:
        """Return everything as arrays, by name."""
        named = {f.name: getattr(self, f.name) for f in fields(self) if f.name != 'lane_ids'}
        return {'lane_ids': np.array(self.lane_ids, dtype=np.str_), **named}

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, Table]) -> Self:
        """Return samples from their arrays.

        Raises:
            MapError: An array is missing, or has another length than the others.
        """
        try:
            rows = {f.name: arrays[f.name] for f in fields(cls) if f.name != 'lane_ids'}
            ids = tuple(str(name) for name in arrays['lane_ids'])
        except KeyError as err:
            raise MapError(f'lane samples lack the array {err}') from err
        if len({row.shape for row in rows.values()}) != 1:
            raise MapError('the arrays of lane samples have different lengths')
        return cls(lane_ids=ids, **rows)

    @cached_property
    def first(self) -> Mapping[str, tuple[int, int]]:
        """First sample of each lane and the one after its last."""
        starts = np.searchsorted(self.lane, np.arange(len(self.lane_ids) + 1))
        return {name: (int(starts[k]), int(starts[k + 1])) for k, name in enumerate(self.lane_ids)}

    def nearest(self, lane_id: str, arc_m: float) -> int | None:
        """Return the sample of a lane that is nearest to a place on it; None: no such lane."""
        span = self.first.get(lane_id)
        if span is None or span[0] == span[1]:
            return None
        return span[0] + int(np.abs(self.arc_m[span[0] : span[1]] - arc_m).argmin())

    def right_of(self, lane_id: str) -> str | None:
        """Return the lane for vehicles to the right of one; None: there is none."""
        return self._named(self.right, self.nearest(lane_id, 0.0))

    def opposite_of(self, lane_id: str, arc_m: float) -> str | None:
        """Return the nearest lane of the other direction beside a place; None: there is none."""
        return self._named(self.opposite, self.nearest(lane_id, arc_m))

    def _named(self, lanes: IntArray, sample: int | None) -> str | None:
        if sample is None or lanes[sample] == NO_LANE:
            return None
        return self.lane_ids[int(lanes[sample])]


def sampled_lanes(network: RoadNetwork) -> tuple[Lane, ...]:
    """Return the lanes outside junctions that some vehicle may drive on."""
    return tuple(
        lane for lane in network.lanes.values() if not lane.is_internal and _is_driven(lane)
    )


def sample_arcs(length_m: float) -> FloatArray:
    """Return where a lane is sampled: in the middle of pieces of ten metres, at least once."""
    count = max(1, int(length_m / SPACING_M))
    piece_m = SPACING_M if count > 1 else length_m
    return np.asarray((np.arange(count) + 0.5) * piece_m, dtype=np.float64)


def sample_lanes(model: MapModel) -> LaneSamples:
    """Sample the lanes of a map."""
    network = model.network
    lanes = sampled_lanes(network)
    number = {lane.id: k for k, lane in enumerate(lanes)}
    arcs = [sample_arcs(lane.arc_length_m) for lane in lanes]
    counts = [len(a) for a in arcs]
    places = np.concatenate(
        [lane.line.at_each(a) for lane, a in zip(lanes, arcs, strict=True)] or [np.zeros((0, 4))]
    )
    arc_m = np.concatenate([*arcs, np.zeros(0)])
    length_m = np.repeat([lane.arc_length_m for lane in lanes], counts)
    xy = places[:, :2]
    crossing_m = np.repeat([_crossing_behind(network, lane) for lane in lanes], counts)
    return LaneSamples(
        lane_ids=tuple(lane.id for lane in lanes),
        lane=_repeated(range(len(lanes)), counts),
        arc_m=_kept(arc_m),
        x_m=_kept(xy[:, 0]),
        y_m=_kept(xy[:, 1]),
        heading_x=_kept(places[:, 2], 1e-4),
        heading_y=_kept(places[:, 3], 1e-4),
        left=_repeated([_beside(lane.left_lane_id, number) for lane in lanes], counts),
        right=_repeated([_beside(lane.right_lane_id, number) for lane in lanes], counts),
        opposite=_opposite(network, lanes, number, counts, places),
        limit_mps=_kept(np.repeat([lane.speed_limit_mps for lane in lanes], counts)),
        junction_m=_kept(length_m - arc_m),
        crossing_m=_kept(length_m - arc_m + crossing_m),
        walkway_m=_kept(_walkway_m(network, xy)),
        building_m=_kept(_building_m(xy, model.buildings)),
    )


def _is_driven(lane: Lane) -> bool:
    return bool(lane.allows - {'pedestrian'})


def _repeated(values: Sequence[int] | range, counts: Sequence[int]) -> IntArray:
    return np.repeat(np.asarray(values, dtype=np.int32), counts)


def _kept(values: FloatArray, resolution: float = _RESOLUTION_M) -> SmallFloats:
    return (np.round(values / resolution) * resolution).astype(np.float32)


def _beside(lane_id: str | None, number: Mapping[str, int]) -> int:
    return NO_LANE if lane_id is None else number.get(lane_id, NO_LANE)


def _crossing_behind(network: RoadNetwork, lane: Lane) -> float:
    """Return how far behind the end of a lane the nearest crossing of its street is."""
    edge = network.edge(lane.edge_id)
    end = shapely.Point(lane.polyline[-1])
    ways = [
        float(shapely.distance(end, shapely.LineString(crossing.centre_line)))
        for crossing in network.crossings
        if crossing.junction_id == edge.to_junction and edge.id in crossing.edge_ids
    ]
    return min(ways, default=np.inf)


def _opposite(
    network: RoadNetwork,
    lanes: Sequence[Lane],
    number: Mapping[str, int],
    counts: Sequence[int],
    places: FloatArray,
) -> IntArray:
    """Return the nearest lane of the other direction at each sample."""
    found = np.full(len(places), NO_LANE, dtype=np.int32)
    others: dict[str, tuple[Lane, ...]] = {}
    start = 0
    for lane, count in zip(lanes, counts, strict=True):
        if lane.edge_id not in others:
            edge_id = network.opposite_edge(lane.edge_id)
            ids = () if edge_id is None else network.edge(edge_id).lane_ids
            others[lane.edge_id] = tuple(network.lane(i) for i in ids if i in number)
        for row in range(start, start + count):
            x, y, hx, hy = places[row]
            options = []
            for other in others[lane.edge_id]:
                arc_m, aside_m = other.line.project(float(x), float(y))
                _, _, ox, oy = other.line.at(min(max(arc_m, 0.0), other.arc_length_m))
                if hx * ox + hy * oy < _AGAINST and abs(aside_m) < _OPPOSITE_REACH_M:
                    options.append((abs(aside_m), number[other.id]))
            if options:
                found[row] = min(options)[1]
        start += count
    return found


def _walkway_m(network: RoadNetwork, xy: FloatArray) -> FloatArray:
    lines = [shapely.LineString(lane.polyline) for lane in network.sidewalks]
    return _nearest_m(xy, lines, WALKWAY_REACH_M)


def _building_m(xy: FloatArray, buildings: Sequence[Building]) -> FloatArray:
    return _nearest_m(xy, [shapely.Polygon(b.ring, b.holes) for b in buildings], BUILDING_REACH_M)


def _nearest_m(xy: FloatArray, shapes: Sequence[shapely.Geometry], reach_m: float) -> FloatArray:
    """Return how far points are from the nearest shape, infinite where none is within reach."""
    distance_m = np.full(len(xy), np.inf)
    if shapes and len(xy):
        (row, _), found = shapely.STRtree(shapes).query_nearest(
            shapely.points(xy), max_distance=reach_m, return_distance=True, all_matches=False
        )
        distance_m[row] = found
    return distance_m
