# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes over the network: straight on where possible, or wandering, never into a dead end.

Extracts of real cities are full of streets that end at their border: nobody turns round there who
can turn off before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence, Set
from functools import lru_cache
from heapq import heappop, heappush
from operator import itemgetter

import numpy as np

from aurora_core.geometry.kernel import norm2
from aurora_core.knowledge.road_network import RoadNetwork

# Finders that are kept: of the classes and speeds that are asked for on the maps in use.
_FINDERS = 32

# Cosine of 75 degrees: a turn that is asked for has at least 60, and lanes are not exact.
_SHARP_COSINE = 0.26

# Nobody comes back to a street sooner who can turn off before (m): no roundabout is that long.
_ROUND_M = 300.0

_ORDER = {'s': 0, 'R': 1, 'L': 2, 'r': 3, 'l': 4, 't': 9}


class RouteFinder:
    """Extends routes over the edges that one vehicle class may use.

    Args:
        network: Road network.
        vclass: SUMO vehicle class.
        least_limit_mps: Streets with this speed limit are preferred.
    """

    def __init__(self, network: RoadNetwork, vclass: str, least_limit_mps: float = 0.0) -> None:
        self._network = network
        self._vclass = vclass
        self._least_limit_mps = least_limit_mps
        edges = {lane.edge_id for lane in network.driving_lanes(vclass)}
        self._endless = _on_cycles({e: set(network.successors(e, vclass)) for e in edges})
        self._lengths_m = {edge_id: network.edge(edge_id).length_m for edge_id in self._endless}
        self._is_slow = lru_cache(maxsize=None)(self._lies_below_limit)
        self._following = lru_cache(maxsize=None)(self._ordered_successors)
        onward = {e: {f for f in self._following(e) if self._goes_on(e, f)} for e in self._endless}
        # On a single road one turns round at its ends.
        through = _on_cycles(onward)
        self._has_ends_only = not through
        self._through = through or self._endless
        self._liked = lru_cache(maxsize=None)(self._successors_through)

    def straight_route(self, start_edge: str, length_m: float) -> tuple[str, ...]:
        """Return a route of at least `length_m`, going straight on where possible.

        Empty when the road from `start_edge` ends before.
        """
        return self._extend(start_edge, length_m, itemgetter(0))

    def turning_route(self, start_edge: str, length_m: float, side: str) -> tuple[str, ...]:
        """Return a route that turns at the end of its first street, then goes straight on.

        Args:
            start_edge: First edge.
            length_m: Least length.
            side: `l` or `r`.

        Returns:
            Empty where there is no such turn.
        """
        if start_edge not in self._endless:
            return ()
        for edge in self._following(start_edge):
            turns = self._directions(start_edge).get(edge) == _ORDER[side]
            if turns and self._is_sharp(start_edge, edge):
                onward = self.straight_route(edge, length_m)
                return (start_edge, *onward) if onward else ()
        return ()

    def _is_sharp(self, edge_id: str, following: str) -> bool:
        """Tell whether one edge turns off from another so that nobody takes it for a bend."""
        before = self._network.lane(self._network.edge(edge_id).lane_ids[-1]).polyline
        after = self._network.lane(self._network.edge(following).lane_ids[-1]).polyline
        (ax, ay), (bx, by), (cx, cy), (dx, dy) = before[-2], before[-1], after[0], after[1]
        cosine = (bx - ax) * (dx - cx) + (by - ay) * (dy - cy)
        return cosine <= _SHARP_COSINE * norm2(bx - ax, by - ay) * norm2(dx - cx, dy - cy)

    def leading_route(
        self, start_edge: str, length_m: float, goals: Sequence[frozenset[str]], way_m: float
    ) -> tuple[str, ...]:
        """Return a route of at least `length_m` that comes through places, then goes straight on.

        Args:
            start_edge: First edge.
            length_m: Least length.
            goals: Edges of each place, in the order in which one comes there.
            way_m: Longest way from one to the next.

        Returns:
            Empty where no way is that short.
        """
        if start_edge not in self._endless:
            return ()
        route: tuple[str, ...] = (start_edge,)
        for goal in goals:
            way = self._shortest_way(route[-1], goal, way_m)
            if not way:
                return ()
            route += way[1:]
        onward = self.straight_route(route[-1], length_m)
        return (*route, *onward[1:]) if onward else ()

    def _shortest_way(self, start: str, goal: frozenset[str], way_m: float) -> tuple[str, ...]:
        """Return the shortest way from an edge to one of several, both included."""
        queue: list[tuple[float, tuple[str, ...]]] = [(0.0, (start,))]
        done: set[str] = set()
        while queue:
            length_m, way = heappop(queue)
            if way[-1] in goal:
                return way
            if way[-1] in done or length_m > way_m:
                continue
            done.add(way[-1])
            for edge in self._following(way[-1]):
                heappush(queue, (length_m + self._lengths_m[edge], (*way, edge)))
        return ()

    def wandering_route(
        self,
        start_edge: str,
        length_m: float,
        generator: np.random.Generator,
        inside: Callable[[str], bool] = lambda _: True,
    ) -> tuple[str, ...]:
        """Return a route of at least `length_m` that turns at random.

        Args:
            start_edge: First edge.
            length_m: Least length.
            generator: Of the turns.
            inside: Tells which edges it keeps to wherever it can.
        """

        def choose(options: Sequence[str]) -> str:
            options = [edge for edge in options if inside(edge)] or options
            liked = [edge for edge in options if not self._is_slow(edge)] or options
            return liked[int(generator.integers(len(liked)))]

        return self._extend(start_edge, length_m, choose)

    def circulating_route(
        self,
        start_lane: str,
        length_m: float,
        generator: np.random.Generator,
        liked: Callable[[str], bool],
    ) -> tuple[str, ...]:
        """Return a route that turns at random and never asks for a change of lane.

        Args:
            start_lane: First lane.
            length_m: Least length.
            generator: Of the turns.
            liked: Tells onto which edges it turns wherever it can.

        Returns:
            Empty where the lanes lead nowhere.
        """
        lane = start_lane
        route = [self._network.lane(lane).edge_id]
        length = self._network.edge(route[0]).length_m
        while length < length_m:
            onward = self._lanes_behind(lane)
            if not onward:
                return ()
            options = [i for i in onward if liked(self._network.lane(i).edge_id)] or onward
            lane = options[int(generator.integers(len(options)))]
            route.append(self._network.lane(lane).edge_id)
            length += self._network.edge(route[-1]).length_m
        return tuple(route)

    def _lanes_behind(self, lane_id: str) -> list[str]:
        """Return the lanes onto which a lane leads, round the end of a road only where all end."""
        onward: set[str] = set()
        round_it: set[str] = set()
        for link in self._network.connections_from(lane_id):
            if self._network.lane(link.to_lane_id).edge_id in self._through:
                (round_it if link.direction == 't' else onward).add(link.to_lane_id)
        return sorted(onward or (round_it if self._has_ends_only else ()))

    def endless(self, edge_id: str) -> bool:
        """Whether one can drive on from this edge for ever."""
        return edge_id in self._endless

    def goes_through(self, edge_id: str) -> bool:
        """Whether one can drive on from this edge for ever and never has to turn round.

        On a map without any such edge it is where one can drive on for ever at all.
        """
        return edge_id in self._through

    def _goes_on(self, edge_id: str, following: str) -> bool:
        """Tell whether one comes from one edge onto the other without turning round."""
        return self._directions(edge_id).get(following, 8) < _ORDER['t']

    def _successors_through(self, edge_id: str) -> tuple[str, ...]:
        """Return onto which edges one goes who wants to go on: not towards an end of the road."""
        following = self._following(edge_id)
        return tuple(e for e in following if e in self._through) or following

    def _lies_below_limit(self, edge_id: str) -> bool:
        """Whether no lane of an edge has the speed limit that is preferred."""
        lanes = (self._network.lane(name) for name in self._network.edge(edge_id).lane_ids)
        return all(
            lane.speed_limit_mps < self._least_limit_mps
            for lane in lanes
            if self._vclass in lane.allows
        )

    def _extend(
        self, start_edge: str, length_m: float, choose: Callable[[Sequence[str]], str]
    ) -> tuple[str, ...]:
        if start_edge not in self._endless:
            return ()
        route = [start_edge]
        edge, lengths_m = start_edge, self._lengths_m
        length = lengths_m[edge]
        begins_m = {edge: 0.0}
        while length < length_m:
            options = self._liked(edge)
            # Straight on in a roundabout is round and round.
            new = [e for e in options if length - begins_m.get(e, -_ROUND_M) >= _ROUND_M]
            edge = choose(new or options)
            route.append(edge)
            begins_m[edge] = length
            length += lengths_m[edge]
        return tuple(route)

    def _directions(self, edge_id: str) -> dict[str, int]:
        """Return how one turns into each edge behind an edge, as ranks in `_ORDER`."""
        direction: dict[str, int] = {}
        for lane_id in self._network.edge(edge_id).lane_ids:
            for link in self._network.connections_from(lane_id):
                target = self._network.lane(link.to_lane_id).edge_id
                rank = _ORDER.get(link.direction, 8)
                direction[target] = min(rank, direction.get(target, rank))
        return direction

    def _ordered_successors(self, edge_id: str) -> tuple[str, ...]:
        direction = self._directions(edge_id)
        options = [
            e for e in self._network.successors(edge_id, self._vclass) if e in self._endless
        ]
        # Turning round is for dead ends only.
        onward = [e for e in options if direction.get(e, 8) < _ORDER['t']]
        return tuple(
            sorted(onward or options, key=lambda e: (self._is_slow(e), direction.get(e, 8), e))
        )


def _on_cycles(ways: Mapping[str, Set[str]]) -> frozenset[str]:
    """Edges from which one can go on for ever: remove edges without a way on, repeatedly."""
    edges = set(ways)
    shrinking = True
    while shrinking:
        dead = {e for e in edges if not ways[e] & edges}
        shrinking = bool(dead)
        edges -= dead
    return frozenset(edges)


@lru_cache(maxsize=_FINDERS)
def route_finder(network: RoadNetwork, vclass: str, least_limit_mps: float = 0.0) -> RouteFinder:
    """Return the finder of a network, class and speed limit: the same one each time."""
    return RouteFinder(network, vclass, least_limit_mps)
