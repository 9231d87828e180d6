# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Beside the map: what happened, the legend, the tightest margins."""

from __future__ import annotations

import textwrap

from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from aurora_core.report.picture.furniture import number_badge
from aurora_core.report.picture.ground import HEIGHTS, TALL_M
from aurora_core.report.picture.paths import ALTITUDES, ARROW_EVERY_S
from aurora_core.report.scene import style
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.story import Moment, Tone
from aurora_core.report.scene.tracks import Track
from aurora_core.report.status import Status
from aurora_core.trace.trace import Trace


def draw_panel(
    ax: Axes,
    tracks: tuple[Track, ...],
    colours: dict[str, str],
    moments: tuple[Moment, ...],
    trace: Trace,
) -> None:
    """Write the numbered moments and the legend beside the map."""
    ax.set_xlim(0.0, 1.0)
    ax.set_ylim(0.0, 1.0)
    ax.set_axis_off()
    if moments:
        ax.text(0.02, 0.985, 'What happened', fontsize=11.0, weight='bold', va='top')
    y = 0.925
    for number, moment in enumerate(moments, start=1):
        colour = style.TONE_COLOURS[moment.tone]
        lines = textwrap.wrap(moment.text, 36)[:3] or ['']
        number_badge(ax, 0.035, y - 0.008, number, colour, zorder=3.0)
        when = '' if moment.tick < 0 else f'{trace.time_s(moment.tick):.1f} s'
        ax.text(0.225, y, when, fontsize=8.6, va='top', ha='right', color=style.FAINT)
        strong = moment.tone in (Tone.FAILURE, Tone.FAULT)
        ax.text(
            0.245,
            y,
            '\n'.join(lines),
            fontsize=8.6,
            va='top',
            color=colour if strong else style.INK,
            linespacing=1.15,
        )
        y -= 0.020 + 0.0245 * len(lines)
    _legend(ax, tracks, colours)


def _legend(ax: Axes, tracks: tuple[Track, ...], colours: dict[str, str]) -> None:
    handles: list[Line2D | Patch] = []
    background = [t for t in tracks if not t.is_uav and t.is_background]
    for track in tracks:
        if not track.is_uav and not track.is_background:
            handles.append(
                Line2D(
                    [],
                    [],
                    color=colours[track.name],
                    linewidth=2.4,
                    marker='o',
                    markersize=6.0,
                    markeredgecolor='white',
                    label=f'{track.name} ({track.entry.type_name}), ● start',
                )
            )
    if background:
        names = f'background traffic ({len(background)})'
        handles.append(Line2D([], [], color=style.BACKGROUND_AGENT, linewidth=1.2, label=names))
    if any(t.is_uav for t in tracks):
        flight = ALTITUDES(0.9)
        handles += [
            Line2D([], [], color=flight, linewidth=6.0, label='UAV path, coloured by altitude'),
            Line2D(
                [],
                [],
                linestyle='none',
                marker='^',
                markersize=8.0,
                markerfacecolor='white',
                markeredgecolor=style.INK,
                label='take-off (▲), landing (▼)',
            ),
        ]
    handles += [
        Line2D(
            [],
            [],
            linestyle='none',
            marker='>',
            markersize=6.0,
            color=style.FAINT,
            label=f'direction, every {ARROW_EVERY_S:g} s',
        ),
        Patch(facecolor=HEIGHTS(0.15), edgecolor=style.BUILDING_EDGE, label='building, low'),
        Patch(
            facecolor=HEIGHTS(1.0),
            edgecolor=style.BUILDING_EDGE,
            label=f'building, {TALL_M:g} m and more',
        ),
        Patch(
            facecolor='#fbe9e8',
            edgecolor=style.NO_FLY,
            hatch='///',
            linestyle='--',
            label='no-fly zone',
        ),
        Line2D(
            [],
            [],
            color=style.CROSSING,
            linewidth=5.0,
            linestyle=(0.0, (0.3, 0.3)),
            label='crossing',
        ),
        Line2D(
            [],
            [],
            linestyle='none',
            marker='s',
            markersize=6.5,
            color='#2b2f36',
            label='traffic lights',
        ),
    ]
    ax.legend(
        handles=handles,
        loc='lower left',
        bbox_to_anchor=(0.0, -0.01),
        fontsize=7.4,
        frameon=False,
        ncols=1 if len(handles) <= 9 else 2,
        columnspacing=1.0,
        handlelength=1.8,
        labelspacing=0.55,
        borderaxespad=0.0,
    )


def draw_tightest(ax: Axes, caption: Caption) -> None:
    """List the conditions that are nearest to their edge, with their margins."""
    ax.set_xlim(0.0, 1.0)
    ax.set_ylim(0.0, 1.0)
    ax.set_axis_off()
    ax.text(0.02, 0.985, 'Tightest margins', fontsize=11.0, weight='bold', va='top')
    y = 0.86
    for row in caption.tightest:
        lines = textwrap.wrap(row.sentence, 50)[:2]
        if y - 0.07 * len(lines) < 0.0:
            break
        colour = style.STATUS_COLOURS[Status.VERIFIED if row.satisfied else Status.VIOLATED]
        ax.text(
            0.215, y, row.margin, fontsize=7.8, weight='bold', color=colour, ha='right', va='top'
        )
        ax.text(0.24, y, '\n'.join(lines), fontsize=7.8, va='top', linespacing=1.1)
        y -= 0.035 + 0.068 * len(lines)
