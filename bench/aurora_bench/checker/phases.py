# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Missions of a UAV: from when to when the recorded phase of the commands says."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from aurora_bench.checker import recording as rec
from aurora_bench.checker.scene import Scene


@dataclass(frozen=True, slots=True)
class Segment:
    """One mission of a UAV: ticks [start, end); the next phase's first command is at `end`.

    Attributes:
        number: 0 for the first mission.
        closed: Another phase follows (else the recording ends in flight).
        then_mission: That phase is another mission.
    """

    number: int
    start: int
    end: int
    closed: bool
    then_mission: bool


def segments(scene: Scene, uav: str) -> tuple[Segment, ...]:
    """Return the missions of a UAV in the order in which they were flown."""
    phase = scene.recording.phase[:, scene.bodies[uav].row]
    bounds = [0, *(int(i) + 1 for i in np.flatnonzero(np.diff(phase))), len(phase)]
    found: list[Segment] = []
    for a, b in itertools.pairwise(bounds):
        if rec.MISSION <= phase[a] < rec.HOLDING:
            closed = b < len(phase)
            then = bool(closed and rec.MISSION <= phase[b] < rec.HOLDING)
            found.append(Segment(len(found), a, b, closed, then))
    return tuple(found)


def missions_end_s(scene: Scene) -> float:
    """Return when the last mission of any UAV ends: with the recording where none does."""
    uavs = [name for name, body in scene.bodies.items() if body.is_uav]
    last = [flown[-1] for uav in uavs if (flown := segments(scene, uav))]
    if not last or not all(segment.closed for segment in last):
        return scene.end_s
    return float(max(scene.times[segment.end] for segment in last))


def landing_tick(scene: Scene, uav: str) -> int | None:
    """Return the tick of the first command of the landing."""
    phase = scene.recording.phase[:, scene.bodies[uav].row]
    ticks = np.flatnonzero(phase >= rec.LANDING)
    return int(ticks[0]) if len(ticks) else None


def ascent_end_tick(scene: Scene, uav: str) -> int:
    """Return the tick at which the ascent is over: the first command of the first mission.

    Without a mission it is the first tick of a landing, or the end of the recording.
    """
    found = segments(scene, uav)
    if found:
        return found[0].start
    landing = landing_tick(scene, uav)
    return scene.recording.ticks - 1 if landing is None else landing
