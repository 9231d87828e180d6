# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Files and folders that the user named."""

from __future__ import annotations

from pathlib import Path

from aurora_core.errors import ReportError


def full_path(path: Path) -> Path:
    """Return a path that holds wherever a process stands.

    Raises:
        ReportError: It starts from the current folder, and that was deleted.
    """
    try:
        return path.absolute()
    except FileNotFoundError as err:
        raise ReportError(
            f'the current folder was deleted, so nothing can be found from it: {path}',
            hint='change into a folder that exists (cd), or name a full path',
        ) from err


def write_file(path: Path, data: bytes) -> None:
    """Write a file whole: a temporary name beside it, then a rename.

    Raises:
        ReportError: No room, no permission, no folder.
    """
    temporary = path.with_name(f'.writing-{path.name}')
    try:
        try:
            temporary.write_bytes(data)
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as err:
        raise ReportError(
            f'{path} cannot be written: {err.strerror or err}',
            hint='choose a folder that exists and that you may write',
        ) from err
