# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""E_G: what depends on what, from the elements of a specification and its conditions.

Placement affects sensing, sensing may trigger communication, communication may enable a vehicle's
action, and every condition hangs on what it judges (paper, text below eq. 1).
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from aurora_core.agsg.families import family_of_prohibition, family_of_quantity
from aurora_core.outcomes.agsg import AgsgEdge, EdgeType
from aurora_core.outcomes.condition import Condition
from aurora_core.spec.events import actor_of
from aurora_core.spec.reference import ENVIRONMENT_ID, is_place
from aurora_core.spec.scenario import (
    Event,
    MessageTrigger,
    ScenarioSpec,
    SendMessage,
    TimeTrigger,
    VisibilityTrigger,
)
from aurora_core.spec.vocabulary import MissionMode

_JUDGED = 'is judged by'
# Fields of triggers and prohibitions that name an element.
_TRIGGER_FIELDS = ('a', 'b', 'uav', 'observer', 'target', 'who', 'by', 'event', 'place')
_PROHIBITION_FIELDS = ('agent', 'uav', 'sender', 'receiver', 'target', 'first', 'then')


class Edges:
    """Lists the edges of one specification.

    Args:
        spec: The request.
    """

    def __init__(self, spec: ScenarioSpec) -> None:
        self._spec = spec
        named = (spec.agents, spec.uavs, spec.links, spec.events, spec.conditions)
        self._nodes = {element.id: element.id for group in named for element in group}
        # Missions are no nodes: what refers to one depends on its UAV.
        self._nodes |= {mission.id: mission.uav for mission in spec.missions}
        self._uavs = frozenset(uav.id for uav in spec.uavs)

    def all(self, conditions: tuple[Condition, ...]) -> tuple[AgsgEdge, ...]:
        """Return every edge once, in a fixed order."""
        parts = (
            self._ground(),
            self._air(),
            self._links(),
            *(self._event(event) for event in self._spec.events),
            self._requirements(),
            self._conditions(conditions),
        )
        return tuple(dict.fromkeys(edge for part in parts for edge in part))

    def _ground(self) -> Iterator[AgsgEdge]:
        for agent in self._spec.agents:
            yield _edge(ENVIRONMENT_ID, agent.id, EdgeType.SPATIAL, 'on the road of')
            for placement in agent.placements:
                source = self._node(placement.of) or ENVIRONMENT_ID
                yield _edge(source, agent.id, EdgeType.SPATIAL, placement.relation.value)
            for behavior in agent.behaviors:
                whom = self._node(behavior.target)
                if whom is not None:
                    yield _edge(whom, agent.id, EdgeType.BEHAVIORAL, behavior.kind.value)

    def _air(self) -> Iterator[AgsgEdge]:
        for uav in self._spec.uavs:
            yield _edge(ENVIRONMENT_ID, uav.id, EdgeType.SPATIAL, 'in the airspace of')
        for mission in self._spec.missions:
            source = self._node(mission.target) or ENVIRONMENT_ID
            looks = mission.mode is not MissionMode.NAVIGATE
            kind = EdgeType.PERCEPTUAL if looks else EdgeType.SPATIAL
            yield _edge(source, mission.uav, kind, mission.mode.value)
            if mission.start is not None:
                start = self._node(mission.start) or ENVIRONMENT_ID
                yield _edge(start, mission.uav, EdgeType.SPATIAL, 'starts from')

    def _links(self) -> Iterator[AgsgEdge]:
        for link in self._spec.links:
            yield _edge(ENVIRONMENT_ID, link.id, EdgeType.COMMUNICATION, 'may block')
            yield _edge(link.sender, link.id, EdgeType.COMMUNICATION, 'sends over')
            yield _edge(link.id, link.receiver, EdgeType.COMMUNICATION, 'delivers to')

    def _event(self, event: Event) -> Iterator[AgsgEdge]:
        trigger, action = event.trigger, event.action
        if trigger is not None:
            sees = isinstance(trigger, VisibilityTrigger)
            kind = EdgeType.PERCEPTUAL if sees else EdgeType.TEMPORAL
            for source in self._named(trigger, _TRIGGER_FIELDS):
                yield _edge(source, event.id, kind, trigger.on)
        if isinstance(trigger, TimeTrigger):
            yield _edge(ENVIRONMENT_ID, event.id, EdgeType.TEMPORAL, trigger.on)
        if isinstance(trigger, MessageTrigger):
            for link in self._spec.links:
                if link.receiver == trigger.by and trigger.sender in (None, link.sender):
                    yield _edge(link.id, event.id, EdgeType.COMMUNICATION, trigger.on)
        if isinstance(action, SendMessage):
            yield from self._message(event, action)
        elif action is not None:
            body = getattr(action, 'agent', None) or getattr(action, 'uav', None)
            yield _edge(event.id, str(body), EdgeType.BEHAVIORAL, action.do)

    def _message(self, event: Event, action: SendMessage) -> Iterator[AgsgEdge]:
        actor = actor_of(event)
        # An alert is sent only while the actor is in sight: sensing triggers communication.
        if action.sender in self._uavs and actor not in (None, action.sender):
            yield _edge(action.sender, event.id, EdgeType.PERCEPTUAL, 'has to see the actor')
        ends = (action.sender, action.receiver)
        over = [link.id for link in self._spec.links if (link.sender, link.receiver) == ends]
        for target in over or [action.receiver]:
            yield _edge(event.id, target, EdgeType.COMMUNICATION, 'sends message')

    def _requirements(self) -> Iterator[AgsgEdge]:
        for stated in self._spec.conditions:
            family = family_of_quantity(stated.quantity)
            yield from self._judged(stated.of, stated.id, family, _JUDGED)
        for order in self._spec.orders:
            ends = (order.first, order.then)
            yield from self._judged(ends, order.id, EdgeType.TEMPORAL, _JUDGED)
        for count in self._spec.counts:
            yield from self._judged((ENVIRONMENT_ID,), count.id, EdgeType.SPATIAL, _JUDGED)
        for prohibition in self._spec.prohibitions:
            sources = [
                *self._named(prohibition, (*_PROHIBITION_FIELDS, 'of')),
                *self._named(getattr(prohibition, 'trigger', None), _TRIGGER_FIELDS),
                *self._named(getattr(prohibition, 'action', None), _PROHIBITION_FIELDS),
            ]
            family = family_of_prohibition(prohibition)
            yield from self._judged(
                sources or (ENVIRONMENT_ID,), prohibition.id, family, 'must not be'
            )

    def _conditions(self, conditions: tuple[Condition, ...]) -> Iterator[AgsgEdge]:
        for condition in conditions:
            arguments = condition.arguments
            parts = (*condition.of, *condition.spec_ids, arguments.event, arguments.link)
            sources = [part for part in parts if part is not None and self._node(part)]
            family = family_of_quantity(condition.quantity)
            yield from self._judged(sources or (ENVIRONMENT_ID,), condition.id, family, _JUDGED)

    def _judged(
        self, sources: Iterable[str], target: str, family: EdgeType, label: str
    ) -> Iterator[AgsgEdge]:
        for reference in sources:
            for source in self._members(reference):
                yield _edge(source, target, family, label)

    def _members(self, reference: str) -> list[str]:
        """Return the nodes that a reference stands for: one, or those of a group."""
        node = self._node(reference)
        if node is not None:
            return [node]
        agents = [agent.id for agent in self._spec.agents if agent.group == reference]
        return agents + [uav.id for uav in self._spec.uavs if uav.group == reference]

    def _named(self, value: object, fields: tuple[str, ...]) -> list[str]:
        """Return the nodes that the fields of a value refer to."""
        found: list[str] = []
        for name in fields:
            reference = getattr(value, name, None)
            for one in reference if isinstance(reference, tuple) else (reference,):
                found += self._members(one) if isinstance(one, str) else []
        return found

    def _node(self, reference: str | None) -> str | None:
        """Return the node of a reference; a place of the map belongs to the environment."""
        if reference is None:
            return None
        if reference == ENVIRONMENT_ID or is_place(reference):
            return ENVIRONMENT_ID
        return self._nodes.get(reference)


def _edge(source: str, target: str, kind: EdgeType, label: str) -> AgsgEdge:
    return AgsgEdge(source=source, target=target, type=kind, label=label)
