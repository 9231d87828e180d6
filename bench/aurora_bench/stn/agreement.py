# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether AURORA and SciPy agree on a network, and whether each negative circle is one."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from time import perf_counter

import numpy as np

from aurora_bench.stn.networks import Kind, Network
from aurora_bench.stn.oracle import shortest
from aurora_core.temporal.stn import UNBOUNDED, Edge


@dataclass(kw_only=True)
class Comparison:
    """Counts over all networks.

    Attributes:
        networks: By kind.
        inconsistent: By kind, as both say.
        values: Bounds of minimal networks that were compared, unbounded ones included.
        unequal: Numbers of the networks whose consistency or a value differs.
        circles: Negative circles that were added up again.
        broken: Numbers of the networks whose circle is none, or not negative, or passes a point
            twice, or whose bounds are not those of the network.
        sizes: Points of the smallest and of the greatest network.
        longest: Bounds of the longest circle.
        seconds: Of AURORA and of SciPy, for all networks.
    """

    networks: Counter[Kind] = field(default_factory=Counter)
    inconsistent: Counter[Kind] = field(default_factory=Counter)
    values: int = 0
    unequal: list[int] = field(default_factory=list)
    circles: int = 0
    broken: list[int] = field(default_factory=list)
    sizes: tuple[int, int] = (10**9, 0)
    longest: int = 0
    seconds: dict[str, float] = field(default_factory=lambda: {'AURORA': 0.0, 'SciPy': 0.0})

    def compare(self, network: Network) -> None:
        """Work a network out with both."""
        count = len(network.points)
        self.networks[network.kind] += 1
        self.sizes = min(count, self.sizes[0]), max(count, self.sizes[1])
        began = perf_counter()
        mine = network.stn()
        circle, minimal = mine.negative_cycle(), mine.minimal()
        between = perf_counter()
        theirs = shortest(network)
        self.seconds['AURORA'] += between - began
        self.seconds['SciPy'] += perf_counter() - between
        consistent = {not circle, minimal is not None, theirs is not None}
        if len(consistent) != 1:
            self.unequal.append(network.number)
        if circle:
            self.inconsistent[network.kind] += 1
            self.circles += 1
            self.longest = max(self.longest, len(circle))
            if not is_negative_circle(network, circle):
                self.broken.append(network.number)
        if minimal is None or theirs is None:
            return
        own = np.where(minimal.bounds_us == UNBOUNDED, np.inf, minimal.bounds_us)
        self.values += count * count
        if minimal.points != network.points or not np.array_equal(own, theirs):
            self.unequal.append(network.number)


def is_negative_circle(network: Network, circle: tuple[Edge[int], ...]) -> bool:
    """Tell whether bounds are ones of the network, in a circle, with a negative sum."""
    points = [edge.earlier for edge in circle]
    return (
        all(network.edges[edge.reason] == edge for edge in circle)
        and all(a.later == b.earlier for a, b in pairwise((*circle, circle[0])))
        and len(set(points)) == len(points)
        and sum(edge.bound_us for edge in circle) < 0
    )
