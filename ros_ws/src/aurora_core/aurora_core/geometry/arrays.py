# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Array types of the geometry layer and the checks at its border."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from aurora_core.errors import AuroraError

FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.intp]
BoolArray = npt.NDArray[np.bool_]
FloatOrArray = float | FloatArray
FloatLike = npt.ArrayLike  # what numpy turns into a float64 array

CHUNK_ROWS = 2048  # bounds the memory of row-by-candidate work; rows never influence each other


def as_rows(name: str, value: FloatLike, columns: int) -> FloatArray:
    """Return a value as a float64 array of shape (T, columns).

    Args:
        name: Name of the argument, for the message.
        value: Array or nested sequence of shape (T, columns); a copy is made only if needed.
        columns: Wanted number of columns.

    Raises:
        AuroraError: The shape is another.
    """
    rows: FloatArray = np.asarray(value, dtype=np.float64)
    if rows.ndim != 2 or rows.shape[1] != columns:
        raise AuroraError(
            f'geometry: {name} must have shape (T, {columns}), found {rows.shape}',
            component='geometry',
        )
    return rows


def as_point(name: str, value: FloatLike, columns: int) -> FloatArray:
    """Return one point of shape (columns,) as a float64 array of shape (1, columns).

    Raises:
        AuroraError: The shape is another.
    """
    point: FloatArray = np.asarray(value, dtype=np.float64)
    if point.shape != (columns,):
        raise AuroraError(
            f'geometry: {name} must have shape ({columns},), found {point.shape}',
            component='geometry',
        )
    return point.reshape(1, columns)


def same_length(**arrays: FloatArray) -> int:
    """Return the common number of rows of the arrays.

    Raises:
        AuroraError: The arrays differ in length.
    """
    lengths = {name: len(array) for name, array in arrays.items()}
    if len(set(lengths.values())) != 1:
        raise AuroraError(
            f'geometry: series of one length expected, found {lengths}', component='geometry'
        )
    return next(iter(lengths.values()))


def finite_rows(*arrays: FloatArray) -> BoolArray:
    """Tell which rows are finite in every array (rows of absent bodies are NaN)."""
    finite: BoolArray = np.asarray(np.isfinite(np.concatenate(arrays, axis=1)).all(axis=1))
    return finite


def size_rows(
    rows: int, length_m: FloatOrArray, width_m: FloatOrArray, height_m: FloatOrArray
) -> FloatArray:
    """Return box sizes, each one number for all rows or (T,), as an array (T, 3)."""
    sizes = np.empty((rows, 3))
    for column, value in enumerate((length_m, width_m, height_m)):
        sizes[:, column] = value
    return sizes


def spread_rows(values: FloatArray, rows: BoolArray) -> FloatArray:
    """Return the values at their rows and NaN at the others."""
    out = np.full(len(rows), np.nan)
    out[rows] = values
    return out


def frozen(array: FloatArray) -> FloatArray:
    """Return the array after making it read-only."""
    array.setflags(write=False)
    return array


def row_chunks(rows: int) -> Iterator[slice]:
    """Yield slices of at most CHUNK_ROWS rows that cover range(rows)."""
    for start in range(0, rows, CHUNK_ROWS):
        yield slice(start, min(start + CHUNK_ROWS, rows))
