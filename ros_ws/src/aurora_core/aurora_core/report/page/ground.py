# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The map around a run: outlines in decimetres, cut to what can be seen."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np
import shapely

from aurora_core.knowledge.world import CentreLine, SurfaceKind, WorldModel
from aurora_core.report.page.motion import STEP_M
from aurora_core.report.page.numbers import FloatArray, whole
from aurora_core.report.scene.tracks import Box
from aurora_core.report.visible import visible

# Room around the scene, to look around in.
_AROUND_M = 120.0
_SIMPLER_M = 0.15


def ground_of(world: WorldModel, box: Box) -> dict[str, Any]:
    """Return what lies around a box.

    Args:
        world: The world of the run.
        box: What is seen first; positions count from its south-western corner.
    """
    wide = Box(
        west=box.west - _AROUND_M,
        south=box.south - _AROUND_M,
        east=box.east + _AROUND_M,
        north=box.north + _AROUND_M,
    )
    kinds: dict[str, list[list[list[list[int]]]]] = {'roads': [], 'walks': [], 'crossings': []}
    names = {
        SurfaceKind.DRIVING: 'roads',
        SurfaceKind.SIDEWALK: 'walks',
        SurfaceKind.CROSSING: 'crossings',
    }
    for surface in world.surfaces:
        if len(surface.ring) >= 3:
            kinds[names[surface.kind]] += _pieces(surface.ring, surface.holes, wide, box)
    return {
        **kinds,
        'buildings': [
            [round(b.height_m, 1), visible(b.name), piece]
            for b in world.buildings
            for piece in _pieces(np.asarray(b.ring), b.holes, wide, box)
        ],
        'zones': [
            [z.floor_m, z.ceiling_m, visible(z.name), piece]
            for z in world.no_fly_zones
            for piece in _pieces(np.asarray(z.ring), (), wide, box)
        ],
        'signals': [
            [round((s.x_m - box.west) / STEP_M), round((s.y_m - box.south) / STEP_M)]
            for s in world.signals
            if wide.holds(s.x_m, s.y_m)
        ],
        'streets': _streets(world.lanes, box),
        'places': [
            [
                visible(p.name),
                round((p.x_m - box.west) / STEP_M),
                round((p.y_m - box.south) / STEP_M),
            ]
            for p in world.places
            if wide.holds(p.x_m, p.y_m)
        ],
    }


def _pieces(
    ring: FloatArray, holes: Iterable[Any], wide: Box, box: Box
) -> list[list[list[list[int]]]]:
    """Return the polygons that are left of one inside a box: outline, then holes; x, then y."""
    (west, south), (east, north) = ring.min(axis=0), ring.max(axis=0)
    if east < wide.west or west > wide.east or north < wide.south or south > wide.north:
        return []
    shape = shapely.Polygon(ring, [hole for hole in holes if len(hole) >= 3])
    if not (wide.holds(west, south) and wide.holds(east, north)):
        shape = shapely.clip_by_rect(shape, wide.west, wide.south, wide.east, wide.north)
    shape = shapely.simplify(shape, _SIMPLER_M)
    parts = [part for part in shapely.get_parts(shape) if part.geom_type == 'Polygon']
    return [
        [_outline(np.asarray(r.coords)[:-1], box) for r in (part.exterior, *part.interiors)]
        for part in parts
        if not part.is_empty
    ]


def _outline(points: FloatArray, box: Box) -> list[list[int]]:
    return [whole(points[:, 0] - box.west, STEP_M), whole(points[:, 1] - box.south, STEP_M)]


def _streets(lanes: Iterable[CentreLine], box: Box) -> list[list[Any]]:
    """Return name, middle, direction in degrees and length of the longest lane of each street."""
    longest: dict[str, tuple[float, FloatArray]] = {}
    for lane in lanes:
        if not lane.street_name:
            continue
        inside = lane.points[[box.holds(float(x), float(y)) for x, y in lane.points[:, :2]]]
        if len(inside) < 2:
            inside = _inside(lane.points, box)
        if len(inside) < 2:
            continue
        length = float(np.hypot(*(inside[-1] - inside[0])[:2]))
        if length > longest.get(lane.street_name, (0.0, inside))[0]:
            longest[lane.street_name] = (length, inside)
    found = []
    for name, (length, points) in sorted(longest.items()):
        delta = points[-1] - points[0]
        middle = (points[0] + points[-1]) / 2.0
        found.append(
            [
                visible(name),
                round((float(middle[0]) - box.west) / STEP_M),
                round((float(middle[1]) - box.south) / STEP_M),
                round(float(np.degrees(np.arctan2(delta[1], delta[0])))),
                round(length / STEP_M),
            ]
        )
    return found


def _inside(points: FloatArray, box: Box) -> FloatArray:
    """Return both ends of the part of a line inside a box."""
    line = shapely.clip_by_rect(
        shapely.LineString(points), box.west, box.south, box.east, box.north
    )
    parts = [p for p in shapely.get_parts(line) if p.geom_type == 'LineString' and p.length > 0.0]
    if not parts:
        return np.empty((0, 2))
    return np.asarray(max(parts, key=lambda p: p.length).coords)[[0, -1]]
