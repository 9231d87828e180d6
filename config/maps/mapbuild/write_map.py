# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Put a map folder together: network, stops, GeoJSON files, manifest."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pyproj
import shapely

from aurora_core.files import gzip_reproducibly
from aurora_core.knowledge.map_files import write_features
from aurora_core.knowledge.map_manifest import (
    SCHEMA_VERSION,
    MapManifest,
    describe_file,
    write_manifest,
)
from aurora_core.knowledge.map_model import (
    BUILDINGS_NAME,
    LANDMARKS_NAME,
    NET_NAME,
    REQUIRED_NAMES,
    STOPS_NAME,
    ZONES_NAME,
)
from aurora_core.knowledge.road_network import RoadNetwork
from mapbuild.buildings import Built, District, Special, build_up
from mapbuild.netbuild import build_net, location_element, projection
from mapbuild.places import Place, Zone
from mapbuild.plain_xml import write_stops
from mapbuild.streets import StreetPlan

LICENCE = 'Apache-2.0'


@dataclass(frozen=True, slots=True, kw_only=True)
class MapPlan:
    """Everything that defines a map."""

    name: str
    version: str
    description: str
    origin_lat_deg: float
    origin_lon_deg: float
    extent_m: tuple[float, float, float, float]
    streets: StreetPlan
    districts: tuple[District, ...]
    specials: tuple[Special, ...]
    zones: tuple[Zone, ...]
    places: tuple[Place, ...]
    seed: int


def write_map(plan: MapPlan, folder: Path) -> MapManifest:
    """Build a map into a folder (created when absent) and return its manifest."""
    folder.mkdir(parents=True, exist_ok=True)
    origin = (plan.origin_lat_deg, plan.origin_lon_deg)
    location = location_element(*origin, plan.extent_m, _lonlat_extent(plan))
    net_xml = build_net(plan.streets, plan.name, location)
    (folder / NET_NAME).write_bytes(gzip_reproducibly(net_xml))
    network = RoadNetwork.from_file(folder / NET_NAME)
    lengths_m = {lane.id: lane.length_m for lane in network.lanes.values()}
    write_stops(plan.streets, folder / STOPS_NAME, lengths_m)
    built = build_up(
        plan.streets, network, plan.extent_m, plan.districts, plan.specials, plan.seed
    )
    write_features(folder / BUILDINGS_NAME, [_building(b) for b in built])
    write_features(folder / ZONES_NAME, [_zone(z) for z in plan.zones])
    write_features(folder / LANDMARKS_NAME, [_landmark(p, network) for p in plan.places])
    (folder / 'ATTRIBUTION.md').write_text(_attribution(plan), encoding='utf-8')
    manifest = MapManifest(
        schema_version=SCHEMA_VERSION,
        name=plan.name,
        version=plan.version,
        description=plan.description,
        licence=LICENCE,
        origin_latitude_deg=plan.origin_lat_deg,
        origin_longitude_deg=plan.origin_lon_deg,
        projection=projection(*origin),
        extent_m=plan.extent_m,
        files=tuple(
            describe_file(folder / name) for name in sorted((*REQUIRED_NAMES, 'ATTRIBUTION.md'))
        ),
    )
    return write_manifest(folder, manifest)


def _lonlat_extent(plan: MapPlan) -> tuple[float, float, float, float]:
    """Return west, south, east, north in degrees."""
    to_degrees = pyproj.Transformer.from_crs(
        projection(plan.origin_lat_deg, plan.origin_lon_deg), 'EPSG:4326', always_xy=True
    )
    west, south, east, north = plan.extent_m
    west_deg, south_deg = to_degrees.transform(west, south)
    east_deg, north_deg = to_degrees.transform(east, north)
    return west_deg, south_deg, east_deg, north_deg


def _feature(geometry: dict[str, Any], properties: dict[str, Any]) -> dict[str, Any]:
    return {'type': 'Feature', 'properties': properties, 'geometry': geometry}


def _polygon(shape: shapely.Polygon) -> dict[str, Any]:
    oriented = shapely.orient_polygons(shape)
    rings = [oriented.exterior, *oriented.interiors]
    coordinates = [[[round(x, 1), round(y, 1)] for x, y in ring.coords] for ring in rings]
    return {'type': 'Polygon', 'coordinates': coordinates}


def _building(built: Built) -> dict[str, Any]:
    properties = {
        'id': built.id,
        'kind': built.kind,
        'height_m': built.height_m,
        'height_source': 'design',
    }
    if built.name:
        properties['name'] = built.name
    return _feature(_polygon(built.shape), properties)


def _zone(zone: Zone) -> dict[str, Any]:
    properties: dict[str, Any] = {'id': zone.id, 'name': zone.name, 'kind': zone.kind}
    if zone.kind == 'no_fly':
        properties |= {'floor_m': zone.floor_m, 'ceiling_m': zone.ceiling_m}
    return _feature(_polygon(zone.shape), properties)


def _landmark(place: Place, network: RoadNetwork) -> dict[str, Any]:
    lane_id, pos_m, _ = network.nearest_lane(*place.door, 'passenger')
    properties = {
        'name': place.name,
        'kind': place.kind,
        'approach_lane_id': lane_id,
        'approach_pos_m': round(pos_m, 1),
    }
    return _feature({'type': 'Point', 'coordinates': list(place.at)}, properties)


def _attribution(plan: MapPlan) -> str:
    return (
        f'# Map {plan.name}\n\n'
        'An invented place: streets, buildings and names were designed by the AURORA authors and '
        'are built\nby the scripts beside this folder. It contains no third-party data.\n\n'
        f'Licence: {LICENCE}, like the code.\n'
    )
