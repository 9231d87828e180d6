# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What the parts of a specification ask of each other: ids, references, spans."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import cache
from typing import TYPE_CHECKING

from pydantic import BaseModel

from aurora_core.spec.events import Event, EventDoneTrigger
from aurora_core.spec.parameter import Span
from aurora_core.spec.prohibitions import ForbiddenBehavior, ForbiddenMission, ForbiddenPlacement
from aurora_core.spec.reference import ENVIRONMENT_ID, is_place
from aurora_core.spec.requirements import Order, StatedCondition
from aurora_core.spec.scene import GroundAgent, UavMission
from aurora_core.spec.vocabulary import Role

if TYPE_CHECKING:
    from aurora_core.spec.scenario import ScenarioSpec

# Fields that name a body (a UAV's own, `uav`, is looked up by itself).
_BODIES = ('a', 'b', 'observer', 'target', 'who', 'by', 'sender', 'receiver', 'agent', 'of')


def check(spec: ScenarioSpec) -> None:
    """Check everything that no element can check by itself.

    Raises:
        ValueError: Ids repeat, a reference leads nowhere, there are two egos, or a span lies
            outside of the prompt.
    """
    _check_ids(spec)
    bodies = _bodies(spec)
    for owner, element in _elements(spec):
        _check_bodies(bodies, owner, element)
    _check_flyers(spec)
    _check_events(spec)
    for requirement in (*spec.conditions, *spec.orders, *spec.prohibitions):
        if isinstance(requirement, StatedCondition):
            _check_condition(spec, requirement)
        if isinstance(requirement, Order):
            _check_order(spec, requirement)
    _check_spans(spec, len(spec.prompt))


def check_agent(spec: ScenarioSpec, agent: GroundAgent) -> None:
    """Check what an agent of a specification names.

    Raises:
        ValueError: A reference leads nowhere, or a span lies outside of the prompt.
    """
    bodies = _bodies(spec)
    for part in (*agent.placements, *agent.behaviors):
        _check_bodies(bodies, agent.id, part)
    _check_spans(agent, len(spec.prompt))


def _check_ids(spec: ScenarioSpec) -> None:
    ids = _ids(spec)
    repeated = sorted(i for i, count in Counter(ids).items() if count > 1)
    if repeated:
        raise ValueError(f'ids must be unique, repeated: {", ".join(repeated)}')
    if ENVIRONMENT_ID in ids:
        raise ValueError(f'the id {ENVIRONMENT_ID} belongs to the environment')
    if sum(agent.role is Role.EGO for agent in spec.agents) > 1:
        raise ValueError('there can be one ego only')


def _ids(spec: ScenarioSpec) -> list[str]:
    return [
        *(agent.id for agent in spec.agents),
        *(uav.id for uav in spec.uavs),
        *(mission.id for mission in spec.missions),
        *(link.id for link in spec.links),
        *(event.id for event in spec.events),
        *(stated.id for stated in spec.conditions),
        *(order.id for order in spec.orders),
        *(count.id for count in spec.counts),
        *(prohibition.id for prohibition in spec.prohibitions),
    ]


def _elements(spec: ScenarioSpec) -> Iterator[tuple[str, BaseModel]]:
    """Yield every value with references to bodies, and the id of the element it belongs to."""
    for agent in spec.agents:
        for part in (*agent.placements, *agent.behaviors):
            yield agent.id, part
    for mission in spec.missions:
        yield mission.id, mission
    for link in spec.links:
        yield link.id, link
    for prohibition in spec.prohibitions:
        if not isinstance(prohibition, StatedCondition):
            yield prohibition.id, prohibition
    for event in _events(spec):
        for side in (event.trigger, event.action):
            if side is not None:
                yield event.id, side


def _events(spec: ScenarioSpec) -> Iterator[Event]:
    yield from spec.events
    yield from (p for p in spec.prohibitions if isinstance(p, Event))


