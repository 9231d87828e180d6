# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How fast bodies get from one recorded place to the next."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Measured,
    Missing,
    TickArray,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName


class Jump(Quantity):
    """Greatest displacement per second of any body from tick to tick, m/s."""

    name = QuantityName.JUMP
    kind: Literal['jump'] = 'jump'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the displacement of the fastest body at each tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view = context.view
        each = motion.jump_speeds(view, [view.body(name) for name in condition.of])
        values: FloatArray = np.max(each, axis=1)
        which: TickArray = np.asarray(np.argmax(each, axis=1))
        fastest = condition.of[int(which[int(np.argmax(values))])]
        return Measured(
            ticks=ticks,
            values=values[ticks],
            label=lambda tick: condition.of[int(which[tick])],
            place_of=fastest,
            evidence=('ground/state', 'uav/state'),
        )


def implied(inputs: Inputs, bodies: tuple[str, ...]) -> Condition:
    """Return that nobody is moved by anything but driving and flying."""
    limit = inputs.tolerances.jump_speed_mps
    return condition(
        id='safety.jump',
        sentence=f'no body jumps: at most {number(limit)} m/s from tick to tick',
        signal='jump(all)',
        of=bodies,
        target=Target(op='<=', threshold=limit, unit='m/s'),
        arguments=Jump(**inputs.common, window=Window.RUN),
        source=EVERY_RUN,
    )
