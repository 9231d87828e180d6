# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A projected sketch of the scene as a UAV has it before it: no picture of any camera.

A pinhole at the UAV, streets as areas, buildings as prisms, bodies as boxes, the far ones first.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.patches import PathPatch
from matplotlib.path import Path as Outline

from aurora_core.knowledge.world import SurfaceKind, WorldModel
from aurora_core.quantities.ticks import first_tick
from aurora_core.trace.layout import GroundColumn, UavColumn
from aurora_core.trace.trace import FloatArray, Trace

_NEAR_M, _FAR_M = 0.5, 350.0
# Below this horizontal part of its direction a camera looks straight down.
_STEEP = 0.15
# Half of the picture's width and height at unit distance: 80 degrees across, 16:10.
_HALF = (0.84, 0.525)
# It is on its way where it moves so far in so much time.
_MOVES_M, _SOON_S = 5.0, 10.0
_SKY, _GROUND, _STREET = '#dfe9f2', '#e9e6dd', '#b9bcc0'
_WALLS, _ROOF = ('#a9a097', '#998f85', '#b5aca3', '#8d847b'), '#c9c1b8'
_ROLES = {'ego': '#0072B2', 'target': '#D55E00', 'background': '#8a8a8a', 'other': '#009E73'}


@dataclass(frozen=True, slots=True)
class Camera:
    """A pinhole.

    Attributes:
        eye: (3,) ENU metres.
        axes: (3, 3) rows: right, up, forward.
    """

    eye: FloatArray
    axes: FloatArray

    @classmethod
    def towards(cls, eye: FloatArray, point: FloatArray, course: FloatArray) -> Camera:
        """Return the camera at a point that looks towards another, its horizon level.

        Args:
            eye: (3,) where it is.
            point: (3,) what is in the middle of its picture.
            course: (2,) unit vector that is up in the picture where it looks straight down.
        """
        forward = point - eye
        forward = forward / max(1e-9, float(np.linalg.norm(forward)))
        level = float(np.hypot(forward[0], forward[1]))
        ahead = forward[:2] / level if level > _STEEP else course
        right = np.array([ahead[1], -ahead[0], 0.0])
        up = np.cross(right, forward)
        up = up / np.linalg.norm(up)
        return cls(eye, np.stack((np.cross(forward, up), up, forward)))

    def project(self, polygon: FloatArray) -> FloatArray | None:
        """Return a polygon (n, 3) in the picture (m, 2), None when it is behind the camera."""
        seen = (polygon - self.eye) @ self.axes.T
        kept = _before(seen)
        if len(kept) < 3:
            return None
        return np.asarray(kept[:, :2] / kept[:, 2:])


class Face(NamedTuple):
    """A polygon of the scene.

    Attributes:
        points: (n, 3) ENU metres.
        colour: Of its area.
        away_m: Distance by which faces cover each other.
    """

    points: FloatArray
    colour: str
    away_m: float


def draw_view(ax: Axes, camera: Camera, faces: Sequence[Face], streets: shapely.Geometry) -> None:
    """Draw what a camera has before it into a panel.

    Args:
        ax: The panel.
        camera: Where it is and looks.
        faces: Of buildings and bodies.
        streets: Carriageways, on the ground.
    """
    ground = camera.project(_plane(camera.eye))
    if ground is not None:
        ax.add_patch(PathPatch(Outline(ground), facecolor=_GROUND, linewidth=0.0))
    seen_streets = shapely.intersection(streets, _ground_before(camera))
    ax.add_patch(area_patch(seen_streets, _STREET, camera))
    polygons, colours = [], []
    for face in sorted(faces, key=lambda f: -f.away_m):
        seen = camera.project(face.points)
        if seen is not None:
            polygons.append(seen)
            colours.append(face.colour)
    ax.set_facecolor(_SKY)
    ax.add_collection(
        PolyCollection(polygons, facecolors=colours, edgecolors='#00000033', linewidths=0.2)
    )
    ax.set_xlim(-_HALF[0], _HALF[0])
    ax.set_ylim(-_HALF[1], _HALF[1])
    ax.set_aspect('equal')
    ax.set_xticks([])
    ax.set_yticks([])
    ax.grid(visible=False)


def looks_at(trace: Trace, uav: int, target: int | None, tick: int) -> Camera:
    """Return the camera of a UAV: at its target, else ahead on its way, else straight down.

    Args:
        trace: The run.
        uav: Its row.
        target: Row of the agent that it follows, None where it follows none.
        tick: When.
    """
    row = trace.uav[tick, uav]
    eye = np.array([row[UavColumn.X], row[UavColumn.Y], max(1.0, row[UavColumn.Z])])
    if target is not None:
        x, y, hx, hy = trace.ground[tick, target, : GroundColumn.HEADING_Y + 1]
        return Camera.towards(eye, np.array([x, y, 1.0]), np.array([hx, hy]))
    later = trace.uav[tick : tick + round(_SOON_S / trace.roster.dt_s), uav, : UavColumn.Y + 1]
    ahead = first_tick(np.linalg.norm(later - later[0], axis=1) > _MOVES_M)
    if ahead is None:
        return Camera.towards(eye, eye - [0.0, 0.0, 1.0], np.array([0.0, 1.0]))
    course = later[ahead] - later[0]
    course = course / np.linalg.norm(course)
    there = eye[:2] + max(5.0, eye[2]) * course
    return Camera.towards(eye, np.array([*there, 0.0]), course)


