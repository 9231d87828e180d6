# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Deeds at a place: a stop there at some moment, whom one yields to or overtakes there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from aurora_core.parsing.atoms import Atom
from aurora_core.parsing.doubts.clauses import meet
from aurora_core.spec.parameter import Span
from aurora_core.spec.reference import is_place
from aurora_core.spec.scenario import AgentAction, Clause, GroundAgent, ScenarioSpec
from aurora_core.spec.vocabulary import BehaviorKind, ClauseStatus, Place

# Done on the way: a place in such a clause is not where one starts.
_ON_THE_WAY = frozenset({BehaviorKind.OVERTAKE, BehaviorKind.YIELD})
_STRETCHES = frozenset({Place.MAIN_ROAD, Place.ROADSIDE, Place.SIDEWALK})


def stops_at_places(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`at 25 s the car stops at the crosswalk`: a stop there, and one then, are two."""
    agents = {agent.id: agent for agent in spec.agents}
    for event in spec.events:
        action = event.action
        if event.trigger is None or not isinstance(action, AgentAction) or action.do != 'stop':
            continue
        agent = agents.get(action.agent)  # a UAV that a model lets stop is none of these
        for clause in _encoded(spec, event.id):
            if agent is not None and _stops_there(agent, clause):
                yield clause.span


def deeds_at_places(spec: ScenarioSpec, atoms: Sequence[Atom]) -> Iterator[Span]:
    """`yields to a pedestrian at the crosswalk` that became a start at the crosswalk."""
    for agent in spec.agents:
        if not any(b.kind in _ON_THE_WAY for b in agent.behaviors):
            continue
        told = [b.span for b in agent.behaviors if b.kind in _ON_THE_WAY and b.span is not None]
        for placement in agent.placements:
            span, of = placement.span, placement.of
            # Whoever is on a road, or a sidewalk, is so before and after the deed, too.
            if span is None or of is None or not is_place(of) or of in _STRETCHES:
                continue
            if any(meet(span, one) for one in told):
                yield span


def _encoded(spec: ScenarioSpec, ident: str) -> Iterator[Clause]:
    return (c for c in spec.clauses if ident in c.ids and c.status is ClauseStatus.ENCODED)


def _stops_there(agent: GroundAgent, clause: Clause) -> bool:
    return any(
        b.kind is BehaviorKind.STOP
        and b.target is not None
        and is_place(b.target)
        and b.span is not None
        and meet(b.span, clause.span)
        for b in agent.behaviors
    )
