# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Simple Temporal Networks, beside networkx on random ones."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise

import networkx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from aurora_core.temporal.stn import SECOND, UNBOUNDED, Edge, Minimal, Stn, microseconds


def stn(*edges: tuple[str, str, int], points: tuple[str, ...] = ()) -> Stn[int]:
    return Stn([Edge(a, b, bound, k) for k, (a, b, bound) in enumerate(edges)], points)


def least_us(minimal: Minimal, earlier: str, later: str) -> int | None:
    """Return by how much a point comes after another at least, None without a bound."""
    bound = minimal.most_us(later, earlier)
    return None if bound is None else -bound


def test_bounds_follow_from_bounds() -> None:
    # b 10 to 20 after a, c 30 to 40 after b, and at most 45 after a.
    found = stn(('a', 'b', 20), ('b', 'a', -10), ('b', 'c', 40), ('c', 'b', -30), ('a', 'c', 45))
    minimal = found.minimal()
    assert minimal is not None
    assert found.negative_cycle() == ()
    assert (least_us(minimal, 'a', 'b'), minimal.most_us('a', 'b')) == (10, 15)
    assert (least_us(minimal, 'a', 'c'), minimal.most_us('a', 'c')) == (40, 45)
    assert (least_us(minimal, 'b', 'c'), minimal.most_us('b', 'c')) == (30, 35)


def test_a_point_without_a_bound_is_free() -> None:
    minimal = stn(('a', 'b', 5), points=('z',)).minimal()
    assert minimal is not None
    assert minimal.points == ('z', 'a', 'b')
    assert minimal.most_us('a', 'z') is None
    assert least_us(minimal, 'a', 'b') is None


def test_bounds_that_just_meet_are_no_contradiction() -> None:
    assert stn(('a', 'b', 5), ('b', 'a', -5)).negative_cycle() == ()
    [first, second] = stn(('a', 'b', 5), ('b', 'a', -6)).negative_cycle()
    assert {first.bound_us, second.bound_us} == {5, -6}
    assert stn(('a', 'b', 5), ('b', 'a', -6)).minimal() is None


@pytest.mark.parametrize('bound', [0, 5, -5])
def test_a_bound_of_a_point_on_itself(bound: int) -> None:
    found = stn(('a', 'a', bound))
    assert bool(found.negative_cycle()) is (bound < 0)
    assert (found.minimal() is None) is (bound < 0)


def test_nothing_is_consistent() -> None:
    assert stn().negative_cycle() == ()
    assert stn(points=('a',)).minimal() is not None


def test_bounds_that_have_no_room_are_refused() -> None:
    with pytest.raises(ValueError, match='no room'):
        stn(('a', 'b', UNBOUNDED // 2))


@given(st.fractions(min_value=-2000, max_value=2000, max_denominator=10**7))
def test_seconds_are_rounded_to_the_looser_side(exact: Fraction) -> None:
    found = microseconds(float(exact))
    assert found >= exact * SECOND - Fraction(1, 500)
    assert found - exact * SECOND < 1
    assert microseconds(found / SECOND) == found


def _random(seed: int) -> Stn[int]:
    chance = np.random.default_rng(seed)
    count = int(chance.integers(1, 30))
    edges = []
    for _ in range(int(chance.integers(0, 4 * count))):
        a, b = chance.integers(0, count, 2)
        edges.append((f'p{a}', f'p{b}', int(chance.integers(-3 - seed % 5, 20))))
    return stn(*edges, points=tuple(f'p{k}' for k in range(count)))


@pytest.mark.parametrize('seed', range(400))
def test_random_networks_are_those_of_networkx(seed: int) -> None:
    found = _random(seed)
    graph = networkx.DiGraph()
    graph.add_nodes_from(found.points)
    for edge in found.edges:
        known = graph.get_edge_data(edge.earlier, edge.later, {'weight': edge.bound_us})['weight']
        graph.add_edge(edge.earlier, edge.later, weight=min(known, edge.bound_us))
    minimal, circle = found.minimal(), found.negative_cycle()
    assert bool(circle) is networkx.negative_edge_cycle(graph)
    assert (minimal is None) is bool(circle)
    if minimal is None:
        assert found.spans_us(found.points[0]) is None
        assert sum(edge.bound_us for edge in circle) < 0
        assert all(a.later == b.earlier for a, b in pairwise((*circle, circle[0])))
        assert len({edge.earlier for edge in circle}) == len(circle)
        # Minimal: without any one of them the rest can be met.
        for left_out in circle:
            assert Stn([e for e in circle if e is not left_out]).minimal() is not None
        return
    for one in found.points:
        lengths = networkx.single_source_bellman_ford_path_length(graph, one)
        assert {p: minimal.most_us(one, p) for p in found.points} == {
            p: lengths.get(p) for p in found.points
        }
        assert found.spans_us(one) == {
            p: (least_us(minimal, one, p), minimal.most_us(one, p)) for p in found.points
        }


@pytest.mark.parametrize('seed', range(400))
def test_bounds_that_are_added_close_a_circle_exactly_where_the_whole_network_has_one(
    seed: int,
) -> None:
    whole = _random(seed)
    cut = np.random.default_rng(seed).integers(0, len(whole.edges) + 1)
    base, more = Stn(whole.edges[:cut], whole.points), whole.edges[cut:]
    if base.negative_cycle():
        with pytest.raises(ValueError, match='consistent'):
            base.closed_by(more)
        return
    circle = base.closed_by(more)
    assert bool(circle) is bool(whole.negative_cycle())
    assert base.negative_cycle() == ()
    if circle:
        assert sum(edge.bound_us for edge in circle) < 0
        assert all(a.later == b.earlier for a, b in pairwise((*circle, circle[0])))
        assert len({edge.earlier for edge in circle}) == len(circle)
        assert set(circle) & set(more)


def test_bounds_are_added_to_points_that_the_network_lacks() -> None:
    base = stn(('a', 'b', 20))
    within, before = Edge('b', 'c', -30, 7), Edge('c', 'a', 9, 8)
    assert set(base.closed_by([within, before])) == {base.edges[0], within, before}
    assert base.closed_by([within, Edge('c', 'a', 10, 8)]) == ()
    assert base.closed_by([]) == ()
