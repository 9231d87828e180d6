# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How much was done of what must not be done: "never stops", "must not change lanes"."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Annotated, Literal

from pydantic import Field

from aurora_core.judging.build import Inputs, Source, Target, condition, number
from aurora_core.judging.evaluation import (
    Context,
    Evaluation,
    Later,
    Missing,
    at_tick,
    ground_topics,
)
from aurora_core.judging.quantities.crossing import Crossing
from aurora_core.judging.quantities.lane_change import LaneChange
from aurora_core.judging.quantities.placement import Overtaking
from aurora_core.judging.quantities.speed import GreatestDeceleration, LongestStandstill
from aurora_core.judging.quantities.turn import Turn
from aurora_core.judging.quantity import Quantity
from aurora_core.judging.until import existing_until
from aurora_core.knowledge.limits import Tolerances
from aurora_core.outcomes.condition import Condition, Op, Window
from aurora_core.outcomes.verdict import Reason
from aurora_core.spec.parameter import Provenance, Span
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.vocabulary import BehaviorKind

Deed = Crossing | GreatestDeceleration | LaneChange | LongestStandstill | Overtaking | Turn


class Undone(Quantity):
    """What a deed measures, 0 where nothing of it could be done.

    Attributes:
        deed: What is measured, in its own unit.
    """

    name = QuantityName.UNDONE
    kind: Literal['undone'] = 'undone'
    window: Window = Window.RUN
    deed: Annotated[Deed, Field(discriminator='kind')]

    def measure(self, context: Context, condition: Condition) -> Evaluation:
        """Return the most that was done of it."""
        found = self.deed.measure(context, condition)
        if not isinstance(found, Missing) or found.reason is not Reason.PREMISE_NEVER:
            return found
        if isinstance(self.deed, LongestStandstill):
            return found  # who never moves has not kept from stopping
        end = existing_until(context, condition)
        if isinstance(end, Missing):
            return end
        topics = ground_topics(condition)
        return at_tick(max(0, end - 1), 0.0, found.story, topics, later=Later.RISES)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """How a deed shows.

    Attributes:
        says: Who does not do it, whom it is about ('' for nobody), and the tolerances.
        deed: What is measured.
        op: Comparison with what would be the deed.
        most: That number.
        unit: Of it.
        paired: It is about two.
    """

    says: Callable[[str, str, Tolerances], str]
    deed: Callable[[Inputs], Deed]
    op: Op = '<'
    most: Callable[[Tolerances], float]
    unit: str
    paired: bool = False


def _turn(side: Literal['left', 'right']) -> _Row:
    return _Row(
        says=lambda a, _, t: f'{a} never turns {side} by {number(t.turn_deg)} deg or more',
        deed=lambda inputs: Turn(
            **inputs.common,
            side=side,
            within_s=inputs.tolerances.turn_within_s,
            moving_mps=inputs.tolerances.moving_speed_mps,
        ),
        most=lambda t: t.turn_deg,
        unit='deg',
    )


def _braking_mps2(tolerances: Tolerances) -> float:
    """Return what may count as braking, a realised value, and is therefore not to be."""
    return tolerances.brake_mps2 * (1.0 - tolerances.limit_margin)


# By the names of behaviours, which are those of the actions, too.
_DEEDS: Mapping[str, _Row] = MappingProxyType(
    {
        BehaviorKind.BRAKE.value: _Row(
            says=lambda a, _, t: f'{a} never brakes with {number(_braking_mps2(t))} m/s^2 or more',
            deed=lambda inputs: GreatestDeceleration(**inputs.common),
            most=_braking_mps2,
            unit='m/s^2',
        ),
        BehaviorKind.CHANGE_LANE.value: _Row(
            says=lambda a, _, t: f'{a} never keeps to another lane for {number(t.lane_hold_s)} s',
            deed=lambda inputs: LaneChange(**inputs.common),
            most=lambda t: t.lane_hold_s,
            unit='s',
        ),
        BehaviorKind.CROSS.value: _Row(
            says=lambda a, _, t: f'{a} never crosses {number(t.crossing_m)} m of carriageway',
            deed=lambda inputs: Crossing(**inputs.common),
            most=lambda t: t.crossing_m,
            unit='m',
        ),
        BehaviorKind.OVERTAKE.value: _Row(
            says=lambda a, b, _: f'{a} never gets from behind {b} to ahead of it',
            deed=lambda inputs: Overtaking(
                **inputs.common, offset_m=inputs.tolerances.route_offset_m
            ),
            op='<=',
            most=lambda _: 0.0,
            unit='m',
            paired=True,
        ),
        BehaviorKind.STOP.value: _Row(
            says=lambda a, _, t: (
                f'{a} moves, and is never under {number(t.stop_speed_mps)} m/s for '
                f'{number(t.stop_hold_s)} s after that'
            ),
            deed=lambda inputs: LongestStandstill(
                **inputs.common,
                still_mps=inputs.tolerances.stop_speed_mps,
                moving_mps=inputs.tolerances.moving_speed_mps,
            ),
            most=lambda t: t.stop_hold_s,
            unit='s',
        ),
        BehaviorKind.TURN_LEFT.value: _turn('left'),
        BehaviorKind.TURN_RIGHT.value: _turn('right'),
    }
)


def can_be_forbidden(deed: str, other: str | None) -> bool:
    """Tell whether a run shows that nobody does a deed, `other` being whom it is done to."""
    row = _DEEDS.get(deed)
    return row is not None and row.paired is (other is not None)


def forbidden(
    inputs: Inputs, id: str, agent: str, deed: str, other: str | None, span: Span | None
) -> Condition:
    """Return that an agent does not do a deed that can be forbidden.

    Args:
        inputs: What every derivation needs.
        id: Of the prohibition.
        agent: Who must not do it.
        deed: Name of the behaviour or action.
        other: To whom, where it takes two.
        span: Where the prompt says so.
    """
    row = _DEEDS[deed]
    of = (agent,) if other is None else (agent, other)
    return condition(
        id=f'{id}.holds',
        sentence=row.says(agent, other or '', inputs.tolerances),
        signal=f'{deed}({",".join(of)})',
        of=of,
        target=Target(op=row.op, threshold=row.most(inputs.tolerances), unit=row.unit),
        arguments=Undone(**inputs.common, deed=row.deed(inputs)),
        source=Source(ids=(id,), spans=(span,), provenance=Provenance.EXPLICIT, implied=False),
        every_sample=False,
    )
