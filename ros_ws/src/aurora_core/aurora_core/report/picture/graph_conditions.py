# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Condition nodes of the graph's picture: a list in columns, each with the nodes it hangs on.

Dozens of conditions with an arrow from every node would be a thicket: the nodes are repeated as
small chips instead, and the arrow from them to the condition shows the family.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch

from aurora_core.agsg.export import EDGE_COLOURS, NODE_COLOURS
from aurora_core.outcomes.agsg import Agsg, AgsgNode, EdgeType, NodeType
from aurora_core.report.picture.graph_edges import DASHES
from aurora_core.report.picture.graph_nodes import outline, parameter_row
from aurora_core.report.picture.graph_text import text_width, wrapped
from aurora_core.report.scene import style

COLUMNS = 2
_ID_PT, _TEXT_PT, _CHIP_PT = 7.2, 6.9, 6.6
_LINE = 1.3
_CHIPS, _ARROW, _BETWEEN = 74.0, 24.0, 16.0
_PAD_X, _PAD_Y, _GAP = 8.0, 2.6, 3.2
_CHIP_PAD, _CHIP_GAP = 3.5, 3.0
_CHIP_HEIGHT = _CHIP_PT * 1.55
# More nodes than this are called by what they have in common.
_MANY = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Entry:
    """One condition as it is written.

    Attributes:
        node: Its node.
        family: Of the edges that lead to it.
        chips: Lines of (text, node type) pairs.
        lines: Of its sentence and parameters.
        height: Of all, points.
    """

    node: AgsgNode
    family: EdgeType
    chips: tuple[tuple[tuple[str, NodeType], ...], ...]
    lines: tuple[str, ...]
    height: float


def column_width(paper: float) -> float:
    """Return the width of one column, points."""
    return (paper - _BETWEEN * (COLUMNS - 1)) / COLUMNS


def entries_of(agsg: Agsg, paper: float) -> tuple[Entry, ...]:
    """Return the conditions in the order of the graph."""
    room = column_width(paper) - _CHIPS - _ARROW - 2 * _PAD_X
    entries = []
    for node in agsg.nodes:
        if node.type is NodeType.CONDITION:
            into = [edge for edge in agsg.edges if edge.target == node.id]
            chips = _chips(agsg, [edge.source for edge in into])
            lines = wrapped(node.label.replace('_', ' '), _TEXT_PT, room)
            rows = (parameter_row(row) for row in agsg.parameters if row.owner == node.id)
            lines += [f'{name} {value} {mark}' for name, value, mark in rows]
            text = (_ID_PT + _TEXT_PT * len(lines)) * _LINE + 2 * _PAD_Y
            beside = len(chips) * (_CHIP_HEIGHT + _CHIP_GAP)
            entries.append(
                Entry(
                    node=node,
                    family=into[0].type,
                    chips=tuple(tuple(line) for line in chips),
                    lines=tuple(lines),
                    height=max(text, beside) + _GAP,
                )
            )
    return tuple(entries)


def columns_of(entries: Sequence[Entry]) -> list[list[Entry]]:
    """Spread entries over columns of about one height, in their order."""
    columns: list[list[Entry]] = [[] for _ in range(COLUMNS)]
    whole = sum(entry.height for entry in entries)
    done = 0.0
    for entry in entries:
        columns[min(int((done + entry.height / 2) / whole * COLUMNS), COLUMNS - 1)].append(entry)
        done += entry.height
    return columns


def conditions_height(entries: Sequence[Entry]) -> float:
    """Return the height of the list, points."""
    return max((sum(e.height for e in column) for column in columns_of(entries)), default=0.0)


def draw_conditions(axes: Axes, entries: Sequence[Entry], top: float, paper: float) -> None:
    """Draw the list below `top`, in points of the axes (y downwards)."""
    width = column_width(paper)
    for index, column in enumerate(columns_of(entries)):
        left, y = index * (width + _BETWEEN), top
        for entry in column:
            _draw_entry(axes, entry, left, y, width)
            y += entry.height


def _draw_entry(axes: Axes, entry: Entry, left: float, top: float, width: float) -> None:
    height = entry.height - _GAP
    middle = top + height / 2
    start = left + _CHIPS + _ARROW
    room = width - _CHIPS - _ARROW
    shape = outline(NodeType.CONDITION, start + room / 2, middle, room, height)
    shape.set_zorder(3.0)
    axes.add_patch(shape)
    text = (_ID_PT + _TEXT_PT * len(entry.lines)) * _LINE
    y = middle - text / 2
    axes.text(start + _PAD_X, y, entry.node.id, size=_ID_PT, weight='bold', va='top', zorder=4.0)
    y += _ID_PT * _LINE
    for line in entry.lines:
        axes.text(start + _PAD_X, y, line, size=_TEXT_PT, va='top', zorder=4.0)
        y += _TEXT_PT * _LINE
    colour = EDGE_COLOURS[entry.family]
    axes.plot(
        [left + _CHIPS + 3.0, start - 5.0],
        [middle, middle],
        color=colour,
        linewidth=1.25,
        linestyle=DASHES[entry.family],
    )
    axes.fill([start, start - 5.5, start - 5.5], [middle, middle - 2.5, middle + 2.5], colour)
    rows = len(entry.chips)
    y = middle - (rows * _CHIP_HEIGHT + (rows - 1) * _CHIP_GAP) / 2 + _CHIP_HEIGHT / 2
    for row in entry.chips:
        x = left + _CHIPS - sum(_chip_width(text) + _CHIP_GAP for text, _ in row)
        for name, kind in row:
            _draw_chip(axes, name, kind, x, y)
            x += _chip_width(name) + _CHIP_GAP
        y += _CHIP_HEIGHT + _CHIP_GAP


def _draw_chip(axes: Axes, text: str, kind: NodeType, left: float, middle: float) -> None:
    width = _chip_width(text)
    axes.add_patch(
        FancyBboxPatch(
            (left + 2.0, middle - _CHIP_HEIGHT / 2 + 2.0),
            width - 4.0,
            _CHIP_HEIGHT - 4.0,
            boxstyle='round,pad=2.0',
            facecolor=NODE_COLOURS[kind],
            edgecolor=style.FAINT,
            linewidth=0.5,
            zorder=3.0,
        )
    )
    axes.text(
        left + width / 2, middle, text, size=_CHIP_PT, ha='center', va='center_baseline', zorder=4
    )


def _chip_width(text: str) -> float:
    return text_width(text, _CHIP_PT) + 2 * _CHIP_PAD


def _chips(agsg: Agsg, sources: Sequence[str]) -> list[list[tuple[str, NodeType]]]:
    """Return the chips in lines that fit."""
    kinds = {node.id: node.type for node in agsg.nodes}
    left = list(dict.fromkeys(sources))
    chips: list[tuple[str, NodeType]] = []
    agents = [name for name, kind in kinds.items() if kind is NodeType.GROUND_AGENT]
    if len(agents) > _MANY and set(agents) <= set(left):
        chips.append(('all ground agents', NodeType.GROUND_AGENT))
        left = [name for name in left if name not in agents]
    chips += [(name, kinds[name]) for name in left]
    lines: list[list[tuple[str, NodeType]]] = []
    used = _CHIPS
    for name, kind in chips:
        needed = _chip_width(name) + _CHIP_GAP
        if used + needed > _CHIPS:
            lines.append([])
            used = 0.0
        lines[-1].append((name, kind))
        used += needed
    return lines
