# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Compose the picture of a run and turn it into PNG or SVG, the same bytes every time."""

from __future__ import annotations

import io
import textwrap

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from aurora_core.judging.codec import conditions_from_json
from aurora_core.knowledge.world import WorldModel
from aurora_core.outcomes.condition import Condition
from aurora_core.report.picture.furniture import draw_scale
from aurora_core.report.picture.ground import draw_ground
from aurora_core.report.picture.panel import draw_panel, draw_tightest
from aurora_core.report.picture.paths import PathLayer
from aurora_core.report.picture.placing import Placer
from aurora_core.report.picture.placing import Rectangle as PlateRoom
from aurora_core.report.picture.strip import (
    draw_altitude,
    draw_moment_lines,
    draw_series,
    series_of,
    speeds_of,
)
from aurora_core.report.scene import style
from aurora_core.report.scene.caption import Caption
from aurora_core.report.scene.story import Moment, Tone, moments_of, realised_altitudes
from aurora_core.report.scene.tracks import (
    Box,
    Track,
    mission_end_tick,
    region_of,
    tracks_of,
    ways_of,
)
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind
from aurora_core.trace.trace import Trace

_SIZE_IN = (14.0, 9.6)
_MAP = (0.012, 0.268, 0.70, 0.605)
_PANEL = (0.722, 0.268, 0.268, 0.605)
_ALTITUDE = (0.052, 0.148, 0.66, 0.078)
_SERIES = (0.052, 0.045, 0.66, 0.096)
_TIGHT = (0.722, 0.022, 0.268, 0.215)
_PROMPT_LINES = 2
_LANE_PT = 2.6
# Room of scale bar and north arrow: left, bottom, width, height of the map's size.
_SCALE_ROOM = (0.01, 0.02, 0.21, 0.08)
_NORTH_ROOM = (0.005, 0.83, 0.05, 0.165)


def draw_picture(
    trace: Trace, world: WorldModel, caption: Caption, *, spec: ScenarioSpec | None = None
) -> Figure:
    """Draw a recorded run.

    Args:
        trace: The run; missing samples leave gaps.
        world: Its world.
        caption: Prompt and verdict.
        spec: The request, for the words of missions and triggers.
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=_SIZE_IN, facecolor=style.PAPER)
        FigureCanvasAgg(figure)
        tracks = tracks_of(trace)
        conditions = conditions_from_json(world.conditions_json)
        colours = style.colours_of(tracks)
        moments = moments_of(trace, tracks, spec, caption.failures, realised_altitudes(conditions))
        _header(figure, caption)
        _map(figure, trace, world, tracks, conditions, colours, moments, spec)
        draw_panel(figure.add_axes(_PANEL), tracks, colours, moments, trace)
        _diagrams(figure, trace, tracks, conditions, colours, moments, spec)
        if caption.tightest:
            draw_tightest(figure.add_axes(_TIGHT), caption)
        return figure


def png_bytes(figure: Figure, dpi: int = 120) -> bytes:
    """Return the picture as PNG without a date or version in it."""
    stream = io.BytesIO()
    with mpl.rc_context(style.RC):
        figure.savefig(stream, format='png', dpi=dpi, metadata={'Software': None})
    return stream.getvalue()


def svg_bytes(figure: Figure) -> bytes:
    """Return the picture as SVG without a date in it."""
    stream = io.BytesIO()
    with mpl.rc_context(style.RC):
        figure.savefig(stream, format='svg', metadata={'Date': None, 'Creator': None})
    return stream.getvalue()


def _header(figure: Figure, caption: Caption) -> None:
    lines = textwrap.wrap(f'“{" ".join(caption.prompt.split())}”', 104) or ['']
    if len(lines) > _PROMPT_LINES:
        lines = [*lines[: _PROMPT_LINES - 1], lines[_PROMPT_LINES - 1][:100] + ' …']
    figure.text(
        0.014, 0.981, '\n'.join(lines), fontsize=13.5, weight='bold', va='top', linespacing=1.25
    )
    if caption.status is None:
        return
    colour = style.STATUS_COLOURS[caption.status]
    word = caption.status.value.replace('_', ' ').upper()
    figure.text(
        0.988,
        0.978,
        word,
        fontsize=15.0,
        weight='bold',
        color='white',
        ha='right',
        va='top',
        bbox={'boxstyle': 'round,pad=0.38', 'facecolor': colour, 'edgecolor': 'none'},
    )
    figure.text(0.989, 0.932, caption.held, fontsize=10.0, color=colour, ha='right', va='top')


def _map(
    figure: Figure,
    trace: Trace,
    world: WorldModel,
    tracks: tuple[Track, ...],
    conditions: tuple[Condition, ...],
    colours: dict[str, str],
    moments: tuple[Moment, ...],
    spec: ScenarioSpec | None,
) -> None:
    ax = figure.add_axes(_MAP)
    width_pt = _MAP[2] * _SIZE_IN[0] * 72.0
    height_pt = _MAP[3] * _SIZE_IN[1] * 72.0
    box = region_of(tracks).with_aspect(width_pt / height_pt)
    scale = width_pt / box.width
    draw_ground(ax, world, box, scale, ways_of(tracks))
    layer = PathLayer(ax, box, scale, trace.roster.dt_s, Placer(width=width_pt, height=height_pt))
    layer.reserve(tracks)
    heights = [float(np.nanmax(t.position_m[:, 2])) for t in tracks if _flies(t)]
    norm = Normalize(0.0, max([10.0, *heights]))
    corner = _free_corner(tracks, box)
    layer.placer.taken += [
        PlateRoom(
            left=x * width_pt, bottom=y * height_pt, width=w * width_pt, height=h * height_pt
        )
        for x, y, w, h in (corner, _SCALE_ROOM, _NORTH_ROOM)
    ]
    layer.route(conditions)
    side: dict[str, float] = {}
    ribbon = None
    for track in tracks:
        if track.is_uav and _flies(track):
            ribbon = layer.uav(track, norm)
    agents = sorted((t for t in tracks if not t.is_uav), key=lambda t: not t.is_background)
    named = sum(not t.is_background for t in agents)
    for index, track in enumerate(agents[len(agents) - named :]):
        side[track.name] = _LANE_PT * (index - (named - 1) / 2)
    for track in agents:
        layer.agent(track, colours[track.name], side.get(track.name, 0.0))
    for track in tracks:
        if track.is_uav:
            layer.uav_ends(track)
    layer.pairs(_pairs(trace, tracks, spec))
    layer.moments(moments)
    draw_scale(ax, box)
    if ribbon is not None:
        _colour_bar(figure, ax, ribbon, box, corner)


def _flies(track: Track) -> bool:
    return track.is_uav and bool(np.isfinite(track.position_m[:, 2]).any())


def _pairs(
    trace: Trace, tracks: tuple[Track, ...], spec: ScenarioSpec | None
) -> list[tuple[Track, Track, int, str]]:
    """Return bodies to connect: both ends of a message, both bodies of a distance trigger."""
    by_name = {track.name: track for track in tracks}
    events = {event.id: event for event in spec.events} if spec else {}
    wanted: list[tuple[str, str, int, Tone]] = []
    for record in trace.links:
        if record.kind is LinkEventKind.SENT:
            wanted.append((record.sender, record.receiver, record.tick, Tone.EVENT))
    for event in trace.events:
        found = events.get(event.subject)
        if event.kind is ScenarioEventKind.TRIGGERED and found is not None:
            trigger = found.trigger
            if isinstance(trigger, DistanceTrigger):
                wanted.append((trigger.a, trigger.b, event.tick, Tone.EVENT))
    return [
        (by_name[a], by_name[b], tick, style.TONE_COLOURS[tone])
        for a, b, tick, tone in wanted
        if a in by_name and b in by_name
    ]


def _free_corner(tracks: tuple[Track, ...], box: Box) -> tuple[float, float, float, float]:
    """Return where the colour bar hides least: left, bottom, width, height of the map's size."""
    width, height = 0.235, 0.105
    corners = [(0.758, 0.015), (0.758, 0.88), (0.10, 0.88)]
    counts = []
    for left, bottom in corners:
        count = 0
        for track in tracks:
            x = (track.position_m[:, 0] - box.west) / box.width
            y = (track.position_m[:, 1] - box.south) / box.height
            inside = (x > left - 0.02) & (x < left + width + 0.02)
            inside &= (y > bottom - 0.03) & (y < bottom + height + 0.03)
            count += int(inside.sum())
        counts.append(count)
    left, bottom = corners[counts.index(min(counts))]
    return left, bottom, width, height


