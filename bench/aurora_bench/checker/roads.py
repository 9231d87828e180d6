# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What bodies do with the road: change lanes, cross it, pass before one another."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import shapely

from aurora_bench.checker import limits
from aurora_bench.checker.case import Case
from aurora_bench.checker.pairs import overtaking
from aurora_bench.checker.paths import lane_of, offset
from aurora_bench.checker.scene import runs_of


class LaneChanged(NamedTuple):
    """A vehicle came onto a lane beside its own: when, did it stay 2 s, and to which side."""

    tick: int
    held: bool
    side: str


def lane_changes(case: Case, agent: str, side: str | None = None) -> list[LaneChanged]:
    """Return the changes of lane of a vehicle; `side`: those to the left, or right, alone."""
    key = ('lanes', agent)
    if key not in case.scene.memory:
        case.scene.memory[key] = _lane_changes(case, agent)
    found = case.scene.memory[key]
    assert isinstance(found, list)
    return [one for one in found if side in (None, one.side)]


def _lane_changes(case: Case, agent: str) -> list[LaneChanged]:
    scene = case.scene
    xy, heading = scene.xy(agent), scene.heading(agent)
    step = max(1, round(0.2 / scene.dt_s))
    found: list[LaneChanged] = []
    current = None
    held = round(limits.LANE_HELD_S / scene.dt_s)
    present = scene.present(agent)
    for tick in range(0, len(xy), step):
        if not present[tick]:
            current = None
            continue
        if current is not None:
            arc, lateral = offset(current, xy[tick])
            length = float(np.linalg.norm(np.diff(current.xy_m, axis=0), axis=1).sum())
            if abs(lateral) <= current.width_m / 2.0 and 0.0 < arc < length:
                continue
            beside = 0.5 * current.width_m < abs(lateral) < 1.7 * current.width_m
            if beside and 0.5 < arc < length - 0.5:
                other = lane_of(scene, xy[tick], heading[tick])
                if other is None:
                    continue
                if other.lane_id != current.lane_id:
                    stay = all(
                        abs(offset(current, xy[t])[1]) > current.width_m / 2.0
                        or not 0.0 < offset(current, xy[t])[0] < length
                        for t in range(tick, min(tick + held, len(xy)), step)
                    )
                    side = 'left' if lateral > 0.0 else 'right'
                    found.append(LaneChanged(tick, stay and tick + held < len(xy), side))
        current = lane_of(scene, xy[tick], heading[tick])
    return found


def crossings_of(case: Case, person: str) -> list[tuple[int, int, float]]:
    """Return (tick of leaving the kerb, tick of reaching the other, metres) of each crossing."""
    scene = case.scene
    key = ('crossings', person)
    if key not in scene.memory:
        road = scene.places.road()
        shapely.prepare(road)
        on = np.asarray(shapely.contains_xy(road, *scene.xy(person).T)) & scene.present(person)
        scene.memory[key] = [
            (a, b, float(np.linalg.norm(scene.xy(person)[b - 1] - scene.xy(person)[a])))
            for a, b in runs_of(on)
            if a > 0
        ]
    found = scene.memory[key]
    assert isinstance(found, list)
    return found


def passed_first(case: Case, first: str, second: str) -> tuple[bool, float] | None:
    """Return whether one body passed where the ways cross before another; and when.

    Who overtakes the other has passed it. None when their ways do not cross.
    """
    scene = case.scene
    if not (scene.bodies[first].is_person or scene.bodies[second].is_person):
        passing = overtaking(scene, first, second)
        if passing is not None and passing.clean:
            return True, passing.end_s
    step = max(1, round(0.2 / scene.dt_s))
    a, b = scene.xy(first)[::step], scene.xy(second)[::step]
    way_a, way_b = _line(a), _line(b)
    if way_a is None:
        return None
    if way_b is None:
        # Whoever stands until the end has let everybody pass who came by.
        near = np.linalg.norm(a - b[0], axis=1)
        if near.min() > 30.0:
            return None
        return True, float(near.argmin() * step * scene.dt_s)
    cut = way_a.intersection(way_b)
    if cut.is_empty:
        # A body that waits short of the crossing point: its heading is the rest of its way.
        ahead = b[-1] + scene.heading(second)[-1] * 25.0
        cut = way_a.intersection(shapely.LineString([b[-1], ahead]))
        if cut.is_empty:
            return None
        point = np.array(cut.centroid.coords[0])
        when = float(np.linalg.norm(a - point, axis=1).argmin() * step * scene.dt_s)
        return True, when
    for geometry in getattr(cut, 'geoms', [cut]):
        point = np.array(geometry.centroid.coords[0])
        time_a = int(np.linalg.norm(a - point, axis=1).argmin())
        time_b = int(np.linalg.norm(b - point, axis=1).argmin())
        # Who is past the point from the start has not passed it before the other.
        if time_a and abs(time_a - time_b) * step * scene.dt_s < 60.0:
            return time_a < time_b, float(time_a * step * scene.dt_s)
    return None


def _line(xy: Any) -> Any | None:
    keep = np.concatenate([[True], np.linalg.norm(np.diff(xy, axis=0), axis=1) > 1e-3])
    points = xy[keep]
    if len(points) < 2 or np.ptp(points, axis=0).max() < 1.0:
        return None
    return shapely.LineString(points)
