# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places on a side of a moving target, in the frame of its course."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from math import ceil, cos, pi, radians, sin

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.spec.vocabulary import Side

FloatArray = npt.NDArray[np.float64]
Point2 = tuple[float, float]

# Angle of a side, counter-clockwise from the course of the target (degrees).
_ANGLES_DEG = {Side.AHEAD: 0.0, Side.LEFT: 90.0, Side.BEHIND: 180.0, Side.RIGHT: 270.0}
# Where the middle of a side is not free: so far from it, well inside the 45 degrees.
_ASIDE_DEG = (0.0, 15.0, -15.0, 25.0, -25.0)
# Several UAVs on one side share so much of it.
_SHARED_DEG = 60.0
# Between two headings that differ by more a way is looked at in between (cosine of 10 degrees).
_SAME_COURSE = 0.985
_STEPS_OF_A_TURN = 9
# Cosine of the 45 degrees of a side.
_SIDE_COSINE = 0.7071


def side_offsets(side: Side, away_m: float, share: tuple[int, int]) -> Iterator[Point2]:
    """Yield where to be on a side: metres ahead of the target and to its left, the middle first.

    Args:
        side: Which one.
        away_m: Distance from the target.
        share: Which one of how many UAVs this is that share the side.
    """
    own, count = share
    asides = _ASIDE_DEG if count == 1 else (_SHARED_DEG * (own / (count - 1) - 0.5),)
    for aside in asides:
        angle = radians(_ANGLES_DEG[side] + aside)
        yield away_m * cos(angle), away_m * sin(angle)


def turned_along(offset: Point2, samples: FloatArray) -> FloatArray:
    """Return the places (K, 2) of who keeps an offset (ahead, left) from samples of a way.

    Args:
        offset: In metres.
        samples: (K, 4) x, y and unit heading.
    """
    hx, hy = samples[:, 2], samples[:, 3]
    ahead, left = offset
    return np.column_stack(
        (samples[:, 0] + ahead * hx - left * hy, samples[:, 1] + ahead * hy + left * hx)
    )


def with_turns(samples: FloatArray) -> FloatArray:
    """Return samples of a way (K, 4) with the headings in between where it bends.

    Who keeps to a side goes round the target there, and not straight.
    """
    found = [samples[:1]]
    for a, b in pairwise(samples):
        cosine = float(a[2] * b[2] + a[3] * b[3])
        if cosine < _SAME_COURSE:
            start, angle = _bearing(a), _turn(a, b)
            for k in range(1, _STEPS_OF_A_TURN + 1):
                part = k / (_STEPS_OF_A_TURN + 1)
                x, y = a[:2] + part * (b[:2] - a[:2])
                heading = start + part * angle
                found.append(np.array([[x, y, cos(heading), sin(heading)]]))
        found.append(b[None, :])
    return np.concatenate(found)


def _bearing(sample: FloatArray) -> float:
    return float(np.arctan2(sample[3], sample[2]))


def _turn(a: FloatArray, b: FloatArray) -> float:
    """Return the change of heading, the shorter way round (rad)."""
    off = _bearing(b) - _bearing(a)
    return off - 2.0 * pi * ceil((off - pi) / (2.0 * pi))


def side_first(spots: Sequence[Point2], target: Point2, place: Point2) -> tuple[Point2, ...]:
    """Return spots in their order, those on the side of a place (seen from the target) first.

    Who starts there is on that side from the beginning, and does not fly over the target.
    """
    px, py = place[0] - target[0], place[1] - target[1]

    def is_elsewhere(spot: Point2) -> bool:
        x, y = spot[0] - target[0], spot[1] - target[1]
        return x * px + y * py < _SIDE_COSINE * norm2(x, y) * norm2(px, py)

    return tuple(sorted(spots, key=is_elsewhere))
