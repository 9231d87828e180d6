# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long after an event a mission begins, and how long after a mission its UAV is higher up."""

from __future__ import annotations

from typing import Literal

from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, Missing, at_tick
from aurora_core.judging.happening import EVENT_TOPICS, moment, never_happened
from aurora_core.judging.quantity import OfEvent, OfMission
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities.actions import CLIMBED_M
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Order


class PhaseAfterEvent(OfEvent):
    """Time from an event to the first command of a mission, seconds; negative: too early.

    Attributes:
        mission: That is to come later.
    """

    name = QuantityName.EVENT_DELAY
    kind: Literal['phase_after_event'] = 'phase_after_event'
    mission: MissionArguments

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time."""
        caused = context.events.trigger_tick(self.event) is not None
        happened = moment(context, self.event) if caused else None
        if happened is None:
            return never_happened(context, condition, f'{self.event} never happened')
        begun = context.phase(self.mission, self.touchdown_m).command_tick
        if begun is None:
            if not context.complete(condition):
                return context.short(condition)
            story = f'{self.mission.mission} was never commanded'
            return Missing(reason=Reason.EMPTY_PHASE, story=story)
        story = (
            f'{self.event} happened at {context.time_s(happened):.2f} s, {self.mission.mission} '
            f'was commanded at {context.time_s(begun):.2f} s'
        )
        return at_tick(begun, context.time_s(begun - happened), story, EVENT_TOPICS)


class ClimbAfterPhase(OfMission):
    """Time from the end of a mission to where its UAV is first as high as asked, seconds.

    Attributes:
        goal_m: Height above ground, above that of the mission.
    """

    name = QuantityName.MISSION_COMPLETED
    kind: Literal['climb_after_phase'] = 'climb_after_phase'
    window: Window = Window.MOMENT
    goal_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time, negative where it was as high before the mission was over."""
        mission = self.mission
        ended = context.phase(mission, self.touchdown_m).end_tick
        height = context.view.reference(mission.uav)[:, 2]
        up = first_tick(height >= self.goal_m - CLIMBED_M)
        if ended is None or up is None:
            if not context.complete(condition):
                return context.short(condition)
            what = f'{mission.mission} never ended' if ended is None else 'it never was so high'
            return Missing(reason=Reason.PREMISE_NEVER, story=f'{mission.uav}: {what}')
        story = (
            f'{mission.mission} was over at {context.time_s(ended):.2f} s, {mission.uav} was '
            f'{number(self.goal_m)} m high at {context.time_s(up):.2f} s'
        )
        return at_tick(up, context.time_s(up - ended), story, self.phase_topics)


def event_first(
    inputs: Inputs, order: Order, mission: MissionArguments, source: Source
) -> Condition:
    """Return that a mission begins after the event that is to come before it."""
    sentence = f'{mission.uav} begins {mission.mission} after {order.first}'
    signal = f'time_between({order.first},{mission.mission})'
    arguments = PhaseAfterEvent(**inputs.of_event(order.first), mission=mission)
    return _after(order, arguments, sentence, signal, source)


def mission_first(
    inputs: Inputs, order: Order, mission: MissionArguments, goal_m: float, source: Source
) -> Condition:
    """Return that a UAV is as high as a climb asks only after the mission before that."""
    sentence = f'{mission.uav} is {number(goal_m)} m high only after {mission.mission}'
    signal = f'time_between({mission.mission},{order.then})'
    arguments = ClimbAfterPhase(**inputs.common, mission=mission, goal_m=goal_m)
    return _after(order, arguments, sentence, signal, source)


def _after(
    order: Order,
    arguments: PhaseAfterEvent | ClimbAfterPhase,
    sentence: str,
    signal: str,
    source: Source,
) -> Condition:
    return condition(
        id=f'{order.id}.holds',
        sentence=sentence,
        signal=signal,
        of=(arguments.mission.uav,),
        target=Target(op='>=', threshold=0.0, unit='s'),
        arguments=arguments,
        source=source,
        every_sample=False,
    )
