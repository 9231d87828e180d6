# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The stated speed of a driver or walker, kept wherever nothing is in the way."""

from __future__ import annotations

from abc import abstractmethod
from math import inf
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
)
from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    FloatArray,
    Missing,
)
from aurora_core.judging.quantity import PerSample, Quantity
from aurora_core.judging.shares import share_of
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import free_road, motion
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import AgentAction, Behavior, Event, GroundAgent, SpeedTrigger
from aurora_core.spec.slower import slower_mps
from aurora_core.spec.vocabulary import AgentType, Relation

_OTHER_SPEED = frozenset({'brake', 'stop', 'slow', 'accelerate', 'yield'})
# They are in the way on the carriageway only, and there for a moment.
_NO_LEADERS = frozenset({AgentType.PEDESTRIAN, AgentType.RSU})
_BEHIND = (Relation.BEHIND, Relation.BEFORE, Relation.SAME_LANE)


class _KeptSpeed(Quantity):
    """Share of the samples with nothing in the way in which an agent has its stated speed.

    Attributes:
        speed: Stated, m/s.
        moving_mps: Speed that counts as moving.
        least_s: A share of less time than this, seconds, shows nothing.
    """

    name = QuantityName.SPEED
    window: Window = Window.MISSIONS
    speed: PerSample
    moving_mps: FiniteFloat
    least_s: FiniteFloat = omitted(0.0)

    @abstractmethod
    def free(
        self, context: Context, condition: Condition, values: FloatArray
    ) -> tuple[BoolArray, str, bool]:
        """Return which samples count, and what it never did when none does.

        Last, whether later samples only add to them.

        Args:
            context: The run.
            condition: The condition that these arguments belong to.
            values: (T,) speed, m/s.
        """

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share of the samples that count."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        gone = context.gone(condition, ticks)
        if gone is not None:
            return gone
        body = context.view.body(condition.of[0])
        values = motion.speed(context.view, body)
        free, never, growing = self.free(context, condition, values)
        ticks = ticks[ticks < _told_otherwise(context, condition.of)]
        ticks = ticks[free[ticks]]
        shown_s = context.time_s(len(ticks))
        if len(ticks) == 0 or shown_s < self.least_s:
            story = f'{body.body_id} never {never}'
            if len(ticks) > 0:
                story = f'{body.body_id} {never} for {shown_s:.2f} s only'
            return Missing(reason=Reason.EMPTY_PHASE, story=story)
        what = f'{body.body_id} kept its speed'
        topics = tuple(f'state[{name}]' for name in condition.of)
        good = self.speed.good(values)
        return share_of(context, ticks, good, values, what, topics, growing=growing)

    def samples(self, context: Context, condition: Condition) -> tuple[BoolArray, BoolArray]:
        """Return which samples of the run count, and which are good; none once told otherwise."""
        values = motion.speed(context.view, context.view.body(condition.of[0]))
        counted, _, _ = self.free(context, condition, values)
        until = np.arange(len(values)) < _told_otherwise(context, condition.of)
        return counted | ~until, self.speed.good(values) & until


def _told_otherwise(context: Context, of: tuple[str, ...]) -> int:
    """Return the tick from which on an event gives one of some bodies another speed.

    Or waits for it to be slow: the request itself says that it has its speed until then.
    """
    due = [
        context.events.due_tick(event.id)
        for event in context.spec.events
        if _tells_otherwise(event, of)
    ]
    return min((tick for tick in due if tick is not None), default=context.view.ticks)


def _tells_otherwise(event: Event, of: tuple[str, ...]) -> bool:
    action, trigger = event.action, event.trigger
    if isinstance(trigger, SpeedTrigger) and trigger.on == 'speed_below' and trigger.who in of:
        return True
    return isinstance(action, AgentAction) and action.agent in of and action.do in _OTHER_SPEED


class WalkingSpeed(_KeptSpeed):
    """Of a walker: the samples in which it walks count."""

    kind: Literal['walking_speed'] = 'walking_speed'

    def free(
        self, context: Context, condition: Condition, values: FloatArray
    ) -> tuple[BoolArray, str, bool]:
        """Return where it walks."""
        return values >= self.moving_mps, 'walked', True


