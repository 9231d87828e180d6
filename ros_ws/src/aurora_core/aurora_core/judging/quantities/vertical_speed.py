# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The vertical speed of a UAV, up or down, as stated: in a phase, and at an event."""

from __future__ import annotations

from typing import Literal

import numpy as np

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import Context, Evaluation, FloatArray, at_tick
from aurora_core.judging.happening import never_happened
from aurora_core.judging.quantity import OfEvent
from aurora_core.judging.series import StatedSeries
from aurora_core.outcomes.condition import Condition
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Event, UavAction

# Between these shares of its way a climb is steady: it gains speed before and loses it after.
_FROM, _TO = 0.2, 0.8


class VerticalSpeed(StatedSeries):
    """Vertical speed of a UAV, up or down, m/s."""

    name = QuantityName.VERTICAL_SPEED
    kind: Literal['vertical_speed'] = 'vertical_speed'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the vertical speed at every tick."""
        return np.abs(motion.climb_rate(context.view, context.view.body(condition.of[0])))


class EventClimbRate(OfEvent):
    """Vertical speed with which a UAV goes where an event makes it climb or descend to, m/s.

    Attributes:
        altitude_m: Where it goes, above ground.
        tolerance_m: On that.
        greatest: The greatest one counts, not that over the steady part of the way.
    """

    name = QuantityName.VERTICAL_SPEED
    kind: Literal['event_climb_rate'] = 'event_climb_rate'
    altitude_m: float
    tolerance_m: float
    greatest: bool = omitted(False)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return that speed from when the event is due to when it is there."""
        (uav,) = condition.of
        times = context.events
        due, asked = times.due_tick(self.event), times.event(self.event)
        if due is None and asked is not None and asked.trigger is None:
            due = times.action_tick(self.event, 0)
        if due is None or due >= context.view.ticks:
            return never_happened(context, condition, f'{self.event} was never due')
        body = context.view.body(uav)
        z_m = motion.altitude(context.view, body)
        there = first_tick(np.abs(z_m - self.altitude_m) <= self.tolerance_m, due)
        if there is None:
            story = f'{uav} never got to {number(self.altitude_m)} m'
            return never_happened(context, condition, story)
        way_m = z_m[due : there + 1] - z_m[due]
        topics = (f'uav/state[{uav}]',)
        if self.greatest:
            rates = np.abs(motion.climb_rate(context.view, body)[due : there + 1])
            worst = int(np.argmax(rates))
            return at_tick(due + worst, float(rates[worst]), evidence=topics)
        gone = np.abs(way_m) / max(float(np.abs(way_m[-1])), 1e-9)
        first, last = (int(np.argmax(gone >= share)) for share in (_FROM, _TO))
        if last <= first:
            story = f'{uav} was at {number(self.altitude_m)} m when {self.event} was due'
            return never_happened(context, condition, story)
        took_s = context.time_s(last - first)
        rate_mps = float(np.abs(way_m[last] - way_m[first])) / took_s
        story = (
            f'{uav} went from {z_m[due + first]:.2f} to {z_m[due + last]:.2f} m in '
            f'{took_s:.2f} s, with {rate_mps:.2f} m/s'
        )
        return at_tick(due + last, rate_mps, story, topics)


def of_event(
    inputs: Inputs, event: Event, action: UavAction, asked: Parameter, source: Source
) -> Condition:
    """Return that a UAV climbs or descends as fast for an event as the prompt says."""
    assert action.altitude_m is not None  # ascend has one
    altitude = action.altitude_m
    slack_m = inputs.tolerances.altitude_m.of(altitude.value, approximate=altitude.approximate)
    greatest = asked.bound is Bound.AT_MOST
    how = 'at its fastest' if greatest else 'over the steady part of the way'
    return condition(
        id=f'{event.id}.vertical_speed',
        sentence=(
            f'{action.uav} goes to {number(altitude.value)} m with {bound_words(asked)} '
            f'{number(asked.value)} m/s up or down {how}'
        ),
        of=(action.uav,),
        target=number_target(asked, inputs.tolerances.vertical_mps),
        arguments=EventClimbRate(
            **inputs.of_event(event.id),
            altitude_m=altitude.value,
            tolerance_m=slack_m,
            greatest=greatest,
        ),
        source=stated_by(source, asked),
        every_sample=False,
    )
