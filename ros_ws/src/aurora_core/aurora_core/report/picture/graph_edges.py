# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Edges of the graph's picture: family by colour and dash, labels that cover nothing."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

from matplotlib.axes import Axes
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from aurora_core.agsg.export import EDGE_COLOURS
from aurora_core.outcomes.agsg import EdgeType
from aurora_core.report.picture.graph_text import text_width
from aurora_core.report.picture.placing import Rectangle
from aurora_core.report.scene import style
from aurora_core.report.scene.graph_layout import Point

DASHES: dict[EdgeType, Any] = {
    EdgeType.SPATIAL: 'solid',
    EdgeType.TEMPORAL: (0, (5.0, 2.2)),
    EdgeType.PERCEPTUAL: (0, (1.2, 1.6)),
    EdgeType.COMMUNICATION: (0, (7.0, 2.0, 1.4, 2.0)),
    EdgeType.BEHAVIORAL: (0, (3.0, 1.4)),
}
LABEL_PT = 6.8
_WIDTH = 1.25
_HEAD = 5.5
_BETWEEN = 5.0
# Lines are sampled in squares of this size; to cover a node or a label is much worse.
_SAMPLE, _WEIGHT = 4.0, 50.0
# Where on a bow between two layers a label may sit, best places first.
_SHARES = (0.5, 0.4, 0.6, 0.32, 0.68, 0.24, 0.76)


def draw_edges(
    axes: Axes, edges: Sequence[tuple[Sequence[Point], EdgeType]]
) -> list[tuple[Point, ...]]:
    """Draw all edges between two nodes side by side and return their points.

    Args:
        axes: With points as units, y downwards.
        edges: Route from source to target (see `graph_layout.Layout`) and family of each.
    """
    lines = []
    for index, (route, family) in enumerate(edges):
        shift = _BETWEEN * (index - (len(edges) - 1) / 2)
        line = tuple((x + shift, y) for x, y in route)
        _draw(axes, line, family, shift)
        lines.append(line)
    return lines


def _draw(axes: Axes, line: Sequence[Point], family: EdgeType, shift: float) -> None:
    (x, y), up = line[-1], line[-2][1] > line[-1][1]
    back = _HEAD if up else -_HEAD
    ends = [*line[:-1], (x, y + back * 0.8)]
    points, codes = [ends[0]], [Path.MOVETO]
    for (x1, y1), (x2, y2) in pairwise(ends):
        # Lines side by side stay apart where they run flat: one bends before the other.
        middle = (y1 + y2) / 2 - shift * ((x2 > x1) - (x2 < x1)) * (1.0 if y2 > y1 else -1.0)
        points += [(x1, middle), (x2, middle), (x2, y2)]
        codes += [Path.CURVE4] * 3
    colour = EDGE_COLOURS[family]
    axes.add_patch(
        PathPatch(
            Path(points, codes),
            facecolor='none',
            edgecolor=colour,
            linewidth=_WIDTH,
            linestyle=DASHES[family],
            zorder=2.0,
        )
    )
    wing = _HEAD * 0.45
    head = [(x, y), (x - wing, y + back), (x + wing, y + back)]
    axes.add_patch(Polygon(head, closed=True, facecolor=colour, linewidth=0.0, zorder=2.1))


def _on_bow(start: Point, end: Point, share: float) -> Point:
    """Return a point of the line between two layers (the Bezier curve that `_draw` draws)."""
    (x1, y1), (x2, y2) = start, end
    x = x1 + (x2 - x1) * (3 * share**2 - 2 * share**3)
    y = y1 + (y2 - y1) * (1.5 * share - 1.5 * share**2 + share**3)
    return x, y


class Labels:
    """Writes the labels of edges where there is room.

    Args:
        axes: With points as units, y downwards.
        taken: Rooms of the nodes.
        width: Of the paper.
    """

    def __init__(self, axes: Axes, taken: Sequence[Rectangle], width: float) -> None:
        self._axes = axes
        self._taken = list(taken)
        self._lines: list[Rectangle] = []
        self._paper = width

    def keep_off(self, line: Sequence[Point]) -> None:
        """Remember a line that labels had better not cover."""
        for (x1, y1), (x2, y2) in pairwise(line):
            steps = max(int(abs(y2 - y1) / _SAMPLE), 1)
            for step in range(steps + 1):
                x, y = _on_bow((x1, y1), (x2, y2), step / steps)
                half = _SAMPLE / 2
                self._lines.append(
                    Rectangle(left=x - half, bottom=y - half, width=_SAMPLE, height=_SAMPLE)
                )

    def write(self, line: Sequence[Point], text: str, family: EdgeType) -> None:
        """Write a label on its line, at the place where it covers least."""
        width, height = text_width(text, LABEL_PT) + 4.0, LABEL_PT * 1.25
        best, least = None, float('inf')
        for start, end in reversed(list(pairwise(line))[::2]):
            for share in _SHARES:
                x, y = _on_bow(start, end, share)
                x = min(max(x, width / 2), self._paper - width / 2)
                room = Rectangle(
                    left=x - width / 2, bottom=y - height / 2, width=width, height=height
                )
                covered = _WEIGHT * sum(room.overlap(other) for other in self._taken)
                covered += sum(room.overlap(other) for other in self._lines)
                if covered < least:
                    best, least = (x, y, room), covered
        if best is None:
            return
        x, y, room = best
        self._taken.append(room)
        self._axes.text(
            x,
            y,
            text,
            size=LABEL_PT,
            color=EDGE_COLOURS[family],
            ha='center',
            va='center',
            zorder=2.5,
            bbox={'facecolor': style.PAPER, 'edgecolor': 'none', 'pad': 0.8},
        )
