# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Named arrays in one `.npz` file that has the same bytes whenever the arrays are the same."""

from __future__ import annotations

import hashlib
import io
import tokenize
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.errors import MapError
from aurora_core.files import MAP_BYTES, read_bytes

Arrays = Mapping[str, npt.NDArray[Any]]

# Of every member: the earliest that a zip archive can name.
_DATE = (1980, 1, 1, 0, 0, 0)
# What the arrays of a map have at most, unpacked.
_UNPACKED_BYTES = 256 << 20
# What zip archives and headers of arrays raise where a byte of them is another one.
_DAMAGE = (
    OSError, ValueError, EOFError, RuntimeError, OverflowError, MemoryError,
    zipfile.BadZipFile, zlib.error, tokenize.TokenError,
)  # fmt: skip


def arrays_bytes(arrays: Arrays) -> bytes:
    """Return the `.npz` file of arrays: sorted names, no time stamps, no pickles."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, 'w', zipfile.ZIP_DEFLATED, compresslevel=9) as archive:
        for name in sorted(arrays):
            member = zipfile.ZipInfo(f'{name}.npy', date_time=_DATE)
            member.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(member, _member(arrays[name]))
    return file.getvalue()


def arrays_digest(arrays: Arrays) -> str:
    """Return the sha256 (hex) over names and values, whatever packed them."""
    digest = hashlib.sha256()
    for name in sorted(arrays):
        digest.update(name.encode('utf-8') + b'\0' + _member(arrays[name]))
    return digest.hexdigest()


def read_arrays(path: Path) -> dict[str, npt.NDArray[Any]]:
    """Read a `.npz` file.

    Raises:
        MapError: It is missing, damaged, larger than that of any map, or holds other than arrays.
    """
    try:
        data = read_bytes(path, MAP_BYTES)
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if sum(member.file_size for member in archive.infolist()) > _UNPACKED_BYTES:
                raise ValueError('it has more than the arrays of a map')
            return {
                member.filename.removesuffix('.npy'): np.load(
                    io.BytesIO(archive.read(member)), allow_pickle=False
                )
                for member in archive.infolist()
            }
    except _DAMAGE as err:
        raise MapError(f'expected arrays in {path}, but: {err}') from err


def _member(array: npt.NDArray[Any]) -> bytes:
    buffer = io.BytesIO()
    np.save(buffer, np.ascontiguousarray(array), allow_pickle=False)
    return buffer.getvalue()
