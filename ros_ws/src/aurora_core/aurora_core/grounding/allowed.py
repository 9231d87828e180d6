# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where a scene that is realised again may be put."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.grounding.sites import Site
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.outcomes.repair import Anchor, RepairPlan

# Nearer than this on the same lane it is the same place (m).
_SAME_PLACE_M = 60.0

Ranked = tuple[float, Site]


def allowed_sites(
    ranked: Iterable[Ranked], plan: RepairPlan, network: RoadNetwork
) -> list[Ranked]:
    """Return the sites at which a plan lets the scene be, in their order.

    Args:
        ranked: Sites with the score of their road.
        plan: Where the scene may not be, or has to stay: then at the nearest site to that place.
        network: Of the map.
    """
    roads = frozenset(network.lane(a.lane).edge_id for a in plan.avoided if a.whole_road)
    found = [(row, _anchor(row[1])) for row in ranked]
    found = [
        (row, here)
        for row, here in found
        if network.lane(here.lane).edge_id not in roads
        and not any(_apart_m(here, away) < _SAME_PLACE_M for away in plan.avoided)
    ]
    kept = plan.kept
    if kept is not None:
        near = [(row, here) for row, here in found if _apart_m(here, kept) < _SAME_PLACE_M]
        found = sorted(near, key=lambda pair: _apart_m(pair[1], kept))[:1]
    return [row for row, _ in found]


def _anchor(site: Site) -> Anchor:
    lane, position_m = site.origin_path.lane_position_at(site.origin_arc_m)
    return Anchor(lane=lane, position_m=position_m)


def _apart_m(here: Anchor, there: Anchor) -> float:
    """Return how far apart two places of one lane are, infinity on different lanes."""
    if here.lane != there.lane:
        return float('inf')
    return abs(here.position_m - there.position_m)
