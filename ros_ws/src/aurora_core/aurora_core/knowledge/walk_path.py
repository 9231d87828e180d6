# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The line that a person walks: along sidewalks, and over a crossing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

from aurora_core.geometry.arrays import FloatArray
from aurora_core.geometry.kernel import norm2
from aurora_core.geometry.polyline import Polyline
from aurora_core.knowledge.net_types import Crossing, Lane, Point, Points
from aurora_core.knowledge.road_network import RoadNetwork

_SAME_POINT_M = 0.01
# Nobody stands on a shorter sidewalk: netconvert leaves stubs of it between junctions (m).
_STUB_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WalkPath:
    """A walk as one line, from the start of its first sidewalk.

    Attributes:
        edge_ids: Edges whose sidewalks it takes, in order.
        lane_id: The first sidewalk.
        goal_lane_id: The last one.
        polyline: Points in ENU map metres.
        line: The same, measured.
        crossing_id: The crossing between the first and the second edge, if there is one.
        begins_m: Of a way over the street away from crossings: where on the first sidewalk it
            begins. None of walks along sidewalks, which begin at the start of theirs.
    """

    edge_ids: tuple[str, ...]
    lane_id: str
    goal_lane_id: str
    polyline: Points
    line: Polyline = field(compare=False, repr=False)
    crossing_id: str | None = None
    begins_m: float | None = None

    @property
    def length_m(self) -> float:
        """Length of the line, metres."""
        return self.line.length_m

    def position_at(self, arc_m: float) -> tuple[float, float, float, float]:
        """Return x, y (m) and the unit heading at an arc length (m)."""
        return self.line.at(arc_m)

    def positions_at(self, arcs_m: FloatArray) -> FloatArray:
        """Return x, y (m) and the unit heading at arc lengths (K,), one row (K, 4) each."""
        return self.line.at_each(arcs_m)


def sidewalk_of(network: RoadNetwork, edge_id: str) -> Lane | None:
    """Return the sidewalk of an edge, at its right kerb; None where it has none."""
    lanes = (network.lane(lane_id) for lane_id in network.edge(edge_id).lane_ids)
    return next((lane for lane in lanes if lane.allows == {'pedestrian'}), None)


def walk_along(
    network: RoadNetwork, edge_ids: Sequence[str], crossing: Crossing | None = None
) -> WalkPath | None:
    """Return the walk along the sidewalks of edges; None where one of them has none.

    Args:
        network: Road network.
        edge_ids: At least one edge; neighbours meet at a junction.
        crossing: Between the first and the second edge.
    """
    lanes = [sidewalk_of(network, edge_id) for edge_id in edge_ids]
    walks = [lane for lane in lanes if lane is not None]
    if len(walks) < len(lanes):
        return None
    points: list[Point] = list(walks[0].polyline)
    for k, lane in enumerate(walks[1:]):
        if k == 0 and crossing is not None:
            ends = crossing.centre_line
            near = min(ends[0], ends[-1], key=lambda p: _apart_m(p, points[-1]))
            points += ends if near == ends[0] else ends[::-1]
        points += lane.polyline
    kept = points[:1] + [b for a, b in pairwise(points) if _apart_m(a, b) > _SAME_POINT_M]
    return WalkPath(
        edge_ids=tuple(edge_ids),
        lane_id=walks[0].id,
        goal_lane_id=walks[-1].id,
        polyline=tuple(kept),
        line=Polyline(kept),
        crossing_id=None if crossing is None else crossing.id,
    )


def kerb_to_kerb(network: RoadNetwork, crossing: Crossing) -> WalkPath | None:
    """Return the walk over a crossing, from the sidewalk that ends there to the one beyond.

    None where the street has no sidewalk on one of its sides, or only a stub of one.
    """
    edges = [network.edge(edge_id) for edge_id in crossing.edge_ids]
    before = [e for e in edges if e.to_junction == crossing.junction_id]
    beyond = [e for e in edges if e.from_junction == crossing.junction_id]
    if not before or not beyond:
        return None
    found = walk_along(network, (before[0].id, beyond[0].id), crossing)
    ends = () if found is None else (found.lane_id, found.goal_lane_id)
    return found if all(network.lane(end).arc_length_m >= _STUB_M for end in ends) else None


def _apart_m(a: Point, b: Point) -> float:
    return norm2(a[0] - b[0], a[1] - b[1])
