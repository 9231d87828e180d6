# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by what an event makes a ground agent do: it is done to its end.

That something changes after the trigger is a condition of every event; here is that the agent
comes to rest, gets to its speed, lets the other one pass, and does not set off too early.
"""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    bound_words,
    condition,
    number,
    stated_by,
)
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.events import bodies_of, sets_off
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event

# Actions that end with a speed of their own, and what is said of them without a number.
_ENDS = {
    'stop': 'has stopped',
    'slow': 'has slowed down to half its speed',
    'accelerate': 'has gained its speed',
}
# With a stated number these end with a speed, too.
_TO_A_SPEED = frozenset({'slow', 'accelerate', 'start', 'brake'})


def action_conditions(
    inputs: Inputs, event: Event, action: AgentAction, source: Source
) -> Iterator[Condition | Underivable]:
    """Yield that an agent completes what an event makes it do."""
    value = action.value_mps
    if value is not None and action.do not in _TO_A_SPEED:
        what = f'a speed of {number(value.value)} m/s with {action.do}'
        yield Underivable(element=event.id, what=what, span=value.span)
    if action.do in _ENDS or (action.do in _TO_A_SPEED and value is not None):
        yield _completed(inputs, event, action, source)
    if action.do == 'start' and event.trigger is not None:
        yield _at_rest(inputs, event, action, source)
    if action.do == 'yield':
        yield _passed(inputs, event, action, source)


def earliest_s(inputs: Inputs, event: Event) -> float:
    """Return how long after its trigger an event has to wait at least, seconds."""
    delay = event.delay_s
    if delay is None or delay.provenance is not Provenance.EXPLICIT:
        return 0.0
    slack_s = inputs.tolerances.duration_s.of(event.waits_s, approximate=delay.approximate)
    return max(0.0, event.waits_s - slack_s)


def _completed(inputs: Inputs, event: Event, action: AgentAction, source: Source) -> Condition:
    value = action.value_mps if action.do in _TO_A_SPEED else None
    facts = inputs.agent_facts(action.agent)
    least = inputs.tolerances.route_acceleration_mps2
    gains = action.do in ('accelerate', 'start')
    if facts is not None:
        least = facts.acceleration_mps2 if gains else facts.deceleration_mps2
    allowed_s = inputs.tolerances.action_done_s
    return condition(
        id=f'{event.id}.completed',
        sentence=(
            f'{action.agent} {_done(action, value)} at most {number(allowed_s)} s later than '
            f'{number(least)} m/s^2 allow'
        ),
        quantity=QuantityName.COMPLETION_DELAY,
        of=(action.agent,),
        target=Target(op='<=', threshold=allowed_s, unit='s'),
        arguments=inputs.arguments(
            Window.MOMENT,
            event=event.id,
            acceleration_mps2=least,
            wanted=0.0 if value is None else value.value,
        ),
        source=source if value is None else _stated(source, value),
        every_sample=False,
    )


def _done(action: AgentAction, value: Parameter | None) -> str:
    if value is None:
        return _ENDS[action.do]
    return f'has got to {bound_words(value)} {number(value.value)} m/s'


def _stated(source: Source, value: Parameter) -> Source:
    explicit = value.provenance is Provenance.EXPLICIT
    return stated_by(source, value) if explicit else source


def _at_rest(inputs: Inputs, event: Event, action: AgentAction, source: Source) -> Condition:
    """Return that an agent stands until it is to set off."""
    limit = inputs.tolerances.stop_speed_mps
    first = sets_off(inputs.spec.events, action.agent)
    since = 'from t = 0' if first == event else 'from when it has stopped'
    return condition(
        id=f'{event.id}.at_rest',
        sentence=f'{action.agent} stands {since} until {event.id} is triggered',
        quantity=QuantityName.SPEED,
        signal=f'speed_before({event.id})',
        of=(action.agent,),
        target=Target(op='<', threshold=limit, unit='m/s'),
        arguments=inputs.arguments(
            Window.MOMENT,
            aspect='before_event',
            event=event.id,
            after_s=earliest_s(inputs, event),
        ),
        source=source,
    )


def _passed(
    inputs: Inputs, event: Event, action: AgentAction, source: Source
) -> Condition | Underivable:
    others = [
        agent.id
        for agent in inputs.spec.agents
        if agent.id in bodies_of(event) and agent.id != action.agent
    ]
    if len(others) != 1:
        return Underivable(element=event.id, what='whom it yields to', span=event.span)
    return condition(
        id=f'{event.id}.passed',
        sentence=f'{others[0]} gets ahead of {action.agent} after {event.id} is triggered',
        quantity=QuantityName.YIELDING,
        signal=f'passes_first({others[0]},{action.agent})',
        of=(action.agent, others[0]),
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=inputs.arguments(
            Window.RUN,
            aspect='passed_after',
            event=event.id,
            offset_m=inputs.tolerances.route_offset_m,
        ),
        source=source,
        every_sample=False,
    )
