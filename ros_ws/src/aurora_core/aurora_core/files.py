# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Read files that a user names: regular files only, and no more of them than their kind has.

A pipe without a writer, a device without an end, a file of a terabyte or an archive that unpacks
to one must neither stop a command nor fill the memory. What a reader here refuses is an
`OSError` too, so that callers say of what it was a part.
"""

from __future__ import annotations

import gzip
import io
import json
import os
import stat
import zlib
from io import BufferedReader
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as Xml
from xml.parsers import expat

from aurora_core.errors import AuroraError

_MIB = 1 << 20

# The most that each kind of file has; the largest that AURORA writes are a tenth of it.
CONFIG_BYTES = 4 * _MIB
MANIFEST_BYTES = 4 * _MIB
DOCUMENT_BYTES = 64 * _MIB  # specification, graph, verdict, report, certificate
TRANSCRIPT_BYTES = 64 * _MIB
MAP_BYTES = 64 * _MIB
XML_BYTES = 256 * _MIB  # a network after unpacking
BAG_BYTES = 4 << 30  # read piece by piece, never whole

_PIECE_BYTES = _MIB
_GZIP_WINDOW = 16 + zlib.MAX_WBITS


class UnreadableFileError(AuroraError, OSError):
    """A file that is not one, or that is larger than any of its kind."""

    default_component = 'files'


def open_regular(path: Path, most_bytes: int) -> BufferedReader:
    """Open a regular file for reading.

    Args:
        path: The file; a link is followed.
        most_bytes: What its kind has at most.

    Raises:
        UnreadableFileError: It is a pipe, a device, a socket, or larger.
        OSError: It is missing, a folder, or may not be read.
    """
    _check(path, os.stat(path), most_bytes)
    # Between the look and the opening it may have become a pipe: that must not wait either.
    descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC | os.O_NOCTTY)
    try:
        _check(path, os.fstat(descriptor), most_bytes)
        return os.fdopen(descriptor, 'rb')
    except BaseException:
        os.close(descriptor)
        raise


def read_bytes(path: Path, most_bytes: int) -> bytes:
    """Return what a regular file holds.

    Raises:
        UnreadableFileError: It is none, or larger than its kind has.
        OSError: It is missing, a folder, or may not be read.
    """
    with open_regular(path, most_bytes) as stream:
        data = stream.read(most_bytes + 1)
    if len(data) > most_bytes:
        raise _too_large(path, most_bytes)
    return data


def read_text(path: Path, most_bytes: int, errors: str = 'strict') -> str:
    """Return the text of a regular file in UTF-8.

    Raises:
        UnreadableFileError: It is none, or larger than its kind has.
        OSError: It is missing, a folder, or may not be read.
        UnicodeDecodeError: It is not UTF-8.
    """
    text = read_bytes(path, most_bytes).decode('utf-8', errors)
    return text.replace('\r\n', '\n').replace('\r', '\n')


def read_json(path: Path, most_bytes: int) -> Any:
    """Return the document in a regular file.

    Raises:
        UnreadableFileError: It is none, or larger than its kind has.
        OSError: It is missing, a folder, or may not be read.
        ValueError: It is no JSON, or nested beyond all measure.
    """
    data = read_bytes(path, most_bytes)
    try:
        return json.loads(data)
    except RecursionError as err:
        raise ValueError('it is nested too deeply') from err


def read_xml(path: Path) -> Xml.Element:
    """Return the root of an XML file of a map, compressed when its name ends in `.gz`.

    Raises:
        UnreadableFileError: It is no regular file, or larger than maps are, unpacked too.
        OSError: It is missing, a folder, or may not be read.
        ValueError: It is no XML or no archive, or it defines a document type or entities.
    """
    data = read_bytes(path, MAP_BYTES)
    if path.suffix == '.gz':
        data = _unpacked(path, data)
    _check_prolog(data)
    try:
        return Xml.fromstring(data)  # nosec B314
    except Xml.ParseError as err:
        raise ValueError(str(err)) from err


def _check(path: Path, found: os.stat_result, most_bytes: int) -> None:
    if stat.S_ISDIR(found.st_mode):
        raise IsADirectoryError(21, 'Is a directory', str(path))
    if not stat.S_ISREG(found.st_mode):
        raise UnreadableFileError(
            f'expected a regular file in {path}, found a pipe, a socket or a device',
            hint='copy what it gives into a file, and name that one',
        )
    if found.st_size > most_bytes:
        raise _too_large(path, most_bytes)


def _too_large(path: Path, most_bytes: int) -> UnreadableFileError:
    return UnreadableFileError(
        f'{path} has more than the {most_bytes} bytes that such a file has at most',
        hint='name the right file, or make it smaller',
    )


def _unpacked(path: Path, data: bytes) -> bytes:
    """Return what an archive holds, as far as a map may be large."""
    pieces: list[bytes] = []
    total = 0
    while data:
        unpacker = zlib.decompressobj(_GZIP_WINDOW)
        try:
            while not unpacker.eof:
                piece = unpacker.decompress(data, _PIECE_BYTES)
                data = unpacker.unconsumed_tail
                pieces.append(piece)
                total += len(piece)
                if total > XML_BYTES:
                    raise _too_large(path, XML_BYTES)
                if not piece and not data and not unpacker.eof:
                    raise ValueError('the archive breaks off')
        except zlib.error as err:
            raise ValueError(f'it is no archive: {err}') from err
        data = unpacker.unused_data.lstrip(b'\0')
    return b''.join(pieces)


class _FirstElement(Exception):  # noqa: N818  (control flow inside this file only)
    pass


def _check_prolog(data: bytes) -> None:
    """Refuse a document type: only there are entities defined, which could unfold without end."""

    def begins(*_: object) -> None:
        raise _FirstElement

    def refused(*_: object) -> None:
        raise ValueError('it defines a document type, which no file of a map does')

    parser = expat.ParserCreate()
    parser.StartElementHandler = begins
    parser.StartDoctypeDeclHandler = refused
    try:
        for start in range(0, len(data), _PIECE_BYTES):
            parser.Parse(data[start : start + _PIECE_BYTES], False)
    except _FirstElement:
        return
    except (expat.ExpatError, LookupError) as err:  # the latter: of its encoding
        raise ValueError(str(err)) from err


def gzip_reproducibly(data: bytes) -> bytes:
    """Compress without time stamp and file name, so that equal input gives equal bytes."""
    buffer = io.BytesIO()
    with gzip.GzipFile(filename='', mode='wb', compresslevel=9, fileobj=buffer, mtime=0) as file:
        file.write(data)
    return buffer.getvalue()
