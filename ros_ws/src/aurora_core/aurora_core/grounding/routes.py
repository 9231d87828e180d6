# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes over the network: straight on where possible, or wandering, never into a dead end."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from aurora_core.knowledge.road_network import RoadNetwork

_ORDER = {'s': 0, 'R': 1, 'L': 2, 'r': 3, 'l': 4, 't': 9}


class RouteFinder:
    """Extends routes over the edges that one vehicle class may use.

    Args:
        network: Road network.
        vclass: SUMO vehicle class.
    """

    def __init__(self, network: RoadNetwork, vclass: str) -> None:
        self._network = network
        self._vclass = vclass
        self._endless = self._edges_on_cycles()
        self._following = lru_cache(maxsize=None)(self._ordered_successors)

    def straight_route(self, start_edge: str, length_m: float) -> tuple[str, ...]:
        """Return a route of at least `length_m`, going straight on where possible.

        Empty when the road from `start_edge` ends before.
        """
        return self._extend(start_edge, length_m, lambda options: options[0])

    def wandering_route(
        self, start_edge: str, length_m: float, generator: np.random.Generator
    ) -> tuple[str, ...]:
        """Return a route of at least `length_m` that turns at random."""
        return self._extend(
            start_edge, length_m, lambda options: options[int(generator.integers(len(options)))]
        )

    def endless(self, edge_id: str) -> bool:
        """Whether one can drive on from this edge for ever."""
        return edge_id in self._endless

    def _extend(self, start_edge: str, length_m: float, choose: object) -> tuple[str, ...]:
        if start_edge not in self._endless:
            return ()
        route = [start_edge]
        length = self._network.edge(start_edge).length_m
        while length < length_m:
            options = self._following(route[-1])
            assert callable(choose)
            route.append(choose(options))
            length += self._network.edge(route[-1]).length_m
        return tuple(route)

    def _ordered_successors(self, edge_id: str) -> tuple[str, ...]:
        direction: dict[str, int] = {}
        for lane_id in self._network.edge(edge_id).lane_ids:
            for link in self._network.connections_from(lane_id):
                target = self._network.lane(link.to_lane_id).edge_id
                rank = _ORDER.get(link.direction, 8)
                direction[target] = min(rank, direction.get(target, rank))
        options = [
            e for e in self._network.successors(edge_id, self._vclass) if e in self._endless
        ]
        # Turning round is for dead ends only.
        onward = [e for e in options if direction.get(e, 8) < _ORDER['t']]
        return tuple(sorted(onward or options, key=lambda e: (direction.get(e, 8), e)))

    def _edges_on_cycles(self) -> frozenset[str]:
        """Edges from which one can go on for ever: remove edges without a way on, repeatedly."""
        edges = {lane.edge_id for lane in self._network.driving_lanes(self._vclass)}
        ways = {e: set(self._network.successors(e, self._vclass)) for e in edges}
        shrinking = True
        while shrinking:
            dead = {e for e in edges if not ways[e] & edges}
            shrinking = bool(dead)
            edges -= dead
        return frozenset(edges)
