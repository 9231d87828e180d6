# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Ahead and behind: progress of two bodies along the route of the one that follows.

The route is the planned path of the roster; a SET_ROUTE command replaces it from its tick on by
the centre lines of the lanes of the new edges.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from aurora_core.errors import MapError
from aurora_core.geometry.polyline import Polyline
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.view import Body, RunView
from aurora_core.trace.layout import GroundColumn, GroundCommandKind

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongRoute:
    """Two bodies on one route.

    Attributes:
        lead_m: (T,) progress of the leader minus progress of the follower (centres), metres.
        gap_m: (T,) the same from bumper to bumper.
        offset_m: (T,) distance of the leader from the follower's route.
    """

    lead_m: FloatArray
    gap_m: FloatArray
    offset_m: FloatArray


def along_route(view: RunView, follower: Body, leader: Body) -> AlongRoute:
    """Return how far `leader` is ahead of `follower` along the route of the follower.

    Samples at which one of them is absent hold what its last position gives.
    """
    lead = np.zeros(view.ticks)
    offset = np.zeros(view.ticks)
    for start, stop, route in _routes(view, follower):
        own = view.reference(follower.body_id)[start:stop, :2]
        other = view.reference(leader.body_id)[start:stop, :2]
        own_s = route.project_series(own, 0.0, extend=True)
        expected = float(own_s[0]) + distance_2d(
            float(other[0, 0] - own[0, 0]), float(other[0, 1] - own[0, 1])
        )
        other_s = route.project_series(other, expected, extend=True)
        lead[start:stop] = other_s - own_s
        offset[start:stop] = _offset(route, other, other_s)
    half = (follower.entry.length_m + leader.entry.length_m) / 2.0
    return AlongRoute(lead_m=lead, gap_m=lead - half, offset_m=offset)


def _offset(route: Polyline, xy: FloatArray, s: FloatArray) -> FloatArray:
    """Return the distance of points from the places of the (prolonged) route at s."""
    points, marks = route.points, route.cumulative_m
    k = np.searchsorted(marks, s, side='right') - 1
    k = np.minimum(np.maximum(k, 0), len(marks) - 2)
    step = marks[k + 1] - marks[k]
    share = (s - marks[k]) / step
    at = points[k] + share[:, None] * (points[k + 1] - points[k])
    return distance_2d(xy[:, 0] - at[:, 0], xy[:, 1] - at[:, 1])


def _routes(view: RunView, body: Body) -> list[tuple[int, int, Polyline]]:
    """Return the routes of a body with the ticks [start, stop) at which they are in force."""
    changes: list[tuple[int, Polyline]] = [(0, _planned(view, body))]
    for tick, commands in enumerate(view.trace.ground_commands):
        for command in commands:
            if command.agent == body.row and command.kind is GroundCommandKind.SET_ROUTE:
                route = _of_edges(view, command.text.split())
                if route is not None:
                    changes.append((tick, route))
    marks = [tick for tick, _ in changes] + [view.ticks]
    return [
        (start, stop, route)
        for (start, stop), (_, route) in zip(pairwise(marks), changes, strict=True)
        if stop > start
    ]


def _planned(view: RunView, body: Body) -> Polyline:
    try:
        return Polyline(np.array(body.entry.route_xy_m, dtype=np.float64).reshape(-1, 2))
    except MapError:
        # A body that never drives has no path: its heading stands for it.
        state = view.rows(body)[0]
        x, y = float(state[GroundColumn.X]), float(state[GroundColumn.Y])
        hx, hy = float(state[GroundColumn.HEADING_X]), float(state[GroundColumn.HEADING_Y])
        return Polyline([(x, y), (x + hx, y + hy)])


def _of_edges(view: RunView, edges: list[str]) -> Polyline | None:
    lanes = {lane.lane_id: lane.points for lane in reversed(view.world.lanes)}
    by_edge = {lane_id.rpartition('_')[0]: points for lane_id, points in lanes.items()}
    parts = [by_edge[edge] for edge in edges if edge in by_edge]
    return Polyline(np.concatenate(parts)) if parts else None
