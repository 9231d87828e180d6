# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Samples of the conditions on the scene as a whole: numbers of bodies, world, duration."""

from __future__ import annotations

import numpy as np

from aurora_core.monitor.evaluation import (
    Context,
    Evaluation,
    Later,
    Measured,
    Missing,
    at_tick,
)
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.vocabulary import Role


def measure_count(context: Context, condition: Condition) -> Evaluation:
    """How many bodies of the types there are at each tick.

    Those that nobody asked for by name count unless they are background; `all`: these, too.
    """
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    view, arguments = context.view, condition.arguments
    everybody = arguments.aspect == 'all'
    counted = [
        view.present(body.body_id)
        for body in (*view.agents, *view.uavs)
        if body.entry.type_name in arguments.types
        and (everybody or body.entry.role != Role.BACKGROUND.value or body.body_id in condition.of)
    ]
    values = np.zeros(view.ticks)
    for present in counted:
        values += present
    return Measured(ticks=ticks, values=values[ticks], evidence=('roster', 'ground/state'))


def measure_world_setting(context: Context, condition: Condition) -> Evaluation:
    """1 at each tick when the world that was run has the setting, else 0."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    name, asked = condition.arguments.aspect, condition.arguments.types
    found = getattr(context.view.world, name)
    story = f'the recorded world has {name.replace("_", " ")} {found}'
    return Measured(
        ticks=ticks,
        values=np.full(len(ticks), 1.0 if found in asked else 0.0),
        story=story,
        evidence=('world',),
    )


def measure_run_duration(context: Context, condition: Condition) -> Evaluation:
    """Simulated time of the last tick, seconds."""
    ticks = context.window(condition)
    if isinstance(ticks, Missing):
        return ticks
    last = int(ticks[-1])
    value = context.time_s(last)
    return at_tick(
        last,
        value,
        f'the run ended at {value:.2f} s',
        ('ground/state', 'uav/state'),
        later=Later.RISES,
        provisional=True,
    )