def _check_bodies(bodies: set[str | None], owner: str, element: BaseModel) -> None:
    names = _naming_fields(type(element))
    for name in names:
        reference = getattr(element, name)
        if reference is not None and reference not in bodies and not is_place(reference):
            raise ValueError(f'{owner} refers to {reference!r}, which is not in the scene')
    sides = [getattr(element, name) for name in ('sender', 'receiver') if name in names]
    if len(sides) > 1 and sides[0] is not None and sides[0] == sides[1]:
        raise ValueError(f'{owner}: {sides[0]} cannot send to itself')


@cache
def _naming_fields(kind: type[BaseModel]) -> tuple[str, ...]:
    """Return the fields of a kind of element that name a body."""
    return tuple(name for name in _BODIES if name in kind.model_fields)


def _check_flyers(spec: ScenarioSpec) -> None:
    uavs = {uav.id for uav in spec.uavs}
    forbidden = (p for p in spec.prohibitions if isinstance(p, ForbiddenMission))
    flown: list[UavMission | ForbiddenMission] = [*spec.missions, *forbidden]
    for mission in flown:
        if mission.uav is not None and mission.uav not in uavs:
            raise ValueError(f'mission {mission.id} refers to unknown UAV {mission.uav!r}')
        if mission.uav is not None and mission.uav == mission.target:
            raise ValueError(f'mission {mission.id}: {mission.uav} cannot be its own target')
    agents = {agent.id for agent in spec.agents}
    for part in spec.prohibitions:
        if isinstance(part, ForbiddenPlacement | ForbiddenBehavior) and part.agent not in agents:
            raise ValueError(f'{part.id} refers to {part.agent!r}, which is no ground agent')


def _check_events(spec: ScenarioSpec) -> None:
    uavs = {uav.id for uav in spec.uavs}
    events = {event.id for event in spec.events}
    flown = {mission.id: mission.uav for mission in spec.missions}
    for event in _events(spec):
        after = event.trigger.event if isinstance(event.trigger, EventDoneTrigger) else None
        if after is not None and (after not in events or after == event.id):
            raise ValueError(f'event {event.id} waits for unknown event {after!r}')
        for part in (event.trigger, event.action):
            flyer = getattr(part, 'uav', None)
            if flyer is not None and flyer not in uavs:
                raise ValueError(f'event {event.id} refers to unknown UAV {flyer!r}')
            observer = getattr(part, 'observer', None)
            if observer is not None and is_place(observer):
                raise ValueError(f'event {event.id}: {observer!r} is a place and sees nothing')
        mission = getattr(event.action, 'mission', None)
        if mission is not None and flown.get(mission) != getattr(event.action, 'uav', None):
            raise ValueError(f'event {event.id} changes to {mission!r}, no mission of its UAV')


def _check_condition(spec: ScenarioSpec, stated: StatedCondition) -> None:
    known = _bodies(spec) | {
        *(agent.group for agent in spec.agents),
        *(uav.group for uav in spec.uavs),
        *(event.id for event in spec.events),
        *(mission.id for mission in spec.missions),
        *(link.id for link in spec.links),
    }
    for reference in stated.of:
        if reference not in known and not is_place(reference):
            raise ValueError(f'{stated.id} refers to {reference!r}, which is not in the scene')


def _check_order(spec: ScenarioSpec, order: Order) -> None:
    known = {*(event.id for event in spec.events), *(mission.id for mission in spec.missions)}
    for reference in (order.first, order.then):
        if reference not in known:
            raise ValueError(f'order {order.id} refers to {reference!r}, no event or mission')


def _check_spans(value: BaseModel | tuple[object, ...], length: int) -> None:
    """Check the spans in a value against the length of the prompt."""
    if isinstance(value, Span):
        if value.end > length:
            raise ValueError(f'span [{value.start}, {value.end}) lies outside of the prompt')
        return
    for part in value if isinstance(value, tuple) else vars(value).values():
        if isinstance(part, BaseModel | tuple):
            _check_spans(part, length)


def _bodies(spec: ScenarioSpec) -> set[str | None]:
    return {*(agent.id for agent in spec.agents), *(uav.id for uav in spec.uavs)}
