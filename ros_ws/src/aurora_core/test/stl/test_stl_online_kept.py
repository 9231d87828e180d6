# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The queue of samples against a list."""

from __future__ import annotations

import tracemalloc

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.stl.online_streams import Kept


@settings(max_examples=100, deadline=None, derandomize=True)
@given(st.integers(0, 5), st.lists(st.tuples(st.integers(0, 200), st.integers(0, 300))))
def test_what_came_last_goes_last(first: int, changes: list[tuple[int, int]]) -> None:
    expected = [-1.0] * first
    kept = Kept(np.array(expected))
    for number, (more, fewer) in enumerate(changes):
        fresh = number + np.arange(more) / 1024.0
        kept.append(fresh)
        fresh[:] = np.nan  # whoever pushed may reuse the array
        expected += [number + k / 1024.0 for k in range(more)]
        fewer = min(fewer, len(expected))
        kept.drop(fewer)
        del expected[:fewer]
        assert kept.values.tolist() == expected
        assert len(kept) == len(expected)


def test_a_long_push_leaves_no_room_behind() -> None:
    tracemalloc.start()
    kept = Kept(np.zeros(0))
    before = tracemalloc.get_traced_memory()[0]
    kept.append(np.zeros(100_000))
    kept.drop(99_990)
    assert tracemalloc.get_traced_memory()[0] < before + 10_000
    tracemalloc.stop()
    assert len(kept) == 10
