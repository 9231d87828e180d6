# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Make a SUMO network in the map frame out of each kind of source."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as Xml

from aurora_cli.map_import.frame import MOST_EXTENT_M, Frame, frame_about, reframe
from aurora_cli.map_import.netconvert import run_netconvert
from aurora_cli.map_import.osm_data import OsmData
from aurora_cli.map_import.source import Source, SourceKind
from aurora_cli.map_import.text import plain_name
from aurora_core.errors import MapError
from aurora_core.knowledge.road_network import RoadNetwork

_METRES_PER_DEGREE = 111_000.0
# The shortest that netconvert makes.
_LEAST_LANE_M = 0.1
_LEAST_SPEED_MPS = 0.5
# The widest motorways have 13 lanes in one direction.
MOST_LANES = 32
# Common to all: names stay, heights go, walkers get crossings where streets have walkways.
_COMMON = ('--output.street-names', '--flatten', '--crossings.guess', '--walkingareas')
# Options of the SUMO user guide for OpenStreetMap, without rails and footways of their own.
_OSM = (
    '--geometry.remove',
    '--roundabouts.guess',
    '--ramps.guess',
    '--junctions.join',
    '--tls.guess-signals',
    '--tls.discard-simple',
    '--tls.join',
    '--tls.default-type',
    'static',
    '--remove-edges.isolated',
    '--no-turnarounds.except-deadend',
    '--sidewalks.guess',
    '--keep-edges.by-vclass',
    'passenger',
    '--keep-edges.components',
    '1',
    '--remove-edges.by-type',
    'highway.track,highway.services,highway.unsurfaced,highway.service',
    '--offset.disable-normalization',
)  # fmt: skip
_OSM_TYPES = ('osmNetconvert', 'osmNetconvertUrbanDe')
_XODR_TYPES = ('opendriveNetconvert', 'opendriveNetconvertPedestrians')


@dataclass(frozen=True, slots=True, kw_only=True)
class BuiltNet:
    """A network and where it lies.

    Args:
        xml: From `<net` on, without netconvert's comment (date, local paths).
        frame: Its frame.
        is_guessed: Walkways were added by a rule of netconvert, not by the file.
    """

    xml: bytes
    frame: Frame
    is_guessed: bool = False


def net_of_osm(source: Source, data: OsmData, scratch: Path) -> BuiltNet:
    """Make the network of an OpenStreetMap extract, projected about the middle of its roads.

    Args:
        source: Extract as XML.
        data: The same, read.
        scratch: Folder for files on the way.

    Raises:
        MapError: It has no road for cars, reaches too far, or netconvert fails.
    """
    places = list(data.road_nodes())
    if not places:
        raise MapError(
            f'{source.given} has no road: no way with the tag highway',
            hint='export the map data with its streets, not buildings or points alone',
        )
    west, east = min(p[0] for p in places), max(p[0] for p in places)
    south, north = min(p[1] for p in places), max(p[1] for p in places)
    if (north - south) * _METRES_PER_DEGREE > MOST_EXTENT_M or east - west > 5.0:
        raise MapError(
            f'{source.given} has roads from {south:.2f} to {north:.2f} degrees north and from '
            f'{west:.2f} to {east:.2f} east, more than the {MOST_EXTENT_M / 1000.0:.0f} km of a '
            'map',
            hint='cut out a smaller part',
        )
    _check_lanes(source, data)
    frame = frame_about((south + north) / 2.0, (west + east) / 2.0)
    out = run_netconvert(
        [
            *('--osm-files', str(source.path), '--proj', frame.projection),
            *_COMMON,
            *_OSM,
        ],
        typemaps=_OSM_TYPES,
        out=scratch / 'built.net.xml',
        given=source.given,
    )
    return BuiltNet(
        xml=_from_net_on(out.read_bytes()),
        frame=frame,
        is_guessed=True,
    )


def _check_lanes(source: Source, data: OsmData) -> None:
    """Refuse streets of more lanes than any has, which netconvert would lay out one by one."""
    for way in data.ways.values():
        count = way.tags.get('lanes', '') if 'highway' in way.tags else ''
        if count.isdecimal() and int(count[:9]) > 2 * MOST_LANES:
            raise MapError(
                f'{source.given}: way {way.id} has {count[:9]} lanes',
                hint=f'correct it: a street has at most {MOST_LANES} in one direction',
            )


def net_of_file(source: Source, scratch: Path) -> BuiltNet:
    """Make the network of a SUMO network or an OpenDRIVE file.

    What the file has of walkways stays; where it has none at all, netconvert guesses them.

    Raises:
        MapError: It has no road for cars, reaches too far, or netconvert fails.
    """
    is_sumo = source.kind is SourceKind.SUMO
    given = ['--sumo-net-file' if is_sumo else '--opendrive-files', str(source.path), *_COMMON]
    if not is_sumo:
        given.append('--no-turnarounds.except-deadend')
    types: tuple[str, ...] = () if is_sumo else _XODR_TYPES
    out = scratch / 'built.net.xml'
    run_netconvert(given, typemaps=types, out=out, given=source.given)
    is_guessed = not RoadNetwork.from_file(out).sidewalks
    if is_guessed:
        types = types[:1]
        run_netconvert([*given, '--sidewalks.guess'], typemaps=types, out=out, given=source.given)
    root, frame = reframe(out, source.given)
    return BuiltNet(xml=_document(root), frame=frame, is_guessed=is_guessed)


def _from_net_on(document: bytes) -> bytes:
    return _document(Xml.fromstring(document))  # nosec B314


def _document(root: Xml.Element) -> bytes:
    _plain_names(root)
    _measure_lanes(root)
    _open_lanes(root)
    return Xml.tostring(root, encoding='unicode').encode('utf-8')


def _plain_names(root: Xml.Element) -> None:
    for edge in root.iterfind('edge'):
        if 'name' in edge.attrib:
            edge.set('name', plain_name(edge.attrib['name']))


def _measure_lanes(root: Xml.Element) -> None:
    """Count the lanes of each edge as long as those that are driven on are, in the middle.

    netconvert counts an edge by its own line, which on curves and at wide junctions may be half or
    twice as long: vehicles would move at another speed than they are said to, and a distance along
    the way would not be the one between them. All lanes of an edge must count the same.
    """
    for edge in root.iterfind('edge'):
        if edge.get('function', 'normal') not in ('normal', 'internal'):
            continue
        lanes = edge.findall('lane')
        driven = [lane for lane in lanes if lane.get('allow') != 'pedestrian'] or lanes
        if driven:
            mean_m = sum(map(_arc_m, driven)) / len(driven)
            for lane in lanes:
                lane.set('length', f'{max(mean_m, _LEAST_LANE_M):.2f}')


def _open_lanes(root: Xml.Element) -> None:
    """Let traffic move everywhere: a limit that netconvert rounds to 0 would stop it."""
    for lane in root.iterfind('edge/lane'):
        speed_mps = float(lane.get('speed', 'inf'))
        if speed_mps < _LEAST_SPEED_MPS:
            lane.set('speed', f'{_LEAST_SPEED_MPS:.2f}')


def _arc_m(lane: Xml.Element) -> float:
    pairs = (pair.split(',') for pair in lane.get('shape', '').split())
    points = [(float(pair[0]), float(pair[1])) for pair in pairs]
    return sum(math.dist(a, b) for a, b in pairwise(points))
