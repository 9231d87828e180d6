# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Write records where they are looked for, and into the sources of an installed configuration."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from aurora_cli.files import write_file
from aurora_core.errors import ReportError
from aurora_core.knowledge.config_files import config_path, config_root

# A file of every configuration; where it is a link, it leads to the sources.
_LANDMARK = 'limits.json'


def write_records(files: Mapping[Path, bytes]) -> tuple[Path, ...]:
    """Write each file whole, in the order given; what is the same already is left alone.

    Args:
        files: Content by path.

    Returns:
        The files that have the content now.

    Raises:
        ReportError: No room, no permission.
    """
    return tuple(_written(path, data) for path, data in files.items())


def _written(path: Path, data: bytes) -> Path:
    source = _source_of(path)
    try:
        source.parent.mkdir(parents=True, exist_ok=True)
        same = source.is_file() and source.read_bytes() == data
        if not same:
            write_file(source, data)
        if path.resolve() != source:
            path.parent.mkdir(parents=True, exist_ok=True)
            path.unlink(missing_ok=True)
            path.symlink_to(source)
    except OSError as err:
        raise ReportError(
            f'{path} cannot be written: {err.strerror or err}',
            hint='name a configuration that you may write with AURORA_CONFIG_DIR',
        ) from err
    return source


def _source_of(path: Path) -> Path:
    """Return the file itself; where a workspace links to its sources, the one there."""
    root = config_root()
    sources = config_path(_LANDMARK).resolve().parent
    if sources == root.resolve() or root not in path.parents:
        return path.resolve()
    return sources / path.relative_to(root)
