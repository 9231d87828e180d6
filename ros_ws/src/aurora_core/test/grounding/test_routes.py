# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Routes are long enough, connected, and never lead into a dead end."""

from __future__ import annotations

from collections.abc import Callable
from itertools import groupby, pairwise
from math import atan2, degrees

import pytest

from aurora_core.grounding.routes import RouteFinder
from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.road_network import RoadNetwork
from aurora_core.ports.random_streams import stream

CASES = [('downtown', 'passenger'), ('downtown', 'bus'), ('junction', 'passenger')]


def _edges(network_map: MapModel, vclass: str) -> list[str]:
    return sorted({lane.edge_id for lane in network_map.network.driving_lanes(vclass)})


@pytest.mark.parametrize(('name', 'vclass'), CASES)
def test_straight_routes(name: str, vclass: str, map_of: Callable[[str], MapModel]) -> None:
    network = map_of(name).network
    finder = RouteFinder(network, vclass)
    started = 0
    for edge in _edges(map_of(name), vclass):
        route = finder.straight_route(edge, 3000.0)
        if not finder.endless(edge):
            assert route == ()
            continue
        started += 1
        assert route[0] == edge
        assert sum(network.edge(e).length_m for e in route) >= 3000.0
        assert all(finder.endless(e) for e in route)
        for a, b in pairwise(route):
            assert b in network.successors(a, vclass)
        assert network.successors(route[-1], vclass)
    assert started > 0


@pytest.mark.parametrize(('name', 'vclass'), CASES)
def test_wandering_routes(name: str, vclass: str, map_of: Callable[[str], MapModel]) -> None:
    network = map_of(name).network
    finder = RouteFinder(network, vclass)
    edge = next(e for e in _edges(map_of(name), vclass) if finder.endless(e))
    routes = {finder.wandering_route(edge, 2000.0, stream(seed, 'test')) for seed in range(10)}
    for route in routes:
        assert sum(network.edge(e).length_m for e in route) >= 2000.0
        assert all(b in network.successors(a, vclass) for a, b in pairwise(route))
        assert all(finder.endless(e) for e in route)
    again = finder.wandering_route(edge, 2000.0, stream(3, 'test'))
    assert again == finder.wandering_route(edge, 2000.0, stream(3, 'test'))
    if name == 'downtown':
        assert len(routes) > 5


@pytest.mark.parametrize(('name', 'vclass'), CASES)
def test_nobody_wanders_back_where_there_is_another_way(
    name: str, vclass: str, map_of: Callable[[str], MapModel]
) -> None:
    network = map_of(name).network
    finder = RouteFinder(network, vclass)
    for edge in [e for e in _edges(map_of(name), vclass) if finder.endless(e)][:20]:
        route = finder.wandering_route(edge, 1500.0, stream(1, edge))
        for a, b in pairwise(route):
            ways = _directions(network, a)
            others = [e for e, way in ways.items() if way != {'t'} and finder.endless(e)]
            assert ways[b] != {'t'} or not others, (a, b)


@pytest.mark.parametrize('name', ['downtown', 'helsinki'])
def test_who_can_turn_off_before_the_end_of_a_road_never_turns_round(
    name: str, map_of: Callable[[str], MapModel]
) -> None:
    """All streets of an extract that lead out of it end at its border."""
    network = map_of(name).network
    finder = RouteFinder(network, 'passenger')
    edges = [e for e in _edges(map_of(name), 'passenger') if finder.endless(e)]
    through = [e for e in edges if finder.goes_through(e)]
    assert 0 < len(edges) - len(through) < 0.1 * len(edges)
    for edge in through:
        for route in (
            finder.straight_route(edge, 2000.0),
            finder.wandering_route(edge, 2000.0, stream(1, edge)),
        ):
            for a, b in pairwise(route):
                assert _directions(network, a)[b] != {'t'}, (a, b)


def test_on_a_map_where_every_road_ends_one_turns_round(
    map_of: Callable[[str], MapModel],
) -> None:
    finder = RouteFinder(map_of('junction').network, 'passenger')
    for edge in _edges(map_of('junction'), 'passenger'):
        assert finder.goes_through(edge) == finder.endless(edge)


