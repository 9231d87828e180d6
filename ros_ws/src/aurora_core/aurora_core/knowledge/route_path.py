# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The exact line that a vehicle drives along a route, lane by lane, through the junctions."""

from __future__ import annotations

import bisect
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from operator import attrgetter
from typing import NamedTuple

from aurora_core.errors import MapError
from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.box import chord_pose
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.lane_plan import LanePlan
from aurora_core.knowledge.net_types import Connection, Edge, Lane, Point, Points

LANE_CHANGE_LENGTH_M = 30.0
_JOIN_M = 0.01


class RouteSegment(NamedTuple):
    """A stretch of the path on one lane.

    Args:
        lane_id: Lane; on a lane change the one that is entered.
        edge_id: Its edge.
        is_internal: Inside a junction.
        is_lane_change: The path slides over from another lane of the edge within this stretch.
        from_lane_id: That other lane; the same lane without a lane change.
        start_m: Arc length along the path where the stretch starts.
        end_m: Arc length where it ends.
        lane_start_pos_m: Simulator position on the lane at `start_m`.
        lane_end_pos_m: Simulator position on the lane at `end_m`.
        signal_id: Traffic light at the end of the stretch that controls the path.
        signal_index: Place in that light's state string, -1 without a light.
    """

    lane_id: str
    edge_id: str
    is_internal: bool
    is_lane_change: bool
    from_lane_id: str
    start_m: float
    end_m: float
    lane_start_pos_m: float
    lane_end_pos_m: float
    signal_id: str | None
    signal_index: int


@dataclass(frozen=True, kw_only=True)
class RoutePath:
    """A route as one line.

    Args:
        edge_ids: Edges of the route.
        polyline: Line from the start of the first lane to the end of the last one.
        line: The same, measured.
        segments: Stretches in order, without gaps.
    """

    edge_ids: tuple[str, ...]
    polyline: Points
    line: Polyline = field(compare=False, repr=False)
    segments: tuple[RouteSegment, ...]

    @property
    def length_m(self) -> float:
        """Length of the line, metres."""
        return self.line.length_m

    @property
    def has_lane_change(self) -> bool:
        """Whether the route cannot be driven without changing lanes."""
        return bool(self.lane_changes)

    def position_at(self, arc_m: float) -> tuple[float, float, float, float]:
        """Return x, y (m) and the unit heading at an arc length.

        Raises:
            MapError: When the arc length is not on the path.
        """
        self._check(arc_m)
        return self.line.at(arc_m)

    def body_at(self, arc_m: float, length_m: float) -> tuple[float, float, float, float]:
        """Return centre (m) and unit heading of a body with its ends on the path.

        Where the path does not reach as far as that it stands along the path.

        Args:
            arc_m: Arc length in the middle between its ends.
            length_m: Of the body, metres.

        Raises:
            MapError: When the arc length is not on the path.
        """
        front_m, back_m = arc_m + 0.5 * length_m, arc_m - 0.5 * length_m
        if back_m < 0.0 or front_m > self.length_m:
            return self.position_at(arc_m)
        front, back = self.line.at(front_m)[:2], self.line.at(back_m)[:2]
        return chord_pose(front, back, length_m)

    def positions_at(self, arcs_m: FloatArray) -> FloatArray:
        """Return x, y (m) and the unit heading at arc lengths (K,), one row (K, 4) each.

        Raises:
            MapError: When one of them is not on the path.
        """
        for arc_m in (arcs_m.min(), arcs_m.max()):
            self._check(float(arc_m))
        return self.line.at_each(arcs_m)

    def headings_at(self, arcs_m: Sequence[float]) -> list[tuple[float, float]]:
        """Return the unit headings at ascending arc lengths, one or more.

        Raises:
            MapError: When one of them is not on the path.
        """
        for arc_m in (arcs_m[0], arcs_m[-1]):
            self._check(arc_m)
        return self.line.tangents_at(arcs_m)

    def lane_position_at(self, arc_m: float) -> tuple[str, float]:
        """Return lane id and simulator position (m) on that lane at an arc length.

        Raises:
            MapError: When the arc length is not on the path.
        """
        self._check(arc_m)
        segment = self.segments[self._segment_index(arc_m)]
        share = (arc_m - segment.start_m) / (segment.end_m - segment.start_m)
        span = segment.lane_end_pos_m - segment.lane_start_pos_m
        return segment.lane_id, segment.lane_start_pos_m + share * span

    def arc_of(self, lane_id: str, pos_m: float) -> float:
        """Return the first arc length at which the path is at a position of a lane.

        Args:
            lane_id: Lane of the path.
            pos_m: Simulator position on it, metres.

        Raises:
            MapError: When the path does not pass there.
        """
        for segment in self.segments:
            low, high = segment.lane_start_pos_m, segment.lane_end_pos_m
            if segment.lane_id == lane_id and low <= pos_m <= high:
                share = (pos_m - low) / (high - low)
                return segment.start_m + share * (segment.end_m - segment.start_m)
        raise MapError(
            f'position {pos_m} m on lane {lane_id} is not on the route of '
            f'{len(self.edge_ids)} edges that starts with {self.edge_ids[0]}',
            hint='choose a lane and position on the route',
        )

    @cached_property
    def signals(self) -> tuple[tuple[float, str, int], ...]:
        """(Arc length of the stop line, signal id, place in its state) in order."""
        return tuple(
            (s.end_m, s.signal_id, s.signal_index)
            for s in self.segments
            if s.signal_id is not None
        )

    @cached_property
    def lane_changes(self) -> tuple[RouteSegment, ...]:
        """The stretches on which the vehicle has to change lanes, in order.

        Without any the line is exactly what the simulator drives. With some, the simulator
        chooses the place of each change itself unless it is commanded at `start_m`.
        """
        return tuple(segment for segment in self.segments if segment.is_lane_change)

    def _segment_index(self, arc_m: float) -> int:
        at = bisect.bisect_right(self.segments, arc_m, key=attrgetter('start_m'))
        return max(at - 1, 0)

    def _check(self, arc_m: float) -> None:
        if not 0.0 <= arc_m <= self.length_m:
            raise MapError(
                f'{arc_m} m is not on the route of {self.length_m:.2f} m that starts with '
                f'{self.edge_ids[0]}',
                hint='stay between 0 and the length of the route',
            )


