# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The times of a request as a network: what excludes itself, and when each thing can be.

Every bound is one-sided and a possible extreme: the fastest climb, the shortest phase that meets
a stated one. So what the network excludes cannot be; what it allows may still be too much.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, islice

from aurora_core.outcomes.feasibility import BoundKind
from aurora_core.spec.stated import is_stated, most
from aurora_core.temporal.demands import Demand, demands, horizon_link
from aurora_core.temporal.flights import flight_links
from aurora_core.temporal.happenings import event_links
from aurora_core.temporal.links import Basis, Link
from aurora_core.temporal.stn import Edge, Stn, microseconds

# Bounds that say what waits for what: a circle of them cannot begin, even if it takes no time.
BEFORE = frozenset({BoundKind.CAUSE, BoundKind.MESSAGE, BoundKind.ORDER})
# Bounds by which such a circle can go on.
_ON = BEFORE | {
    BoundKind.DELAY,
    BoundKind.END,
    BoundKind.BEGUN,
    BoundKind.SEQUENCE,
    BoundKind.PHASE,
    BoundKind.ROUTE,
}

# More contradictions of one request say nothing more; one is enough.
MOST_TOLD = 12

Cycle = tuple[Link, ...]
_Find = Callable[[Sequence[Link]], Cycle]


def core_links(basis: Basis) -> tuple[Link, ...]:
    """Return the bounds that hold in every run of a request, whatever is asked of its times."""
    stated = basis.spec.world.duration_s
    last_s = most(stated, 0.0, math.inf) if is_stated(stated) else math.inf
    ends = [horizon_link(basis, last_s)] if math.isfinite(last_s) else []
    return (*flight_links(basis), *event_links(basis), *ends)


def contradictions(basis: Basis) -> Iterator[Cycle]:
    """Yield bounds that exclude each other, in circles (`outcomes.feasibility.Certificate.chain`).

    First what waits for itself, then what each demand excludes alone, then what demands exclude
    only together. Of demands that clash with each other each is told of once.
    """
    search = _Search(core_links(basis), demands(basis))
    found = chain(search.together(_waiting), search.alone(), search.together(_negative))
    yield from islice(found, MOST_TOLD)


def first_conflict(links: Sequence[Link]) -> Cycle:
    """Return bounds that exclude each other, as a circle; none when all can be met."""
    return _waiting(links) or _negative(links)


class _Search:
    """Looks for circles; what is found is taken out of the network."""

    def __init__(self, core: Sequence[Link], asked: Iterator[Demand]) -> None:
        self._core = list(core)
        self._asked = list(asked)

    def together(self, find: _Find) -> Iterator[Cycle]:
        """Yield the circles among all that is left."""
        while found := find([*self._core, *chain.from_iterable(self._asked)]):
            yield found
            kept = [d for d in self._asked if not set(d) & set(found)]
            if len(kept) == len(self._asked):
                self._core = [link for link in self._core if link not in found]
            self._asked = kept

    def alone(self) -> Iterator[Cycle]:
        """Yield the circles without any demand, and then one for each demand that has one."""
        if not _negative([*self._core, *chain.from_iterable(self._asked)]):
            return  # as nearly always
        while found := _negative(self._core):
            yield found
            self._core = [link for link in self._core if link not in found]
        kept: list[Demand] = []
        network = Stn([link.edge for link in self._core])
        for demand in self._asked:
            found = _forward(network.closed_by([link.edge for link in demand]))
            if found:
                yield found
            else:
                kept.append(demand)
        self._asked = kept


def _negative(links: Sequence[Link]) -> Cycle:
    return _forward(Stn([link.edge for link in links]).negative_cycle())


def _waiting(links: Sequence[Link]) -> Cycle:
    """Return bounds by which something waits for itself, whether that takes time or not."""
    edges = [
        Edge(a.later, a.earlier, microseconds(-a.least_s) - (a.kind in BEFORE), a)
        for a in links
        if a.kind in _ON and a.least_s is not None
    ]
    return _forward(Stn(edges).negative_cycle())


def _forward(edges: Sequence[Edge[Link]]) -> Cycle:
    """Return a circle in the order of time, its greatest bounds last."""
    links = [edge.reason for edge in reversed(edges)]
    last = max((k for k, a in enumerate(links) if a.most_s is not None), default=-1)
    return (*links[last + 1 :], *links[: last + 1])