def faces_of(world: WorldModel, trace: Trace, tick: int, eye: FloatArray) -> list[Face]:
    """Return buildings and bodies near a point at a tick."""
    faces: list[Face] = []
    for building in world.buildings:
        ring = np.asarray(building.ring, dtype=np.float64)
        if np.linalg.norm(ring - eye[:2], axis=1).min() < _FAR_M:
            faces += _prism(ring, building.height_m, _ROOF, _WALLS, eye)
    for row, entry in enumerate(trace.roster.agents):
        state = trace.ground[tick, row]
        if state[GroundColumn.PRESENT] > 0.5:
            hue = _ROLES.get(entry.role, _ROLES['other'])
            ring = box_ring(state, entry.length_m, entry.width_m)
            faces += _prism(ring, entry.height_m, hue, (hue,), eye)
    return faces


def box_ring(state: FloatArray, length_m: float, width_m: float) -> FloatArray:
    """Return the outline (4, 2) of a body on the ground, counter-clockwise."""
    x, y, hx, hy = state[: GroundColumn.HEADING_Y + 1]
    along = np.array([hx, hy]) * length_m / 2.0
    across = np.array([-hy, hx]) * width_m / 2.0
    middle = np.array([x, y])
    return np.stack(
        (middle + along + across, middle - along + across, middle - along - across,
         middle + along - across)
    )  # fmt: skip


def _prism(
    ring: FloatArray, height_m: float, roof: str, walls: Sequence[str], eye: FloatArray
) -> Iterator[Face]:
    low = np.column_stack((ring, np.zeros(len(ring))))
    high = np.column_stack((ring, np.full(len(ring), height_m)))
    for k in range(len(ring)):
        n = (k + 1) % len(ring)
        wall = np.stack((low[k], low[n], high[n], high[k]))
        yield Face(wall, walls[k % len(walls)], _away(wall, eye))
    yield Face(high, roof, _away(high, eye))


def _away(points: FloatArray, eye: FloatArray) -> float:
    return float(np.linalg.norm(points.mean(axis=0) - eye))


def _plane(eye: FloatArray) -> FloatArray:
    reach = 20.0 * _FAR_M
    corners = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]) * reach
    return np.column_stack((corners + eye[:2], np.zeros(4)))


def _before(points: FloatArray) -> FloatArray:
    """Return the part of a polygon (n, 3) that is before the camera."""
    kept = []
    for k in range(len(points)):
        a, b = points[k - 1], points[k]
        if (a[2] >= _NEAR_M) != (b[2] >= _NEAR_M):
            share = (_NEAR_M - a[2]) / (b[2] - a[2])
            kept.append(a + share * (b - a))
        if b[2] >= _NEAR_M:
            kept.append(b)
    return np.array(kept)


def streets_of(world: WorldModel) -> shapely.Geometry:
    """Return the carriageways of a world as one area."""
    parts = [
        shapely.Polygon(surface.ring, surface.holes)
        for surface in world.surfaces
        if surface.kind is SurfaceKind.DRIVING
    ]
    return shapely.union_all(shapely.make_valid(parts))


def area_patch(area: shapely.Geometry, colour: str, camera: Camera | None = None) -> PathPatch:
    """Return an area with its holes as a patch, on the map or before a camera."""
    rings = [
        shapely.get_coordinates(ring)
        for part in shapely.get_parts(area)
        if isinstance(part, shapely.Polygon)
        for ring in (part.normalize().exterior, *part.normalize().interiors)
    ]
    if camera is not None:
        flat = [np.column_stack((ring, np.zeros(len(ring)))) for ring in rings]
        rings = [seen for ring in flat if (seen := camera.project(ring)) is not None]
    outlines = [Outline(ring) for ring in rings if len(ring) > 2]
    whole = Outline.make_compound_path(*outlines) if outlines else Outline(np.zeros((1, 2)))
    return PathPatch(whole, facecolor=colour, linewidth=0.0)


def _ground_before(camera: Camera) -> shapely.Polygon:
    """Return the part of the ground that a camera has before it, near enough to be drawn."""
    disc = shapely.Point(camera.eye[:2]).buffer(_FAR_M)
    forward = camera.axes[2]
    level = float(np.hypot(forward[0], forward[1]))
    if level < 1e-6:
        return disc
    along = forward[:2] / level
    across = np.array([-along[1], along[0]])
    begins_m = (1.5 * _NEAR_M + camera.eye[2] * forward[2]) / level
    begin = camera.eye[:2] + along * max(-2.0 * _FAR_M, begins_m)
    reach = 3.0 * _FAR_M
    corners = [
        begin + reach * across, begin - reach * across,
        begin - reach * across + 2.0 * reach * along, begin + reach * across + 2.0 * reach * along,
    ]  # fmt: skip
    return shapely.intersection(disc, shapely.Polygon(corners))
