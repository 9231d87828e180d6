# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Stamps: what a finished step was made from. A step without a matching stamp is done again."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path

# Of a Python package only these decide what an install contains: the modules are linked.
PYTHON_SETUP_FILES = ('package.xml', 'setup.py', 'setup.cfg')
# Compiled, so every file counts.
COMPILED_SUFFIXES = ('.msg', '.srv', '.action', '.txt', '.xml', '.cmake')
# Never part of a package.
SKIPPED_FOLDERS = frozenset({'__pycache__', 'test'})


def read_stamp(path: Path) -> dict[str, str]:
    """Return the stamp, or an empty one where it is missing or damaged."""
    try:
        loaded = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return {str(k): str(v) for k, v in loaded.items()} if isinstance(loaded, dict) else {}


def write_stamp(path: Path, values: Mapping[str, str]) -> None:
    """Write a stamp whole: a crash leaves the old one or the new one."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_suffix('.tmp')
    temporary.write_text(json.dumps(dict(values), indent=1, sort_keys=True) + '\n')
    os.replace(temporary, path)


def digest_files(files: Iterable[Path]) -> str:
    """Return the sha256 over the contents of files, in the given order."""
    total = hashlib.sha256()
    for file in files:
        data = file.read_bytes()
        total.update(len(data).to_bytes(8, 'little'))
        total.update(data)
    return total.hexdigest()


def digest_package(folder: Path) -> str:
    """Return a digest that changes when a package has to be built again.

    In a Python package the modules and data files are linked into the install, so that only
    their names count (data files) or nothing at all (modules); in a compiled one all counts.
    """
    compiled = (folder / 'CMakeLists.txt').is_file()
    contents: list[Path] = []
    names: list[str] = [str(folder)]
    for where, subfolders, files in os.walk(folder):
        subfolders[:] = sorted(
            name for name in subfolders if name not in SKIPPED_FOLDERS and name[0] != '.'
        )
        for name in sorted(files):
            path = Path(where) / name
            relative = path.relative_to(folder).as_posix()
            if relative in PYTHON_SETUP_FILES or (compiled and path.suffix in COMPILED_SUFFIXES):
                contents.append(path)
            if path.suffix not in ('.py', '.pyc'):
                names.append(relative)
    listing = hashlib.sha256('\0'.join(names).encode()).hexdigest()
    return hashlib.sha256((listing + digest_files(contents)).encode()).hexdigest()
