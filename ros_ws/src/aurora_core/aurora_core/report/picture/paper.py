# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A figure of a run for a paper: no title, one colour per body, altitude as a strip below.

What the numbers mean is left to the figure's caption; `moment_lines` has the words for it.
"""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from typing import Literal

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_pdf import FigureCanvasPdf
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from scipy.spatial import cKDTree

from aurora_core.judging.codec import conditions_from_json
from aurora_core.knowledge.world import WorldModel
from aurora_core.report.picture.ground import draw_ground
from aurora_core.report.picture.placing import Placer
from aurora_core.report.picture.strip import speeds_of
from aurora_core.report.scene import style
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.story import Moment, moments_of, realised_altitudes
from aurora_core.report.scene.tracks import Box, FloatArray, Track, region_of, tracks_of, ways_of
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.trace.trace import Trace

# Width of one and of two columns of a page. Source: IEEE author centre, preparing graphics.
WIDTHS_IN = {1: 3.5, 2: 7.16}
# By columns: narrower or wider than this a map is no figure any more; width / height.
_ASPECTS = {1: (0.9, 2.6), 2: (1.4, 4.5)}
# What happens beside the flights is shown while the map grows no more than this by it.
MOST_WIDER = 2.5
# Room on a page is dear: closer to what happens than on the screen.
_LEAST_SIDE_M = 70.0
_STRIP_IN = 0.75
_LEFT_IN, _RIGHT_IN, _XLABEL_IN, _BADGES_IN = 0.36, 0.06, 0.32, 0.18
_LEGEND_ROW_IN = 0.14
_LEGEND_COLUMN_IN = 1.15
# Numbers nearer to each other than this share one badge.
_PILE_PT = 11.0
_BADGE_PT = 5.2
# Width of a way, by how much one is wider than the one that covers it, and the greatest.
_THIN_PT, _STEP_PT, _THICK_PT = 1.1, 0.9, 3.8
# With a greater share of it under another one, a way would be hidden.
_COVERED = 0.1
# After the last moment, as a share of the time until then.
_AFTER = 0.04
# Told apart also by people who see few colours, in colour and in grey (Okabe and Ito, without the
# yellow); from the eighth body on the lines are dashed.
_COLOURS = ('#0072b2', '#d55e00', '#009e73', '#a3337f', '#56b4e9', '#e69f00', '#000000')
_RC = {
    **style.RC,
    'font.size': 7.0,
    'axes.linewidth': 0.6,
    'xtick.major.width': 0.5,
    'ytick.major.width': 0.5,
    # Text stays text: journals want embedded TrueType, not outlines.
    'pdf.fonttype': 42,
}


def draw_paper(
    trace: Trace,
    world: WorldModel,
    caption: Caption,
    *,
    spec: ScenarioSpec | None = None,
    columns: int = 1,
) -> Figure:
    """Draw a recorded run for print.

    Args:
        trace: The run; missing samples leave gaps.
        world: Its world.
        caption: Of it only what failed is drawn.
        spec: The request, for the words of the moments.
        columns: Key of `WIDTHS_IN`.
    """
    with mpl.rc_context(_RC):
        tracks = tracks_of(trace)
        looks = looks_of(tracks)
        width_in = WIDTHS_IN[columns]
        moments = told_moments(trace, world, tracks, spec, caption)
        places = (moment.place_m for moment in moments if moment.place_m is not None)
        box = region_of(tracks, _LEAST_SIDE_M).with_places(places, MOST_WIDER)
        narrowest, widest = _ASPECTS[columns]
        aspect = min(max(box.width / box.height, narrowest), widest)
        box = box.with_aspect(aspect)
        map_in = (width_in, width_in / aspect)
        ncols = max(1, int(width_in / _LEGEND_COLUMN_IN))
        rows = -(-len(looks) // ncols)
        legend_in = rows * _LEGEND_ROW_IN + 0.06
        below_in = legend_in + _BADGES_IN + _STRIP_IN + _XLABEL_IN
        height_in = map_in[1] + below_in
        figure = Figure(figsize=(width_in, height_in), facecolor='white')
        FigureCanvasPdf(figure)
        ax = figure.add_axes((0.0, below_in / height_in, 1.0, map_in[1] / height_in))
        _map(ax, world, tracks, looks, moments, box, map_in[0] * 72.0 / box.width)
        strip = figure.add_axes(
            (
                _LEFT_IN / width_in,
                _XLABEL_IN / height_in,
                1.0 - (_LEFT_IN + _RIGHT_IN) / width_in,
                _STRIP_IN / height_in,
            )
        )
        _strip(strip, tracks, looks, trace.roster.dt_s, shown_ticks(tracks, moments, trace))
        _strip_moments(strip, moments, trace.roster.dt_s, (width_in - _LEFT_IN - _RIGHT_IN) * 72.0)
        if looks:
            figure.legend(
                handles=[_handle(track, looks[track.name]) for track in shown(tracks)],
                loc='upper left',
                bbox_to_anchor=(0.0, below_in / height_in),
                ncols=ncols,
                fontsize=6.5,
                frameon=False,
                borderaxespad=0.2,
                handlelength=1.8,
                columnspacing=1.0,
                labelspacing=0.2,
            )
        return figure


def moment_lines(
    trace: Trace, world: WorldModel, caption: Caption, spec: ScenarioSpec | None
) -> tuple[str, ...]:
    """Return what the numbers of the figure stand for, one line each."""
    lines = []
    for number, moment in enumerate(
        told_moments(trace, world, tracks_of(trace), spec, caption), start=1
    ):
        when = '' if moment.tick < 0 else f'{trace.time_s(moment.tick):.1f} s: '
        lines.append(f'{number}  {when}{moment.text}')
    return tuple(lines)


def paper_bytes(figure: Figure, suffix: str) -> bytes:
    """Return the figure as a file of a kind, the same bytes every time.

    Args:
        figure: As `draw_paper` gives it.
        suffix: '.pdf', '.svg' or '.png' (600 dots per inch).
    """
    nothing = {
        '.pdf': {'CreationDate': None, 'Creator': None, 'Producer': None},
        '.svg': {'Date': None, 'Creator': None},
        '.png': {'Software': None},
    }
    stream = io.BytesIO()
    with mpl.rc_context(_RC):
        figure.savefig(stream, format=suffix[1:], dpi=600, metadata=nothing[suffix])
    return stream.getvalue()


def told_moments(
    trace: Trace,
    world: WorldModel,
    tracks: tuple[Track, ...],
    spec: ScenarioSpec | None,
    caption: Caption,
) -> tuple[Moment, ...]:
    """Return what happened, with the altitudes that missions were grounded to."""
    altitudes = realised_altitudes(conditions_from_json(world.conditions_json))
    return moments_of(trace, tracks, spec, caption.failures, altitudes)


Look = tuple[str, Literal['-', '--', ':']]


def shown(tracks: tuple[Track, ...]) -> list[Track]:
    """UAVs first: they are what the strip tells of."""
    return [t for t in tracks if t.is_uav] + [
        t for t in tracks if not t.is_uav and not t.is_background
    ]


def looks_of(tracks: tuple[Track, ...]) -> dict[str, Look]:
    """Return colour and line style by body; no two are alike."""
    styles: tuple[Literal['-', '--', ':'], ...] = ('-', '--', ':')
    return {
        track.name: (
            _COLOURS[k % len(_COLOURS)], styles[min(k // len(_COLOURS), len(styles) - 1)]
        )
        for k, track in enumerate(shown(tracks))
    }  # fmt: skip


def _handle(track: Track, look: Look) -> Line2D:
    marker = '^' if track.is_uav else 'o'
    return Line2D(
        [], [], color=look[0], linestyle=look[1], linewidth=1.4, marker=marker, markersize=3.5,
        markeredgecolor='white', markeredgewidth=0.4, label=track.name,
    )  # fmt: skip


def _map(
    ax: Axes,
    world: WorldModel,
    tracks: tuple[Track, ...],
    looks: dict[str, Look],
    moments: tuple[Moment, ...],
    box: Box,
    points_per_m: float,
) -> None:
    draw_ground(ax, world, box, points_per_m, ways_of(tracks))
    # Names and signs of the ground are sized for a picture four times as wide.
    for text in ax.texts:
        text.set_fontsize(min(float(text.get_fontsize()), 5.0))
    for line in ax.lines:
        line.set_markersize(min(float(line.get_markersize()), 3.0))
    placer = Placer(width=box.width * points_per_m, height=box.height * points_per_m)
    for track in tracks:
        if track.is_background:
            x, y = track.position_m[:, 0], track.position_m[:, 1]
            ax.plot(x, y, color=style.BACKGROUND_AGENT, linewidth=0.5, zorder=3.0)
    # UAVs on top, in the order of the legend.
    lowest_first = shown(tracks)[::-1]
    lowest_first.sort(key=lambda track: track.is_uav)
    widths = way_widths(lowest_first, points_per_m)
    for rank, track in enumerate(lowest_first):
        _way(ax, track, looks[track.name], rank, widths[track.name])
        points = track.position_m[::40, :2]
        points = points[np.isfinite(points).all(axis=1)]
        at = (points - (box.west, box.south)) * points_per_m
        placer.keep_free(((float(x), float(y)) for x, y in at), 4.0)
    _map_moments(ax, moments, box, points_per_m, placer)
    _scale(ax, box)


def way_widths(lowest_first: Sequence[Track], points_per_m: float) -> dict[str, float]:
    """Return how wide the way of each body is drawn, in points: wider than what covers it.

    Args:
        lowest_first: In the order in which they are drawn.
        points_per_m: Scale of the map.
    """
    ways = {track.name: _standing_out(track) for track in lowest_first}
    widths: dict[str, float] = {}
    for track in reversed(lowest_first):
        own = ways[track.name]
        covering = [
            widths[name]
            for name in widths
            if len(own)
            and len(ways[name])
            and (cKDTree(ways[name]).query(own)[0] * points_per_m < _STEP_PT).mean() > _COVERED
        ]
        widest = max(covering, default=_THIN_PT - _STEP_PT)
        widths[track.name] = min(widest + _STEP_PT, _THICK_PT)
    return widths


def _standing_out(track: Track) -> FloatArray:
    """Return the points of a way, one per metre at most, so that who stands does not count."""
    points = track.position_m[:, :2]
    points = points[np.isfinite(points).all(axis=1)]
    cells = np.unique(np.round(points), axis=0)
    return np.asarray(cells, dtype=np.float64)


def _way(ax: Axes, track: Track, look: Look, rank: int, width_pt: float) -> None:
    """Draw where a body went: start marked, the end an arrow head (UAV: its landing)."""
    colour, dashes = look
    x, y = track.position_m[:, 0], track.position_m[:, 1]
    # White edges lie beneath all ways, so that none hides another one.
    ax.plot(x, y, color='white', linewidth=width_pt + 1.2, zorder=3.5, solid_capstyle='round')
    ax.plot(
        x, y, color=colour, linestyle=dashes, linewidth=width_pt, zorder=4.0 + 0.05 * rank,
        solid_capstyle='round',
    )  # fmt: skip
    rank_of_ends = 6.0 if track.is_uav else 5.5
    here = np.flatnonzero(np.isfinite(x) & np.isfinite(y))
    if len(here) == 0:
        return
    first, last = int(here[0]), int(here[-1])
    kind = '^' if track.is_uav else 'o'
    ax.plot(
        x[first], y[first], marker=kind, color=colour, markersize=4.5, markeredgecolor='white',
        markeredgewidth=0.5, zorder=rank_of_ends + 0.1,
    )  # fmt: skip
    # The last point that is far enough away gives the direction of the head.
    back = np.flatnonzero(np.hypot(x - x[last], y - y[last]) > 2.0)
    if len(back) and not track.is_uav:
        ax.annotate(
            '', (x[last], y[last]), (x[back[-1]], y[back[-1]]),
            arrowprops={
                'arrowstyle': '-|>', 'color': colour, 'lw': 1.0,
                'mutation_scale': 4.5 + 2.0 * width_pt, 'shrinkA': 0.0, 'shrinkB': 0.0,
            },
            zorder=rank_of_ends,
        )  # fmt: skip
    elif track.is_uav:
        ax.plot(
            x[last], y[last], marker='v', color='white', markersize=3.5, markeredgecolor=colour,
            markeredgewidth=0.8, zorder=rank_of_ends + 0.2,
        )  # fmt: skip


def piles(points: Iterable[tuple[float, float]], reach: float) -> list[list[int]]:
    """Group points, in their order, that are too near to the first of a group to stand alone.

    Args:
        points: In points of the axes.
        reach: Nearer than this (in either axis: both) they share a place.

    Returns:
        Indices by group.
    """
    firsts: list[tuple[float, float]] = []
    groups: list[list[int]] = []
    for index, (x, y) in enumerate(points):
        for (ax, ay), group in zip(firsts, groups, strict=True):
            if abs(ax - x) < reach and abs(ay - y) < reach:
                group.append(index)
                break
        else:
            firsts.append((x, y))
            groups.append([index])
    return groups


def numbers(members: Iterable[int]) -> str:
    """Return numbers in a few characters: 1, 2, 3, 5 as '1–3,5'."""
    runs: list[list[int]] = []
    for number in members:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ','.join(
        str(run[0]) if len(run) == 1 else f'{run[0]}{"," if len(run) == 2 else "–"}{run[-1]}'
        for run in runs
    )


def _badge_width(text: str) -> float:
    return _BADGE_PT * (1.0 + 0.62 * len(text))


def _badge(ax: Axes, x: float, y: float, text: str, *, clip: bool = True) -> None:
    ax.text(
        x, y, text, fontsize=_BADGE_PT, color='white', weight='bold', ha='center',
        va='center_baseline', zorder=9.0, clip_on=clip,
        bbox={
            'boxstyle': 'round,pad=0.25,rounding_size=0.6', 'facecolor': style.INK,
            'edgecolor': 'white', 'linewidth': 0.5,
        },
    )  # fmt: skip


def _map_moments(
    ax: Axes, moments: tuple[Moment, ...], box: Box, points_per_m: float, placer: Placer
) -> None:
    placed = [
        (number, moment.place_m)
        for number, moment in enumerate(moments, start=1)
        if moment.place_m is not None and box.holds(*moment.place_m)
    ]
    at = [((x - box.west) * points_per_m, (y - box.south) * points_per_m) for _, (x, y) in placed]
    for group in piles(at, _PILE_PT):
        text = numbers(placed[k][0] for k in group)
        x, y = at[group[0]]
        size = _badge_width(text), 1.7 * _BADGE_PT
        bx, by = placer.place(x, y, *size, gap=4.0)
        mx, my = bx / points_per_m + box.west, by / points_per_m + box.south
        place = placed[group[0]][1]
        ax.plot([place[0], mx], [place[1], my], color=style.INK, linewidth=0.5, zorder=8.0)
        ax.plot(*place, marker='o', markersize=1.3, color=style.INK, zorder=8.0)
        _badge(ax, mx, my, text)


def _scale(ax: Axes, box: Box) -> None:
    length = next(s for s in (10, 20, 50, 100, 200, 500, 1000, 2000) if s >= box.width / 8.0)
    x, y = box.west + 0.03 * box.width, box.south + 0.05 * box.height
    edge = [withStroke(linewidth=2.5, foreground='white')]
    ax.plot(
        [x, x + length], [y, y], color=style.INK, linewidth=1.4, solid_capstyle='butt',
        zorder=8.5, path_effects=edge,
    )  # fmt: skip
    ax.annotate(
        f'{length} m', (x + length / 2, y), xytext=(0.0, 2.0), textcoords='offset points',
        ha='center', va='bottom', fontsize=5.5, zorder=8.5, path_effects=edge,
    )  # fmt: skip
    ax.annotate(
        'N', (box.west + 0.03 * box.width, box.north - 0.03 * box.height),
        xytext=(0.0, -15.0), textcoords='offset points', ha='center', va='top', fontsize=5.5,
        arrowprops={'arrowstyle': '-|>', 'color': style.INK, 'lw': 0.8, 'mutation_scale': 6.0},
        zorder=8.5, path_effects=edge,
    )  # fmt: skip


def shown_ticks(tracks: tuple[Track, ...], moments: tuple[Moment, ...], trace: Trace) -> int:
    """Return until when a run is shown: nobody needs to see an empty end."""
    ends = [moment.tick for moment in moments]
    for track in tracks:
        if track.is_uav:
            ends += np.flatnonzero(track.airborne)[-1:].tolist()
    if not any(track.is_uav for track in tracks):
        return trace.ticks
    return min(trace.ticks, int((1.0 + _AFTER) * max(ends, default=trace.ticks)) + 2)


def _strip(
    ax: Axes, tracks: tuple[Track, ...], looks: dict[str, Look], dt_s: float, ticks: int
) -> None:
    """Draw altitude over time, or the speeds when nobody flies."""
    times_s = np.arange(ticks) * dt_s
    uavs = [track for track in tracks if track.is_uav]
    if uavs:
        ax.set_ylabel('altitude [m]', fontsize=6.5, labelpad=2.0)
        lines = [(track.name, track.position_m[:, 2]) for track in uavs]
    else:
        ax.set_ylabel('speed [m/s]', fontsize=6.5, labelpad=2.0)
        colours = {track.name: style.INK for track in tracks}
        lines = [(s.label, s.values) for s in speeds_of(tracks, colours, dt_s)]
    for name, values in lines:
        colour, dashes = looks[name]
        ax.plot(
            times_s[: len(values)], values[:ticks], color=colour, linestyle=dashes, linewidth=1.0
        )
    ax.set_xlabel('simulated time [s]', fontsize=6.5, labelpad=1.5)
    ax.set_xlim(0.0, max(ticks - 1, 1) * dt_s)
    ax.set_ylim(bottom=0.0)
    ax.tick_params(labelsize=6.0, length=2.0, pad=1.5)
    ax.grid(axis='y', color='#e2e4e8', linewidth=0.4)
    ax.spines[['top', 'right']].set_visible(False)


def _strip_moments(ax: Axes, moments: tuple[Moment, ...], dt_s: float, width_pt: float) -> None:
    """Mark the moments; numbers that would touch share a badge over the first of them."""
    end_s = ax.get_xlim()[1]
    timed = [(n, m.tick * dt_s) for n, m in enumerate(moments, start=1) if m.tick >= 0]
    for _, time_s in timed:
        ax.axvline(time_s, color=style.INK, linewidth=0.4, alpha=0.5, zorder=1.0)
    # A badge of several numbers is wide: room for it before the next begins.
    groups: list[list[int]] = []
    right_pt = -1e9
    for number, time_s in timed:
        at = time_s / end_s * width_pt
        if groups and at < right_pt:
            groups[-1].append(number)
        else:
            groups.append([number])
        first = dict(timed)[groups[-1][0]] / end_s * width_pt
        right_pt = first + _badge_width(numbers(groups[-1])) + 3.0
    top = ax.get_ylim()[1]
    starts = dict(timed)
    for group in groups:
        _badge(ax, starts[group[0]], top * 1.12, numbers(group), clip=False)
