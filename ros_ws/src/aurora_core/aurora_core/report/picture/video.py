# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A run as an animated GIF: the bodies move over the map, a short trail behind each.

What happens is told below, and a message is a line between those who speak.
"""

from __future__ import annotations

import io
import textwrap
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from PIL import Image, ImageColor

from aurora_core.knowledge.world import WorldModel
from aurora_core.report.picture.ground import draw_ground
from aurora_core.report.picture.paper import MOST_WIDER, looks_of, shown, shown_ticks
from aurora_core.report.scene import style
from aurora_core.report.scene.story import Moment, Tone
from aurora_core.report.scene.tracks import Track, region_of, tracks_of, ways_of
from aurora_core.trace.records import LinkEventKind, LinkRecord
from aurora_core.trace.trace import Trace

_WIDTH_IN, _DPI = 8.0, 100
_ASPECTS = (1.0, 2.2)
# Frames are so far apart in simulated time and are shown at this multiple of it; a longer run
# gets fewer frames per second, so that the file stays small.
_FRAME_S = 0.2
_FASTER = 4.0
_MOST_FRAMES = 400
_TRAIL_S = 8.0
# In simulated time: how long a moment is told, and a message shown at least.
_TOLD_S, _MESSAGE_S = 6.0, 2.0
_MOST_LINES = 3
_PATCH_PX = 40
_NAME_PT, _LINE_PT = 8.0, 10.5
# As on the page of a run.
_ARRIVED, _LOST = '#9a5cc0', '#b51b1b'


def gif_bytes(trace: Trace, world: WorldModel, moments: tuple[Moment, ...] = ()) -> bytes:
    """Return the animation of a recorded run, four times as fast as it happened.

    It ends when the last UAV has landed and nothing happens any more.

    Args:
        trace: The run; who is absent is not drawn.
        world: Its world.
        moments: What happened, in order of time.
    """
    tracks = tracks_of(trace)
    dt_s = trace.roster.dt_s
    ticks = shown_ticks(tracks, moments, trace)
    stride = max(round(_FRAME_S / dt_s), -(-ticks // _MOST_FRAMES), 1)
    with mpl.rc_context(style.RC):
        places = (moment.place_m for moment in moments if moment.place_m is not None)
        box = region_of(tracks).with_places(places, MOST_WIDER)
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
        story = _Story(ax, moments, messages_of(trace, tracks), dt_s)
        frames = []
        for tick in range(0, ticks, stride):
            canvas.restore_region(ground)
            movers.draw(tick, tick * dt_s)
            story.draw(tick)
            image = Image.frombytes('RGBA', canvas.get_width_height(), canvas.buffer_rgba())
            frames.append(image.convert('RGB'))
    palette = _palette(frames[len(frames) // 2])
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


def _palette(frame: Image.Image) -> Image.Image:
    """Return one palette for all frames: colours that flicker would look like events.

    What is seldom seen, and thin, has patches of its colour in it.
    """
    width, height = frame.size
    sheet = Image.new('RGB', (width, height + 2 * _PATCH_PX))
    sheet.paste(frame, (0, 0))
    for row, colour in enumerate((_ARRIVED, _LOST)):
        top = height + row * _PATCH_PX
        sheet.paste(ImageColor.getrgb(colour), (0, top, width, top + _PATCH_PX))
    return sheet.quantize(128, dither=Image.Dither.NONE)


class _Movers:
    """The bodies, their trails and names, moved from frame to frame."""

    def __init__(self, ax: Axes, tracks: tuple[Track, ...], trail: int) -> None:
        self._ax = ax
        self._trail = trail
        # Left, right and height of the names of a frame, in points.
        self._taken: list[tuple[float, float, float]] = []
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
            label = ax.annotate(
                '', (0.0, 0.0), xytext=(0.0, 0.0), textcoords='offset points', fontsize=_NAME_PT,
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
        self._taken.clear()
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
                label.xyann = self._free(place, label.get_text(), above=track.is_uav)
                self._ax.draw_artist(label)
        self._clock.set_text(f'{time_s:.1f} s')
        self._ax.draw_artist(self._clock)

    def _free(self, place: tuple[float, float], text: str, *, above: bool) -> tuple[float, float]:
        """Return where a name has room, in points from its body: above who flies, else below."""
        x, y = self._ax.transData.transform(place) * 72.0 / _DPI
        step = _LINE_PT if above else -_LINE_PT
        offset = 8.0 if above else -13.0
        left, right = x + 5.0, x + 5.0 + 0.62 * _NAME_PT * len(text)
        while any(
            left < end and right > start and abs(y + offset - height) < _LINE_PT
            for start, end, height in self._taken
        ):
            offset += step
        self._taken.append((left, right, y + offset))
        return 5.0, offset


@dataclass(frozen=True, slots=True, kw_only=True)
class Message:
    """A message while it is shown.

    Attributes:
        first: Tick at which it is sent.
        last: Tick until which it is shown.
        arrived: It was delivered.
    """

    first: int
    last: int
    sender: Track
    receiver: Track
    arrived: bool


def messages_of(trace: Trace, tracks: tuple[Track, ...]) -> tuple[Message, ...]:
    """Return the messages between bodies, in the order in which they were sent."""
    bodies = {track.name: track for track in tracks}
    least = round(_MESSAGE_S / trace.roster.dt_s)
    ledger: dict[int, list[LinkRecord]] = {}
    for record in trace.links:
        if record.sender in bodies and record.receiver in bodies:
            ledger.setdefault(record.message, []).append(record)
    return tuple(
        Message(
            first=records[0].tick,
            last=max(records[-1].tick, records[0].tick + least),
            sender=bodies[records[0].sender],
            receiver=bodies[records[0].receiver],
            arrived=any(record.kind is LinkEventKind.DELIVERED for record in records),
        )
        for records in ledger.values()
    )


class _Story:
    """What happened last, in words, and who speaks with whom."""

    def __init__(
        self, ax: Axes, moments: tuple[Moment, ...], messages: tuple[Message, ...], dt_s: float
    ) -> None:
        self._ax = ax
        self._moments = [moment for moment in moments if moment.tick >= 0]
        self._messages = messages
        self._hold = round(_TOLD_S / dt_s)
        edge = [withStroke(linewidth=3.0, foreground='white')]
        self._words = ax.text(
            0.015, 0.03, '', transform=ax.transAxes, ha='left', va='bottom', fontsize=10.0,
            weight='bold', zorder=9.0, path_effects=edge, linespacing=1.4,
        )  # fmt: skip
        (self._line,) = ax.plot([], [], linewidth=2.2, linestyle=(0, (4, 2)), zorder=7.5)

    def draw(self, tick: int) -> None:
        """Draw onto what the canvas holds."""
        for message in self._messages:
            start, end = message.sender.at(tick), message.receiver.at(tick)
            if message.first <= tick <= message.last and start and end:
                self._line.set_data((start[0], end[0]), (start[1], end[1]))
                self._line.set_color(_ARRIVED if message.arrived else _LOST)
                self._ax.draw_artist(self._line)
        told = [m for m in self._moments if m.tick <= tick <= m.tick + self._hold][-_MOST_LINES:]
        self._words.set_text('\n'.join(textwrap.shorten(m.text, 80) for m in told))
        failed = any(moment.tone is Tone.FAILURE for moment in told)
        self._words.set_color(_LOST if failed else style.INK)
        self._ax.draw_artist(self._words)
