# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The map under a run: carriageway, crossings, buildings by height, no-fly zones, signals."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Protocol

import numpy as np
import numpy.typing as npt
from matplotlib.axes import Axes
from matplotlib.collections import PatchCollection
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline
from matplotlib.patheffects import withStroke
from shapely import Polygon

from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import CentreLine, SignalPost, Surface, SurfaceKind
from aurora_core.report.scene import style
from aurora_core.report.scene.tracks import Box

FloatArray = npt.NDArray[np.float64]

TALL_M = 60.0
HEIGHTS = LinearSegmentedColormap.from_list(
    'heights', [style.BUILDING_LOW, '#b3ab9f', style.BUILDING_HIGH]
)
# A building throws a shadow this long per metre of height: depth at a glance.
_SHADOW = (0.16, -0.16)
_LABEL_SPACING_M = 40.0
_STREET_STEP_M = 4.0


class GroundModel(Protocol):
    """What is drawn of a world; `WorldModel` has all of it."""

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """Carriageway, crossings, sidewalks."""

    @property
    def buildings(self) -> tuple[Building, ...]:
        """Prisms."""

    @property
    def no_fly_zones(self) -> tuple[NoFlyZone, ...]:
        """Closed air."""

    @property
    def lanes(self) -> tuple[CentreLine, ...]:
        """Driving lanes with the names of their streets."""

    @property
    def signals(self) -> tuple[SignalPost, ...]:
        """Signalised junctions."""


def draw_ground(
    ax: Axes,
    world: GroundModel,
    box: Box,
    points_per_m: float,
    ways: FloatArray,
    named_elsewhere: frozenset[str] = frozenset(),
) -> None:
    """Draw the map inside a box, which the axes show from now on, without ticks.

    Args:
        ax: Axes in ENU metres.
        world: The world of the run.
        box: What is visible.
        points_per_m: Scale of the axes.
        ways: (K, 2) points of trajectories; street names stay off them.
        named_elsewhere: Buildings that get no label here.
    """
    ax.set_xlim(box.west, box.east)
    ax.set_ylim(box.south, box.north)
    ax.set_xticks([])
    ax.set_yticks([])
    ax.set_autoscale_on(False)
    ax.set_facecolor(style.GROUND)
    _surfaces(ax, world)
    _crossings(ax, world, box, points_per_m)
    _buildings(ax, world, box, named_elsewhere)
    _zones(ax, world, box)
    _street_names(ax, world, box, points_per_m, ways)
    _signals(ax, world, box)


def outline(ring: FloatArray, holes: Iterable[FloatArray] = ()) -> Outline:
    """Return a closed outline with holes.

    Args:
        ring: (K, 2), not closed.
        holes: Rings of the same form, wound the other way.
    """
    vertices, codes = [], []
    for part in (ring, *holes):
        points = np.asarray(part, dtype=np.float64)
        if len(points) < 3:
            continue
        vertices += [*points, points[0]]
        codes += [Outline.MOVETO, *[Outline.LINETO] * (len(points) - 1), Outline.CLOSEPOLY]
    return Outline(np.asarray(vertices).reshape(-1, 2), codes)


def _surfaces(ax: Axes, world: GroundModel) -> None:
    roads = [
        PathPatch(outline(s.ring, s.holes))
        for s in world.surfaces
        if s.kind is SurfaceKind.DRIVING and len(s.ring) >= 3
    ]
    # First the edges of all, then the faces: pieces of one road join without a seam.
    ax.add_collection(
        PatchCollection(roads, facecolor='none', edgecolor=style.ROAD_EDGE, linewidth=1.6)
    )
    ax.add_collection(PatchCollection(roads, facecolor=style.ROAD, edgecolor='none'))
    walks = [
        PathPatch(outline(s.ring, s.holes))
        for s in world.surfaces
        if s.kind is SurfaceKind.SIDEWALK and len(s.ring) >= 3
    ]
    ax.add_collection(PatchCollection(walks, facecolor='#e3e0d7', edgecolor='none'))


def _crossings(ax: Axes, world: GroundModel, box: Box, points_per_m: float) -> None:
    """Draw zebras: a thick line across the road, dashed."""
    for surface in world.surfaces:
        if surface.kind is not SurfaceKind.CROSSING or len(surface.ring) < 4:
            continue
        centre = surface.ring.mean(axis=0)
        if not box.holds(float(centre[0]), float(centre[1])):
            continue
        start, end, width_m = _long_axis(surface.ring)
        dash = 0.5 / width_m  # in line widths: bars of half a metre
        ax.plot(
            [start[0], end[0]],
            [start[1], end[1]],
            color=style.CROSSING,
            linewidth=width_m * points_per_m,
            linestyle=(0.0, (dash, dash)),
            dash_capstyle='butt',
            zorder=2.0,
        )


