# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""When an event happens."""

from __future__ import annotations

from typing import Literal

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import Context, Evaluation, at_tick
from aurora_core.judging.happening import moment, never_happened, unready_story
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event

Part = Literal['trigger', 'action']


class EventTime(OfEvent):
    """Time of an event, seconds from scenario start.

    Attributes:
        part: What of the event.
        done: When its action is complete: who has to have stopped by then stands.
    """

    name = QuantityName.EVENT_TIME
    kind: Literal['event_time'] = 'event_time'
    part: Part
    done: bool = omitted(False)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time."""
        tick = context.events.trigger_tick(self.event)
        if self.done:
            tick = context.events.completion_tick(self.event)
        elif self.part == 'action':
            tick = moment(context, self.event)
        if tick is None:
            return never_happened(context, condition, f'{self.event} never happened')
        due = context.events.due_tick(self.event)
        if self.part == 'action' and due is not None:
            # The time for which it was not possible does not count.
            possible = context.events.possible_tick(self.event, due)
            tick -= 0 if possible is None else possible - due
        value = context.time_s(tick)
        happened = 'was complete' if self.done else 'happened'
        story = f'{self.event} {happened} at {value:.2f} s{unready_story(context, self.event)}'
        return at_tick(tick, value, story, ('events',))


def happens(inputs: Inputs, event: Event, part: Part, source: Source) -> Condition:
    """Return that an event happens at some time."""
    horizon_s = inputs.facts.horizon_s
    return condition(
        id=f'{event.id}.happens',
        sentence=f'{event.id} happens by {number(horizon_s)} s',
        of=(event.id,),
        target=Target(op='<=', threshold=horizon_s, unit='s'),
        arguments=EventTime(**inputs.of_event(event.id), part=part),
        source=source,
        every_sample=False,
    )


def at(inputs: Inputs, event: Event, time: Parameter, delay_s: float, source: Source) -> Condition:
    """Return that an event happens at the time that the prompt says."""
    wanted_s = time.value + delay_s
    slack_s = inputs.tolerances.duration_s.of(wanted_s, approximate=time.approximate)
    return condition(
        id=f'{event.id}.time',
        sentence=f'{event.id} happens at {number(wanted_s)} s',
        of=(event.id,),
        target=Target(op='==', threshold=wanted_s, unit='s', tolerance=slack_s),
        arguments=EventTime(**inputs.of_event(event.id), part='action'),
        source=Source(ids=source.ids, spans=(time.span,), provenance=time.provenance),
        every_sample=False,
    )
