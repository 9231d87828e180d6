# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An OpenStreetMap extract as plain values."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.sax.saxutils import quoteattr

import osmium

from aurora_cli.map_import.source import (
    MOST_ELEMENTS,
    MOST_NODES,
    Source,
    SourceKind,
    too_many_nodes,
)
from aurora_core.errors import MapError

Tags = dict[str, str]
Degrees = tuple[float, float]  # longitude, latitude
_MOST_SAID = 200  # a reader may quote what it finds at any length
_MEMBER_KINDS = {'n': 'node', 'w': 'way', 'r': 'relation'}


@dataclass(frozen=True, slots=True)
class OsmWay:
    """A line or ring of nodes."""

    id: int
    nodes: tuple[int, ...]
    tags: Tags

    @property
    def is_ring(self) -> bool:
        """Whether it ends where it begins."""
        return len(self.nodes) > 3 and self.nodes[0] == self.nodes[-1]


@dataclass(frozen=True, slots=True)
class OsmRelation:
    """A group; members are (kind, id, role)."""

    id: int
    members: tuple[tuple[str, int, str], ...]
    tags: Tags


@dataclass(slots=True)
class OsmData:
    """What an extract holds.

    Args:
        positions: Longitude and latitude (degrees) of each node.
        node_tags: Tags of the nodes that have some.
        ways: Ways by id.
        relations: Relations by id.
    """

    positions: dict[int, Degrees] = field(default_factory=dict)
    node_tags: dict[int, Tags] = field(default_factory=dict)
    ways: dict[int, OsmWay] = field(default_factory=dict)
    relations: dict[int, OsmRelation] = field(default_factory=dict)

    def road_nodes(self) -> Iterator[Degrees]:
        """Return the positions of the nodes of all roads."""
        for way in self.ways.values():
            if 'highway' in way.tags:
                yield from (self.positions[n] for n in way.nodes if n in self.positions)


def read_osm(source: Source) -> OsmData:
    """Read an extract: positions, references and tags; who edited what and when is passed over.

    Args:
        source: XML or PBF, as `take_in` returned it.

    Raises:
        MapError: It is damaged, an element lacks what it must have, or it is a whole region.
    """
    data, count = OsmData(), 0
    kind = 'osm.pbf' if source.kind is SourceKind.OSM_PBF else 'osm'
    try:
        for element in osmium.FileProcessor(osmium.io.File(str(source.path), kind)):
            count += _add(element, data)
            if len(data.positions) > MOST_NODES or count > MOST_ELEMENTS:
                raise too_many_nodes(source.given)
    except (RuntimeError, ValueError, osmium.InvalidLocationError) as err:
        raise MapError(
            f'{source.given} is damaged: {str(err)[:_MOST_SAID]}',
            hint='download or export it again',
        ) from err
    return data


def _add(element: Any, data: OsmData) -> int:
    """Take an element over; return how many elements it has as XML."""
    if not element.visible:
        return 1
    parts, tags = 0, dict(element.tags)
    if element.is_node():
        data.positions[element.id] = (element.location.lon, element.location.lat)
        if tags:
            data.node_tags[element.id] = tags
    elif element.is_way():
        nodes = tuple(node.ref for node in element.nodes)
        parts = len(nodes)
        data.ways[element.id] = OsmWay(element.id, nodes, tags)
    elif element.is_relation():
        members = tuple((_MEMBER_KINDS[m.type], m.ref, m.role) for m in element.members)
        parts = len(members)
        data.relations[element.id] = OsmRelation(element.id, members, tags)
    return 1 + len(tags) + parts


def write_osm_xml(data: OsmData, path: Path) -> None:
    """Write an extract as XML, which netconvert reads.

    Raises:
        OSError: No room.
    """
    with path.open('w', encoding='utf-8') as out:
        out.write("<?xml version='1.0' encoding='UTF-8'?>\n<osm version=\"0.6\">\n")
        for node, (lon_deg, lat_deg) in data.positions.items():
            head = f'<node id="{node}" lat="{lat_deg:.7f}" lon="{lon_deg:.7f}"'
            tags = data.node_tags.get(node)
            out.write(f'{head}>{_tags(tags)}</node>\n' if tags else f'{head}/>\n')
        for way in data.ways.values():
            nodes = ''.join(f'<nd ref="{n}"/>' for n in way.nodes)
            out.write(f'<way id="{way.id}">{nodes}{_tags(way.tags)}</way>\n')
        for relation in data.relations.values():
            members = ''.join(
                f'<member type="{kind}" ref="{ref}" role={quoteattr(role)}/>'
                for kind, ref, role in relation.members
            )
            out.write(f'<relation id="{relation.id}">{members}{_tags(relation.tags)}</relation>\n')
        out.write('</osm>\n')


def _tags(tags: Tags) -> str:
    return ''.join(f'<tag k={_quoted(key)} v={_quoted(value)}/>' for key, value in tags.items())


def _quoted(text: str) -> str:
    return quoteattr(''.join(c for c in text if c >= ' ' or c in '\t\n'))
