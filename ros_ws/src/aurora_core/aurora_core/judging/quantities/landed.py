# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When a UAV is down again."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.quantity import OfMissions
from aurora_core.judging.until import not_yet
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.spec.quantity import QuantityName


class Landed(OfMissions):
    """First sample on the ground after the landing command, seconds from scenario start."""

    name = QuantityName.LANDED
    kind: Literal['landed'] = 'landed'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; who is not down by the end of the run is late."""
        mission = self.missions[0]
        flight = context.flight(mission, self.touchdown_m)
        topics = (f'uav/state[{mission.uav}]',)
        if flight.landed_tick is not None:
            value = context.time_s(flight.landed_tick)
            story = f'{mission.uav} was down at {value:.2f} s'
            return at_tick(flight.landed_tick, value, story, topics)
        earliest_s = context.time_s(context.view.ticks)
        if earliest_s > condition.threshold or context.complete(condition):
            last_tick = context.view.ticks - 1
            story = f'{mission.uav} was not down at the end, {context.time_s(last_tick)} s'
            return not_yet(context, condition, last_tick, earliest_s, story, topics)
        return context.short(condition)


def by_deadline(
    inputs: Inputs,
    missions: tuple[MissionArguments, ...],
    *,
    id: str,
    source: Source,
    by_s: float | None = None,
) -> Condition:
    """Return that a UAV has landed after its missions.

    Args:
        inputs: The request.
        missions: All missions of the UAV, at least one.
        id: Of the condition.
        source: Where it comes from.
        by_s: Deadline from scenario start; default: the horizon.
    """
    uav = missions[-1].uav
    deadline_s = inputs.facts.horizon_s if by_s is None else by_s
    return condition(
        id=id,
        sentence=f'{uav} has landed by {number(deadline_s)} s',
        signal=f'landing_time({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=deadline_s, unit='s'),
        arguments=Landed(**inputs.common, missions=missions),
        source=source,
        every_sample=False,
    )
