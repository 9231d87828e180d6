# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by behaviours of ground agents: a table of what each of them means."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Literal

from aurora_core.conditions.lasting import as_long, moves_for, stands_for, stated_distances
from aurora_core.grounding.going import comes_to
from aurora_core.grounding.places import has_point
from aurora_core.judging.build import Inputs, Source, Target, Underivable, condition, number
from aurora_core.judging.quantities import (
    at_place,
    came_nearer,
    free_speed,
    placement,
    relation_fraction,
    time_headway,
)
from aurora_core.judging.quantities.crossing import Crossing
from aurora_core.judging.quantities.distance import ClosedIn
from aurora_core.judging.quantities.distance_travelled import DistanceTravelled
from aurora_core.judging.quantities.follow_fraction import FollowFraction
from aurora_core.judging.quantities.lane_change import LaneChange
from aurora_core.judging.quantities.over_limit import OverLimit
from aurora_core.judging.quantities.placement import Overtaking
from aurora_core.judging.quantities.speed import (
    GreatestDeceleration,
    GreatestDrop,
    Speed,
    SpeedAfterMoving,
    slowed_to,
)
from aurora_core.judging.quantities.time_gap import TimeGap
from aurora_core.judging.quantities.turn import Turn
from aurora_core.judging.quantities.yielding import PassedFirst, SlowerBeforePassed
from aurora_core.judging.quantity import Quantity
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.condition import Condition, Op, Window
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.parking import parks, parks_after
from aurora_core.spec.scenario import Behavior, GroundAgent, Placement
from aurora_core.spec.vocabulary import BehaviorKind, Place, Relation

_Number = Callable[[Tolerances], float]


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """One condition that a behaviour implies.

    Attributes:
        says: Sentence about the agent, the other one ('' where there is none).
        quantity: What is measured.
        op: Comparison.
        least: What it is compared with.
        unit: Of that number.
        signal: In the formula, `{a}` for the agent and `{b}` for the other one; '': the quantity
            with its bodies.
        hold_s: How long it has to hold in one stretch.
        series: The worst sample counts, or the best stretch; else there is one number only.
        share: The number is a share of samples.
        part: Tells the conditions of one behaviour apart.
    """

    says: Callable[[str, str, Tolerances], str]
    quantity: Callable[[Inputs], Quantity]
    op: Op
    least: _Number
    unit: str
    signal: str = ''
    hold_s: _Number | None = None
    series: bool = False
    share: bool = False
    part: str = ''


def _moves(verb: str, least: _Number) -> tuple[_Row, ...]:
    return (
        _Row(
            says=lambda a, _, t: f'{a} {verb}: at least {number(least(t))} m',
            quantity=lambda inputs: DistanceTravelled(**inputs.common),
            op='>=',
            least=least,
            unit='m',
        ),
    )


def _stands(
    says: Callable[[str, str, Tolerances], str],
    quantity: Callable[[Inputs], Quantity],
    hold_s: _Number | None,
) -> tuple[_Row, ...]:
    return (
        _Row(
            says=says,
            quantity=quantity,
            op='<',
            least=lambda t: t.stop_speed_mps,
            unit='m/s',
            hold_s=hold_s,
            series=True,
        ),
    )


def _turns(side: Literal['left', 'right']) -> tuple[_Row, ...]:
    return (
        _Row(
            says=lambda a, _, t: (
                f'{a} turns {side} by at least {number(t.turn_deg)} deg within '
                f'{number(t.turn_within_s)} s'
            ),
            quantity=lambda inputs: Turn(
                **inputs.common,
                side=side,
                within_s=inputs.tolerances.turn_within_s,
                moving_mps=inputs.tolerances.moving_speed_mps,
            ),
            op='>=',
            least=lambda t: t.turn_deg,
            unit='deg',
            signal=f'turn_{side}({{a}})',
        ),
    )


def _speed(inputs: Inputs) -> Speed:
    return Speed(**inputs.common, window=Window.RUN)


def _following(inputs: Inputs) -> FollowFraction:
    t = inputs.tolerances
    low, high = t.follow_gap_moving_m
    slow_low, slow_high = t.follow_gap_slow_m
    return FollowFraction(
        **inputs.common,
        after_s=t.follow_after_s,
        low_m=low,
        high_m=high,
        slow_low_m=slow_low,
        slow_high_m=slow_high,
        slow_mps=t.follow_slow_mps,
        offset_m=t.route_offset_m,
    )


