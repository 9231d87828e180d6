# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Versions: Python, the packages of the lock, ROS, SUMO, and what was built from which sources."""

from __future__ import annotations

import importlib.util
import json
import re
from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

from aurora_cli.doctor.machine import Finding, Machine

PYTHONS = ((3, 11), (3, 12))
_NAMED_AT_MOST = 5
_PROBE_LIMIT_S = 30.0
_PINNED = re.compile(r'^([A-Za-z0-9_.-]+)==([^\s;\\]+)', re.MULTILINE)
_VARIABLES = ('ROS_DISTRO', 'AMENT_PREFIX_PATH', 'RMW_IMPLEMENTATION')
# Module → what it stands for.
IMPORTS = {
    'rclpy': 'ROS 2 in Python',
    'aurora_msgs.msg': 'the built message package',
    'libsumo': 'SUMO',
}


def python_version(machine: Machine) -> list[Finding]:
    """Python is one that is tested."""
    if machine.python in PYTHONS:
        return []
    return [
        Finding(
            expected='Python 3.11 or 3.12',
            found=f'Python {machine.python[0]}.{machine.python[1]}',
            fix='install Python 3.12, then: PYTHON=python3.12 make setup',
        )
    ]


def environment(machine: Machine) -> list[Finding]:
    """The environment is the one of this checkout."""
    checkout = machine.checkout
    if checkout is None:
        return []
    install = checkout / 'ros_ws' / 'install'
    if not (install / 'aurora_env.bash').is_file():
        return [
            Finding(
                expected=f'a built workspace in {install}',
                found='none',
                fix=f'make -C {checkout} setup',
            )
        ]
    prefixes = machine.environment.get('AMENT_PREFIX_PATH', '').split(':')
    if str(install) in prefixes:
        return []
    return [
        Finding(
            expected=f'the environment of {checkout} (AMENT_PREFIX_PATH with {install})',
            found='that of another checkout' if any('ros_ws' in p for p in prefixes) else 'none',
            fix=machine.setup_hint,
        )
    ]


def variables(machine: Machine) -> list[Finding]:
    """The variables that ROS needs are set, and what they name exists."""
    missing = [name for name in _VARIABLES if not machine.environment.get(name)]
    prefixes = machine.environment.get('AMENT_PREFIX_PATH', '').split(':')
    gone = [prefix for prefix in prefixes if prefix and not Path(prefix).is_dir()]
    found = [f'{name} is not set' for name in missing]
    found += [f'AMENT_PREFIX_PATH names {prefix}, which does not exist' for prefix in gone]
    return [
        Finding(
            expected=f'{", ".join(_VARIABLES)} of an environment that is there',
            found=what,
            fix=machine.setup_hint,
        )
        for what in found
    ]


def packages(machine: Machine) -> list[Finding]:
    """Every installed package is the one of the lock file."""
    if machine.checkout is None or machine.python not in PYTHONS:
        return []
    system = machine.environment.get('AURORA_ROS', '') == 'system'
    tag = f'py{machine.python[0]}.{machine.python[1]}'
    lock = machine.checkout / 'requirements' / f'{"system" if system else "run"}-{tag}.txt'
    wanted = dict(_PINNED.findall(lock.read_text(encoding='utf-8')))
    found = {name: machine.installed(name) for name in wanted}
    wrong = sorted(name for name in wanted if found[name] != wanted[name])
    if not wrong:
        return []
    told = ', '.join(
        f'{name} {found[name] or "missing"} instead of {wanted[name]}'
        for name in wrong[:_NAMED_AT_MOST]
    )
    rest = len(wrong) - _NAMED_AT_MOST
    return [
        Finding(
            expected=f'the {len(wanted)} packages of requirements/{lock.name}',
            found=told + (f' and {rest} more' if rest > 0 else ''),
            # Without the environment this may be another Python altogether.
            fix=machine.setup_hint
            if environment(machine)
            else f'rm -rf {machine.checkout}/.venv && make -C {machine.checkout} setup',
        )
    ]


def imports(machine: Machine, modules: Iterable[str] = tuple(IMPORTS)) -> list[Finding]:
    """What ROS, the messages and SUMO need at run time can be loaded.

    Args:
        machine: What is looked at.
        modules: Which of `IMPORTS`.
    """
    findings = []
    for module in modules:
        done = machine.probe(f'import {module}', _PROBE_LIMIT_S)
        if done.code != 0:
            findings.append(
                Finding(
                    expected=f'{IMPORTS[module]} can be imported (import {module})',
                    found=done.last_words,
                    fix=f'make setup, then: {machine.setup_hint}',
                )
            )
    return findings


def build(machine: Machine) -> list[Finding]:
    """What is installed in the workspace was built from the present sources."""
    checkout = machine.checkout
    if checkout is None:
        return []
    stamp = checkout / 'ros_ws' / 'install' / 'workspace.json'
    tool = checkout / 'tools' / 'aurora_setup' / 'stamps.py'
    if not stamp.is_file() or not tool.is_file():
        return []  # `environment` tells that nothing is built
    built = json.loads(stamp.read_text(encoding='utf-8'))
    stamps = _load(tool)
    stale = []
    for name, folder in _package_folders(checkout).items():
        # The stamp of the messages goes on with the digest of what they were generated by.
        digest = stamps.digest_package(folder)
        if not str(built.get(name, '')).startswith(digest):
            stale.append(name)
    if not stale:
        return []
    return [
        Finding(
            expected='a workspace that was built from the present sources',
            found=f'changed since: {", ".join(stale)}',
            fix=f'make -C {checkout} setup',
        )
    ]


def _package_folders(checkout: Path) -> dict[str, Path]:
    """Folder of each package that is built, by name."""
    found = {}
    for entry in sorted((checkout / 'ros_ws' / 'src').iterdir()):
        for manifest in (entry / 'package.xml', *sorted(entry.glob('*/package.xml'))):
            name = re.search(r'<name>\s*([^<\s]+)', _text(manifest))
            if name is not None:
                found[name[1]] = manifest.parent.resolve()
                if manifest.parent == entry:
                    break
    return found


def _text(path: Path) -> str:
    return path.read_text(encoding='utf-8') if path.is_file() else ''


def _load(path: Path) -> ModuleType:
    """Import a file of the set-up: only it knows what a digest covers."""
    spec = importlib.util.spec_from_file_location('aurora_setup_stamps', path)
    if spec is None or spec.loader is None:
        raise ImportError(f'{path} cannot be imported')
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