def _long_axis(ring: FloatArray) -> tuple[FloatArray, FloatArray, float]:
    """Return ends and width of a strip's long axis (the principal axis of its corners)."""
    centre = ring.mean(axis=0)
    offsets = ring - centre
    sxx, syy = float((offsets[:, 0] ** 2).sum()), float((offsets[:, 1] ** 2).sum())
    sxy = float((offsets[:, 0] * offsets[:, 1]).sum())
    angle = 0.5 * math.atan2(2.0 * sxy, sxx - syy)
    along = np.array([math.cos(angle), math.sin(angle)])
    across = np.array([-along[1], along[0]])
    reach, half = offsets @ along, offsets @ across
    width_m = max(float(half.max() - half.min()), 0.5)
    return centre + along * reach.min(), centre + along * reach.max(), width_m


def _buildings(ax: Axes, world: GroundModel, box: Box, named_elsewhere: frozenset[str]) -> None:
    shown = []
    for building in world.buildings:
        ring = np.asarray(building.ring, dtype=np.float64)
        (west, south), (east, north) = ring.min(axis=0), ring.max(axis=0)
        far = building.height_m * abs(_SHADOW[0])
        if east < box.west - far or west > box.east + far:
            continue
        if north < box.south - far or south > box.north + far:
            continue
        shown.append(building)
    if not shown:
        return
    shadows, bodies, heights = [], [], []
    for building in shown:
        ring = np.asarray(building.ring, dtype=np.float64)
        holes = [np.asarray(hole, dtype=np.float64) for hole in building.holes]
        shift = building.height_m * np.array(_SHADOW)
        shadows.append(PathPatch(outline(ring + shift, [hole + shift for hole in holes])))
        bodies.append(PathPatch(outline(ring, holes)))
        heights.append(building.height_m)
    ax.add_collection(
        PatchCollection(shadows, facecolor='#3a3f4a', edgecolor='none', alpha=0.16, zorder=2.4)
    )
    collection = PatchCollection(
        bodies, cmap=HEIGHTS, norm=Normalize(0.0, TALL_M), linewidth=0.5, zorder=2.5
    )
    collection.set_array(np.asarray(heights))
    collection.set_edgecolor(style.BUILDING_EDGE)
    ax.add_collection(collection)
    labels: list[tuple[float, float]] = []
    for building in sorted(shown, key=lambda b: (-b.height_m, b.id)):
        inside = Polygon(building.ring, building.holes).representative_point()
        x, y = inside.x, inside.y
        near = any(math.hypot(x - a, y - b) < _LABEL_SPACING_M for a, b in labels)
        if building.name in named_elsewhere or near or not box.holds(x, y):
            continue
        if building.height_m < 20.0 and not building.name:
            continue
        labels.append((x, y))
        text = f'{building.height_m:.0f} m'
        ax.text(
            x,
            y,
            f'{building.name}\n{text}' if building.name else text,
            fontsize=6.0,
            color='#ffffff' if building.height_m > 35.0 else '#5d574b',
            ha='center',
            va='center',
            clip_on=True,
            zorder=2.6,
        )


def _zones(ax: Axes, world: GroundModel, box: Box) -> None:
    for zone in world.no_fly_zones:
        ring = np.asarray(zone.ring, dtype=np.float64)
        patch = PathPatch(
            outline(ring),
            facecolor=(*_rgb(style.NO_FLY), 0.10),
            edgecolor=style.NO_FLY,
            hatch='///',
            linewidth=1.2,
            linestyle='--',
            zorder=3.0,
        )
        ax.add_patch(patch)
        x, y = ring.mean(axis=0)
        if box.holds(x, y):
            ax.text(
                x,
                y,
                f'NO FLY\n{zone.floor_m:.0f}–{zone.ceiling_m:.0f} m',
                fontsize=7.0,
                color=style.NO_FLY,
                weight='bold',
                ha='center',
                va='center',
                path_effects=[withStroke(linewidth=2.0, foreground='white')],
                clip_on=True,
                zorder=3.1,
            )


def _rgb(colour: str) -> tuple[float, float, float]:
    return tuple(int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5))  # type: ignore[return-value]


