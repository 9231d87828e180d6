# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How hard somebody brakes: at an event, and at most in the run."""

from __future__ import annotations

from typing import Literal

from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, at_tick, ground_topics
from aurora_core.judging.happening import agent_action, never_happened
from aurora_core.judging.quantities.speed import GreatestDeceleration
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.braking import mean_deceleration
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event


class BrakingDeceleration(OfEvent):
    """Mean fully developed deceleration with which an agent does what an event asks, m/s^2."""

    name = QuantityName.DECELERATION
    kind: Literal['braking_deceleration'] = 'braking_deceleration'

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the mean deceleration from the onset of the braking to its end."""
        action = agent_action(context, condition, self.event)
        times, view = context.events, context.view
        due, asked = times.due_tick(self.event), times.event(self.event)
        onset = None
        if due is not None or asked is None or asked.trigger is None:
            onset = times.action_tick(self.event, due or 0)
        if onset is None or onset == 0:
            return never_happened(context, condition, f'{self.event} was never carried out')
        body = view.body(action.agent)
        end = times.completion_tick(self.event)
        if action.do == 'brake' and action.value_mps is None:
            # It has no speed of its own to get to: it is over when the speed falls no more.
            slowing = motion.deceleration(view, body) >= self.event_tolerances.onset_mps2
            end = first_tick(~slowing, onset)
        if end is None:
            return never_happened(context, condition, f'{self.event} was never complete')
        speeds = motion.speed(view, body)[onset - 1 : end + 1]
        mean_mps2 = mean_deceleration(speeds, view.dt_s)
        if mean_mps2 is None:
            story = f'{action.agent} lost no speed for {self.event}'
            return never_happened(context, condition, story)
        story = (
            f'{action.agent} braked from {speeds[0]:.2f} to {speeds[-1]:.2f} m/s between '
            f'{context.time_s(onset - 1):.2f} and {context.time_s(end):.2f} s, with '
            f'{mean_mps2:.2f} m/s^2'
        )
        return at_tick(end, mean_mps2, story, ground_topics(condition))


class HardestBraking(GreatestDeceleration):
    """Hardest braking of an agent in the run, m/s^2."""

    name = QuantityName.DECELERATION
    kind: Literal['hardest_braking'] = 'hardest_braking'  # type: ignore[assignment]


def of_event(
    inputs: Inputs, event: Event, action: AgentAction, asked: Parameter, source: Source
) -> Condition:
    """Return that an agent brakes as hard for an event as the prompt says."""
    return condition(
        id=f'{event.id}.deceleration',
        sentence=(
            f'{action.agent} brakes with {bound_words(asked)} {number(asked.value)} m/s^2 '
            'on average'
        ),
        of=(action.agent,),
        target=number_target(asked, inputs.tolerances.deceleration_mps2),
        arguments=BrakingDeceleration(**inputs.of_event(event.id)),
        source=stated_by(source, asked),
        every_sample=False,
    )
