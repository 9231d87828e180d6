# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Loading a map: complete, verified, refused when anything about it changed."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.map_folders import list_maps
from aurora_core.knowledge.map_manifest import describe_file, read_manifest, write_manifest
from aurora_core.knowledge.map_model import MapModel, load_map, load_map_folder


def _copy(model: MapModel, tmp_path: Path) -> Path:
    return Path(shutil.copytree(model.folder, tmp_path / model.name))


def test_shipped_maps_are_listed() -> None:
    assert {'downtown', 'junction'} <= set(list_maps())
    assert list(list_maps()) == sorted(list_maps())


def test_loaded_map_is_complete(junction: MapModel) -> None:
    assert junction.name == 'junction'
    assert junction.bounds_m == (-170.0, -170.0, 170.0, 170.0)
    assert [b.height_m for b in junction.buildings] == [60.0, 30.0, 15.0, 8.0]
    assert [z.id for z in junction.zones] == ['nofly_north_east']
    assert junction.landmark('South East House').x_m == 28.0
    assert junction.net_path.is_file()
    assert junction.stops_path.is_file()
    assert len(junction.digest) == 64


def test_two_loads_are_equal_and_quick(
    downtown: MapModel, steps_of: Callable[[Callable[[], object]], int]
) -> None:
    loaded: list[MapModel] = []
    # A map loads at the start of every run.
    assert steps_of(lambda: loaded.append(load_map('downtown'))) < 1_000_000
    (again,) = loaded
    assert again.digest == downtown.digest
    assert again.buildings == downtown.buildings
    assert again.landmarks == downtown.landmarks
    assert again.network.connections == downtown.network.connections
    assert list(again.network.lanes) == list(downtown.network.lanes)


def test_unknown_map_names_those_that_exist() -> None:
    with pytest.raises(MapError, match="no map 'atlantis'") as caught:
        load_map('atlantis')
    assert 'downtown, helsinki, junction' in caught.value.hint


def test_path_tricks_are_not_map_names() -> None:
    with pytest.raises(MapError, match='there is no map'):
        load_map('../maps/downtown')


@pytest.mark.parametrize('name', ['net.xml.gz', 'buildings.geojson', 'landmarks.geojson'])
def test_any_changed_file_is_refused(junction: MapModel, tmp_path: Path, name: str) -> None:
    folder = _copy(junction, tmp_path)
    data = bytearray((folder / name).read_bytes())
    data[len(data) // 2] ^= 1
    (folder / name).write_bytes(bytes(data))
    with pytest.raises(MapError, match=f'{name} has changed'):
        load_map_folder(folder)


def test_map_without_a_required_file_is_refused(junction: MapModel, tmp_path: Path) -> None:
    folder = _copy(junction, tmp_path)
    manifest = read_manifest(folder)
    kept = tuple(file for file in manifest.files if file.name != 'zones.geojson')
    content = manifest.model_dump() | {'files': kept}
    write_manifest(folder, type(manifest).model_validate(content))
    with pytest.raises(MapError, match=r'expected zones\.geojson'):
        load_map_folder(folder)


def test_network_in_another_projection_is_refused(junction: MapModel, tmp_path: Path) -> None:
    folder = _copy(junction, tmp_path)
    manifest = read_manifest(folder)
    content = manifest.model_dump() | {'projection': '+proj=utm +zone=32'}
    write_manifest(folder, type(manifest).model_validate(content))
    with pytest.raises(MapError, match='network is projected by'):
        load_map_folder(folder)


def test_landmark_that_is_not_there_names_those_that_are(junction: MapModel) -> None:
    with pytest.raises(MapError, match="no landmark 'Louvre'") as caught:
        junction.landmark('Louvre')
    assert 'South East House' in caught.value.hint


def test_manifest_describes_the_files_as_they_are(downtown: MapModel) -> None:
    for file in read_manifest(downtown.folder).files:
        assert file == describe_file(downtown.folder / file.name)
