# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How long an agent does something: stands and then drives on, or moves without a stop."""

from __future__ import annotations

from typing import Literal, Protocol, runtime_checkable

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.errors import VerificationError
from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    number_target,
    stated_by,
)
from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.until import existing_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import longest_stretch, stretches, whole_ticks
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent

# A stretch that is too short is measured to this (s).
_MEASURED_S = 1.0


class StandingTime(Quantity):
    """Time for which a body stood in one stretch, seconds.

    Of several stretches the one that counts is the longest, of an exact time the one nearest to
    it. Who stands to the end of the run has not driven on: nobody knows how long that stretch is.

    Attributes:
        wanted_s: As stated.
        bound: How it binds.
        still_mps: Speed below which it stands.
        hold_s: Who stands for less has not stood.
        set_off_s: Of what it stands longer than stated so much is setting off.
        moving_mps: It has moved so fast before; None: it may stand from t = 0.
        place: Where it is to stand; None: anywhere.
        near_m: How far from there its front or rear may be.
    """

    name = QuantityName.BEHAVIOR_TIME
    kind: Literal['standing_time'] = 'standing_time'
    window: Window = Window.RUN
    wanted_s: FiniteFloat
    bound: Bound
    still_mps: FiniteFloat
    hold_s: FiniteFloat
    set_off_s: FiniteFloat
    moving_mps: FiniteFloat | None = omitted(None)
    place: str | None = omitted(None)
    near_m: FiniteFloat = omitted(0.0)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the time of the stretch that counts, 0 without any."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        found = stretches(self._stands(context, condition.of[0])[:end])
        if self.bound is not Bound.AT_LEAST:
            found = [one for one in found if one[1] < end]
        told = [(self._stood_s(context, *one), one[0]) for one in found]
        topics, exact = ground_topics(condition), self.bound is Bound.EXACTLY
        stood_s, begin = max(
            told, key=lambda one: -abs(one[0] - self.wanted_s) if exact else one[0],
            default=(0.0, end - 1),
        )  # fmt: skip
        if self.bound is Bound.AT_MOST and stood_s < self.hold_s:
            story = f'{condition.of[0]} never stood for {number(self.hold_s)} s and drove on'
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        story = (
            f'{condition.of[0]} stood for {stood_s:.2f} s from {context.time_s(begin):.2f} s on'
        )
        return at_tick(begin, stood_s, story, topics, later=Later.ANY if exact else Later.RISES)

    def _stands(self, context: Context, name: str) -> BoolArray:
        """Return where it stands as asked, (T,)."""
        view = context.view
        speed = motion.speed(view, view.body(name))
        still = speed < self.still_mps
        if self.moving_mps is not None:
            still &= np.logical_or.accumulate(speed >= self.moving_mps)
        if self.place is not None:
            reach_m = self.near_m + view.body(name).entry.length_m / 2.0
            still &= motion.horizontal_distance(view, name, self.place, on_road=True) <= reach_m
        return still

    def _stood_s(self, context: Context, begin: int, stop: int) -> float:
        stood_s = context.time_s(stop - begin)
        if self.bound is not Bound.EXACTLY:
            return stood_s
        return max(min(stood_s, self.wanted_s), stood_s - self.set_off_s)


@runtime_checkable
class _Counted(Protocol):
    """A share of samples: which of them count, and which are good."""

    def samples(self, context: Context, condition: Condition) -> tuple[BoolArray, BoolArray]:
        """Return both, (T,) each."""


class MotionTime(Quantity):
    """Longest time for which a body moved without a stop, seconds.

    Attributes:
        wanted_s: As stated.
        moving_mps: Speed above which it moves.
        kept: Conditions on shares of the time (ids) that hold in that time as well.
    """

    name = QuantityName.BEHAVIOR_TIME
    kind: Literal['motion_time'] = 'motion_time'
    window: Window = Window.RUN
    wanted_s: FiniteFloat
    moving_mps: FiniteFloat
    kept: tuple[str, ...] = omitted(())

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the length of the longest stretch that does."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        moves = (motion.speed(context.view, context.view.body(condition.of[0])) > self.moving_mps)[
            :end
        ]
        topics = ground_topics(condition)
        longest = longest_stretch(moves)
        if longest is None:
            return at_tick(end - 1, 0.0, evidence=topics, later=Later.RISES)
        shares = [_share(context, name, end) for name in self.kept]
        dt_s = context.view.dt_s
        most, step = longest[1] - longest[0], whole_ticks(_MEASURED_S, dt_s)
        asked = whole_ticks(self.wanted_s, dt_s)
        lengths = {most, *range(step, most, step), *([asked] if asked < most else [])}
        for length in sorted(lengths, reverse=True):
            begins = _all(moves, length)
            for counted, good, least in shares:
                begins &= _sums(good & counted, length) >= least * _sums(counted, length)
            if begins.any():
                begin, moved_s = int(np.argmax(begins)), context.time_s(length)
                story = f'{condition.of[0]} did so for {moved_s:.2f} s from '
                story += f'{context.time_s(begin):.2f} s on'
                return at_tick(begin, moved_s, story, topics, later=Later.ANY)
        return at_tick(longest[0], 0.0, evidence=topics, later=Later.ANY)


