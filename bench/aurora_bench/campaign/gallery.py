# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The paper's figures of single runs, from the folders of runs: maps, views, one run whole."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from aurora_bench.campaign.sketch import area_patch, draw_view, faces_of, looks_at, streets_of
from aurora_bench.plotting import COLOURS, new_figure, save_as
from aurora_bench.results import ResultsError, write_whole
from aurora_core.agsg.message import read_agsg
from aurora_core.files import DOCUMENT_BYTES, read_json
from aurora_core.outcomes.agsg import Agsg, NodeType
from aurora_core.report.run_report import RunReport
from aurora_core.spec.vocabulary import MissionMode
from aurora_core.trace.bag_content import BagContent
from aurora_core.trace.bag_reader import read_bag
from aurora_core.trace.definitions import message_definitions
from aurora_core.trace.layout import GroundColumn, UavColumn, UavCommandColumn, UavPhase
from aurora_core.trace.records import LinkEventKind, ScenarioEventKind

_FONT = 7.0
_WIDTH_IN = 7.2
_VIEWS = 6
_ROOM_M = 40.0
_STYLES = {'ego': COLOURS[0], 'target': COLOURS[1], 'background': COLOURS[7]}


@dataclass(frozen=True, slots=True, kw_only=True)
class Shown:
    """A run as figures need it."""

    report: RunReport
    content: BagContent
    agsg: Agsg

    @property
    def target(self) -> int | None:
        """Row of the agent that its first UAV follows."""
        missions = self.agsg.spec.missions
        name = missions[0].target if missions else None
        roster = self.content.trace.roster
        return None if name is None else roster.agent_index(str(name))

    @property
    def mode(self) -> MissionMode | None:
        """Of its first mission."""
        missions = self.agsg.spec.missions
        return missions[0].mode if missions else None


def read_run(folder: Path) -> Shown:
    """Return what figures need of a run folder.

    Raises:
        ResultsError: There is no executed run.
    """
    try:
        report = RunReport.model_validate(read_json(folder / 'report.json', DOCUMENT_BYTES))
    except (OSError, ValueError) as err:
        raise ResultsError(f'{folder} is no run folder: {err}') from err
    if report.trace is None:
        raise ResultsError(f'{folder}: nothing was executed ({report.status.value})')
    content = read_bag(folder / report.trace.bag, message_definitions())
    return Shown(report=report, content=content, agsg=read_agsg(content.agsg_message))


def draw_gallery(folders: Sequence[Path], out: Path) -> tuple[Path, ...]:
    """Write the figures of some runs: views, maps, and the first one whole.

    Args:
        folders: Run folders with a UAV.
        out: Where to.

    Raises:
        ResultsError: A folder holds no executed run with a UAV, or a file cannot be written.
    """
    runs = [read_run(folder) for folder in folders]
    for folder, run in zip(folders, runs, strict=True):
        if not run.content.trace.roster.uavs:
            raise ResultsError(f'{folder}: no UAV takes part')
    drawn = (
        (
            'views',
            _views(runs),
            'Projected sketches of the scene from the UAV, six times over each execution, with '
            'the request: streets, buildings and boxes of bodies (blue: ego, orange: target). No '
            'camera is simulated.',
        ),
        (
            'maps',
            _maps(runs),
            'Grounded scenarios on the map: ways of ground agents and UAVs as they were driven '
            'and flown, planned waypoints as crosses.',
        ),
        (
            'graphs',
            _graphs(runs),
            'Scenario graphs of the grounded runs: typed nodes and the dependencies between them, '
            'without conditions.',
        ),
        (
            'missions',
            _missions(runs),
            'Flights by phase: ascent, mission, holding, landing; altitude over time.',
        ),
        (
            'example',
            _example(runs[0]),
            'One run: the request, its scenario graph, the grounded trajectories, and what was '
            'monitored over time.',
        ),
    )
    paths: list[Path] = []
    for name, figure, caption in drawn:
        paths += save_as(figure, out, name, ('pdf', 'svg', 'png'))
        paths.append(out / f'{name}.txt')
        write_whole(paths[-1], f'{caption}\n'.encode())
    return tuple(paths)


def _views(runs: Sequence[Shown]) -> Figure:
    figure, axes = new_figure(
        _WIDTH_IN, 1.25 * len(runs), panels=_VIEWS, rows=len(runs), font_size=_FONT
    )
    for k, run in enumerate(runs):
        trace, streets = run.content.trace, streets_of(run.content.world)
        airborne = np.flatnonzero(trace.uav[:, 0, UavColumn.Z] > 2.0)
        first, last = (int(airborne[0]), int(airborne[-1])) if len(airborne) else (0, 1)
        for n, tick in enumerate(np.linspace(first, last, _VIEWS).round().astype(int).tolist()):
            ax = axes[k * _VIEWS + n]
            camera = looks_at(trace, 0, run.target, tick)
            draw_view(ax, camera, faces_of(run.content.world, trace, tick, camera.eye), streets)
            ax.set_xlabel(f'{trace.time_s(tick):.1f} s', labelpad=1)
        words = textwrap.wrap(f'({chr(97 + k)}) “{run.report.prompt}”', 125)
        _titled(axes[k * _VIEWS], '\n'.join(words))
    return figure


