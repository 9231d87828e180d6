# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places of an OpenStreetMap extract that people name, and named ground."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import shapely

from aurora_cli.map_import.osm_data import Tags
from aurora_cli.map_import.osm_shapes import OsmArea, OsmShapes, Point
from aurora_cli.map_import.text import plain_name
from aurora_core.knowledge.map_types import Area, BusStop, Landmark
from aurora_core.knowledge.reach import Reach
from aurora_core.parsing.landmarks import is_plain_word, landmark_words

# Key, value (empty: any) and what the place is called here; the first that fits counts.
_KINDS: tuple[tuple[str, str, str], ...] = (
    ('amenity', 'hospital', 'hospital'),
    ('amenity', 'clinic', 'hospital'),
    ('amenity', 'fire_station', 'fire_station'),
    ('amenity', 'police', 'police_station'),
    ('amenity', 'townhall', 'city_hall'),
    ('amenity', 'school', 'school'),
    ('amenity', 'university', 'school'),
    ('amenity', 'college', 'school'),
    ('amenity', 'kindergarten', 'school'),
    ('amenity', 'marketplace', 'market'),
    ('amenity', 'bus_station', 'station'),
    ('amenity', 'ferry_terminal', 'station'),
    ('amenity', 'library', 'library'),
    ('amenity', 'place_of_worship', 'church'),
    ('amenity', 'theatre', 'theatre'),
    ('amenity', 'cinema', 'theatre'),
    ('amenity', 'courthouse', 'courthouse'),
    ('amenity', 'post_office', 'post_office'),
    ('amenity', 'embassy', 'embassy'),
    ('amenity', 'fuel', 'fuel_station'),
    ('amenity', 'fountain', 'monument'),
    ('railway', 'station', 'station'),
    ('railway', 'halt', 'station'),
    ('building', 'train_station', 'station'),
    ('building', 'church', 'church'),
    ('building', 'cathedral', 'church'),
    ('building', 'stadium', 'stadium'),
    ('leisure', 'stadium', 'stadium'),
    ('leisure', 'park', 'park'),
    ('leisure', 'garden', 'park'),
    ('leisure', 'sports_centre', 'sports_centre'),
    ('place', 'square', 'square'),
    ('highway', 'pedestrian', 'square'),
    ('tourism', 'museum', 'museum'),
    ('tourism', 'gallery', 'museum'),
    ('tourism', 'hotel', 'hotel'),
    ('tourism', 'attraction', 'attraction'),
    ('historic', '', 'monument'),
    ('man_made', 'tower', 'tower'),
    ('shop', 'mall', 'market'),
    ('shop', 'department_store', 'market'),
    ('shop', 'supermarket', 'market'),
    ('building', '', 'building'),
)
_KEYS = tuple(dict.fromkeys(key for key, _, _ in _KINDS))
_GROUND = {
    ('leisure', 'park'): 'park',
    ('leisure', 'garden'): 'park',
    ('place', 'square'): 'plaza',
    ('highway', 'pedestrian'): 'plaza',
    ('amenity', 'school'): 'school_zone',
    ('aeroway', 'helipad'): 'helipad',
    ('natural', 'water'): 'water',
}
_MOST_LANDMARKS = 400
# From farther away nobody says that a vehicle is there.
_REACH_M = 150.0
_LEAST_GROUND_M2 = 100.0
# A paved area for walkers that is longer than so many times its width is a street, no square.
_LONGEST_SQUARE = 3.0
# A stop's sign stands on the walkway beside its lane.
_STOP_REACH_M = 15.0
_STOP_LENGTH_M = 15.0


@dataclass(frozen=True, slots=True)
class _Candidate:
    rank: tuple[int, float, str]
    name: str
    kind: str
    at: Point


