# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a grounding: where a request would happen, and where else it was looked for."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Protocol

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PatchCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Rectangle
from matplotlib.patheffects import withStroke

from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.world import SurfaceKind
from aurora_core.mission.plan import MissionPlan, UavPlan
from aurora_core.outcomes.grounded import GroundedAgent, GroundedScenario
from aurora_core.report.picture.furniture import draw_scale
from aurora_core.report.picture.ground import draw_ground, outline
from aurora_core.report.picture.map_picture import ground_of_map
from aurora_core.report.scene import style
from aurora_core.report.scene.tracks import Box
from aurora_core.spec.reference import LANDMARK
from aurora_core.spec.scenario import ScenarioSpec

_SIZE_IN = (14.0, 10.4)
_AXES = (0.01, 0.06, 0.98, 0.85)
_INSET = (0.73, 0.07, 0.255, 0.24)
_BAR = (0.80, 0.026, 0.17, 0.012)
_MARGIN_M = 60.0
_LEAST_M = 240.0
# Names keep clear of ways that are told by points so far apart.
_CLOSE_M = 2.0
# Names of UAVs that fly so near to each other stand one above the other.
_SAME_SPOT_M = 20.0
_LINE_PT = 11.0
# So much of an agent's route is drawn: the rest is far from the scene.
_ROUTE_M = 400.0
_SCORES = LinearSegmentedColormap.from_list('scores', ['#c9b8e8', '#7a3fa0', '#2b0f57'])
_UNFIT = '#8b8f96'
_SIGHT = '#b3123f'
_LINK = '#00805f'

Point = tuple[float, float]


class Tried(Protocol):
    """A site that was looked at; `grounding.sites.TriedSite` is one."""

    @property
    def x_m(self) -> float:
        """East."""

    @property
    def y_m(self) -> float:
        """North."""

    @property
    def joint(self) -> float | None:
        """Score, None where it is not fit."""


def draw_check(
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    model: MapModel,
    tried: Sequence[Tried] = (),
    result: str = '',
) -> Figure:
    """Draw a grounded request: agents with routes, flights, sight lines, links, other anchors.

    Args:
        spec: The request.
        grounded: Where it was placed.
        model: Its map.
        tried: Every site that was looked at.
        result: Word of the check, above the map.
    """
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=_SIZE_IN, facecolor=style.PAPER)
        FigureCanvasAgg(figure)
        ax = figure.add_axes(_AXES)
        flights = _Flights(grounded)
        box = _box(grounded, model, flights)
        ax.set_aspect('equal')
        scale = _AXES[2] * _SIZE_IN[0] * 72.0 / box.width
        lines = [*map(_route, grounded.agents), *map(flights.way, grounded.uavs)]
        ways = np.array([p for line in lines for p in _between(line)]).reshape(-1, 2)
        draw_ground(ax, ground_of_map(model), box, scale, ways)
        places = {f'{LANDMARK}{m.name}': (m.x_m, m.y_m) for m in model.places}
        places |= {a.id: (a.x_m, a.y_m) for a in grounded.agents}
        places |= {u.id: flights.spot(u, u.missions[0]) for u in grounded.uavs if u.missions}
        _anchors(ax, tried)
        if tried:
            _score_bar(figure)
            if not _shows_all(box, model):
                _whole_map(figure, box, model, tried)
        _agents(ax, grounded.agents)
        _flown(ax, grounded.uavs, flights)
        _sight(ax, grounded.uavs, places, flights)
        _links(ax, spec, places)
        buildings = {f'{LANDMARK}{b.name}' for b in model.buildings}
        _named(ax, {n: p for n, p in places.items() if n not in buildings}, grounded.uavs)
        draw_scale(ax, box)
        _words(figure, spec, grounded, tried, result)
        return figure


