# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The speed of an agent right before it is to slow down or stop: who stands has nothing to do."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    at_tick,
    ground_topics,
)
from aurora_core.judging.happening import agent_action, never_happened
from aurora_core.judging.quantity import OfEvent
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import whole_ticks
from aurora_core.spec.events import BRAKING, SLOWS
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event, ScenarioSpec, TimeTrigger
from aurora_core.spec.vocabulary import AgentType

# Who is told to creep is on the move at this share of that, and so is who has no time to be
# faster: all stand at t = 0.
_OF_STATED = _OF_GAINED = 0.5


class MovingBeforeAction(OfEvent):
    """Greatest speed of an agent from right before what slows it down is triggered, m/s.

    It counts until that is due: in a stated wait it may slow down for other reasons.

    Attributes:
        before_s: So long before the trigger; None: since t = 0.
    """

    name = QuantityName.SPEED
    kind: Literal['moving_before_action'] = 'moving_before_action'
    before_s: FiniteFloat | None

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that speed."""
        action = agent_action(context, condition, self.event)
        trigger, due = (
            context.events.trigger_tick(self.event),
            context.events.due_tick(self.event),
        )
        if trigger is None or due is None or due >= context.view.ticks:
            return never_happened(context, condition, f'{self.event} was never due')
        first = 0
        if self.before_s is not None:
            first = max(0, trigger - whole_ticks(self.before_s, context.view.dt_s))
        gone = context.gone(condition, np.arange(first, due + 1, dtype=np.intp))
        if gone is not None:
            return gone
        speed = motion.speed(context.view, context.view.body(action.agent))
        tick = first + int(np.argmax(speed[first : due + 1]))
        story = (
            f'{self.event} was due at {context.time_s(due):.2f} s; '
            f'{action.agent} had {speed[tick]:.2f} m/s at most right before'
        )
        topics = ground_topics(condition)
        return at_tick(tick, float(speed[tick]), story, topics)


def implied(inputs: Inputs, event: Event, action: AgentAction, source: Source) -> Condition | None:
    """Return that an agent is on the move when it is to slow down or stop.

    None where another event may have slowed it down before, and where nobody says when.
    """
    if event.trigger is None or action.do not in SLOWS:
        return None
    if _slowed_before(inputs.spec, event, action.agent):
        return None
    least_mps = _least_mps(inputs.spec, inputs.tolerances, action.agent)
    facts = inputs.agent_facts(action.agent)
    if isinstance(event.trigger, TimeTrigger) and facts is not None:
        gained_mps = facts.acceleration_mps2 * event.trigger.at_s.value
        least_mps = min(least_mps, _OF_GAINED * gained_mps)
    # Who is to yield may have been made to wait by traffic: it has come there.
    yields = action.do not in BRAKING
    before_s = None if yields else inputs.tolerances.acts_before_s
    when = 'since t = 0 before' if before_s is None else f'from {number(before_s)} s before'
    return condition(
        id=f'{event.id}.moving',
        sentence=(
            f'{action.agent} is at least {number(least_mps)} m/s fast at some time {when} the '
            f'trigger of {event.id} on, until that is due'
        ),
        signal=f'fastest_before({event.id})',
        of=(action.agent,),
        target=Target(op='>=', threshold=least_mps, unit='m/s'),
        arguments=MovingBeforeAction(**inputs.of_event(event.id), before_s=before_s),
        source=source,
        every_sample=False,
    )


def _least_mps(spec: ScenarioSpec, tolerances: Tolerances, name: str) -> float:
    agent = next((a for a in spec.agents if a.id == name), None)
    least_mps = tolerances.acts_from_mps
    if agent is not None and agent.type is AgentType.PEDESTRIAN:
        least_mps = tolerances.acts_from_on_foot_mps
    for behavior in () if agent is None else agent.behaviors:
        if behavior.speed_mps is not None:
            least_mps = min(least_mps, _OF_STATED * behavior.speed_mps.value)
    return least_mps


def _slowed_before(spec: ScenarioSpec, event: Event, agent: str) -> bool:
    """Tell whether what is told before makes an agent slow down, and nothing drive on."""
    slowed = False
    for other in spec.events:
        action = other.action
        if other == event:
            return slowed
        if isinstance(action, AgentAction) and action.agent == agent:
            slowed = action.do in SLOWS
    return slowed
