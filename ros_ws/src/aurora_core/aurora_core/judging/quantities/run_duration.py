# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long a run is."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import (
    Inputs,
    Source,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, Later, Missing, at_tick
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import ENVIRONMENT_ID


class RunDuration(Quantity):
    """Simulated time of the last tick, seconds."""

    name = QuantityName.RUN_DURATION
    kind: Literal['run_duration'] = 'run_duration'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return when the run ended."""
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


def implied(inputs: Inputs, duration: Parameter) -> Condition:
    """Return that the scenario is as long as the prompt says."""
    return condition(
        id='world.duration',
        sentence=f'the scenario lasts {number(duration.value)} s',
        signal='last_tick_time',
        of=(),
        target=number_target(duration, inputs.tolerances.duration_s),
        arguments=RunDuration(**inputs.common, window=Window.RUN),
        source=stated_by(Source(ids=(ENVIRONMENT_ID,)), duration),
        every_sample=False,
    )
