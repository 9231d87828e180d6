# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The manifest of a map folder (`map.json`): where it lies, what belongs to it, the digests."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from aurora_core.document import first_problem
from aurora_core.errors import MapError
from aurora_core.files import MANIFEST_BYTES, MAP_BYTES, read_bytes

MANIFEST_NAME = 'map.json'
SCHEMA_VERSION = 1
NAME_PATTERN = r'^[a-z0-9][a-z0-9_-]*$'
_BUILD_HINT = 'restore the file; build a bundled map again with `make maps`, import your own again'


class MapFile(BaseModel):
    """A file of the map with its sha256 (hex) and size in bytes."""

    model_config = ConfigDict(frozen=True, extra='forbid')

    name: str = Field(pattern=r'^[A-Za-z0-9_.-]+$')
    sha256: str = Field(pattern=r'^[0-9a-f]{64}$')
    size_bytes: int = Field(ge=0)


class MapManifest(BaseModel):
    """Facts about a map and the digests that make it verifiable.

    The map frame is ENU metres with its origin at the geographic origin; `projection` (PROJ) turns
    longitude and latitude into it. `extent_m` is west, south, east, north. `digest` covers every
    other field, and with the file hashes every file.
    """

    model_config = ConfigDict(frozen=True, extra='forbid')

    schema_version: int = Field(ge=SCHEMA_VERSION, le=SCHEMA_VERSION)
    name: str = Field(pattern=NAME_PATTERN)
    version: str
    description: str
    licence: str
    origin_latitude_deg: float = Field(ge=-90.0, le=90.0)
    origin_longitude_deg: float = Field(ge=-180.0, le=180.0)
    projection: str
    extent_m: tuple[float, float, float, float]
    files: tuple[MapFile, ...]
    digest: str = Field(default='', pattern=r'^([0-9a-f]{64})?$')

    def computed_digest(self) -> str:
        """Return the sha256 (hex) over the canonical JSON of every field but the digest."""
        content = self.model_dump(mode='json', exclude={'digest'})
        canonical = json.dumps(content, sort_keys=True, separators=(',', ':'), ensure_ascii=True)
        return hashlib.sha256(canonical.encode('ascii')).hexdigest()


def describe_file(path: Path) -> MapFile:
    """Return name, hash and size of a file."""
    data = read_bytes(path, MAP_BYTES)
    return MapFile(name=path.name, sha256=hashlib.sha256(data).hexdigest(), size_bytes=len(data))


def read_manifest(folder: Path) -> MapManifest:
    """Read a manifest and check it against itself and against the files.

    Args:
        folder: Map folder.

    Raises:
        MapError: When the manifest is missing or damaged, or when a file is missing or changed.
    """
    path = folder / MANIFEST_NAME
    try:
        manifest = MapManifest.model_validate_json(read_bytes(path, MANIFEST_BYTES))
    except (OSError, ValidationError) as err:
        raise MapError(
            f'expected a map manifest in {path}, but: {first_problem(err)}', hint=_BUILD_HINT
        ) from err
    for expected in manifest.files:
        file = folder / expected.name
        if not file.is_file():
            raise MapError(
                f'map {manifest.name}: expected file {file}, found none', hint=_BUILD_HINT
            )
        found = describe_file(file)
        if found.sha256 != expected.sha256:
            raise MapError(
                f'map {manifest.name}: {file} has changed: expected sha256 {expected.sha256}, '
                f'found {found.sha256}',
                hint=_BUILD_HINT,
            )
    if manifest.computed_digest() != manifest.digest:
        raise MapError(
            f'map {manifest.name}: {path} has changed: expected digest {manifest.digest}, found '
            f'{manifest.computed_digest()}',
            hint=_BUILD_HINT,
        )
    return manifest


def write_manifest(folder: Path, manifest: MapManifest) -> MapManifest:
    """Write a manifest with its digest filled in and return it."""
    content = manifest.model_dump(mode='json') | {'digest': manifest.computed_digest()}
    complete = MapManifest.model_validate(content)
    text = json.dumps(complete.model_dump(mode='json'), indent=2, ensure_ascii=False)
    (folder / MANIFEST_NAME).write_text(text + '\n', encoding='utf-8')
    return complete
