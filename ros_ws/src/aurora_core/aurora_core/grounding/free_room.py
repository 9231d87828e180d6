# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places on lanes that are apart from everybody who has one already."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from math import floor, sqrt

import numpy as np

from aurora_core.knowledge.net_types import Lane
from aurora_core.knowledge.road_network import RoadNetwork

# Tries at random places before all places are looked through, and how far apart those are (m).
_TRIES = 400
_SCAN_M = 5.0

# Lane, simulator position on it (m), distance from the centre (m).
FreePlace = tuple[Lane, float, float]


# Lane, simulator position on it, x, y (m, ENU).
_Scanned = tuple[Lane, float, float, float]


class _Scan:
    """Places all over some lanes, in their order.

    Attributes:
        places: All of them.
        cells: Those that are left, by cell.
        left: The same, as one set.
        seen: How many who stand somewhere are taken into account.
    """

    def __init__(self, places: list[_Scanned]) -> None:
        self.places = places
        self.cells: defaultdict[tuple[int, int], list[int]] = defaultdict(list)
        self.left = set(range(len(places)))
        self.seen = 0


class FreeRoom:
    """Where there is room on lanes round a centre.

    Args:
        network: Road network.
        centre: x, y (m, ENU).
        gap_m: How far apart everybody is.
    """

    def __init__(self, network: RoadNetwork, centre: tuple[float, float], gap_m: float) -> None:
        self._network = network
        self._centre = centre
        self._gap_m = gap_m
        self._cell_m = max(gap_m, 1.0)
        # Who is nearer than the gap stands in the same cell or in one of the eight round it.
        self._taken: defaultdict[tuple[int, int], list[tuple[float, float]]] = defaultdict(list)
        self._places: list[tuple[float, float]] = []
        self._scans: dict[tuple[float, tuple[str, ...]], _Scan] = {}

    def take(self, x: float, y: float) -> None:
        """Note that somebody stands at a place (m, ENU)."""
        self._places.append((x, y))
        for cell in self._cells_round(x, y):
            self._taken[cell].append((x, y))

    def drawn(
        self, lanes: list[Lane], margin_m: float, generator: np.random.Generator
    ) -> Iterator[FreePlace]:
        """Yield random free places on random lanes, `margin_m` away from their ends."""
        for _ in range(_TRIES):
            lane = lanes[int(generator.integers(len(lanes)))]
            span_m = lane.length_m - 2.0 * margin_m
            position_m = margin_m + float(generator.random()) * span_m
            x, y, _, _ = self._network.position_on_lane(lane.id, position_m)
            if self._is_free(x, y):
                yield lane, position_m, self._away_m(x, y)

    def scanned(self, lanes: list[Lane], margin_m: float) -> Iterator[FreePlace]:
        """Yield free places all over the lanes, nearest to the centre first."""
        key = margin_m, tuple(lane.id for lane in lanes)
        scan = self._scans.get(key)
        if scan is None:
            scan = self._scans[key] = _Scan(places=self._all_places(lanes, margin_m))
            for k, (_, _, x, y) in enumerate(scan.places):
                scan.cells[self._cell(x, y)].append(k)
        # Nobody leaves: what somebody takes is left out for good.
        for x, y in self._places[scan.seen :]:
            for cell in self._cells_round(x, y):
                near = scan.cells.get(cell, ())
                free = [k for k in near if self._apart(x, y, *scan.places[k][2:])]
                if len(free) < len(near):
                    scan.left.difference_update(near)
                    scan.left.update(free)
                    scan.cells[cell] = free
        scan.seen = len(self._places)
        for k in sorted(scan.left):
            lane, position_m, x, y = scan.places[k]
            yield lane, position_m, self._away_m(x, y)

    def _all_places(self, lanes: list[Lane], margin_m: float) -> list[_Scanned]:
        found = []
        for lane in lanes:
            for k in range(int((lane.length_m - 2.0 * margin_m) / _SCAN_M) + 1):
                position_m = margin_m + k * _SCAN_M
                x, y, _, _ = self._network.position_on_lane(lane.id, position_m)
                square = (x - self._centre[0]) ** 2 + (y - self._centre[1]) ** 2
                found.append((square, lane.id, position_m, (lane, position_m, x, y)))
        return [place for _, _, _, place in sorted(found, key=lambda p: p[:3])]

    def _away_m(self, x: float, y: float) -> float:
        return sqrt((x - self._centre[0]) ** 2 + (y - self._centre[1]) ** 2)

    def _is_free(self, x: float, y: float) -> bool:
        return all(self._apart(x, y, u, v) for u, v in self._taken.get(self._cell(x, y), ()))

    def _apart(self, x: float, y: float, u: float, v: float) -> bool:
        return sqrt((x - u) ** 2 + (y - v) ** 2) >= self._gap_m

    def _cells_round(self, x: float, y: float) -> Iterator[tuple[int, int]]:
        column, row = self._cell(x, y)
        for one in (column - 1, column, column + 1):
            for other in (row - 1, row, row + 1):
                yield one, other

    def _cell(self, x: float, y: float) -> tuple[int, int]:
        return floor(x / self._cell_m), floor(y / self._cell_m)
