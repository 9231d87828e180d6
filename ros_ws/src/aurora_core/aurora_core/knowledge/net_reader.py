# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read a SUMO network file (`.net.xml` or `.net.xml.gz`) without SUMO."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree as Xml

from aurora_core.errors import MapError
from aurora_core.files import read_xml
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.net_types import (
    Connection,
    Crossing,
    Edge,
    Junction,
    Lane,
    NetworkData,
    Points,
)

# Source: SUMO 1.28, SVCPermissions (vehicle classes of the network format).
VEHICLE_CLASSES = frozenset(
    {
        'private',
        'emergency',
        'authority',
        'army',
        'vip',
        'pedestrian',
        'passenger',
        'hov',
        'taxi',
        'bus',
        'coach',
        'delivery',
        'truck',
        'trailer',
        'motorcycle',
        'moped',
        'bicycle',
        'evehicle',
        'tram',
        'rail_urban',
        'rail',
        'rail_electric',
        'rail_fast',
        'ship',
        'container',
        'cable_car',
        'subway',
        'aircraft',
        'wheelchair',
        'scooter',
        'drone',
        'custom1',
        'custom2',
    }
)
_DEFAULT_LANE_WIDTH_M = 3.2


def read_network(path: Path) -> NetworkData:
    """Parse a network file.

    Args:
        path: File in SUMO's network format, compressed when its name ends in `.gz`.

    Raises:
        MapError: When the file is missing, damaged or not a network.
    """
    try:
        root = read_xml(path)
        if root.tag != 'net':
            raise ValueError(f'root element is <{root.tag}>, expected <net>')
        return _network(root)
    except (OSError, KeyError, ValueError) as err:
        raise MapError(
            f'expected a SUMO network in {path}, but: {err}',
            hint='restore the file or build it again with `make maps`',
        ) from err


def _network(root: Xml.Element) -> NetworkData:
    edges: list[Edge] = []
    lanes: list[Lane] = []
    crossings: list[Xml.Element] = []
    walking_areas: list[tuple[str, Points]] = []
    for element in root.iterfind('edge'):
        function = element.get('function', 'normal')
        if function == 'crossing':
            crossings.append(element)
        elif function == 'walkingarea':
            shape = _shape(_first_lane(element).attrib['shape'])
            walking_areas.append((element.attrib['id'], shape))
        elif function in ('normal', 'internal'):
            own = _lanes(element, is_internal=function == 'internal')
            lanes.extend(own)
            edges.append(_edge(element, own))
    links = root.findall('connection')
    location = root.find('location')
    return NetworkData(
        lanes=tuple(sorted(lanes, key=lambda lane: lane.id)),
        edges=tuple(sorted(edges, key=lambda edge: edge.id)),
        junctions=_junctions(root),
        crossings=_crossings(crossings, links),
        walking_areas=tuple(shape for _, shape in sorted(walking_areas)),
        connections=_connections(links),
        projection='' if location is None else location.get('projParameter', ''),
    )


def _shape(text: str) -> Points:
    points: list[tuple[float, float]] = []
    for pair in text.split():
        x, y = pair.split(',')[:2]
        points.append((float(x), float(y)))
    if not points:
        raise ValueError('a shape has no points')
    return tuple(points)


def _without_repeats(points: Points) -> Points:
    """Drop points equal to their predecessor: a segment of no length has no direction."""
    kept = [b for a, b in pairwise(points) if a != b]
    return (points[0], *kept)


def _first_lane(element: Xml.Element) -> Xml.Element:
    lane = element.find('lane')
    if lane is None:
        raise ValueError(f'edge {element.get("id")} has no lane')
    return lane


def _allows(attributes: Mapping[str, str]) -> frozenset[str]:
    allow, disallow = attributes.get('allow'), attributes.get('disallow')
    if allow is not None and allow != 'all':
        return frozenset(allow.split())
    if disallow is not None:
        return frozenset() if disallow == 'all' else VEHICLE_CLASSES - set(disallow.split())
    return VEHICLE_CLASSES


def _lanes(element: Xml.Element, *, is_internal: bool) -> list[Lane]:
    children = element.findall('lane')
    ids = [child.attrib['id'] for child in children]
    lanes = []
    for i, child in enumerate(children):
        polyline = _without_repeats(_shape(child.attrib['shape']))
        if len(polyline) < 2:
            # A degenerate junction lane: give it the millimetre that a direction needs.
            x, y = polyline[0]
            polyline = ((x, y), (x + 0.001, y))
        lanes.append(
            Lane(
                id=ids[i],
                edge_id=element.attrib['id'],
                index=int(child.attrib['index']),
                polyline=polyline,
                line=Polyline(polyline),
                length_m=float(child.attrib['length']),
                speed_limit_mps=float(child.attrib['speed']),
                width_m=float(child.get('width', _DEFAULT_LANE_WIDTH_M)),
                allows=_allows(child.attrib),
                is_internal=is_internal,
                right_lane_id=ids[i - 1] if i > 0 else None,
                left_lane_id=ids[i + 1] if i + 1 < len(ids) else None,
            )
        )
    return lanes


