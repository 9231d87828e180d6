# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions implied by what one agent does towards another: follow, overtake, yield, ..."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    condition,
    number,
    number_target,
)
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent


def follow_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that the gap is kept for most of the time."""
    assert behavior.target is not None  # checked before
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


def tailgate_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that the time gap is short for some time."""
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


def overtake_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it gets from behind to ahead."""
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


def approach_condition(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that the distance shrinks."""
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


def closing_conditions(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition]:
    """Yield the distance from which it closes in, at t = 0 and when it begins to."""
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


def yield_conditions(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str, source: Source
) -> Iterator[Condition]:
    """Yield that it gets slower, or waits, and that the other one passes first."""
    assert behavior.target is not None
    t = inputs.tolerances
    of = (agent.id, behavior.target)
    # The other one passes in its lane or in one beside it.
    way = {'offset_m': 3.0 * t.lane_offset_m, 'slow_mps': t.moving_speed_mps}
    yield condition(
        id=name,
        sentence=(
            f'{agent.id} gets at least {number(t.slow_by_mps)} m/s slower, or waits, until '
            f'{behavior.target} has passed'
        ),
        quantity=QuantityName.YIELDING,
        signal=f'slower_before_passed({agent.id},{behavior.target})',
        of=of,
        target=Target(op='>=', threshold=t.slow_by_mps, unit='m/s'),
        arguments=inputs.arguments(Window.RUN, aspect='slower', **way),
        source=source,
        every_sample=False,
    )
    yield condition(
        id=f'{name}.passed',
        sentence=f'{behavior.target} passes before {agent.id}',
        quantity=QuantityName.YIELDING,
        signal=f'passed_first({behavior.target},{agent.id})',
        of=of,
        target=Target(op='>', threshold=0.0, unit='m'),
        arguments=inputs.arguments(Window.RUN, aspect='passed', **way),
        source=source,
        every_sample=False,
    )
