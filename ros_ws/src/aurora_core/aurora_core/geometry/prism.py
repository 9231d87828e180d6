# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""An upright prism: the solid that stands for a building, a structure or a no-fly zone."""

from __future__ import annotations

import math
from dataclasses import dataclass

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.polygon import require_simple, ring_of


@dataclass(frozen=True, slots=True, eq=False)
class Prism:
    """A polygon with holes between two heights, ENU map frame.

    A prism whose base is at or below the ground (`base_m` <= 0) has no underside: nothing flies
    or looks below it, and depths inside it are measured to walls and roof only.

    Attributes:
        prism_id: Name in the map.
        ring_xy: (K, 2) outer ring, metres, either orientation, not closed, read-only.
        holes_xy: Courtyards of the same kind.
        base_m: Height of the underside above ground, metres.
        top_m: Height of the roof above ground, metres.
    """

    prism_id: str
    ring_xy: FloatArray
    holes_xy: tuple[FloatArray, ...]
    base_m: float
    top_m: float

    def __post_init__(self) -> None:
        """Copy, check and freeze the rings.

        Raises:
            MapError: The rings are not those of one polygon, or the heights are not finite and
                in order.
        """
        name = f'prism {self.prism_id!r}'
        object.__setattr__(self, 'ring_xy', ring_of(name, self.ring_xy))
        holes = tuple(ring_of(f'hole {k} of {name}', hole) for k, hole in enumerate(self.holes_xy))
        object.__setattr__(self, 'holes_xy', holes)
        require_simple(name, self.ring_xy, holes)
        object.__setattr__(self, 'base_m', float(self.base_m))
        object.__setattr__(self, 'top_m', float(self.top_m))
        if not (math.isfinite(self.base_m) and math.isfinite(self.top_m)):
            raise MapError(f'{name}: finite heights expected, found {self.base_m}, {self.top_m}')
        if self.top_m <= self.base_m or self.top_m <= 0.0:
            raise MapError(
                f'{name}: a top above the base and the ground expected, '
                f'found base {self.base_m} m and top {self.top_m} m'
            )

    @property
    def rings(self) -> tuple[FloatArray, ...]:
        """Outer ring first, then the holes."""
        return (self.ring_xy, *self.holes_xy)
