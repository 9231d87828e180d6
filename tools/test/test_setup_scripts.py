# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""tools/setup.sh and ros_ws/setup.bash as a user meets them."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BUILT = (ROOT / 'ros_ws' / 'install' / 'aurora_env.bash').is_file()


def _bash(script: str, cwd: Path, **environment: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        ['bash', '-c', script],
        cwd=cwd,
        env={'PATH': '/usr/bin:/bin', 'HOME': str(cwd), **environment},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )


def test_a_wrong_python_is_refused_with_what_to_install(tmp_path: Path) -> None:
    old = tmp_path / 'python-old'
    old.write_text('#!/bin/sh\nexit 1\n')
    old.chmod(0o755)

    done = _bash(f'{ROOT}/tools/setup.sh', tmp_path, PYTHON=str(old))

    assert done.returncode == 1
    assert 'no Python 3.11 or 3.12 found' in done.stderr
    assert 'apt install python3' in done.stderr


def test_sourcing_before_the_set_up_says_so_and_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / 'ros_ws').mkdir()
    shutil.copy(ROOT / 'ros_ws' / 'setup.bash', tmp_path / 'ros_ws')

    done = _bash('source ros_ws/setup.bash; echo "code $?"; echo "$PATH"', tmp_path)

    assert "call 'make setup' there first" in done.stderr
    assert done.stdout.splitlines() == ['code 1', '/usr/bin:/bin']


def test_running_instead_of_sourcing_is_refused(tmp_path: Path) -> None:
    done = _bash(f'bash {ROOT}/ros_ws/setup.bash', tmp_path)

    assert done.returncode == 1
    assert 'source this file' in done.stderr


needs_workspace = pytest.mark.skipif(not BUILT, reason='the workspace is not built')


@needs_workspace
def test_sourcing_twice_is_sourcing_once_and_leaves_no_trace(tmp_path: Path) -> None:
    setup = ROOT / 'ros_ws' / 'setup.bash'
    done = _bash(
        f'set -euo pipefail; before="$-"; source {setup}; env | sort > one; source {setup}; '
        'env | sort > two; [ "$-" = "$before" ]; compgen -v | grep -i "^_aurora" || true; '
        'compgen -A function | grep aurora || true',
        tmp_path,
    )

    assert done.returncode == 0, done.stderr
    assert done.stdout == ''
    assert (tmp_path / 'one').read_text() == (tmp_path / 'two').read_text()


@needs_workspace
def test_what_the_user_has_set_stays(tmp_path: Path) -> None:
    own = {'ROS_DOMAIN_ID': '3', 'FASTRTPS_DEFAULT_PROFILES_FILE': '/own.xml'}
    done = _bash(
        f'cd {ROOT}/ros_ws && source setup.bash && '
        'echo "$ROS_DOMAIN_ID $FASTRTPS_DEFAULT_PROFILES_FILE $ROS_AUTOMATIC_DISCOVERY_RANGE"',
        tmp_path,
        **own,
    )

    assert done.stdout == '3 /own.xml LOCALHOST\n'


@needs_workspace
def test_the_environment_finds_commands_packages_and_the_profile(tmp_path: Path) -> None:
    done = _bash(
        f'source {ROOT}/ros_ws/setup.bash && type -P ros2 python && '
        'echo "$FASTRTPS_DEFAULT_PROFILES_FILE $ROS_AUTOMATIC_DISCOVERY_RANGE"',
        tmp_path,
    )

    ros2, python, profile = done.stdout.splitlines()
    assert os.access(ros2, os.X_OK)
    assert python == f'{ROOT}/.venv/bin/python'
    file, discovery = profile.split()
    assert Path(file).is_file()
    assert discovery == 'SYSTEM_DEFAULT'


@needs_workspace
def test_a_real_ros2_is_preferred(tmp_path: Path) -> None:
    real = tmp_path / 'ros2'
    real.write_text('#!/bin/sh\n')
    real.chmod(0o755)

    done = _bash(
        f'source {ROOT}/ros_ws/setup.bash && type -P ros2',
        tmp_path,
        PATH=f'/bin:/usr/bin:{tmp_path}',
    )

    assert done.stdout == f'{real}\n'
