# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The picture of a map by itself, with its landmarks and named ground."""

from __future__ import annotations

from dataclasses import dataclass

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patches import Polygon as PolygonPatch
from matplotlib.patheffects import withStroke

from aurora_core.knowledge.map_model import MapModel
from aurora_core.knowledge.map_types import Building, NoFlyZone
from aurora_core.knowledge.world import CentreLine, SignalPost, Surface, SurfaceKind
from aurora_core.report.picture.furniture import draw_scale
from aurora_core.report.picture.ground import draw_ground
from aurora_core.report.scene import style
from aurora_core.report.scene.tracks import Box

_WIDTH_IN = 14.0
_TITLE_IN = 0.7
_AREA_COLOURS = {
    'park': '#cfe3c0',
    'plaza': '#e6dfcb',
    'water': '#bcd7ea',
    'school_zone': '#f5e7b8',
}


@dataclass(frozen=True, slots=True, kw_only=True)
class MapGround:
    """The part of a map that `draw_ground` draws."""

    surfaces: tuple[Surface, ...]
    buildings: tuple[Building, ...]
    no_fly_zones: tuple[NoFlyZone, ...]
    lanes: tuple[CentreLine, ...]
    signals: tuple[SignalPost, ...]


def ground_of_map(model: MapModel) -> MapGround:
    """Return what is drawn of a map."""
    network = model.network
    areas = (
        (SurfaceKind.SIDEWALK, network.sidewalk_area),
        (SurfaceKind.DRIVING, network.carriageway),
    )
    surfaces = [
        Surface(
            surface_id=f'{kind.name.lower()}_{k}',
            kind=kind,
            ring=np.array(polygon.exterior.coords)[:-1],
            holes=tuple(np.array(hole.coords)[:-1] for hole in polygon.interiors),
        )
        for kind, area in areas
        for k, polygon in enumerate(area.geoms)
    ]
    surfaces += [
        Surface(surface_id=c.id, kind=SurfaceKind.CROSSING, ring=np.array(c.polygon))
        for c in network.crossings
    ]
    return MapGround(
        surfaces=tuple(surfaces),
        buildings=model.buildings,
        no_fly_zones=model.zones,
        lanes=tuple(
            CentreLine(
                lane_id=lane.id,
                street_name=network.edge(lane.edge_id).street_name,
                points=np.array(lane.polyline),
                width_m=lane.width_m,
                speed_limit_mps=lane.speed_limit_mps,
            )
            for lane in network.driving_lanes('passenger')
        ),
        signals=tuple(
            SignalPost(junction_id=j.id, x_m=j.x_m, y_m=j.y_m)
            for j in sorted(network.junctions.values(), key=lambda j: j.id)
            if j.has_signal
        ),
    )


def draw_map(model: MapModel) -> Figure:
    """Draw a map."""
    west, south, east, north = model.bounds_m
    box = Box(west=west, south=south, east=east, north=north)
    height_in = _WIDTH_IN * box.height / box.width + _TITLE_IN
    with mpl.rc_context(style.RC):
        figure = Figure(figsize=(_WIDTH_IN, height_in), facecolor=style.PAPER)
        FigureCanvasAgg(figure)
        top = 1.0 - _TITLE_IN / height_in
        ax = figure.add_axes((0.01, 0.01, 0.98, top - 0.01))
        ax.set_aspect('equal')
        scale = 0.98 * _WIDTH_IN * 72.0 / box.width
        marks = frozenset(mark.name for mark in model.landmarks)
        draw_ground(ax, ground_of_map(model), box, scale, np.empty((0, 2)), marks)
        _areas(ax, model)
        _landmarks(ax, model)
        draw_scale(ax, box)
        figure.text(
            0.012, 1.0 - 0.2 / height_in, model.name, fontsize=15.0, weight='bold', va='top'
        )
        figure.text(
            0.012,
            1.0 - 0.48 / height_in,
            f'{model.description}  ({box.width:.0f} m × {box.height:.0f} m, {model.licence})',
            fontsize=9.0,
            color=style.FAINT,
            va='top',
        )
        return figure


def _areas(ax: Axes, model: MapModel) -> None:
    for area in model.areas:
        ax.add_patch(
            PolygonPatch(
                np.asarray(area.ring),
                closed=True,
                facecolor=_AREA_COLOURS.get(area.kind, '#e3e6da'),
                edgecolor='none',
                alpha=0.75,
                zorder=0.5,
            )
        )


def _landmarks(ax: Axes, model: MapModel) -> None:
    for mark in model.landmarks:
        ax.plot(mark.x_m, mark.y_m, marker='*', markersize=11.0, color='#b3123f', zorder=7.0)
        ax.annotate(
            mark.name,
            (mark.x_m, mark.y_m),
            xytext=(0.0, 8.0),
            textcoords='offset points',
            ha='center',
            fontsize=8.5,
            weight='bold',
            path_effects=[withStroke(linewidth=2.6, foreground='white')],
            zorder=7.1,
        )
