# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the prompt asks of the whole: conditions, order; and its clauses."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from aurora_core.document import Document
from aurora_core.spec.parameter import Element, Parameter, Span, Unit
from aurora_core.spec.quantity import QuantityName
from aurora_core.spec.reference import Id, PlaceRef
from aurora_core.spec.vocabulary import AgentType, ClauseStatus

# Quantities that a prompt can name, with their unit; the others are implied by runs.
STATED_QUANTITIES: Mapping[str, Unit] = MappingProxyType(
    {
        QuantityName.DISTANCE.value: Unit.METRE,
        QuantityName.HORIZONTAL_DISTANCE.value: Unit.METRE,
        QuantityName.SEPARATION.value: Unit.METRE,
        QuantityName.ALTITUDE.value: Unit.METRE,
        QuantityName.SPEED.value: Unit.METRE_PER_SECOND,
        QuantityName.VERTICAL_SPEED.value: Unit.METRE_PER_SECOND,
        QuantityName.DECELERATION.value: Unit.METRE_PER_SECOND_SQUARED,
        QuantityName.TIME_HEADWAY.value: Unit.SECOND,
        QuantityName.TIME_TO_COLLISION.value: Unit.SECOND,
        QuantityName.TRACKED_FRACTION.value: Unit.ONE,
        QuantityName.VISIBLE_TIME.value: Unit.SECOND,
        QuantityName.VISIBLE_FRACTION.value: Unit.ONE,
        QuantityName.DELIVERY_LATENCY.value: Unit.SECOND,
        QuantityName.DELIVERED.value: Unit.ONE,
        QuantityName.DELIVERY_RATIO.value: Unit.ONE,
        QuantityName.EVENT_TIME.value: Unit.SECOND,
        QuantityName.HOVER_DRIFT.value: Unit.METRE,
        QuantityName.WAYPOINTS_VISITED.value: Unit.ONE,
        QuantityName.MISSION_COMPLETED.value: Unit.ONE,
        QuantityName.LANDED.value: Unit.ONE,
        QuantityName.CLEARANCE.value: Unit.METRE,
        QuantityName.BATTERY.value: Unit.ONE,
    }
)

StatedQuantity = Annotated[str, Field(json_schema_extra={'enum': [*STATED_QUANTITIES]})]


class StatedCondition(Element):
    """A condition the prompt itself states; quantity names are those of the contract.

    Attributes:
        quantity: One of `STATED_QUANTITIES`.
        of: Ids of bodies, groups, events, missions or links, or places.
        op: Comparison with `value`.
        value: In the quantity's unit; 1 stands for yes and 0 for no.
        hold_s: Longest unbroken stretch.
        by_s: Deadline from scenario start.
        fraction: Share of the time in which the mission or agent is active.
    """

    id: Id
    quantity: StatedQuantity
    of: tuple[Id | PlaceRef, ...]
    op: Literal['<=', '<', '>=', '>', '==']
    value: Parameter
    hold_s: Parameter | None = None
    by_s: Parameter | None = None
    fraction: Parameter | None = None
    span: Span | None = None

    @model_validator(mode='after')
    def _quantity_is_known(self) -> Self:
        if self.quantity not in STATED_QUANTITIES:
            known = ', '.join(STATED_QUANTITIES)
            raise ValueError(f'condition {self.id}: quantity is one of {known}')
        if not self.of:
            raise ValueError(f'condition {self.id} is of nothing')
        return self

    def _unit_of(self, name: str) -> Unit:
        if name == 'value':
            return STATED_QUANTITIES.get(self.quantity, self.value.unit)
        return super()._unit_of(name)


# What a UAV is called where bodies are counted by their types.
UAV_TYPE = 'uav'


def types_counted(kind: str) -> tuple[str, ...]:
    """Return the types of the vocabulary that a stated number is about.

    Args:
        kind: A type, `uav`, `vehicle`, `person` or `body` (all of them).
    """
    walks = AgentType.PEDESTRIAN.value
    stands = AgentType.RSU.value
    drives = tuple(t.value for t in AgentType if t.value not in (walks, stands))
    groups = {'vehicle': drives, 'person': (walks,), 'body': (*drives, walks, UAV_TYPE)}
    return groups.get(kind, (kind,))


class SceneCount(Element):
    """How many of a kind there are in the whole scene, background included: it closes the scene.

    Attributes:
        kind: A type of the vocabulary, `uav`, `vehicle`, `person` or `body`.
        value: The number; its bound says whether it is exact, a least or a greatest one.
    """

    id: Id
    kind: AgentType | Literal['uav', 'vehicle', 'person', 'body']
    value: Parameter
    span: Span | None = None


class Order(Element):
    """One event or mission comes before another, the second within `within_s` of the first."""

    id: Id
    first: Id
    then: Id
    within_s: Parameter | None = None
    span: Span | None = None

    @model_validator(mode='after')
    def _two_of_them(self) -> Self:
        if self.first == self.then:
            raise ValueError(f'order {self.id}: {self.first} cannot come before itself')
        return self


class Clause(Document):
    """A piece of the prompt and what became of it."""

    text: str
    span: Span
    status: ClauseStatus
    ids: tuple[str, ...] = ()
    note: str = ''
