# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who begins near whom where no place is stated, and persons and vehicles placed by each other."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from aurora_core.grounding.awaited import bound_to_places
from aurora_core.grounding.pace import partings
from aurora_core.spec.events import VisibilityTrigger, bodies_of_cause
from aurora_core.spec.reference import is_landmark
from aurora_core.spec.scenario import GroundAgent, Link, Placement, ScenarioSpec, SendMessage
from aurora_core.spec.vocabulary import AgentType, MissionMode, Place, Relation, Role

# Who stands on sidewalks: persons, and roadside units, which never go.
ON_SIDEWALKS = (AgentType.PEDESTRIAN, AgentType.RSU)

# Where a person is to a vehicle that is placed by the person, which is put there in its stead.
BY_PERSONS: dict[Relation, Relation] = {
    Relation.AHEAD: Relation.BEHIND,
    Relation.BEHIND: Relation.AHEAD,
    Relation.LEFT: Relation.RIGHT,
    Relation.BESIDE: Relation.BESIDE,
    Relation.NEAR: Relation.NEAR,
}

# Along or against the route of a vehicle, by relation.
ALONG = {
    Relation.AHEAD: 1.0,
    Relation.BEFORE: -1.0,
    Relation.BEHIND: -1.0,
    Relation.BESIDE: 0.0,
    Relation.NEAR: 0.0,
    Relation.RIGHT: 0.0,
    Relation.LEFT: 0.0,
}
# Who stands on a side of another one; of a person only in the same walk, at no stated distance.
SIDES = (Relation.BESIDE, Relation.RIGHT, Relation.LEFT)
_AT = (Relation.AT, Relation.BESIDE, Relation.NEAR, Relation.ON)


def begins_near(spec: ScenarioSpec) -> Mapping[str, str]:
    """Return who begins near whom, the one in front by the one behind it.

    It is to get away from it, tells it something by radio, or is seen by who tracks it.
    """
    watched = {m.target for m in spec.missions}
    egos = {a.id for a in spec.agents if a.role is Role.EGO}
    # Of two that part the ego is in front, and who is watched, and so drives slowly, behind.
    parting = [
        sorted(sorted(pair, reverse=True), key=lambda name: (name not in watched, name in egos))
        for pair in partings(spec)
    ]
    told: list[SendMessage | Link] = list(spec.links)
    told += [e.action for e in spec.events if isinstance(e.action, SendMessage)]
    pairs = [(t.sender, t.receiver) for t in told]
    pairs = [*_seen_on_the_way(spec), *(pair[::-1] if pair[0] in egos else pair for pair in pairs)]
    near: dict[str, str] = {}
    by_id = {a.id: a for a in spec.agents}
    for behind, front in [*((pair[0], pair[-1]) for pair in parting), *pairs]:
        if any(name in by_id and bound_to_places(spec, by_id[name]) for name in (behind, front)):
            continue
        if behind != front and near.get(behind) != front:
            near.setdefault(front, behind)
    return near


def _seen_on_the_way(spec: ScenarioSpec) -> Iterator[tuple[str, str]]:
    """Yield who has to come into view of a UAV that tracks a vehicle, and that vehicle."""
    for event in spec.events:
        trigger = event.trigger
        if isinstance(trigger, VisibilityTrigger) and trigger.on == 'visible':
            first = next((m for m in spec.missions if m.uav == trigger.observer), None)
            if first is not None and first.mode is MissionMode.TRACK and first.target is not None:
                yield trigger.target, first.target


def reported(spec: ScenarioSpec) -> frozenset[str]:
    """Return the bodies that UAVs report, which they have to see then."""
    uavs = {uav.id for uav in spec.uavs}
    return frozenset().union(
        *(
            bodies_of_cause(event)
            for event in spec.events
            if isinstance(event.action, SendMessage) and event.action.sender in uavs
        )
    )


def can_stand(agent: GroundAgent, placement: Placement, spec: ScenarioSpec) -> bool:
    """Tell whether a person can be placed so."""
    others = {a.id for a in spec.agents if a.id != agent.id}
    of, relation = placement.of, placement.relation
    if of in others:
        persons = {a.id for a in spec.agents if a.type in ON_SIDEWALKS}
        if of in persons and relation is Relation.RIGHT:
            return False  # SUMO has no room there
        stated = of in persons and placement.distance_m is not None and relation in SIDES
        return relation in ALONG and not stated and placement.bearing_deg is None
    if placement.distance_m is not None and relation is not Relation.NEAR:
        return False
    grounds = (Place.CROSSWALK, Place.SIDEWALK, Place.ROADSIDE, Place.INTERSECTION)
    at_place = of in grounds or is_landmark(of)
    return relation in _AT and at_place


def in_order(persons: tuple[GroundAgent, ...]) -> list[GroundAgent]:
    """Return persons so that whoever stands by another one comes after that one."""
    names = {agent.id for agent in persons}
    found: list[GroundAgent] = []
    left = list(persons)
    while left:
        done = {agent.id for agent in found}
        ready = [
            agent
            for agent in left
            if not {p.of for p in agent.placements if p.of in names} - done - {agent.id}
        ]
        found += ready or left  # those who wait for each other come as they were listed
        left = [agent for agent in left if agent not in found]
    return found


def by_vehicles(spec: ScenarioSpec, person: GroundAgent) -> Iterator[Placement]:
    """Yield where a person is by the placements of vehicles that name it."""
    for agent in spec.agents:
        for placement in agent.placements:
            if placement.of == person.id and agent.type not in ON_SIDEWALKS:
                relation = BY_PERSONS.get(placement.relation)
                if relation is not None:
                    changed = {'relation': relation, 'of': agent.id}
                    yield placement.model_copy(update=changed)
