# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbered badges, scale bar and north arrow."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.patches import FancyArrowPatch
from matplotlib.patheffects import withStroke

from aurora_core.report.scene import style
from aurora_core.report.scene.tracks import Box


def number_badge(ax: Axes, x: float, y: float, number: int, colour: str, *, zorder: float) -> None:
    """Draw a filled circle with a number at a point in data coordinates."""
    ax.plot(
        x,
        y,
        marker='o',
        markersize=11.5,
        markerfacecolor=colour,
        markeredgecolor='white',
        markeredgewidth=1.0,
        zorder=zorder,
        clip_on=False,
    )
    ax.annotate(
        str(number),
        (x, y),
        color='white',
        fontsize=6.6,
        weight='bold',
        ha='center',
        va='center_baseline',
        zorder=zorder + 0.05,
        annotation_clip=False,
    )


def draw_scale(ax: Axes, box: Box) -> None:
    """Draw scale bar and north arrow into the lower left and upper left corners."""
    length = next(s for s in (10, 20, 50, 100, 200, 500, 1000, 2000) if s >= box.width / 9.0)
    x, y = box.west + 0.022 * box.width, box.south + 0.045 * box.height
    edge = [withStroke(linewidth=4.0, foreground='white')]
    ax.plot(
        [x, x + length],
        [y, y],
        color=style.INK,
        linewidth=2.4,
        solid_capstyle='butt',
        zorder=8.0,
        path_effects=[withStroke(linewidth=5.0, foreground='white')],
    )
    ax.text(
        x + length / 2,
        y + 0.012 * box.height,
        f'{length} m',
        ha='center',
        va='bottom',
        fontsize=7.5,
        path_effects=edge,
        zorder=8.0,
    )
    north = (box.west + 0.03 * box.width, box.north - 0.045 * box.height)
    ax.add_patch(
        FancyArrowPatch(
            (north[0], north[1] - 0.075 * box.height),
            north,
            arrowstyle='-|>',
            mutation_scale=14.0,
            color=style.INK,
            linewidth=1.6,
            zorder=8.0,
            path_effects=[withStroke(linewidth=4.0, foreground='white')],
        )
    )
    ax.text(
        north[0],
        north[1] + 0.006 * box.height,
        'N',
        ha='center',
        va='bottom',
        weight='bold',
        fontsize=9.0,
        path_effects=edge,
        zorder=8.0,
    )
