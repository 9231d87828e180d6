# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Persons who walk up to where they are to stand: who is there, and who stands in the way."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.trace.layout import GroundColumn

FloatArray = npt.NDArray[np.float64]

# Who walks up to where he is to stand is there until he is so much beyond it (m), and no farther
# beside it: two walk abreast.
_BEYOND_M = 0.4
_ABREAST_M = 1.5
# And stands so far behind somebody who stands there already (m).
_BEHIND_M = 1.5


def is_there(state: FloatArray, x_m: float, y_m: float) -> bool:
    """Tell whether a person (GROUND_WIDTH,) has walked up to abreast of a point."""
    x, y, hx, hy = state[: GroundColumn.HEADING_Y + 1].tolist()
    to_go_m = (x_m - x) * hx + (y_m - y) * hy
    return -_BEYOND_M <= to_go_m <= 0.0 and norm2(x_m - x, y_m - y) <= _ABREAST_M


def is_behind(state: FloatArray, others: Iterable[FloatArray], stop_mps: float) -> bool:
    """Tell whether somebody stands in the way of a person.

    Args:
        state: Of the person (GROUND_WIDTH,).
        others: The same of whoever may stand there already.
        stop_mps: Who is slower than this stands.
    """
    x, y, hx, hy = state[: GroundColumn.HEADING_Y + 1].tolist()
    for other in others:
        to_x, to_y = float(other[GroundColumn.X]) - x, float(other[GroundColumn.Y]) - y
        near = norm2(to_x, to_y) <= _BEHIND_M and to_x * hx + to_y * hy > 0.5 * _BEHIND_M
        if near and other[GroundColumn.SPEED] < stop_mps:
            return True
    return False
