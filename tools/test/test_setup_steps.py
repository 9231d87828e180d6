# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The parts of the set-up: machine checks, lock excerpts, CMake paths, logs."""

from __future__ import annotations

import sys
import sysconfig
from pathlib import Path

import pytest

import checks
from cmake_paths import rewrite_builder_paths
from console import SetupError, last_lines, run_logged
from environment import excerpt
from layout import Layout

LOCK = """# a comment
numpy==2.4.6 \\
    --hash=sha256:aa
setuptools==79.0.1 \\
    --hash=sha256:bb \\
    --hash=sha256:cc
setuptools-scm==1.0 \\
    --hash=sha256:dd
"""


def _layout(root: Path, ros: str = 'wheels', tag: str = '3.11') -> Layout:
    return Layout(root=root, ros=ros, python_tag=tag)


def test_an_excerpt_has_the_entry_with_its_hashes_and_no_other() -> None:
    assert excerpt(LOCK, frozenset({'setuptools', 'wheel'})) == (
        'setuptools==79.0.1 \\\n    --hash=sha256:bb \\\n    --hash=sha256:cc\n'
    )


def test_builder_paths_become_this_machines(tmp_path: Path) -> None:
    site = tmp_path / 'lib' / 'site-packages'
    numpy_include = site / 'numpy' / '_core' / 'include'
    numpy_include.mkdir(parents=True)
    exported = tmp_path / 'share' / 'std_msgs' / 'cmake' / 'export.cmake'
    exported.parent.mkdir(parents=True)
    exported.write_text(
        'INCLUDE "/opt/python/cp311-cp311/include/python3.11;'
        '/opt/python/cp311-cp311/lib/python3.11/site-packages/numpy/_core/include"'
    )

    assert rewrite_builder_paths(tmp_path, site) == 1

    python_include = sysconfig.get_paths()['include']
    assert exported.read_text() == f'INCLUDE "{python_include};{numpy_include}"'
    assert rewrite_builder_paths(tmp_path, site) == 0


def test_a_numpy_without_headers_is_reported(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match='numpy has no headers'):
        rewrite_builder_paths(tmp_path, tmp_path)


def test_a_full_disk_is_reported_with_both_figures(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match=r'GB free on the disk .* 1000000 GB needed'):
        checks.check_disk(tmp_path, needed_bytes=10**15)
    checks.check_disk(tmp_path, needed_bytes=1)


def test_a_missing_compiler_is_reported_with_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv('PATH', str(tmp_path))
    monkeypatch.delenv('CXX', raising=False)
    with pytest.raises(SetupError, match=r'no g\+\+ .* and no make .*apt install g\+\+ make'):
        checks.check_compiler()


def test_libraries_of_sumo_are_missed_before_anything_is_installed(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    checks.check_libraries()
    monkeypatch.setitem(checks.LIBRARIES, 'libnowhere.so.1', 'libnowhere1')
    with pytest.raises(SetupError, match=r'libnowhere\.so\.1, which .*apt install libnowhere1\)'):
        checks.check_libraries()


@pytest.mark.parametrize(
    ('ros', 'tag', 'message'),
    [
        ('both', '3.11', 'AURORA_ROS=both is neither'),
        ('system', '3.12', 'has no ROS 2 Jazzy'),
    ],
)
def test_a_wrong_choice_of_ros_is_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ros: str, tag: str, message: str
) -> None:
    monkeypatch.setattr(checks, 'SYSTEM_PREFIX', tmp_path / 'nowhere')
    with pytest.raises(SetupError, match=message):
        checks.check_ros_choice(_layout(tmp_path, ros, tag))


def test_the_system_install_needs_its_own_python(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / 'setup.bash').touch()
    monkeypatch.setattr(checks, 'SYSTEM_PREFIX', tmp_path)
    with pytest.raises(SetupError, match=r'needs the Python 3\.12'):
        checks.check_ros_choice(_layout(tmp_path, 'system', '3.11'))
    checks.check_ros_choice(_layout(tmp_path, 'system', '3.12'))


def test_missing_python_headers_are_reported(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sysconfig, 'get_paths', lambda: {'include': str(tmp_path)})
    with pytest.raises(SetupError, match=r'apt install python3\.11-dev'):
        checks.check_python_parts(_layout(tmp_path))


def test_packages_are_found_through_links_once_each(tmp_path: Path) -> None:
    source = tmp_path / 'ros_ws' / 'src'
    source.mkdir(parents=True)
    for folder in ('bridges/one', 'solo', 'ros_ws/src/inner'):
        manifest = tmp_path / folder / 'package.xml'
        manifest.parent.mkdir(parents=True)
        manifest.write_text(f'<package><name>{manifest.parent.name}</name></package>')
    (source / 'bridges').symlink_to('../../bridges')
    (source / 'solo').symlink_to('../../solo')
    (source / 'later').symlink_to('../../later')

    assert _layout(tmp_path).packages() == {
        'inner': source / 'inner',
        'one': tmp_path / 'bridges' / 'one',
        'solo': tmp_path / 'solo',
    }


@pytest.mark.parametrize(
    ('text', 'message'), [('<package>', 'is not XML'), ('<package/>', 'names no package')]
)
def test_a_bad_manifest_is_reported(tmp_path: Path, text: str, message: str) -> None:
    manifest = tmp_path / 'ros_ws' / 'src' / 'bad' / 'package.xml'
    manifest.parent.mkdir(parents=True)
    manifest.write_text(text)
    with pytest.raises(SetupError, match=message):
        _layout(tmp_path).packages()


def test_a_command_leaves_its_output_in_the_log(tmp_path: Path) -> None:
    log = tmp_path / 'logs' / 'a.log'
    code = run_logged(
        [sys.executable, '-c', 'print("one\\n\\ntwo"); raise SystemExit(3)'], log, label='a'
    )

    assert code == 3
    assert last_lines(log, 1) == '    two'
    assert last_lines(log) == '    one\n    two'


def test_a_command_that_does_not_exist_is_reported(tmp_path: Path) -> None:
    with pytest.raises(SetupError, match='no-such-tool is missing'):
        run_logged(['no-such-tool'], tmp_path / 'a.log', label='a')


def test_a_copy_is_built_only_where_ros_lacks_the_package(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ('tf2_msgs', 'own'):
        manifest = tmp_path / 'ros_ws' / 'src' / name / 'package.xml'
        manifest.parent.mkdir(parents=True)
        manifest.write_text(f'<package><name>{name}</name></package>')
    layout = _layout(tmp_path)
    assert set(layout.packages()) == {'tf2_msgs', 'own'}
    (layout.site_packages / 'tf2_msgs').mkdir(parents=True)
    assert set(layout.packages()) == {'own'}
    # Of a full install another place counts.
    monkeypatch.setattr('layout.SYSTEM_PREFIX', tmp_path / 'jazzy')
    assert set(_layout(tmp_path, 'system', '3.12').packages()) == {'tf2_msgs', 'own'}
    (tmp_path / 'jazzy' / 'share' / 'tf2_msgs').mkdir(parents=True)
    assert set(_layout(tmp_path, 'system', '3.12').packages()) == {'own'}