def _sums(mask: BoolArray, length: int) -> np.ndarray:
    """Return how many samples are true in each stretch of a length, (n - length + 1,)."""
    total = np.concatenate(([0], np.cumsum(mask)))
    sums: np.ndarray = total[length:] - total[:-length]
    return sums


def _all(mask: BoolArray, length: int) -> BoolArray:
    found: BoolArray = _sums(mask, length) == length
    return found


def _share(context: Context, name: str, end: int) -> tuple[BoolArray, BoolArray, float]:
    """Return which samples of a condition count, which are good, and the least share of them."""
    kept = next((c for c in context.conditions if c.id == name), None)
    if kept is None or not isinstance(kept.arguments, _Counted):
        raise VerificationError(f'there is no condition {name} on a share of samples')
    counted, good = kept.arguments.samples(context, kept)
    return counted[:end], good[:end], kept.threshold


def stands(
    inputs: Inputs,
    agent: GroundAgent,
    behavior: Behavior,
    duration: Parameter,
    place: str | None,
    name: str,
    *,
    moved: bool,
) -> Condition:
    """Return that an agent stands for as long as the prompt says, and drives on then.

    Args:
        inputs: Of the derivation.
        agent: Who stands.
        behavior: What it does.
        duration: Stated.
        place: Where it has a point; None: anywhere.
        name: Id of the condition.
        moved: It has moved before.
    """
    t = inputs.tolerances
    at = '' if place is None else f' within {number(t.arrival_m)} m of {place}'
    rests = 'stops after having moved, and stands' if moved else 'stands'
    ends = '' if duration.bound is Bound.AT_LEAST else ', and then goes on'
    return condition(
        id=name,
        sentence=(
            f'{agent.id} {rests}{at}: under {number(t.stop_speed_mps)} m/s for '
            f'{bound_words(duration)} {number(duration.value)} s{ends}'
        ),
        signal=f'standing_time({agent.id})',
        of=(agent.id,),
        target=number_target(duration, t.duration_s),
        arguments=StandingTime(
            **inputs.common,
            wanted_s=duration.value,
            bound=duration.bound,
            still_mps=t.stop_speed_mps,
            hold_s=min(t.stop_hold_s, duration.value),
            set_off_s=t.event_delay_s,
            moving_mps=t.moving_speed_mps if moved else None,
            place=place,
            near_m=0.0 if place is None else t.arrival_m,
        ),
        source=stated_by(_source(agent, behavior), duration),
        every_sample=False,
    )


def moves(
    inputs: Inputs,
    agent: GroundAgent,
    behavior: Behavior,
    duration: Parameter,
    kept: tuple[str, ...],
    name: str,
) -> Condition:
    """Return that an agent moves for as long as the prompt says; nobody says that it ends.

    Args:
        inputs: Of the derivation.
        agent: Who moves.
        behavior: What it does.
        duration: Stated.
        kept: Conditions on its speed or distance that hold meanwhile (ids).
        name: Id of the behaviour's own condition.
    """
    t = inputs.tolerances
    slack_s = t.duration_s.of(duration.value, approximate=duration.approximate)
    least_s = duration.value - (slack_s if duration.bound is Bound.EXACTLY else 0.0)
    meanwhile = f', while {" and ".join(kept)} hold' if kept else ''
    return condition(
        id=f'{name}.time',
        sentence=(
            f'{agent.id} is on the move for {bound_words(duration)} {number(duration.value)} s '
            f'without a stop: over {number(t.start_speed_mps)} m/s{meanwhile}'
        ),
        signal=f'motion_time({agent.id})',
        of=(agent.id,),
        target=Target(op='>=', threshold=max(0.0, least_s), unit='s'),
        arguments=MotionTime(
            **inputs.common, wanted_s=duration.value, moving_mps=t.start_speed_mps, kept=kept
        ),
        source=stated_by(_source(agent, behavior), duration),
        every_sample=False,
    )


def _source(agent: GroundAgent, behavior: Behavior) -> Source:
    return Source(ids=(agent.id,), spans=(behavior.span or agent.span,))
