# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ground surfaces of a road network as polygons."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import shapely

from aurora_core.knowledge.net_types import Lane, NetworkData, Points

_WALKERS = frozenset({'pedestrian'})


def carriageway(data: NetworkData) -> shapely.MultiPolygon:
    """Return the lanes that some vehicle may use with the junctions, less the walkers' corners."""
    parts = [_lane(lane) for lane in data.lanes if lane.allows - _WALKERS and not lane.is_internal]
    parts += _polygons(junction.shape for junction in data.junctions)
    corners = shapely.union_all(_polygons(data.walking_areas))
    return union([shapely.union_all(parts).difference(corners)])


def sidewalk_area(data: NetworkData) -> shapely.MultiPolygon:
    """Return the sidewalks with the walkers' corners at junctions."""
    parts = [
        _lane(lane) for lane in data.lanes if lane.allows == _WALKERS and not lane.is_internal
    ]
    return union([*parts, *_polygons(data.walking_areas)])


def parking_area(data: NetworkData) -> shapely.MultiPolygon:
    """Return the kerbside strips that no class may drive on."""
    return union([_lane(lane) for lane in data.lanes if not lane.allows and not lane.is_internal])


def union(geometries: Sequence[shapely.Geometry]) -> shapely.MultiPolygon:
    """Return the union, its polygons in a fixed order, anything thinner dropped."""
    whole = shapely.get_parts(shapely.union_all(geometries))
    parts = [p for p in whole if p.geom_type == 'Polygon' and not p.is_empty]
    return shapely.MultiPolygon(sorted(parts, key=lambda p: p.bounds))


def _lane(lane: Lane) -> shapely.Geometry:
    line = shapely.LineString(lane.polyline)
    return shapely.buffer(line, lane.width_m / 2.0, cap_style='flat', join_style='mitre')


def _polygons(shapes: Iterable[Points]) -> list[shapely.Geometry]:
    return [shapely.make_valid(shapely.Polygon(shape)) for shape in shapes if len(shape) >= 3]