def _passing_offset_m(t: Tolerances) -> float:
    """Return how far off the way of who yields the other one passes: one lane beside it."""
    return 3.0 * t.lane_offset_m


# What one agent does alone.
_OWN: dict[BehaviorKind, tuple[_Row, ...]] = {
    BehaviorKind.DRIVE: _moves('drives', lambda t: t.drive_distance_m),
    BehaviorKind.WALK: _moves('walks', lambda t: t.drive_distance_m),
    BehaviorKind.CIRCULATE: _moves('circulates', lambda t: t.circulate_distance_m),
    BehaviorKind.STOP: _stands(
        lambda a, _, t: (
            f'{a} stops after having moved: under {number(t.stop_speed_mps)} m/s for '
            f'{number(t.stop_hold_s)} s'
        ),
        lambda inputs: SpeedAfterMoving(
            **inputs.common, moving_mps=inputs.tolerances.moving_speed_mps
        ),
        lambda t: t.stop_hold_s,
    ),
    BehaviorKind.WAIT: _stands(
        lambda a, _, t: (
            f'{a} waits: under {number(t.stop_speed_mps)} m/s for {number(t.stop_hold_s)} s'
        ),
        _speed,
        lambda t: t.stop_hold_s,
    ),
    BehaviorKind.PARK: _stands(
        lambda a, _, t: f'{a} stays parked: under {number(t.stop_speed_mps)} m/s all the time',
        _speed,
        None,
    ),
    BehaviorKind.BRAKE: (
        _Row(
            says=lambda a, _, t: f'{a} brakes with at least {number(t.brake_mps2)} m/s^2',
            quantity=lambda inputs: GreatestDeceleration(**inputs.common),
            op='>=',
            least=lambda t: t.brake_mps2,
            unit='m/s^2',
            signal='greatest_deceleration({a})',
        ),
    ),
    BehaviorKind.SLOW: (
        _Row(
            says=lambda a, _, t: f'{a} slows down by at least {number(t.slow_by_mps)} m/s',
            quantity=lambda inputs: GreatestDrop(
                **inputs.common, moving_mps=inputs.tolerances.moving_speed_mps
            ),
            op='>=',
            least=lambda t: t.slow_by_mps,
            unit='m/s',
            signal='greatest_drop({a})',
        ),
    ),
    BehaviorKind.TURN_LEFT: _turns('left'),
    BehaviorKind.TURN_RIGHT: _turns('right'),
    BehaviorKind.CROSS: (
        _Row(
            says=lambda a, _, t: (
                f'{a} crosses a carriageway, at least {number(t.crossing_m)} m from kerb to kerb'
            ),
            quantity=lambda inputs: Crossing(**inputs.common),
            op='>=',
            least=lambda t: t.crossing_m,
            unit='m',
        ),
    ),
    BehaviorKind.CHANGE_LANE: (
        _Row(
            says=lambda a, _, t: (
                f'{a} changes lane and keeps to the new one for {number(t.lane_hold_s)} s'
            ),
            quantity=lambda inputs: LaneChange(**inputs.common),
            op='>=',
            least=lambda t: t.lane_hold_s,
            unit='s',
            signal='lane_kept_after_change({a})',
        ),
    ),
    BehaviorKind.EMERGENCY_RUN: (
        _Row(
            says=lambda a, _, t: (
                f'{a} is on an emergency run: at some time at least '
                f'{number(t.over_limit_mps)} m/s faster than the speed limit of its street'
            ),
            quantity=lambda inputs: OverLimit(
                **inputs.common, moving_mps=inputs.tolerances.moving_speed_mps
            ),
            op='>=',
            least=lambda t: t.over_limit_mps,
            unit='m/s',
        ),
    ),
}

