# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Complete what is said of bodies on the ground: how they rest, whom they meet or let pass."""

from __future__ import annotations

from itertools import pairwise

from aurora_core.spec.own_events import let_cross, overtakings
from aurora_core.spec.scenario import AgentAction, GroundAgent, Placement, ScenarioSpec
from aurora_core.spec.vocabulary import MOVING, AgentType, BehaviorKind, Place, Relation, Role

# Who drives on the road.
_DRIVEN = frozenset(AgentType) - {AgentType.PEDESTRIAN, AgentType.RSU}

# A lane told so is one by that of somebody else.
_LANES = (Relation.ADJACENT_LANE, Relation.SAME_LANE)

_WITH_SIREN = (AgentType.AMBULANCE, AgentType.FIRETRUCK, AgentType.POLICE)


def standing(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification in which who waits after a motion comes to rest for it.

    "The van stops at the intersection and waits for 5 s" is one stop, of 5 s; "walks to the
    crosswalk and waits there for 5 s" is another one: no wait before it has set off. A person who
    "walks to the crosswalk and waits there" stays, where nothing lets it go on.

    Args:
        spec: The request, whoever read it; returned as it is when nobody does.
    """
    acting = {e.action.agent for e in spec.events if isinstance(e.action, AgentAction)}
    acting |= {person for _, person in let_cross(spec)}

    def at_rest(agent: GroundAgent) -> GroundAgent:
        behaviors = list(agent.behaviors[:1])
        on_foot = agent.type is AgentType.PEDESTRIAN
        for before, wait in pairwise(agent.behaviors):
            along = on_foot and before.target == Place.SIDEWALK
            waits = along or wait.target in (None, before.target)
            waits = waits and wait.kind is BehaviorKind.WAIT
            stays = on_foot and wait is agent.behaviors[-1] and agent.id not in acting
            lasts = (wait.duration_s is not None or stays) and before.duration_s is None
            place = wait.target if along and wait.target is not None else before.target
            here = {'duration_s': wait.duration_s, 'target': place}
            if not waits or not lasts:
                behaviors.append(wait)
            elif before.kind is BehaviorKind.STOP and before.target is not None:
                behaviors[-1] = before.model_copy(update=here)
            elif before.kind in MOVING:
                behaviors.append(wait.model_copy(update={'kind': BehaviorKind.STOP, **here}))
            else:
                behaviors.append(wait)
        if tuple(behaviors) == agent.behaviors:
            return agent
        return agent.model_copy(update={'behaviors': tuple(behaviors)})

    agents = tuple(map(at_rest, spec.agents))
    if agents == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': agents})


def passed(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification in which nobody stays ahead of who is to overtake him.

    "A truck drives in front of the ego car. The ego car overtakes it": there it starts.

    Args:
        spec: The request, whoever read it; returned as it is when nobody overtakes.
    """
    pairs = {frozenset(pair) for pair in overtakings(spec)}

    def at_first(agent: GroundAgent) -> GroundAgent:
        placements = tuple(
            p.model_copy(update={'kept_in_motion': False})
            if p.kept_in_motion and not p.throughout and frozenset((agent.id, p.of)) in pairs
            else p
            for p in agent.placements
        )
        return agent.model_copy(update={'placements': placements})

    agents = tuple(map(at_first, spec.agents)) if pairs else spec.agents
    if agents == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': agents})


def meeting(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with another one where a relation of two names nobody.

    Who is oncoming, or in the next or the same lane, is so to the ego, else to whoever a UAV
    watches, else to the first vehicle; where all are oncoming, they are so to each other.

    Args:
        spec: The request, whoever read it; returned as it is when nothing was added.
    """
    watched = {mission.target for mission in spec.missions}

    def met(agent: GroundAgent) -> GroundAgent:
        driven = [a for a in spec.agents if a.type in _DRIVEN and a.id != agent.id]
        others = [a for a in driven if not any(map(_meets, a.placements))] or driven
        others.sort(key=lambda a: (a.role is not Role.EGO, a.id not in watched))
        if not others:
            return agent
        placements = tuple(
            p.model_copy(update={'of': others[0].id}) if _meets(p) and p.of is None else p
            for p in agent.placements
        )
        return agent.model_copy(update={'placements': placements})

    agents = tuple(map(met, spec.agents))
    if agents == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': agents})


def _meets(placement: Placement) -> bool:
    lane = placement.relation in _LANES and placement.of is None
    return lane or placement.relation is Relation.ONCOMING


def approaching(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with somebody to come nearer to for who approaches nobody named.

    That is whom it is placed to, else the ego; where there is none it stays open.

    Args:
        spec: The request, whoever read it; returned as it is when nothing was added.
    """
    egos = [a.id for a in spec.agents if a.role is Role.EGO]
    ids = {a.id for a in spec.agents}

    def comes(agent: GroundAgent) -> GroundAgent:
        others = [p.of for p in agent.placements if p.of in ids] + egos
        whom = next((other for other in others if other != agent.id), None)
        open_ones = [b.kind is BehaviorKind.APPROACH and b.target is None for b in agent.behaviors]
        if whom is None or not any(open_ones):
            return agent
        found = {'target': whom, 'target_inferred': True}
        behaviors = tuple(
            b.model_copy(update=found) if is_open else b
            for b, is_open in zip(agent.behaviors, open_ones, strict=True)
        )
        return agent.model_copy(update={'behaviors': behaviors})

    agents = tuple(map(comes, spec.agents))
    if agents == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': agents})


def yielding(spec: ScenarioSpec) -> ScenarioSpec:
    """Return the specification with somebody to yield to for who yields to nobody named.

    Those are the persons who cross, else the vehicle with a siren, else who does something about
    the agent itself; where there are several of those it stays open.

    Args:
        spec: The request, whoever read it; returned as it is when nothing was added.
    """
    agents = tuple(_yielding(spec, agent) for agent in spec.agents)
    if agents == spec.agents:
        return spec
    return ScenarioSpec.model_validate({**dict(spec), 'agents': agents})


def _yielding(spec: ScenarioSpec, agent: GroundAgent) -> GroundAgent:
    crosses = {
        e.action.agent
        for e in spec.events
        if isinstance(e.action, AgentAction) and e.action.do == 'cross'
    }
    others = [a for a in spec.agents if a.id != agent.id]
    kinds = (
        [a for a in others if a.id in crosses or _does(a, BehaviorKind.CROSS)],
        [a for a in others if a.type in _WITH_SIREN],
        [a for a in others if any(b.target == agent.id for b in a.behaviors)],
    )
    found = next((kind for kind in kinds if kind), [])
    on_foot = all(a.type is AgentType.PEDESTRIAN for a in found)
    if not found or (len(found) > 1 and not on_foot):
        return agent
    behaviors = tuple(
        each
        for b in agent.behaviors
        for each in (
            [b.model_copy(update={'target': a.id, 'target_inferred': True}) for a in found]
            if b.kind is BehaviorKind.YIELD and b.target is None
            else [b]
        )
    )
    return agent.model_copy(update={'behaviors': behaviors})


def _does(agent: GroundAgent, kind: BehaviorKind) -> bool:
    return any(behavior.kind is kind for behavior in agent.behaviors)
