# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The scenario graph of a page: nodes in layers, what each condition depends on."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from aurora_core.agsg.export import value_text
from aurora_core.agsg.influence import parameters_by_condition
from aurora_core.outcomes.agsg import Agsg, AgsgEdge, NodeType
from aurora_core.report.scene.graph_layout import Point, layered

_WIDTH = 680.0
_MARGIN = 8.0
_LEAST_WIDTH, _HEIGHT = 76.0, 40.0
# Pixels that a letter takes at most on average, of the id and of the label.
_ID_LETTER, _LABEL_LETTER = 7.8, 6.2
_LONGEST = 30
# The way of a message: events come before the links that carry what they send.
_ORDER = (
    NodeType.ENVIRONMENT,
    NodeType.GROUND_AGENT,
    NodeType.UAV,
    NodeType.EVENT,
    NodeType.COMMUNICATION,
)
# The environment stands above everything: where it leads needs no words.
_SILENT = frozenset({'on the road of', 'in the airspace of'})
_BETWEEN = 7.0
# Room for labels beside a line.
_ROOM = (-30.0, 30.0)
_PARAMETERS = 8
_LEVELS = (0.0, 12.0, -12.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class NodeBox:
    """A node on the paper, from its centre, pixels."""

    id: str
    kind: str
    label: str
    x: float
    y: float
    width: float
    height: float


@dataclass(frozen=True, slots=True, kw_only=True)
class EdgeLine:
    """An edge on the paper.

    Attributes:
        path: As an SVG path says it.
        x: Where its label stands.
        y: Where its label stands.
    """

    source: str
    target: str
    family: str
    label: str
    path: str
    x: float
    y: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Dependence:
    """What a condition depends on.

    Attributes:
        id: Of the condition.
        sources: Nodes that lead straight to it.
        parameters: The nearest parameters that can affect it, in words.
        more: How many other parameters can.
    """

    id: str
    sources: tuple[str, ...]
    parameters: tuple[str, ...]
    more: int


@dataclass(frozen=True, slots=True, kw_only=True)
class GraphPaper:
    """A graph, laid out; its paper begins at `left`."""

    left: float
    width: float
    height: float
    nodes: tuple[NodeBox, ...]
    edges: tuple[EdgeLine, ...]
    conditions: tuple[Dependence, ...]


def graph_paper(agsg: Agsg) -> GraphPaper | None:
    """Return a graph on paper, None when it has no elements."""
    kept = [n for n in agsg.nodes if n.type is not NodeType.CONDITION]
    if not kept:
        return None
    labels = {n.id: _short(n.label.replace('_', ' ')) for n in kept}
    sizes = {
        n.id: (_width(n.id, labels[n.id]), _HEIGHT)
        for n in sorted(kept, key=lambda node: _ORDER.index(node.type))
    }
    pairs: dict[tuple[str, str], list[AgsgEdge]] = {}
    for edge in agsg.edges:
        if edge.source in sizes and edge.target in sizes and edge.source != edge.target:
            pairs.setdefault((edge.source, edge.target), []).append(edge)
    layout = layered(sizes, list(pairs), _WIDTH)
    kinds = {n.id: n.type.value for n in kept}
    nodes = tuple(
        NodeBox(
            id=name,
            kind=kinds[name],
            label=labels[name],
            x=round(layout.centres[name][0] + _MARGIN, 1),
            y=round(layout.centres[name][1] + _MARGIN, 1),
            width=round(width, 1),
            height=height,
        )
        for name, (width, height) in sizes.items()
    )
    lines = [
        _line(edge, layout.routes[pair], _BETWEEN * (k - (len(found) - 1) / 2))
        for pair, found in pairs.items()
        for k, edge in enumerate(found)
    ]
    edges = tuple(_apart(lines))
    # The layout centres everything on the paper that it was given; the rest is cut off.
    reach = [x + side for route in layout.routes.values() for x, _ in route for side in _ROOM]
    left = min([*(n.x - n.width / 2 for n in nodes), *reach]) - _MARGIN
    right = max([*(n.x + n.width / 2 for n in nodes), *reach]) + _MARGIN
    return GraphPaper(
        left=round(left, 1),
        width=round(right - left, 1),
        height=round(layout.height + 2 * _MARGIN, 1),
        nodes=nodes,
        edges=edges,
        conditions=_dependences(agsg),
    )


def _short(label: str) -> str:
    return label if len(label) <= _LONGEST else f'{label[: _LONGEST - 1]}…'


def _width(name: str, label: str) -> float:
    return max(_LEAST_WIDTH, 20.0 + max(_ID_LETTER * len(name), _LABEL_LETTER * len(label)))


def _line(edge: AgsgEdge, route: tuple[Point, ...], shift: float) -> EdgeLine:
    points = [(x + _MARGIN + shift, y + _MARGIN) for x, y in route]
    (x, y), *rest = points
    path = [f'M{x:.1f} {y:.1f}']
    for to_x, to_y in rest:
        middle = (y + to_y) / 2
        path.append(f'C{x:.1f} {middle:.1f} {to_x:.1f} {middle:.1f} {to_x:.1f} {to_y:.1f}')
        x, y = to_x, to_y
    (x1, y1), (x2, y2) = points[-2], points[-1]
    return EdgeLine(
        source=edge.source,
        target=edge.target,
        family=edge.type.value,
        label='' if edge.label in _SILENT else edge.label.replace('_', ' '),
        path=''.join(path),
        x=round((x1 + x2) / 2, 1),
        y=round((y1 + y2) / 2, 1),
    )


def _apart(lines: Sequence[EdgeLine]) -> Iterator[EdgeLine]:
    """Yield the lines with labels one below the other where they would stand side by side."""
    for row in {line.y for line in lines if line.label}:
        level = 0
        before: EdgeLine | None = None
        for line in sorted((e for e in lines if e.y == row and e.label), key=lambda e: e.x):
            room = 0.5 * _LABEL_LETTER * (len(line.label) + len(before.label)) if before else 0.0
            level = level + 1 if before is not None and line.x - before.x < room else 0
            before = line
            yield replace(line, y=round(line.y + _LEVELS[level % len(_LEVELS)], 1))
    yield from (line for line in lines if not line.label)


def _dependences(agsg: Agsg) -> tuple[Dependence, ...]:
    sources: dict[str, list[str]] = {}
    for edge in agsg.edges:
        sources.setdefault(edge.target, []).append(edge.source)
    rows = {row.path: row for row in agsg.parameters}
    found = []
    for condition, near in parameters_by_condition(agsg).items():
        told = []
        for influence in near[:_PARAMETERS]:
            row = rows[influence.parameter]
            value = row.requested if row.realised is None else row.realised
            told.append(f'{row.path} = {value_text(value, row.unit)} ({row.provenance.value})')
        found.append(
            Dependence(
                id=condition,
                sources=tuple(dict.fromkeys(sources.get(condition, ()))),
                parameters=tuple(told),
                more=max(len(near) - _PARAMETERS, 0),
            )
        )
    return tuple(found)
