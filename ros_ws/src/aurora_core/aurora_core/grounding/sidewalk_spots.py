# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places on the sidewalks of a map: where somebody stands, and the walk that begins there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.walk_ends import KERB_M, NEXT_M, WALKS_M
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.walk_path import WalkPath, walk_along
from aurora_core.spec.parameter import Bound, Parameter

# Steps in which a spot at a stated distance is looked for (m).
_STEP_M = 0.5
# Of a place, the sidewalk is at most so far away (m).
_BESIDE_PLACE_M = 50.0


@dataclass(frozen=True, slots=True)
class Spot:
    """A walk, where it begins (m along it, and left of its middle), and where somebody rests."""

    path: WalkPath
    arc_m: float
    lateral_m: float = 0.0
    rest_m: float | None = None


def off_m(stated: Parameter, tolerances: Tolerances) -> float:
    """Return how far off a stated distance somebody may stand who is near another one (m)."""
    if stated.bound is not Bound.EXACTLY:
        return inf
    return tolerances.placement_other_m.of(stated.value, approximate=stated.approximate)


def walks_to(network: RoadNetwork, spot: Spot, beyond_m: float = 0.0) -> Spot:
    """Return the spot from which somebody walks to another one and rests there.

    It is as far before that as shows that he walks, or at the beginning of the sidewalk; where
    that is too near he rests up to `beyond_m` farther on (m).
    """
    end_m = max(spot.arc_m, network.lane(spot.path.lane_id).arc_length_m - KERB_M)
    rest_m = min(max(spot.arc_m, KERB_M + WALKS_M), spot.arc_m + beyond_m, end_m)
    return replace(spot, arc_m=max(min(KERB_M, rest_m), rest_m - WALKS_M), rest_m=rest_m)


def at_distance(
    network: RoadNetwork, point: tuple[float, float], away_m: float, number: int
) -> Spot | None:
    """Return the place on a sidewalk that is so far from a point, the next one beside it."""
    best: tuple[float, Spot] | None = None
    for lane in network.sidewalks:
        x0, y0 = lane.polyline[0]
        if norm2(x0 - point[0], y0 - point[1]) > away_m + lane.arc_length_m + 1.0:
            continue
        path = walk_along(network, (lane.edge_id,))
        if path is None or path.lane_id != lane.id:
            continue
        count = int(max(0.0, lane.arc_length_m - 2.0 * KERB_M) / _STEP_M) + 1
        for k in range(count):
            arc_m = KERB_M + k * _STEP_M
            here = lane.line.at(arc_m)
            off_m = abs(norm2(here[0] - point[0], here[1] - point[1]) - away_m)
            if best is None or off_m < best[0] - 1e-6:
                best = off_m, Spot(path, arc_m)
    if best is None or best[0] > _STEP_M:
        return None
    spot = best[1]
    lane = network.lane(spot.path.lane_id)
    most_m = lane.arc_length_m - KERB_M
    return Spot(spot.path, min(most_m, spot.arc_m + NEXT_M * number))


def nearest_spot(network: RoadNetwork, point: tuple[float, float], number: int) -> Spot | None:
    """Return the place on a sidewalk that is nearest to a point."""
    lane_id, _, away_m = network.nearest_lane(*point, 'pedestrian')
    lane = network.lane(lane_id)
    path = walk_along(network, (lane.edge_id,))
    if path is None or away_m > _BESIDE_PLACE_M:
        return None
    arc_m, _ = lane.line.project(*point)
    low, high = KERB_M, max(KERB_M, lane.arc_length_m - KERB_M)
    return Spot(path, min(high, max(low, arc_m + NEXT_M * number)))
