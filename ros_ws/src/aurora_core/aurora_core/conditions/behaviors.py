# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by behaviours, one small function each.

A behaviour that is not in the registry has no condition yet and is reported as `Underivable`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    condition,
    number,
    number_target,
)
from aurora_core.conditions.condition import Condition, Window
from aurora_core.conditions.driving_speed import speed_conditions
from aurora_core.conditions.manoeuvres import cross_condition, slow_condition, turn_condition
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind

_Derive = Callable[[Inputs, GroundAgent, Behavior, str, Source], Iterator[Condition]]


def behavior_conditions(inputs: Inputs) -> Iterator[Condition | Underivable]:
    """Yield the conditions of all behaviours of ground agents."""
    agents = {agent.id for agent in inputs.spec.agents}
    for agent in inputs.spec.agents:
        for index, behavior in enumerate(agent.behaviors):
            kind = behavior.kind
            derive = _REGISTRY.get(kind)
            lacks_target = kind in _NEED_TARGET and behavior.target not in agents
            if derive is None or lacks_target:
                yield Underivable(
                    element=agent.id, what=f'behaviour {kind.value}', span=behavior.span
                )
                continue
            name = behavior_id(agent, index)
            source = Source(ids=(agent.id,), spans=(behavior.span or agent.span,))
            yield from derive(inputs, agent, behavior, name, source)
            yield from _closing(inputs, agent, behavior, name)
            if behavior.speed_mps is not None:
                yield from speed_conditions(inputs, agent, behavior, name)


def behavior_id(agent: GroundAgent, index: int) -> str:
    """Return the id of the condition that a behaviour of an agent implies."""
    return f'{agent.id}.{agent.behaviors[index].kind.value}' + (
        '' if index == 0 else str(index + 1)
    )


def _moves(
    inputs: Inputs, agent: GroundAgent, name: str, source: Source, least_m: float, what: str
) -> Condition:
    return condition(
        id=name,
        sentence=f'{agent.id} {what}: at least {number(least_m)} m',
        quantity=QuantityName.DISTANCE_TRAVELLED,
        of=(agent.id,),
        target=Target(op='>=', threshold=least_m, unit='m'),
        arguments=inputs.arguments(Window.MISSIONS),
        source=source,
        every_sample=False,
    )


def _drive(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    yield _moves(inputs, agent, name, source, inputs.tolerances.drive_distance_m, 'drives')


def _walk(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    yield _moves(inputs, agent, name, source, inputs.tolerances.drive_distance_m, 'walks')


def _circulate(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    least = inputs.tolerances.circulate_distance_m
    yield _moves(inputs, agent, name, source, least, 'circulates')


def _follow(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    assert behavior.target is not None  # checked against _NEED_TARGET
    t = inputs.tolerances
    low, high = t.follow_gap_moving_m
    slow_low, slow_high = t.follow_gap_slow_m
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} follows {behavior.target} {number(low)} to {number(high)} m behind it '
            f'for {number(100 * t.follow_fraction)} % of the time after '
            f'{number(t.follow_after_s)} s'
        ),
        quantity=QuantityName.FOLLOW_FRACTION,
        of=(agent.id, behavior.target),
        target=Target(op='>=', threshold=t.follow_fraction, unit='1'),
        fraction=t.follow_fraction,
        arguments=inputs.arguments(
            Window.MISSIONS,
            after_s=t.follow_after_s,
            low=low,
            high=high,
            slow_low=slow_low,
            slow_high=slow_high,
            slow_mps=t.follow_slow_mps,
            offset_m=t.route_offset_m,
        ),
        source=source,
        every_sample=False,
    )


def _tailgate(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    assert behavior.target is not None
    t = inputs.tolerances
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} tailgates {behavior.target}: less than {number(t.tailgate_time_gap_s)} s '
            f'behind it at more than {number(t.tailgate_speed_mps)} m/s for '
            f'{number(t.tailgate_hold_s)} s'
        ),
        quantity=QuantityName.TIME_GAP,
        of=(agent.id, behavior.target),
        target=Target(op='<', threshold=t.tailgate_time_gap_s, unit='s'),
        hold_s=t.tailgate_hold_s,
        arguments=inputs.arguments(
            Window.RUN, slow_mps=t.tailgate_speed_mps, offset_m=t.route_offset_m
        ),
        source=source,
    )


