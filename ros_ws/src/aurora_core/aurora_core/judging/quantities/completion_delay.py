# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How late what an event makes an agent or a UAV do is complete."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.errors import VerificationError
from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    stated_by,
)
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.happening import (
    EVENT_TOPICS,
    agent_action,
    never_happened,
    trigger_story,
    triggered,
)
from aurora_core.judging.mission import climb_mps, descent_mps
from aurora_core.judging.quantities.lane_change import the_lane
from aurora_core.judging.quantity import OfEvent
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.actions import ends_with_mps, least_climb_mps
from aurora_core.quantities.braking import least_mps2, most_mps2
from aurora_core.quantities.lane_changes import LANE_CHANGE_S
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.events import BRAKING
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event, UavAction

# Actions that end with a speed or lane of their own, and what is said of them without a number.
ENDS = {
    'stop': 'has stopped',
    'slow': 'has slowed down to half its speed',
    'accelerate': 'has gained its speed',
    'change_lane': 'is in the middle of another lane',
}


class CompletionDelay(OfEvent):
    """Time from when an action is due to its completion, beyond what it needs, seconds.

    It needs the change of speed divided by what the agent can do; a change of lane has its time,
    wherever it is. An action without a trigger is never late: it has to be
    complete at some time.

    Attributes:
        goal_mps: Stated speed that it ends with, 0 where none is stated.
        acceleration_mps2: What the agent can do to get to its speed.
    """

    name = QuantityName.COMPLETION_DELAY
    kind: Literal['completion_delay'] = 'completion_delay'
    goal_mps: FiniteFloat
    acceleration_mps2: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; what is not complete when it has to be is late."""
        action = agent_action(context, condition, self.event)
        times = context.events
        due = times.due_tick(self.event)
        asked = times.event(self.event)
        if asked is not None and asked.trigger is None:
            return self._at_some_time(context, condition)
        if due is None or due >= context.view.ticks:
            return never_happened(context, condition, f'{self.event} was never due')
        gone = context.gone(condition, np.array([due], dtype=np.intp))
        if gone is not None:
            return gone
        before_mps, needed_s = self._needed(context, condition, action, due)
        topics = ground_topics(condition)
        begin = f'{self.event} was due at {context.time_s(due):.2f} s with {before_mps:.2f} m/s'
        done = times.completion_tick(self.event)
        if done is not None:
            took_s = context.time_s(done - due)
            story = f'{begin}; it was complete {took_s:.2f} s later, {needed_s:.2f} s were needed'
            return at_tick(done, took_s - needed_s, story, topics)
        waited_s = context.time_s(context.view.ticks - due) - needed_s
        if waited_s > condition.threshold:
            story = f'{begin}; it was never complete, {needed_s:.2f} s would have been needed'
            return at_tick(due, waited_s, story, topics, later=Later.RISES, provisional=True)
        if context.complete(condition):
            late_s = condition.threshold + context.view.dt_s
            story = f'{begin}; the run was over before it was complete'
            return at_tick(due, late_s, story, topics)
        return context.short(condition)

    def _needed(
        self, context: Context, condition: Condition, action: AgentAction, due: int
    ) -> tuple[float, float]:
        """Return the speed with which the action begins, and the seconds that it needs."""
        rules = self.event_tolerances.actions
        if rules is None:
            raise VerificationError(f'condition {condition.id} has no rules of actions')
        speed = motion.speed(context.view, context.view.body(action.agent))
        before_mps = float(speed[due])
        if action.do == 'change_lane':
            return before_mps, LANE_CHANGE_S
        goal_mps = ends_with_mps(action, before_mps, rules)
        change_mps = 0.0 if goal_mps is None else abs(goal_mps - before_mps)
        return before_mps, change_mps / self.acceleration_mps2

    def _at_some_time(self, context: Context, condition: Condition) -> Evaluation:
        done = context.events.completion_tick(self.event)
        if done is None:
            return never_happened(context, condition, f'{self.event} was never complete')
        story = f'{self.event} was complete at {context.time_s(done):.2f} s'
        return at_tick(done, 0.0, story, ground_topics(condition))


class ClimbDelay(OfEvent):
    """Time from when a climb is due to its end, beyond what it needs, seconds.

    Attributes:
        altitude_m: Where it leads, above ground.
        tolerance_m: On that.
        climb_mps: Rate at which the UAV can climb on average.
        descent_mps: Rate at which it can sink.
    """

    name = QuantityName.COMPLETION_DELAY
    kind: Literal['climb_delay'] = 'climb_delay'
    altitude_m: FiniteFloat
    tolerance_m: FiniteFloat
    climb_mps: FiniteFloat
    descent_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; who is not up when it has to be is late."""
        (uav,) = condition.of
        due = context.events.due_tick(self.event)
        if due is None or due >= context.view.ticks:
            return never_happened(context, condition, f'{self.event} was never due')
        z_m = motion.altitude(context.view, context.view.body(uav))
        rise_m = self.altitude_m - float(z_m[due])
        needed_s = max(rise_m / self.climb_mps, -rise_m / self.descent_mps)
        topics = (f'uav/state[{uav}]',)
        begin = (
            f'{uav} was told to change its altitude at {context.time_s(due):.2f} s, '
            f'{z_m[due]:.2f} m high'
        )
        there = first_tick(np.abs(z_m - self.altitude_m) <= self.tolerance_m, due)
        if there is not None:
            took_s = context.time_s(there - due)
            story = f'{begin}; it was there {took_s:.2f} s later, {needed_s:.2f} s were needed'
            return at_tick(there, took_s - needed_s, story, topics)
        waited_s = context.time_s(context.view.ticks - due) - needed_s
        if waited_s > condition.threshold or context.complete(condition):
            late_s = max(waited_s, condition.threshold + context.view.dt_s)
            story = f'{begin}; it never got to {number(self.altitude_m)} m'
            later = Later.RISES if waited_s > condition.threshold else Later.ANY
            return at_tick(due, late_s, story, topics, later=later, provisional=True)
        return context.short(condition)


