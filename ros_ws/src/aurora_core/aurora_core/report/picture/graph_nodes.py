# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Nodes of the graph's picture: type by shape and fill, parameters with value and provenance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch, Patch, Polygon

from aurora_core.agsg.export import NODE_COLOURS, parameter_name, value_text
from aurora_core.outcomes.agsg import AgsgNode, AgsgParameter, NodeType
from aurora_core.report.picture.graph_text import text_width, wrapped
from aurora_core.report.scene import style
from aurora_core.spec.parameter import Provenance

MARKS = {Provenance.EXPLICIT: '●', Provenance.INFERRED: '◐', Provenance.DEFAULT: '○'}
ID_PT, LABEL_PT, ROW_PT = 8.6, 7.4, 7.2
_LINE = 1.34
_PAD_X, _PAD_Y = 9.0, 6.0
_MARK_ROOM = 10.0
_WIDEST_LABEL = 150.0
# How far slanted and pointed sides reach beyond the text.
_SIDE = {NodeType.UAV: 9.0, NodeType.COMMUNICATION: 9.0, NodeType.EVENT: 5.0}


@dataclass(frozen=True, slots=True, kw_only=True)
class Card:
    """What is written in a node.

    Attributes:
        node: The node.
        label: Lines of its label.
        rows: Name, value and mark of each parameter.
        width: Of the shape, points.
        height: Of the shape, points.
    """

    node: AgsgNode
    label: tuple[str, ...]
    rows: tuple[tuple[str, str, str], ...]
    width: float
    height: float


def card_of(node: AgsgNode, parameters: Sequence[AgsgParameter]) -> Card:
    """Return the card of a node with the parameters that it owns."""
    rows = tuple(parameter_row(row) for row in parameters if row.owner == node.id)
    label = tuple(wrapped(node.label.replace('_', ' '), LABEL_PT, _WIDEST_LABEL))
    inner = max(
        [
            text_width(node.id, ID_PT, bold=True),
            *(text_width(line, LABEL_PT) for line in label),
            *(text_width(f'{n}   {v}', ROW_PT) + _MARK_ROOM for n, v, _ in rows),
        ]
    )
    lines = ID_PT + LABEL_PT * len(label) + ROW_PT * len(rows)
    return Card(
        node=node,
        label=label,
        rows=rows,
        width=inner + 2 * (_PAD_X + _SIDE.get(node.type, 0.0)),
        height=lines * _LINE + 2 * _PAD_Y + (3.0 if rows else 0.0),
    )


def parameter_row(row: AgsgParameter) -> tuple[str, str, str]:
    """Return name, value and mark of a parameter; a value that grounding moved shows both."""
    parts = row.path.split('/')
    name = parameter_name(row.path)
    if parts[0] == 'missions':
        name = f'{parts[1]} {name}'
    value = value_text(row.requested, row.unit)
    realised = None if row.realised is None else value_text(row.realised, row.unit)
    if realised is not None and realised != value:
        value = f'{value} → {realised}'
    return name, value, MARKS[row.provenance]


def outline(kind: NodeType, x: float, y: float, width: float, height: float) -> Patch:
    """Return the shape of a node type around a centre (y downwards)."""
    left, right, top, bottom = x - width / 2, x + width / 2, y - height / 2, y + height / 2
    look: dict[str, Any] = {
        'facecolor': NODE_COLOURS[kind],
        'edgecolor': style.FAINT,
        'linewidth': 0.9,
    }
    side = min(_SIDE.get(kind, 0.0), height / 2)
    if kind is NodeType.UAV:
        points = [(left, y), (left + side, top), (right - side, top)]
        points += [(right, y), (right - side, bottom), (left + side, bottom)]
    elif kind is NodeType.COMMUNICATION:
        points = [(left + side, top), (right, top), (right - side, bottom), (left, bottom)]
    elif kind is NodeType.EVENT:
        points = [(left + side, top), (right - side, top), (right, top + side)]
        points += [(right, bottom - side), (right - side, bottom), (left + side, bottom)]
        points += [(left, bottom - side), (left, top + side)]
    elif kind is NodeType.ENVIRONMENT:
        points = [(left, top), (right, top), (right, bottom), (left, bottom)]
    else:
        round_pt = min(height / 2, 11.0) if kind is NodeType.CONDITION else 5.0
        return FancyBboxPatch(
            (left + round_pt, top + round_pt),
            width - 2 * round_pt,
            height - 2 * round_pt,
            boxstyle=f'round,pad={round_pt}',
            **look,
        )
    return Polygon(points, closed=True, joinstyle='round', **look)


def draw_card(axes: Axes, card: Card, x: float, y: float) -> None:
    """Draw a node around a centre, in points of the axes."""
    shape = outline(card.node.type, x, y, card.width, card.height)
    shape.set_zorder(3.0)
    axes.add_patch(shape)
    side = _SIDE.get(card.node.type, 0.0) + _PAD_X
    left, right = x - card.width / 2 + side, x + card.width / 2 - side
    line = y - card.height / 2 + _PAD_Y

    def write(at: float, text: str, size: float, align: str, **look: Any) -> None:
        axes.text(at, line, text, size=size, ha=align, va='top', zorder=4.0, **look)

    write(x, card.node.id, ID_PT, 'center', weight='bold')
    line += ID_PT * _LINE
    for text in card.label:
        write(x, text, LABEL_PT, 'center')
        line += LABEL_PT * _LINE
    line += 3.0
    for name, value, mark in card.rows:
        write(left, name, ROW_PT, 'left', color=style.FAINT)
        write(right - _MARK_ROOM, value, ROW_PT, 'right')
        write(right, mark, ROW_PT, 'right')
        line += ROW_PT * _LINE
