# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Which lane a body is on, from its place and heading; between two lanes it is on the nearer one.

Lanes are those of the measured world. Inside a junction, and off the carriageway, it is on none.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from aurora_core.geometry.kernel import norm2
from aurora_core.knowledge.world import CentreLine, WorldModel
from aurora_core.quantities.view import Body, RunView, Series
from aurora_core.trace.layout import GroundColumn

FloatArray = npt.NDArray[np.float64]
LaneArray = npt.NDArray[np.intp]

NO_LANE = -1


def edge_of(lane: CentreLine) -> str:
    """Return the street edge of a lane: all lanes of one direction between two junctions."""
    return lane.lane_id.rpartition('_')[0]


def edges_with_several_lanes(world: WorldModel) -> frozenset[str]:
    """Return the edges on which there is another lane to change to."""
    count = Counter(edge_of(lane) for lane in world.lanes)
    return frozenset(edge for edge, lanes in count.items() if lanes > 1)


def lane_of(view: RunView, body: Body) -> LaneArray:
    """Return the index in `world.lanes` of the lane that a body is on, (T,); else `NO_LANE`."""

    def compute(part: RunView) -> Series:
        return (lanes_of_rows(part.world, part.rows(body)),)

    lanes: LaneArray = view.series(('lane_of', body.body_id), compute)[0]
    return lanes


def lanes_of_rows(world: WorldModel, rows: FloatArray) -> LaneArray:
    """Return the same of states (n, GROUND_WIDTH) of a body, (n,)."""
    found = np.full(len(rows), NO_LANE, dtype=np.intp)
    nearest = np.full(len(rows), np.inf)
    around = _around(world, rows)
    for index in np.flatnonzero(around.any(axis=1)).tolist():
        near = np.flatnonzero(around[index])
        square = _square_distance(world.lanes[index], rows[near])
        better = square < nearest[near]
        found[near[better]] = index
        nearest[near[better]] = square[better]
    return found


def off_lane_m(lane: CentreLine, rows: FloatArray) -> FloatArray:
    """Return how far states (n, GROUND_WIDTH) are from the centre line of a lane, (n,) metres."""
    best = np.full(len(rows), np.inf)
    for _, _, _, square in _to_segments(lane, rows[:, [GroundColumn.X, GroundColumn.Y]]):
        best = np.minimum(best, square)
    off_m: FloatArray = np.sqrt(best)
    return off_m


def left_of_lane_m(lane: CentreLine, rows: FloatArray) -> FloatArray:
    """Return how far a lane goes on from states (n, GROUND_WIDTH), (n,) metres."""
    best, passed_m = np.full(len(rows), np.inf), np.zeros(len(rows))
    before_m = 0.0
    for dx, dy, share, square in _to_segments(lane, rows[:, [GroundColumn.X, GroundColumn.Y]]):
        step_m = norm2(dx, dy)
        passed_m = np.where(square < best, before_m + share * step_m, passed_m)
        best = np.minimum(best, square)
        before_m += step_m
    left_m: FloatArray = before_m - passed_m
    return left_m


def _around(world: WorldModel, rows: FloatArray) -> npt.NDArray[np.bool_]:
    """Tell of each lane which states are inside the box around it, (L, n)."""
    x, y = rows[:, GroundColumn.X], rows[:, GroundColumn.Y]
    west, south, east, north = world.lane_boxes.T[:, :, None]
    inside: npt.NDArray[np.bool_] = (x >= west) & (x <= east) & (y >= south) & (y <= north)
    return inside


def _square_distance(lane: CentreLine, rows: FloatArray) -> FloatArray:
    """Return squared distances from the centre line, infinite beyond the lane or against it."""
    hx, hy = rows[:, GroundColumn.HEADING_X], rows[:, GroundColumn.HEADING_Y]
    limit = (lane.width_m / 2.0) * (lane.width_m / 2.0)
    best = np.full(len(rows), np.inf)
    for dx, dy, _, square in _to_segments(lane, rows[:, [GroundColumn.X, GroundColumn.Y]]):
        on = (square <= limit) & (hx * dx + hy * dy > 0.0)
        best = np.where(on & (square < best), square, best)
    return best


def _to_segments(
    lane: CentreLine, xy: FloatArray
) -> Iterator[tuple[float, float, FloatArray, FloatArray]]:
    """Yield of each segment of a centre line its vector, and where points (n, 2) are beside it.

    That is the share of the segment in [0, 1] and the squared distance, (n,) each.
    """
    for a, b in pairwise(lane.points):
        dx, dy = float(b[0] - a[0]), float(b[1] - a[1])
        length2 = dx * dx + dy * dy
        if length2 == 0.0:
            continue
        along = ((xy[:, 0] - a[0]) * dx + (xy[:, 1] - a[1]) * dy) / length2
        at = np.minimum(np.maximum(along, 0.0), 1.0)
        off_x, off_y = xy[:, 0] - (a[0] + at * dx), xy[:, 1] - (a[1] + at * dy)
        yield dx, dy, at, off_x * off_x + off_y * off_y


def inside_lanes_m(lanes: Iterable[CentreLine], xy: FloatArray) -> FloatArray:
    """Return by how much points lie inside the nearest edges of lanes, (T,) metres.

    Args:
        lanes: At least one.
        xy: (T, 2) metres.

    Returns:
        Half the width minus the distance from the centre line, of the lane where it is most.
    """
    best = np.full(len(xy), -np.inf)
    for lane in lanes:
        for _, _, _, square in _to_segments(lane, xy):
            best = np.maximum(best, lane.width_m / 2.0 - np.sqrt(square))
    return best


def lane_change_ticks(view: RunView, lanes: LaneArray) -> list[int]:
    """Return the ticks at which a body is first seen on another lane of the same edge.

    Args:
        view: The run.
        lanes: (T,) as `lane_of` returns it; on its way across a body may be on no lane.
    """
    known = np.flatnonzero(lanes != NO_LANE)
    names = [edge_of(lane) for lane in view.world.lanes]
    # Few of many samples differ from the one before: only these are looked up.
    differ = np.flatnonzero(lanes[known[1:]] != lanes[known[:-1]]) + 1
    return [
        int(known[k])
        for k in differ.tolist()
        if names[int(lanes[known[k]])] == names[int(lanes[known[k - 1]])]
    ]


def lane_before(lanes: LaneArray, tick: int) -> int:
    """Return the lane on which a body was seen last before a tick, else `NO_LANE`."""
    known = np.flatnonzero(lanes[:tick] != NO_LANE)
    return int(lanes[known[-1]]) if len(known) else NO_LANE
