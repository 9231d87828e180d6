# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded speeds against recorded positions: what one of them hides the other shows."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import numpy.typing as npt

from aurora_core.monitor.evaluation import Context
from aurora_core.monitor.verdict import Finding
from aurora_core.quantities.kernels import distance_3d
from aurora_core.quantities.motion import jump_speed
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import Body
from aurora_core.spec.quantity import QuantityName
from aurora_core.trace.layout import GroundColumn, UavColumn

FloatArray = npt.NDArray[np.float64]

# Way and speed are compared over this time: a lane change or a landing disturbs single ticks.
_WINDOW_S = 1.0
# What way and speed of a vehicle may differ by in it (m): a part of its own, a share of its length
# and of the way, for the centre of a box cuts corners that the speed along the lane goes round.
_VEHICLE_M = 1.0
_OF_LENGTH = 0.2
_OF_WAY = 0.15
# A UAV reports both of one point (m).
_UAV_M = 0.5


def motion_findings(context: Context) -> Iterator[Finding]:
    """Yield, body by body, the first time at which its speed is not that of its way.

    A jump is no matter of speeds: it has a condition of its own.
    """
    view = context.view
    window = whole_ticks(_WINDOW_S, view.dt_s)
    if view.ticks <= window:
        return
    jump_mps = max(
        (c.threshold for c in context.conditions if c.quantity is QuantityName.JUMP),
        default=np.inf,
    )
    for body in (*view.agents, *view.uavs):
        if body.entry.is_person:
            continue  # the simulator moves walkers aside without telling it as a speed
        way, told, off, slack = _uav(context, body) if body.is_uav else _vehicle(context, body)
        counted = view.present(body.body_id)[1:] & view.present(body.body_id)[:-1]
        counted &= jump_speed(view, body)[1:] <= jump_mps
        off[~counted] = 0.0
        apart = np.linalg.norm(_sums(off, window), axis=1)
        wrong = np.flatnonzero(apart > slack + _OF_WAY * _sums(told, window) * (not body.is_uav))
        if len(wrong):
            first = int(wrong[0])
            yield Finding(
                kind='motion',
                subject=body.body_id,
                tick=first + window,
                time_s=context.time_s(first + window),
                text=(
                    f'moved {float(_sums(way, window)[first]):.2f} m in {_WINDOW_S:g} s, its '
                    f'speed says {float(_sums(told, window)[first]):.2f} m'
                ),
            )


def _sums(values: FloatArray, window: int) -> FloatArray:
    """Return the sums over every `window` rows that follow each other."""
    total = np.concatenate((np.zeros_like(values[:1]), np.cumsum(values, axis=0)))
    sums: FloatArray = total[window:] - total[:-window]
    return sums


def _vehicle(context: Context, body: Body) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return way, way by speed, their difference (T - 1, 1) along the heading, and its slack."""
    rows = context.view.rows(body)
    step = np.diff(rows[:, GroundColumn.X : GroundColumn.Y + 1], axis=0)
    heading = rows[:-1, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1]
    way = (step * heading).sum(axis=1)
    told = rows[1:, GroundColumn.SPEED] * context.view.dt_s
    return way, np.abs(told), (way - told)[:, None], _VEHICLE_M + _OF_LENGTH * body.entry.length_m


def _uav(context: Context, body: Body) -> tuple[FloatArray, FloatArray, FloatArray, float]:
    """Return way, way by velocity, their difference (T - 1, 3), and its slack."""
    rows = context.view.rows(body)
    step = np.diff(rows[:, UavColumn.X : UavColumn.Z + 1], axis=0)
    velocity = rows[:, UavColumn.VX : UavColumn.VZ + 1]
    told = (velocity[1:] + velocity[:-1]) / 2.0 * context.view.dt_s
    return _length(step), _length(told), step - told, _UAV_M


def _length(vectors: FloatArray) -> FloatArray:
    return distance_3d(vectors[:, 0], vectors[:, 1], vectors[:, 2])
