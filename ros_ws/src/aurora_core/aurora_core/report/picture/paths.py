# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who went where: trajectories, directions, take-off and landing, waypoints, numbered moments."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.patches import FancyArrowPatch
from matplotlib.patheffects import withStroke

from aurora_core.outcomes.condition import Condition
from aurora_core.report.picture.furniture import number_badge
from aurora_core.report.picture.placing import Placer
from aurora_core.report.scene import style
from aurora_core.report.scene.story import Moment
from aurora_core.report.scene.tracks import Box, Track, beside

FloatArray = npt.NDArray[np.float64]

ALTITUDES = LinearSegmentedColormap.from_list('altitudes', list(style.ALTITUDE_STEPS))
ARROW_EVERY_S = 10.0
_ARROW_LEAST_M = 4.0
_STILL_M = 1.0
_RIBBON_WIDTH = 9.5


class PathLayer:
    """Draws on axes in ENU metres whose labels must not cover each other.

    Args:
        ax: Axes.
        box: What is visible.
        points_per_m: Scale of the axes.
        dt_s: Time step.
        placer: Remembers the room that is taken, in points of the axes.
    """

    def __init__(
        self, ax: Axes, box: Box, points_per_m: float, dt_s: float, placer: Placer
    ) -> None:
        self.ax = ax
        self.box = box
        self.scale = points_per_m
        self.arrow_ticks = max(1, round(ARROW_EVERY_S / dt_s))
        self.placer = placer

    def reserve(self, tracks: tuple[Track, ...]) -> None:
        """Keep labels off the trajectories."""
        for track in tracks:
            points = track.position_m[::10, :2]
            points = points[np.isfinite(points).all(axis=1)]
            kept: list[tuple[float, float]] = []
            for x, y in points:
                at = self._points(float(x), float(y))
                # Standing still must not fill the list with one place.
                if not kept or abs(at[0] - kept[-1][0]) + abs(at[1] - kept[-1][1]) > 6.0:
                    kept.append(at)
            self.placer.keep_free(kept, 6.0)

    def uav(self, track: Track, norm: Normalize) -> LineCollection:
        """Draw a flight as a ribbon coloured by altitude, with take-off and landing spots."""
        points = track.position_m[::2]
        segments = np.stack((points[:-1, :2], points[1:, :2]), axis=1)
        altitude = (points[:-1, 2] + points[1:, 2]) / 2.0
        self.ax.plot(
            track.position_m[:, 0],
            track.position_m[:, 1],
            color='white',
            linewidth=_RIBBON_WIDTH + 3.0,
            solid_capstyle='round',
            solid_joinstyle='round',
            zorder=4.0,
        )
        ribbon = LineCollection(
            list(segments),
            cmap=ALTITUDES,
            norm=norm,
            linewidth=_RIBBON_WIDTH,
            capstyle='round',
            zorder=4.1,
        )
        ribbon.set_array(altitude)
        self.ax.add_collection(ribbon)
        self._arrows(track.position_m[:, :2], style.INK, 4.4, size=9.0)
        return ribbon

    def uav_ends(self, track: Track) -> None:
        """Mark where a UAV took off and where it came down."""
        flying = np.flatnonzero(track.airborne)
        if len(flying) == 0:
            return
        start = track.at(int(flying[0]))
        last = int(flying[-1])
        end = track.at(min(last + 1, len(track.position_m) - 1))
        if start is None:
            return
        if end is None or track.airborne[-1]:
            self._spot(start, '^', f'{track.name} take-off')
        elif (abs(end[0] - start[0]) + abs(end[1] - start[1])) * self.scale < 14.0:
            self._spot(start, '^', f'{track.name} take-off and landing')
        else:
            self._spot(start, '^', f'{track.name} take-off')
            self._spot(end, 'v', f'{track.name} landing')

    def agent(self, track: Track, colour: str, side_pt: float) -> None:
        """Draw the way of a ground agent from its start marker on.

        Args:
            track: Its way.
            colour: Its colour.
            side_pt: Shift to its left in points, so that agents in one lane do not hide each
                other.
        """
        wide = 1.2 if track.is_background else 2.2
        way = beside(track.position_m[:, :2], side_pt / self.scale)
        x, y = way[:, 0], way[:, 1]
        if not track.is_background:
            # Under the flights, so that a flight right above its target still shows.
            self.ax.plot(x, y, color='white', linewidth=wide + 2.0, alpha=0.9, zorder=3.9)
        self.ax.plot(x, y, color=colour, linewidth=wide, solid_capstyle='round', zorder=5.1)
        self._arrows(way, colour, 5.2, size=8.0 if track.is_background else 12.0)
        seen = np.flatnonzero(np.isfinite(x))
        if len(seen) == 0:
            return
        start = (float(x[seen[0]]), float(y[seen[0]]))
        if not self.box.holds(*start):
            return
        self.ax.plot(
            *start,
            marker='o',
            markersize=5.0 if track.is_background else 8.5,
            markerfacecolor=colour,
            markeredgecolor='white',
            markeredgewidth=1.2,
            zorder=6.0,
        )
        self._name(start, track.name, colour, small=track.is_background)
        moved = np.nanmax(np.abs(x - x[seen[0]]) + np.abs(y - y[seen[0]]))
        gone = int(seen[-1])
        if gone + 1 < len(x) and moved > _STILL_M:
            self.ax.plot(
                x[gone],
                y[gone],
                marker='X',
                markersize=9.0,
                markerfacecolor=colour,
                markeredgecolor='white',
                zorder=6.0,
            )

    def route(self, conditions: tuple[Condition, ...]) -> None:
        """Draw the planned points of patterns and hover missions."""
        done: set[str] = set()
        for condition in conditions:
            mission = condition.arguments.mission
            if mission is None or mission.mission in done:
                continue
            done.add(mission.mission)
            points = mission.waypoints
            if points:
                self.ax.plot(
                    [p[0] for p in points],
                    [p[1] for p in points],
                    color=style.INK,
                    linewidth=0.9,
                    linestyle=(0.0, (4.0, 3.0)),
                    zorder=4.3,
                )
                shown = points[:-1] if points[0] == points[-1] else points
                for number, point in enumerate(shown, start=1):
                    self._waypoint(point[0], point[1], str(number))
            elif mission.point_m is not None:
                self._waypoint(mission.point_m[0], mission.point_m[1], '+')

    def pairs(self, pairs: list[tuple[Track, Track, int, str]]) -> None:
        """Connect two bodies at a tick: a message on its way, a distance that was reached."""
        for a, b, tick, colour in pairs:
            start, end = a.at(tick), b.at(tick)
            if start is None or end is None:
                continue
            self.ax.plot(
                [start[0], end[0]],
                [start[1], end[1]],
                color=colour,
                linewidth=1.6,
                linestyle=(0.0, (2.0, 1.4)),
                zorder=6.2,
            )
            for x, y in (start, end):
                self.ax.plot(x, y, 'o', markersize=4.2, color=colour, zorder=6.3)

    def moments(self, moments: tuple[Moment, ...]) -> None:
        """Put the numbers of the moments beside their places."""
        for number, moment in enumerate(moments, start=1):
            if moment.place_m is None or not self.box.holds(*moment.place_m):
                continue
            colour = style.TONE_COLOURS[moment.tone]
            x, y = self._points(*moment.place_m)
            at = self.placer.place(x, y, 13.0, 13.0, 8.0)
            to = self._metres(*at)
            self.ax.plot(
                [moment.place_m[0], to[0]],
                [moment.place_m[1], to[1]],
                color=colour,
                linewidth=0.9,
                zorder=7.0,
            )
            self.ax.plot(*moment.place_m, marker='o', markersize=3.6, color=colour, zorder=7.0)
            number_badge(self.ax, to[0], to[1], number, colour, zorder=7.2)

    def _arrows(self, position: FloatArray, colour: str, zorder: float, size: float) -> None:
        """Arrow heads at equal times: close together means slow."""
        last: FloatArray | None = None
        for tick in range(self.arrow_ticks, len(position), self.arrow_ticks):
            here, before = position[tick], position[max(tick - 10, 0)]
            step = here - before
            length = float(np.sqrt((step**2).sum()))
            if not np.isfinite(length) or length < 0.3 or not self.box.holds(*here):
                continue
            if last is not None and float(np.sqrt(((here - last) ** 2).sum())) < _ARROW_LEAST_M:
                continue
            last = here
            tail = here - step / length * (3.0 / self.scale)
            self.ax.add_patch(
                FancyArrowPatch(
                    tuple(tail),
                    tuple(here),
                    arrowstyle='-|>',
                    mutation_scale=size,
                    color=colour,
                    linewidth=0.0,
                    shrinkA=0.0,
                    shrinkB=0.0,
                    zorder=zorder,
                    path_effects=[withStroke(linewidth=1.4, foreground='white')],
                )
            )

    def _waypoint(self, x: float, y: float, label: str) -> None:
        self.ax.plot(
            x,
            y,
            marker='D',
            markersize=10.0,
            markerfacecolor='white',
            markeredgecolor=style.INK,
            markeredgewidth=1.2,
            zorder=4.5,
        )
        self.ax.annotate(
            label,
            (x, y),
            fontsize=6.5,
            ha='center',
            va='center_baseline',
            zorder=4.6,
            annotation_clip=True,
        )
        at = self._points(x, y)
        self.placer.keep_free([at], 12.0)

    def _spot(self, place: tuple[float, float], marker: str, text: str) -> None:
        self.ax.plot(
            *place,
            marker=marker,
            markersize=10.0,
            markerfacecolor='#ffffff',
            markeredgecolor=style.INK,
            markeredgewidth=1.6,
            zorder=6.5,
        )
        self._name(place, text, style.INK, small=False)

    def _name(self, place: tuple[float, float], text: str, colour: str, *, small: bool) -> None:
        size = 6.5 if small else 8.5
        x, y = self._points(*place)
        width, height = 0.62 * size * len(text), 1.25 * size
        at = self._metres(*self.placer.place(x, y, width, height, 6.0))
        self.ax.text(
            *at,
            text,
            color=colour,
            fontsize=size,
            weight='normal' if small else 'bold',
            ha='center',
            va='center',
            clip_on=True,
            zorder=7.1,
            path_effects=[withStroke(linewidth=2.6, foreground='white')],
        )

    def _points(self, x_m: float, y_m: float) -> tuple[float, float]:
        return (x_m - self.box.west) * self.scale, (y_m - self.box.south) * self.scale

    def _metres(self, x: float, y: float) -> tuple[float, float]:
        return self.box.west + x / self.scale, self.box.south + y / self.scale
