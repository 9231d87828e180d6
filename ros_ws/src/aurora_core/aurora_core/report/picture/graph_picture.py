# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scenario graph on a page: elements in layers of dependency, conditions below, a key."""

from __future__ import annotations

from collections.abc import Mapping

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from aurora_core.agsg.export import EDGE_COLOURS
from aurora_core.outcomes.agsg import Agsg, AgsgEdge, EdgeType, NodeType
from aurora_core.report.picture.graph_conditions import (
    Entry,
    conditions_height,
    draw_conditions,
    entries_of,
)
from aurora_core.report.picture.graph_edges import DASHES, Labels, draw_edges
from aurora_core.report.picture.graph_nodes import MARKS, Card, card_of, draw_card, outline
from aurora_core.report.picture.graph_text import text_width, wrapped
from aurora_core.report.picture.placing import Rectangle
from aurora_core.report.scene import style
from aurora_core.report.scene.graph_layout import Layout, layered

# Text of 7 points on this width is read without effort when the page is as wide.
_PAPER = 590.0
_MARGIN = 14.0
_TITLE_PT, _SMALL_PT = 10.5, 7.4
_TITLE_LINES = 4
_SECTION = 26.0
_KEY = 50.0
# The way of a message: events come before the links that carry what they send.
_ORDER = (
    NodeType.ENVIRONMENT,
    NodeType.GROUND_AGENT,
    NodeType.UAV,
    NodeType.EVENT,
    NodeType.COMMUNICATION,
    NodeType.CONDITION,
)
# The environment stands above everything: where it leads needs no words.
_SILENT = frozenset({'on the road of', 'in the airspace of'})


def draw_graph(agsg: Agsg) -> Figure:
    """Draw a graph, parsed or grounded.

    Args:
        agsg: The graph.
    """
    with mpl.rc_context(style.RC):
        cards = {
            node.id: card_of(node, agsg.parameters)
            for node in sorted(agsg.nodes, key=lambda node: _ORDER.index(node.type))
            if node.type is not NodeType.CONDITION
        }
        pairs = _pairs(agsg, cards)
        sizes = {name: (card.width, card.height) for name, card in cards.items()}
        layout = layered(sizes, list(pairs), _PAPER)
        paper = layout.width
        entries = entries_of(agsg, paper)
        title = _title(agsg, paper)
        head = len(title) * _TITLE_PT * 1.3 + _SMALL_PT * 1.5 + 10.0
        below = _SECTION + conditions_height(entries) if entries else 0.0
        height = head + layout.height + below + _KEY
        figure, axes = _page(paper, height)
        _write_head(axes, agsg, title)
        _draw_elements(axes, cards, layout, pairs, head)
        if entries:
            _draw_list(axes, entries, head + layout.height, paper)
        _draw_key(axes, height - _KEY + 16.0, paper)
        return figure


def _page(paper: float, height: float) -> tuple[Figure, Axes]:
    size = (paper + 2 * _MARGIN, height + 2 * _MARGIN)
    figure = Figure(figsize=(size[0] / 72.0, size[1] / 72.0), facecolor=style.PAPER)
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_xlim(-_MARGIN, paper + _MARGIN)
    axes.set_ylim(height + _MARGIN, -_MARGIN)
    axes.set_autoscale_on(False)
    axes.axis('off')
    return figure, axes


def _title(agsg: Agsg, paper: float) -> list[str]:
    text = ' '.join(c if c.isprintable() else ' ' for c in agsg.spec.prompt.split(' '))
    lines = wrapped(f'“{text}”', _TITLE_PT, paper, bold=True)
    return lines if len(lines) <= _TITLE_LINES else [*lines[: _TITLE_LINES - 1], '…”']


def _write_head(axes: Axes, agsg: Agsg, title: list[str]) -> None:
    axes.text(
        0.0, 0.0, '\n'.join(title), size=_TITLE_PT, weight='bold', va='top', linespacing=1.25
    )
    free = sum(row.provenance.value != 'explicit' for row in agsg.parameters)
    facts = (
        f'scenario graph, {agsg.stage.value}: {len(agsg.nodes)} nodes, {len(agsg.edges)} edges, '
        f'{len(agsg.parameters)} parameters ({free} of them free)'
    )
    y = len(title) * _TITLE_PT * 1.3 + 2.0
    axes.text(0.0, y, facts, size=_SMALL_PT, color=style.FAINT, va='top')


