# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The edges of many polygons in flat arrays, so that one numpy call handles many pairs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from aurora_core.geometry import kernel
from aurora_core.geometry.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True, slots=True, kw_only=True)
class PairEdges:
    """Edges of the polygons of P (row, polygon) pairs, pair after pair.

    Attributes:
        edge: (E,) index into the edge table.
        pair: (E,) index of the pair that the edge belongs to.
        first: (P,) where each pair's edges begin, for `reduceat`.
    """

    edge: IntArray
    pair: IntArray
    first: IntArray


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeRows:
    """Edges of the polygons of P pairs, spelled out.

    Attributes:
        ax: (E,) metres east of the edge's start; `ay` north; `bx`, `by` its end.
        pair: (E,) pair that the edge belongs to.
    """

    ax: FloatArray
    ay: FloatArray
    bx: FloatArray
    by: FloatArray
    pair: IntArray


# So many edges of a polygon are for one of its slabs, about.
_EDGES_A_SLAB = 8


@dataclass(frozen=True, slots=True, kw_only=True)
class Slabs:
    """Each polygon cut into slabs from south to north, with the edges that reach into each.

    Whether a point is inside hangs on the edges at its height alone. A carriageway has thousands.

    Attributes:
        base: (N,) first slab of each polygon, in `first` and `count`.
        number: (N,) slabs of each polygon.
        south: (N,) where they begin, metres; `height` of one of them.
        edges: Edges of all slabs, one slab after the other.
        first: (S,) where the edges of each slab begin in that list; `count` of them.
    """

    base: IntArray
    number: IntArray
    south: FloatArray
    height: FloatArray
    edges: IntArray
    first: IntArray
    count: IntArray

    def of_points(self, y: FloatArray, item: IntArray) -> PairEdges:
        """Return the edges at the height of P points, of one polygon each."""
        slab = _slab(y, self.south[item], self.height[item], self.number[item])
        slab += self.base[item]
        counts = self.count[slab]
        first = np.cumsum(counts) - counts
        pair = np.repeat(np.arange(len(item), dtype=np.intp), counts)
        at = np.arange(len(pair), dtype=np.intp) + (self.first[slab] - first)[pair]
        return PairEdges(edge=self.edges[at], pair=pair, first=first)


def _slab(y: FloatArray, south: FloatArray, height: FloatArray, number: IntArray) -> IntArray:
    """Return the slab at a height; one expression for points and edges, so monotonic."""
    slab: IntArray = np.clip(np.floor((y - south) / height), 0, number - 1).astype(np.intp)
    return slab


