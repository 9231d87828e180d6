# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Take in a file that somebody else made: what it is, and that it may be handed on.

Nothing of it reaches netconvert or a tree of elements before one pass has shown that it is whole,
defines no entities and is no larger than a map.
"""

from __future__ import annotations

import hashlib
import zlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import Enum
from io import BufferedReader
from pathlib import Path
from xml.parsers import expat

from aurora_core.errors import MapError
from aurora_core.files import XML_BYTES, UnreadableFileError, open_regular

# A city centre has 20,000 nodes in OpenStreetMap, a city of a million people half a million.
MOST_NODES = 500_000
MOST_ELEMENTS = 5_000_000
_MOST_DEPTH = 64
_PIECE_BYTES = 1 << 20
_GZIP = b'\x1f\x8b'
_PBF = b'OSMHeader'
_OTHER_ARCHIVES = {b'BZh': 'bzip2', b'PK\x03\x04': 'zip', b'\xfd7zXZ': 'xz', b'7z\xbc\xaf': '7z'}
_CUT = (
    'cut out a smaller part, for example `osmium extract --bbox WEST,SOUTH,EAST,NORTH`, or export '
    'one on openstreetmap.org'
)
_KINDS_HINT = (
    'import an OpenStreetMap extract (.osm, .osm.gz, .osm.pbf), a SUMO network '
    '(.net.xml, .net.xml.gz) or OpenDRIVE (.xodr)'
)


class SourceKind(Enum):
    """What a file holds."""

    OSM = 'OpenStreetMap'
    OSM_PBF = 'OpenStreetMap (PBF)'
    SUMO = 'SUMO network'
    OPENDRIVE = 'OpenDRIVE'


_ROOTS = {'osm': SourceKind.OSM, 'net': SourceKind.SUMO, 'OpenDRIVE': SourceKind.OPENDRIVE}


@dataclass(frozen=True, slots=True, kw_only=True)
class Source:
    """A file that may be imported.

    Args:
        kind: What it holds.
        path: Unpacked copy.
        given: File as the user named it.
        sha256: Of that file (hex).
    """

    kind: SourceKind
    path: Path
    given: Path
    sha256: str


def take_in(given: Path, scratch: Path) -> Source:
    """Copy a file, unpacked, into a folder and say what it is.

    Args:
        given: File of the user.
        scratch: Folder for the copy.

    Raises:
        MapError: It is empty, broken off, damaged, of another kind, too large, or dangerous.
        UnreadableFileError: It is a pipe or a device, or larger than any map.
        OSError: The copy cannot be written.
    """
    copy = scratch / 'source'
    digest = hashlib.sha256()
    try:
        opened = open_regular(given, XML_BYTES)
    except UnreadableFileError:
        raise
    except OSError as err:
        raise MapError(
            f'{given} cannot be read: {err.strerror or err}',
            hint='name one file that you may read',
        ) from err
    with opened as stream, copy.open('wb') as out:
        head = stream.peek(64)[:64]
        if not head:
            raise MapError(f'{given} is empty', hint='download or export it again')
        for magic, name in _OTHER_ARCHIVES.items():
            if head.startswith(magic):
                raise MapError(f'{given} is packed with {name}', hint='unpack it first')
        pieces = _pieces(stream, digest.update)
        for piece in _unpacked(given, pieces) if head.startswith(_GZIP) else pieces:
            out.write(piece)
    with copy.open('rb') as stream:
        head = stream.read(64)
    if head[4:].lstrip(b'\n').lstrip(b'\t').startswith(_PBF):
        kind = SourceKind.OSM_PBF
    else:
        kind = check_xml(copy, given)
    return Source(kind=kind, path=copy, given=given, sha256=digest.hexdigest())


def _pieces(stream: BufferedReader, seen: Callable[[bytes], object]) -> Iterator[bytes]:
    while piece := stream.read(_PIECE_BYTES):
        seen(piece)
        yield piece


def _unpacked(given: Path, pieces: Iterator[bytes]) -> Iterator[bytes]:
    """Unpack gzip, no more of it than a map has."""
    total = 0
    unpacker = zlib.decompressobj(16 + zlib.MAX_WBITS)
    try:
        for piece in pieces:
            data = piece
            while data:
                if unpacker.eof:
                    data = data.lstrip(b'\0')
                    unpacker = zlib.decompressobj(16 + zlib.MAX_WBITS)
                    continue
                part = unpacker.decompress(data, _PIECE_BYTES)
                total += len(part)
                if total > XML_BYTES:
                    raise MapError(
                        f'{given} unpacks to more than {XML_BYTES >> 20} MiB', hint=_CUT
                    )
                yield part
                data = unpacker.unused_data if unpacker.eof else unpacker.unconsumed_tail
    except zlib.error as err:
        raise MapError(
            f'{given} is a damaged gzip archive: {err}', hint='download it again'
        ) from err
    if not unpacker.eof:
        raise MapError(f'{given} breaks off inside its gzip archive', hint='download it again')


class _Checker:
    """Sees every element of an XML document once."""

    def __init__(self, given: Path) -> None:
        self.kind: SourceKind | None = None
        self.nodes = 0
        self._given = given
        self._elements = 0
        self._depth = 0

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        if self.kind is None:
            self.kind = _ROOTS.get(tag)
            if self.kind is None:
                raise MapError(
                    f'{self._given} is XML of another kind: it begins with <{tag[:40]}>',
                    hint=_KINDS_HINT,
                )
            if tag == 'net' and attributes.get('lefthand', '') in ('true', '1'):
                raise MapError(
                    f'{self._given} is a network for driving on the left',
                    hint='AURORA places vehicles for driving on the right only',
                )
        if tag == 'include':
            raise MapError(
                f'{self._given} includes other files',
                hint='import one file that holds everything',
            )
        self._depth += 1
        self._elements += 1
        if tag == 'node' and self.kind is SourceKind.OSM:
            self.nodes += 1
            if self.nodes > MOST_NODES:
                raise too_many_nodes(self._given)
        if self._depth > _MOST_DEPTH or self._elements > MOST_ELEMENTS:
            raise MapError(
                f'{self._given} has more than {MOST_ELEMENTS} elements or nests them more than '
                f'{_MOST_DEPTH} deep',
                hint=_CUT,
            )

    def end(self, _tag: str) -> None:
        self._depth -= 1

    def refuse(self, *_: object) -> None:
        raise MapError(
            f'{self._given} defines a document type or entities, which no map needs and which '
            'could unfold without end or name other files',
            hint='remove the <!DOCTYPE …> part if you trust the rest',
        )


def too_many_nodes(given: Path) -> MapError:
    """Return the error of an extract that is larger than a scenario needs."""
    return MapError(f'{given} has more than {MOST_NODES} nodes, a whole region', hint=_CUT)


def check_xml(path: Path, given: Path) -> SourceKind:
    """Read an XML file once, from beginning to end, and return what it holds.

    Args:
        path: Unpacked copy.
        given: File as the user named it, for messages.

    Raises:
        MapError: It is no XML, breaks off, is of another kind, too large, or defines entities.
    """
    if path.stat().st_size > XML_BYTES:
        raise MapError(f'{given} has more than {XML_BYTES >> 20} MiB', hint=_CUT)
    checker = _Checker(given)
    parser = expat.ParserCreate()
    parser.StartElementHandler = checker.start
    parser.EndElementHandler = checker.end
    parser.StartDoctypeDeclHandler = checker.refuse
    parser.EntityDeclHandler = checker.refuse
    try:
        with path.open('rb') as stream:
            while piece := stream.read(_PIECE_BYTES):
                parser.Parse(piece, False)
            parser.Parse(b'', True)
    except (expat.ExpatError, ValueError, LookupError) as err:  # the last: of its encoding
        if checker.kind is None:
            raise MapError(f'{given} is neither XML nor PBF ({err})', hint=_KINDS_HINT) from err
        raise MapError(
            f'{given} is damaged or breaks off: {err}', hint='download or export it again'
        ) from err
    if checker.kind is None:
        raise MapError(f'{given} has no content', hint=_KINDS_HINT)
    return checker.kind
