# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The speed of an agent up to the trigger of what lets it set off: it stands until then."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import Inputs, Source, Target, condition
from aurora_core.judging.evaluation import Context, Evaluation, Measured, Missing, ground_topics
from aurora_core.judging.happening import agent_action, earliest_s, triggered
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick, whole_ticks
from aurora_core.spec.events import sets_off
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event, EventDoneTrigger


class SpeedBeforeEvent(OfEvent):
    """Speed of an agent up to the trigger of what lets it set off, m/s.

    From t = 0; of who is to start again from when it has come to rest.

    Attributes:
        after_s: How long after the trigger it still has to stand.
    """

    name = QuantityName.SPEED
    kind: Literal['speed_before_event'] = 'speed_before_event'
    after_s: FiniteFloat = 0.0

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the speed at each tick before it may set off."""
        action = agent_action(context, condition, self.event)
        trigger = triggered(context, condition, self.event)
        if isinstance(trigger, Missing):
            return trigger
        first = self._rests_from(context, action)
        if first is None or first > trigger:
            story = f'{action.agent} had not come to rest before {self.event} was triggered'
            return Missing(reason=Reason.EMPTY_PHASE, story=story, tick=trigger)
        wait = whole_ticks(self.after_s, context.view.dt_s)
        last = min(trigger + wait, context.view.ticks - 1)
        ticks = np.arange(first, last + 1, dtype=np.intp)
        gone = context.gone(condition, ticks)
        if gone is not None:
            return gone
        speed = motion.speed(context.view, context.view.body(action.agent))
        return Measured(ticks=ticks, values=speed[ticks], evidence=ground_topics(condition))

    def _rests_from(self, context: Context, action: AgentAction) -> int | None:
        first = sets_off(context.spec.events, action.agent)
        event = context.events.event(self.event)
        if first is not None and first.id == self.event:
            return 0
        trigger = None if event is None else event.trigger
        if isinstance(trigger, EventDoneTrigger):
            return self._stands_from(context, action, trigger.event)
        # It was to stop before, whichever event that was.
        stops = [
            self._stands_from(context, action, e.id)
            for e in context.spec.events
            if isinstance(e.action, AgentAction)
            and e.action.agent == action.agent
            and e.action.do in ('stop', 'brake', 'yield')
        ]
        return min((tick for tick in stops if tick is not None), default=None)

    def _stands_from(self, context: Context, action: AgentAction, before: str) -> int | None:
        """Return when another event is over: where the agent brakes or yields, once it stands."""
        done, event = context.events.done_tick(before), context.events.event(before)
        other = None if event is None else event.action
        rules = self.event_tolerances.actions
        if done is None or rules is None or not isinstance(other, AgentAction):
            return done
        if other.agent != action.agent or other.do not in ('brake', 'yield'):
            return done
        speed = motion.speed(context.view, context.view.body(action.agent))
        return first_tick(speed < rules.stop_mps, done)


def implied(inputs: Inputs, event: Event, action: AgentAction, source: Source) -> Condition:
    """Return that an agent stands until it is to set off."""
    first = sets_off(inputs.spec.events, action.agent)
    since = 'from t = 0' if first == event else 'from when it has stopped'
    return condition(
        id=f'{event.id}.at_rest',
        sentence=f'{action.agent} stands {since} until {event.id} is triggered',
        signal=f'speed_before({event.id})',
        of=(action.agent,),
        target=Target(op='<', threshold=inputs.tolerances.stop_speed_mps, unit='m/s'),
        arguments=SpeedBeforeEvent(**inputs.of_event(event.id), after_s=earliest_s(inputs, event)),
        source=source,
    )
