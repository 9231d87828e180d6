# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Arrays in a file: the same bytes each time, nothing but arrays, damage in one clear line."""

from __future__ import annotations

import io
import struct
import zipfile
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

from aurora_core.errors import MapError
from aurora_core.knowledge.array_file import arrays_bytes, arrays_digest, read_arrays

ARRAYS = {
    'b': np.array([1.5, np.inf], dtype=np.float32),
    'a': np.array(['x', 'ü'], dtype=np.str_),
    'c': np.zeros((0, 3), dtype=np.uint8),
}


def test_what_is_read_is_what_was_written(tmp_path: Path) -> None:
    file = tmp_path / 'a.npz'
    file.write_bytes(arrays_bytes(ARRAYS))
    found = read_arrays(file)
    assert set(found) == set(ARRAYS)
    for name, array in ARRAYS.items():
        assert found[name].dtype == array.dtype
        assert found[name].tolist() == array.tolist()
    assert arrays_digest(found) == arrays_digest(ARRAYS)


def test_the_order_of_names_changes_nothing() -> None:
    turned = dict(reversed(ARRAYS.items()))
    assert arrays_bytes(turned) == arrays_bytes(ARRAYS)
    assert arrays_digest(turned) == arrays_digest(ARRAYS)


def test_a_changed_value_changes_the_digest() -> None:
    changed = ARRAYS | {'b': np.array([1.5, 2.0], dtype=np.float32)}
    assert arrays_digest(changed) != arrays_digest(ARRAYS)


@pytest.mark.parametrize('data', [b'', b'PK', b'{}'])
def test_what_is_no_archive_is_refused(tmp_path: Path, data: bytes) -> None:
    file = tmp_path / 'a.npz'
    file.write_bytes(data)
    with pytest.raises(MapError, match='expected arrays in'):
        read_arrays(file)


@pytest.mark.parametrize('bit', [1, 4, 128])
def test_no_byte_of_it_can_be_another_one_and_pass(tmp_path: Path, bit: int) -> None:
    file = tmp_path / 'a.npz'
    whole = arrays_bytes(ARRAYS)
    for at in range(len(whole)):
        data = bytearray(whole)
        data[at] ^= bit
        file.write_bytes(data)
        with suppress(MapError):
            found = read_arrays(file)
            # Names and dates are not under a check sum of their own; the digest has the names.
            same = set(found) == set(ARRAYS)
            assert same is (arrays_digest(found) == arrays_digest(ARRAYS)), at


@pytest.mark.parametrize(
    'header',
    [
        "{'descr': '<f8', 'fortran_order': False, 'shape': (9999999999999,)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (99999999999999999999999,)}",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1,)}",
        "{'descr': ",
        '(' * 500,
    ],
)
def test_arrays_that_claim_what_they_have_not_are_refused(tmp_path: Path, header: str) -> None:
    text = header.encode('ascii') + b'\n'
    file = tmp_path / 'a.npz'
    with zipfile.ZipFile(file, 'w') as archive:
        archive.writestr('a.npy', b'\x93NUMPY\x01\x00' + struct.pack('<H', len(text)) + text)
    with pytest.raises(MapError, match='expected arrays in'):
        read_arrays(file)


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MapError, match='expected arrays in'):
        read_arrays(tmp_path / 'none.npz')


def test_pickles_are_refused(tmp_path: Path) -> None:
    file = tmp_path / 'a.npz'
    np.savez(file, a=np.array([object()], dtype=object))
    with pytest.raises(MapError, match='expected arrays in'):
        read_arrays(file)


def test_a_bomb_is_refused(tmp_path: Path) -> None:
    file = tmp_path / 'a.npz'
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, 'w', zipfile.ZIP_DEFLATED) as archive:
        for number in range(5):
            archive.writestr(f'{number}.npy', bytes(64 << 20))
    file.write_bytes(buffer.getvalue())
    with pytest.raises(MapError, match='more than the arrays of a map'):
        read_arrays(file)
