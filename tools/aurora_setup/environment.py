# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Makes the virtual environment from the locks."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import venv
from collections.abc import Mapping
from pathlib import Path

from cmake_paths import rewrite_builder_paths
from console import SetupError, last_lines, run_logged, say
from layout import SYSTEM, WHEELS, Layout
from stamps import digest_files, read_stamp, write_stamp

RUN_STAMP = 'run.json'
DEV_STAMP = 'dev.json'
# Source packages in the lock build with these, so they are installed before the rest.
BUILD_TOOLS = frozenset({'setuptools', 'wheel'})


def run_key(layout: Layout) -> dict[str, str]:
    """Return what the virtual environment depends on: lock, interpreter, place, kind of ROS."""
    if not layout.run_lock.is_file():
        raise SetupError(f'{layout.run_lock} is missing; `make lock` makes it')
    return {
        'lock': digest_files([layout.run_lock]),
        'python': f'{os.path.realpath(sys.executable)} {sys.version.split()[0]}',
        'place': str(layout.venv),
        'ros': layout.ros,
    }


def is_current(layout: Layout) -> bool:
    """Whether the virtual environment is whole and made from the present lock."""
    return read_stamp(layout.stamps / RUN_STAMP) == run_key(layout)


def ensure_run(layout: Layout) -> None:
    """Make the virtual environment anew unless it is current.

    Raises:
        SetupError: If it cannot be made or pip fails.
    """
    if is_current(layout):
        return
    if layout.venv.exists():
        say('the virtual environment is unfinished or outdated: making it again')
        shutil.rmtree(layout.venv)
    say(f'making .venv with Python {sys.version.split()[0]} ({sys.executable})')
    try:
        venv.create(
            layout.venv, with_pip=True, symlinks=True, system_site_packages=layout.ros == SYSTEM
        )
    except (subprocess.CalledProcessError, OSError) as err:
        raise SetupError(f'cannot make the virtual environment {layout.venv}: {err}') from err
    say(f'installing {layout.run_lock.name} (about 1.5 GB; a minute or two)')
    tools = layout.logs / 'build-tools.txt'
    tools.parent.mkdir(parents=True, exist_ok=True)
    tools.write_text(excerpt(layout.run_lock.read_text(), BUILD_TOOLS))
    if tools.stat().st_size:
        _pip_install(layout, tools)
    _pip_install(layout, layout.run_lock)
    if layout.ros == WHEELS:
        count = rewrite_builder_paths(layout.venv, layout.site_packages)
        say(f'adapted {count} CMake files of the wheels to this interpreter')
    write_stamp(layout.stamps / RUN_STAMP, run_key(layout))


def ensure_dev(layout: Layout) -> None:
    """Add what tests and linters need, unless the lock is installed already."""
    if not layout.dev_lock.is_file():
        raise SetupError(f'{layout.dev_lock} is missing; `make lock` makes it')
    key = {'lock': digest_files([layout.dev_lock])}
    if read_stamp(layout.stamps / DEV_STAMP) == key:
        return
    say(f'installing {layout.dev_lock.name}')
    _pip_install(layout, layout.dev_lock)
    write_stamp(layout.stamps / DEV_STAMP, key)


def excerpt(lock: str, names: frozenset[str]) -> str:
    """Return the entries of a lock for some packages, with their hashes.

    Args:
        lock: Text of the lock: an entry begins in the first column, its hashes are indented.
        names: Normalised names; those that the lock lacks are left out.
    """
    kept: list[str] = []
    keeping = False
    for line in lock.splitlines(keepends=True):
        if not line[:1].isspace():
            keeping = line.partition('==')[0] in names
        if keeping:
            kept.append(line)
    return ''.join(kept)


def _pip_install(layout: Layout, lock: Path) -> None:
    log = layout.logs / f'pip-{lock.stem}.log'
    # The lock is complete, so nothing is resolved (--no-deps), and source packages build with
    # the locked setuptools instead of one fetched without a hash (--no-build-isolation).
    command = [
        str(layout.venv_python), '-m', 'pip', '--disable-pip-version-check', '--no-input',
        'install', '--no-deps', '--require-hashes', '--no-build-isolation', '--no-compile',
        '--progress-bar=off', '-r', str(lock),
    ]  # fmt: skip
    code = run_logged(
        command, log, label=f'installing {lock.name}', environment=_pip_environment()
    )
    if code != 0:
        raise SetupError(
            f'pip could not install {lock.name}; is the network up? Last lines of {log}:\n'
            f'{last_lines(log)}'
        )


def _pip_environment() -> Mapping[str, str]:
    environment = dict(os.environ)
    # A user's `pip config set install.user true` or the like must not redirect the install.
    environment['PIP_USER'] = '0'
    environment['PIP_REQUIRE_VIRTUALENV'] = '0'
    environment.pop('PIP_TARGET', None)
    environment.pop('PIP_PREFIX', None)
    return environment
