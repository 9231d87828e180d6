# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How often a relation holds: of agents in motion, of a UAV the bearing from its target."""

from __future__ import annotations

from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.document import omitted
from aurora_core.judging.build import (
    Inputs,
    Source,
    bound_words,
    number,
    share_condition,
    stated_by,
)
from aurora_core.judging.evaluation import (
    BoolArray,
    Context,
    Evaluation,
    FloatArray,
    Missing,
    TickArray,
    ground_topics,
)
from aurora_core.judging.quantities.placement import near_m, offset_m, placed_distance_m
from aurora_core.judging.quantity import OfMission, Quantity
from aurora_core.judging.relations import (
    RELATION_WORDS,
    abreast_slack,
    bearing_error,
    relation_slack,
)
from aurora_core.judging.shares import share_of
from aurora_core.knowledge.limits import Tolerance
from aurora_core.outcomes.condition import Condition, MissionArguments, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import GroundAgent, Placement
from aurora_core.spec.vocabulary import AgentType, Relation


class RelationFraction(Quantity):
    """Share of the time in which a relation of two agents holds.

    Attributes:
        relation: Which one.
        offset_m: How far from a route a body may be.
        near_m: How far apart is still near, or at.
    """

    name = QuantityName.RELATION_FRACTION
    kind: Literal['relation_fraction'] = 'relation_fraction'
    window: Window = Window.MISSIONS
    relation: Relation
    offset_m: FiniteFloat
    near_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; who is absent is in no relation."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        values = relation_slack(context, condition, self)
        if self.relation in (Relation.LEFT, Relation.RIGHT):
            # Who drives on that side far ahead or behind does not drive beside it.
            values = np.minimum(values, abreast_slack(context, condition))
        good = values >= 0.0 if self.relation is Relation.BESIDE else values > 0.0
        a, b = condition.of
        what = f'{a} was {RELATION_WORDS[self.relation]} {b}'
        return _share(context, condition, ticks, good, values, what)


class DistanceFraction(Quantity):
    """Share of the time in which two agents are as far apart as their relation asks for.

    Attributes:
        relation: Which one; it says how the distance is measured.
        low_m: Least distance; None: any.
        high_m: Greatest distance; None: any.
        moving_mps: Only samples count at which the one in front, else the other one, is faster;
            None: all.
    """

    name = QuantityName.RELATION_FRACTION
    kind: Literal['distance_fraction'] = 'distance_fraction'
    window: Window = Window.MISSIONS
    relation: Relation
    low_m: FiniteFloat | None
    high_m: FiniteFloat | None
    moving_mps: FiniteFloat | None = omitted(None)

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share; who is absent is at no distance."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        counted, good = self.samples(context, condition)
        ticks = ticks[counted[ticks]]
        if self.moving_mps is not None and not len(ticks):
            if not context.complete(condition):
                return context.short(condition)
            story = (
                f'{self._leader(condition)} was never faster than {number(self.moving_mps)} m/s'
            )
            return Missing(reason=Reason.PREMISE_NEVER, story=story)
        values = placed_distance_m(context, condition, self.relation)
        a, b = condition.of
        what = f'{a} kept its distance from {b}'
        return _share(context, condition, ticks, good, values, what)

    def samples(self, context: Context, condition: Condition) -> tuple[BoolArray, BoolArray]:
        """Return which samples of the run count, and which are good."""
        values = placed_distance_m(context, condition, self.relation)
        counted = good = np.ones(len(values), dtype=np.bool_)
        if self.moving_mps is not None:
            leader = context.view.body(self._leader(condition))
            counted = motion.speed(context.view, leader) > self.moving_mps
        if self.low_m is not None:
            good = good & (values >= self.low_m)
        if self.high_m is not None:
            good = good & (values <= self.high_m)
        return counted, good

    def _leader(self, condition: Condition) -> str:
        return condition.of[0 if self.relation is Relation.AHEAD else 1]