def _box(grounded: GroundedScenario, model: MapModel, flights: _Flights) -> Box:
    """Return what is visible: all starts and flights, with room around."""
    points = [(a.x_m, a.y_m) for a in grounded.agents if a.role != 'background']
    points += [p for a in grounded.agents if a.role != 'background' for p in _route(a)]
    points += [p for u in grounded.uavs for p in flights.way(u)]
    if not points:
        west, south, east, north = model.bounds_m
        return Box(west=west, south=south, east=east, north=north)
    across, along = [p[0] for p in points], [p[1] for p in points]
    spare = max(_MARGIN_M, (_LEAST_M - (max(across) - min(across))) / 2.0)
    box = Box(
        west=min(across) - spare,
        south=min(along) - _MARGIN_M,
        east=max(across) + spare,
        north=max(along) + _MARGIN_M,
    )
    return box.with_aspect(_AXES[2] * _SIZE_IN[0] / (_AXES[3] * _SIZE_IN[1]))


def _route(agent: GroundedAgent) -> list[Point]:
    """Return the first part of an agent's route, from where it stands."""
    if agent.parked or len(agent.route_xy_m) < 2:
        return []
    line = np.asarray(agent.route_xy_m)
    nearest = int(np.argmin(np.hypot(line[:, 0] - agent.x_m, line[:, 1] - agent.y_m)))
    points: list[Point] = [(agent.x_m, agent.y_m)]
    left = _ROUTE_M
    for x_m, y_m in line[nearest + 1 :]:
        step = float(np.hypot(x_m - points[-1][0], y_m - points[-1][1]))
        if step > left:
            break
        left -= step
        points.append((float(x_m), float(y_m)))
    return points


def _between(line: Sequence[Point]) -> Iterator[Point]:
    """Yield points along a line, so close that no name fits between them."""
    for (x_m, y_m), (to_x_m, to_y_m) in pairwise(line):
        steps = max(1, round(math.hypot(to_x_m - x_m, to_y_m - y_m) / _CLOSE_M))
        for k in range(steps + 1):
            yield x_m + (to_x_m - x_m) * k / steps, y_m + (to_y_m - y_m) * k / steps


class _Flights:
    """Where UAVs are at the beginning of their missions."""

    def __init__(self, grounded: GroundedScenario) -> None:
        self._agents = {a.id: a for a in grounded.agents}

    def spot(self, uav: UavPlan, mission: MissionPlan) -> Point:
        """Return where a mission begins, as it is planned for t = 0."""
        if mission.waypoints:
            return mission.waypoints[0][0], mission.waypoints[0][1]
        if mission.hover_point is not None:
            return mission.hover_point[0], mission.hover_point[1]
        target = self._agents.get(mission.target or '')
        if target is None:
            return uav.home_x_m, uav.home_y_m
        east_m, north_m = mission.offset_from((target.heading_x, target.heading_y))
        return target.x_m + east_m, target.y_m + north_m

    def way(self, uav: UavPlan) -> list[Point]:
        """Return the way of a UAV: its home, and what is planned of its missions."""
        points: list[Point] = [(uav.home_x_m, uav.home_y_m)]
        for mission in uav.missions:
            if not mission.is_placed:
                continue
            legs = [(w[0], w[1]) for w in mission.waypoints]
            points += legs or [self.spot(uav, mission)]
        return points


def _shows_all(box: Box, model: MapModel) -> bool:
    """Tell whether a picture shows the whole map."""
    west, south, east, north = model.bounds_m
    across = box.west <= west and east <= box.west + box.width
    return across and box.south <= south and north <= box.south + box.height


def _whole_map(figure: Figure, box: Box, model: MapModel, tried: Sequence[Tried]) -> None:
    """Draw all anchors on the whole map, and which part of it the picture shows."""
    west, south, east, north = model.bounds_m
    inset = figure.add_axes(_INSET, zorder=9.0)
    inset.set_xlim(west, east)
    inset.set_ylim(south, north)
    inset.set_aspect('equal', anchor='SE')
    inset.set_xticks([])
    inset.set_yticks([])
    inset.set_autoscale_on(False)
    inset.set_facecolor(style.GROUND)
    roads = [
        PathPatch(outline(s.ring, s.holes))
        for s in ground_of_map(model).surfaces
        if s.kind is SurfaceKind.DRIVING
    ]
    inset.add_collection(
        PatchCollection(roads, facecolor=style.ROAD, edgecolor=style.ROAD_EDGE, linewidth=0.3)
    )
    _anchors(inset, tried, small=True)
    corner = (box.west, box.south)
    inset.add_patch(
        Rectangle(corner, box.width, box.height, fill=False, edgecolor=style.INK, zorder=7.0)
    )


