# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether all bodies are in the simulation."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.judging.build import EVERY_RUN, Inputs, Target, condition
from aurora_core.judging.evaluation import BoolArray, Context, Evaluation, Measured, Missing
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.quantity import QuantityName


class Presence(Quantity):
    """1 while all bodies exist, 0 while one does not."""

    name = QuantityName.PRESENCE
    kind: Literal['presence'] = 'presence'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return whether everybody is there at each tick, with the names of who is not."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        present = np.stack([context.view.present(name) for name in condition.of])
        everyone: BoolArray = np.asarray(present.all(axis=0))
        rows = tuple(zip(condition.of, present, strict=True))

        def absent(tick: int) -> str:
            return ', '.join(name for name, row in rows if not row[tick])

        return Measured(
            ticks=ticks,
            values=everyone.astype(np.float64)[ticks],
            label=absent,
            place_of=next((name for name, row in rows if not row.all()), None),
            evidence=('ground/state.present',),
        )


def implied(inputs: Inputs, agents: tuple[str, ...]) -> Condition:
    """Return that ground agents neither vanish nor come later."""
    return condition(
        id='safety.presence',
        sentence='every ground agent is there from t = 0 to the end',
        signal='present(all)',
        of=agents,
        target=Target(op='>=', threshold=0.5, unit='1'),
        arguments=Presence(**inputs.common, window=Window.RUN),
        source=EVERY_RUN,
    )
