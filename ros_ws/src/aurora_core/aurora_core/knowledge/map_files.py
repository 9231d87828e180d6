# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read GeoJSON and stops files of a map folder, and write the former.

Coordinates in them are ENU map metres, not degrees; each file says so in its member `frame`.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeVar
from xml.etree import ElementTree as Xml

from aurora_core.errors import MapError
from aurora_core.files import MAP_BYTES, read_json, read_xml
from aurora_core.knowledge.map_types import (
    Area,
    Building,
    BusStop,
    Landmark,
    NoFlyZone,
    ParkingArea,
    ParkingPlace,
)
from aurora_core.knowledge.net_types import Points
from aurora_core.knowledge.road_network import RoadNetwork

FRAME = 'enu_m'
NO_FLY = 'no_fly'
_HINT = 'restore the file; build a bundled map again with `make maps`, import your own again'

_T = TypeVar('_T')
_Feature = Mapping[str, Any]


def write_features(path: Path, features: Sequence[dict[str, Any]]) -> None:
    """Write one feature per line, coordinates in map metres: what the readers here read.

    Raises:
        OSError: No room.
    """
    lines = ',\n'.join(json.dumps(f, separators=(',', ':'), ensure_ascii=False) for f in features)
    head = f'{{"type":"FeatureCollection","frame":"{FRAME}","features":[\n'
    path.write_text(f'{head}{lines}\n]}}\n', encoding='utf-8')


def read_buildings(path: Path) -> tuple[Building, ...]:
    """Read buildings, sorted by id.

    Raises:
        MapError: When the file is missing, damaged, or a building has no outline or height.
    """
    return _sorted(_features(path, _building), path, lambda b: b.id)


def read_zones(path: Path) -> tuple[NoFlyZone, ...]:
    """Read the no-fly zones of a zones file, sorted by id.

    Raises:
        MapError: When the file is missing or damaged.
    """
    zones = _features(path, lambda f: _zone(f) if _kind(f) == NO_FLY else None)
    return _sorted(zones, path, lambda z: z.id)


def read_areas(path: Path) -> tuple[Area, ...]:
    """Read the areas other than no-fly zones of a zones file, sorted by id.

    Raises:
        MapError: When the file is missing or damaged.
    """
    areas = _features(path, lambda f: None if _kind(f) == NO_FLY else _area(f))
    return _sorted(areas, path, lambda a: a.id)


def read_landmarks(path: Path, network: RoadNetwork) -> tuple[Landmark, ...]:
    """Read landmarks, sorted by name.

    Raises:
        MapError: When the file is missing or damaged, or when a landmark is approached from no
            place on a lane of the network.
    """
    found = _features(path, _landmark)
    for mark in found:
        try:
            network.position_on_lane(mark.approach_lane_id, mark.approach_pos_m)
        except MapError as err:
            raise _damaged(path, f'{mark.name}: {err.message}') from err
    return _sorted(found, path, lambda m: m.name)


def read_stops(
    path: Path, network: RoadNetwork
) -> tuple[tuple[BusStop, ...], tuple[ParkingArea, ...]]:
    """Read bus stops and parking rows of a SUMO additional file, each sorted by id.

    Raises:
        MapError: When the file is missing or damaged or names a lane that the network lacks.
    """
    try:
        root = read_xml(path)
        stops = [_bus_stop(e, network) for e in root.iterfind('busStop')]
        rows = [_parking_area(e, network) for e in root.iterfind('parkingArea')]
    except (OSError, KeyError, ValueError, MapError) as err:
        raise _damaged(path, err) from err
    return _sorted(stops, path, lambda s: s.id), _sorted(rows, path, lambda r: r.id)


def _damaged(path: Path, err: Exception | str) -> MapError:
    return MapError(f'expected a complete map file in {path}, but: {err!r}', hint=_HINT)


def _features(path: Path, convert: Callable[[_Feature], _T | None]) -> list[_T]:
    try:
        document = read_json(path, MAP_BYTES)
        if document['frame'] != FRAME:
            raise ValueError(f'frame is {document["frame"]!r}, expected {FRAME!r}')
        converted = [convert(feature) for feature in document['features']]
    except (OSError, KeyError, TypeError, ValueError, IndexError) as err:
        raise _damaged(path, err) from err
    return [value for value in converted if value is not None]


def _sorted(values: list[_T], path: Path, key: Callable[[_T], str]) -> tuple[_T, ...]:
    ordered = sorted(values, key=key)
    for a, b in pairwise(ordered):
        if key(a) == key(b):
            raise _damaged(path, f'{key(a)} is there twice')
    return tuple(ordered)


