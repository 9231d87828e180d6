# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A map as one verified value: network, buildings, zones, landmarks, origin, digest."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from aurora_core.errors import MapError
from aurora_core.knowledge.grounds import BUS_STOP, grounds_of
from aurora_core.knowledge.map_files import (
    read_areas,
    read_buildings,
    read_landmarks,
    read_stops,
    read_zones,
)
from aurora_core.knowledge.map_folders import map_folder
from aurora_core.knowledge.map_manifest import MANIFEST_NAME, read_manifest
from aurora_core.knowledge.map_types import (
    Area,
    Building,
    BusStop,
    Landmark,
    NoFlyZone,
    ParkingArea,
)
from aurora_core.knowledge.road_network import RoadNetwork

NET_NAME = 'net.xml.gz'
STOPS_NAME = 'stops.add.xml'
BUILDINGS_NAME = 'buildings.geojson'
ZONES_NAME = 'zones.geojson'
LANDMARKS_NAME = 'landmarks.geojson'
REQUIRED_NAMES = (NET_NAME, STOPS_NAME, BUILDINGS_NAME, ZONES_NAME, LANDMARKS_NAME)


@dataclass(frozen=True, kw_only=True)
class MapModel:
    """A map in its ENU frame (metres).

    Args:
        name: Name of the map.
        version: Its version.
        digest: sha256 (hex) over everything in it.
        description: What it shows, one sentence.
        licence: SPDX expression.
        folder: Where its files are.
        origin_lat_deg: Latitude of the frame's origin.
        origin_lon_deg: Longitude of the frame's origin.
        projection: PROJ string that turns longitude and latitude into map metres.
        bounds_m: West, south, east, north.
        network: Road network.
        buildings: Sorted by id.
        zones: No-fly zones, sorted by id.
        areas: Parks, school zones and other named ground, sorted by id.
        landmarks: Sorted by name.
        grounds: Areas and bus stops that are no landmarks, as such, sorted by name.
        bus_stops: Sorted by id.
        parking_areas: Sorted by id.
    """

    name: str
    version: str
    digest: str
    description: str
    licence: str
    folder: Path
    origin_lat_deg: float
    origin_lon_deg: float
    projection: str
    bounds_m: tuple[float, float, float, float]
    network: RoadNetwork
    buildings: tuple[Building, ...]
    zones: tuple[NoFlyZone, ...]
    areas: tuple[Area, ...]
    landmarks: tuple[Landmark, ...]
    grounds: tuple[Landmark, ...]
    bus_stops: tuple[BusStop, ...]
    parking_areas: tuple[ParkingArea, ...]

    @property
    def net_path(self) -> Path:
        """Network file for the simulator."""
        return self.folder / NET_NAME

    @property
    def stops_path(self) -> Path:
        """Additional file with bus stops and parking rows for the simulator."""
        return self.folder / STOPS_NAME

    @property
    def quotable(self) -> tuple[Landmark, ...]:
        """Landmarks and areas: where a stop is on its lane, no proof says."""
        return tuple(mark for mark in self.places if mark.kind != BUS_STOP)

    @property
    def places(self) -> tuple[Landmark, ...]:
        """All that a prompt can name: the landmarks, then areas and bus stops."""
        return self.landmarks + self.grounds

    def landmark(self, name: str) -> Landmark:
        """Return a landmark, an area or a bus stop by name.

        Raises:
            MapError: When the map has none of that name.
        """
        for landmark in self.places:
            if landmark.name == name:
                return landmark
        names = ', '.join(landmark.name for landmark in self.places)
        raise MapError(f'map {self.name} has no landmark {name!r}', hint=f'it has: {names}')


def load_map(name: str) -> MapModel:
    """Load a map and verify every file against its digest.

    Args:
        name: Of a bundled or an imported map.

    Raises:
        MapError: When there is no such map, or when one of its files is missing or changed.
    """
    folder = map_folder(name)
    model = load_map_folder(folder)
    if model.name != name:
        raise MapError(
            f'the folder {folder} holds the map {model.name!r}, which no run would find again',
            hint=f'name the folder {model.name}, or import the map again with --name {name}',
        )
    return model


def load_map_folder(folder: Path) -> MapModel:
    """Load a map from a folder of any place and verify every file against its digest.

    Raises:
        MapError: When one of its files is missing, changed or damaged.
    """
    manifest = read_manifest(folder)
    listed = {file.name for file in manifest.files}
    for required in REQUIRED_NAMES:
        if required not in listed:
            raise MapError(
                f'map {manifest.name}: expected {required} in the file list of '
                f'{folder / MANIFEST_NAME}',
                hint='build the maps again with `make maps`',
            )
    network = RoadNetwork.from_file(folder / NET_NAME)
    if network.projection != manifest.projection:
        raise MapError(
            f'map {manifest.name}: the network is projected by {network.projection!r}, the '
            f'manifest says {manifest.projection!r}',
            hint='build the maps again with `make maps`',
        )
    bus_stops, parking_areas = read_stops(folder / STOPS_NAME, network)
    areas = read_areas(folder / ZONES_NAME)
    landmarks = read_landmarks(folder / LANDMARKS_NAME, network)
    return MapModel(
        name=manifest.name,
        version=manifest.version,
        digest=manifest.digest,
        description=manifest.description,
        licence=manifest.licence,
        folder=folder,
        origin_lat_deg=manifest.origin_latitude_deg,
        origin_lon_deg=manifest.origin_longitude_deg,
        projection=manifest.projection,
        bounds_m=manifest.extent_m,
        network=network,
        buildings=read_buildings(folder / BUILDINGS_NAME),
        zones=read_zones(folder / ZONES_NAME),
        areas=areas,
        landmarks=landmarks,
        grounds=grounds_of(areas, bus_stops, landmarks, network),
        bus_stops=bus_stops,
        parking_areas=parking_areas,
    )