def _pairs(agsg: Agsg, cards: Mapping[str, Card]) -> dict[tuple[str, str], list[AgsgEdge]]:
    """Return the edges between elements, by the nodes that they connect."""
    pairs: dict[tuple[str, str], list[AgsgEdge]] = {}
    for edge in agsg.edges:
        if edge.source in cards and edge.target in cards and edge.source != edge.target:
            pairs.setdefault((edge.source, edge.target), []).append(edge)
    return pairs


def _bundles(
    pairs: Mapping[tuple[str, str], list[AgsgEdge]],
) -> list[list[tuple[EdgeType, list[AgsgEdge]]]]:
    """Return what is drawn side by side: all lines between two nodes, both ways.

    Edges of one family in one direction are one line with all their words.
    """
    bundles: dict[frozenset[str], list[tuple[EdgeType, list[AgsgEdge]]]] = {}
    for pair, edges in pairs.items():
        for family in dict.fromkeys(edge.type for edge in edges):
            same = [edge for edge in edges if edge.type is family]
            bundles.setdefault(frozenset(pair), []).append((family, same))
    return list(bundles.values())


def _draw_elements(
    axes: Axes,
    cards: Mapping[str, Card],
    layout: Layout,
    pairs: Mapping[tuple[str, str], list[AgsgEdge]],
    top: float,
) -> None:
    rooms = []
    for name, card in cards.items():
        x, y = layout.centres[name]
        draw_card(axes, card, x, y + top)
        rooms.append(
            Rectangle(
                left=x - card.width / 2,
                bottom=y + top - card.height / 2,
                width=card.width,
                height=card.height,
            )
        )
    labels = Labels(axes, rooms, layout.width)
    wanted = []
    # All lines first: a label keeps off those of others.
    for bundle in _bundles(pairs):
        routes = [
            ([(x, y + top) for x, y in layout.routes[edges[0].source, edges[0].target]], family)
            for family, edges in bundle
        ]
        for line, (family, edges) in zip(draw_edges(axes, routes), bundle, strict=True):
            labels.keep_off(line)
            words = [edge.label for edge in edges if edge.label not in _SILENT]
            if words:
                wanted.append((line, ', '.join(words).replace('_', ' '), family))
    for line, text, family in wanted:
        labels.write(line, text, family)


def _draw_list(axes: Axes, entries: tuple[Entry, ...], top: float, paper: float) -> None:
    axes.text(
        0.0,
        top + _SECTION - 8.0,
        f'{len(entries)} success conditions, each with the nodes that it hangs on',
        size=_SMALL_PT,
        weight='bold',
        va='bottom',
    )
    draw_conditions(axes, entries, top + _SECTION, paper)


def _draw_key(axes: Axes, top: float, paper: float) -> None:
    """Draw what shapes, lines and marks mean."""
    axes.plot([0.0, paper], [top - 6.0, top - 6.0], color=style.ROAD_EDGE, linewidth=0.6)
    x = 0.0
    for kind in NodeType:
        shape = outline(kind, x + 10.0, top + 8.0, 20.0, 11.0)
        axes.add_patch(shape)
        words = 'UAV' if kind is NodeType.UAV else kind.value.replace('_', ' ')
        x = _key_text(axes, x + 24.0, top + 8.0, words)
    x = 0.0
    for family in EdgeType:
        axes.plot(
            [x, x + 24.0],
            [top + 25.0] * 2,
            color=EDGE_COLOURS[family],
            linestyle=DASHES[family],
            linewidth=1.25,
        )
        x = _key_text(axes, x + 28.0, top + 25.0, family.value)
    for provenance, mark in MARKS.items():
        axes.text(x, top + 25.0, mark, size=_SMALL_PT, va='center')
        x = _key_text(axes, x + 10.0, top + 25.0, provenance.value)


def _key_text(axes: Axes, x: float, y: float, text: str) -> float:
    """Write a word of the key and return where the next one begins."""
    axes.text(x, y, text, size=_SMALL_PT, color=style.FAINT, va='center')
    return x + text_width(text, _SMALL_PT) + 12.0
