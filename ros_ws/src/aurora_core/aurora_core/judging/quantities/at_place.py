# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether an agent does at a place what it is to do there: stand, cross, or come by."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import Inputs, Source, Target, condition, number
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
from aurora_core.judging.series import Series
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind

# Who does one of these does it standing.
_STANDING = frozenset({BehaviorKind.STOP, BehaviorKind.WAIT, BehaviorKind.PARK})


class AtPlace(Quantity):
    """What is left of the distance to a place when an agent is nearest to it, metres.

    Attributes:
        near_m: How far from the place its front or rear may be.
        still_mps: Only samples below this speed count; None: all of them.
        hold_s: For how long it has to be that slow.
        moving_mps: Only from when it was once that fast: who has stopped there has come there.
    """

    name = QuantityName.HORIZONTAL_DISTANCE
    kind: Literal['at_place'] = 'at_place'
    window: Window = Window.RUN
    near_m: FiniteFloat
    still_mps: FiniteFloat | None = None
    hold_s: FiniteFloat = 0.0
    moving_mps: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest slack; who never stands is nowhere."""
        view = context.view
        name, place = condition.of
        there = view.present(name)
        if self.still_mps is not None:
            speed = motion.speed(view, view.body(name))
            there = there & _lasting(speed < self.still_mps, round(self.hold_s / view.dt_s))
            if self.moving_mps is not None:
                there &= np.logical_or.accumulate(speed >= self.moving_mps)
        ticks = np.flatnonzero(there)
        if len(ticks) == 0:
            if not context.complete(condition):
                return context.short(condition)
            story = f'{name} never {"stood" if self.moving_mps is None else "stopped"}'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        # From its nearest end: a bus at an intersection has its middle farther away than a car.
        reach_m = self.near_m + view.body(name).entry.length_m / 2.0
        left_m = reach_m - motion.horizontal_distance(view, name, place, on_road=True)
        best = int(ticks[int(np.argmax(left_m[ticks]))])
        topics = ground_topics(condition)
        return at_tick(best, float(left_m[best]), evidence=topics, later=Later.RISES)


class SpeedOnceThere(Series):
    """Speed of an agent from when it has come to rest at a place, having moved, m/s.

    Attributes:
        near_m: How far from the place its front or rear may be.
        still_mps: Slower than this it is at rest.
        hold_s: Once it has been so for so long.
        moving_mps: Speed that counts as moving.
    """

    name = QuantityName.SPEED
    kind: Literal['speed_once_there'] = 'speed_once_there'
    window: Window = Window.RUN
    near_m: FiniteFloat
    still_mps: FiniteFloat
    hold_s: FiniteFloat
    moving_mps: FiniteFloat

    def values(self, context: Context, condition: Condition) -> FloatArray:
        """Return the speed at every tick."""
        return motion.speed(context.view, context.view.body(condition.of[0]))

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the speed from then on; who does not come to rest there is not parked."""
        ticks = self.ticks(context, condition)
        if isinstance(ticks, Missing):
            return ticks
        view, (name, place) = context.view, condition.of
        speed = self.values(context, condition)
        reach_m = self.near_m + view.body(name).entry.length_m / 2.0
        near = motion.horizontal_distance(view, name, place, on_road=True) <= reach_m
        still = view.present(name) & near & (speed < self.still_mps)
        rests = _lasting(still, round(self.hold_s / view.dt_s))
        moved = first_tick(speed >= self.moving_mps)
        there = None if moved is None else first_tick(rests, moved)
        if there is None:
            if not context.complete(condition):
                return context.short(condition)
            story = f'{name} never came to rest there'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        later = ticks[ticks >= there]
        return Measured(ticks=later, values=speed[later], evidence=self.topics(condition))

    def topics(self, condition: Condition) -> tuple[str, ...]:
        """Return the evidence: where the agent is."""
        return ground_topics(condition)


def _lasting(good: np.ndarray, ticks: int) -> np.ndarray:
    """Return which samples belong to a stretch of at least `ticks` steps that are good, (T,)."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], good.astype(np.int8), [0]))))
    lasting = np.zeros(len(good), dtype=np.bool_)
    for begin, end in zip(edges[::2].tolist(), edges[1::2].tolist(), strict=True):
        lasting[begin:end] = end - begin > ticks
    return lasting


def implied(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, place: str, name: str
) -> Condition:
    """Return that an agent does what a behaviour says at a place."""
    t = inputs.tolerances
    stands = behavior.kind in _STANDING
    # A crosswalk is crossed where its middle is, not on the other side of the intersection.
    near_m = t.waypoint_horizontal_m if behavior.kind is BehaviorKind.CROSS else t.arrival_m
    done = {BehaviorKind.CROSS: 'crosses'}.get(behavior.kind, 'stands' if stands else 'gets')
    return condition(
        id=f'{name}.at',
        sentence=f'{agent.id} {done} within {number(near_m)} m of {place}',
        signal=f'at_place({agent.id},{place})',
        of=(agent.id, place),
        target=Target(op='>=', threshold=0.0, unit='m'),
        arguments=AtPlace(
            **inputs.common,
            near_m=near_m,
            still_mps=t.stop_speed_mps if stands else None,
            hold_s=t.stop_hold_s if stands else 0.0,
            moving_mps=t.moving_speed_mps if behavior.kind is BehaviorKind.STOP else None,
        ),
        source=Source(ids=(agent.id,), spans=(behavior.span or agent.span,)),
        every_sample=False,
    )


def parks(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, place: str, name: str
) -> Condition:
    """Return that an agent drives to a place and stays parked there."""
    t = inputs.tolerances
    return condition(
        id=name,
        sentence=(
            f'{agent.id} comes to rest within {number(t.arrival_m)} m of {place}, having driven, '
            f'and stays there: under {number(t.stop_speed_mps)} m/s from then on'
        ),
        signal=f'speed_once_there({agent.id},{place})',
        of=(agent.id, place),
        target=Target(op='<', threshold=t.stop_speed_mps, unit='m/s'),
        arguments=SpeedOnceThere(
            **inputs.common,
            near_m=t.arrival_m,
            still_mps=t.stop_speed_mps,
            hold_s=t.stop_hold_s,
            moving_mps=t.moving_speed_mps,
        ),
        source=Source(ids=(agent.id,), spans=(behavior.span or agent.span,)),
        every_sample=True,
    )
