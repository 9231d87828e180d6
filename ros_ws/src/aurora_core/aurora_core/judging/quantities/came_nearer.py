# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether an agent that goes to a place comes there from somewhere else."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent


class CameNearer(Quantity):
    """How much nearer an agent is to a place, while it is there, than it was before, metres.

    Attributes:
        near_m: How far from the place its front or rear may be.
    """

    name = QuantityName.HORIZONTAL_DISTANCE
    kind: Literal['came_nearer'] = 'came_nearer'
    window: Window = Window.RUN
    near_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest gain; of who never gets there, on the way."""
        view, (name, place) = context.view, condition.of
        present = view.present(name)
        if not present.any():
            return Missing(reason=Reason.TARGET_GONE, story=f'{name} is never there', tick=0)
        apart_m = motion.horizontal_distance(view, name, place, on_road=True)
        farthest_m = np.maximum.accumulate(np.where(present, apart_m, 0.0))
        reach_m = self.near_m + view.body(name).entry.length_m / 2.0
        there = present & (apart_m <= reach_m)
        ticks = np.flatnonzero(there if there.any() else present)
        gain_m = (farthest_m - apart_m)[ticks]
        best = int(np.argmax(gain_m))
        topics = ground_topics(condition)
        return at_tick(
            int(ticks[best]),
            float(gain_m[best]),
            evidence=topics,
            later=Later.ANY,
            provisional=True,
        )


def implied(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, place: str, name: str
) -> Condition:
    """Return that an agent comes to a place from somewhere else."""
    t = inputs.tolerances
    return condition(
        id=f'{name}.nearer',
        sentence=(
            f'{agent.id} comes to {place} from elsewhere: there it is at least '
            f'{number(t.approach_m)} m nearer to it than before'
        ),
        signal=f'came_nearer({agent.id},{place})',
        of=(agent.id, place),
        target=Target(op='>=', threshold=t.approach_m, unit='m'),
        arguments=CameNearer(**inputs.common, near_m=t.arrival_m),
        source=Source(ids=(agent.id,), spans=(behavior.span or agent.span,)),
        every_sample=False,
    )
