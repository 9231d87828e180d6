# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by manoeuvres of one agent alone: slowing down, turning, crossing."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import Inputs, Source, Target, condition, number
from aurora_core.conditions.condition import Condition, Window
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import BehaviorKind


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
