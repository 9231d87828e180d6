# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Yielding: one gets slower, or waits, and the other one passes first.

Another vehicle passes when it gets ahead on the way of the one that yields: it crosses that way,
joins it, or overtakes there. A person passes by getting over that way, to its other side.
"""

from __future__ import annotations

from abc import abstractmethod
from math import inf
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, Underivable, condition, number
from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    FloatArray,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.happening import agent_action, never_happened, trigger_story
from aurora_core.judging.quantity import OfEvent, Quantity
from aurora_core.judging.relations import lead_on_route
from aurora_core.judging.until import existing_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick
from aurora_core.quantities.way_crossing import crossing_series
from aurora_core.spec.own_events import let_pass
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Event


class _Yielding(Quantity):
    """One of the two things that yielding is.

    Attributes:
        offset_m: How far from the way of the one that yields the other one may pass.
        near_m: Farther apart than this nobody lets anybody pass.
    """

    name = QuantityName.YIELDING
    window: Window = Window.RUN
    offset_m: FiniteFloat
    near_m: FiniteFloat = omitted(inf)

    def near(self, context: Context, condition: Condition, end: int) -> BoolArray:
        """Return at which of the first ticks the two are near each other, (end,)."""
        apart: FloatArray = motion.horizontal_distance(context.view, *condition.of)[:end]
        return apart <= self.near_m

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return it where there was somebody to yield to."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        a, b = condition.of
        if context.view.body(b).entry.is_person:
            return self.of_person(context, condition, end)
        offset = context.along(a, b).offset_m[:end]
        if first_tick(offset <= self.offset_m) is None:
            story = f'{b} never came to the way of {a}'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        ahead = lead_on_route(context, a, b, self.offset_m)[:end]
        start = first_tick(ahead <= 0.0)
        if start is None:
            story = f'{b} was ahead of {a} all the time: there was nothing to yield to'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        return self.of_pass(context, condition, ahead, start)

    @abstractmethod
    def of_pass(
        self, context: Context, condition: Condition, ahead: FloatArray, start: int
    ) -> Evaluation:
        """Return the measurement.

        Args:
            context: The run.
            condition: The condition that these arguments belong to.
            ahead: (n,) metres by which the other one is ahead, while both are there.
            start: First tick at which it is not.
        """

    @abstractmethod
    def of_person(self, context: Context, condition: Condition, end: int) -> Evaluation:
        """Return the measurement where the other one is on foot.

        Args:
            context: The run.
            condition: The condition that these arguments belong to.
            end: Tick until which both are there.
        """


class PassedFirst(_Yielding):
    """By how much the other one gets ahead, metres."""

    kind: Literal['passed_first'] = 'passed_first'

    def of_pass(
        self, context: Context, condition: Condition, ahead: FloatArray, start: int
    ) -> Evaluation:
        """Return the greatest lead that it has near the other one."""
        near = self.near(context, condition, len(ahead))
        if not near[start:].any():
            a, b = condition.of
            story = f'{b} never came within {number(self.near_m)} m of {a}'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        farthest = start + int(np.argmax(np.where(near, ahead, -inf)[start:]))
        most_m = float(ahead[farthest])
        topics = ground_topics(condition)
        return at_tick(farthest, most_m, evidence=topics, later=Later.RISES)

    def of_person(self, context: Context, condition: Condition, end: int) -> Evaluation:
        """Return how far ahead the person was once it was over the way."""
        tick, value_m = _crossing(context, condition, end)
        return at_tick(tick, value_m, evidence=ground_topics(condition), later=Later.ANY)


class SlowerBeforePassed(_Yielding):
    """By how much the speed fell until the other one had passed, m/s.

    Attributes:
        moving_mps: Speed that counts as moving.
    """

    kind: Literal['slower_before_passed'] = 'slower_before_passed'
    moving_mps: FiniteFloat

    def of_pass(
        self, context: Context, condition: Condition, ahead: FloatArray, start: int
    ) -> Evaluation:
        """Return the greatest drop; of who waited what it drives afterwards."""
        return self._drop(context, condition, len(ahead), first_tick(ahead > 0.0, start))

    def of_person(self, context: Context, condition: Condition, end: int) -> Evaluation:
        """Return the greatest drop until the person is over the way."""
        a, b = (context.view.body(name) for name in condition.of)
        _, _, crossed = crossing_series(context.view, a, b)
        return self._drop(context, condition, end, first_tick(crossed[:end]))

    def _drop(
        self, context: Context, condition: Condition, end: int, passed: int | None
    ) -> Evaluation:
        """Return the greatest drop until the other one has passed."""
        body = context.view.body(condition.of[0])
        speed = motion.speed(context.view, body)[:end]
        moved = first_tick(speed >= self.moving_mps)
        if moved is None:
            return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
        near = self.near(context, condition, end)
        if passed is not None and passed <= moved:
            # It waited: what it drives afterwards is what it did not drive before.
            tick = int(np.argmax(speed)) if near[passed] else passed
            value = float(speed[tick]) if near[passed] else 0.0
        else:
            until = speed if passed is None else speed[: passed + 1]
            drop = (np.maximum.accumulate(until) - until) * near[: len(until)]
            tick = int(np.argmax(drop))
            value = float(drop[tick])
        return at_tick(tick, value, evidence=ground_topics(condition), later=Later.RISES)


class PassedAfter(OfEvent):
    """By how much the other one gets ahead after an event, metres.

    Attributes:
        offset_m: How far from the way of the one that yields the other one may pass.
    """

    name = QuantityName.YIELDING
    kind: Literal['passed_after'] = 'passed_after'
    window: Window = Window.RUN
    offset_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest lead from when the event is due."""
        agent_action(context, condition, self.event)
        due = context.events.due_tick(self.event)
        if due is None:
            story = f'the trigger of {self.event} never happened'
            return never_happened(context, condition, story)
        end = context.together_until(condition)
        if isinstance(end, Missing):
            return end
        if due >= end:
            return never_happened(context, condition, f'{self.event} was never due')
        a, b = condition.of
        begin = trigger_story(context, self.event, due)
        topics = ground_topics(condition)
        if context.view.body(b).entry.is_person:
            tick, value_m = _crossing(context, condition, end)
            story = f'{begin}; {b} was {value_m:.2f} m ahead of {a}, or short of its other side'
            return at_tick(tick, value_m, story, topics, later=Later.ANY, provisional=True)
        ahead = lead_on_route(context, a, b, self.offset_m)[:end]
        farthest = due + int(np.argmax(ahead[due:]))
        most_m = float(ahead[farthest])
        return at_tick(
            farthest,
            most_m,
            f'{begin}; {b} was at most {most_m:.2f} m ahead of {a} after that',
            topics,
            later=Later.RISES,
            provisional=True,
        )


