# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Random networks, one per seed and number.

Sizes from 1 to 200 points, small ones as often as great ones. Three kinds take turns: met by times
that were drawn first (consistent for certain), the same with one bound too tight by a little, and
bounds that were drawn freely. Bounds repeat, meet exactly, are zero, or are missing altogether.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from aurora_core.temporal.stn import Edge, Stn

MAX_POINTS = 200
# Times that are drawn lie inside this, in microseconds: half an hour.
_SPAN_US = 1_800_000_000
_FREE_US = 60_000_000


class Kind(StrEnum):
    """How the bounds of a network were drawn."""

    MET = 'met'
    TIGHTENED = 'tightened'
    FREE = 'free'


@dataclass(frozen=True, kw_only=True)
class Network:
    """A network; the reason of an edge is its number.

    Attributes:
        number: Which one of its seed.
        kind: How it was drawn.
        points: Names, also of those without a bound.
        edges: Bounds.
    """

    number: int
    kind: Kind
    points: tuple[str, ...]
    edges: tuple[Edge[int], ...]

    def stn(self) -> Stn[int]:
        """Return it as the product has it."""
        return Stn(self.edges, self.points)


def network(seed: int, number: int) -> Network:
    """Return a network; equal arguments give equal networks."""
    chance = np.random.default_rng((seed, number))
    kind = tuple(Kind)[number % len(Kind)]
    count = int(np.exp(chance.uniform(0.0, np.log(MAX_POINTS + 1))))
    points = tuple(f'p{k}' for k in range(count))
    wanted = int(chance.integers(0, int(4.0 * count * chance.uniform(0.2, 2.0)) + 2))
    ends = chance.integers(0, count, (wanted, 2))
    # Small whole numbers meet exactly far more often than great ones.
    unit = 1_000_000 if chance.random() < 0.5 else 1
    if kind is Kind.FREE:
        low = -int(_FREE_US * chance.uniform(0.0, 0.4)) // unit
        bounds = chance.integers(low, _FREE_US // unit, wanted) * unit
    else:
        times = chance.integers(0, _SPAN_US // unit, count) * unit
        slack = chance.integers(0, _FREE_US // unit, wanted) * unit
        slack[chance.random(wanted) < 0.3] = 0
        bounds = times[ends[:, 1]] - times[ends[:, 0]] + slack
    if kind is Kind.TIGHTENED and wanted:
        worst = int(chance.integers(0, wanted))
        bounds[worst] -= int(chance.integers(1, 2 * _FREE_US))
    edges = tuple(
        Edge(points[a], points[b], int(bound), k)
        for k, ((a, b), bound) in enumerate(zip(ends, bounds, strict=True))
    )
    return Network(number=number, kind=kind, points=points, edges=edges)