class EdgeTable:
    """Edges of polygons with holes; every ring closes itself.

    Holes need no mark: with the even-odd rule a point in a courtyard is outside.

    Attributes:
        ax: (E,) start of each edge, metres east; `ay` north.
        bx: (E,) end of each edge; `by` north.
        ex: (E,) end minus start; `ey` north.
        ee: (E,) squared length, 1 for an edge of length 0.
        bounds: (N, 4) x_min, y_min, x_max, y_max of each polygon.
    """

    def __init__(self, polygons: Iterable[Sequence[FloatArray]]) -> None:
        starts: list[FloatArray] = []
        ends: list[FloatArray] = []
        counts: list[int] = []
        bounds: list[tuple[float, float, float, float]] = []
        for rings in polygons:
            counts.append(sum(len(ring) for ring in rings))
            for ring in rings:
                starts.append(ring)
                ends.append(np.concatenate((ring[1:], ring[:1])))
            outer = rings[0]
            low, high = outer.min(axis=0), outer.max(axis=0)
            bounds.append((float(low[0]), float(low[1]), float(high[0]), float(high[1])))
        start = np.concatenate(starts) if starts else np.zeros((0, 2))
        end = np.concatenate(ends) if ends else np.zeros((0, 2))
        self.ax: FloatArray = np.ascontiguousarray(start[:, 0])
        self.ay: FloatArray = np.ascontiguousarray(start[:, 1])
        self.bx: FloatArray = np.ascontiguousarray(end[:, 0])
        self.by: FloatArray = np.ascontiguousarray(end[:, 1])
        self.ex: FloatArray = self.bx - self.ax
        self.ey: FloatArray = self.by - self.ay
        self.ee: FloatArray = kernel.nonzero(self.ex * self.ex + self.ey * self.ey)
        self.bounds: FloatArray = np.array(bounds, dtype=np.float64).reshape(len(counts), 4)
        self._counts: IntArray = np.array(counts, dtype=np.intp)
        self._starts: IntArray = np.cumsum(self._counts) - self._counts

    def __len__(self) -> int:
        """Return the number of polygons."""
        return len(self._counts)

    @cached_property
    def _slabs(self) -> Slabs:
        number = np.maximum(1, self._counts // _EDGES_A_SLAB)
        south = self.bounds[:, 1]
        height = kernel.nonzero((self.bounds[:, 3] - south) / number)
        owner = np.repeat(np.arange(len(self), dtype=np.intp), self._counts)
        cut = south[owner], height[owner], number[owner]
        low = _slab(np.minimum(self.ay, self.by), *cut)
        reach = _slab(np.maximum(self.ay, self.by), *cut) - low + 1
        base = np.cumsum(number) - number
        edge = np.repeat(np.arange(len(owner), dtype=np.intp), reach)
        up = np.arange(len(edge), dtype=np.intp) - np.repeat(np.cumsum(reach) - reach, reach)
        slab = (base[owner] + low)[edge] + up
        order = np.argsort(slab, kind='stable')
        count = np.bincount(slab, minlength=int(number.sum()))
        return Slabs(
            base=base,
            number=number,
            south=south,
            height=height,
            edges=edge[order],
            first=np.cumsum(count) - count,
            count=count,
        )

    def of_pairs(self, item: IntArray) -> PairEdges:
        """Return the edges of one polygon per pair.

        Args:
            item: (P,) polygon of each pair.
        """
        counts = self._counts[item]
        first = np.cumsum(counts) - counts
        pair = np.repeat(np.arange(len(item), dtype=np.intp), counts)
        edge = np.arange(len(pair), dtype=np.intp) + (self._starts[item] - first)[pair]
        return PairEdges(edge=edge, pair=pair, first=first)

    def rows_of_pairs(self, item: IntArray) -> EdgeRows:
        """Return the edges of one polygon per pair, spelled out.

        Args:
            item: (P,) polygon of each pair.
        """
        pairs = self.of_pairs(item)
        edge = pairs.edge
        return EdgeRows(
            ax=self.ax[edge],
            ay=self.ay[edge],
            bx=self.bx[edge],
            by=self.by[edge],
            pair=pairs.pair,
        )

    def signed_distance(self, x: FloatArray, y: FloatArray, item: IntArray) -> FloatArray:
        """Return the plane distance of P points to one polygon each.

        Args:
            x: (P,) metres east.
            y: (P,) metres north.
            item: (P,) polygon of each point.

        Returns:
            (P,) metres to the boundary, negative inside, 0 on it.
        """
        if len(item) == 0:
            return np.zeros(0)
        pairs = self.of_pairs(item)
        edge, pair = pairs.edge, pairs.pair
        point_y = y[pair]
        start_y = self.ay[edge]
        wx = x[pair] - self.ax[edge]
        wy = point_y - start_y
        ex = self.ex[edge]
        ey = self.ey[edge]
        square = kernel.point_segment_sq(wx, wy, ex, ey, self.ee[edge])
        distance: FloatArray = np.sqrt(np.minimum.reduceat(square, pairs.first))
        crossing = kernel.upward_crossing(point_y, wx, wy, ex, ey, self.by[edge], start_y)
        inside = odd_count(pair[crossing], len(item))
        # 0.0 - d and not -d: the boundary is 0.0 seen from both sides, never -0.0
        return np.where(inside, 0.0 - distance, distance)

    def contains(self, x: FloatArray, y: FloatArray, item: IntArray) -> BoolArray:
        """Tell which of P points lie in their polygon (half-open on the boundary)."""
        pairs = self._slabs.of_points(y, item)
        edge, pair = pairs.edge, pairs.pair
        point_y = y[pair]
        start_y = self.ay[edge]
        crossing = kernel.upward_crossing(
            point_y,
            x[pair] - self.ax[edge],
            point_y - start_y,
            self.ex[edge],
            self.ey[edge],
            self.by[edge],
            start_y,
        )
        return odd_count(pair[crossing], len(item))


def odd_count(index: IntArray, size: int) -> BoolArray:
    """Tell for each of range(size) whether it occurs an odd number of times in the index."""
    odd: BoolArray = np.bincount(index, minlength=size) % 2 == 1
    return odd
