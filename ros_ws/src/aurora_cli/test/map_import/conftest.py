# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Small files of each kind, written here, and a folder of own maps for each test."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from aurora_cli.testing.small_maps import small_city, xodr
from aurora_core.knowledge.config_files import config_path


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty folder of own maps."""
    folder = tmp_path / 'own'
    monkeypatch.setenv('AURORA_MAPS', str(folder))
    return folder


@pytest.fixture
def files(tmp_path: Path) -> SimpleNamespace:
    """A file of each kind."""
    folder = tmp_path / 'files'
    folder.mkdir()
    osm = folder / 'Small City.osm.gz'
    osm.write_bytes(gzip.compress(small_city().encode()))
    net = folder / 'junction2.net.xml'
    net.write_bytes(gzip.decompress(config_path('maps', 'junction', 'net.xml.gz').read_bytes()))
    road = folder / 'road.xodr'
    road.write_text(xodr(walkways=True))
    return SimpleNamespace(osm=osm, net=net, xodr=road, folder=folder)


@pytest.fixture
def call(call: Callable[..., SimpleNamespace]) -> Callable[..., SimpleNamespace]:
    """`aurora` as it is, but for imports: they leave out the measuring unless it is named."""

    def without_measuring(*arguments: str) -> SimpleNamespace:
        named = '--measure' in arguments or arguments[:2] != ('map', 'import')
        return call(*arguments, *(() if named else ('--no-measure',)))

    return without_measuring
