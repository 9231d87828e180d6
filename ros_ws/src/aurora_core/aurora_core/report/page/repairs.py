# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Margins over the iterations of repair, as a figure of the page: realised and as foreseen."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from html import escape

from aurora_core.report.run_report import RepairReport
from aurora_core.report.visible import visible

_WIDTH, _HEIGHT = 720, 240
_LEFT, _RIGHT, _TOP, _BOTTOM = 46, 200, 12, 30
# Normalised margins beyond this are drawn at the edge: there the scale says no more.
_MOST = 2.0
_LINES = 6


def repair_figure(repairs: Sequence[RepairReport]) -> str:
    """Return the figure as SVG, '' where nothing was simulated again.

    A line is a condition that failed once, over the realisations; hollow is what was foreseen.

    Args:
        repairs: Attempts, in order.
    """
    simulated = [repair for repair in repairs if repair.bag is not None]
    if not simulated:
        return ''
    courses = _courses(simulated)
    last = len(simulated)

    def x(k: int) -> float:
        return _LEFT + k * (_WIDTH - _LEFT - _RIGHT) / last

    def y(value: float) -> float:
        shown = min(_MOST, max(-_MOST, value))
        return _TOP + (_MOST - shown) * (_HEIGHT - _TOP - _BOTTOM) / (2 * _MOST)

    parts = [f'<svg viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img" class="iterations">']
    parts.append('<title>Normalised margins over the realisations</title>')
    for level in (-_MOST, 0.0, _MOST):
        kind = 'zero' if level == 0.0 else 'axis'
        parts.append(
            f'<line class="{kind}" x1="{_LEFT}" x2="{_WIDTH - _RIGHT}" '
            f'y1="{y(level):.1f}" y2="{y(level):.1f}"/>'
            f'<text x="{_LEFT - 6}" y="{y(level) + 4:.1f}" text-anchor="end">{level:g}</text>'
        )
    for k in range(last + 1):
        parts.append(
            f'<text x="{x(k):.1f}" y="{_HEIGHT - 10}" text-anchor="middle">{_name(k)}</text>'
        )
    for number, (condition, realised, foreseen) in enumerate(courses):
        kind = f'course c{number}'
        points = [(x(k), y(value)) for k, value in enumerate(realised) if value is not None]
        way = ' '.join(f'{px:.1f},{py:.1f}' for px, py in points)
        parts.append(f'<polyline class="{kind}" points="{way}"/>')
        parts += [f'<circle class="{kind}" cx="{a:.1f}" cy="{b:.1f}" r="3"/>' for a, b in points]
        parts += [
            f'<circle class="{kind} foreseen" cx="{x(k):.1f}" cy="{y(value):.1f}" r="5"/>'
            for k, value in enumerate(foreseen)
            if value is not None
        ]
        parts.append(
            f'<text class="{kind}" x="{_WIDTH - _RIGHT + 12}" y="{_TOP + 14 + 18 * number}">'
            f'{escape(visible(condition))}</text>'
        )
    return ''.join((*parts, '</svg>'))


Course = tuple[str, list[float | None], list[float | None]]


def _courses(simulated: Sequence[RepairReport]) -> list[Course]:
    """Return the conditions that failed once, the worst first, each with its margins.

    What a proposal answers to is the best realisation so far; of the first one that is the first.
    """
    return sorted(_failed(simulated), key=_worst)[:_LINES]


def _failed(simulated: Sequence[RepairReport]) -> Iterator[Course]:
    names = dict.fromkeys(row.condition for repair in simulated for row in repair.margins)
    for name in names:
        rows = [
            next((row for row in repair.margins if row.condition == name), None)
            for repair in simulated
        ]
        first = None if rows[0] is None else rows[0].before
        realised = [first, *(None if row is None else row.realised for row in rows)]
        foreseen = [None, *(None if row is None else row.predicted for row in rows)]
        known = [value for value in realised if value is not None]
        if known and min(known) < 0.0:
            yield name, realised, foreseen


def _worst(course: Course) -> tuple[float, str]:
    return min(value for value in course[1] if value is not None), course[0]


def _name(k: int) -> str:
    return 'first' if k == 0 else str(k)
