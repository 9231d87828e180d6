# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Other ways in which a specification may say the same thing.

Placements, behaviours and events overlap: a van that closes in from 45 m is 45 m behind; a bus
that stops at 20 s stops. Every way counts that means the same at run time.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import AgentAction, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, Relation

_MIRRORED = {
    Relation.AHEAD: Relation.BEHIND,
    Relation.BEHIND: Relation.AHEAD,
    Relation.LEFT: Relation.RIGHT,
    Relation.RIGHT: Relation.LEFT,
    Relation.BESIDE: Relation.BESIDE,
    Relation.ADJACENT_LANE: Relation.ADJACENT_LANE,
    Relation.SAME_LANE: Relation.SAME_LANE,
    Relation.ONCOMING: Relation.ONCOMING,
    Relation.NEAR: Relation.NEAR,
}
_CLOSING = (BehaviorKind.TAILGATE, BehaviorKind.APPROACH)
# What an agent does when an event tells it to.
BEHAVIOR_OF_ACTION = {
    'brake': BehaviorKind.BRAKE,
    'stop': BehaviorKind.STOP,
    'slow': BehaviorKind.SLOW,
    'change_lane': BehaviorKind.CHANGE_LANE,
    'yield': BehaviorKind.YIELD,
    'cross': BehaviorKind.CROSS,
    'start': BehaviorKind.DRIVE,
}


@dataclass(frozen=True, kw_only=True)
class PlacementFact:
    """Where a body is, wherever the specification says it."""

    agent: str
    relation: Relation
    of: str | None
    distance_m: Parameter | None = None
    bearing_deg: Parameter | None = None


@dataclass(frozen=True, kw_only=True)
class BehaviorFact:
    """What a body does, wherever the specification says it."""

    agent: str
    kind: BehaviorKind
    target: str | None = None
    speed_mps: Parameter | None = None
    headway_s: Parameter | None = None
    side: str | None = None
    duration_s: Parameter | None = None


def placement_facts(spec: ScenarioSpec) -> Iterator[PlacementFact]:
    """Return placements, the same seen from the other body, and those that behaviours imply."""
    for agent in spec.agents:
        for p in agent.placements:
            yield PlacementFact(
                agent=agent.id,
                relation=p.relation,
                of=p.of,
                distance_m=p.distance_m,
                bearing_deg=p.bearing_deg,
            )
            if p.of is not None and p.relation in _MIRRORED and p.bearing_deg is None:
                yield PlacementFact(
                    agent=p.of,
                    relation=_MIRRORED[p.relation],
                    of=agent.id,
                    distance_m=p.distance_m,
                )
        for b in agent.behaviors:
            if b.kind in _CLOSING and b.target is not None:
                yield PlacementFact(
                    agent=agent.id,
                    relation=Relation.BEHIND,
                    of=b.target,
                    distance_m=b.closing_from_m,
                )
            if b.kind is BehaviorKind.PARK:
                yield PlacementFact(agent=agent.id, relation=Relation.PARKED_AT, of=b.target)


def behavior_facts(spec: ScenarioSpec) -> Iterator[BehaviorFact]:
    """Return behaviours, what events make agents do, and following said as a placement."""
    for agent in spec.agents:
        for b in agent.behaviors:
            yield BehaviorFact(
                agent=agent.id,
                kind=b.kind,
                target=b.target,
                speed_mps=b.speed_mps,
                headway_s=b.headway_s,
                side=b.side,
                duration_s=b.duration_s,
            )
        for p in agent.placements:
            if p.kept_in_motion and p.relation is Relation.BEHIND:
                yield BehaviorFact(agent=agent.id, kind=BehaviorKind.FOLLOW, target=p.of)
            if p.relation is Relation.PARKED_AT:
                yield BehaviorFact(agent=agent.id, kind=BehaviorKind.PARK, target=p.of)
    for event in spec.events:
        action = event.action
        if isinstance(action, AgentAction) and action.do in BEHAVIOR_OF_ACTION:
            yield BehaviorFact(
                agent=action.agent,
                kind=BEHAVIOR_OF_ACTION[action.do],
                speed_mps=action.value_mps,
                side=action.side,
            )