def _score_bar(figure: Figure) -> None:
    shades = ScalarMappable(Normalize(vmin=0.0, vmax=1.0), _SCORES)
    bar = figure.add_axes(_BAR)
    figure.colorbar(shades, cax=bar, orientation='horizontal')
    bar.tick_params(labelsize=7.0)
    bar.set_title('score of an anchor', fontsize=7.5, color=style.FAINT, pad=3.0)


def _anchors(ax: Axes, tried: Sequence[Tried], *, small: bool = False) -> None:
    size = 0.5 if small else 1.0
    unfit = [(t.x_m, t.y_m) for t in tried if t.joint is None]
    if unfit:
        ax.plot(*zip(*unfit, strict=True), 'x', color=_UNFIT, markersize=5.0 * size, zorder=6.0)
    fit = [t for t in tried if t.joint is not None]
    if not fit:
        return
    ax.scatter(
        [t.x_m for t in fit],
        [t.y_m for t in fit],
        c=[t.joint or 0.0 for t in fit],
        cmap=_SCORES,
        norm=Normalize(vmin=0.0, vmax=1.0),
        s=46.0 * size * size,
        edgecolors='white',
        linewidths=0.8 * size,
        zorder=6.1,
    )
    best = max(fit, key=lambda t: t.joint or 0.0)
    ax.plot(
        best.x_m,
        best.y_m,
        'o',
        markersize=13.0 * size,
        markerfacecolor='none',
        markeredgecolor='#2b0f57',
        markeredgewidth=1.8 * size,
        zorder=6.2,
    )


def _agents(ax: Axes, agents: Sequence[GroundedAgent]) -> None:
    known = [a for a in agents if a.role != 'background']
    for agent in (a for a in agents if a.role == 'background'):
        ax.plot(agent.x_m, agent.y_m, 's', color=_UNFIT, markersize=4.0, zorder=6.4)
    for k, agent in enumerate(known):
        colour = style.AGENT_COLOURS[k % len(style.AGENT_COLOURS)]
        route = _route(agent)
        if route:
            ax.plot(*zip(*route, strict=True), color=colour, linewidth=2.4, alpha=0.8, zorder=6.5)
            ax.annotate(
                '', route[-1], route[-2], zorder=6.5,
                arrowprops={'arrowstyle': '-|>', 'color': colour, 'linewidth': 1.6},
            )  # fmt: skip
        ax.plot(
            agent.x_m, agent.y_m, 's', color=colour, markeredgecolor='white', markersize=8.0,
            zorder=7.0,
        )  # fmt: skip
        _label(ax, (agent.x_m, agent.y_m), agent.id, colour, -11.0)


def _flown(ax: Axes, uavs: Sequence[UavPlan], flights: _Flights) -> None:
    named: list[Point] = []
    for k, uav in enumerate(uavs):
        colour = style.UAV_COLOURS[k % len(style.UAV_COLOURS)]
        way = flights.way(uav)
        ax.plot(*zip(*way, strict=True), color=colour, linewidth=1.8, linestyle='--', zorder=7.2)
        ax.plot(*way[0], '^', color=colour, markeredgecolor='white', markersize=8.0, zorder=7.3)
        told: dict[Point, list[str]] = {}
        for mission in (m for m in uav.missions if m.is_placed):
            told.setdefault(flights.spot(uav, mission), []).append(f'{mission.altitude_m:.0f}')
        for spot, heights in told.items():
            # A ring, so that who is below it can be seen.
            ax.plot(
                *spot, 'o', markerfacecolor='none', markeredgecolor=colour, markeredgewidth=2.2,
                markersize=13.0, zorder=7.3,
            )  # fmt: skip
            # Who flies above another one is named above it.
            lines = sum(math.dist(spot, other) < _SAME_SPOT_M for other in named)
            named.append(spot)
            above_pt = 9.0 + _LINE_PT * lines
            _label(ax, spot, f'{uav.id} {"/".join(heights)} m', colour, above_pt)


