# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of the safety conditions of every run."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from aurora_core.monitor.evaluation import Context, Evaluation, FloatArray, Measured, Missing
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import contact, motion


def measure_collision_clearance(context: Context, condition: Condition) -> Evaluation:
    """Least gap of any two bodies, metres."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    least = contact.body_gap(context.view)
    return _measured(condition, ticks, least.values, least)


def measure_obstacle_clearance(context: Context, condition: Condition) -> Evaluation:
    """Distance of a flying UAV from the nearest building, vehicle or person, metres."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    least = contact.obstacle_clearance(context.view, context.view.body(condition.of[0]))
    return _measured(condition, ticks, least.values, least)


def _measured(
    condition: Condition,
    ticks: npt.NDArray[np.intp],
    values: FloatArray,
    least: contact.LeastSeries,
) -> Measured:
    return Measured(
        ticks=ticks,
        values=values[ticks],
        label=least.name_at,
        evidence=('ground/state', 'uav/state', 'world'),
    )


def measure_presence(context: Context, condition: Condition) -> Evaluation:
    """1 while all bodies exist, 0 while one does not."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    present = np.stack([context.view.present(name) for name in condition.of])
    everyone: npt.NDArray[np.bool_] = np.asarray(present.all(axis=0))
    values = everyone.astype(np.float64)

    def absent(tick: int) -> str:
        gone = [name for name, row in zip(condition.of, present, strict=True) if not row[tick]]
        return ', '.join(gone)

    first = next(
        (name for name, row in zip(condition.of, present, strict=True) if not row.all()), None
    )
    return Measured(
        ticks=ticks,
        values=values[ticks],
        label=absent,
        place_of=first,
        evidence=('ground/state.present',),
    )


def measure_jump(context: Context, condition: Condition) -> Evaluation:
    """Greatest displacement per second of any body from tick to tick, m/s."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    view = context.view
    each = motion.jump_speeds(view, [view.body(name) for name in condition.of])
    values: FloatArray = np.max(each, axis=1)
    which: npt.NDArray[np.intp] = np.asarray(np.argmax(each, axis=1))
    fastest = condition.of[int(which[int(np.argmax(values))])]
    return Measured(
        ticks=ticks,
        values=values[ticks],
        label=lambda tick: condition.of[int(which[tick])],
        place_of=fastest,
        evidence=('ground/state', 'uav/state'),
    )


def measure_no_fly(context: Context, condition: Condition) -> Evaluation:
    """Signed distance of a flying UAV from the nearest no-fly zone, metres."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    values = contact.no_fly_distance(context.view, context.view.body(condition.of[0]))
    return Measured(ticks=ticks, values=values[ticks], evidence=('uav/state', 'world'))