class BearingFraction(OfMission):
    """Share of a mission in which a UAV is at a bearing from its target.

    Attributes:
        bearing_deg: Asked, compass.
        tolerance_deg: On it.
    """

    name = QuantityName.RELATION_FRACTION
    kind: Literal['bearing_fraction'] = 'bearing_fraction'
    bearing_deg: FiniteFloat
    tolerance_deg: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the share."""
        ticks = context.window(condition)
        if isinstance(ticks, Missing):
            return ticks
        values = bearing_error(context, condition, self.bearing_deg)
        a, b = condition.of
        what = f'{a} kept its bearing from {b}'
        return _share(context, condition, ticks, values <= self.tolerance_deg, values, what)


def _share(
    context: Context,
    condition: Condition,
    ticks: TickArray,
    good: BoolArray,
    values: FloatArray,
    what: str,
) -> Evaluation:
    a, b = condition.of
    good = good & context.view.present(a) & context.view.present(b)
    return share_of(context, ticks, good, values, what, ground_topics(condition))


def kept(
    inputs: Inputs, agent: GroundAgent, placement: Placement, of: str, name: str, source: Source
) -> Condition:
    """Return that a relation is kept in motion."""
    relation, share = placement.relation, _least_share(inputs, placement)
    return share_condition(
        id=f'{name}.kept',
        sentence=(
            f'{agent.id} stays {RELATION_WORDS[relation]} {of} for {number(100 * share)} % of the '
            'time until the last mission ends'
        ),
        signal=f'{relation.value}_fraction({agent.id},{of})',
        of=(agent.id, of),
        share=share,
        arguments=RelationFraction(
            **inputs.common,
            relation=relation,
            offset_m=offset_m(inputs, relation),
            near_m=near_m(inputs, relation, of),
        ),
        source=source,
    )


def distance_kept(
    inputs: Inputs, agent: GroundAgent, placement: Placement, of: str, name: str
) -> Condition | None:
    """Return that a stated distance is kept in motion, None where it is that at t = 0 only."""
    distance = placement.distance_m
    if distance is None or not placement.keeps_distance:
        return None
    share = _least_share(inputs, placement)
    low_m, high_m = _ends_m(distance, inputs.placement_tolerance(agent.id))
    words = RELATION_WORDS[placement.relation]
    exact = distance.bound is Bound.EXACTLY
    binds = '' if exact else f'{bound_words(distance)} '
    leader = agent.id if placement.relation is Relation.AHEAD else of
    moving_mps = None
    if exact and not placement.throughout:
        # Who closes up to one that waits at a signal still drives at its distance behind it.
        front = inputs.agent(leader)
        walks = front is not None and front.type is AgentType.PEDESTRIAN
        t = inputs.tolerances
        moving_mps = t.start_speed_mps if walks else t.follow_slow_mps
    counted = (
        'the time'
        if moving_mps is None
        else f'the time in which {leader} is faster than {number(moving_mps)} m/s'
    )
    return share_condition(
        id=f'{name}.distance_kept',
        sentence=(
            f'{agent.id} stays {binds}{number(distance.value)} m {words} {of} for '
            f'{number(100 * share)} % of {counted} until the last mission ends'
        ),
        signal=f'distance_{placement.relation.value}_fraction({agent.id},{of})',
        of=(agent.id, of),
        share=share,
        arguments=DistanceFraction(
            **inputs.common,
            relation=placement.relation,
            low_m=low_m,
            high_m=high_m,
            moving_mps=moving_mps,
        ),
        source=Source(ids=(agent.id,), spans=(distance.span,), provenance=distance.provenance),
    )


def _least_share(inputs: Inputs, placement: Placement) -> float:
    """Return for how much of the time a placement has to hold."""
    return 1.0 if placement.throughout else inputs.tolerances.relation_fraction


def _ends_m(distance: Parameter, tolerance: Tolerance) -> tuple[float | None, float | None]:
    """Return the least and the greatest distance that a stated one allows, metres."""
    slack_m = tolerance.of(distance.value, approximate=distance.approximate)
    if distance.bound is Bound.AT_LEAST:
        return distance.value, None
    if distance.bound is Bound.AT_MOST:
        return None, distance.value
    return distance.value - slack_m, distance.value + slack_m


def bearing_kept(
    inputs: Inputs, mission: MissionArguments, bearing: Parameter, target: str, source: Source
) -> Condition:
    """Return that a UAV stays at the stated bearing from its target."""
    share = inputs.tolerances.relation_fraction
    return share_condition(
        id=f'{mission.mission}.bearing',
        sentence=(
            f'{mission.uav} stays at bearing {number(bearing.value)} deg from {target} for '
            f'{number(100 * share)} % of {mission.mission}'
        ),
        signal=f'bearing_fraction({mission.uav},{target})',
        of=(mission.uav, target),
        share=share,
        arguments=BearingFraction(
            **inputs.common,
            mission=mission,
            bearing_deg=bearing.value,
            tolerance_deg=inputs.tolerances.bearing_deg,
        ),
        source=stated_by(source, bearing),
    )
