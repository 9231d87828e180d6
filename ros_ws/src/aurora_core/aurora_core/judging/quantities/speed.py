# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The speed of a body: flown, driven, commanded, and how hard it was lost."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import (
    EVERY_RUN,
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
)
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Later,
    Measured,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.series import Series, StatedSeries
from aurora_core.judging.until import moving_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick, longest_stretch
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent

# The length of a vector scaled to the limit may exceed it in the last bit.
_ROUNDING = 1e-9


class Speed(StatedSeries):
    """Speed, m/s: of a ground agent along its heading, of a UAV in space."""

    name = QuantityName.SPEED
    kind: Literal['speed'] = 'speed'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the speed at every tick."""
        return motion.speed(context.view, context.view.body(condition.of[0]))


class HorizontalSpeed(Series):
    """Speed of a UAV over ground, m/s."""

    name = QuantityName.SPEED
    kind: Literal['horizontal_speed'] = 'horizontal_speed'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the speed in the plane at every tick."""
        return motion.horizontal_speed(context.view, context.view.body(condition.of[0]))


class CommandedSpeed(Series):
    """Speed that a UAV is commanded to fly over ground, m/s."""

    name = QuantityName.SPEED
    kind: Literal['commanded_speed'] = 'commanded_speed'

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the commanded speed at every tick."""
        return motion.commanded_speed(context.view, context.view.body(condition.of[0]))

    def topics(self, condition: Condition) -> tuple[str, ...]:
        """Return the evidence: commands."""
        return tuple(f'uav/command[{name}]' for name in condition.of)


class GreatestSpeed(Quantity):
    """Speed of the fastest of several bodies, m/s; who is absent has none."""

    name = QuantityName.SPEED
    kind: Literal['greatest_speed'] = 'greatest_speed'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest speed at each tick."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        view = context.view
        each = np.stack([motion.speed(view, view.body(name)) for name in condition.of])
        greatest: FloatArray = np.max(each, axis=0)
        topics = tuple(f'state[{name}]' for name in condition.of)
        return Measured(ticks=ticks, values=greatest[ticks], evidence=topics)


class SpeedAfterMoving(Series):
    """Speed from when a body first moved on, m/s.

    Attributes:
        moving_mps: Speed that counts as moving.
    """

    name = QuantityName.SPEED
    kind: Literal['speed_after_moving'] = 'speed_after_moving'
    window: Window = Window.RUN
    moving_mps: FiniteFloat

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the speed at every tick."""
        return motion.speed(context.view, context.view.body(condition.of[0]))

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the speed from the first motion on; who never moves cannot stop."""
        ticks = self.ticks(context, condition)
        if isinstance(ticks, Missing):
            return ticks
        values = self.values(context, condition)
        moved = first_tick(values >= self.moving_mps, 0, int(ticks[-1]) + 1)
        if moved is None:
            return Missing(
                reason=Reason.PREMISE_NEVER, story=f'{condition.of[0]} never moved so fast'
            )
        later = ticks[ticks >= moved]
        return Measured(ticks=later, values=values[later], evidence=self.topics(condition))


class GreatestDeceleration(Quantity):
    """Hardest braking, m/s^2."""

    name = QuantityName.SPEED
    kind: Literal['greatest_deceleration'] = 'greatest_deceleration'
    window: Window = Window.RUN

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest loss of speed while the body is there."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        end = context.together_until(condition)
        if isinstance(end, Missing):
            return end
        loss = motion.deceleration(context.view, context.view.body(condition.of[0]))[:end]
        hardest = int(np.argmax(loss))
        topics = tuple(f'state[{name}]' for name in condition.of)
        return at_tick(hardest, float(loss[hardest]), evidence=topics, later=Later.RISES)


class LongestStandstill(Quantity):
    """Longest time for which a body stood in one stretch after it had moved, s.

    Attributes:
        still_mps: Speed below which it stands.
        moving_mps: Speed that counts as moving; who never moves has not come to a stop.
    """

    name = QuantityName.SPEED
    kind: Literal['longest_standstill'] = 'longest_standstill'
    window: Window = Window.RUN
    still_mps: FiniteFloat
    moving_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time from the first motion on."""
        end = moving_until(context, condition, self.moving_mps)
        if isinstance(end, Missing):
            return end
        values = motion.speed(context.view, context.view.body(condition.of[0]))[:end]
        moved = first_tick(values >= self.moving_mps)
        assert moved is not None
        still = values < self.still_mps
        still[:moved] = False
        stood = longest_stretch(still)
        topics = ground_topics(condition)
        if stood is None:
            return at_tick(end - 1, 0.0, evidence=topics, later=Later.RISES)
        first, last = stood
        stood_s = context.time_s(last - first)
        return at_tick(first, stood_s, evidence=topics, later=Later.RISES)