def _edge(element: Xml.Element, lanes: list[Lane]) -> Edge:
    if not lanes:
        raise ValueError(f'edge {element.get("id")} has no lane')
    return Edge(
        id=element.attrib['id'],
        street_name=element.get('name', ''),
        from_junction=element.get('from', ''),
        to_junction=element.get('to', ''),
        lane_ids=tuple(lane.id for lane in lanes),
        length_m=max(lane.length_m for lane in lanes),
        priority=int(element.get('priority', '-1')),
        is_internal=element.get('function') == 'internal',
    )


def _junctions(root: Xml.Element) -> tuple[Junction, ...]:
    junctions = []
    for element in root.iterfind('junction'):
        kind = element.attrib['type']
        if kind == 'internal':
            continue
        shape = element.get('shape', '')
        junctions.append(
            Junction(
                id=element.attrib['id'],
                kind=kind,
                x_m=float(element.attrib['x']),
                y_m=float(element.attrib['y']),
                has_signal=kind.startswith('traffic_light'),
                shape=_shape(shape) if shape.strip() else (),
            )
        )
    return tuple(sorted(junctions, key=lambda junction: junction.id))


def _crossings(elements: list[Xml.Element], links: list[Xml.Element]) -> tuple[Crossing, ...]:
    onto = {link.attrib['to']: link for link in links if link.attrib['from'].startswith(':')}
    crossings = []
    for element in elements:
        id_ = element.attrib['id']
        lane = _first_lane(element)
        centre_line = _shape(lane.attrib['shape'])
        width_m = float(lane.get('width', _DEFAULT_LANE_WIDTH_M))
        entry = onto.get(id_)
        has_signal = entry is not None and entry.get('tl') is not None
        crossings.append(
            Crossing(
                id=id_,
                junction_id=id_[1:].rpartition('_c')[0],
                edge_ids=tuple(sorted(element.get('crossingEdges', '').split())),
                centre_line=centre_line,
                width_m=width_m,
                # Not the file's outlineShape: it follows the kerb and may cross itself.
                polygon=_strip(centre_line, width_m),
                has_signal=has_signal,
                has_priority=entry is not None and not has_signal and entry.get('state') == 'M',
            )
        )
    return tuple(sorted(crossings, key=lambda crossing: crossing.id))


def _strip(line: Points, width_m: float) -> Points:
    """Return the rectangle around the straight line from the first to the last point."""
    (ax, ay), (bx, by) = line[0], line[-1]
    length = Polyline((line[0], line[-1])).length_m
    nx, ny = -(by - ay) / length * width_m / 2.0, (bx - ax) / length * width_m / 2.0
    return ((ax + nx, ay + ny), (bx + nx, by + ny), (bx - nx, by - ny), (ax - nx, ay - ny))


def _connections(links: list[Xml.Element]) -> tuple[Connection, ...]:
    """Join each lane-to-lane link with the lanes inside the junction that it runs through."""
    next_via = {
        _lane_id(link, 'from'): link.attrib['via']
        for link in links
        if link.attrib['from'].startswith(':') and 'via' in link.attrib
    }
    connections = []
    for link in links:
        if link.attrib['from'].startswith(':') or link.attrib['to'].startswith(':'):
            continue
        via: list[str] = []
        lane_id = link.get('via')
        while lane_id is not None and lane_id not in via:
            via.append(lane_id)
            lane_id = next_via.get(lane_id)
        connections.append(
            Connection(
                from_lane_id=_lane_id(link, 'from'),
                to_lane_id=_lane_id(link, 'to'),
                via_lane_ids=tuple(via),
                direction=link.get('dir', ''),
                signal_id=link.get('tl'),
                signal_index=int(link.get('linkIndex', '-1')) if 'tl' in link.attrib else -1,
            )
        )
    return tuple(sorted(connections, key=lambda c: (c.from_lane_id, c.to_lane_id)))


def _lane_id(link: Xml.Element, end: str) -> str:
    return f'{link.attrib[end]}_{link.attrib[end + "Lane"]}'