def _kind(feature: _Feature) -> str:
    return str(feature['properties']['kind'])


def _rings(feature: _Feature) -> tuple[Points, ...]:
    geometry = feature['geometry']
    if geometry['type'] != 'Polygon':
        raise ValueError(f'geometry is {geometry["type"]!r}, expected Polygon')
    rings = []
    for i, ring in enumerate(geometry['coordinates']):
        points = tuple((float(x), float(y)) for x, y in ring)
        if points[0] == points[-1]:
            points = points[:-1]
        if len(points) < 3:
            raise ValueError('a ring has fewer than three points')
        clockwise = _doubled_area(points) < 0.0
        rings.append(points if clockwise == (i > 0) else tuple(reversed(points)))
    return tuple(rings)


def _doubled_area(points: Points) -> float:
    total = 0.0
    for (ax, ay), (bx, by) in zip(points, (*points[1:], points[0]), strict=True):
        total += ax * by - bx * ay
    return total


def _building(feature: _Feature) -> Building:
    properties = feature['properties']
    height_m = float(properties['height_m'])
    if not 0.0 < height_m < 1000.0:
        raise ValueError(f'building {properties["id"]} has height {height_m} m')
    rings = _rings(feature)
    return Building(
        id=str(properties['id']),
        ring=rings[0],
        holes=rings[1:],
        height_m=height_m,
        height_source=str(properties['height_source']),
        kind=str(properties['kind']),
        name=str(properties.get('name', '')),
    )


def _zone(feature: _Feature) -> NoFlyZone:
    properties = feature['properties']
    floor_m, ceiling_m = float(properties['floor_m']), float(properties['ceiling_m'])
    if not 0.0 <= floor_m < ceiling_m:
        raise ValueError(f'zone {properties["id"]} reaches from {floor_m} to {ceiling_m} m')
    return NoFlyZone(
        id=str(properties['id']),
        name=str(properties['name']),
        ring=_rings(feature)[0],
        floor_m=floor_m,
        ceiling_m=ceiling_m,
    )


def _area(feature: _Feature) -> Area:
    properties = feature['properties']
    return Area(
        id=str(properties['id']),
        name=str(properties['name']),
        kind=_kind(feature),
        ring=_rings(feature)[0],
    )


def _landmark(feature: _Feature) -> Landmark:
    properties = feature['properties']
    x, y = feature['geometry']['coordinates']
    return Landmark(
        name=str(properties['name']),
        kind=_kind(feature),
        x_m=float(x),
        y_m=float(y),
        approach_lane_id=str(properties['approach_lane_id']),
        approach_pos_m=float(properties['approach_pos_m']),
    )


def _bus_stop(element: Xml.Element, network: RoadNetwork) -> BusStop:
    start_m, end_m = _span(element, network)
    return BusStop(
        id=element.attrib['id'],
        name=element.get('name', ''),
        lane_id=element.attrib['lane'],
        start_pos_m=start_m,
        end_pos_m=end_m,
    )


def _span(element: Xml.Element, network: RoadNetwork) -> tuple[float, float]:
    start_m, end_m = float(element.attrib['startPos']), float(element.attrib['endPos'])
    length_m = network.lane(element.attrib['lane']).length_m
    if not 0.0 <= start_m < end_m <= length_m:
        raise ValueError(f'{element.attrib["id"]}: {start_m} to {end_m} m on {length_m} m')
    return start_m, end_m


def _parking_area(element: Xml.Element, network: RoadNetwork) -> ParkingArea:
    start_m, end_m = _span(element, network)
    lane = network.lane(element.attrib['lane'])
    count = int(element.attrib['roadsideCapacity'])
    width_m, length_m = float(element.attrib['width']), float(element.attrib['length'])
    # Source: SUMO manual, Simulation/ParkingArea: roadside places stand in a row whose centre
    # line is half a lane and half a place to the right of the lane's centre line.
    offset_m = (lane.width_m + width_m) / 2.0
    places = []
    for i in range(count):
        middle_m = start_m + (i + 0.5) * (end_m - start_m) / count
        x, y, east, north = network.position_on_lane(lane.id, middle_m)
        places.append(
            ParkingPlace(
                x_m=x + north * offset_m,
                y_m=y - east * offset_m,
                heading_east=east,
                heading_north=north,
                length_m=length_m,
                width_m=width_m,
            )
        )
    return ParkingArea(
        id=element.attrib['id'],
        name=element.get('name', ''),
        lane_id=lane.id,
        start_pos_m=start_m,
        end_pos_m=end_m,
        places=tuple(places),
    )
