# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Overlap of bodies, clearance from obstacles, separation of UAVs, no-fly zones."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations, product

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.box import box_gap_series
from aurora_core.geometry.obstacles import point_box_distance
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.motion import distance
from aurora_core.quantities.view import Body, RunView, Series
from aurora_core.trace.layout import GroundColumn

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]

# Clearances beyond this are not told apart.
CLEARANCE_CUTOFF_M = 50.0
# Rounding of a distance is far below this.
_GUARD_M = 1.0
# Ticks that are looked at together.
_BLOCK = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class LeastSeries:
    """The least of several signals at each sample, and which one it is.

    Attributes:
        values: (T,).
        which: (T,) index into `names`, -1 where none applies.
        names: What the index stands for.
    """

    values: FloatArray
    which: npt.NDArray[np.intp]
    names: tuple[str, ...]

    def name_at(self, tick: int) -> str:
        """Return the name of the least signal at a tick, empty when none applies."""
        index = int(self.which[tick])
        return self.names[index] if index >= 0 else ''


class _Least:
    """Collects the least of signals, the earlier one of equals."""

    def __init__(self, ticks: int, ceiling: float) -> None:
        self.values = np.full(ticks, ceiling)
        self.which: npt.NDArray[np.intp] = np.full(ticks, -1, dtype=np.intp)

    def add(self, number: int, ticks: npt.NDArray[np.intp], values: FloatArray) -> None:
        """Take in the signal of a number at some ticks, in the order of the numbers."""
        less = values < self.values[ticks]
        if less.any():
            self.values[ticks[less]] = values[less]
            self.which[ticks[less]] = number


def _reach(body: Body) -> float:
    """Return a radius around the reference point that holds the whole box."""
    return (body.entry.length_m + body.entry.width_m) / 2.0


def body_gap(view: RunView) -> LeastSeries:
    """Return the least gap of any two ground bodies, and of any UAV and ground body.

    Two ground bodies: signed gap of their boxes in the plane, below 0 the depth of the overlap.
    UAV and ground body: distance of the UAV's centre from the box in space less half the UAV's
    greatest extent, below 0 when they overlap. At most CLEARANCE_CUTOFF_M.
    """
    values, which = view.series(('body_gap',), _body_gap)
    names = [f'{a.body_id} and {b.body_id}' for a, b in combinations(view.agents, 2)]
    names += [f'{uav.body_id} and {body.body_id}' for uav, body in product(view.uavs, view.agents)]
    return LeastSeries(values=values, which=which, names=tuple(names))


def _body_gap(view: RunView) -> Series:
    least = _Least(view.ticks, CLEARANCE_CUTOFF_M)
    for start in range(0, view.ticks, _BLOCK):
        ticks = np.arange(start, min(start + _BLOCK, view.ticks), dtype=np.intp)
        for number, gap in _ground_gaps(view, ticks):
            least.add(number, ticks, gap)
    count = len(view.agents)
    for row, uav in enumerate(view.uavs):
        first = count * (count - 1) // 2 + row * count  # the order of `product`
        half = max(uav.entry.length_m, uav.entry.width_m, uav.entry.height_m) / 2.0
        for number, body in _beneath(view, uav, CLEARANCE_CUTOFF_M + half):
            k, away = _to_box(view, uav, body, least.values + half)
            least.add(first + number, k, away - half)
    return least.values, least.which


def _ground_gaps(view: RunView, ticks: npt.NDArray[np.intp]) -> Iterator[tuple[int, FloatArray]]:
    """Yield the gaps of the pairs of ground bodies that come within the cutoff, (len(ticks),).

    All pairs at once, a few ticks at a time: for each pair by itself the calls would cost more
    than the work.
    """
    rows = view.trace.ground[ticks]
    number, a, b = _near(view, rows)
    if len(number) == 0:
        return
    xy = rows[:, :, GroundColumn.X : GroundColumn.Y + 1]
    delta = xy[:, b] - xy[:, a]
    apart = distance_2d(delta[:, :, 0], delta[:, :, 1])
    reach = np.array([_reach(body) for body in view.agents])
    present = rows[:, :, GroundColumn.PRESENT] > 0.5
    close = present[:, a] & present[:, b]
    close &= apart - reach[a] - reach[b] < CLEARANCE_CUTOFF_M
    tick, pair = np.nonzero(close)
    length = np.array([body.entry.length_m for body in view.agents])
    width = np.array([body.entry.width_m for body in view.agents])
    gaps = np.full(close.shape, CLEARANCE_CUTOFF_M)
    gaps[tick, pair] = box_gap_series(
        *_box(rows[tick, a[pair]]),
        length[a[pair]],
        width[a[pair]],
        *_box(rows[tick, b[pair]]),
        length[b[pair]],
        width[b[pair]],
    )
    for k in np.flatnonzero(close.any(axis=0)):
        yield int(number[k]), gaps[:, k]


