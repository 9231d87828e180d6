# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The layout of a graph: nothing over anything, lines past the nodes, cycles allowed."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from aurora_core.report.scene.graph_layout import Layout, layered

WIDTH = 500.0
_NAMES = [f'n{k}' for k in range(9)]


def _boxes(sizes: dict[str, tuple[float, float]], layout: Layout) -> list[tuple[float, ...]]:
    return [
        (x - w / 2, x + w / 2, y - h / 2, y + h / 2)
        for name, (w, h) in sizes.items()
        for x, y in [layout.centres[name]]
    ]


@st.composite
def _graphs(
    draw: st.DrawFn,
) -> tuple[dict[str, tuple[float, float]], list[tuple[str, str]]]:
    names = _NAMES[: draw(st.integers(1, len(_NAMES)))]
    size = st.tuples(st.floats(20.0, 180.0), st.floats(15.0, 90.0))
    pairs = [(a, b) for a in names for b in names if a != b]
    edges = draw(st.lists(st.sampled_from(pairs), unique=True, max_size=14)) if pairs else []
    return {name: draw(size) for name in names}, edges


@settings(max_examples=150, deadline=None, derandomize=True)
@given(_graphs())
def test_no_node_lies_over_another_and_no_line_over_a_node(
    graph: tuple[dict[str, tuple[float, float]], list[tuple[str, str]]],
) -> None:
    sizes, edges = graph
    layout = layered(sizes, edges, WIDTH)
    boxes = _boxes(sizes, layout)
    for index, (left, right, top, bottom) in enumerate(boxes):
        assert top >= -1e-6
        assert bottom <= layout.height + 1e-6
        for other_left, other_right, other_top, other_bottom in boxes[index + 1 :]:
            apart_x = right <= other_left + 1e-6 or other_right <= left + 1e-6
            assert apart_x or bottom <= other_top + 1e-6 or other_bottom <= top + 1e-6
    for source, target in edges:
        route = layout.routes[source, target]
        # Its ends are on the two nodes.
        for (x, y), name in ((route[0], source), (route[-1], target)):
            w, h = sizes[name]
            assert abs(x - layout.centres[name][0]) <= w / 2
            assert abs(abs(y - layout.centres[name][1]) - h / 2) < 1e-6
        # Where it passes a layer it is vertical and in a lane of its own.
        for (x1, y1), (x2, y2) in list(pairwise(route))[1::2]:
            assert x1 == x2
            for left, right, top, bottom in boxes:
                beside = x1 <= left + 1e-6 or x1 >= right - 1e-6
                assert beside or max(y1, y2) <= top + 1e-6 or min(y1, y2) >= bottom - 1e-6


def test_layers_follow_the_arrows_and_a_cycle_turns_the_later_node_round() -> None:
    sizes = dict.fromkeys(('a', 'b', 'c'), (40.0, 20.0))
    layout = layered(sizes, [('a', 'b'), ('b', 'c'), ('c', 'a')], WIDTH)
    assert layout.centres['a'][1] < layout.centres['b'][1] < layout.centres['c'][1]
    back = layout.routes['c', 'a']
    assert back[0][1] > back[-1][1]


def test_a_layer_that_is_too_wide_becomes_two() -> None:
    sizes = {'top': (40.0, 20.0), **{f'n{k}': (150.0, 20.0) for k in range(5)}}
    layout = layered(sizes, [('top', f'n{k}') for k in range(5)], WIDTH)
    assert layout.width == WIDTH
    assert len({y for _, y in layout.centres.values()}) > 2
    assert all(x - 75.0 >= -1.0 and x + 75.0 <= WIDTH + 1.0 for x, _ in layout.centres.values())


def test_neighbours_stand_in_the_order_with_fewer_crossings() -> None:
    sizes = dict.fromkeys(('a', 'b', 'x', 'y'), (40.0, 20.0))
    layout = layered(sizes, [('a', 'y'), ('b', 'x')], WIDTH)
    a, b, x, y = (layout.centres[n][0] for n in 'abxy')
    assert (a < b) == (y < x)


@pytest.mark.parametrize('edges', [[], [('a', 'b')]])
def test_it_is_the_same_every_time(edges: list[tuple[str, str]]) -> None:
    sizes = {'a': (40.0, 20.0), 'b': (30.0, 10.0)}
    assert layered(sizes, edges, WIDTH) == layered(sizes, edges, WIDTH)
