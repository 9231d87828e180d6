# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The strip under the map: altitude, and the distances that the request is about, over time."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes

from aurora_core.outcomes.condition import Condition
from aurora_core.report.picture.furniture import number_badge
from aurora_core.report.scene import style
from aurora_core.report.scene.story import Moment
from aurora_core.report.scene.tracks import Track
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import DistanceTrigger, ScenarioSpec
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.layout import UavPhase

FloatArray = npt.NDArray[np.float64]

_MOST_SERIES = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class Series:
    """A line of the lower diagram.

    Attributes:
        values: (T,) in `unit`, NaN where a body is absent.
        band: Where the line should be, None when nothing is asked.
        threshold: Crossing it is an event.
    """

    label: str
    values: FloatArray
    unit: str
    colour: str
    band: tuple[float, float] | None = None
    threshold: float | None = None


def series_of(
    tracks: tuple[Track, ...],
    conditions: tuple[Condition, ...],
    spec: ScenarioSpec | None,
    colours: dict[str, str],
    dt_s: float,
) -> tuple[Series, ...]:
    """Return the distances that missions, triggers and relations are about, else the speeds."""
    by_name = {track.name: track for track in tracks}
    found: dict[tuple[str, str], Series] = {}

    def add(a: str, b: str, *, flat: bool, colour: str, **marks: object) -> None:
        if a in by_name and b in by_name and (a, b) not in found and len(found) < _MOST_SERIES:
            delta = by_name[a].position_m - by_name[b].position_m
            axes = 2 if flat else 3
            values = np.sqrt((delta[:, :axes] ** 2).sum(axis=1))
            found[(a, b)] = Series(
                label=f'{a} – {b}',
                values=values,
                unit='m',
                colour=colour,
                band=marks.get('band'),  # type: ignore[arg-type]
                threshold=marks.get('threshold'),  # type: ignore[arg-type]
            )

    for condition in conditions:
        mission = condition.arguments.mission
        if mission is not None and mission.mode is MissionMode.TRACK and mission.target:
            low = max(0.0, mission.standoff_m - mission.standoff_tolerance_m)
            high = mission.standoff_m + mission.standoff_tolerance_m
            colour = colours.get(mission.uav, style.FAINT)
            add(mission.uav, mission.target, flat=True, colour=colour, band=(low, high))
    for event in spec.events if spec is not None else ():
        if isinstance(event.trigger, DistanceTrigger):
            trigger = event.trigger
            colour = colours.get(trigger.a, style.FAINT)
            add(trigger.a, trigger.b, flat=False, colour=colour, threshold=trigger.value_m.value)
    for condition in conditions:
        if condition.quantity in (QuantityName.RELATION_FRACTION, QuantityName.FOLLOW_FRACTION):
            a, b = condition.of[0], condition.of[-1]
            add(a, b, flat=True, colour=colours.get(a, style.FAINT))
    if found:
        return tuple(found.values())
    return speeds_of(tracks, colours, dt_s)


def speeds_of(
    tracks: tuple[Track, ...], colours: dict[str, str], dt_s: float
) -> tuple[Series, ...]:
    """Return the ground speeds of UAVs and named agents."""
    shown = [t for t in tracks if t.is_uav] + [
        t for t in tracks if not t.is_uav and not t.is_background
    ]
    found = []
    for track in shown[:_MOST_SERIES]:
        steps = np.diff(track.position_m[:, :2], axis=0)
        speed = np.sqrt((steps**2).sum(axis=1)) / dt_s
        found.append(
            Series(
                label=track.name,
                values=np.concatenate(([0.0], speed)),
                unit='m/s',
                colour=colours[track.name],
            )
        )
    return tuple(found)


def draw_altitude(
    ax: Axes,
    tracks: tuple[Track, ...],
    conditions: tuple[Condition, ...],
    colours: dict[str, str],
    dt_s: float,
) -> None:
    """Draw the altitude of every UAV with the band that is asked for and the phases."""
    uavs = [track for track in tracks if track.is_uav]
    for track in uavs:
        times = np.arange(len(track.position_m)) * dt_s
        ax.plot(
            times,
            track.position_m[:, 2],
            color=colours[track.name],
            linewidth=1.6,
            label=track.name,
            zorder=3.0,
        )
    for condition in conditions:
        mission = condition.arguments.mission
        flown = next((t for t in uavs if mission is not None and t.name == mission.uav), None)
        if flown is None or mission is None:
            continue
        phase = np.flatnonzero(flown.phase == UavPhase.MISSION + mission.index)
        if condition.quantity is QuantityName.ALTITUDE_FRACTION and len(phase):
            ax.fill_between(
                [phase[0] * dt_s, phase[-1] * dt_s],
                mission.altitude_m - mission.altitude_tolerance_m,
                mission.altitude_m + mission.altitude_tolerance_m,
                color='#1b7f4b',
                alpha=0.22,
                linewidth=0.0,
                zorder=2.0,
            )
    if uavs:
        shade_phases(ax, uavs[0].phase, dt_s)
    ax.set_ylim(bottom=-1.5)
    ax.margins(y=0.18)
    ax.set_ylabel('altitude\n[m]', fontsize=7.5)
    if len(uavs) > 1:
        ax.legend(loc='upper right', fontsize=6.5, frameon=False, ncols=len(uavs))