# What one agent does towards another.
_PAIRED: dict[BehaviorKind, tuple[_Row, ...]] = {
    BehaviorKind.FOLLOW: (
        _Row(
            says=lambda a, b, t: (
                f'{a} follows {b} {number(t.follow_gap_moving_m[0])} to '
                f'{number(t.follow_gap_moving_m[1])} m behind it for '
                f'{number(100 * t.follow_fraction)} % of the time after '
                f'{number(t.follow_after_s)} s'
            ),
            quantity=_following,
            op='>=',
            least=lambda t: t.follow_fraction,
            unit='1',
            share=True,
        ),
    ),
    BehaviorKind.TAILGATE: (
        _Row(
            says=lambda a, b, t: (
                f'{a} tailgates {b}: less than {number(t.tailgate_time_gap_s)} s behind it at '
                f'more than {number(t.tailgate_speed_mps)} m/s for {number(t.tailgate_hold_s)} s'
            ),
            quantity=lambda inputs: TimeGap(
                **inputs.common,
                moving_mps=inputs.tolerances.tailgate_speed_mps,
                offset_m=inputs.tolerances.route_offset_m,
            ),
            op='<',
            least=lambda t: t.tailgate_time_gap_s,
            unit='s',
            hold_s=lambda t: t.tailgate_hold_s,
            series=True,
        ),
    ),
    BehaviorKind.OVERTAKE: (
        _Row(
            says=lambda a, b, _: f'{a} gets from behind {b} to ahead of it',
            quantity=lambda inputs: Overtaking(
                **inputs.common, offset_m=inputs.tolerances.route_offset_m
            ),
            op='>',
            least=lambda _: 0.0,
            unit='m',
            signal='overtaken({a},{b})',
        ),
    ),
    BehaviorKind.APPROACH: (
        _Row(
            says=lambda a, b, t: f'{a} gets at least {number(t.approach_m)} m closer to {b}',
            quantity=lambda inputs: ClosedIn(**inputs.common),
            op='>=',
            least=lambda t: t.approach_m,
            unit='m',
            signal='closed_in({a},{b})',
        ),
    ),
    BehaviorKind.YIELD: (
        _Row(
            says=lambda a, b, t: (
                f'{a} gets at least {number(t.slow_by_mps)} m/s slower, or waits, within '
                f'{number(t.yield_m)} m of {b} until that has passed'
            ),
            quantity=lambda inputs: SlowerBeforePassed(
                **inputs.common,
                offset_m=_passing_offset_m(inputs.tolerances),
                near_m=inputs.tolerances.yield_m,
                moving_mps=inputs.tolerances.moving_speed_mps,
            ),
            op='>=',
            least=lambda t: t.slow_by_mps,
            unit='m/s',
            signal='slower_before_passed({a},{b})',
        ),
        _Row(
            says=lambda a, b, _: f'{b} passes before {a}',
            quantity=lambda inputs: PassedFirst(
                **inputs.common,
                offset_m=_passing_offset_m(inputs.tolerances),
                near_m=inputs.tolerances.yield_m,
            ),
            op='>',
            least=lambda _: 0.0,
            unit='m',
            signal='passed_first({b},{a})',
            part='.passed',
        ),
    ),
}

# Who is placed as parked stays so, whether or not that is told as its behaviour.
_PARK = BehaviorKind.PARK

# What can be done at a place, or all along on a kind of ground.
_ANYWHERE = frozenset(
    {
        BehaviorKind.DRIVE,
        BehaviorKind.WALK,
        BehaviorKind.CROSS,
        BehaviorKind.STOP,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
        BehaviorKind.EMERGENCY_RUN,
        BehaviorKind.TURN_LEFT,
        BehaviorKind.TURN_RIGHT,
    }
)
_GROUNDS = (Place.SIDEWALK, Place.MAIN_ROAD, Place.ROADSIDE)

# Nobody chooses a speed in these: it is given by the manoeuvre, or there is none.
_NO_SPEED = frozenset(
    {
        BehaviorKind.STOP,
        BehaviorKind.BRAKE,
        BehaviorKind.YIELD,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
    }
)


