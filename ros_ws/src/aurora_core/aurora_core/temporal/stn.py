# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Simple Temporal Networks: time points, bounds on their differences, and what follows from them.

Source: Dechter, Meiri, Pearl, Temporal constraint networks, Artificial Intelligence 49 (1991).

Times are whole microseconds, so sums are exact and equal on every machine. A bound in seconds
becomes whole microseconds on its looser side (`microseconds`): rounding can hide a contradiction
of one microsecond per bound, and can make none.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from heapq import heappop, heappush
from itertools import chain
from typing import Generic, TypeVar

import numpy as np
import numpy.typing as npt

IntArray = npt.NDArray[np.int64]
Reason = TypeVar('Reason')

SECOND = 1_000_000
# No bound between two points. A network whose bounds could add up to this is refused.
UNBOUNDED = 2**60
# A whole number of microseconds is found again below this share of one (float seconds).
_EXACT = 1e-3


def microseconds(seconds: float) -> int:
    """Return the least number of whole microseconds that is not less than a time.

    What is within a thousandth of a whole number is that number: 0.1 s is 100 000, not 100 001.
    """
    exact = seconds * SECOND
    nearest = round(exact)
    return nearest if abs(exact - nearest) <= _EXACT else math.ceil(exact)


@dataclass(frozen=True, slots=True)
class Edge(Generic[Reason]):
    """`later` comes at most `bound_us` after `earlier`; a negative bound: it comes before it.

    Attributes:
        earlier: A time point.
        later: Another one.
        bound_us: Greatest value of the time of `later` less that of `earlier`, microseconds.
        reason: Whatever it is because of; handed back in cycles.
    """

    earlier: str
    later: str
    bound_us: int
    reason: Reason


@dataclass(frozen=True, slots=True)
class Minimal:
    """The minimal network: the tightest bound between any two points that follows from all.

    Attributes:
        points: In the order of their rows.
        bounds_us: (N, N): greatest time of column less that of row; `UNBOUNDED`: none.
    """

    points: tuple[str, ...]
    bounds_us: IntArray

    def most_us(self, earlier: str, later: str) -> int | None:
        """Return by how much a point comes after another at most, None without a bound."""
        bound = int(self.bounds_us[self.points.index(earlier), self.points.index(later)])
        return None if bound == UNBOUNDED else bound


