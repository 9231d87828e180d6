# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where an agent is at one moment: relation, distance or bearing, and whether it overtakes."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

import numpy as np
from pydantic import FiniteFloat

from aurora_core.judging.build import (
    Inputs,
    Source,
    Target,
    bound_words,
    condition,
    number,
    number_target,
)
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    FloatArray,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.relations import (
    RELATION_WORDS,
    bearing_error,
    before_place,
    lead_of,
    relation_slack,
)
from aurora_core.judging.until import existing_until
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.quantities import motion
from aurora_core.quantities.ticks import first_tick
from aurora_core.spec.parameter import Bound, Parameter, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import Behavior, GroundAgent, Placement
from aurora_core.spec.vocabulary import Place, Relation

_ALONG = (Relation.AHEAD, Relation.BEHIND, Relation.BEFORE)


class Placed(Quantity):
    """By how much a relation holds at t = 0, metres (`oncoming`: cosine).

    Attributes:
        relation: Which one.
        offset_m: How far from a route a body may be.
        near_m: How far apart is still near, or at.
    """

    name = QuantityName.PLACEMENT
    kind: Literal['placement'] = 'placement'
    window: Window = Window.START
    relation: Relation
    offset_m: FiniteFloat
    near_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the slack of the relation at t = 0."""
        gone = _absent(context, condition, 0)
        if gone is not None:
            return gone
        return _one(condition, 0, relation_slack(context, condition, self))


class PlacedDistance(Quantity):
    """Distance at t = 0, metres, along the route or straight as the relation means it.

    Attributes:
        relation: Which one.
    """

    name = QuantityName.PLACEMENT
    kind: Literal['placed_distance'] = 'placed_distance'
    window: Window = Window.START
    relation: Relation

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance at t = 0."""
        gone = _absent(context, condition, 0)
        if gone is not None:
            return gone
        return _one(condition, 0, placed_distance_m(context, condition, self.relation))


class PlacedBearing(Quantity):
    """By how much the bearing at t = 0 is off, degrees.

    Attributes:
        relation: Which one it belongs to.
        bearing_deg: Asked, compass.
    """

    name = QuantityName.PLACEMENT
    kind: Literal['placed_bearing'] = 'placed_bearing'
    window: Window = Window.START
    relation: Relation
    bearing_deg: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the error at t = 0."""
        gone = _absent(context, condition, 0)
        if gone is not None:
            return gone
        return _one(condition, 0, bearing_error(context, condition, self.bearing_deg))


class DistanceAtStart(Quantity):
    """Straight distance at t = 0, metres."""

    name = QuantityName.PLACEMENT
    kind: Literal['distance_at_start'] = 'distance_at_start'
    window: Window = Window.MOMENT

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance at t = 0."""
        gone = _absent(context, condition, 0)
        if gone is not None:
            return gone
        return _one(condition, 0, motion.distance(context.view, *condition.of))


class DistanceAtClosing(Quantity):
    """Straight distance when the first body begins to close in, metres.

    Attributes:
        still_mps: Speed below which a body stands.
    """

    name = QuantityName.PLACEMENT
    kind: Literal['distance_at_closing'] = 'distance_at_closing'
    window: Window = Window.MOMENT
    still_mps: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the distance at that moment; who never moves never closes in."""
        body = context.view.body(condition.of[0])
        start = motion.closing_start_tick(context.view, body, self.still_mps)
        if start is None:
            if not context.complete(condition):
                return context.short(condition)
            return Missing(reason=Reason.PREMISE_NEVER, story=f'{body.body_id} never moved')
        gone = _absent(context, condition, start)
        if gone is not None:
            return gone
        return _one(condition, start, motion.distance(context.view, *condition.of))


class Overtaking(Quantity):
    """By how much an agent gets ahead of another one, once it has been behind it, metres.

    Attributes:
        offset_m: How far from its route the other one may be.
    """

    name = QuantityName.PLACEMENT
    kind: Literal['overtaking'] = 'overtaking'
    window: Window = Window.RUN
    offset_m: FiniteFloat

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the greatest lead; who was never behind cannot overtake."""
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        a, b = condition.of
        behind = context.along(a, b)  # on the route of the one that overtakes
        lead = np.where(behind.offset_m <= self.offset_m, -behind.lead_m, 0.0)[:end]
        start = first_tick(lead < 0.0)
        if start is None:
            return Missing(reason=Reason.PREMISE_NEVER, story=f'{a} was never behind {b}')
        farthest = start + int(np.argmax(lead[start:]))
        most_m = float(lead[farthest])
        topics = ground_topics(condition)
        return at_tick(farthest, most_m, evidence=topics, later=Later.RISES)