def landmarks(shapes: OsmShapes, reach: Reach, extent: shapely.Geometry) -> tuple[Landmark, ...]:
    """Return the named places, each with the lane from which a vehicle reaches it.

    Of places with one name the most notable stays, then the largest. A name that prompts use for
    something else (`Taxi`) is left out, and so are a name of the town itself and a place that no
    street passes within 150 m.

    Args:
        shapes: Shapes of the extract.
        reach: Lanes that vehicles can reach and leave again.
        extent: Area of the map.
    """
    taken: set[tuple[str, ...]] = set()
    found: list[Landmark] = []
    towns = {landmark_words(plain_name(name)) for name in shapes.towns()}
    for one in sorted(_candidates(shapes), key=lambda c: (c.rank, c.name)):
        words = landmark_words(one.name)
        if words in taken | towns or is_plain_word(words) or len(found) >= _MOST_LANDMARKS:
            continue
        nearest = reach.nearest(*one.at)
        if (
            nearest is None
            or nearest.distance_m > _REACH_M
            or not extent.intersects(shapely.Point(one.at))
        ):
            continue
        taken.add(words)
        found.append(
            Landmark(
                name=one.name,
                kind=one.kind,
                x_m=round(one.at[0], 1),
                y_m=round(one.at[1], 1),
                approach_lane_id=nearest.lane_id,
                approach_pos_m=math.floor(nearest.pos_m * 10.0) / 10.0,
            )
        )
    return tuple(sorted(found, key=lambda mark: mark.name))


def _candidates(shapes: OsmShapes) -> Iterator[_Candidate]:
    for area in shapes.areas(_KEYS):
        if _is_walking_street(area):
            continue
        point = shapely.point_on_surface(area.shape)
        yield from _named(area.tags, (point.x, point.y), area.shape.area, area.id)
    for id_, at, tags in shapes.points():
        yield from _named(tags, at, 0.0, id_)


def _is_walking_street(area: OsmArea) -> bool:
    """Tell whether an area is a street for walkers that is drawn as an area."""
    if area.tags.get('highway') != 'pedestrian':
        return False
    box = shapely.minimum_rotated_rectangle(area.shape)
    if box.geom_type != 'Polygon':
        return True
    a, b, c, *_ = box.exterior.coords
    sides = sorted((math.dist(a, b), math.dist(b, c)))
    return sides[1] > _LONGEST_SQUARE * sides[0]


def _named(tags: Tags, at: Point, area_m2: float, id_: str) -> Iterator[_Candidate]:
    ranked = (
        (rank, kind)
        for rank, (key, value, kind) in enumerate(_KINDS)
        if tags.get(key, 'no') != 'no' and value in ('', tags[key])
    )
    rank, kind = next(ranked, (-1, ''))
    if rank < 0:
        return
    names = (plain_name(tags.get(key, '')) for key in ('name', 'name:en'))
    for name in dict.fromkeys(names):
        if len(name) > 2 and any(c.isalpha() for c in name):
            yield _Candidate((rank, -area_m2, id_), name, kind, at)


def areas(shapes: OsmShapes, extent: shapely.Geometry) -> tuple[Area, ...]:
    """Return parks, squares, school grounds, helipads and waters that have a name."""
    found = []
    for area in shapes.areas({key for key, _ in _GROUND}):
        kinds = (kind for (key, value), kind in _GROUND.items() if area.tags.get(key) == value)
        kind = '' if _is_walking_street(area) else next(kinds, '')
        name = plain_name(area.tags.get('name', ''))
        largest = max(area.shape.geoms, key=lambda p: p.area)
        outline = shapely.simplify(largest, 0.2)
        if kind and name and outline.area >= _LEAST_GROUND_M2 and extent.intersects(outline):
            ring = tuple((round(x, 1), round(y, 1)) for x, y in outline.exterior.coords[:-1])
            found.append(Area(id=area.id, name=name, kind=kind, ring=ring))
    return tuple(found)


def bus_stops(shapes: OsmShapes, reach: Reach) -> tuple[BusStop, ...]:
    """Return the bus stops beside lanes that buses use, by id.

    Args:
        shapes: Shapes of the extract.
        reach: Lanes that buses can reach and leave again.
    """
    found = []
    for id_, at, tags in shapes.points():
        nearest = reach.nearest(*at) if _is_bus_stop(tags) else None
        if nearest is None or nearest.distance_m > _STOP_REACH_M:
            continue
        # Buses stop with their front at the sign.
        end_m = math.floor(max(nearest.pos_m, min(_STOP_LENGTH_M, nearest.length_m)) * 10.0) / 10.0
        start_m = max(0.0, end_m - _STOP_LENGTH_M)
        if end_m - start_m >= 1.0:
            found.append(
                BusStop(
                    id=id_,
                    name=plain_name(tags.get('name', '')),
                    lane_id=nearest.lane_id,
                    start_pos_m=start_m,
                    end_pos_m=end_m,
                )
            )
    return tuple(found)


def _is_bus_stop(tags: Tags) -> bool:
    is_platform = tags.get('public_transport') == 'platform' and tags.get('bus') == 'yes'
    return tags.get('highway') == 'bus_stop' or is_platform