def _directions(network: RoadNetwork, edge: str) -> dict[str, set[str]]:
    """Return the directions of the links to each following edge."""
    found: dict[str, set[str]] = {}
    for lane_id in network.edge(edge).lane_ids:
        for link in network.connections_from(lane_id):
            found.setdefault(network.lane(link.to_lane_id).edge_id, set()).add(link.direction)
    return found


def test_straight_on_is_preferred_and_turning_round_is_the_last_resort(
    map_of: Callable[[str], MapModel],
) -> None:
    network = map_of('downtown').network
    finder = RouteFinder(network, 'passenger')
    for edge in _edges(map_of('downtown'), 'passenger')[:40]:
        if not finder.endless(edge):
            continue
        route = finder.straight_route(edge, 1000.0)
        for k, (a, b) in enumerate(pairwise(route)):
            onward = {
                link.direction
                for lane_id in network.edge(a).lane_ids
                for link in network.connections_from(lane_id)
                if finder.endless(network.lane(link.to_lane_id).edge_id)
            }
            taken = {
                link.direction
                for lane_id in network.edge(a).lane_ids
                for link in network.connections_from(lane_id)
                if network.lane(link.to_lane_id).edge_id == b
            }
            straight = {
                network.lane(link.to_lane_id).edge_id
                for lane_id in network.edge(a).lane_ids
                for link in network.connections_from(lane_id)
                if link.direction == 's'
            }
            # Nobody drives round and round in a roundabout.
            if 's' in onward and not straight & set(route[: k + 1]):
                assert 's' in taken, (a, b)
            if onward - {'t'}:
                assert taken != {'t'}, (a, b)


def test_nobody_drives_round_and_round_in_a_roundabout(
    map_of: Callable[[str], MapModel],
) -> None:
    network = map_of('downtown').network
    finder = RouteFinder(network, 'passenger')
    circle = {
        e for e in _edges(map_of('downtown'), 'passenger') if e.startswith('founders_circle')
    }
    assert len(circle) == 4
    into = [
        e
        for e in _edges(map_of('downtown'), 'passenger')
        if _directions(network, e).keys() & circle
    ]
    for edge in (e for e in into if finder.endless(e)):
        route = finder.straight_route(edge, 3000.0)
        stays = max(
            len(list(run)) for inside, run in groupby(route, circle.__contains__) if inside
        )
        assert stays <= 4, route


def test_a_leading_route_comes_through_its_places_in_their_order(
    map_of: Callable[[str], MapModel],
) -> None:
    network = map_of('downtown').network
    finder = RouteFinder(network, 'passenger')
    start, first, then = 'meridian_parkway_2_eb', 'cannery_street_8_eb', 'juniper_street_5_wb'
    route = finder.leading_route(start, 3000.0, [frozenset({first}), frozenset({then})], 2000.0)
    assert route[0] == start
    assert route.index(first) < route.index(then)
    assert all(b in network.successors(a, 'passenger') for a, b in pairwise(route))
    assert finder.leading_route(start, 3000.0, [frozenset({then})], 50.0) == ()


@pytest.mark.parametrize('side', ['l', 'r'])
def test_a_turn_that_is_asked_for_is_no_bend(side: str, map_of: Callable[[str], MapModel]) -> None:
    network = map_of('downtown').network
    finder = RouteFinder(network, 'passenger')
    turns = [r for e in network.edges if (r := finder.turning_route(e, 500.0, side))]
    assert turns
    for before, after, *_ in turns:
        (ax, ay), (bx, by) = network.lane(network.edge(before).lane_ids[-1]).polyline[-2:]
        (cx, cy), (dx, dy) = network.lane(network.edge(after).lane_ids[-1]).polyline[:2]
        turned = atan2(dy - cy, dx - cx) - atan2(by - ay, bx - ax)
        assert abs((degrees(turned) + 180.0) % 360.0 - 180.0) >= 74.0
