# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by what one agent does alone: drive, stop, turn, cross, change lane, ..."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind


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


def drive_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that some way is driven."""
    yield _moves(inputs, agent, name, source, inputs.tolerances.drive_distance_m, 'drives')


def walk_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that some way is walked."""
    yield _moves(inputs, agent, name, source, inputs.tolerances.drive_distance_m, 'walks')


def circulate_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that a long way is driven."""
    least = inputs.tolerances.circulate_distance_m
    yield _moves(inputs, agent, name, source, least, 'circulates')


def stop_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it stands for some time after having moved."""
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


def brake_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it loses speed fast."""
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


def park_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it never moves."""
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


def wait_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it stands for some time."""
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


def slow_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that a speed that was driven before is reduced."""
    least = inputs.tolerances.slow_by_mps
    yield condition(
        id=name,
        sentence=f'{agent.id} slows down by at least {number(least)} m/s',
        quantity=QuantityName.SPEED,
        signal=f'greatest_drop({agent.id})',
        of=(agent.id,),
        target=Target(op='>=', threshold=least, unit='m/s'),
        arguments=inputs.arguments(
            Window.RUN, aspect='greatest_drop', slow_mps=inputs.tolerances.moving_speed_mps
        ),
        source=source,
        every_sample=False,
    )


def turn_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that the heading changes far enough to one side within some seconds."""
    t = inputs.tolerances
    side = 'left' if behavior.kind is BehaviorKind.TURN_LEFT else 'right'
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} turns {side} by at least {number(t.turn_deg)} deg within '
            f'{number(t.turn_within_s)} s'
        ),
        quantity=QuantityName.TURN,
        signal=f'turn_{side}({agent.id})',
        of=(agent.id,),
        target=Target(op='>=', threshold=t.turn_deg, unit='deg'),
        arguments=inputs.arguments(
            Window.RUN, aspect=side, high=t.turn_within_s, slow_mps=t.moving_speed_mps
        ),
        source=source,
        every_sample=False,
    )


def cross_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that a carriageway is crossed from kerb to kerb."""
    least = inputs.tolerances.crossing_m
    yield condition(
        id=name,
        sentence=f'{agent.id} crosses a carriageway, at least {number(least)} m from kerb to kerb',
        quantity=QuantityName.CROSSING,
        of=(agent.id,),
        target=Target(op='>=', threshold=least, unit='m'),
        arguments=inputs.arguments(Window.RUN),
        source=source,
        every_sample=False,
    )


def change_lane_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that another lane of the same street is taken and kept."""
    least = inputs.tolerances.lane_hold_s
    yield condition(
        id=name,
        sentence=f'{agent.id} changes lane and keeps to the new one for {number(least)} s',
        quantity=QuantityName.LANE_CHANGE,
        signal=f'lane_kept_after_change({agent.id})',
        of=(agent.id,),
        target=Target(op='>=', threshold=least, unit='s'),
        arguments=inputs.arguments(Window.RUN),
        source=source,
        every_sample=False,
    )


def emergency_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it is not bound by the speed limit that the others keep."""
    least = inputs.tolerances.over_limit_mps
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} is on an emergency run: at some time at least {number(least)} m/s faster '
            'than the speed limit of its street'
        ),
        quantity=QuantityName.OVER_LIMIT,
        of=(agent.id,),
        target=Target(op='>=', threshold=least, unit='m/s'),
        arguments=inputs.arguments(Window.RUN, slow_mps=inputs.tolerances.moving_speed_mps),
        source=source,
        every_sample=False,
    )