def _signals(ax: Axes, world: GroundModel, box: Box) -> None:
    rim_x, rim_y = 0.012 * box.width, 0.02 * box.height
    inside = [
        (s.x_m, s.y_m)
        for s in world.signals
        if box.west + rim_x < s.x_m < box.east - rim_x
        and box.south + rim_y < s.y_m < box.north - rim_y
    ]
    if not inside:
        return
    x, y = [p[0] for p in inside], [p[1] for p in inside]
    ax.scatter(x, y, marker='s', s=58.0, color='#2b2f36', linewidths=0.0, zorder=3.4)
    for up, colour in ((2.6, '#ff5a4e'), (0.0, '#ffc53d'), (-2.6, '#3ecf6e')):
        for px, py in inside:
            ax.annotate(
                '•',
                (px, py),
                xytext=(0.0, up - 0.3),
                textcoords='offset points',
                color=colour,
                fontsize=5.5,
                ha='center',
                va='center',
                annotation_clip=True,
                zorder=3.5,
            )


def _street_names(
    ax: Axes, world: GroundModel, box: Box, points_per_m: float, ways: FloatArray
) -> None:
    """Write each street's name once, along the longest piece that can be seen."""
    by_name: dict[str, list[CentreLine]] = {}
    for lane in world.lanes:
        if lane.street_name:
            by_name.setdefault(lane.street_name, []).append(lane)
    inner = Box(
        west=box.west + 0.03 * box.width,
        south=box.south + 0.05 * box.height,
        east=box.east - 0.03 * box.width,
        north=box.north - 0.05 * box.height,
    )
    for name in sorted(by_name):
        half_m = 0.5 * 4.2 * len(name) / points_per_m
        pieces = [_visible(lane.points, inner) for lane in by_name[name]]
        long_enough = [p for p in pieces if len(p) * _STREET_STEP_M > 2.4 * half_m]
        if not long_enough:
            continue
        # The lane and the place on it that the trajectories leave free.
        spots = [_freest(piece, ways, half_m, 9.0 / points_per_m) for piece in long_enough]
        best = min(range(len(spots)), key=lambda i: (spots[i][0], -len(long_enough[i])))
        if spots[best][0] > 1:
            continue  # it would be half hidden
        piece, k = long_enough[best], spots[best][1]
        dx, dy = _direction(piece, k)
        angle = math.degrees(math.atan2(dy, dx))
        if angle > 90.0 or angle <= -90.0:
            angle += 180.0
        ax.text(
            piece[k][0],
            piece[k][1],
            name,
            fontsize=6.8,
            color='#6f6a5d',
            style='italic',
            rotation=angle,
            rotation_mode='anchor',
            ha='center',
            va='center',
            path_effects=[withStroke(linewidth=2.2, foreground='white')],
            clip_on=True,
            zorder=3.2,
        )


def _freest(
    piece: FloatArray, ways: FloatArray, along_m: float, across_m: float
) -> tuple[int, int]:
    """Return how many points of trajectories a name would cover at best, and its index."""
    first = len(piece) // 6
    best = (len(ways) + 1, len(piece), len(piece) // 2)
    for k in range(first, max(len(piece) - first, first + 1)):
        dx, dy = _direction(piece, k)
        delta = ways - piece[k]
        along = np.abs(delta[:, 0] * dx + delta[:, 1] * dy)
        across = np.abs(delta[:, 1] * dx - delta[:, 0] * dy)
        count = int(((along < along_m) & (across < across_m)).sum())
        best = min(best, (count, abs(2 * k - len(piece)), k))
    return best[0], best[2]


def _direction(piece: FloatArray, k: int) -> tuple[float, float]:
    """Return the unit direction of a line of samples at an index."""
    dx, dy = piece[min(k + 2, len(piece) - 1)] - piece[max(k - 2, 0)]
    length = math.hypot(dx, dy) or 1.0
    return float(dx) / length, float(dy) / length


def _visible(points: FloatArray, box: Box) -> FloatArray:
    """Return the longest run of samples of a line inside a box, (K, 2), every few metres."""
    steps = np.sqrt((np.diff(points, axis=0) ** 2).sum(axis=1))
    along = np.concatenate(([0.0], np.cumsum(steps)))
    samples = np.arange(0.0, along[-1], _STREET_STEP_M)
    x = np.interp(samples, along, points[:, 0])
    y = np.interp(samples, along, points[:, 1])
    best: list[int] = []
    run: list[int] = []
    for k in range(len(samples)):
        run = [*run, k] if box.holds(float(x[k]), float(y[k])) else []
        best = run if len(run) > len(best) else best
    return np.column_stack((x[best], y[best])) if best else np.empty((0, 2))
