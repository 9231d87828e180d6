# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who steps out beside a parked vehicle crosses right there, wherever the vehicle stands.

The way is straight over the street to the sidewalk on the other side. So it is for everybody who
names no crosswalk, where none is in place.
"""

from __future__ import annotations

from aurora_core.geometry.kernel import norm2
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.net_types import Lane, Point
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.walk_path import WalkPath
from aurora_core.spec.parking import parks
from aurora_core.spec.scenario import GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import Place

# From the middle of one sidewalk to that of the other, streets that are crossed so (m).
_WIDTHS_M = (4.0, 40.0)
# The sidewalks on both sides run alike (cosine), and nobody crosses so near their ends (m).
_ALIKE = 0.95
_FROM_END_M = 3.0


def steps_out(spec: ScenarioSpec, agent: GroundAgent) -> bool:
    """Tell whether somebody who crosses is placed by a parked vehicle, and at no crosswalk."""
    parked = {a.id for a in spec.agents if a.id != agent.id and parks(spec, a)}
    return not names_crosswalk(agent) and any(p.of in parked for p in agent.placements)


def names_crosswalk(agent: GroundAgent) -> bool:
    """Tell whether it is said of somebody that it is at, or goes over, the crosswalk."""
    named = {b.target for b in agent.behaviors} | {p.of for p in agent.placements}
    return Place.CROSSWALK in named


class FarKerb:
    """Finds the other side of streets on one map.

    Args:
        network: Road network.
    """

    def __init__(self, network: RoadNetwork) -> None:
        self._network = network
        self._near: dict[str, tuple[Lane, ...]] = {}

    def way(self, path: WalkPath, arc_m: float) -> WalkPath | None:
        """Return the way over the street from a place on a sidewalk, None where there is none.

        Args:
            path: Begins on the sidewalk.
            arc_m: The place, on its first sidewalk.
        """
        lane = self._network.lane(path.lane_id)
        if not _FROM_END_M <= arc_m <= lane.arc_length_m - _FROM_END_M:
            return None
        x, y, hx, hy = path.position_at(arc_m)
        across = -hy, hx  # sidewalks are right of their street
        hits = [
            (hit_m, far)
            for far in self._beyond(lane)
            if (hit_m := _hit_m(far, (x, y), across, (hx, hy))) is not None
        ]
        if not hits:
            return None
        way_m, far = min(hits, key=lambda hit: (hit[0], hit[1].id))
        points = ((x, y), (x + way_m * across[0], y + way_m * across[1]))
        return WalkPath(
            edge_ids=(lane.edge_id,),
            lane_id=lane.id,
            goal_lane_id=far.id,
            polyline=points,
            line=Polyline(points),
            begins_m=arc_m,
        )

    def _beyond(self, lane: Lane) -> tuple[Lane, ...]:
        """Return the sidewalks of other edges that are near one."""
        if lane.id not in self._near:
            reach_m = _WIDTHS_M[1]
            low, high = _box(lane)
            self._near[lane.id] = tuple(
                other
                for other in self._network.sidewalks
                if other.edge_id != lane.edge_id
                and all(
                    a <= d + reach_m and c <= b + reach_m
                    for a, b, c, d in zip(low, high, *_box(other), strict=True)
                )
            )
        return self._near[lane.id]


def _box(lane: Lane) -> tuple[Point, Point]:
    xs, ys = zip(*lane.polyline, strict=True)
    return (min(xs), min(ys)), (max(xs), max(ys))


def _hit_m(far: Lane, start: Point, across: Point, along: Point) -> float | None:
    """Return how far across a sidewalk is met that runs like the one at the start, else None."""
    arc_m = 0.0
    for (ax, ay), (bx, by) in zip(far.polyline[:-1], far.polyline[1:], strict=True):
        piece_m = norm2(bx - ax, by - ay)
        # Along the street, both ends as seen from the start.
        first = (ax - start[0]) * along[0] + (ay - start[1]) * along[1]
        last = (bx - start[0]) * along[0] + (by - start[1]) * along[1]
        if piece_m > 0.0 and min(first, last) <= 0.0 <= max(first, last) and first != last:
            share = first / (first - last)
            here_m = arc_m + share * piece_m
            x, y = ax + share * (bx - ax), ay + share * (by - ay)
            way_m = (x - start[0]) * across[0] + (y - start[1]) * across[1]
            inside = _FROM_END_M <= here_m <= far.arc_length_m - _FROM_END_M
            alike = abs(last - first) >= _ALIKE * piece_m
            if inside and alike and _WIDTHS_M[0] <= way_m <= _WIDTHS_M[1]:
                return way_m
        arc_m += piece_m
    return None
