# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Refuse conditions that exclude each other, or that a stated flight, link or phase excludes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import combinations

from aurora_core.feasibility.certificates import beyond, contradiction, told
from aurora_core.feasibility.facts import limit_facts, says, tolerance_facts
from aurora_core.feasibility.operands import AT_LEAST, AT_MOST, in_parts, upward, whole
from aurora_core.knowledge.limits import Limits, Tolerances
from aurora_core.outcomes.feasibility import Certificate, Fact, Rule
from aurora_core.spec.parameter import Bound, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import ScenarioSpec, StatedCondition, UavAction, UavMission
from aurora_core.spec.stated import is_stated, most
from aurora_core.spec.vocabulary import MissionMode

_SYMMETRIC = (QuantityName.DISTANCE, QuantityName.HORIZONTAL_DISTANCE, QuantityName.SEPARATION)
_REASONS = {
    Unit.METRE: 'spatial_contradiction',
    Unit.METRE_PER_SECOND: 'spatial_contradiction',
    Unit.SECOND: 'temporal_contradiction',
}


@dataclass(frozen=True, slots=True)
class _Asked:
    """What a condition leaves: the values of a quantity, for a share of the time."""

    condition: StatedCondition
    low: float
    high: float
    strict: bool
    share: float


def check_bounds(
    spec: ScenarioSpec, limits: Limits, tolerances: Tolerances
) -> Iterator[Certificate]:
    """Return bounds on one quantity without a common value, and what else rules a condition out.

    Args:
        spec: The request; its conditions are about what has their quantities.
        limits: Limits in force.
        tolerances: How far stated numbers may be missed.
    """
    yield from exclusive(spec, split=False)
    yield from _moved(spec, tolerances)
    yield from _watched(spec, tolerances)
    yield from _late(spec)
    yield from _close(spec, limits)


def exclusive(spec: ScenarioSpec, *, split: bool) -> Iterator[Certificate]:
    """`always below 30 m and always above 50 m`: of one quantity, of the same things.

    Args:
        spec: The request.
        split: Of bodies that do one thing after another: there it proves nothing.
    """
    asked = [a for c in spec.conditions for a in _asked(c)]
    for one, other in combinations(asked, 2):
        if not _same_quantity(spec, one.condition, other.condition):
            continue
        below, above = sorted((one, other), key=lambda a: a.high)
        gap = above.low - below.high
        apart = gap > 0.0 or (gap == 0.0 and (below.strict or above.strict))
        if not apart or below.share + above.share <= 1.0:
            continue
        if in_parts(spec, {*one.condition.of, *other.condition.of}) is not split:
            continue
        first, second = below.condition, above.condition
        yield contradiction(
            Rule.BOUNDS,
            _REASONS.get(second.value.unit, 'spatial_contradiction'),
            f'conditions/{other.condition.id}',
            f'{told(first)}, and {told(second)}: no value is both.',
            other.condition.span,
            (*_says(first), *_says(second)),
        )


def _asked(condition: StatedCondition) -> Iterator[_Asked]:
    if condition.hold_s is not None or condition.by_s is not None:
        return
    if not is_stated(condition.value) or condition.op == '==':
        return
    if condition.quantity == QuantityName.EVENT_TIME:  # told of by the network of times
        return
    share = 1.0 if condition.fraction is None else condition.fraction.value
    up, value = condition.op in AT_LEAST, condition.value.value
    low, high = (value, math.inf) if up else (-math.inf, value)
    yield _Asked(condition, low, high, condition.op in ('<', '>'), share)


def _same_quantity(spec: ScenarioSpec, one: StatedCondition, other: StatedCondition) -> bool:
    """Tell whether what one asks from above is at least what the other asks from below."""
    if one.quantity == other.quantity:
        if one.quantity in _SYMMETRIC:
            return set(one.of) == set(other.of)
        return one.of == other.of
    upper, lower = (one, other) if one.op in AT_MOST else (other, one)
    if upper.op not in AT_MOST or lower.op not in AT_LEAST:
        return False
    # Nobody is nearer than the way along the ground, nor than its height above it.
    if upper.quantity != QuantityName.DISTANCE:
        return False
    if lower.quantity == QuantityName.HORIZONTAL_DISTANCE:
        return set(upper.of) == set(lower.of)
    flying = {name for uav in spec.uavs for name in (uav.id, uav.group)}
    below = set(upper.of) - set(lower.of)
    aloft = lower.quantity == QuantityName.ALTITUDE and set(lower.of) < set(upper.of)
    return aloft and below.isdisjoint(flying)


def _says(condition: StatedCondition) -> tuple[Fact, ...]:
    base = f'conditions/{condition.id}'
    return (
        *says(f'{base}/quantity', condition.quantity),
        *says(f'{base}/op', condition.op),
        *says(f'{base}/value', condition.value),
        *says(f'{base}/fraction', condition.fraction),
    )


def _redirected(spec: ScenarioSpec) -> set[str]:
    return {e.action.uav for e in spec.events if isinstance(e.action, UavAction)}


