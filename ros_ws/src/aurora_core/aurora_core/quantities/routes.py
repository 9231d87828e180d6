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
from aurora_core.geometry.route_follower import RouteFollower
from aurora_core.quantities.kernels import distance_2d
from aurora_core.quantities.view import Body, RunView, Series
from aurora_core.trace.layout import GroundColumn, GroundCommandKind
from aurora_core.trace.roster import RosterEntry

FloatArray = npt.NDArray[np.float64]
BoolArray = npt.NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongRoute:
    """Two bodies on one route.

    Attributes:
        lead_m: (T,) progress of the leader minus progress of the follower (centres), metres.
        gap_m: (T,) the same from bumper to bumper.
        offset_m: (T,) distance of the leader from the follower's route.
        own_offset_m: (T,) distance of the follower from it.
    """

    lead_m: FloatArray
    gap_m: FloatArray
    offset_m: FloatArray
    own_offset_m: FloatArray


def along_route(view: RunView, follower: Body, leader: Body) -> AlongRoute:
    """Return how far `leader` is ahead of `follower` along the route of the follower.

    Samples at which one of them is absent hold what its last position gives.
    """
    key = ('along_route', follower.body_id, leader.body_id)
    lead, offset, own_offset = view.series(key, _Progress(follower, leader))
    half = (follower.entry.length_m + leader.entry.length_m) / 2.0
    return AlongRoute(lead_m=lead, gap_m=lead - half, offset_m=offset, own_offset_m=own_offset)


class _Progress:
    """Lead and offset of two bodies, part after part of a run."""

    def __init__(self, follower: Body, leader: Body) -> None:
        self._follower = follower
        self._leader = leader
        self._both = Along()

    def __call__(self, part: RunView) -> Series:
        lead = np.zeros(part.ticks)
        offset = np.zeros(part.ticks)
        own_offset = np.zeros(part.ticks)
        own = part.reference(self._follower.body_id)[:, :2]
        other = part.reference(self._leader.body_id)[:, :2]
        changes = _changes(part, self._follower)
        if not self._both.begun:
            changes.insert(0, (0, planned_route(part, self._follower)))
        elif not changes or changes[0][0] > 0:
            changes.insert(0, (0, None))  # goes on
        marks = [tick for tick, _ in changes] + [part.ticks]
        for (start, stop), (_, route) in zip(pairwise(marks), changes, strict=True):
            if stop > start:
                here = slice(start, stop)
                found = self._both.follow(route, own[here], other[here])
                lead[here], offset[here], own_offset[here] = found
        return lead, offset, own_offset


class Along:
    """Lead and offsets of two bodies on the route of one of them, in one call or in many."""

    def __init__(self) -> None:
        self._route: Polyline | None = None
        self._own: RouteFollower | None = None
        self._other: RouteFollower | None = None

    @property
    def begun(self) -> bool:
        """Whether there is a route yet."""
        return self._route is not None

    def follow(
        self, new: Polyline | None, own: FloatArray, other: FloatArray
    ) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return lead of the other one, its offset and one's own at the next samples, metres.

        Args:
            new: Route from these samples on, None where it goes on.
            own: (n, 2) positions of whose route it is.
            other: (n, 2) positions of the other one.
        """
        if new is not None:
            self._route, self._other = new, None
            self._own = RouteFollower(new, extend=True)
        assert self._route is not None  # the first part begins with a route
        assert self._own is not None
        own_s = self._own.follow(own)
        if self._other is None:
            expected = float(own_s[0]) + distance_2d(
                float(other[0, 0] - own[0, 0]), float(other[0, 1] - own[0, 1])
            )
            self._other = RouteFollower(self._route, expected, extend=True)
        other_s = self._other.follow(other)
        offset = _offset(self._route, other, other_s)
        return other_s - own_s, offset, _offset(self._route, own, own_s)


def _offset(route: Polyline, xy: FloatArray, s: FloatArray) -> FloatArray:
    """Return the distance of points from the places of the (prolonged) route at s."""
    points, marks = route.points, route.cumulative_m
    k = np.searchsorted(marks, s, side='right') - 1
    k = np.minimum(np.maximum(k, 0), len(marks) - 2)
    step = marks[k + 1] - marks[k]
    share = (s - marks[k]) / step
    at = points[k] + share[:, None] * (points[k + 1] - points[k])
    return distance_2d(xy[:, 0] - at[:, 0], xy[:, 1] - at[:, 1])


def _changes(view: RunView, body: Body) -> list[tuple[int, Polyline | None]]:
    """Return the new routes of a body with the ticks from which on they are in force."""
    found: list[tuple[int, Polyline | None]] = []
    for tick, commands in enumerate(view.trace.ground_commands):
        for command in commands:
            if command.agent == body.row and command.kind is GroundCommandKind.SET_ROUTE:
                route = _of_edges(view, command.text.split())
                if route is not None:
                    found.append((tick, route))
    return found


def planned_route(view: RunView, body: Body) -> Polyline:
    """Return the path of a body as it was planned before the run."""
    return route_of(body.entry, view.rows(body)[0])


def route_of(entry: RosterEntry, state: FloatArray) -> Polyline:
    """Return the planned path of an agent; `state` is its first one, (GROUND_WIDTH,)."""
    try:
        return Polyline(np.array(entry.route_xy_m, dtype=np.float64).reshape(-1, 2))
    except MapError:
        # A body that never drives has no path: its heading stands for it.
        x, y = float(state[GroundColumn.X]), float(state[GroundColumn.Y])
        hx, hy = float(state[GroundColumn.HEADING_X]), float(state[GroundColumn.HEADING_Y])
        return Polyline([(x, y), (x + hx, y + hy)])


def _of_edges(view: RunView, edges: list[str]) -> Polyline | None:
    lanes = {lane.lane_id: lane.points for lane in reversed(view.world.lanes)}
    by_edge = {lane_id.rpartition('_')[0]: points for lane_id, points in lanes.items()}
    parts = [by_edge[edge] for edge in edges if edge in by_edge]
    return Polyline(np.concatenate(parts)) if parts else None
