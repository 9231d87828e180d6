# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""From a reading to the scene that the scene rules and defaults take: the offline parser's own.

Ids, roles, groups, defaults and inferred targets therefore come out as they do there.
"""

from __future__ import annotations

from aurora_core.parsing.constructions.places import (
    add_placement,
    default_distance,
    says_throughout,
)
from aurora_core.parsing.llm.actors import Anchors, is_ego
from aurora_core.parsing.llm.events import add_condition, add_event, add_order
from aurora_core.parsing.llm.flights import add_link, add_mission
from aurora_core.parsing.llm.parts import Parts
from aurora_core.parsing.llm.places import is_place
from aurora_core.parsing.llm.reading import (
    AgentReading,
    BehaviorReading,
    CountReading,
    ForbiddenReading,
    Reading,
    UavReading,
    WorldReading,
)
from aurora_core.parsing.scene import Entity
from aurora_core.parsing.values import default
from aurora_core.spec.parameter import Span
from aurora_core.spec.prohibitions import (
    ForbiddenAgent,
    ForbiddenBehavior,
    ForbiddenLink,
    ForbiddenWorld,
    Prohibition,
)
from aurora_core.spec.scenario import Behavior, Placement, SceneCount
from aurora_core.spec.scene import KEEPS_HEADWAY, lasts
from aurora_core.spec.vocabulary import (
    AgentType,
    BehaviorKind,
    Relation,
    Role,
    TimeOfDay,
    TrafficDensity,
    Weather,
)

# Who does this begins behind the one it is about.
_BEHIND_ITS_TARGET = (
    BehaviorKind.FOLLOW,
    BehaviorKind.TAILGATE,
    BehaviorKind.OVERTAKE,
    BehaviorKind.APPROACH,
)


def build_scene(reading: Reading, parts: Parts, anchors: Anchors) -> None:
    """Fill the scene; what does not fit becomes an objection.

    Raises:
        ValueError: Parts of the reading contradict the specification's schema.
    """
    _add_world(reading.world, parts)
    _add_actors(reading, parts, anchors)
    parts.name_all('m', [m.id for m in reading.missions])
    parts.name_all('link', [link.id for link in reading.links])
    parts.name_all('e', [e.id for e in reading.events])
    parts.name_all('order', [o.id for o in reading.orders])
    parts.name_all('c', [c.id for c in reading.conditions])
    parts.name_all('count', [c.id for c in reading.counts])
    parts.name_all('no', [f.id for f in reading.forbidden])
    for agent in reading.agents:
        _add_agent(agent, parts)
    for mission in reading.missions:
        add_mission(mission, parts)
    for link in reading.links:
        add_link(link, parts)
    for event in reading.events:
        add_event(event, parts)
    for order in reading.orders:
        add_order(order, parts)
    for condition in reading.conditions:
        add_condition(condition, parts)
    for count in reading.counts:
        _add_count(count, parts)
    for forbidden in reading.forbidden:
        _add_forbidden(forbidden, parts)


def _add_count(count: CountReading, parts: Parts) -> None:
    value = parts.number('scene_count', count.value, f'{count.id}.value')
    if value is not None:
        span = parts.span(count.quote, count.id)
        parts.scene.counts.append(
            SceneCount(id=parts.ref(count.id), kind=count.kind, value=value, span=span)
        )


def _add_forbidden(said: ForbiddenReading, parts: Parts) -> None:
    world = (said.weather, said.time_of_day, said.traffic_density)
    kinds = [
        said.agent is not None or said.kind is not None or said.target is not None,
        said.type is not None,
        said.sender is not None or said.receiver is not None,
        *(one is not None for one in world),
    ]
    if sum(kinds) != 1:
        parts.complaints.append(
            f'{said.id}: expected agent with kind, type, sender with receiver, or one of weather, '
            'time_of_day and traffic_density'
        )
        return
    made = _prohibition(said, parts)
    if made is not None:
        parts.scene.prohibitions.append(made)


def _prohibition(said: ForbiddenReading, parts: Parts) -> Prohibition | None:
    name, span = parts.ref(said.id), parts.span(said.quote, said.id)
    if said.type is not None:
        return ForbiddenAgent(forbids='agent', id=name, type=said.type, span=span)
    if any((said.weather, said.time_of_day, said.traffic_density)):
        return ForbiddenWorld(
            forbids='world',
            id=name,
            weather=said.weather,
            time_of_day=said.time_of_day,
            traffic_density=said.traffic_density,
            span=span,
        )
    if said.sender is not None or said.receiver is not None:
        sender = parts.actor(said.sender or '', f'{said.id}.sender')
        receiver = parts.actor(said.receiver or '', f'{said.id}.receiver')
        if sender is None or receiver is None:
            return None
        return ForbiddenLink(
            forbids='link', id=name, sender=sender.id, receiver=receiver.id, span=span
        )
    agent = parts.actor(said.agent or '', f'{said.id}.agent', flies=False)
    if said.kind is None:
        parts.complaints.append(f'{said.id}.kind: what the agent must not do is missing')
    if agent is None or said.kind is None:
        return None
    return ForbiddenBehavior(
        forbids='behavior',
        id=name,
        agent=agent.id,
        kind=said.kind,
        target=parts.ref_or_none(said.target),
        span=span,
    )


def _add_world(said: WorldReading, parts: Parts) -> None:
    draft = parts.scene.world
    draft.weather, draft.weather_span = said.weather, _word('weather', said.weather, parts)
    draft.time_of_day = said.time_of_day
    draft.time_of_day_span = _word('time_of_day', said.time_of_day, parts)
    draft.traffic = said.traffic_density
    draft.duration = parts.number('scenario_duration', said.duration_s, 'world.duration_s')
    draft.wind_speed = parts.number('wind_speed', said.wind_mps, 'world.wind_mps')
    draft.gust = parts.number('gust_speed', said.gust_mps, 'world.gust_mps')
    draft.wind_from = parts.number('wind_from', said.wind_from_deg, 'world.wind_from_deg')
    draft.wind = said.wind


def _word(
    kind: str, value: Weather | TimeOfDay | TrafficDensity | None, parts: Parts
) -> Span | None:
    for atom in parts.facts.world_words(kind):
        if value is not None and atom.key == f'{kind}:{value.value}':
            return Span(start=atom.start, end=atom.end)
    return None


def _add_actors(reading: Reading, parts: Parts, anchors: Anchors) -> None:
    actors: list[AgentReading | UavReading] = [*reading.agents, *reading.uavs]
    anchored = [(atom, actor) for actor in actors if (atom := anchors.of(actor.id)) is not None]
    # In the order of the prompt, whatever order the model took.
    anchored.sort(key=lambda pair: pair[0].start)
    groups: dict[int, str] = {}
    for atom, actor in anchored:
        agent = actor if isinstance(actor, AgentReading) else None
        stem = agent.type.value if agent is not None else 'uav'
        if atom.start not in groups and sum(other is atom for other, _ in anchored) > 1:
            groups[atom.start] = parts.scene.new_id(f'{stem}_group')
        ego = agent is not None and atom.noun is not None and is_ego(atom.noun)
        background = atom.noun is not None and atom.noun.background
        entity = Entity(
            id='ego' if ego else parts.scene.new_id(stem),
            is_uav=agent is None,
            type=agent.type if agent is not None else AgentType.CAR,
            role=Role.EGO if ego else Role.BACKGROUND if background else Role.OTHER,
            group=groups.get(atom.start),
            span=Span(start=atom.start, end=atom.end),
        )
        parts.name(actor.id, entity.id)
        parts.scene.entities.append(entity)


def _add_agent(agent: AgentReading, parts: Parts) -> None:
    entity = parts.scene.by_id(parts.ref(agent.id))
    if entity is None:
        return  # not anchored: objected to
    for i, said in enumerate(agent.placements):
        where = f'{agent.id}.placements[{i}]'
        distance = parts.number('placement_distance', said.distance_m, f'{where}.distance_m')
        of = parts.ref_or_none(said.of)
        if of == entity.id:
            parts.complaints.append(f'{where}: an agent has no place relative to itself')
        if of is None and said.relation is not Relation.ONCOMING:
            parts.complaints.append(f'{where}.of: expected an id or a place, found null')
        if said.of is not None and not is_place(said.of):
            parts.actor(said.of, f'{where}.of', flies=False)
        add_placement(
            entity,
            Placement(
                relation=said.relation,
                of=of,
                distance_m=distance or default_distance(said.relation),
                bearing_deg=parts.number('bearing', said.bearing_deg, f'{where}.bearing_deg'),
                kept_in_motion=said.kept_in_motion,
                throughout=says_throughout(said.quote),
                span=parts.span(said.quote, where),
            ),
        )
    for i, behavior in enumerate(agent.behaviors):
        _add_behavior(entity, behavior, f'{agent.id}.behaviors[{i}]', parts)


def _add_behavior(entity: Entity, said: BehaviorReading, where: str, parts: Parts) -> None:
    closing = parts.number('closing_from', said.closing_from_m, f'{where}.closing_from_m')
    if said.side is not None and said.kind is not BehaviorKind.CHANGE_LANE:
        parts.complaints.append(f'{where}.side: only who changes lane has one')
    headway = parts.number('headway', said.headway_s, f'{where}.headway_s')
    if headway is not None and said.kind not in KEEPS_HEADWAY:
        parts.complaints.append(f'{where}.headway_s: only who follows or tailgates has one')
        headway = None
    lasting = parts.number('behavior_duration', said.duration_s, f'{where}.duration_s')
    if lasting is not None and not lasts(said.kind, lasting.bound):
        parts.complaints.append(f'{where}.duration_s: nobody does that for a time')
        lasting = None
    made = Behavior(
        kind=said.kind,
        target=parts.ref_or_none(said.target),
        speed_mps=parts.number('ground_speed', said.speed_mps, f'{where}.speed_mps'),
        closing_from_m=closing,
        headway_s=headway,
        side=said.side if said.kind is BehaviorKind.CHANGE_LANE else None,
        duration_s=lasting,
        span=parts.span(said.quote, where),
    )
    if made.target == entity.id:
        parts.complaints.append(f'{where}: an agent is not its own target')
    if made not in entity.behaviors:
        entity.behaviors.append(made)
    target = parts.scene.by_id(made.target or '')
    if made.kind not in _BEHIND_ITS_TARGET or target is None or target.is_uav:
        return
    elsewhere = any(p.relation is not Relation.BEHIND for p in entity.placements)
    if elsewhere or any(p.of == entity.id for p in target.placements):
        return
    add_placement(
        entity,
        Placement(
            relation=Relation.BEHIND,
            of=made.target,
            distance_m=closing or default('placement_distance'),
            kept_in_motion=made.kind is BehaviorKind.FOLLOW,
            throughout=says_throughout(said.quote),
            span=made.span,
        ),
    )