class GreatestDrop(Quantity):
    """By how much the speed fell below one that was driven before, m/s.

    Attributes:
        moving_mps: Speed that counts as moving; who never moves cannot slow down.
    """

    name = QuantityName.SPEED
    kind: Literal['greatest_drop'] = 'greatest_drop'
    window: Window = Window.RUN
    moving_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest drop."""
        end = moving_until(context, condition, self.moving_mps)
        if isinstance(end, Missing):
            return end
        values = motion.speed(context.view, context.view.body(condition.of[0]))[:end]
        drop = np.maximum.accumulate(values) - values
        tick = int(np.argmax(drop))
        topics = ground_topics(condition)
        return at_tick(tick, float(drop[tick]), evidence=topics, later=Later.RISES)


def slowed_to(inputs: Inputs, agent: GroundAgent, speed: Parameter, name: str) -> Condition:
    """Return that an agent holds the speed that it is to slow down to, after a higher one."""
    t = inputs.tolerances
    faster_mps = speed.value + t.slow_by_mps
    slack = t.action_speed_mps.of(speed.value, approximate=speed.approximate)
    bounded = speed.bound is Bound.AT_MOST
    return condition(
        id=f'{name}.speed',
        sentence=(
            f'{agent.id} drives {bound_words(speed)} {number(speed.value)} m/s for '
            f'{number(t.stop_hold_s)} s after at least {number(faster_mps)} m/s'
        ),
        of=(agent.id,),
        target=Target(
            op='<=' if bounded else '==',
            threshold=speed.value + slack if bounded else speed.value,
            tolerance=None if bounded else slack,
            unit='m/s',
        ),
        hold_s=t.stop_hold_s,
        arguments=SpeedAfterMoving(**inputs.common, moving_mps=faster_mps),
        source=Source(ids=(agent.id,), spans=(speed.span,), provenance=speed.provenance),
    )


def ground_limits(
    inputs: Inputs, persons: tuple[str, ...], vehicles: tuple[str, ...]
) -> Iterator[Condition]:
    """Yield that nobody on the ground is faster than its kind may be."""
    for name, of, limit in (
        ('vehicle_speed', vehicles, inputs.limits.vehicle_speed_max_mps),
        ('pedestrian_speed', persons, inputs.limits.pedestrian_speed_max_mps),
    ):
        if of:
            bound = limit * (1.0 + inputs.tolerances.limit_margin)
            yield condition(
                id=f'safety.{name}',
                sentence=f'{name.replace("_", " ")} at most {number(limit)} m/s',
                signal=f'greatest_{name}(all)',
                of=of,
                target=Target(op='<=', threshold=bound, unit='m/s'),
                arguments=GreatestSpeed(**inputs.common),
                source=EVERY_RUN,
            )


def flight_limits(inputs: Inputs, uav: str) -> Iterator[Condition]:
    """Yield that a UAV flies and is commanded no faster than it may be."""
    top = inputs.limits.uav_speed_max_mps
    slack = inputs.tolerances.route_speed_mps.of(top)
    yield condition(
        id=f'safety.speed.{uav}',
        sentence=f'{uav} flies at most {number(top)} m/s over ground',
        signal=f'horizontal_speed({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=top + slack, unit='m/s'),
        arguments=HorizontalSpeed(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
    yield condition(
        id=f'safety.speed_command.{uav}',
        sentence=f'{uav} is commanded to at most {number(top)} m/s over ground',
        signal=f'commanded_speed({uav})',
        of=(uav,),
        target=Target(op='<=', threshold=top * (1.0 + _ROUNDING), unit='m/s'),
        arguments=CommandedSpeed(**inputs.common, window=Window.AIRBORNE),
        source=EVERY_RUN,
    )
