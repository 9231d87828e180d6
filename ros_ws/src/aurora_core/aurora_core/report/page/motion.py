# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where everybody was, every few ticks: positions in decimetres, differences from before."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from aurora_core.report.page.numbers import FloatArray, whole
from aurora_core.report.scene.tracks import Box, Track
from aurora_core.report.visible import visible
from aurora_core.trace.layout import GroundColumn, UavColumn, UavPhase
from aurora_core.trace.trace import Trace

STEP_M = 0.1
_LEAST_S = 0.1
# So many numbers keep a page of many bodies and minutes small.
_MOST_NUMBERS = 400_000
_PER_SAMPLE = 4


def stride_of(trace: Trace) -> int:
    """Return how many ticks lie between two samples of the page."""
    bodies = len(trace.roster.agents) + len(trace.roster.uavs)
    finest = max(1, round(_LEAST_S / trace.roster.dt_s))
    needed = -(-trace.ticks * max(bodies, 1) * _PER_SAMPLE // _MOST_NUMBERS)
    return max(finest, needed)


def samples_of(trace: Trace, stride: int) -> npt.NDArray[np.intp]:
    """Return the ticks of the samples; the last one is the last tick of the run."""
    ticks = np.arange(0, trace.ticks, stride, dtype=np.intp)
    return ticks if ticks[-1] == trace.ticks - 1 else np.append(ticks, trace.ticks - 1)


def bodies_of(
    trace: Trace, tracks: tuple[Track, ...], colours: dict[str, str], box: Box, stride: int
) -> list[dict[str, Any]]:
    """Return every body with its motion, ground agents first.

    Args:
        trace: The run.
        tracks: Its bodies, as `tracks_of` gives them.
        colours: By body.
        box: Positions count from its south-western corner.
        stride: Ticks between two samples.
    """
    ticks = samples_of(trace, stride)
    agents = len(trace.roster.agents)
    found = []
    for row, track in enumerate(tracks):
        entry = track.entry
        position = track.position_m[ticks]
        there = np.asarray(np.isfinite(position[:, :2]).all(axis=1), dtype=np.bool_)
        if not there.any():
            continue
        kind = 'uav' if track.is_uav else 'person' if entry.is_person else 'vehicle'
        if track.is_uav:
            more = _flight(trace, track, row - agents, ticks)
        else:
            more = _drive(trace.ground[ticks, row, :])
        found.append(
            {
                'id': visible(track.name),
                'type': entry.type_name.replace('_', ' '),
                'kind': kind,
                'role': entry.role,
                'size': [entry.length_m, entry.width_m],
                'colour': colours[track.name],
                'there': _stretches(there),
                'x': whole(_filled(position[:, 0], there) - box.west, STEP_M),
                'y': whole(_filled(position[:, 1], there) - box.south, STEP_M),
                **more,
            }
        )
    return found


def _drive(states: FloatArray) -> dict[str, Any]:
    heading = np.arctan2(states[:, GroundColumn.HEADING_Y], states[:, GroundColumn.HEADING_X])
    return {
        'h': whole(_unwrapped(heading), 1.0),
        'v': whole(np.nan_to_num(states[:, GroundColumn.SPEED]), 0.1),
    }


def _flight(trace: Trace, track: Track, row: int, ticks: npt.NDArray[np.intp]) -> dict[str, Any]:
    states = trace.uav[ticks, row, :]
    qw, qx, qy, qz = (
        states[:, column] for column in (UavColumn.QW, UavColumn.QX, UavColumn.QY, UavColumn.QZ)
    )
    yaw = np.arctan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz))
    speed = np.hypot(states[:, UavColumn.VX], states[:, UavColumn.VY])
    return {
        'h': whole(_unwrapped(yaw), 1.0),
        'v': whole(np.nan_to_num(speed), 0.1),
        'z': whole(np.nan_to_num(states[:, UavColumn.Z]), STEP_M),
        'phases': _phases(trace, track),
    }


def _phases(trace: Trace, track: Track) -> list[tuple[float, str]]:
    """Return when each phase begins, and its name."""
    phase = np.nan_to_num(track.phase, nan=-1.0)
    changes = [0, *(np.flatnonzero(np.diff(phase) != 0.0) + 1).tolist(), len(phase)]
    return [
        (round(trace.time_s(start), 3), phase_name(phase[start])) for start, _ in pairwise(changes)
    ]


def phase_name(phase: float) -> str:
    """Return the word for a phase of a flight (`UavPhase`)."""
    if phase >= UavPhase.LANDING:
        return 'landing'
    if phase == UavPhase.HOLDING:
        return 'holding'
    if phase >= UavPhase.MISSION:
        return 'mission'
    return 'ascent' if phase == UavPhase.ASCENT else 'on the ground'


def _unwrapped(angle: FloatArray) -> FloatArray:
    """Return angles in degrees that never jump by a turn."""
    return np.degrees(np.unwrap(np.nan_to_num(angle)))


def _filled(values: FloatArray, there: npt.NDArray[np.bool_]) -> FloatArray:
    """Return values with the last known one where there is none."""
    index = np.where(there, np.arange(len(values)), -1)
    last = np.maximum.accumulate(index)
    last[last < 0] = int(np.flatnonzero(there)[0])
    return values[last]


def _stretches(there: npt.NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return first and last sample of each stretch in which a body is there."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], there.astype(np.int8), [0]))))
    return [(int(a), int(b) - 1) for a, b in edges.reshape(-1, 2)]