def _crossing(context: Context, condition: Condition, end: int) -> tuple[int, float]:
    """Return when a person was over the way of a vehicle, and how far ahead of its front then.

    Of a person that never was, where it came nearest to that, and how far short of it (negative).
    Until then anything may follow: who comes over behind the vehicle has not been let over.
    """
    a, b = (context.view.body(name) for name in condition.of)
    lead, beyond, crossed = crossing_series(context.view, a, b)
    tick = first_tick(crossed[:end])
    if tick is None:
        nearest = int(np.argmax(beyond[:end]))
        return nearest, float(beyond[nearest])
    return tick, float(lead[tick]) - a.entry.length_m / 2.0


def after_event(
    inputs: Inputs, event: Event, action: AgentAction, source: Source
) -> Condition | Underivable:
    """Return that the other one of an event gets ahead of the one that yields."""
    other = let_pass(inputs.spec, event)
    if other is None:
        return Underivable(element=event.id, what='whom it yields to', span=event.span)
    return condition(
        id=f'{event.id}.passed',
        sentence=f'{other} gets ahead of {action.agent} after {event.id} is triggered',
        signal=f'passes_first({other},{action.agent})',
        of=(action.agent, other),
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=PassedAfter(
            **inputs.of_event(event.id), offset_m=inputs.tolerances.route_offset_m
        ),
        source=source,
        every_sample=False,
    )