class Stn(Generic[Reason]):
    """A network that does not change.

    Args:
        edges: Its bounds; of several between two points the tightest counts.
        points: Points that may have no bound at all, before those of the edges.

    Raises:
        ValueError: The bounds are so great that their sums have no room.
    """

    def __init__(self, edges: Sequence[Edge[Reason]], points: Sequence[str] = ()) -> None:
        ends = [point for edge in edges for point in (edge.earlier, edge.later)]
        self.points = tuple(dict.fromkeys((*points, *ends)))
        self.edges = tuple(edges)
        at = {point: k for k, point in enumerate(self.points)}
        self._from = np.array([at[e.earlier] for e in edges], dtype=np.intp)
        self._to = np.array([at[e.later] for e in edges], dtype=np.intp)
        greatest = max((abs(e.bound_us) for e in edges), default=0)
        if greatest * (len(self.points) + 1) >= UNBOUNDED:
            raise ValueError(f'bounds of {greatest} microseconds have no room to be added up')
        self._bounds = np.array([e.bound_us for e in edges], dtype=np.int64)

    def negative_cycle(self) -> tuple[Edge[Reason], ...]:
        """Return bounds in a circle whose sum is negative, none when the network is consistent.

        Each begins where the one before ends. Without any one of them the others can be met: the
        circle passes no point twice.
        """
        return self._solved[1]

    @cached_property
    def _solved(self) -> tuple[IntArray, tuple[Edge[Reason], ...]]:
        """Times that meet every bound, or a negative circle, by Bellman and Ford."""
        count = len(self.points)
        times = np.zeros(count, dtype=np.int64)
        through = np.full(count, -1, dtype=np.intp)
        rounds = 0
        while True:
            reached = times[self._from] + self._bounds
            better = times.copy()
            np.minimum.at(better, self._to, reached)
            used = np.flatnonzero((reached == better[self._to]) & (reached < times[self._to]))
            if not len(used):
                return times, ()
            through[self._to[used]] = used
            times = better
            rounds += 1
            # Who moves after as many rounds as there are points hangs on a circle; most circles
            # are short, and there long before.
            if rounds & (rounds - 1) == 0:
                point = self._on_circle(through)
                if point is not None:
                    return times, self._circle(through, point)

    def closed_by(self, more: Sequence[Edge[Reason]]) -> tuple[Edge[Reason], ...]:
        """Return a negative circle that further bounds close, none when they can be met as well.

        Costs only what they move, where a network anew would cost the whole. The network stays
        as it is. Source: Cotton, Maler, Fast and flexible difference constraint propagation for
        DPLL(T), SAT 2006.

        Args:
            more: Bounds, between points of this network or new ones.

        Raises:
            ValueError: The network is inconsistent without them.
        """
        if self.negative_cycle():
            raise ValueError('bounds are added to a consistent network only')
        moved: dict[str, int] = {}
        added: dict[str, list[Edge[Reason]]] = {}
        for edge in more:
            circle = self._added(edge, moved, added)
            if circle:
                return circle
            added.setdefault(edge.earlier, []).append(edge)
        return ()

    def _added(
        self, edge: Edge[Reason], moved: dict[str, int], added: dict[str, list[Edge[Reason]]]
    ) -> tuple[Edge[Reason], ...]:
        """Move points, nearest first, until a bound is met; the circle if none can meet it."""
        times, leaving = self._times, self._leaving

        def time(point: str) -> int:
            return moved[point] if point in moved else times.get(point, 0)

        sooner = {edge.later: time(edge.earlier) + edge.bound_us - time(edge.later)}
        through = {edge.later: edge}
        waiting = [(sooner[edge.later], edge.later)] if sooner[edge.later] < 0 else []
        settled: dict[str, int] = {}
        while waiting:
            by, point = heappop(waiting)
            if point in settled:
                continue
            if point == edge.earlier:
                circle = [through[point]]
                while circle[-1] is not edge:
                    circle.append(through[circle[-1].earlier])
                return tuple(reversed(circle))
            settled[point] = time(point) + by
            for onward in chain(leaving.get(point, ()), added.get(point, ())):
                gain = settled[point] + onward.bound_us - time(onward.later)
                if onward.later not in settled and gain < sooner.get(onward.later, 0):
                    sooner[onward.later], through[onward.later] = gain, onward
                    heappush(waiting, (gain, onward.later))
        moved.update(settled)
        return ()

    @cached_property
    def _times(self) -> dict[str, int]:
        return dict(zip(self.points, self._solved[0].tolist(), strict=True))

    @cached_property
    def _leaving(self) -> dict[str, list[Edge[Reason]]]:
        leaving: dict[str, list[Edge[Reason]]] = {}
        for edge in self.edges:
            leaving.setdefault(edge.earlier, []).append(edge)
        return leaving

    def _on_circle(self, through: npt.NDArray[np.intp]) -> int | None:
        """Return a point to which one comes again by the edges that moved points last."""
        count = len(self.points)
        before = np.append(np.where(through < 0, count, self._from[through]), count)
        for _ in range(count.bit_length()):
            before = before[before]
        caught = before[before < count]
        return int(caught[0]) if len(caught) else None

    def _circle(self, through: npt.NDArray[np.intp], point: int) -> tuple[Edge[Reason], ...]:
        found: list[Edge[Reason]] = []
        at = point
        while not found or at != point:
            edge = int(through[at])
            found.append(self.edges[edge])
            at = int(self._from[edge])
        return tuple(reversed(found))

    def spans_us(self, origin: str) -> dict[str, tuple[int | None, int | None]] | None:
        """Return by how much each point comes after one of them at least and at most.

        The rows of that point in `minimal`, without the others. None for a side without a bound;
        None at all when some bounds exclude each other.
        """
        if self.negative_cycle():
            return None
        start = self.points.index(origin)
        most = self._spread(start, self._from, self._to)
        least = self._spread(start, self._to, self._from)
        return {
            point: (-before if before < UNBOUNDED else None, after if after < UNBOUNDED else None)
            for point, before, after in zip(
                self.points, least.tolist(), most.tolist(), strict=True
            )
        }

    def _spread(
        self, start: int, tails: npt.NDArray[np.intp], heads: npt.NDArray[np.intp]
    ) -> IntArray:
        """Return the least sums of bounds from a point, along edges from tails to heads."""
        sums = np.full(len(self.points), UNBOUNDED, dtype=np.int64)
        sums[start] = 0
        while True:
            better = sums.copy()
            known = sums[tails] < UNBOUNDED
            np.minimum.at(better, heads[known], sums[tails[known]] + self._bounds[known])
            if (better == sums).all():
                return sums
            sums = better

    def minimal(self) -> Minimal | None:
        """Return the minimal network, None when there is none: some bounds exclude each other."""
        count = len(self.points)
        bounds = np.full((count, count), UNBOUNDED, dtype=np.int64)
        np.fill_diagonal(bounds, 0)
        np.minimum.at(bounds, (self._from, self._to), self._bounds)
        for k in range(count):
            first, second = bounds[:, k, None], bounds[None, k, :]
            joined = np.where(
                (first < UNBOUNDED) & (second < UNBOUNDED), first + second, UNBOUNDED
            )
            np.minimum(bounds, joined, out=bounds)
            if (np.diagonal(bounds) < 0).any():
                return None
        return Minimal(self.points, bounds)
