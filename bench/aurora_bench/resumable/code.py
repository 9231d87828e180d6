# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which code and configuration a campaign measures."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from aurora_core.knowledge.config_files import config_path

# All that a run in the local engine and its judgement can depend on.
_PACKAGES = (
    'aurora_core', 'aurora_cli', 'aurora_llm', 'aurora_sumo_bridge', 'aurora_uav_bridge',
    'aurora_uav_sim', 'aurora_bench',
)  # fmt: skip


def code_digest() -> str:
    """Return a sha256 (hex) over the packages' sources and the configuration folder.

    A campaign that goes on after an edit would mix two products; the version number alone does
    not tell them apart.
    """
    return files_digest([*(p for name in _PACKAGES for p in _sources(name)), *_configuration()])


def files_digest(files: Sequence[tuple[str, Path]]) -> str:
    """Return a sha256 (hex) over the names and contents of files, in the order of the names."""
    digest = hashlib.sha256()
    for name, path in sorted(files):
        data = path.read_bytes()
        digest.update(f'{name}\n{len(data)}\n'.encode())
        digest.update(data)
    return digest.hexdigest()


def _sources(package: str) -> Iterator[tuple[str, Path]]:
    spec = find_spec(package)
    for folder in spec.submodule_search_locations or () if spec is not None else ():
        for path in Path(folder).rglob('*.py'):
            yield f'{package}/{path.relative_to(folder).as_posix()}', path


def _configuration() -> Iterator[tuple[str, Path]]:
    folder = config_path()
    for path in folder.rglob('*'):
        if path.is_file() and '__pycache__' not in path.parts:
            yield f'config/{path.relative_to(folder).as_posix()}', path
