# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Builds the colcon workspace: what changed, nothing else."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from pathlib import Path

from console import SetupError, last_lines, run_logged, say
from environment import run_key
from layout import SYSTEM, SYSTEM_PREFIX, Layout
from stamps import digest_files, digest_package, read_stamp, write_stamp

WORKSPACE_STAMP = 'workspace.json'
INTERFACES = ('aurora_msgs', 'tf2_msgs')
_BASE = '/base'


def ensure_workspace(layout: Layout) -> None:
    """Build every package whose sources differ from its stamp.

    Raises:
        SetupError: If colcon fails.
    """
    packages = layout.packages()
    wanted = {name: digest_package(folder) for name, folder in packages.items()}
    wanted[_BASE] = digest_files([layout.run_lock, layout.workspace / 'colcon_defaults.yaml'])
    wanted[_BASE] += ' ' + ' '.join(run_key(layout).values())
    for name in INTERFACES:
        if name in wanted:
            wanted[name] += digest_files([_hook(layout)])
    stamp = layout.install / WORKSPACE_STAMP
    built = read_stamp(stamp)
    if built == wanted:
        return
    if built.get(_BASE) != wanted[_BASE] or not set(built) <= set(wanted):
        # Another environment or place, or a package was taken away: nothing old may stay.
        for folder in (layout.install, layout.workspace / 'build'):
            shutil.rmtree(folder, ignore_errors=True)
        built = {}
    changed = [name for name in packages if built.get(name) != wanted[name]]
    # An interrupted build leaves no stamp for what it was about to change.
    write_stamp(
        stamp, {k: v for k, v in built.items() if k not in changed} | {_BASE: wanted[_BASE]}
    )
    if changed:
        say(f'building {", ".join(changed)}')
        _build(layout, changed)
    _write_environment(layout, packages)
    write_stamp(stamp, wanted)


def _write_environment(layout: Layout, packages: dict[str, Path]) -> None:
    """Tell setup.bash what was built, so that it need not search at every start of a shell."""
    paths = [
        f'build/{name}' for name, folder in packages.items() if (folder / 'setup.py').is_file()
    ]
    paths.append(f'install/lib/python{layout.python_tag}/site-packages')
    lines = [
        f'AURORA_BUILT_FOR={shlex.quote(str(layout.workspace))}',
        f'AURORA_BUILT_ROS={layout.ros}',
        f'AURORA_BUILT_PYTHON={layout.python_tag}',
        f'AURORA_BUILT_PATHS=({" ".join(map(shlex.quote, paths))})',
    ]
    (layout.install / 'aurora_env.bash').write_text('\n'.join(lines) + '\n')


def _build(layout: Layout, names: list[str]) -> None:
    interfaces = [name for name in names if name in INTERFACES]
    rest = [name for name in names if name not in INTERFACES]
    # Else a message that was renamed would stay importable.
    packages = f'lib/python{layout.python_tag}/site-packages'
    for name in interfaces:
        for place in ('share', 'include', packages):
            shutil.rmtree(layout.install / place / name, ignore_errors=True)
    if interfaces and not _build_interfaces_quickly(layout, interfaces):
        rest = names
    if rest and _colcon(layout, rest) != 0:
        log = _log(layout)
        raise SetupError(
            f'colcon could not build the workspace; whole log: {log}, by package: '
            f'{layout.workspace / "log" / "latest_build"}. Last lines:\n{last_lines(log, 12)}'
        )


def _build_interfaces_quickly(layout: Layout, names: list[str]) -> bool:
    """Build interfaces the short way, which depends on how the wheels' generators work."""
    if layout.ros == SYSTEM:
        return False
    hooks = [f'-DCMAKE_PROJECT_{name}_INCLUDE={_hook(layout)}' for name in names]
    if _colcon(layout, names, *hooks) == 0:
        return True
    say(f'building {", ".join(names)} the short way failed: trying the plain one')
    for name in names:
        shutil.rmtree(layout.workspace / 'build' / name, ignore_errors=True)
    return False


def _hook(layout: Layout) -> Path:
    return layout.root / 'tools' / 'cmake' / 'interfaces.cmake'


def _log(layout: Layout) -> Path:
    return layout.logs / 'colcon.log'


def _colcon(layout: Layout, names: list[str], *more_cmake: str) -> int:
    cmake = [f'-DPython3_EXECUTABLE={layout.venv_python}', '-DBUILD_TESTING=OFF', *more_cmake]
    workspace = layout.workspace
    command = [
        str(layout.venv_python), '-m', 'colcon', '--log-base', str(workspace / 'log'), 'build',
        '--base-paths', str(workspace / 'src'), '--build-base', str(workspace / 'build'),
        '--install-base', str(layout.install), '--merge-install', '--symlink-install',
        '--event-handlers', 'console_direct+', '--parallel-workers', str(os.cpu_count() or 1),
        '--packages-select', *names, '--cmake-args', *cmake,
    ]  # fmt: skip
    label = 'building ' + (names[0] if len(names) == 1 else f'{len(names)} packages')
    return run_logged(command, _log(layout), label=label, environment=build_environment(layout))


def build_environment(layout: Layout) -> dict[str, str]:
    """Return a small clean environment for colcon, whatever the caller has sourced."""
    kept = ('HOME', 'LANG', 'LC_ALL', 'TERM', 'TMPDIR', 'USER', 'CC', 'CXX', 'CFLAGS', 'CXXFLAGS')
    environment = {name: os.environ[name] for name in kept if name in os.environ}
    environment['PATH'] = os.pathsep.join(
        [str(layout.venv / 'bin'), os.environ.get('PATH', os.defpath)]
    )
    # colcon's own -l limit starves a build on a busy machine.
    environment['MAKEFLAGS'] = f'-j{os.cpu_count() or 1}'
    environment['_ROS_WHEELS_BOOTSTRAP_COMPLETE'] = '1'
    environment['COLCON_DEFAULTS_FILE'] = str(layout.workspace / 'colcon_defaults.yaml')
    # Messages of setuptools about its own future are not the user's business.
    environment['PYTHONWARNINGS'] = 'ignore'
    if layout.ros == SYSTEM:
        return environment | _system_environment(environment)
    libraries = [layout.venv / 'lib', *sorted(layout.site_packages.glob('ros_*.libs'))]
    environment['AMENT_PREFIX_PATH'] = str(layout.venv)
    environment['CMAKE_PREFIX_PATH'] = str(layout.venv)
    environment['LD_LIBRARY_PATH'] = os.pathsep.join(map(str, libraries))
    return environment


def _system_environment(clean: dict[str, str]) -> dict[str, str]:
    """Return what sourcing the ROS 2 install adds, the virtual environment's bin staying first."""
    done = subprocess.run(
        ['bash', '-c', f'source {SYSTEM_PREFIX}/setup.bash >&2 && env -0'],
        env=clean,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        check=False,
    )
    if done.returncode != 0:
        raise SetupError(f'{SYSTEM_PREFIX}/setup.bash failed: {done.stderr.decode()[-300:]!r}')
    pairs = (item.partition('=') for item in done.stdout.decode().split('\0') if item)
    sourced = {name: value for name, _, value in pairs if name not in ('_', 'SHLVL', 'PWD')}
    own = clean['PATH'].split(os.pathsep)[0]
    sourced['PATH'] = os.pathsep.join(
        [own, *(part for part in sourced['PATH'].split(os.pathsep) if part != own)]
    )
    return sourced
