# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who sees what: range, buildings and vehicles between the eye and the target."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from aurora_bench.checker import limits
from aurora_bench.checker.places import GENERAL
from aurora_bench.checker.recording import Body, BoolArray, FloatArray
from aurora_bench.checker.scene import Scene

# Sight is looked at this often; states come more often.
STEP_S = 0.1


def visible(scene: Scene, observer: str, target: str) -> BoolArray:
    """Return (ticks,) whether the observer sees the target (a body or a place).

    A place that is a kind of place is seen when its chosen spot is; an area, at its nearest point.
    """
    key = ('visible', observer, target)
    if key not in scene.memory:
        scene.memory[key] = _visible(scene, observer, target)
    seen = scene.memory[key]
    assert isinstance(seen, np.ndarray)
    return seen


def _visible(scene: Scene, observer: str, target: str) -> BoolArray:
    step = max(1, round(STEP_S / scene.dt_s))
    ticks = np.arange(0, scene.recording.ticks, step)
    eye = _eye(scene, observer)[ticks]
    if scene.is_body(target):
        seen = _sees(scene, observer, target, ticks, eye, _sight_point(scene, target)[ticks])
        seen &= scene.present(target)[ticks]
    else:
        seen = np.zeros(len(ticks), dtype=bool)
        spots = scene.places.chosen(target)
        spots = tuple(sorted(spots, key=lambda s: float(np.hypot(*(s.xy - eye[-1, :2])))))[:4]
        for spot in spots:
            point = np.array([spot.x_m, spot.y_m, limits.PLACE_SIGHT_M])
            points = np.tile(point, (len(ticks), 1))
            # A building that is the place does not hide itself.
            itself = target.casefold() not in GENERAL and not scene.places.is_region(target)
            seen |= _sees(scene, observer, '', ticks, eye, points, itself=itself)
    seen &= scene.present(observer)[ticks]
    return np.repeat(seen, step)[: scene.recording.ticks]


def _eye(scene: Scene, observer: str) -> FloatArray:
    body, xyz = scene.bodies[observer], scene.xyz(observer).copy()
    if not body.is_uav:
        xyz[:, 2] = (
            limits.PERSON_EYE_M if body.is_person else limits.DRIVER_EYE_SHARE * body.height_m
        )
    return xyz


def _sight_point(scene: Scene, target: str) -> FloatArray:
    body, xyz = scene.bodies[target], scene.xyz(target).copy()
    if not body.is_uav:
        xyz[:, 2] = (
            limits.PERSON_SIGHT_M if body.is_person else limits.VEHICLE_SIGHT_SHARE * body.height_m
        )
    return xyz


def _sees(
    scene: Scene,
    observer: str,
    target: str,
    ticks: Any,
    eye: FloatArray,
    point: FloatArray,
    *,
    itself: bool = False,
) -> BoolArray:
    free = np.linalg.norm(point - eye, axis=1) <= scene.sensing_range_m
    body = scene.bodies[observer]
    # A roadside unit has no driver who looks ahead.
    if not body.is_uav and not body.is_person and body.type_name != 'rsu':
        forward = np.einsum('ij,ij->i', (point - eye)[:, :2], scene.heading(observer)[ticks])
        free &= forward >= 0.0
    rows = np.flatnonzero(free)
    free[rows] &= ~_behind_building(scene, eye[rows], point[rows], itself=itself)
    for other in scene.bodies.values():
        if other.body_id in (observer, target) or other.is_uav or other.is_person:
            continue
        rows = np.flatnonzero(free)
        if not len(rows):
            break
        there = scene.present(other.body_id)[ticks][rows]
        free[rows] &= ~(there & _through_box(scene, other, ticks[rows], eye[rows], point[rows]))
    return np.asarray(free)


def _behind_building(
    scene: Scene, eye: FloatArray, point: FloatArray, *, itself: bool
) -> BoolArray:
    blocked = np.zeros(len(eye), dtype=bool)
    prisms = scene.world.buildings
    if not len(eye) or not prisms:
        return blocked
    if 'tree' not in scene.memory:
        scene.memory['tree'] = shapely.STRtree([p.polygon for p in prisms])
    tree: Any = scene.memory['tree']
    # A line without length meets nothing: straight down is looked at as a point.
    flat = np.stack([eye[:, :2], point[:, :2] + 1e-6], axis=1)
    lines = shapely.linestrings(flat)
    line_of, prism_of = tree.query(lines, predicate='intersects')
    if itself and len(line_of):
        around = tree.query(shapely.Point(point[0, :2]), predicate='intersects')
        other = ~np.isin(prism_of, around)
        line_of, prism_of = line_of[other], prism_of[other]
    if not len(line_of):
        return blocked
    cuts = shapely.intersection(lines[line_of], np.array([p.polygon for p in prisms])[prism_of])
    xy, cut_of = shapely.get_coordinates(cuts, return_index=True)
    ray = line_of[cut_of]
    along = flat[ray, 1] - flat[ray, 0]
    length2 = np.maximum(np.einsum('ij,ij->i', along, along), 1e-12)
    t = np.clip(np.einsum('ij,ij->i', xy - flat[ray, 0], along) / length2, 0.0, 1.0)
    height = eye[ray, 2] + t * (point[ray, 2] - eye[ray, 2])
    # Nothing blocks from the point of sight itself: a place may lie on a wall.
    tops = np.array([p.top_m for p in prisms])[prism_of][cut_of]
    hit = (height < tops) & (t < 1.0 - 1e-6)
    blocked[np.unique(ray[hit])] = True
    return blocked


def _through_box(
    scene: Scene, body: Body, ticks: Any, eye: FloatArray, point: FloatArray
) -> BoolArray:
    """Return (n,) whether the segments cross the box of a vehicle (slabs in its own frame)."""
    centre, heading = scene.xy(body.body_id)[ticks], scene.heading(body.body_id)[ticks]
    left = np.column_stack([-heading[:, 1], heading[:, 0]])

    def local(xyz: FloatArray) -> FloatArray:
        delta = xyz[:, :2] - centre
        return np.column_stack(
            [
                np.einsum('ij,ij->i', delta, heading),
                np.einsum('ij,ij->i', delta, left),
                xyz[:, 2],
            ]
        )

    start, end = local(eye), local(point)
    low = np.array([-body.length_m / 2.0, -body.width_m / 2.0, 0.0])
    high = np.array([body.length_m / 2.0, body.width_m / 2.0, body.height_m])
    step = end - start
    with np.errstate(divide='ignore', invalid='ignore'):
        a, b = (low - start) / step, (high - start) / step
    inside = (start >= low) & (start <= high)
    parallel = np.abs(step) < 1e-12
    near = np.where(parallel, np.where(inside, -np.inf, np.inf), np.minimum(a, b))
    far = np.where(parallel, np.where(inside, np.inf, -np.inf), np.maximum(a, b))
    first = np.maximum(near.max(axis=1), 0.0)
    last = np.minimum(far.min(axis=1), 1.0)
    return np.asarray(first < last)
