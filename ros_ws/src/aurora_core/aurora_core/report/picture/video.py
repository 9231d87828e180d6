# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run as an animated GIF: the bodies move over the map, a short trail behind each."""

from __future__ import annotations

import io
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from PIL import Image

from aurora_core.knowledge.world import WorldModel
from aurora_core.report.picture.ground import draw_ground
from aurora_core.report.picture.paper import looks_of, shown
from aurora_core.report.scene import style
from aurora_core.report.scene.tracks import Track, region_of, tracks_of, ways_of
from aurora_core.trace.trace import Trace

_WIDTH_IN, _DPI = 8.0, 100
_ASPECTS = (1.0, 2.2)
# Frames are so far apart in simulated time and are shown at this multiple of it; a longer run
# gets fewer frames per second, so that the file stays small.
_FRAME_S = 0.2
_FASTER = 4.0
_MOST_FRAMES = 400
_TRAIL_S = 8.0


def gif_bytes(trace: Trace, world: WorldModel) -> bytes:
    """Return the animation of a recorded run, four times as fast as it happened.

    Args:
        trace: The run; who is absent is not drawn.
        world: Its world.
    """
    tracks = tracks_of(trace)
    dt_s = trace.roster.dt_s
    stride = max(round(_FRAME_S / dt_s), -(-trace.ticks // _MOST_FRAMES), 1)
    with mpl.rc_context(style.RC):
        box = region_of(tracks)
        box = box.with_aspect(min(max(box.width / box.height, _ASPECTS[0]), _ASPECTS[1]))
        size = (_WIDTH_IN, _WIDTH_IN * box.height / box.width)
        figure = Figure(figsize=size, dpi=_DPI, facecolor=style.GROUND)
        canvas: Any = FigureCanvasAgg(figure)
        ax = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        ax.set_axis_off()
        scale = _WIDTH_IN * 72.0 / box.width
        draw_ground(ax, world, box, scale, ways_of(tracks))
        canvas.draw()
        ground = canvas.copy_from_bbox(figure.bbox)
        movers = _Movers(ax, tracks, max(1, round(_TRAIL_S / dt_s)))
        frames = []
        for tick in range(0, trace.ticks, stride):
            canvas.restore_region(ground)
            movers.draw(tick, tick * dt_s)
            image = Image.frombytes('RGBA', canvas.get_width_height(), canvas.buffer_rgba())
            frames.append(image.convert('RGB'))
    # One palette for all frames: colours that flicker would look like events.
    palette = frames[len(frames) // 2].quantize(128, dither=Image.Dither.NONE)
    few = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames]
    stream = io.BytesIO()
    few[0].save(
        stream,
        format='GIF',
        save_all=True,
        append_images=few[1:],
        duration=max(20, round(1000.0 * stride * dt_s / _FASTER)),
        loop=0,
    )
    return stream.getvalue()


class _Movers:
    """The bodies, their trails and names, moved from frame to frame."""

    def __init__(self, ax: Axes, tracks: tuple[Track, ...], trail: int) -> None:
        self._ax = ax
        self._trail = trail
        looks = looks_of(tracks)
        self._rows = []
        names = {track.name for track in shown(tracks)}
        for track in tracks:
            colour = looks[track.name][0] if track.name in names else style.BACKGROUND_AGENT
            marker = '^' if track.is_uav else 'o'
            size = 9.0 if track.name in names else 5.0
            (line,) = ax.plot([], [], color=colour, linewidth=2.0, alpha=0.7, zorder=5.0)
            (dot,) = ax.plot(
                [], [], marker=marker, color=colour, markersize=size, markeredgecolor='white',
                zorder=6.0 + track.is_uav,
            )  # fmt: skip
            # Who flies over somebody is named above, who drives below.
            above = 8.0 if track.is_uav else -13.0
            label = ax.annotate(
                '', (0.0, 0.0), xytext=(5.0, above), textcoords='offset points', fontsize=8.0,
                color=colour, weight='bold', zorder=8.0, annotation_clip=True,
                path_effects=[withStroke(linewidth=2.0, foreground='white')],
            )  # fmt: skip
            self._rows.append((track, track.name in names, line, dot, label))
        self._clock = ax.text(
            0.985, 0.975, '', transform=ax.transAxes, ha='right', va='top', fontsize=13.0,
            weight='bold', zorder=9.0,
            path_effects=[withStroke(linewidth=3.0, foreground='white')],
        )  # fmt: skip

    def draw(self, tick: int, time_s: float) -> None:
        """Draw a moment onto what the canvas holds."""
        for track, named, line, dot, label in self._rows:
            tail = track.position_m[max(0, tick - self._trail) : tick + 1, :2]
            line.set_data(tail[:, 0], tail[:, 1])
            place = track.at(tick)
            dot.set_data(*(([place[0]], [place[1]]) if place else ([], [])))
            for artist in (line, dot):
                self._ax.draw_artist(artist)
            if named and place is not None:
                height = f' {track.position_m[tick, 2]:.0f} m' if track.is_uav else ''
                label.set_text(track.name + height)
                label.xy = place
                self._ax.draw_artist(label)
        self._clock.set_text(f'{time_s:.1f} s')
        self._ax.draw_artist(self._clock)
