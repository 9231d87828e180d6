# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""`ScenarioSpec`: the request as typed data, S = (W, A, u, M, V_E, O).

The parts are defined beside this module and exported by it: the rest of the code imports the
specification from here.
"""

from __future__ import annotations

from typing import Literal, Self

from pydantic import model_validator

from aurora_core.document import Document, omitted
from aurora_core.spec.checks import check, check_agent
from aurora_core.spec.events import (
    AgentAction,
    AltitudeTrigger,
    ArrivalTrigger,
    BatteryTrigger,
    BehaviorDoneTrigger,
    DistanceTrigger,
    Event,
    EventAction,
    EventDoneTrigger,
    HeadwayTrigger,
    MessageTrigger,
    MissionDoneTrigger,
    SendMessage,
    SpeedTrigger,
    TimeTrigger,
    Trigger,
    UavAction,
    VisibilityTrigger,
    bodies_of,
)
from aurora_core.spec.prohibitions import Prohibition
from aurora_core.spec.reference import Id, PlaceRef, is_place
from aurora_core.spec.requirements import Clause, Order, SceneCount, StatedCondition
from aurora_core.spec.scene import (
    Behavior,
    GroundAgent,
    Link,
    Placement,
    Uav,
    UavMission,
    World,
)

__all__ = [
    'AgentAction',
    'AltitudeTrigger',
    'ArrivalTrigger',
    'BatteryTrigger',
    'Behavior',
    'BehaviorDoneTrigger',
    'Clause',
    'DistanceTrigger',
    'Event',
    'EventAction',
    'EventDoneTrigger',
    'GroundAgent',
    'HeadwayTrigger',
    'Id',
    'Link',
    'MessageTrigger',
    'MissionDoneTrigger',
    'Order',
    'PlaceRef',
    'Placement',
    'Prohibition',
    'ScenarioSpec',
    'SceneCount',
    'SendMessage',
    'SpeedTrigger',
    'StatedCondition',
    'TimeTrigger',
    'Trigger',
    'Uav',
    'UavAction',
    'UavMission',
    'VisibilityTrigger',
    'World',
    'bodies_of',
    'is_place',
]


class ScenarioSpec(Document):
    """The whole request. Built and edited only through validation.

    Attributes:
        prompt: What was typed; spans count its characters.
        missions: Those of one UAV are flown in the order listed.
        events: Triggers, actions, chains and milestones.
        conditions: Success conditions that the prompt states itself.
        orders: What comes before what.
        counts: How many of a kind there are in the whole scene.
        prohibitions: What must not be so.
        clauses: Every piece of the prompt and what became of it.
        reader: Digest of the offline parser that read the prompt (`pipeline.reading`); empty for
            what a model, a person or a repair wrote.
    """

    schema_version: Literal[1] = 1
    prompt: str
    world: World = World()
    agents: tuple[GroundAgent, ...] = ()
    uavs: tuple[Uav, ...] = ()
    missions: tuple[UavMission, ...] = ()
    links: tuple[Link, ...] = ()
    events: tuple[Event, ...] = ()
    conditions: tuple[StatedCondition, ...] = ()
    orders: tuple[Order, ...] = omitted(())
    counts: tuple[SceneCount, ...] = omitted(())
    prohibitions: tuple[Prohibition, ...] = omitted(())
    clauses: tuple[Clause, ...] = ()
    reader: str = omitted('')

    @model_validator(mode='after')
    def _parts_fit(self) -> Self:
        check(self)
        return self

    def with_agent(self, agent: GroundAgent) -> ScenarioSpec:
        """Return the specification with another agent in the place of the one of its id.

        Only what names something is checked again, and that of this agent alone: nobody else's
        parts depend on what an agent does or where it is placed.

        Args:
            agent: Has id, role and group of the one that it replaces.

        Raises:
            ValueError: There is no such agent, or a reference of it leads nowhere.
        """
        agents = {known.id: known for known in self.agents}
        known = agents.get(agent.id)
        if known is None or (known.role, known.group) != (agent.role, agent.group):
            raise ValueError(f'{agent.id} replaces no agent of its role and group')
        agents[agent.id] = agent
        check_agent(self, agent)
        return self.model_copy(update={'agents': tuple(agents.values())})