# Lane, from which lane it slides, arc lengths, positions on the lane, signal with its index.
_Stretch = tuple[
    Lane, str | None, tuple[float, float], tuple[float, float], tuple[str | None, int]
]
_NO_SIGNAL: tuple[str | None, int] = (None, -1)


class _PathBuilder:
    """Collects points and stretches."""

    def __init__(self) -> None:
        self.points: list[Point] = []
        self._stretches: list[_Stretch] = []
        self._length_m = 0.0

    @property
    def segments(self) -> tuple[RouteSegment, ...]:
        """The stretches in order."""
        return tuple(
            RouteSegment(
                lane.id,
                lane.edge_id,
                lane.is_internal,
                slides_from is not None,
                lane.id if slides_from is None else slides_from,
                *arcs_m,
                *positions_m,
                *signal,
            )
            for lane, slides_from, arcs_m, positions_m, signal in self._stretches
        )

    def add(
        self,
        lane: Lane,
        points: Points,
        pos_m: tuple[float, float],
        *,
        slides_from: str | None = None,
    ) -> None:
        """Append a stretch; its first point joins the last one when they (nearly) coincide."""
        self._append(lane, points, _length_m(points), pos_m, slides_from)

    def add_lane(self, lane: Lane) -> None:
        """Append a whole lane."""
        # Its line is measured already, by the same sum.
        self._append(lane, lane.polyline, lane.arc_length_m, (0.0, lane.length_m), None)

    def _append(
        self,
        lane: Lane,
        points: Points,
        length_m: float,
        pos_m: tuple[float, float],
        slides_from: str | None,
    ) -> None:
        if length_m <= _JOIN_M:
            return
        if not self.points:
            self.points.extend(points)
        elif self.points[-1] == points[0]:
            self.points.extend(points[1:])
        else:
            gap_m = _length_m((self.points[-1], points[0]))
            joined = [self.points[-1], *(points[1:] if gap_m <= _JOIN_M else points)]
            self.points.extend(joined[1:])
            length_m = _length_m(tuple(joined))
        start_m = self._length_m
        self._length_m += length_m
        arcs_m = (start_m, self._length_m)
        self._stretches.append((lane, slides_from, arcs_m, pos_m, _NO_SIGNAL))

    def end_with_signal(self, link: Connection) -> None:
        """Note the light that controls the end of the last stretch."""
        signal = (link.signal_id, link.signal_index)
        self._stretches[-1] = (*self._stretches[-1][:-1], signal)


