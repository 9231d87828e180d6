# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Packages and their executables, from the ament index in AMENT_PREFIX_PATH."""

from __future__ import annotations

import os
from pathlib import Path

from aurora_ros2cli.errors import CliError

_MARKERS = Path('share') / 'ament_index' / 'resource_index' / 'packages'


def prefixes() -> list[Path]:
    """Return the install prefixes, the overlay first.

    Raises:
        CliError: If no environment was sourced.
    """
    named = os.environ.get('AMENT_PREFIX_PATH', '')
    if not named:
        raise CliError("AMENT_PREFIX_PATH is not set: 'source ros_ws/setup.bash' first")
    return [Path(part) for part in named.split(os.pathsep) if part]


def package_prefixes() -> dict[str, Path]:
    """Return the prefix of every package by name; the overlay wins."""
    found: dict[str, Path] = {}
    for prefix in prefixes():
        markers = prefix / _MARKERS
        if markers.is_dir():
            for marker in markers.iterdir():
                found.setdefault(marker.name, prefix)
    return found


def package_prefix(name: str) -> Path:
    """Return the prefix of one package.

    Raises:
        CliError: If there is no such package.
    """
    for prefix in prefixes():
        if (prefix / _MARKERS / name).exists() and '/' not in name:
            return prefix
    raise CliError(f"Package '{name}' not found")


def executables(name: str) -> list[Path]:
    """Return the executables of a package, sorted by path.

    Raises:
        CliError: If there is no such package.
    """
    folder = package_prefix(name) / 'lib' / name
    if not folder.is_dir():
        return []
    return sorted(
        path
        for path in folder.rglob('*')
        if path.is_file() and os.access(path, os.X_OK) and '__pycache__' not in path.parts
    )
