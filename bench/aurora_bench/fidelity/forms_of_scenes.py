# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Roles, placements, motions and hovers that say the same in another form (`equivalences.py`)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

from aurora_bench.fidelity.carriers import BehaviorFact, PlacementFact
from aurora_bench.fidelity.fields import (
    Case,
    Fields,
    agent_fields,
    behavior_fields,
    mission_fields,
    placement_fields,
)
from aurora_bench.prompts.format import (
    AgentRequirement,
    BehaviorRequirement,
    MissionRequirement,
    PlacementRequirement,
)
from aurora_core.spec.parameter import Parameter, Provenance
from aurora_core.spec.scenario import ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Relation, Role


def is_watched(case: Case) -> bool:
    """Whether a target is what a mission watches, whatever role the specification gives it."""
    r, spec = case.requirement, case.subject.spec
    if not isinstance(r, AgentRequirement) or r.role != 'target' or r.count == 0:
        return False
    watched = {mission.target for mission in spec.missions}
    agents = tuple(
        agent.model_copy(update={'role': Role.TARGET})
        if agent.id in watched and agent.role is not Role.EGO
        else agent
        for agent in spec.agents
    )
    subject = replace(case.subject, spec=spec.model_copy(update={'agents': agents}))
    return all(agent_fields(r, subject).values())


def is_placed(case: Case, facts: Callable[[ScenarioSpec], Iterator[PlacementFact]]) -> bool:
    """Whether a placement holds by facts that follow from several placements together."""
    r = case.requirement
    if not isinstance(r, PlacementRequirement):
        return False
    subject = replace(case.subject, placements=tuple(facts(case.subject.spec)))
    return all(placement_fields(r, subject, case.rule).values())


def oncoming(spec: ScenarioSpec) -> Iterator[PlacementFact]:
    """Return what an oncoming body's distance says, and the distance of one that is oncoming."""
    for agent in spec.agents:
        for p in agent.placements:
            if p.relation is not Relation.ONCOMING or p.of is None:
                continue
            pair = {agent.id, p.of}
            near = [
                other.distance_m
                for body in spec.agents
                for other in body.placements
                if other.relation in (Relation.NEAR, Relation.AHEAD)
                and {body.id, other.of} == pair
                and not _is_open(other.distance_m)
            ]
            said: list[tuple[Relation, Parameter | None]] = (
                [(Relation.ONCOMING, distance_m) for distance_m in near]
                if _is_open(p.distance_m)
                else [(Relation.NEAR, p.distance_m), (Relation.AHEAD, p.distance_m)]
            )
            # Both come towards each other: each is ahead of the other.
            for one, two in ((agent.id, p.of), (p.of, agent.id)):
                for relation, distance_m in said:
                    yield PlacementFact(
                        agent=one, relation=relation, of=two, distance_m=distance_m
                    )


def parked(spec: ScenarioSpec) -> Iterator[PlacementFact]:
    """Return that what parks at a place is parked there, and that what is parked is there."""
    for agent in spec.agents:
        parks = [b.target for b in agent.behaviors if b.kind is BehaviorKind.PARK]
        for place in parks:
            yield PlacementFact(agent=agent.id, relation=Relation.AT, of=place)
        for p in agent.placements:
            if p.relation is Relation.PARKED_AT:
                yield PlacementFact(agent=agent.id, relation=Relation.AT, of=p.of)
            elif p.relation is Relation.AT and (None in parks or p.of in parks):
                yield PlacementFact(agent=agent.id, relation=Relation.PARKED_AT, of=p.of)


_MOTIONS = frozenset(
    {
        BehaviorKind.DRIVE, BehaviorKind.CIRCULATE, BehaviorKind.FOLLOW, BehaviorKind.TAILGATE,
        BehaviorKind.OVERTAKE, BehaviorKind.APPROACH, BehaviorKind.EMERGENCY_RUN,
    }
)  # fmt: skip


def is_speed_of_motion(case: Case) -> bool:
    """Whether the speed of a motion is said of another motion of the same body."""
    r = case.requirement
    if not isinstance(r, BehaviorRequirement) or r.behavior not in _MOTIONS:
        return False
    if r.speed_mps is None:
        return False
    facts: list[BehaviorFact] = []
    for agent in case.subject.spec.agents:
        motions = [b for b in agent.behaviors if b.kind in _MOTIONS]
        speeds = [b.speed_mps for b in motions if not _is_open(b.speed_mps)]
        if len(speeds) != 1:  # of two speeds each belongs to its own motion
            continue
        facts.append(BehaviorFact(agent=agent.id, kind=BehaviorKind.DRIVE, speed_mps=speeds[0]))
        facts += [
            BehaviorFact(agent=agent.id, kind=b.kind, target=b.target, speed_mps=speeds[0])
            for b in motions
        ]
    subject = replace(case.subject, behaviors=tuple(facts))
    return all(behavior_fields(r, subject, case.rule).values())


def _is_open(number: Parameter | None) -> bool:
    """Whether a number is not stated: what else is said of it does not contradict it."""
    return number is None or number.provenance is Provenance.DEFAULT


def is_above(case: Case) -> bool:
    """Whether a standoff of 0 m is a hover over the target."""
    r, subject = case.requirement, case.subject
    if not isinstance(r, MissionRequirement) or r.standoff_m != 0.0:
        return False
    return any(
        mission.mode is MissionMode.HOVER
        and mission.standoff_m is None
        and mission.target is not None
        and _all_but(mission_fields(r, mission, subject, case.rule), 'standoff_m')
        for mission in subject.spec.missions
        if case.is_reading or subject.binding.moments.get(r.ref) == mission.id
    )


def _all_but(fields: Fields, name: str) -> bool:
    return all(held for field, held in fields.items() if field != name)
