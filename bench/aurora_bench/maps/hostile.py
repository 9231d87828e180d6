# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Files that are no map: empty, broken, of another kind, or made to do harm. One of each class."""

from __future__ import annotations

import gzip
import os
import re
import struct
import zlib
from collections.abc import Callable
from pathlib import Path

from aurora_core.knowledge.config_files import config_path

Make = Callable[[Path], None]

_HEAD = '<?xml version="1.0"?>'
_ROAD = (
    '<way id="9"><nd ref="1"/><nd ref="2"/><tag k="highway" v="primary"/>'
    '<tag k="name" v="{}"/></way>'
)
_NODES = '<node id="1" lat="60" lon="24"/><node id="2" lat="{}" lon="24"/>'
_LAUGHS = ''.join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 10))
_MILLION = 1_000_000
_CORNERS = 100_000


def osm(*parts: str) -> bytes:
    """Return an OpenStreetMap document of parts."""
    return f'{_HEAD}<osm version="0.6">{"".join(parts)}</osm>'.encode()


def _bytes(data: bytes) -> Make:
    def write(path: Path) -> None:
        path.write_bytes(data)

    return write


def _unpacks_without_end(path: Path) -> None:
    """Two million times the zeros of a page, packed twice as a part of a document."""
    with gzip.open(path, 'wb', compresslevel=9) as out:
        out.write(b'<osm version="0.6">')
        for _ in range(1024):
            out.write(b' ' * (1 << 20))


def _a_million_nodes(path: Path) -> None:
    with gzip.open(path, 'wt', compresslevel=1, encoding='ascii') as out:
        out.write('<osm version="0.6">')
        for k in range(1, _MILLION + 1):
            out.write(f'<node id="{k}" lat="60.{k % 9999:04d}" lon="24"/>')
        out.write('</osm>')


def pbf_blob(kind: bytes, body: bytes, raw_size: int) -> bytes:
    """Return a block of a PBF file whose packed body claims a size."""

    def field(number: int, data: bytes) -> bytes:
        return _varint(number << 3 | 2) + _varint(len(data)) + data

    blob = _varint(2 << 3) + _varint(raw_size) + field(3, zlib.compress(body, 9))
    header = field(1, kind) + _varint(3 << 3) + _varint(len(blob))
    return struct.pack('>I', len(header)) + header + blob


def _varint(value: int) -> bytes:
    out = bytearray()
    while value > 127:
        out.append(value & 127 | 128)
        value >>= 7
    return bytes([*out, value])


def _pbf_bomb(path: Path) -> None:
    """A header, then a block that unpacks to a gibibyte and says so."""
    head = pbf_blob(b'OSMHeader', b'"\x0eOsmSchema-V0.6', 16)
    path.write_bytes(head + pbf_blob(b'OSMData', bytes(1 << 28), 1 << 30))


def _scribble(path: Path) -> None:
    """A building of a hundred thousand corners, each in another part of the town."""
    nodes = ''.join(
        f'<node id="{k + 10}" lat="60.00{k * 37 % 101:03d}" lon="24.00{k * 53 % 97:03d}"/>'
        for k in range(_CORNERS)
    )
    ring = ''.join(f'<nd ref="{k + 10}"/>' for k in (*range(_CORNERS), 0))
    building = f'<way id="99">{ring}<tag k="building" v="yes"/></way>'
    # Streets round a block, so that vehicles have somewhere to drive.
    corners = ''.join(
        f'<node id="{k}" lat="{lat}" lon="{lon}"/>'
        for k, (lat, lon) in enumerate(((60, 24), (60.002, 24), (60.002, 24.004), (60, 24.004)), 1)
    )
    block = ''.join(f'<nd ref="{k}"/>' for k in (1, 2, 3, 4, 1))
    street = f'<way id="9">{block}<tag k="highway" v="primary"/></way>'
    path.write_bytes(osm(corners, nodes, street, building))


def _road(length_m: str, lanes: int) -> Make:
    """One curved road of OpenDRIVE."""
    right = ''.join(
        f'<lane id="-{k}" type="driving"><width sOffset="0" a="3" b="0" c="0" d="0"/></lane>'
        for k in range(1, lanes + 1)
    )
    return _bytes(
        f'<OpenDRIVE><road name="r" length="{length_m}" id="1" junction="-1"><planView><geometry '
        f's="0" x="0" y="0" hdg="0" length="{length_m}"><arc curvature="1e-9"/></geometry>'
        '</planView><lanes><laneSection s="0"><center><lane id="0" type="none"/></center>'
        f'<right>{right}</right></laneSection></lanes></road></OpenDRIVE>'.encode()
    )


def _signals_without_time(path: Path) -> None:
    """A network whose signals change in no time."""
    packed = config_path('maps', 'junction', 'net.xml.gz').read_bytes()
    path.write_bytes(re.sub(rb'duration="[0-9]+"', b'duration="0"', gzip.decompress(packed)))