def _moved(spec: ScenarioSpec, tolerances: Tolerances) -> Iterator[Certificate]:
    """Who hovers over a place all the time is asked to be fast all the time.

    A stated speed may be missed by so much: less than that proves nothing.
    """
    bodies = {a.id for a in spec.agents} | {u.id for u in spec.uavs}
    for condition in spec.conditions:
        fast = condition.quantity == QuantityName.SPEED and upward(condition)
        if not (fast and whole(condition)):
            continue
        flown = [m for m in spec.missions if m.uav == condition.of[0]]
        still = all(m.mode is MissionMode.HOVER and m.target not in bodies for m in flown)
        if not flown or not still or flown[0].uav in _redirected(spec):
            continue
        least = tolerances.route_speed_mps.absolute
        if condition.value.value > least:
            yield contradiction(
                Rule.STILL,
                'spatial_contradiction',
                f'conditions/{condition.id}',
                f'{told(condition)}; {flown[0].uav} hovers, so it stands still.',
                condition.span,
                (
                    *_says(condition),
                    *(f for m in flown for f in says(f'missions/{m.id}/mode', m.mode.value)),
                    *tolerance_facts(tolerances, 'route_speed_mps'),
                ),
            )


def _watched(spec: ScenarioSpec, tolerances: Tolerances) -> Iterator[Certificate]:
    """Longer in sight, or without a break, than the phases or the scenario last."""
    world = spec.world.duration_s
    end_s = most(world, 0.0, math.inf)
    for condition in spec.conditions:
        base = f'conditions/{condition.id}'
        seen = condition.quantity == QuantityName.VISIBLE_TIME and upward(condition)
        need = condition.value if seen else condition.hold_s
        path = f'{base}/{"value" if seen else "hold_s"}'
        if need is None or not is_stated(need) or need.bound is Bound.AT_MOST:
            continue
        flown = [m for m in spec.missions if m.uav == condition.of[0]] if seen else []
        phases_s = _longest_s(flown, tolerances)
        if flown and flown[0].uav in _redirected(spec):
            phases_s = math.inf
        if need.value <= min(end_s, phases_s):
            continue
        by_end = end_s <= phases_s
        what = 'the scenario lasts' if by_end else f'the phases of {flown[0].uav} last'
        facts = says('world/duration_s', world) if by_end else _durations(flown, tolerances)
        yield contradiction(
            Rule.WATCH,
            'temporal_contradiction',
            path,
            f'{condition.quantity} of {", ".join(condition.of)} needs {need.value:g} s; '
            f'{what} {min(end_s, phases_s):g} s at most.',
            need.span,
            (*says(path, need), *facts),
        )


def _longest_s(flown: list[UavMission], tolerances: Tolerances) -> float:
    """Return how long phases of sight last together at most; routes last as long as they need."""
    if not flown or any(m.mode is MissionMode.NAVIGATE for m in flown):
        return math.inf
    total = 0.0
    for mission in flown:
        stated = mission.duration_s
        if stated is None or not is_stated(stated):
            return math.inf
        slack = tolerances.duration_s.of(stated.value, approximate=stated.approximate)
        total += most(stated, slack, math.inf)
    return total


def _durations(flown: list[UavMission], tolerances: Tolerances) -> tuple[Fact, ...]:
    stated = (f for m in flown for f in says(f'missions/{m.id}/duration_s', m.duration_s))
    return (*stated, *tolerance_facts(tolerances, 'duration_s'))


def _late(spec: ScenarioSpec) -> Iterator[Certificate]:
    """A message is to be there before the stated latency of its link has passed."""
    for condition in spec.conditions:
        asked = condition.quantity == QuantityName.DELIVERY_LATENCY
        if not asked or condition.op not in (*AT_MOST, '==') or not is_stated(condition.value):
            continue
        for link in (k for k in spec.links if (k.sender, k.receiver) == condition.of):
            latency = link.latency_s
            least_s = 0.0 if latency.bound is Bound.AT_MOST else latency.value
            if is_stated(latency) and condition.value.value < least_s:
                path = f'links/{link.id}/latency_s'
                yield contradiction(
                    Rule.LATENCY,
                    'temporal_contradiction',
                    f'conditions/{condition.id}',
                    f'{told(condition)}, and the link has a latency of {least_s:g} s: no message '
                    'is there sooner.',
                    condition.span,
                    (*_says(condition), *says(path, latency)),
                )


def _close(spec: ScenarioSpec, limits: Limits) -> Iterator[Certificate]:
    """Two UAVs that are always to be nearer than two may be."""
    flying = {uav.id for uav in spec.uavs}
    for condition in spec.conditions:
        near = condition.quantity == QuantityName.DISTANCE and flying.issuperset(condition.of)
        near = near and condition.op in AT_MOST and is_stated(condition.value)
        if near and condition.value.value < limits.separation_min_m:
            yield beyond(
                Rule.CLOSENESS,
                'separation',
                condition.value,
                f'conditions/{condition.id}/value',
                ('separation_min_m', limits.separation_min_m),
                f'two UAVs keep at least {limits.separation_min_m:g} m apart; '
                f'{condition.value.value:g} m are asked for.',
                (
                    *says(f'conditions/{condition.id}/value', condition.value),
                    *limit_facts(limits, 'separation_min_m'),
                ),
            )
