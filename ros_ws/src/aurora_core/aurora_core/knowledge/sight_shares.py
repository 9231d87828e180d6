# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much of a map's lanes can be seen from the air, by height and distance, exactly measured."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from aurora_core.document import Document
from aurora_core.geometry.prism import Prism
from aurora_core.geometry.sight import SightModel
from aurora_core.knowledge.lane_samples import LaneSamples

FloatArray = npt.NDArray[np.float64]

HEIGHTS_M = (20.0, 40.0, 60.0, 100.0)
DISTANCES_M = (20.0, 50.0, 100.0)
TARGET_HEIGHT_M = 1.0
BEARINGS = 8
# Lanes are looked at in so many places at most: shares of more differ in the third digit.
_PLACES = 600
# Where views along streets are measured: a vehicle this far before a junction.
_EYE_M = 1.5
BEFORE_M = (10.0, 25.0)


class SightShare(Document):
    """Share of the views of lanes that are free from one height and one horizontal distance."""

    height_m: float
    distance_m: float
    free_share: float


class CornerShare(Document):
    """Share of the pairs of approaches to a junction that do not see each other.

    Attributes:
        before_m: How far before the junction both are.
        pairs: So many were looked at.
        hidden_share: Share of them with a building between them; 0 without pairs.
    """

    before_m: float
    pairs: int
    hidden_share: float


def sight_shares(samples: LaneSamples, prisms: Sequence[Prism]) -> tuple[SightShare, ...]:
    """Return the shares for every height and distance.

    Args:
        samples: Lane samples of the map.
        prisms: Its buildings.
    """
    rows = np.unique(np.linspace(0, len(samples) - 1, _PLACES).astype(int))[: len(samples)]
    sight = SightModel(prisms)
    eye = np.arange(BEARINGS) * (2.0 * np.pi / BEARINGS)
    around = np.column_stack((np.cos(eye), np.sin(eye)))
    places = np.column_stack((samples.x_m[rows], samples.y_m[rows])).astype(np.float64)
    targets = np.column_stack((places, np.full(len(places), TARGET_HEIGHT_M)))
    targets = np.repeat(targets, BEARINGS, axis=0)
    shares = []
    for height_m in HEIGHTS_M:
        for distance_m in DISTANCES_M:
            eyes = targets.copy()
            eyes[:, :2] += np.tile(distance_m * around, (len(places), 1))
            eyes[:, 2] = height_m
            free = sight.clearance_series(eyes, targets) > 0.0
            share = float(np.count_nonzero(free)) / max(1, len(free))
            shares.append(
                SightShare(height_m=height_m, distance_m=distance_m, free_share=round(share, 4))
            )
    return tuple(shares)


def corner_shares(
    samples: LaneSamples, ends_at: Sequence[str], prisms: Sequence[Prism]
) -> tuple[CornerShare, ...]:
    """Return how many pairs of approaches are hidden from each other, by their distance.

    Args:
        samples: Lane samples of the map.
        ends_at: Junction at the end of each lane of `samples.lane_ids`.
        prisms: Buildings of the map.
    """
    sight = SightModel(prisms)
    shares = []
    for before_m in BEFORE_M:
        approaches: dict[str, list[int]] = {}
        for lane_id, junction in zip(samples.lane_ids, ends_at, strict=True):
            first, end = samples.first[lane_id]
            left_m = np.abs(samples.junction_m[first:end] - before_m)
            if end > first and left_m.min() <= 5.0:
                approaches.setdefault(junction, []).append(first + int(left_m.argmin()))
        pairs = [
            (a, b)
            for _, rows in sorted(approaches.items())
            for k, a in enumerate(rows)
            for b in rows[:k]
            if _cross(samples, a, b)
        ]
        first_eye, other_eye = (_eyes(samples, [pair[side] for pair in pairs]) for side in (0, 1))
        hidden = 0
        if pairs:
            hidden = int(np.count_nonzero(sight.clearance_series(first_eye, other_eye) <= 0.0))
        shares.append(
            CornerShare(
                before_m=before_m,
                pairs=len(pairs),
                hidden_share=round(hidden / max(1, len(pairs)), 4),
            )
        )
    return tuple(shares)


def _cross(samples: LaneSamples, a: int, b: int) -> bool:
    """Tell whether two samples head across each other (between 45 and 135 degrees)."""
    x, y = samples.heading_x, samples.heading_y
    return bool(abs(x[a] * x[b] + y[a] * y[b]) < 0.7)


def _eyes(samples: LaneSamples, rows: Sequence[int]) -> FloatArray:
    height = np.full(len(rows), _EYE_M)
    index = np.array(rows, dtype=int)
    return np.column_stack((samples.x_m[index], samples.y_m[index], height)).astype(np.float64)
