# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Many prisms in flat arrays: footprints, heights and edges per (row, prism) pair."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from aurora_core.geometry.arrays import FloatArray, frozen
from aurora_core.geometry.footprints import FootprintTable
from aurora_core.geometry.prism import Prism

# Base of a prism without an underside: far below everything, finite so that no inf - inf occurs.
NO_UNDERSIDE_M = -1e6


class PrismTable:
    """Prisms with their heights in arrays.

    Attributes:
        prisms: As given.
        footprints: Index and edges of the footprints.
        base: (N,) metres above ground, NO_UNDERSIDE_M for one that stands on it.
        top: (N,) metres above ground.
    """

    def __init__(self, prisms: Iterable[Prism]) -> None:
        self.prisms = tuple(prisms)
        self.footprints = FootprintTable([prism.rings for prism in self.prisms])
        base = np.array([prism.base_m for prism in self.prisms], dtype=np.float64)
        self.base: FloatArray = frozen(np.where(base <= 0.0, NO_UNDERSIDE_M, base))
        self.top: FloatArray = frozen(np.array([p.top_m for p in self.prisms], dtype=np.float64))

    def __len__(self) -> int:
        """Return the number of prisms."""
        return len(self.prisms)