def _titled(ax: Axes, text: str) -> None:
    """Put words above a panel, which may be wider than it: an empty title keeps the room."""
    ax.set_title('\n'.join(' ' for _ in text.split('\n')), fontsize=_FONT + 0.5)
    note = ax.annotate(
        text, (0.0, 1.0), xytext=(0, 3), xycoords='axes fraction', textcoords='offset points',
        fontsize=_FONT + 0.5, va='bottom',
    )  # fmt: skip
    note.set_in_layout(False)


def _maps(runs: Sequence[Shown]) -> Figure:
    figure, axes = new_figure(
        _WIDTH_IN, 0.6 + _WIDTH_IN / len(runs), panels=len(runs), font_size=_FONT
    )
    for k, (ax, run) in enumerate(zip(axes, runs, strict=True)):
        _map(ax, run)
        _titled(ax, f'({chr(97 + k)})' + ('' if run.mode is None else f' {run.mode.value}'))
    for role, hue in (*_STYLES.items(), ('other', COLOURS[2])):
        axes[0].plot([], [], color=hue, label=role)
    axes[0].plot([], [], color='black', linestyle='--', label='UAV')
    axes[0].plot([], [], color=COLOURS[3], linestyle='', marker='x', label='waypoint')
    figure.legend(
        *axes[0].get_legend_handles_labels(), loc='outside lower center', ncols=6, fontsize=_FONT
    )
    return figure


def _graphs(runs: Sequence[Shown]) -> Figure:
    figure, axes = new_figure(
        _WIDTH_IN, 0.3 + _WIDTH_IN / len(runs), panels=len(runs), font_size=_FONT
    )
    for k, (ax, run) in enumerate(zip(axes, runs, strict=True)):
        _graph(ax, run.agsg)
        _titled(ax, f'({chr(97 + k)})' + ('' if run.mode is None else f' {run.mode.value}'))
    return figure


def _missions(runs: Sequence[Shown]) -> Figure:
    figure, axes = new_figure(_WIDTH_IN, 2.0, panels=len(runs), font_size=_FONT)
    phases = {'ascent': UavPhase.ASCENT, 'holding': UavPhase.HOLDING, 'landing': UavPhase.LANDING}
    for k, (ax, run) in enumerate(zip(axes, runs, strict=True)):
        trace = run.content.trace
        times = np.arange(trace.ticks) * trace.roster.dt_s
        phase = trace.uav_commands[:, 0, UavCommandColumn.PHASE]
        flies = (phase >= UavPhase.MISSION) & (phase < UavPhase.HOLDING)
        parts = {**{name: phase == p for name, p in phases.items()}, 'mission': flies}
        for hue, (name, here) in zip(COLOURS, parts.items(), strict=False):
            altitude_m = np.where(here, trace.uav[:, 0, UavColumn.Z], np.nan)
            ax.plot(times, altitude_m, color=hue, linewidth=1.6, label=name)
        ax.set_xlabel('simulated time [s]')
        _titled(ax, f'({chr(97 + k)})' + ('' if run.mode is None else f' {run.mode.value}'))
    axes[0].set_ylabel('altitude [m]')
    axes[0].legend(fontsize=_FONT - 1)
    return figure


def _map(ax: Axes, run: Shown) -> None:
    world, trace = run.content.world, run.content.trace
    ax.add_patch(area_patch(streets_of(world), '#d5d8db'))
    rings = [np.asarray(b.ring) for b in world.buildings]
    ax.add_collection(PolyCollection(rings, facecolors='#c9c1b8'))
    ax.grid(visible=False)
    points = []
    for row, entry in enumerate(trace.roster.agents):
        here = trace.ground[trace.ground[:, row, GroundColumn.PRESENT] > 0.5, row, :2]
        if not len(here):
            continue
        hue = _STYLES.get(entry.role, COLOURS[2])
        ax.plot(*here.T, color=hue, linewidth=1.2)
        ax.plot(*here[0], marker='o', markersize=3, color=hue)
        if entry.role != 'background':
            points.append(here[:1])
    for row in range(len(trace.roster.uavs)):
        way = trace.uav[:, row, :2]
        ax.plot(*way.T, color='black', linewidth=0.9, linestyle='--')
        points.append(way)
    schedule = run.agsg.schedule
    for facts in () if schedule is None else schedule.facts.missions:
        marks = np.array([p[:2] for p in facts.waypoints]).reshape(-1, 2)
        ax.plot(*marks.T, linestyle='', marker='x', markersize=4, color=COLOURS[3])
    every = np.concatenate(points)
    (west, south), (east, north) = every.min(axis=0), every.max(axis=0)
    half = max(east - west, north - south) / 2.0 + _ROOM_M
    x, y = (west + east) / 2.0, (south + north) / 2.0
    ax.set_xlim(x - half, x + half)
    ax.set_ylim(y - half, y + half)
    ax.set_aspect('equal')
    ax.set_xlabel('east [m]')
    ax.set_ylabel('north [m]')