def _near(view: RunView, rows: FloatArray) -> tuple[npt.NDArray[np.intp], ...]:
    """Return the pairs of ground bodies that may come within the cutoff: number, rows of both.

    Of the others the rectangles that hold all their positions are farther apart than that.
    """
    xy = rows[:, :, GroundColumn.X : GroundColumn.Y + 1]
    low, high = xy.min(axis=0), xy.max(axis=0)
    reach = np.array([_reach(body) for body in view.agents])
    a, b = np.triu_indices(len(reach), k=1)  # the order of `combinations`
    apart = np.maximum(low[b] - high[a], low[a] - high[b]).max(axis=1, initial=-np.inf)
    far = apart > CLEARANCE_CUTOFF_M + reach[a] + reach[b] + _GUARD_M
    number = np.flatnonzero(~far)
    return number, a[number], b[number]


def _box(rows: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    return (
        rows[:, GroundColumn.X],
        rows[:, GroundColumn.Y],
        rows[:, GroundColumn.HEADING_X],
        rows[:, GroundColumn.HEADING_Y],
    )


def _beneath(view: RunView, uav: Body, below_m: float) -> Iterator[tuple[int, Body]]:
    """Yield row and ground body of those that a UAV may at some tick be nearer to than `below_m`.

    All bodies at once: for each by itself the calls would cost more than the work.
    """
    ground, point = view.trace.ground, view.reference(uav.body_id)
    apart = distance_2d(
        point[:, :1] - ground[:, :, GroundColumn.X],
        point[:, 1:2] - ground[:, :, GroundColumn.Y],
    )
    reach = np.array([_reach(body) for body in view.agents])
    near = (ground[:, :, GroundColumn.PRESENT] > 0.5) & (apart - reach < below_m)
    for row in np.flatnonzero(near.any(axis=0)):
        yield int(row), view.agents[row]


def _to_box(
    view: RunView, uav: Body, body: Body, below: FloatArray
) -> tuple[npt.NDArray[np.intp], FloatArray]:
    """Return ticks at which a UAV may be nearer to a body than `below`, and how near it is."""
    rows = view.rows(body)
    point = view.reference(uav.body_id)
    apart = distance_2d(
        point[:, 0] - rows[:, GroundColumn.X], point[:, 1] - rows[:, GroundColumn.Y]
    )
    k = np.flatnonzero(view.present(body.body_id) & (apart - _reach(body) < below))
    if len(k) == 0:
        return k, np.zeros(0)
    away = point_box_distance(
        point[k],
        rows[k, GroundColumn.X : GroundColumn.Y + 1],
        rows[k, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1],
        body.entry.length_m,
        body.entry.width_m,
        body.entry.height_m,
    )
    return k, away


def obstacle_clearance(view: RunView, uav: Body) -> LeastSeries:
    """Return the distance of a UAV's centre from the nearest building, vehicle or person.

    Never from the ground. Metres, at most CLEARANCE_CUTOFF_M.
    """

    def compute(part: RunView) -> Series:
        least = _Least(part.ticks, CLEARANCE_CUTOFF_M)
        every = np.arange(part.ticks, dtype=np.intp)
        point = part.reference(uav.body_id)
        to_building = part.geometry.obstacles.clearance_series(point, CLEARANCE_CUTOFF_M)
        least.add(0, every, to_building)
        for row, body in _beneath(part, uav, CLEARANCE_CUTOFF_M):
            least.add(1 + row, *_to_box(part, uav, body, least.values))
        return least.values, least.which

    values, which = view.series(('obstacle_clearance', uav.body_id), compute)
    names = ('a building', *(body.body_id for body in view.agents))
    return LeastSeries(values=values, which=which, names=names)


def separation(view: RunView, a: str, b: str) -> FloatArray:
    """Return the 3-D distance of two bodies, (T,) metres."""
    return distance(view, a, b)


def no_fly_distance(view: RunView, uav: Body) -> FloatArray:
    """Return the signed distance from the nearest no-fly zone, negative inside, (T,) metres."""

    def compute(part: RunView) -> Series:
        point = part.reference(uav.body_id)
        return (part.geometry.zones.clearance_series(point, CLEARANCE_CUTOFF_M),)

    values: FloatArray = view.series(('no_fly', uav.body_id), compute)[0]
    return values