def behavior_conditions(
    inputs: Inputs, whose: Sequence[GroundAgent]
) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all behaviours of some ground agents."""
    agents = {agent.id for agent in inputs.spec.agents}
    for agent in whose:
        if parks(inputs.spec, agent) and all(b.kind is not _PARK for b in agent.behaviors):
            yield from _implied(inputs, agent, Behavior(kind=_PARK), f'{agent.id}.parked')
        for index, behavior in enumerate(agent.behaviors):
            kind = behavior.kind
            comes_near = kind is BehaviorKind.APPROACH and has_point(behavior.target)
            unpaired = kind in _PAIRED and behavior.target not in agents and not comes_near
            round_it = kind is BehaviorKind.CIRCULATE and behavior.target is not None
            if unpaired or round_it:
                yield Underivable(
                    element=agent.id, what=f'behaviour {kind.value}', span=behavior.span
                )
                continue
            name = behavior_id(agent, index)
            goal = parks_after(inputs.spec, agent) if kind is _PARK else None
            if goal is not None and behavior.duration_s is None:
                yield at_place.parks(inputs, agent, behavior, goal, name)
                continue
            stands = stands_for(inputs, agent, behavior, name)
            if stands is None:
                yield from _implied(_as_stated(inputs, agent, behavior), agent, behavior, name)
            else:
                yield stands
            yield from _there(inputs, agent, behavior, name)
            yield from moves_for(inputs, agent, behavior, name)
            yield from placement.closing(inputs, agent, behavior, name)
            yield from _stated_speed(inputs, agent, behavior, name)
            if behavior.headway_s is not None:
                yield time_headway.of_follower(inputs, agent, behavior, behavior.headway_s, name)


def behavior_id(agent: GroundAgent, index: int) -> str:
    """Return the id of the condition that a behaviour of an agent implies."""
    return f'{agent.id}.{agent.behaviors[index].kind.value}' + (
        '' if index == 0 else str(index + 1)
    )


def _as_stated(inputs: Inputs, agent: GroundAgent, behavior: Behavior) -> Inputs:
    """Return what a pair is judged by: the distance or time that is stated for it goes before."""
    stated = [metres for metres, _ in stated_distances(inputs, agent, behavior)]
    if behavior.headway_s is not None and behavior.kind is BehaviorKind.FOLLOW:
        # What is stated in seconds is as far as the fastest one drives in them.
        stated.append(behavior.headway_s.value * inputs.limits.vehicle_speed_max_mps)
    if not stated:
        return as_long(inputs, behavior)
    t = inputs.tolerances
    low_m, high_m = t.follow_gap_moving_m
    slack_m = t.placement_vehicle_m.of(max(stated))
    gaps_m = (min(low_m, t.follow_gap_slow_m[0]), max(high_m, max(stated) + slack_m))
    return replace(inputs, tolerances=t.model_copy(update={'follow_gap_moving_m': gaps_m}))


def _implied(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    paired = behavior.kind in _PAIRED
    other = (behavior.target or '') if paired else ''
    t = inputs.tolerances
    for row in (_PAIRED if paired else _OWN)[behavior.kind]:
        least = row.least(t)
        measured, where = row.quantity(inputs), ''
        if isinstance(measured, Turn) and has_point(behavior.target):
            measured = measured.model_copy(
                update={'place': behavior.target, 'near_m': t.arrival_m}
            )
            where = f' at {behavior.target}'
        if isinstance(measured, LaneChange) and behavior.side is not None:
            measured = measured.model_copy(update={'side': behavior.side})
            where = f', the one on its {behavior.side.value}'
        yield condition(
            id=f'{name}{row.part}',
            sentence=f'{row.says(agent.id, other, t)}{where}',
            signal=row.signal.format(a=agent.id, b=other) or None,
            of=(agent.id, other) if paired else (agent.id,),
            target=Target(op=row.op, threshold=least, unit=row.unit),
            fraction=least if row.share else None,
            hold_s=None if row.hold_s is None else row.hold_s(t),
            arguments=measured,
            source=Source(ids=(agent.id,), spans=(behavior.span or agent.span,)),
            every_sample=row.series,
        )


def _there(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    """Yield that what is to be done at a place, or on a kind of ground, is done there."""
    place = behavior.target
    if place in _GROUNDS and behavior.kind in _ANYWHERE:
        source = Source(ids=(agent.id,), spans=(behavior.span or agent.span,))
        on = Placement(relation=Relation.ON, of=place)
        yield relation_fraction.kept(inputs, agent, on, place, f'{name}.on', source)
    elif stands_for(inputs, agent, behavior, name) is not None:
        return  # for its time it stands there
    elif place is not None and has_point(place) and behavior.kind in _ANYWHERE:
        yield at_place.implied(inputs, agent, behavior, place, name)
        if comes_to(agent, behavior):
            yield came_nearer.implied(inputs, agent, behavior, place, name)


def _stated_speed(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition | Underivable]:
    """Yield the condition of a behaviour with a stated speed."""
    speed = behavior.speed_mps
    if speed is None or speed.provenance is not Provenance.EXPLICIT:
        return
    if behavior.kind is BehaviorKind.SLOW:
        yield slowed_to(inputs, agent, speed, name)
        return
    if behavior.kind not in _NO_SPEED:
        yield free_speed.implied(inputs, agent, behavior, speed, name)
        return
    yield Underivable(
        element=agent.id,
        what=f'speed of {number(speed.value)} m/s while it {behavior.kind.value}s',
        span=speed.span,
    )
