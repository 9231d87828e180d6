# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Import a file: the steps in order, each timed."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

import shapely

from aurora_cli.map_import.folder import (
    area_features,
    building_features,
    landmark_features,
    new_folder,
    write_stops,
)
from aurora_cli.map_import.networks import MOST_LANES, BuiltNet, net_of_file, net_of_osm
from aurora_cli.map_import.osm_buildings import buildings
from aurora_cli.map_import.osm_data import read_osm, write_osm_xml
from aurora_cli.map_import.osm_places import areas, bus_stops, landmarks
from aurora_cli.map_import.osm_shapes import OsmShapes
from aurora_cli.map_import.source import Source, SourceKind, take_in
from aurora_cli.output import quiet_stdout
from aurora_core.errors import GroundSimulatorError, MapError
from aurora_core.files import gzip_reproducibly
from aurora_core.grounding.spots import compiled_area
from aurora_core.knowledge.map_files import write_features
from aurora_core.knowledge.map_folders import is_map_name, list_maps, own_maps_folder
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
    MapModel,
    load_map_folder,
)
from aurora_core.knowledge.map_types import Area, Building, BusStop, Landmark
from aurora_core.knowledge.measured_on import vtypes_path
from aurora_core.knowledge.reach import Reach
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.settings import load_settings
from aurora_sumo_bridge.sumo_process import SumoProcess

ATTRIBUTION_NAME = 'ATTRIBUTION.md'
_MARGIN_M = 50.0
# A city centre has 20 km of lanes per square kilometre, measured in half a second each.
_MOST_LANES_KM = 2000.0
_SUFFIXES = ('.gz', '.xml', '.net', '.osm', '.pbf', '.xodr')
_ODBL = 'ODbL-1.0'
# SPDX: the licence is what the giver of the file says, and only the user knows that.
_UNKNOWN_LICENCE = 'NOASSERTION'


@dataclass(frozen=True, slots=True, kw_only=True)
class Imported:
    """What came of an import.

    Args:
        model: The map, read back from where it is now.
        kind: What the file held.
        seconds: Time of each step.
        is_placed: False when the file does not say where on Earth it is.
        is_guessed: Walkways were added by rule.
    """

    model: MapModel
    kind: SourceKind
    seconds: dict[str, float]
    is_placed: bool
    is_guessed: bool


@dataclass(slots=True)
class _Steps:
    """Tells which step begins, and how long each took."""

    tell: Callable[[str], None]
    seconds: dict[str, float] = field(default_factory=dict)
    _name: str = ''
    _begin_s: float = 0.0

    def begin(self, name: str) -> None:
        now_s = time.monotonic()
        if self._name:
            self.seconds[self._name] = round(now_s - self._begin_s, 3)
        self._name, self._begin_s = name, now_s
        if name:
            self.tell(name)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Content:
    buildings: tuple[Building, ...] = ()
    areas: tuple[Area, ...] = ()
    landmarks: tuple[Landmark, ...] = ()
    stops: tuple[BusStop, ...] = ()


def name_of(file: Path) -> str:
    """Return the name that a map gets from its file: `Old Town.osm.gz` → `old_town`."""
    stem = file.name.lower()
    while any(stem.endswith(suffix) for suffix in _SUFFIXES):
        stem = stem.rpartition('.')[0]
    return re.sub(r'[^a-z0-9]+', '_', stem).strip('_')[:64]


def import_map(file: Path, name: str, tell: Callable[[str], None]) -> Imported:
    """Make a map of a file in the user's own folder of maps.

    Args:
        file: OSM extract, SUMO network or OpenDRIVE file.
        name: Of the map.
        tell: Called with the name of each step as it begins.

    Raises:
        MapError: The name or the file will not do, or the folder cannot be written.
        UnreadableFileError: The file is none.
    """
    if not is_map_name(name):
        raise MapError(
            f'a map cannot be named {name!r}',
            hint='use small letters, digits, _ and -, at most 64, a letter or digit first',
        )
    final = own_maps_folder() / name
    if name in list_maps() or final.exists():
        raise MapError(
            f'there is a map {name} already',
            hint=f'choose another name with --name, or delete {final} if it is yours',
        )
    steps = _Steps(tell)
    with new_folder(final) as scratch:
        steps.begin('read')
        source = take_in(file, scratch)
        try:
            built, kind = _build(source, scratch, scratch / 'map', name, steps)
            steps.begin('load')
            _try_out(load_map_folder(scratch / 'map'))
        except MapError as err:
            raise _of_the_file(err, file, scratch) from err
    model = load_map_folder(final)
    steps.begin('prepare')
    # On a read-only installation every run makes it anew.
    with suppress(OSError):
        compiled_area(model).write()
    steps.begin('')
    return Imported(
        model=model,
        kind=kind,
        seconds=steps.seconds,
        is_placed=built.frame.is_placed,
        is_guessed=built.is_guessed,
    )


def _of_the_file(err: MapError, file: Path, scratch: Path) -> MapError:
    """Return an error about the file that the user knows, not about what was made of it."""
    if str(file) in err.message:
        return err
    made = f'{scratch}{os.sep}'
    again = 'export it again, or import another file'
    hint = again if made in err.message else err.hint or again
    return MapError(f'{file} gives no map: {err.message.replace(made, "")}', hint=hint)