def _overtake(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    assert behavior.target is not None
    yield condition(
        id=name,
        sentence=f'{agent.id} gets from behind {behavior.target} to ahead of it',
        quantity=QuantityName.PLACEMENT,
        signal=f'overtaken({agent.id},{behavior.target})',
        of=(agent.id, behavior.target),
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=inputs.arguments(
            Window.RUN, aspect='overtake', offset_m=inputs.tolerances.route_offset_m
        ),
        source=source,
        every_sample=False,
    )


def _approach(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    assert behavior.target is not None
    least = inputs.tolerances.approach_m
    yield condition(
        id=name,
        sentence=f'{agent.id} gets at least {number(least)} m closer to {behavior.target}',
        quantity=QuantityName.DISTANCE,
        signal=f'closed_in({agent.id},{behavior.target})',
        of=(agent.id, behavior.target),
        target=Target(op='>=', threshold=least, unit='m'),
        arguments=inputs.arguments(Window.RUN, aspect='closed_in'),
        source=source,
        every_sample=False,
    )


def _stop(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    t = inputs.tolerances
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} stops after having moved: under {number(t.stop_speed_mps)} m/s for '
            f'{number(t.stop_hold_s)} s'
        ),
        quantity=QuantityName.SPEED,
        of=(agent.id,),
        target=Target(op='<', threshold=t.stop_speed_mps, unit='m/s'),
        hold_s=t.stop_hold_s,
        arguments=inputs.arguments(Window.RUN, aspect='after_moving', slow_mps=t.moving_speed_mps),
        source=source,
    )


def _brake(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    least = inputs.tolerances.brake_mps2
    yield condition(
        id=name,
        sentence=f'{agent.id} brakes with at least {number(least)} m/s^2',
        quantity=QuantityName.SPEED,
        signal=f'greatest_deceleration({agent.id})',
        of=(agent.id,),
        target=Target(op='>=', threshold=least, unit='m/s^2'),
        arguments=inputs.arguments(Window.RUN, aspect='greatest_deceleration'),
        source=source,
        every_sample=False,
    )


def _park(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    limit = inputs.tolerances.stop_speed_mps
    yield condition(
        id=name,
        sentence=f'{agent.id} stays parked: under {number(limit)} m/s all the time',
        quantity=QuantityName.SPEED,
        of=(agent.id,),
        target=Target(op='<', threshold=limit, unit='m/s'),
        arguments=inputs.arguments(Window.RUN),
        source=source,
    )


def _wait(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    t = inputs.tolerances
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} waits: under {number(t.stop_speed_mps)} m/s for {number(t.stop_hold_s)} s'
        ),
        quantity=QuantityName.SPEED,
        of=(agent.id,),
        target=Target(op='<', threshold=t.stop_speed_mps, unit='m/s'),
        hold_s=t.stop_hold_s,
        arguments=inputs.arguments(Window.RUN),
        source=source,
    )


def _closing(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    distance = behavior.closing_from_m
    if distance is None or behavior.target is None:
        return
    if distance.provenance is not Provenance.EXPLICIT:
        return
    target = number_target(distance, inputs.placement_tolerance(agent.id))
    source = Source(ids=(agent.id,), spans=(distance.span,), provenance=distance.provenance)
    for aspect, when in (('start', 'at t = 0'), ('closing', 'when the closing starts')):
        yield condition(
            id=f'{name}.from_{aspect}',
            sentence=f'{agent.id} is {number(distance.value)} m from {behavior.target} {when}',
            quantity=QuantityName.PLACEMENT,
            signal=f'distance_at_{aspect}({agent.id},{behavior.target})',
            of=(agent.id, behavior.target),
            target=target,
            arguments=inputs.arguments(
                Window.MOMENT,
                aspect=f'distance_{aspect}',
                slow_mps=inputs.tolerances.stop_speed_mps,
            ),
            source=source,
            every_sample=False,
        )


_REGISTRY: dict[BehaviorKind, _Derive] = {
    BehaviorKind.DRIVE: _drive,
    BehaviorKind.WALK: _walk,
    BehaviorKind.CIRCULATE: _circulate,
    BehaviorKind.FOLLOW: _follow,
    BehaviorKind.TAILGATE: _tailgate,
    BehaviorKind.OVERTAKE: _overtake,
    BehaviorKind.APPROACH: _approach,
    BehaviorKind.STOP: _stop,
    BehaviorKind.BRAKE: _brake,
    BehaviorKind.SLOW: slow_condition,
    BehaviorKind.TURN_LEFT: turn_condition,
    BehaviorKind.TURN_RIGHT: turn_condition,
    BehaviorKind.CROSS: cross_condition,
    BehaviorKind.PARK: _park,
    BehaviorKind.WAIT: _wait,
}
_NEED_TARGET = frozenset(
    {BehaviorKind.FOLLOW, BehaviorKind.TAILGATE, BehaviorKind.OVERTAKE, BehaviorKind.APPROACH}
)
