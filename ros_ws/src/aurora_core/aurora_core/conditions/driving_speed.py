# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""The condition that a stated driving speed implies: kept wherever the road is free."""

from __future__ import annotations

from collections.abc import Iterator

from aurora_core.conditions.build import (
    Inputs,
    Source,
    Target,
    Underivable,
    bound_words,
    condition,
    number,
)
from aurora_core.outcomes.condition import Condition, Window
from aurora_core.spec.parameter import Bound, Provenance
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.scenario import Behavior, GroundAgent
from aurora_core.spec.vocabulary import AgentType, BehaviorKind

# Nobody chooses a speed in these: it is given by the manoeuvre, or there is none.
_NO_SPEED = frozenset(
    {
        BehaviorKind.STOP,
        BehaviorKind.BRAKE,
        BehaviorKind.SLOW,
        BehaviorKind.YIELD,
        BehaviorKind.WAIT,
        BehaviorKind.PARK,
    }
)


def speed_conditions(
    inputs: Inputs, agent: GroundAgent, behavior: Behavior, name: str
) -> Iterator[Condition | Underivable]:
    """Yield the condition of a behaviour with a stated speed."""
    speed = behavior.speed_mps
    if speed is None or speed.provenance is not Provenance.EXPLICIT:
        return
    if behavior.kind in _NO_SPEED:
        yield Underivable(
            element=agent.id,
            what=f'speed of {number(speed.value)} m/s while it {behavior.kind.value}s',
            span=speed.span,
        )
        return
    t = inputs.tolerances
    walks = agent.type is AgentType.PEDESTRIAN
    known = inputs.agent(behavior.target or '')
    # Whom it follows is no leader that keeps it from its speed: both are asked together.
    of = (agent.id,) if known is None or walks else (agent.id, known.id)
    slack = t.route_speed_mps.of(speed.value, approximate=speed.approximate)
    where = f'with no {"other " if len(of) > 1 else ""}leader or junction within'
    rest = 'while it walks' if walks else f'{where} {number(t.free_road_m)} m'
    yield condition(
        id=f'{name}.speed',
        sentence=(
            f'{agent.id} {"walks" if walks else "drives"} {bound_words(speed)} '
            f'{number(speed.value)} m/s for {number(100 * t.route_speed_share)} % of the time '
            f'{rest}'
        ),
        quantity=QuantityName.SPEED,
        signal=f'free_speed_share({agent.id})',
        of=of,
        target=Target(op='>=', threshold=t.route_speed_share, unit='1'),
        fraction=t.route_speed_share,
        arguments=inputs.arguments(
            Window.MISSIONS,
            aspect='walking' if walks else 'free',
            bound=speed.bound,
            wanted=speed.value,
            sample_tolerance=0.0 if speed.bound is not Bound.EXACTLY else slack,
            low=speed.value * speed.value / (2.0 * t.route_acceleration_mps2),
            high=t.free_road_m,
            offset_m=t.lane_offset_m,
            slow_mps=t.stop_speed_mps if walks else t.moving_speed_mps,
        ),
        source=Source(ids=(agent.id,), spans=(speed.span,), provenance=speed.provenance),
        every_sample=False,
    )
