# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places on the sidewalks of a map: where somebody stands, and the walk that begins there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

from aurora_core.geometry.kernel import norm2
from aurora_core.grounding.distances import DEFAULT_GAP_M
from aurora_core.grounding.sites import SeatedAgent, SeatedPerson
from aurora_core.grounding.walk_ends import KERB_M, NEXT_M, WALKS_M
from aurora_core.knowledge.limits import Tolerances
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.knowledge.walk_path import WalkPath, walk_along
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.parking import stands
from aurora_core.spec.vocabulary import Relation

# Steps in which a spot at a stated distance is looked for (m).
_STEP_M = 0.5
# Who stands behind a vehicle is so far from its bumper (m).
_STANDS_BEHIND_M = 2.0
# Of a place, the sidewalk is at most so far away (m).
_BESIDE_PLACE_M = 50.0
# Who comes to a place from elsewhere has so much of a sidewalk before it, at least (m).
COMES_M = 13.0


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


def walked_up_to(network: RoadNetwork, point: tuple[float, float], within_m: float) -> Spot | None:
    """Return the place on a sidewalk to which one walks, nearest to a point and no farther off.

    None where no sidewalk has a way before it that is worth the name.
    """
    best: tuple[float, Spot] | None = None
    for lane in network.sidewalks:
        arc_m, _ = lane.line.project(*point)
        arc_m = min(arc_m, lane.arc_length_m - KERB_M)
        if arc_m < COMES_M:
            continue
        x, y, _, _ = lane.line.at(arc_m)
        away_m = norm2(x - point[0], y - point[1])
        if away_m > within_m or (best is not None and away_m >= best[0]):
            continue
        path = walk_along(network, (lane.edge_id,))
        if path is not None and path.lane_id == lane.id:
            best = away_m, Spot(path, arc_m)
    return None if best is None else best[1]


def beyond_m(spot: Spot, place: tuple[float, float], arrival_m: float) -> float:
    """Return how far beyond a spot one is still at the place that it is next to (m)."""
    x, y, _, _ = spot.path.position_at(spot.arc_m)
    return max(0.0, arrival_m - norm2(place[0] - x, place[1] - y) - 1.0)


def abreast_of(
    network: RoadNetwork, seat: SeatedPerson, relation: Relation, abreast_m: float
) -> Spot:
    """Return the spot beside a person, in the same walk."""
    side_m = abreast_m if relation is not Relation.RIGHT else -abreast_m
    width_m = network.lane(seat.path.lane_id).width_m
    lateral_m = seat.lateral_m + side_m
    free = relation not in (Relation.LEFT, Relation.RIGHT)
    if free and abs(lateral_m) > 0.5 * width_m - KERB_M:
        lateral_m = seat.lateral_m - side_m
    return Spot(seat.path, seat.arc_m, lateral_m)


def off_it_m(seat: SeatedAgent | SeatedPerson, length_m: float, free: Parameter | None) -> float:
    """Return how far from another agent somebody is of whom nobody says it (m).

    Who stands behind a vehicle that stands is right behind it.

    Args:
        seat: Of the other one.
        length_m: Its length.
        free: What stands for it where nothing is known better.
    """
    parked = any(p.relation is Relation.PARKED_AT for p in seat.agent.placements)
    if stands(seat.agent) or parked:
        return length_m / 2.0 + _STANDS_BEHIND_M
    return DEFAULT_GAP_M if free is None else free.value