def placed_distance_m(context: Context, condition: Condition, relation: Relation) -> FloatArray:
    """Return how far apart two bodies are as a relation means it, (T,) metres.

    Ahead, behind, before and in the same lane: along the route; all others straight.
    """
    view = context.view
    a, b = condition.of
    if relation is Relation.BEFORE and not view.has(b):
        return np.full(view.ticks, before_place(context, condition)[0])
    if relation in _ALONG:
        return lead_of(context, a, b, ahead=relation is Relation.AHEAD)[0]
    if relation is Relation.SAME_LANE:
        return np.abs(context.along(b, a).lead_m)
    return motion.horizontal_distance(view, a, b)


def _absent(context: Context, condition: Condition, tick: int) -> Missing | None:
    return context.gone(condition, np.array([tick], dtype=np.intp))


def _one(condition: Condition, tick: int, values: FloatArray) -> Evaluation:
    return at_tick(tick, float(values[tick]), evidence=ground_topics(condition))


def implied(
    inputs: Inputs, agent: GroundAgent, placement: Placement, of: str, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that an agent is where a placement says at t = 0: relation, distance, bearing."""
    relation, words = placement.relation, RELATION_WORDS[placement.relation]
    pair, distance = (agent.id, of), placement.distance_m
    stated = distance is not None and distance.provenance is Provenance.EXPLICIT
    # "100 m from City Hall" is no more than that: how near is near is left open.
    if not (stated and relation is Relation.NEAR and is_landmark(of)):
        yield condition(
            id=name,
            sentence=f'{agent.id} is {words} {of} at t = 0',
            signal=f'{relation.value}({agent.id},{of})',
            of=pair,
            target=Target(op='>' if relation in _ALONG else '>=', threshold=0.0, unit='m'),
            arguments=Placed(
                **inputs.common,
                relation=relation,
                offset_m=offset_m(inputs, relation),
                near_m=near_m(inputs, relation, of),
            ),
            source=source,
            every_sample=False,
        )
    if distance is not None and stated:
        yield condition(
            id=f'{name}.distance',
            sentence=f'{agent.id} is {_so_far(distance)} {words} {of} at t = 0',
            signal=f'distance_{relation.value}({agent.id},{of})',
            of=pair,
            target=number_target(distance, inputs.placement_tolerance(agent.id)),
            arguments=PlacedDistance(**inputs.common, relation=relation),
            source=Source(ids=(agent.id,), spans=(distance.span,), provenance=distance.provenance),
            every_sample=False,
        )
    bearing = placement.bearing_deg
    if bearing is not None and bearing.provenance is Provenance.EXPLICIT:
        yield condition(
            id=f'{name}.bearing',
            sentence=f'{agent.id} is at bearing {number(bearing.value)} deg from {of} at t = 0',
            signal=f'bearing_error({agent.id},{of})',
            of=pair,
            target=Target(op='<=', threshold=inputs.tolerances.bearing_deg, unit='deg'),
            arguments=PlacedBearing(**inputs.common, relation=relation, bearing_deg=bearing.value),
            source=Source(ids=(agent.id,), spans=(bearing.span,), provenance=bearing.provenance),
            every_sample=False,
        )


def _so_far(distance: Parameter) -> str:
    exact = distance.bound is Bound.EXACTLY
    return f'{"" if exact else f"{bound_words(distance)} "}{number(distance.value)} m'


def offset_m(inputs: Inputs, relation: Relation) -> float:
    """Return how far from a route a body may be, metres."""
    if relation in (Relation.SAME_LANE, Relation.ADJACENT_LANE):
        return inputs.tolerances.lane_offset_m
    return inputs.tolerances.route_offset_m


def near_m(inputs: Inputs, relation: Relation, of: str) -> float:
    """Return how far apart is still near, or at, metres."""
    if relation is Relation.NEAR:
        return inputs.tolerances.near_m
    on = relation in (Relation.ON, Relation.PARKED_AT, Relation.AT, Relation.BESIDE)
    strip = on and of == Place.ROADSIDE
    return inputs.tolerances.roadside_m if strip else inputs.tolerances.arrival_m


def closing(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    """Yield the distance from which an agent closes in, at t = 0 and when it begins to."""
    distance, other = behavior.closing_from_m, behavior.target
    if distance is None or other is None or distance.provenance is not Provenance.EXPLICIT:
        return
    still_mps = inputs.tolerances.stop_speed_mps
    for moment, when, arguments in (
        ('start', 'at t = 0', DistanceAtStart(**inputs.common)),
        (
            'closing',
            'when the closing starts',
            DistanceAtClosing(**inputs.common, still_mps=still_mps),
        ),
    ):
        yield condition(
            id=f'{name}.from_{moment}',
            sentence=f'{agent.id} is {number(distance.value)} m from {other} {when}',
            signal=f'distance_at_{moment}({agent.id},{other})',
            of=(agent.id, other),
            target=number_target(distance, inputs.placement_tolerance(agent.id)),
            arguments=arguments,
            source=Source(ids=(agent.id,), spans=(distance.span,), provenance=distance.provenance),
            every_sample=False,
        )