def shade_phases(
    ax: Axes, phases: FloatArray, dt_s: float, span_s: tuple[float, float] | None = None
) -> None:
    """Shade and name the phases of a flight.

    Args:
        ax: Axes of simulated time.
        phases: (T,) `UavPhase` by tick.
        dt_s: Time step.
        span_s: What the axes show, None for all of the run.
    """
    changes = [0, *(np.flatnonzero(np.diff(phases) != 0.0) + 1).tolist(), len(phases)]
    low_s, high_s = span_s if span_s is not None else (0.0, max(len(phases) * dt_s, dt_s))
    for start, end in pairwise(changes):
        phase = phases[start]
        if start == 0 and end - start <= 1:
            continue
        if phase == UavPhase.ASCENT:
            name, colour = 'ascent', '#f3f5f8'
        elif phase >= UavPhase.LANDING:
            name, colour = 'landing', '#f3f5f8'
        elif phase == UavPhase.HOLDING:
            name, colour = 'holding', '#f3f5f8'
        elif phase >= UavPhase.MISSION:
            name, colour = 'mission', '#e6f0ea'
        else:
            continue
        begin_s, until_s = max(start * dt_s, low_s), min(end * dt_s, high_s)
        if until_s <= begin_s:
            continue
        ax.axvspan(begin_s, until_s, color=colour, linewidth=0.0, zorder=0.5)
        if until_s - begin_s > 0.06 * (high_s - low_s):
            ax.text(
                (begin_s + until_s) / 2,
                0.05,
                name,
                transform=ax.get_xaxis_transform(),
                ha='center',
                va='bottom',
                fontsize=6.8,
                color=style.FAINT,
                zorder=2.5,
            )


def draw_series(ax: Axes, series: tuple[Series, ...], dt_s: float, mission_end: int) -> None:
    """Draw the distances (or speeds), what is asked of them, and name the lines.

    Args:
        ax: Axes of simulated time.
        series: Lines.
        dt_s: Time step.
        mission_end: Tick after which the lines do not set the scale any more.
    """
    for line in series:
        times = np.arange(len(line.values)) * dt_s
        ax.plot(times, line.values, color=line.colour, linewidth=1.6, label=line.label, zorder=3.0)
        if line.band is not None:
            ax.axhspan(*line.band, color=line.colour, alpha=0.10, linewidth=0.0, zorder=1.0)
        if line.threshold is not None:
            ax.axhline(
                line.threshold,
                color=line.colour,
                linewidth=0.9,
                linestyle=(0.0, (4.0, 3.0)),
                zorder=2.0,
            )
            ax.annotate(
                f'{line.threshold:g} m',
                (1.0, line.threshold),
                xycoords=('axes fraction', 'data'),
                xytext=(3.0, 0.0),
                textcoords='offset points',
                fontsize=6.8,
                color=line.colour,
                va='center',
                annotation_clip=False,
            )
    units = {line.unit for line in series}
    what = 'distance\n[m]' if units == {'m'} else 'speed\n[m/s]'
    ax.set_ylabel(what, fontsize=7.5)
    ax.set_xlabel('simulated time [s]', fontsize=7.5, labelpad=1.0)
    seen = [line.values[: mission_end + 1] for line in series]
    finite = [values[np.isfinite(values)] for values in seen]
    top = max((float(v.max()) for v in finite if len(v)), default=1.0)
    ax.set_ylim(0.0, top * 1.22 + 0.5)
    if series:
        ax.legend(
            loc='upper left', fontsize=6.8, frameon=False, ncols=len(series), borderaxespad=0.2
        )


def draw_moment_lines(axes: tuple[Axes, ...], moments: tuple[Moment, ...], dt_s: float) -> None:
    """Mark the numbered moments in all diagrams; the badges stand over the first one."""
    last_s, level = -1e9, 0
    low, high = axes[0].get_xlim()
    for number, moment in enumerate(moments, start=1):
        if moment.tick < 0:
            continue
        time_s = moment.tick * dt_s
        colour = style.TONE_COLOURS[moment.tone]
        for ax in axes:
            ax.axvline(time_s, color=colour, linewidth=0.8, alpha=0.55, zorder=1.5)
        level = level + 1 if time_s - last_s < 0.013 * (high - low) else 0
        last_s = time_s
        bottom, top = axes[0].get_ylim()
        y = top + (0.10 + 0.17 * level) * (top - bottom)
        number_badge(axes[0], time_s, y, number, colour, zorder=5.0)