def _try_out(model: MapModel) -> None:
    """Start the simulator on a map: it refuses some networks that netconvert makes."""
    dt_s = load_settings().run.dt_s
    try:
        with quiet_stdout():
            SumoProcess(
                net_path=model.net_path, vtypes_path=vtypes_path(), dt_s=dt_s, seed=1
            ).close()
    except GroundSimulatorError as err:
        raise MapError(err.message, hint='correct what SUMO names, and import it again') from err


def _build(
    source: Source, scratch: Path, folder: Path, name: str, steps: _Steps
) -> tuple[BuiltNet, SourceKind]:
    """Write all files of the map."""
    data = None
    if source.kind in (SourceKind.OSM, SourceKind.OSM_PBF):
        data = read_osm(source)
        if source.kind is SourceKind.OSM_PBF:
            write_osm_xml(data, source.path)  # netconvert reads XML only
    steps.begin('roads')
    built = net_of_osm(source, data, scratch) if data is not None else net_of_file(source, scratch)
    (folder / NET_NAME).write_bytes(gzip_reproducibly(built.xml))
    network = RoadNetwork.from_file(folder / NET_NAME)
    reach = Reach(network)
    if reach.nearest(0.0, 0.0) is None:
        raise MapError(
            f'{source.given} has no road that cars may use',
            hint='import a file that has streets for cars',
        )
    _check_size(network)
    extent = _extent(network)
    content = _Content()
    if data is not None:
        steps.begin('buildings')
        shapes = OsmShapes(data, built.frame)
        prisms = buildings(shapes, network.street_surface, extent)
        steps.begin('places')
        content = _Content(
            buildings=prisms,
            areas=areas(shapes, extent),
            landmarks=landmarks(shapes, reach, extent),
            stops=bus_stops(shapes, Reach(network, 'bus')),
        )
    steps.begin('write')
    _write(content, folder)
    (folder / ATTRIBUTION_NAME).write_text(_attribution(name, source, built), encoding='utf-8')
    corners = shapely.union_all([extent, *(shapely.Polygon(b.ring) for b in content.buildings)])
    manifest = MapManifest(
        schema_version=SCHEMA_VERSION,
        name=name,
        version='1.0.0',
        description=_description(source, built),
        licence=_ODBL if data is not None else _UNKNOWN_LICENCE,
        origin_latitude_deg=built.frame.lat_deg,
        origin_longitude_deg=built.frame.lon_deg,
        projection=built.frame.projection,
        extent_m=tuple(round(v, 1) for v in corners.bounds),
        files=tuple(
            describe_file(folder / n) for n in sorted((*REQUIRED_NAMES, ATTRIBUTION_NAME))
        ),
    )
    write_manifest(folder, manifest)
    return built, source.kind


def _check_size(network: RoadNetwork) -> None:
    """Refuse streets that no city has."""
    widest = max(network.edges.values(), key=lambda edge: (len(edge.lane_ids), edge.id))
    if len(widest.lane_ids) > MOST_LANES:
        raise MapError(
            f'street {widest.street_name or widest.id} has {len(widest.lane_ids)} lanes in one '
            'direction',
            hint=f'correct it: a street has at most {MOST_LANES}',
        )
    length_km = sum(lane.arc_length_m for lane in network.lanes.values()) / 1000.0
    if length_km > _MOST_LANES_KM:
        raise MapError(
            f'its lanes are {length_km:.0f} km long, more than the {_MOST_LANES_KM:.0f} km of a '
            'map',
            hint='cut out a smaller part',
        )


def _extent(network: RoadNetwork) -> shapely.Polygon:
    lines = [shapely.LineString(lane.polyline) for lane in network.lanes.values()]
    west, south, east, north = shapely.total_bounds(lines)
    return shapely.box(west - _MARGIN_M, south - _MARGIN_M, east + _MARGIN_M, north + _MARGIN_M)


def _write(content: _Content, folder: Path) -> None:
    write_features(folder / BUILDINGS_NAME, building_features(content.buildings))
    write_features(folder / ZONES_NAME, area_features(content.areas))
    write_features(folder / LANDMARKS_NAME, landmark_features(content.landmarks))
    write_stops(folder / STOPS_NAME, content.stops)


def _description(source: Source, built: BuiltNet) -> str:
    where = '' if built.frame.is_placed else ', no place on Earth'
    return f'Imported: {source.kind.value}{where}'


def _attribution(name: str, source: Source, built: BuiltNet) -> str:
    lines = [
        f'# Map {name}',
        '',
        f'Imported by `aurora map import` from a file of the kind {source.kind.value},',
        f'sha256 {source.sha256}.',
        '',
    ]
    if source.kind in (SourceKind.OSM, SourceKind.OSM_PBF):
        lines += [
            'Map data (c) OpenStreetMap contributors, available under the Open Database License',
            '(ODbL) 1.0: https://www.openstreetmap.org/copyright. This folder is derived from it',
            'and stays under that licence. Pictures of it need the credit "(c) OpenStreetMap',
            'contributors".',
        ]
    else:
        lines += ['The licence is that of the file; it is not known here.']
    if built.is_guessed:
        lines += ['', 'Walkways along streets and crossings were guessed by netconvert.']
    if not built.frame.is_placed:
        lines += ['', "The file names no place on Earth: the origin is PX4's default home."]
    return '\n'.join(lines) + '\n'