def _pipe(path: Path) -> None:
    os.mkfifo(path)


def _link_to_device(path: Path) -> None:
    path.symlink_to('/dev/zero')


def _link_to_nowhere(path: Path) -> None:
    path.symlink_to('nowhere.osm')


def _folder(path: Path) -> None:
    path.mkdir()


CLASSES: dict[str, tuple[str, Make]] = {
    'empty': ('empty.osm', _bytes(b'')),
    'broken off': ('short.osm', _bytes(osm(_NODES.format(60.001), _ROAD.format('A'))[:-20])),
    'gzip that breaks off': (
        'short.osm.gz', _bytes(gzip.compress(osm(_NODES.format(60.001)) * 50)[:60])
    ),
    'damaged gzip': ('damaged.osm.gz', _bytes(b'\x1f\x8b\x08' + bytes(range(200)))),
    'another kind of XML': ('page.osm', _bytes(b'<html><body>no map</body></html>')),
    'no XML at all': ('text.xodr', _bytes(b'not a map at all')),
    'archive of another kind': ('packed.osm', _bytes(b'PK\x03\x04' + bytes(64))),
    'entity bomb': (
        'laughs.osm',
        _bytes(f'{_HEAD}<!DOCTYPE osm [<!ENTITY e0 "ha">{_LAUGHS}]>'
               '<osm version="0.6"><node id="1" lat="&e9;" lon="1"/></osm>'.encode()),
    ),
    'external entity': (
        'external.osm',
        _bytes(f'{_HEAD}<!DOCTYPE osm [<!ENTITY x SYSTEM "file:///etc/passwd">]>'
               '<osm version="0.6"><node id="1" lat="1" lon="&x;"/></osm>'.encode()),
    ),
    'included file': ('include.net.xml', _bytes(b'<net><include href="/etc/passwd"/></net>')),
    'nested without end': ('deep.osm', _bytes(b'<osm>' + b'<a>' * 1_000_000)),
    'unpacks without end': ('bomb.osm.gz', _unpacks_without_end),
    'PBF block that unpacks without end': ('bomb.osm.pbf', _pbf_bomb),
    'PBF that breaks off': (
        'cut.osm.pbf', _bytes(b'\0\0\0\x0d\x0a\x09OSMHeader\x18\x7f' + b'x' * 20)
    ),
    'a million nodes': ('region.osm.gz', _a_million_nodes),
    'coordinate that is no number': (
        'nan.osm', _bytes(osm(_NODES.format('nan'), _ROAD.format('A')))
    ),
    'coordinate beyond the Earth': (
        'far.osm', _bytes(osm(_NODES.format('1e9'), _ROAD.format('A')))
    ),
    'network with points that are no numbers': (
        'nan.net.xml',
        _bytes(b'<net version="1.20"><location netOffset="0,0" convBoundary="0,0,9,9" '
               b'origBoundary="0,0,9,9" projParameter="!"/><edge id="a" from="p" to="q" '
               b'priority="1"><lane id="a_0" index="0" speed="9" length="nan" '
               b'shape="nan,0 inf,9"/></edge></net>'),
    ),
    'no road': ('points.osm', _bytes(osm(_NODES.format(60.001)))),
    'half the world': ('world.osm', _bytes(osm(_NODES.format(1), _ROAD.format('A')))),
    'driving on the left': ('left.net.xml', _bytes(b'<net version="1.20" lefthand="true"></net>')),
    'encoding that nobody has': (
        'encoding.osm', _bytes(b'<?xml version="1.0" encoding="x-none"?><osm/>')
    ),
    'identifier without end': (
        'long.osm', _bytes(osm('<node id="', 'x' * 100_000, '" lat="60" lon="24"/>'))
    ),
    'a million lanes': (
        'lanes.osm',
        _bytes(osm(_NODES.format(60.001), _ROAD.format('A').replace(
            '</way>', '<tag k="lanes" v="1000000"/></way>'))),
    ),
    'outline that crosses itself without end': ('scribble.osm', _scribble),
    'road without end': ('endless.xodr', _road('1e12', 1)),
    'road of thousands of lanes': ('wide.xodr', _road('200', 5000)),
    'signals that change in no time': ('frozen.net.xml', _signals_without_time),
    'pipe': ('pipe.osm', _pipe),
    'link to a device': ('device.osm', _link_to_device),
    'link to nowhere': ('nowhere2.osm', _link_to_nowhere),
    'folder': ('folder.osm', _folder),
}  # fmt: skip

# Names of maps that would leave the folder of maps, or hide in it.
NAMES = ('../x', 'a/b', '/tmp/x', '.x', '..', 'x\ny', 'X' * 3, 'x' * 65)