def _sight(ax: Axes, uavs: Sequence[UavPlan], places: dict[str, Point], flights: _Flights) -> None:
    for uav in uavs:
        for mission in uav.missions:
            target = places.get(mission.target or '')
            if target is not None:
                spot = flights.spot(uav, mission)
                ax.plot(
                    [spot[0], target[0]], [spot[1], target[1]], color=_SIGHT, linewidth=1.1,
                    linestyle=(0, (1, 1.6)), zorder=6.9,
                )  # fmt: skip


def _links(ax: Axes, spec: ScenarioSpec, places: dict[str, Point]) -> None:
    for link in spec.links:
        ends = places.get(link.sender), places.get(link.receiver)
        if ends[0] is not None and ends[1] is not None:
            ax.annotate(
                '', ends[1], ends[0], zorder=6.8,
                arrowprops={
                    'arrowstyle': '-|>', 'color': _LINK, 'linewidth': 1.4, 'shrinkA': 7.0,
                    'shrinkB': 7.0, 'connectionstyle': 'arc3,rad=0.18',
                },
            )  # fmt: skip


def _named(ax: Axes, places: dict[str, Point], uavs: Sequence[UavPlan]) -> None:
    """Name the landmarks that flights are at, where no building has the name already."""
    targets = dict.fromkeys(m.target for u in uavs for m in u.missions if m.target in places)
    for target in (t for t in targets if t is not None and t.startswith(LANDMARK)):
        _label(ax, places[target], target.removeprefix(LANDMARK), style.FAINT, -11.0)


def _label(ax: Axes, point: Point, text: str, colour: str, below_pt: float) -> None:
    ax.annotate(
        text, point, xytext=(0.0, below_pt), textcoords='offset points', ha='center',
        va='bottom' if below_pt > 0.0 else 'top', fontsize=8.5, weight='bold', color=colour,
        path_effects=[withStroke(linewidth=2.6, foreground='white')], zorder=8.5,
    )  # fmt: skip


def _words(
    figure: Figure,
    spec: ScenarioSpec,
    grounded: GroundedScenario,
    tried: Sequence[Tried],
    result: str,
) -> None:
    words = f'“{" ".join(spec.prompt.split())}”'
    lines = textwrap.wrap(words, 112, max_lines=2, placeholder=' …”')
    figure.text(0.012, 0.985, '\n'.join(lines), fontsize=12.5, weight='bold', va='top')
    fit = sum(t.joint is not None for t in tried)
    anchors = f'{len(tried)} anchor{"" if len(tried) == 1 else "s"} tried, {fit} fit'
    place = f'{grounded.map_name}, seed {grounded.seed}: {anchors}'
    figure.text(0.012, 0.925, f'{result}  {place}'.strip(), fontsize=9.5, color=style.FAINT)
    figure.legend(
        handles=list(_legend()), loc='lower left', bbox_to_anchor=(0.008, 0.004), ncols=4,
        frameon=False, fontsize=8.0, columnspacing=1.4, handlelength=2.2,
    )  # fmt: skip


def _legend() -> Iterator[Line2D]:
    ink = style.INK
    yield Line2D([], [], color=ink, marker='s', label='ground agent and its route')
    yield Line2D([], [], color=ink, linestyle='--', marker='^', label='UAV from its start')
    yield Line2D(
        [], [], color=ink, marker='o', markerfacecolor='none', linestyle='', label='its missions'
    )
    yield Line2D([], [], color=_SIGHT, linestyle=(0, (1, 1.6)), label='sight line at the start')
    yield Line2D([], [], color=_LINK, label='message link')
    yield Line2D([], [], color='#7a3fa0', marker='o', linestyle='', label='anchor, by score')
    yield Line2D(
        [], [], color='#2b0f57', marker='o', markerfacecolor='none', linestyle='', label='best'
    )
    yield Line2D([], [], color=_UNFIT, marker='x', linestyle='', label='anchor that is not fit')
