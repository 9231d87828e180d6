# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which changes make a package be built again."""

from __future__ import annotations

from pathlib import Path

import pytest

from stamps import digest_package, read_stamp, write_stamp


@pytest.fixture
def python_package(tmp_path: Path) -> Path:
    folder = tmp_path / 'pack'
    for name in ('setup.py', 'package.xml', 'pack/__init__.py', 'config/a.yaml', 'test/test_a.py'):
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(name)
    return folder


@pytest.fixture
def compiled_package(tmp_path: Path) -> Path:
    folder = tmp_path / 'messages'
    for name in ('CMakeLists.txt', 'package.xml', 'msg/A.msg'):
        file = folder / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(name)
    return folder


@pytest.mark.parametrize('name', ['setup.py', 'package.xml', 'setup.cfg', 'config/b.yaml'])
def test_a_python_package_is_built_again_after(python_package: Path, name: str) -> None:
    before = digest_package(python_package)
    (python_package / name).write_text('changed')
    assert digest_package(python_package) != before


@pytest.mark.parametrize(
    'name', ['pack/__init__.py', 'pack/new.py', 'config/a.yaml', 'test/test_b.py', '.hidden/x']
)
def test_a_python_package_stays_built_after(python_package: Path, name: str) -> None:
    before = digest_package(python_package)
    file = python_package / name
    file.parent.mkdir(exist_ok=True)
    file.write_text('changed')
    assert digest_package(python_package) == before


@pytest.mark.parametrize('name', ['msg/A.msg', 'srv.srv', 'CMakeLists.txt'])
def test_a_compiled_package_is_built_again_after(compiled_package: Path, name: str) -> None:
    before = digest_package(compiled_package)
    (compiled_package / name).write_text('changed')
    assert digest_package(compiled_package) != before


def test_a_moved_package_is_built_again(python_package: Path, tmp_path: Path) -> None:
    before = digest_package(python_package)
    assert digest_package(python_package.rename(tmp_path / 'elsewhere')) != before


def test_a_stamp_comes_back_and_a_damaged_one_counts_as_none(tmp_path: Path) -> None:
    stamp = tmp_path / 'folder' / 'step.json'
    assert read_stamp(stamp) == {}

    write_stamp(stamp, {'lock': 'a'})
    assert read_stamp(stamp) == {'lock': 'a'}

    for damaged in ('{"lock":', '[1]', ''):
        stamp.write_text(damaged)
        assert read_stamp(stamp) == {}
