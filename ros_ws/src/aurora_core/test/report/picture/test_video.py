# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import io
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from PIL import Image

from aurora_core.report.picture.video import gif_bytes


def test_the_bodies_move_and_the_time_is_right(make: SimpleNamespace) -> None:
    trace = make.trace()
    film: Any = Image.open(io.BytesIO(gif_bytes(trace, make.world())))
    assert film.n_frames > 10
    frames = []
    shown_s = 0.0
    for k in range(film.n_frames):
        film.seek(k)
        shown_s += film.info['duration'] / 1000.0
        frames.append(np.asarray(film.convert('RGB')).astype(int))
    assert shown_s * 4.0 == pytest.approx(trace.ticks * trace.roster.dt_s, rel=0.05)
    moved = np.abs(frames[0] - frames[len(frames) // 2]).sum(axis=2) > 60
    # Something moves, the ground does not.
    assert 20 < moved.sum() < 0.1 * moved.size


def test_the_same_run_gives_the_same_bytes(make: SimpleNamespace) -> None:
    assert gif_bytes(make.trace(), make.world()) == gif_bytes(make.trace(), make.world())
