# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Windows over traces longer than a piece, against loops over samples."""

from __future__ import annotations

from collections import deque

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.stl.windows import (
    Extremum,
    FloatArray,
    running_to_end,
    sliding,
    sliding_clipped,
    until,
    until_within,
)

# More than two pieces, and no multiple of one.
LONG = 40_009


def trace(n: int, seed: int = 7) -> FloatArray:
    """Small whole numbers: many equal values, as at the edges of real windows."""
    return np.random.default_rng(seed).integers(-40, 40, n).astype(float)


def least_ahead(values: FloatArray, width: int) -> FloatArray:
    """The least of values[i : i + width], by a queue of candidates (Lemire 2006)."""
    result = np.empty(len(values))
    candidates: deque[int] = deque()
    for i in range(len(values) - 1, -1, -1):
        while candidates and values[candidates[-1]] >= values[i]:
            candidates.pop()
        candidates.append(i)
        while candidates[0] >= i + width:
            candidates.popleft()
        result[i] = values[candidates[0]]
    return result


def until_by_definition(left: FloatArray, right: FloatArray, width: int, i: int) -> float:
    """The greatest over the witnesses of the lesser of right there and left before."""
    best, held = -np.inf, np.inf
    for j in range(i, min(i + width, len(left))):
        best = max(best, min(right[j], held))
        held = min(held, left[j])
    return float(best)


@pytest.mark.parametrize('width', [1, 2, 181, 4096, 4097, 16_384, 30_000, LONG, LONG + 5])
def test_long_traces_have_the_extrema_of_every_window(width: int) -> None:
    values = trace(LONG)
    least = least_ahead(values, width)
    full = max(0, LONG - width + 1)
    assert np.array_equal(sliding_clipped(values, width, Extremum.LEAST), least)
    assert np.array_equal(sliding(values, width, Extremum.LEAST), least[:full])
    assert np.array_equal(sliding_clipped(-values, width, Extremum.GREATEST), -least)
    assert np.array_equal(sliding(-values, width, Extremum.GREATEST), -least[:full])


@pytest.mark.parametrize('width', [1, 2, 181, 4096, 4097, 30_000, LONG + 5])
def test_until_on_long_traces_is_the_definition(width: int) -> None:
    # left holds for long: witnesses far away decide, beyond the seams between pieces.
    left, right = trace(LONG, 1) + 300.0, trace(LONG, 2)
    left[:: LONG // 9] = -20.0
    found = until_within(left, right, width)
    seams = [k * 16_384 + d for k in (1, 2) for d in (-1, 0, 1)]
    for i in [0, 1, *seams, LONG - width, LONG - 2, LONG - 1]:
        if 0 <= i < LONG:
            assert found[i] == until_by_definition(left, right, width, i), i


def test_until_without_end_is_the_recursion() -> None:
    left, right = trace(LONG, 3), trace(LONG, 4)
    expected = np.empty(LONG)
    value = -np.inf
    for i in range(LONG - 1, -1, -1):
        value = max(right[i], min(left[i], value))
        expected[i] = value
    assert np.array_equal(until_within(left, right, LONG), expected)


def test_until_without_end_knows_what_comes_many_pieces_later() -> None:
    # left holds to the end: the only good witness is the last sample.
    left, right = np.full(LONG, 5.0), np.full(LONG, -5.0)
    left[7] = 1.0
    right[-1] = 9.0
    expected = np.full(LONG, 5.0)
    expected[:8], expected[-1] = 1.0, 9.0
    assert np.array_equal(until(left, right, 0, None), expected)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(st.integers(0, 40), st.integers(1, 45), st.integers(0, 2**32 - 1))
def test_short_traces_have_the_extrema_of_every_window(n: int, width: int, seed: int) -> None:
    values = trace(n, seed)
    least = least_ahead(values, width)
    assert np.array_equal(sliding_clipped(values, width, Extremum.LEAST), least)
    full = sliding(-values, width, Extremum.GREATEST)
    assert np.array_equal(full, -least[: max(0, n - width + 1)])


@settings(max_examples=200, deadline=None, derandomize=True)
@given(
    st.integers(0, 20),
    st.integers(0, 22),
    st.one_of(st.none(), st.integers(0, 22)),
    st.integers(0, 2**32 - 1),
)
def test_until_over_an_interval_is_the_definition(
    n: int, near: int, more: int | None, seed: int
) -> None:
    left, right = trace(n, seed), trace(n, seed + 1)
    found = until(left, right, near, None if more is None else near + more)
    expected = []
    for i in range(n - near):
        last = n if more is None else min(n, i + near + more + 1)
        expected.append(max(min([right[j], *left[i:j]]) for j in range(i + near, last)))
    assert found.tolist() == expected


def test_inputs_stay_as_they_are() -> None:
    left, right = trace(100, 5), trace(100, 6)
    kept = left.copy(), right.copy()
    until_within(left, right, 20)
    sliding(left, 20, Extremum.LEAST)
    # Whoever writes into a result must not write into the signal, not even for windows of one.
    sliding(left, 1, Extremum.LEAST)[:] = 0.0
    until_within(left, right, 1)[:] = 0.0
    assert np.array_equal(left, kept[0])
    assert np.array_equal(right, kept[1])


def test_an_empty_trace_has_no_windows() -> None:
    nothing = np.empty(0)
    assert len(until_within(nothing, nothing, 3)) == 0
    assert len(sliding(nothing, 3, Extremum.LEAST)) == 0
    assert len(sliding_clipped(nothing, 3, Extremum.LEAST)) == 0
    assert len(running_to_end(nothing, Extremum.LEAST)) == 0