class FreeSpeed(_KeptSpeed):
    """Of a vehicle: the samples on a free road count.

    The other bodies of the condition are no leaders that keep it from its speed.

    Attributes:
        settle_m: Way that it needs to reach its speed.
        free_m: No leader and no junction within this distance.
        lane_offset_m: How far off its way a leader may be.
        slower: Leaders who are to drive slower, by the request itself: it catches up with them.
        closed_m: Nearer than this behind one of them it has caught up ...
        least_mps: ... while that one is slower than this.
    """

    kind: Literal['free_speed'] = 'free_speed'
    settle_m: FiniteFloat
    free_m: FiniteFloat
    lane_offset_m: FiniteFloat
    slower: tuple[str, ...] = omitted(())
    closed_m: FiniteFloat = omitted(0.0)
    least_mps: FiniteFloat | None = omitted(None)

    def free(
        self, context: Context, condition: Condition, values: FloatArray
    ) -> tuple[BoolArray, str, bool]:
        """Return where the road is free."""
        view = context.view
        body, *followed = (view.body(name) for name in condition.of)
        besides = tuple(other.body_id for other in followed)
        good = self.speed.good(values)
        free = free_road.under_way(view, body, self.moving_mps, self.settle_m, good)
        free &= free_road.free_of_junctions(view, body, self.free_m)
        besides += self.slower
        never = 'drove free of junctions'
        if self.slower:
            rest = tuple(a.body_id for a in view.agents if a.body_id not in self.slower)
            below_mps = inf if self.least_mps is None else self.least_mps
            free &= free_road.free_of_leaders(
                view, body, self.closed_m, self.lane_offset_m, rest, below_mps
            )
            never += ' before it had caught up'
        alone = free & free_road.free_of_leaders(
            view, body, self.free_m, self.lane_offset_m, besides
        )
        # Where somebody is ahead all the way, that is no excuse.
        return (alone, never, True) if alone.any() else (free, never, False)


def _followed(inputs: Inputs, agent: GroundAgent, behavior: Behavior) -> tuple[str, ...]:
    """Return who may be in front and excuses nothing.

    Whoever is there because the request says so, and who is to go as fast.
    """
    named = [behavior.target or '']
    named += [p.of or '' for p in agent.placements if p.relation in _BEHIND]
    for other in inputs.spec.agents:
        ahead = any(p.of == agent.id and p.relation is Relation.AHEAD for p in other.placements)
        named += [other.id] if ahead or _as_fast(other, behavior) else []
    known = [n for n in named if n != agent.id and inputs.agent(n) is not None]
    return tuple(dict.fromkeys(known))


def _slower(
    inputs: Inputs, agent: GroundAgent, followed: tuple[str, ...], speed: Parameter
) -> dict[str, float]:
    """Return who is to be slower than a stated speed that is no upper bound, and how slow, m/s."""
    if speed.bound is Bound.AT_MOST:
        return {}
    found = {
        other.id: slower_mps(other, speed.value)
        for other in inputs.spec.agents
        if other.id in followed or (other.id != agent.id and other.type not in _NO_LEADERS)
    }
    return {name: slow_mps for name, slow_mps in found.items() if slow_mps is not None}


def _as_fast(other: GroundAgent, behavior: Behavior) -> bool:
    wanted = behavior.speed_mps
    told = [b.speed_mps.value for b in other.behaviors if b.speed_mps is not None]
    return wanted is not None and wanted.value in told


def implied(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, speed: Parameter, name: str
) -> Condition:
    """Return that an agent has its stated speed wherever it can."""
    t = inputs.tolerances
    walks = agent.type is AgentType.PEDESTRIAN
    # Whom it follows is no leader that keeps it from its speed: both are asked together.
    of = (agent.id,) if walks else (agent.id, *_followed(inputs, agent, behavior))
    slow_mps = {} if walks else _slower(inputs, agent, of[1:], speed)
    slower = tuple(slow_mps)
    # A metre per second is most of a walk.
    tolerance = t.walking_speed_mps if walks else t.route_speed_mps
    slack = tolerance.of(speed.value, approximate=speed.approximate)
    where = f'with no {"other " if len(of) > 1 else ""}leader or junction within'
    rest = 'while it walks' if walks else f'{where} {number(t.free_road_m)} m'
    rest += f', until it has caught up with {" and ".join(slower)}' if slower else ''
    told = any(_tells_otherwise(e, of) for e in inputs.spec.events)
    rest += ', until it or who is ahead of it is told otherwise' if told else ''
    wanted = PerSample.of(speed, slack)
    return condition(
        id=f'{name}.speed',
        sentence=(
            f'{agent.id} {"walks" if walks else "drives"} {bound_words(speed)} '
            f'{number(speed.value)} m/s for {number(100 * t.route_speed_share)} % of the time '
            f'{rest}'
        ),
        signal=f'free_speed_share({agent.id})',
        of=of,
        target=Target(op='>=', threshold=t.route_speed_share, unit='1'),
        fraction=t.route_speed_share,
        arguments=WalkingSpeed(**inputs.common, speed=wanted, moving_mps=t.stop_speed_mps)
        if walks
        else FreeSpeed(
            **inputs.common,
            speed=wanted,
            moving_mps=t.moving_speed_mps,
            least_s=t.free_road_s,
            settle_m=speed.value * speed.value / (2.0 * t.route_acceleration_mps2),
            free_m=t.free_road_m,
            lane_offset_m=t.lane_offset_m,
            slower=slower,
            closed_m=free_road.caught_up_m(
                speed.value, min(slow_mps.values()), t.tailgate_time_gap_s, t.brake_mps2
            )
            if slower
            else 0.0,
            least_mps=max(0.0, speed.value - slack) if slower else None,
        ),
        source=Source(ids=(agent.id,), spans=(speed.span,), provenance=speed.provenance),
        every_sample=False,
    )
