# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The border refuses arrays of a wrong shape."""

from __future__ import annotations

import numpy as np
import pytest

from aurora_core.errors import AuroraError
from aurora_core.geometry import arrays


def test_series_of_a_wrong_width_is_refused() -> None:
    with pytest.raises(AuroraError, match=r'points must have shape \(T, 3\), found \(4, 2\)'):
        arrays.as_rows('points', np.zeros((4, 2)), 3)


def test_point_of_a_wrong_width_is_refused() -> None:
    with pytest.raises(AuroraError, match=r'p must have shape \(3,\), found \(2,\)'):
        arrays.as_point('p', [1.0, 2.0], 3)


def test_series_of_different_lengths_are_refused() -> None:
    with pytest.raises(AuroraError, match='one length'):
        arrays.same_length(a=np.zeros((3, 2)), b=np.zeros((4, 2)))


def test_chunks_cover_every_row_once() -> None:
    rows = 2 * arrays.CHUNK_ROWS + 5
    covered = [k for part in arrays.row_chunks(rows) for k in range(part.start, part.stop)]
    assert covered == list(range(rows))