def _colour_bar(
    figure: Figure,
    ax: Axes,
    ribbon: LineCollection,
    box: Box,
    corner: tuple[float, float, float, float],
) -> None:
    left, bottom, width, height = corner
    ax.add_patch(_paper(box, left, bottom, width, height))
    inset = ax.inset_axes((left + 0.015, bottom + 0.034, width - 0.03, 0.020), zorder=9.0)
    bar = figure.colorbar(ribbon, cax=inset, orientation='horizontal')
    bar.outline.set_linewidth(0.0)
    inset.tick_params(labelsize=6.8, length=2.0, pad=1.5)
    inset.set_title('UAV altitude above ground [m]', fontsize=7.2, pad=3.0, color=style.INK)


def _paper(box: Box, left: float, bottom: float, width: float, height: float) -> Rectangle:
    """Return a white plate under an inset, in fractions of the map."""
    return Rectangle(
        (box.west + left * box.width, box.south + bottom * box.height),
        width * box.width,
        height * box.height,
        facecolor='white',
        edgecolor='#d5d8dd',
        linewidth=0.6,
        alpha=0.92,
        zorder=8.5,
    )


def _diagrams(
    figure: Figure,
    trace: Trace,
    tracks: tuple[Track, ...],
    conditions: tuple[Condition, ...],
    colours: dict[str, str],
    moments: tuple[Moment, ...],
    spec: ScenarioSpec | None,
) -> None:
    dt_s = trace.roster.dt_s
    top = figure.add_axes(_ALTITUDE)
    bottom = figure.add_axes(_SERIES, sharex=top)
    for ax in (top, bottom):
        ax.set_xlim(0.0, max(trace.ticks - 1, 1) * dt_s)
        ax.grid(axis='y', color='#e7e9ec', linewidth=0.6)
        ax.tick_params(labelsize=7.2, length=2.5, pad=2.0)
        for side in ('top', 'right'):
            ax.spines[side].set_visible(False)
    top.tick_params(labelbottom=False)
    end = mission_end_tick(tracks)
    if any(track.is_uav for track in tracks):
        draw_altitude(top, tracks, conditions, colours, dt_s)
    else:
        draw_series(top, speeds_of(tracks, colours, dt_s), dt_s, end)
        top.set_xlabel('')
    series = series_of(tracks, conditions, spec, colours, dt_s)
    draw_series(bottom, series, dt_s, end)
    draw_moment_lines((top, bottom), moments, dt_s)
