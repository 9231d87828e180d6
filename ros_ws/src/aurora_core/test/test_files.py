# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Pipes, devices, huge files and archives that never end are refused at once."""

from __future__ import annotations

import gzip
import os
import zlib
from collections.abc import Callable
from pathlib import Path

import pytest

from aurora_core import files
from aurora_core.errors import AuroraError
from aurora_core.files import (
    UnreadableFileError,
    open_regular,
    read_bytes,
    read_json,
    read_text,
    read_xml,
)

pytestmark = pytest.mark.timeout(30)

READERS: tuple[Callable[[Path], object], ...] = (
    lambda path: open_regular(path, 100).close(),
    lambda path: read_bytes(path, 100),
    lambda path: read_text(path, 100),
    lambda path: read_json(path, 100),
    read_xml,
)


def pipe(folder: Path) -> Path:
    path = folder / 'pipe'
    os.mkfifo(path)
    return path


def link_to_zero(folder: Path) -> Path:
    path = folder / 'zero'
    path.symlink_to('/dev/zero')
    return path


def sparse(folder: Path) -> Path:
    path = folder / 'sparse'
    with path.open('wb') as stream:
        stream.truncate(1 << 40)
    return path


@pytest.mark.parametrize('read', READERS)
@pytest.mark.parametrize('make', [pipe, link_to_zero, sparse])
def test_what_has_no_end_is_refused(
    tmp_path: Path, make: Callable[[Path], Path], read: Callable[[Path], object]
) -> None:
    with pytest.raises(UnreadableFileError) as refused:
        read(make(tmp_path))
    assert isinstance(refused.value, AuroraError)
    assert isinstance(refused.value, OSError)  # as all that cannot be read
    assert refused.value.hint


@pytest.mark.parametrize('read', READERS)
def test_what_is_missing_or_a_folder_is_told_as_ever(
    tmp_path: Path, read: Callable[[Path], object]
) -> None:
    with pytest.raises(FileNotFoundError):
        read(tmp_path / 'none')
    with pytest.raises(IsADirectoryError):
        read(tmp_path)


def test_a_file_as_large_as_allowed_is_read(tmp_path: Path) -> None:
    path = tmp_path / 'file'
    path.write_bytes(b'a\r\n' * 10)
    assert read_bytes(path, 30) == b'a\r\n' * 10
    assert read_text(path, 30) == 'a\n' * 10
    with pytest.raises(UnreadableFileError, match='29 bytes'):
        read_bytes(path, 29)


def test_a_file_that_grows_while_it_is_read_is_cut_off(tmp_path: Path) -> None:
    path = Path('/proc/self/status')  # says that it has no bytes, and has hundreds
    with pytest.raises(UnreadableFileError):
        read_bytes(path, 10)


def test_json_without_end_of_nesting_is_no_json(tmp_path: Path) -> None:
    path = tmp_path / 'deep.json'
    path.write_text('[' * 200_000)
    with pytest.raises(ValueError, match=r'deep|nest'):
        read_json(path, files.DOCUMENT_BYTES)


def test_an_archive_is_unpacked(tmp_path: Path) -> None:
    path = tmp_path / 'net.xml.gz'
    whole = b'<?xml version="1.0"?>\n<!-- made by hand -->\n<net><edge id="a"/></net>'
    path.write_bytes(gzip.compress(whole[:30], mtime=0) + gzip.compress(whole[30:], mtime=0))
    assert [edge.get('id') for edge in read_xml(path)] == ['a']


def test_an_archive_that_unpacks_to_more_than_a_map_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(files, 'XML_BYTES', 4 << 20)
    path = tmp_path / 'net.xml.gz'
    path.write_bytes(gzip.compress(b'<net>' + b' ' * (100 << 20) + b'</net>'))
    assert path.stat().st_size < 1 << 20
    with pytest.raises(UnreadableFileError):
        read_xml(path)


@pytest.mark.parametrize(
    'content',
    [
        b'',
        b'no archive',
        gzip.compress(b'<net></net>', mtime=0)[:-9],
        gzip.compress(b'<net></net>', mtime=0)[:15],
        gzip.compress(b'<net></net>', mtime=0)[:-5] + b'\xff' * 5,
        zlib.compress(b'<net></net>'),
        gzip.compress(b'<net>', mtime=0),
    ],
)
def test_a_damaged_archive_is_told(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / 'net.xml.gz'
    path.write_bytes(content)
    with pytest.raises(ValueError):
        read_xml(path)


@pytest.mark.parametrize(
    'prolog',
    [
        '<!DOCTYPE net [<!ENTITY a "ha"><!ENTITY b "&a;&a;&a;&a;">]>',
        '<!DOCTYPE net SYSTEM "file:///etc/passwd">',
        '<!-- first -->\n<!DOCTYPE net>',
    ],
)
@pytest.mark.parametrize('encoding', ['utf-8', 'utf-16'])
def test_entities_are_refused_before_they_unfold(
    tmp_path: Path, prolog: str, encoding: str
) -> None:
    path = tmp_path / 'net.xml'
    text = f'<?xml version="1.0" encoding="{encoding}"?>{prolog}<net></net>'
    path.write_text(text, encoding=encoding)
    with pytest.raises(ValueError, match='document type'):
        read_xml(path)
