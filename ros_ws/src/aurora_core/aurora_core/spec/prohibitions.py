# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What must not be so: "no pedestrians", "the van never overtakes", "the drone must not land".

Prohibitions are kept apart from what they forbid, so that nothing that realises agents, missions
or events can take one for a request.
"""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from aurora_core.spec.events import AgentAction, Event
from aurora_core.spec.parameter import Element, Span
from aurora_core.spec.reference import Id, PlaceRef
from aurora_core.spec.requirements import Order, StatedCondition
from aurora_core.spec.scene import Behavior, Placement
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    MissionMode,
    TimeOfDay,
    TrafficDensity,
    Weather,
)


class ForbiddenWorld(Element):
    """Not in this weather, not at this time of day, ..."""

    forbids: Literal['world']
    id: Id
    weather: Weather | None = None
    time_of_day: TimeOfDay | None = None
    traffic_density: TrafficDensity | None = None
    map_name: str | None = None
    span: Span | None = None

    @model_validator(mode='after')
    def _one_field(self) -> Self:
        fields = (self.weather, self.time_of_day, self.traffic_density, self.map_name)
        if sum(field is not None for field in fields) != 1:
            raise ValueError(f'prohibition {self.id} forbids exactly one property of the world')
        return self


class ForbiddenAgent(Element):
    """No agent of this type may appear; `uav`: no UAV."""

    forbids: Literal['agent']
    id: Id
    type: AgentType | Literal['uav']
    span: Span | None = None


class ForbiddenPlacement(Placement):
    """The agent must not be there at t = 0 (or, when `kept_in_motion`, ever)."""

    forbids: Literal['placement']
    id: Id
    agent: Id


class ForbiddenBehavior(Behavior):
    """The agent must not do this."""

    forbids: Literal['behavior']
    id: Id
    agent: Id


class ForbiddenMission(Element):
    """The UAV (any, when None) must not fly this."""

    forbids: Literal['mission']
    id: Id
    uav: Id | None = None
    mode: MissionMode
    target: Id | PlaceRef | None = None
    span: Span | None = None


class ForbiddenLink(Element):
    """No message from one to the other."""

    forbids: Literal['link']
    id: Id
    sender: Id
    receiver: Id
    span: Span | None = None


class ForbiddenEvent(Event):
    """The action must not follow the trigger; without a trigger: never happen."""

    forbids: Literal['event']


class ForbiddenOrder(Order):
    """The second must not follow the first."""

    forbids: Literal['order']


class ForbiddenCondition(StatedCondition):
    """Must not hold."""

    forbids: Literal['condition']


Prohibition = Annotated[
    ForbiddenWorld
    | ForbiddenAgent
    | ForbiddenPlacement
    | ForbiddenBehavior
    | ForbiddenMission
    | ForbiddenLink
    | ForbiddenEvent
    | ForbiddenOrder
    | ForbiddenCondition,
    Field(discriminator='forbids'),
]


def keeps_on(prohibition: Prohibition, agent: str) -> bool:
    """Tell whether a prohibition is that an agent must not stop or brake."""
    match prohibition:
        case ForbiddenBehavior(agent=who, kind=BehaviorKind.STOP | BehaviorKind.BRAKE):
            return who == agent
        case ForbiddenEvent(trigger=None, action=AgentAction(agent=who, do='stop' | 'brake')):
            return who == agent
        case _:
            return False
