# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distances along the way of a body, and the lanes that it drives on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely

from aurora_bench.checker.recording import FloatArray, Lane
from aurora_bench.checker.scene import Scene

# How far beside the way of another body something still counts as on that way.
BESIDE_M = 8.0
# A body counts as on its way only so far ahead or behind: streets meet themselves again.
WINDOW_M = 400.0
# Who has driven no farther than this stands for good.
STANDS_M = 1.0
# A lap that is 500 m farther along the way counts as one metre farther off.
LAP_SHARE = 1.0 / 500.0


@dataclass(frozen=True, slots=True)
class Way:
    """What a body drove, then what it planned; `own_m` is its own arc length per tick."""

    xy_m: FloatArray
    arc_m: FloatArray
    own_m: FloatArray


def way(scene: Scene, body_id: str) -> Way:
    """Return the way of a ground body: driven path first, then the rest of its plan."""
    key = ('way', body_id)
    if key not in scene.memory:
        scene.memory[key] = _way(scene, body_id)
    found = scene.memory[key]
    assert isinstance(found, Way)
    return found


def _way(scene: Scene, body_id: str) -> Way:
    xy = scene.xy(body_id)
    steps = np.linalg.norm(np.diff(xy, axis=0), axis=1)
    own = np.concatenate([[0.0], np.cumsum(steps)])
    kept, last = [0], 0.0
    for i in np.flatnonzero(np.diff(np.floor(own / 0.5))) + 1:
        if own[i] - last >= 0.3:
            kept.append(int(i))
            last = float(own[i])
    points = [xy[kept]]
    plan = scene.bodies[body_id].route_xy_m
    if len(plan) >= 2:
        line = shapely.LineString(plan)
        # The driven path may pass the end of the plan more than once: the arc length tells where.
        start = line.project(shapely.Point(xy[0]))
        here = start + own[-1]
        if here < line.length and line.interpolate(here).distance(shapely.Point(xy[-1])) < 5.0:
            arcs = np.concatenate(
                [[0.0], np.cumsum(np.linalg.norm(np.diff(plan, axis=0), axis=1))]
            )
            points.append(plan[arcs > here + 0.5])
    whole = np.concatenate(points)
    if len(whole) == 1:
        whole = np.concatenate([whole, whole + scene.heading(body_id)[0] * 0.5])
    arc = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(whole, axis=0), axis=1))])
    own_on_kept = np.interp(own, own[kept], arc[: len(kept)])
    # Between the last kept point and the end the body is at most one point further.
    return Way(whole, arc, own_on_kept + np.maximum(own - own[kept[-1]], 0.0))


def project(
    found: Way, xy: FloatArray, around_m: FloatArray, heading: FloatArray | None = None
) -> tuple[FloatArray, FloatArray]:
    """Return (n,) arc lengths and signed lateral offsets (left positive) of points on a way.

    Args:
        around_m: (n,) arc length near which to look.
        heading: (n, 2) of who is there: where the way goes against it is the other carriageway;
            zero where that does not count.
    """
    a, b = found.xy_m[:-1], found.xy_m[1:]
    along = b - a
    length = np.maximum(np.linalg.norm(along, axis=1), 1e-9)
    arcs, laterals = np.zeros(len(xy)), np.zeros(len(xy))
    for block in range(0, len(xy), 512):
        rows = slice(block, block + 512)
        delta = xy[rows, None] - a[None]
        t = np.clip(np.einsum('nsk,sk->ns', delta, along) / length**2, 0.0, 1.0)
        foot = a[None] + t[..., None] * along[None]
        gap = np.linalg.norm(xy[rows, None] - foot, axis=2)
        arc = found.arc_m[:-1][None] + t * length[None]
        away = np.abs(arc - around_m[rows, None])
        if heading is not None:
            against = heading[rows] @ along.T < 0.0
            away = np.where(against & ~against.all(axis=1, keepdims=True), np.inf, away)
        # Of several laps over the same ground it is the nearest one along the way.
        best = np.where(away <= WINDOW_M, gap + LAP_SHARE * away, np.inf).argmin(axis=1)
        pick = np.arange(len(best))
        side = along[best, 0] * delta[pick, best, 1] - along[best, 1] * delta[pick, best, 0]
        arcs[rows] = arc[pick, best]
        laterals[rows] = np.where(side >= 0.0, 1.0, -1.0) * gap[pick, best]
    return arcs, laterals


