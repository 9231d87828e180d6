# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Recorded speeds against recorded positions: what one of them hides the other shows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from aurora_core.judging.evaluation import Context
from aurora_core.outcomes.verdict import Finding
from aurora_core.quantities.lanes import NO_LANE, lanes_of_rows, length_shares
from aurora_core.quantities.motion import jump_speeds
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.quantities.view import Body
from aurora_core.spec.quantity import QuantityName
from aurora_core.trace.layout import GroundColumn, UavColumn

FloatArray = npt.NDArray[np.float64]

# Way and speed are compared over this time: a lane change or a landing disturbs single ticks.
_WINDOW_S = 1.0
# What way and speed of a vehicle may differ by in it: so many metres, and a share of the way. The
# way is that of its front, whose speed it is: in a turn the centre of the box goes another one.
_VEHICLE_M = 1.0
_OF_WAY = 0.15
# Inside a junction the lanes of a turn count the same length: who drives outside of their middle
# goes by so much (m) more per radian: the width of a lane of which SUMO is told none. Elsewhere
# the lanes are known.
_ASIDE_M = 3.2
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
    shares = np.append(length_shares(view.world.lanes), 1.0)  # NO_LANE is the last one
    jump_mps = max(
        (c.threshold for c in context.conditions if c.quantity is QuantityName.JUMP),
        default=np.inf,
    )
    for body in (*view.agents, *view.uavs):
        if body.entry.is_person:
            continue  # the simulator moves walkers aside without telling it as a speed
        pace = _uav(context, body) if body.is_uav else _vehicle(context, body, shares)
        counted = view.present(body.body_id)[1:] & view.present(body.body_id)[:-1]
        counted &= jump_speeds(view, [body])[1:, 0] <= jump_mps
        off = np.where(counted[:, None], pace.off_m, 0.0)
        apart = np.linalg.norm(_sums(off, window), axis=1)
        wrong = np.flatnonzero(apart > pace.slack_m + _sums(pace.slack_each_m, window))
        if len(wrong):
            first = int(wrong[0])
            way, told = (float(_sums(s, window)[first]) for s in (pace.way_m, pace.told_m))
            yield Finding(
                kind='motion',
                subject=body.body_id,
                tick=first + window,
                time_s=context.time_s(first + window),
                text=f'moved {way:.2f} m in {_WINDOW_S:g} s, its speed says {told:.2f} m',
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class _Pace:
    """How a body got on from tick to tick.

    Attributes:
        way_m: By its positions, (T - 1,).
        told_m: By its speeds.
        off_m: Difference of the two, (T - 1, 1) of its front or (T - 1, 3).
        slack_m: What their sum may be off at any time.
        slack_each_m: And for what it does from tick to tick.
    """

    way_m: FloatArray
    told_m: FloatArray
    off_m: FloatArray
    slack_m: float
    slack_each_m: FloatArray


def _sums(values: FloatArray, window: int) -> FloatArray:
    """Return the sums over every `window` rows that follow each other."""
    total = np.concatenate((np.zeros_like(values[:1]), np.cumsum(values, axis=0)))
    sums: FloatArray = total[window:] - total[:-window]
    return sums


def _vehicle(context: Context, body: Body, shares: FloatArray) -> _Pace:
    rows = context.view.rows(body)
    heading = rows[:, GroundColumn.HEADING_X : GroundColumn.HEADING_Y + 1]
    front = rows.copy()
    front[:, GroundColumn.X : GroundColumn.Y + 1] += body.entry.length_m / 2.0 * heading
    lanes = lanes_of_rows(context.view.world, front)
    step = np.diff(front[:, GroundColumn.X : GroundColumn.Y + 1], axis=0)
    # Ahead, without what it moves aside in its lane; in a turn the front goes aside as well.
    least = (step * heading[:-1]).sum(axis=1)
    back = (lanes[:-1] != NO_LANE) & (least < 0.0)
    most = np.where(back, least, np.linalg.norm(step, axis=1))
    share = shares[lanes]
    told = rows[1:, GroundColumn.SPEED] * context.view.dt_s * (share[1:] + share[:-1]) / 2.0
    turned = np.linalg.norm(np.diff(heading, axis=0), axis=1)
    aside_m = np.where(lanes[:-1] == NO_LANE, _ASIDE_M, 0.0)
    return _Pace(
        way_m=most,
        told_m=told,
        off_m=(np.clip(told, least, most) - told)[:, None],
        slack_m=_VEHICLE_M,
        slack_each_m=_OF_WAY * np.abs(told) + aside_m * turned,
    )


def _uav(context: Context, body: Body) -> _Pace:
    rows = context.view.rows(body)
    step = np.diff(rows[:, UavColumn.X : UavColumn.Z + 1], axis=0)
    velocity = rows[:, UavColumn.VX : UavColumn.VZ + 1]
    told = (velocity[1:] + velocity[:-1]) / 2.0 * context.view.dt_s
    return _Pace(
        way_m=np.linalg.norm(step, axis=1),
        told_m=np.linalg.norm(told, axis=1),
        off_m=step - told,
        slack_m=_UAV_M,
        slack_each_m=np.zeros(len(step)),
    )
