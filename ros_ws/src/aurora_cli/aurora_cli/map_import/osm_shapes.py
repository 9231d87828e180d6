# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Shapes of OpenStreetMap elements in map metres: rings, multipolygons, points."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import shapely

from aurora_cli.map_import.frame import Frame
from aurora_cli.map_import.osm_data import OsmData, OsmRelation, Tags
from aurora_core.errors import MapError

Point = tuple[float, float]
_NAMES = ('name', 'name:en')
# Outlines cross themselves by mistake, here and there; to mend them takes longer with each.
_MOST_CROSSINGS = 1000
_AT_ONCE = 4
_TOWNS = ('city', 'town', 'village', 'suburb', 'borough')


@dataclass(frozen=True, slots=True)
class OsmArea:
    """A tagged area; `id` is `w<way>` or `r<relation>`."""

    id: str
    shape: shapely.Geometry
    tags: Tags


class OsmShapes:
    """Turns the elements of an extract into shapes.

    Args:
        data: Extract.
        frame: Frame of the map.
    """

    def __init__(self, data: OsmData, frame: Frame) -> None:
        self._data = data
        ids = list(data.positions)
        degrees = np.array(list(data.positions.values()), dtype=float).reshape(-1, 2)
        x, y = frame.to_map().transform(degrees[:, 0], degrees[:, 1])
        self._crossings_left = 2 * _MOST_CROSSINGS  # each is found from both sides
        self._points: dict[int, Point] = dict(
            zip(ids, zip(x.tolist(), y.tolist(), strict=True), strict=True)
        )

    def towns(self) -> frozenset[str]:
        """Return the names of towns: of those that lie in the extract, and in its addresses."""
        data = self._data
        nodes = data.node_tags.values()
        ways = (way.tags for way in data.ways.values())
        named = {tags.get('addr:city', '') for tags in (*nodes, *ways)}
        named |= {
            tags[key]
            for tags in nodes
            if tags.get('place') in _TOWNS
            for key in _NAMES
            if key in tags
        }
        return frozenset(named - {''})

    def points(self) -> Iterator[tuple[str, Point, Tags]]:
        """Return id, position and tags of the tagged nodes."""
        for node, tags in sorted(self._data.node_tags.items()):
            if node in self._points:
                yield f'n{node}', self._points[node], tags

    def areas(self, wanted: Iterable[str]) -> Iterator[OsmArea]:
        """Return the closed ways and the multipolygons that have one of the tags, by id.

        Raises:
            MapError: Their outlines cross themselves without end.
        """
        keys = frozenset(wanted)
        in_relations: set[int] = set()
        for relation in sorted(self._data.relations.values(), key=lambda r: r.id):
            tags = relation.tags
            if tags.get('type') != 'multipolygon' or not keys & tags.keys():
                continue
            shape = self._multipolygon(relation)
            if not shape.is_empty:
                in_relations.update(i for kind, i, _ in relation.members if kind == 'way')
                yield OsmArea(f'r{relation.id}', shape, tags)
        for way in sorted(self._data.ways.values(), key=lambda w: w.id):
            if way.is_ring and keys & way.tags.keys() and way.id not in in_relations:
                ring = shapely.LinearRing(self._line(way.nodes))
                self._count_crossings(ring)
                shape = polygons(shapely.Polygon(ring))
                if not shape.is_empty:
                    yield OsmArea(f'w{way.id}', shape, way.tags)

    def _line(self, nodes: Iterable[int]) -> list[Point]:
        points = [self._points[n] for n in nodes if n in self._points]
        # An extract that was cut may lack nodes: fewer than three make no ring.
        return points if len(points) >= 3 else [(0.0, 0.0)] * 4

    def _multipolygon(self, relation: OsmRelation) -> shapely.Geometry:
        outer = self._rings(relation, ('outer', ''))
        inner = self._rings(relation, ('inner',))
        return polygons(shapely.union_all(outer).difference(shapely.union_all(inner)))

    def _rings(self, relation: OsmRelation, roles: tuple[str, ...]) -> list[shapely.Geometry]:
        lines = []
        for kind, way_id, role in relation.members:
            way = self._data.ways.get(way_id)
            if kind == 'way' and role in roles and way is not None:
                points = [self._points[n] for n in way.nodes if n in self._points]
                if len(points) >= 2:
                    lines.append(shapely.LineString(points))
        if not lines:
            return []
        self._count_crossings(shapely.MultiLineString(lines))
        whole = shapely.polygonize([shapely.union_all(lines)])
        return [polygons(part) for part in shapely.get_parts(whole)]

    def _count_crossings(self, lines: shapely.Geometry) -> None:
        """Take the crossings of lines with themselves from those that a map may have."""
        if lines.is_simple:
            return
        segments = [
            shapely.LineString(pair)
            for line in shapely.get_parts(lines)
            for pair in pairwise(line.coords)
            if pair[0] != pair[1]
        ]
        tree = shapely.STRtree(segments)
        for start in range(0, len(segments), _AT_ONCE):
            found = tree.query(segments[start : start + _AT_ONCE], predicate='crosses')
            self._crossings_left -= found.shape[1]
            if self._crossings_left < 0:
                raise MapError(
                    'outlines of buildings and areas cross themselves more than '
                    f'{_MOST_CROSSINGS} times',
                    hint='export it again, or cut out a smaller part',
                )


def polygons(shape: shapely.Geometry) -> shapely.Geometry:
    """Return the valid polygons of a shape; empty where there are none."""
    if not shape.is_valid:
        shape = shapely.make_valid(shape)
    parts = [p for p in shapely.get_parts(shape) if p.geom_type == 'Polygon' and p.area > 0.0]
    if any(p.geom_type.startswith(('Multi', 'Geometry')) for p in shapely.get_parts(shape)):
        parts += [
            q
            for p in shapely.get_parts(shape)
            for q in shapely.get_parts(p)
            if p.geom_type != 'Polygon' and q.geom_type == 'Polygon'
        ]
    return shapely.MultiPolygon(parts)