def ahead_of(scene: Scene, a: str, b: str, ticks: Any) -> tuple[FloatArray, FloatArray]:
    """Return how far body a is ahead of b along the way, and how far beside it.

    Positions of a are looked for on the way of b and, where it is not there, those of b on the way
    of a. NaN where neither is on the other's way.

    Args:
        ticks: Indices.
    """
    index = np.asarray(ticks, dtype=np.int64)
    own_b, own_a = way(scene, b), way(scene, a)
    # Who walks may do so along the street in any direction.
    driven = not scene.is_person(a) and not scene.is_person(b)
    one, other = scene.heading(a)[index], scene.heading(b)[index]
    # Of two that meet one is ahead on the way of the other, against which it drives.
    alike = np.einsum('ij,ij->i', one, other)[:, None] > 0.0
    heads = (one * alike, other * alike) if driven else (None, None)
    arc, lateral = project(own_b, scene.xy(a)[index], own_b.own_m[index], heads[0])
    ahead = arc - own_b.own_m[index]
    # The very ends of a way stand for everything beyond them.
    beyond = (arc <= 1e-6) | (arc >= own_b.arc_m[-1] - 1e-6)
    good = (np.abs(lateral) <= BESIDE_M) & ~(beyond & (np.abs(ahead) > 1e-6))
    back_arc, back_lateral = project(own_a, scene.xy(b)[index], own_a.own_m[index], heads[1])
    back = own_a.own_m[index] - back_arc
    back_beyond = (back_arc <= 1e-6) | (back_arc >= own_a.arc_m[-1] - 1e-6)
    back_good = (np.abs(back_lateral) <= BESIDE_M) & ~(back_beyond & (np.abs(back) > 1e-6))
    # Who is behind where a way begins is beside no part of it, however near: its own way tells.
    told = good & ~(beyond & back_good & ~back_beyond)
    ahead = np.where(told, ahead, np.where(back_good, back, np.nan))
    beside = np.where(told, lateral, np.where(back_good, -back_lateral, np.nan))
    if scene.is_person(a) and own_b.own_m[-1] <= STANDS_M:
        # A person's way may lead across, and nobody drove behind who stands: its heading tells.
        forward, left = (values[index] for values in frame(scene, a, b))
        near = np.abs(left) <= BESIDE_M
        return np.where(near, forward, np.nan), np.where(near, left, np.nan)
    return ahead, beside


def frame(scene: Scene, a: str, b: str) -> tuple[FloatArray, FloatArray]:
    """Return (ticks,) how far a is forward and left of b in the frame of b's heading."""
    delta, heading = scene.xy(a) - scene.xy(b), scene.course(b)
    forward = np.einsum('ij,ij->i', delta, heading)
    left = heading[:, 0] * delta[:, 1] - heading[:, 1] * delta[:, 0]
    return forward, left


def lane_of(scene: Scene, xy: FloatArray, heading: FloatArray) -> Lane | None:
    """Return the lane on whose surface a vehicle stands, by its position and heading."""
    best, least = None, np.inf
    point = shapely.Point(xy)
    for lane in scene.world.lanes:
        line = shapely.LineString(lane.xy_m)
        gap = line.distance(point)
        if gap > lane.width_m / 2.0 + 0.6 or gap >= least:
            continue
        if abs(offset(lane, xy)[1]) > lane.width_m or not _same_way(line, point, heading):
            continue
        best, least = lane, gap
    return best


def offset(lane: Lane, xy: FloatArray) -> tuple[float, float]:
    """Return arc length and signed lateral offset (left positive) of a point on a lane."""
    points = lane.xy_m
    arcs = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    found = Way(points, arcs, np.zeros(1))
    arc, lateral = project(found, np.asarray(xy).reshape(1, 2), np.full(1, arcs[-1] / 2.0))
    return float(arc[0]), float(lateral[0])


def _same_way(line: shapely.LineString, point: shapely.Point, heading: FloatArray) -> bool:
    arc = line.project(point)
    a, b = line.interpolate(max(arc - 1.0, 0.0)), line.interpolate(min(arc + 1.0, line.length))
    return bool((b.x - a.x) * heading[0] + (b.y - a.y) * heading[1] > 0.0)