def build_path(
    edges: tuple[Edge, ...], lanes: Mapping[str, Lane], plan: LanePlan, start_pos_m: float
) -> RoutePath:
    """Join the lanes of a plan into one line.

    A needed lane change is drawn as a slide over `LANE_CHANGE_LENGTH_M` (less on a short edge),
    as soon as the edge is entered, or from `start_pos_m` on the first edge: that is where a
    vehicle on a free road makes it.
    """
    builder = _PathBuilder()
    for k in range(len(edges)):
        entry, exit_ = lanes[plan.entry[k]], lanes[plan.exit[k]]
        if entry.id == exit_.id:
            builder.add_lane(entry)
        else:
            _add_change(builder, entry, exit_, start_pos_m if k == 0 else 0.0)
        if k < len(plan.links):
            link = plan.links[k]
            if link.signal_id is not None:
                builder.end_with_signal(link)
            for via_id in link.via_lane_ids:
                builder.add_lane(lanes[via_id])
    polyline = tuple(builder.points)
    return RoutePath(
        edge_ids=tuple(edge.id for edge in edges),
        polyline=polyline,
        line=Polyline(polyline),
        segments=builder.segments,
    )


def _add_change(builder: _PathBuilder, entry: Lane, exit_: Lane, start_pos_m: float) -> None:
    length_m = entry.length_m
    first = min(max(start_pos_m, 0.0), length_m)
    wanted = LANE_CHANGE_LENGTH_M * abs(entry.index - exit_.index)
    last = min(first + wanted, first + 0.8 * (length_m - first))
    if first > 0.0:
        builder.add(entry, lane_part(entry, 0.0, first), (0.0, first))
    slide = (lane_point(entry, first), lane_point(exit_, last))
    builder.add(exit_, slide, (first, last), slides_from=entry.id)
    builder.add(exit_, lane_part(exit_, last, length_m), (last, length_m))


def lane_point(lane: Lane, pos_m: float) -> Point:
    """Return the point (m) at a simulator position of a lane."""
    x, y, _, _ = lane.line.at(arc_at(lane, pos_m))
    return x, y


def arc_at(lane: Lane, pos_m: float) -> float:
    """Turn a simulator position on a lane into an arc length of its centre line, metres."""
    return pos_m / lane.length_m * lane.arc_length_m


def lane_part(lane: Lane, from_pos_m: float, to_pos_m: float) -> Points:
    """Return the centre line between two simulator positions of a lane."""
    low, high = arc_at(lane, from_pos_m), arc_at(lane, to_pos_m)
    inner = [
        p
        for p, arc_m in zip(lane.polyline, lane.line.cumulative_m.tolist(), strict=True)
        if low < arc_m < high
    ]
    return (lane_point(lane, from_pos_m), *inner, lane_point(lane, to_pos_m))


def _length_m(points: Points) -> float:
    total = 0.0
    for (ax, ay), (bx, by) in pairwise(points):
        total += math.sqrt((bx - ax) * (bx - ax) + (by - ay) * (by - ay))
    return total
