# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ros2 run` and `ros2 pkg` on a small install prefix."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from aurora_ros2cli.commands import COMMANDS, Group
from aurora_ros2cli.main import main

ROOT = Path(__file__).resolve().parents[1]


def _program(path: Path, body: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f'#!/usr/bin/env bash\n{body}\n')
    path.chmod(0o755)


@pytest.fixture
def prefix(tmp_path: Path) -> Path:
    markers = tmp_path / 'share' / 'ament_index' / 'resource_index' / 'packages'
    markers.mkdir(parents=True)
    for name in ('garage', 'meadow'):
        (markers / name).touch()
    _program(tmp_path / 'lib' / 'garage' / 'drive', 'echo "$$ $*"; exit 7')
    _program(tmp_path / 'lib' / 'garage' / 'wait', 'echo up; exec sleep 60')
    _program(tmp_path / 'lib' / 'garage' / 'a' / 'twin', 'true')
    _program(tmp_path / 'lib' / 'garage' / 'b' / 'twin', 'true')
    (tmp_path / 'lib' / 'garage' / 'notes.txt').write_text('not executable')
    return tmp_path


def _environment(prefix: Path | None) -> dict[str, str]:
    environment = {
        'PATH': os.environ['PATH'],
        'PYTHONPATH': str(ROOT),
        '_ROS_WHEELS_BOOTSTRAP_COMPLETE': '1',
    }
    if prefix is not None:
        environment['AMENT_PREFIX_PATH'] = str(prefix)
    return environment


def _ros2(prefix: Path | None, *arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, str(ROOT / 'scripts' / 'ros2'), *arguments],
        env=_environment(prefix),
        capture_output=True,
        text=True,
        timeout=30,
        check=False,
    )


def test_run_passes_arguments_and_exit_code(prefix: Path) -> None:
    done = _ros2(prefix, 'run', 'garage', 'drive', 'fast', '--ros-args', '-p', 'x:=1')

    assert done.returncode == 7
    assert done.stdout.split(maxsplit=1)[1] == 'fast --ros-args -p x:=1\n'


def test_run_becomes_the_executable(prefix: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, str(ROOT / 'scripts' / 'ros2'), 'run', 'garage', 'wait'],
        env=_environment(prefix),
        stdout=subprocess.PIPE,
        text=True,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == 'up\n'

    process.send_signal(signal.SIGTERM)

    # Had a parent stayed in between, it and not the signal would give the exit code.
    assert process.wait(timeout=10) == -signal.SIGTERM
    process.stdout.close()


def test_run_with_a_prefix_command(prefix: Path) -> None:
    done = _ros2(prefix, 'run', '--prefix', 'echo before', 'garage', 'drive', 'x')

    assert done.stdout == f'before {prefix}/lib/garage/drive x\n'


@pytest.mark.parametrize(
    ('arguments', 'message'),
    [
        (('nowhere', 'drive'), "Package 'nowhere' not found"),
        (('garage', 'fly'), 'No executable found'),
        (('garage', 'notes.txt'), 'No executable found'),
        (('garage', 'twin'), 'Multiple executables found:'),
        (('../garage', 'drive'), "Package '../garage' not found"),
    ],
)
def test_run_says_what_is_missing(prefix: Path, arguments: tuple[str, str], message: str) -> None:
    done = _ros2(prefix, 'run', *arguments)

    assert done.returncode == 1
    assert done.stderr.startswith(message)


def test_without_an_environment_the_message_names_the_script() -> None:
    done = _ros2(None, 'run', 'garage', 'drive')

    assert done.returncode == 1
    assert 'source ros_ws/setup.bash' in done.stderr


def test_pkg_executables_of_one_package(prefix: Path) -> None:
    done = _ros2(prefix, 'pkg', 'executables', 'garage')

    assert done.stdout.splitlines() == [
        'garage twin',
        'garage twin',
        'garage drive',
        'garage wait',
    ]


def test_pkg_executables_and_list_of_all(prefix: Path) -> None:
    paths = _ros2(prefix, 'pkg', 'executables', '--full-path').stdout.splitlines()
    assert f'{prefix}/lib/garage/drive' in paths
    assert _ros2(prefix, 'pkg', 'list').stdout.splitlines() == ['garage', 'meadow']
    assert _ros2(prefix, 'pkg', 'executables', 'moor').stderr == "Package 'moor' not found\n"


def test_pkg_prefix(prefix: Path) -> None:
    assert _ros2(prefix, 'pkg', 'prefix', 'garage').stdout == f'{prefix}\n'
    shared = _ros2(prefix, 'pkg', 'prefix', '--share', 'garage').stdout
    assert shared == f'{prefix}/share/garage\n'
    assert _ros2(prefix, 'pkg', 'prefix', 'moor').stderr == "Package 'moor' not found\n"


def test_the_overlay_hides_the_underlay(prefix: Path, tmp_path: Path) -> None:
    overlay = tmp_path / 'overlay'
    marker = overlay / 'share' / 'ament_index' / 'resource_index' / 'packages' / 'garage'
    marker.parent.mkdir(parents=True)
    marker.touch()
    _program(overlay / 'lib' / 'garage' / 'drive', 'echo overlay')

    done = _ros2(Path(f'{overlay}:{prefix}'), 'run', 'garage', 'drive')

    assert done.stdout == 'overlay\n'


@pytest.mark.parametrize('arguments', [('fly',), ('pkg', 'fly'), ('run',), ('interface', 'show')])
def test_usage_errors_exit_with_2(prefix: Path, arguments: tuple[str, ...]) -> None:
    done = _ros2(prefix, *arguments)

    assert done.returncode == 2
    assert done.stderr.startswith('usage: ros2')


@pytest.mark.parametrize('arguments', [(), ('pkg',)])
def test_no_verb_prints_help(prefix: Path, arguments: tuple[str, ...]) -> None:
    done = _ros2(prefix, *arguments)

    assert done.returncode == 0
    assert done.stdout.startswith('usage: ros2')


def test_run_does_not_import_rclpy(prefix: Path) -> None:
    _program(prefix / 'lib' / 'garage' / 'noop', 'true')
    traced = subprocess.run(
        [
            sys.executable, '-X', 'importtime', str(ROOT / 'scripts' / 'ros2'),
            'run', 'garage', 'noop',
        ],
        env=_environment(prefix), capture_output=True, text=True, timeout=30, check=True,
    )  # fmt: skip

    assert 'aurora_ros2cli.packages' in traced.stderr
    assert 'rclpy' not in traced.stderr
    assert 'yaml' not in traced.stderr


def test_help_names_every_command_and_verb(prefix: Path) -> None:
    top = _ros2(prefix, '--help').stdout
    for name, entry in COMMANDS.items():
        assert f'\n  {name} ' in top
        if isinstance(entry, Group):
            shown = _ros2(prefix, name, '-h').stdout
            assert all(f'\n  {verb} ' in shown for verb in entry.verbs)


def test_every_verb_has_a_module_with_help(capsys: pytest.CaptureFixture[str]) -> None:
    pytest.importorskip('rclpy')
    for name, entry in COMMANDS.items():
        for verb in entry.verbs if isinstance(entry, Group) else ('',):
            with pytest.raises(SystemExit) as stop:
                main([name, *([verb] if verb else []), '--help'])
            assert stop.value.code == 0
            assert capsys.readouterr().out.startswith(f'usage: ros2 {name} {verb}'.rstrip())