class DoneDelay(OfEvent):
    """Time from the trigger of an event to the end of what it makes somebody do, seconds.

    Attributes:
        tolerance_m: On the altitude that a UAV is to reach.
    """

    name = QuantityName.COMPLETION_DELAY
    kind: Literal['done_delay'] = 'done_delay'
    tolerance_m: FiniteFloat = 0.0

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that time; what is not over in it is late."""
        trigger = triggered(context, condition, self.event)
        if isinstance(trigger, Missing):
            return trigger
        begin = trigger_story(context, self.event, trigger)
        done = self._done(context, condition, trigger)
        if done is not None:
            took_s = context.time_s(done - trigger)
            return at_tick(
                done, took_s, f'{begin}; it was done {took_s:.2f} s later', EVENT_TOPICS
            )
        waited_s = context.time_s(context.view.ticks - trigger)
        if waited_s > condition.threshold or context.complete(condition):
            late_s = max(waited_s, condition.threshold + context.view.dt_s)
            story = f'{begin}; {self.event} was not done in the {waited_s:.2f} s after it'
            # Who has come to a stand in time may have stopped: it shows when that has lasted.
            rules = self.event_tolerances.actions
            open_s = condition.threshold + (0.0 if rules is None else rules.stop_hold_s)
            later = Later.RISES if waited_s > open_s else Later.ANY
            return at_tick(trigger, late_s, story, EVENT_TOPICS, later=later, provisional=True)
        return context.short(condition)

    def _done(self, context: Context, condition: Condition, trigger: int) -> int | None:
        asked = context.events.event(self.event)
        action = None if asked is None else asked.action
        if not isinstance(action, UavAction):
            return context.events.completion_tick(self.event)
        if action.lands:
            flight = context.events.rules.flights.get(action.uav)
            return None if flight is None else flight.landed_tick
        if action.altitude_m is None:
            return None
        z_m = motion.altitude(context.view, context.view.body(action.uav))
        return first_tick(np.abs(z_m - action.altitude_m.value) <= self.tolerance_m, trigger)


def of_climb(
    inputs: Inputs, event: Event, action: UavAction, altitude: Parameter, source: Source
) -> Condition:
    """Return that a UAV is soon where an event makes it climb to."""
    allowed_s = inputs.tolerances.action_done_s
    rates = climb_mps(inputs), descent_mps(inputs)
    if action.vertical_mps is not None:
        least = least_climb_mps(action.vertical_mps, inputs.tolerances.vertical_mps)
        rates = min(rates[0], least), min(rates[1], least)
    if altitude.provenance is Provenance.EXPLICIT:
        source = stated_by(source, altitude)
    return condition(
        id=f'{event.id}.completed',
        sentence=(
            f'{action.uav} is {number(altitude.value)} m high at most {number(allowed_s)} s later '
            f'than {number(rates[0])} m/s up and {number(rates[1])} m/s down allow'
        ),
        of=(action.uav,),
        target=Target(op='<=', threshold=allowed_s, unit='s'),
        arguments=ClimbDelay(
            **inputs.of_event(event.id),
            altitude_m=altitude.value,
            tolerance_m=inputs.tolerances.altitude_m.of(
                altitude.value, approximate=altitude.approximate
            ),
            climb_mps=rates[0],
            descent_mps=rates[1],
        ),
        source=source,
        every_sample=False,
    )


def implied(
    inputs: Inputs, event: Event, action: AgentAction, goal: Parameter | None, source: Source
) -> Condition:
    """Return that an agent completes what an event makes it do.

    Args:
        inputs: The request.
        event: Which event.
        action: What it makes the agent do.
        goal: Stated speed that this ends with.
        source: Where the condition comes from.
    """
    facts = inputs.agent_facts(action.agent)
    least = inputs.tolerances.route_acceleration_mps2
    if facts is not None:
        gains = action.do in ('accelerate', 'start')
        least = facts.acceleration_mps2 if gains else facts.deceleration_mps2
    if action.do in BRAKING:
        tolerance = inputs.tolerances.deceleration_mps2
        most = most_mps2(inputs.spec, action.agent, tolerance)
        least = least if most is None else min(least, most)
        if action.deceleration_mps2 is not None:
            least = least_mps2(action.deceleration_mps2, tolerance)
    done = ENDS.get(action.do, '')
    if action.side is not None:
        done = f'is in the middle of {the_lane(action.side)}'
    if goal is not None:
        done = f'has got to {bound_words(goal)} {number(goal.value)} m/s'
        if goal.provenance is Provenance.EXPLICIT:
            source = stated_by(source, goal)
    allowed_s = inputs.tolerances.action_done_s
    allow = f'{number(least)} m/s^2 allow'
    if action.do == 'change_lane':
        allow = f'the {number(LANE_CHANGE_S)} s of a change of lane'
    return condition(
        id=f'{event.id}.completed',
        sentence=f'{action.agent} {done} at most {number(allowed_s)} s later than {allow}',
        of=(action.agent,),
        target=Target(op='<=', threshold=allowed_s, unit='s'),
        arguments=CompletionDelay(
            **inputs.of_event(event.id),
            goal_mps=0.0 if goal is None else goal.value,
            acceleration_mps2=least,
        ),
        source=source,
        every_sample=False,
    )


def by_deadline(inputs: Inputs, event: Event, deadline_s: float, source: Source) -> Condition:
    """Return that what an event makes somebody do is over by a stated time after its trigger."""
    altitude = event.action.altitude_m if isinstance(event.action, UavAction) else None
    tolerance_m = 0.0
    if altitude is not None:
        tolerance_m = inputs.tolerances.altitude_m.of(
            altitude.value, approximate=altitude.approximate
        )
    return condition(
        id=f'{event.id}.done_within',
        sentence=f'{event.id} is done within {number(deadline_s)} s of its trigger',
        of=(event.id,),
        target=Target(op='<=', threshold=deadline_s, unit='s'),
        arguments=DoneDelay(**inputs.of_event(event.id), tolerance_m=tolerance_m),
        source=source,
        every_sample=False,
    )
