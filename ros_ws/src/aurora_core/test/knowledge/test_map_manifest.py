# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A manifest vouches for every file and for itself."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.map_manifest import (
    MANIFEST_NAME,
    MapManifest,
    describe_file,
    read_manifest,
    write_manifest,
)


def _folder(tmp_path: Path) -> Path:
    (tmp_path / 'net.xml.gz').write_bytes(b'roads')
    manifest = MapManifest(
        schema_version=1,
        name='tiny',
        version='1.0.0',
        description='',
        licence='Apache-2.0',
        origin_latitude_deg=1.0,
        origin_longitude_deg=2.0,
        projection='+proj=tmerc',
        extent_m=(0.0, 0.0, 1.0, 1.0),
        files=(describe_file(tmp_path / 'net.xml.gz'),),
    )
    write_manifest(tmp_path, manifest)
    return tmp_path


def test_round_trip_keeps_every_field(tmp_path: Path) -> None:
    manifest = read_manifest(_folder(tmp_path))
    assert manifest.name == 'tiny'
    assert manifest.files[0].size_bytes == 5
    assert manifest.digest == manifest.computed_digest()
    assert len(manifest.digest) == 64


def test_changed_file_is_named(tmp_path: Path) -> None:
    folder = _folder(tmp_path)
    (folder / 'net.xml.gz').write_bytes(b'road5')
    with pytest.raises(MapError, match=r'net\.xml\.gz has changed') as caught:
        read_manifest(folder)
    assert 'make maps' in caught.value.hint


def test_missing_file_is_named(tmp_path: Path) -> None:
    folder = _folder(tmp_path)
    (folder / 'net.xml.gz').unlink()
    with pytest.raises(MapError, match=r'expected file .*net\.xml\.gz'):
        read_manifest(folder)


def test_changed_manifest_is_refused(tmp_path: Path) -> None:
    folder = _folder(tmp_path)
    path = folder / MANIFEST_NAME
    document = json.loads(path.read_text())
    document['origin_latitude_deg'] = 1.5
    path.write_text(json.dumps(document))
    with pytest.raises(MapError, match=r'map\.json has changed'):
        read_manifest(folder)


@pytest.mark.parametrize(
    'change',
    [{'unknown': 1}, {'origin_latitude_deg': 95.0}, {'schema_version': 2}, {'digest': 'abc'}],
)
def test_manifest_out_of_its_schema_is_refused(tmp_path: Path, change: dict[str, object]) -> None:
    folder = _folder(tmp_path)
    path = folder / MANIFEST_NAME
    path.write_text(json.dumps(json.loads(path.read_text()) | change))
    with pytest.raises(MapError, match='expected a map manifest') as caught:
        read_manifest(folder)
    assert next(iter(change)) in caught.value.message
    assert '\n' not in caught.value.message


@pytest.mark.parametrize('data', [b'', b'[]', b'{"schema_version": 1, "na', b'\xff'])
def test_a_manifest_that_is_none_is_told_in_one_line(tmp_path: Path, data: bytes) -> None:
    folder = _folder(tmp_path)
    (folder / MANIFEST_NAME).write_bytes(data)
    with pytest.raises(MapError, match='expected a map manifest') as caught:
        read_manifest(folder)
    assert '\n' not in caught.value.message
    assert 'pydantic' not in caught.value.message


def test_file_outside_the_folder_cannot_be_listed(tmp_path: Path) -> None:
    folder = _folder(tmp_path)
    path = folder / MANIFEST_NAME
    document = json.loads(path.read_text())
    document['files'][0]['name'] = '../net.xml.gz'
    path.write_text(json.dumps(document))
    with pytest.raises(MapError, match='expected a map manifest'):
        read_manifest(folder)
