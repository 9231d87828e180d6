# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Buildings of an OpenStreetMap extract, each with its height and where that comes from."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator

import shapely

from aurora_cli.map_import.osm_data import Tags
from aurora_cli.map_import.osm_shapes import OsmArea, OsmShapes, polygons
from aurora_cli.map_import.text import plain_name
from aurora_core.knowledge.map_types import Building

LEVEL_M = 3.0
DEFAULT_M = 10.0
# What stands lower than a house, by its value of `building`.
_LOW_M = {
    'roof': 5.0, 'carport': 3.0, 'garage': 3.0, 'garages': 3.0, 'shed': 3.0, 'hut': 3.0,
    'kiosk': 4.0, 'greenhouse': 4.0, 'service': 4.0, 'toilets': 3.0, 'bunker': 4.0,
}  # fmt: skip
_HIGH_M = {'church': 20.0, 'cathedral': 35.0, 'stadium': 20.0, 'house': 7.0, 'detached': 7.0}
_MOST_M = 900.0
_LEAST_M2 = 4.0
_STREET_GAP_M = 0.3
_GRID_M = 0.1
# "12.13 m", "12,5", "40 ft", "40'6\"": OpenStreetMap's wiki has metres by default.
_METRES = re.compile(r'^\s*(\d+(?:[.,]\d+)?)\s*(?:m|meters?|metres?)?\s*$', re.IGNORECASE)
_FEET = re.compile(r'^\s*(\d+(?:\.\d+)?)\s*(?:ft|feet|\')\s*(?:(\d+(?:\.\d+)?)\s*(?:"|in))?\s*$')


def height_of(tags: Tags) -> tuple[float, str]:
    """Return the height of a building above ground (m) and its source.

    Sources, the first that there is: `height tag`, `levels` (3 m each, roof levels too), `default
    of its kind`, `default`.
    """
    tagged = _length_m(tags.get('height', '')) or _length_m(tags.get('building:height', ''))
    if tagged:
        return min(tagged, _MOST_M), 'height tag'
    levels = _number(tags.get('building:levels', ''))
    if levels:
        roof = _number(tags.get('roof:levels', '')) or 0.0
        return min((levels + roof) * LEVEL_M, _MOST_M), 'levels'
    kind = tags.get('building', '')
    if kind in _LOW_M or kind in _HIGH_M:
        return (_LOW_M | _HIGH_M)[kind], 'default of its kind'
    return DEFAULT_M, 'default'


def _length_m(text: str) -> float:
    metres = _METRES.match(text)
    if metres is not None:
        return float(metres[1].replace(',', '.'))
    feet = _FEET.match(text)
    return (float(feet[1]) + float(feet[2] or 0.0) / 12.0) * 0.3048 if feet is not None else 0.0


def _number(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        return 0.0
    return value if math.isfinite(value) and value > 0.0 else 0.0


def buildings(
    shapes: OsmShapes, streets: shapely.Geometry, extent: shapely.Geometry
) -> tuple[Building, ...]:
    """Return the buildings that stand within an extent, less what streets run through.

    Footprints above streets (arches, bridges, tunnels) are cut: a prism reaches to the ground.

    Args:
        shapes: Shapes of the extract.
        streets: Streets from house line to house line.
        extent: Area of the map.
    """
    shapely.prepare(extent)
    clear = shapely.buffer(streets, _STREET_GAP_M, quad_segs=2)
    shapely.prepare(clear)
    found: list[Building] = []
    for area in shapes.areas(('building',)):
        if _is_above_ground(area.tags) and extent.intersects(area.shape):
            free = area.shape.difference(clear) if clear.intersects(area.shape) else area.shape
            found += _prisms(area, free)
    return tuple(found)


def _is_above_ground(tags: Tags) -> bool:
    below = tags.get('layer', '').startswith('-') or tags.get('location') == 'underground'
    return tags['building'] not in ('no', 'ruins', 'construction') and not below


def _prisms(area: OsmArea, free: shapely.Geometry) -> Iterator[Building]:
    height_m, source = height_of(area.tags)
    kind = area.tags['building']
    # Writing rounds to decimetres: what is too thin for that must go before.
    snapped = polygons(shapely.set_precision(free, _GRID_M))
    parts = [p for p in snapped.geoms if p.area >= _LEAST_M2]
    for number, part in enumerate(sorted(parts, key=lambda p: (-p.area, p.bounds))):
        oriented = shapely.orient_polygons(part)
        yield Building(
            id=area.id if number == 0 else f'{area.id}_{number + 1}',
            ring=_open(oriented.exterior),
            holes=tuple(_open(ring) for ring in oriented.interiors),
            height_m=round(max(height_m, 0.1), 1),
            height_source=source,
            kind=plain_name(kind) or 'yes',
            name=plain_name(area.tags.get('name', '')),
        )


def _open(ring: shapely.LinearRing) -> tuple[tuple[float, float], ...]:
    return tuple((round(x, 1), round(y, 1)) for x, y in list(ring.coords)[:-1])
