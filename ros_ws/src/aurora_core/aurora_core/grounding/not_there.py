# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Leave out the sites of a scene that was tried there and did not come true."""

from __future__ import annotations

from collections.abc import Iterable

from aurora_core.grounding.sites import Site
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.outcomes.repair import AvoidedAnchor

# Nearer than this on the same lane it is the same place (m).
_SAME_PLACE_M = 60.0


class NotThere:
    """Tells whether a site is another one than those that are to be avoided.

    Args:
        network: Of the map.
        avoided: Where the scene was tried.
    """

    def __init__(self, network: RoadNetwork, avoided: Iterable[AvoidedAnchor]) -> None:
        self._avoided = tuple(avoided)
        self._roads = frozenset(
            network.lane(place.lane).edge_id for place in self._avoided if place.whole_road
        )
        self._network = network

    def __call__(self, site: Site) -> bool:
        """Tell whether the scene was not tried at a site."""
        if not self._avoided:
            return True
        lane_id, position_m = site.origin_path.lane_position_at(site.origin_arc_m)
        if self._network.lane(lane_id).edge_id in self._roads:
            return False
        return not any(
            place.lane == lane_id and abs(place.position_m - position_m) < _SAME_PLACE_M
            for place in self._avoided
        )