def _example(run: Shown) -> Figure:
    figure, axes = new_figure(_WIDTH_IN, 5.2, panels=2, rows=2, font_size=_FONT)
    words, graph, ways, times = axes
    words.axis('off')
    told = [f'“{run.report.prompt}”', '', f'{run.report.status.value}: {run.report.summary}', '']
    told.append('Conditions with the least normalised margins:')
    judged = [c for c in run.report.conditions if c.normalised is not None]
    for row in sorted(judged, key=lambda c: c.normalised or 0.0)[:6]:
        told.append(f'{row.margin:+.2f} {row.unit}: {row.sentence}')
    text = '\n'.join(line for one in told for line in (textwrap.wrap(one, 66) or ['']))
    words.text(0.0, 1.0, text, va='top', fontsize=_FONT - 0.5).set_in_layout(False)
    _graph(graph, run.agsg)
    _map(ways, run)
    _over_time(times, run)
    titles = (
        '(a) request and verdict', '(b) scenario graph, without conditions', '(c) trajectories',
        '(d) over time',
    )  # fmt: skip
    for ax, title in zip(axes, titles, strict=True):
        _titled(ax, title)
    return figure


def _graph(ax: Axes, agsg: Agsg) -> None:
    """Draw the typed nodes on a circle, with the edges between them."""
    nodes = [n for n in agsg.nodes if n.type is not NodeType.CONDITION]
    angle = np.linspace(0.0, 2.0 * np.pi, len(nodes), endpoint=False) + np.pi / 2.0
    points = np.column_stack((np.cos(angle), np.sin(angle)))
    place = {n.id: point for n, point in zip(nodes, points, strict=True)}
    pairs = sorted({(e.source, e.target) for e in agsg.edges})
    lines = [(place[a], place[b]) for a, b in pairs if a in place and b in place and a != b]
    ax.add_collection(LineCollection(lines, colors='#999999', linewidths=0.7))
    hues = dict(zip(NodeType, COLOURS, strict=False))
    for node in nodes:
        ax.plot(*place[node.id], marker='o', markersize=7, color=hues[node.type])
        ax.annotate(node.id, 1.16 * place[node.id], ha='center', va='center', fontsize=_FONT - 1)
    for kind in dict.fromkeys(n.type for n in nodes):
        ax.plot([], [], linestyle='', marker='o', color=hues[kind], label=kind.value)
    ax.legend(fontsize=_FONT - 1.5, loc='lower center', ncols=3)
    ax.set_xlim(-1.5, 1.5)
    ax.set_ylim(-2.0, 1.3)
    ax.axis('off')


def _over_time(ax: Axes, run: Shown) -> None:
    """Draw altitude and distance to the target, and mark events and messages."""
    trace = run.content.trace
    times = np.arange(trace.ticks) * trace.roster.dt_s
    ax.plot(times, trace.uav[:, 0, UavColumn.Z], color='black', linestyle='--', label='altitude')
    if run.target is not None:
        apart = trace.uav[:, 0, :2] - trace.ground[:, run.target, :2]
        # While it flies for it: who has landed is left behind.
        flown = trace.uav_commands[:, 0, UavCommandColumn.PHASE] < UavPhase.HOLDING
        apart_m = np.where(flown, np.linalg.norm(apart, axis=1), np.nan)
        ax.plot(times, apart_m, color=COLOURS[1], label='UAV to target')
    for event in trace.events:
        if event.kind in (ScenarioEventKind.PHASE, ScenarioEventKind.TRIGGERED):
            hue = COLOURS[7] if event.kind is ScenarioEventKind.PHASE else COLOURS[3]
            label = event.detail if event.kind is ScenarioEventKind.PHASE else event.subject
            _mark(ax, trace.time_s(event.tick), hue, label)
    for link in trace.links:
        if link.kind is LinkEventKind.DELIVERED:
            _mark(ax, trace.time_s(link.tick), COLOURS[2], f'{link.event} delivered')
    ax.set_xlabel('simulated time [s]')
    ax.set_ylabel('metres')
    ax.legend(fontsize=_FONT - 1, loc='upper right')


def _mark(ax: Axes, time_s: float, hue: str, label: str) -> None:
    ax.axvline(time_s, color=hue, linewidth=0.8)
    ax.annotate(
        label, (time_s, 0.02), xycoords=('data', 'axes fraction'), rotation=90,
        fontsize=_FONT - 2, va='bottom', ha='right',
    )  # fmt: skip
