# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What adjectives and places beside a noun say: `a parked van`, `the van behind the ego`."""

from __future__ import annotations

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import AtomKind, NounPhrase
from aurora_core.parsing.constructions.ground import is_behavior
from aurora_core.parsing.constructions.places import add_placement, placement_at
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity, MissionDraft
from aurora_core.spec.parameter import Span
from aurora_core.spec.scenario import Behavior, Placement
from aurora_core.spec.vocabulary import BehaviorKind, MissionMode, Pattern, Relation

_KINDS = (AdjunctKind.PLACE, AdjunctKind.PHRASE)


def noun_places(frame: Frame) -> None:
    """Place ground agents by the free place words right behind their nouns."""
    for adjunct in frame.adjuncts:
        if adjunct.used or adjunct.kind not in _KINDS:
            continue
        entity = _owner(frame, adjunct)
        if entity is None:
            continue
        placement = placement_at(frame, adjunct, entity)
        if placement is not None:
            adjunct.used = True
            add_placement(entity, placement)


def _owner(frame: Frame, adjunct: Adjunct) -> Entity | None:
    """Return the one ground agent whose noun ends where the place begins."""
    nouns: list[NounPhrase] = list(frame.nouns())
    for noun in nouns:
        between = frame.scene.prompt[noun.end : adjunct.start]
        if noun.end <= adjunct.start and not between.strip():
            known = frame.resolver.known(noun)
            ground = [e for e in known if not e.is_uav]
            return ground[0] if len(known) == len(ground) == 1 else None
    return None


_MODES = {
    'track': MissionMode.TRACK,
    'follow': MissionMode.TRACK,
    'observe': MissionMode.TRACK,
    'hover': MissionMode.HOVER,
    'navigate': MissionMode.NAVIGATE,
    'orbit': MissionMode.NAVIGATE,
}
_NO_NEWS = frozenset({'fly', 'drive'})


def adjectives(frame: Frame) -> None:
    """Apply the adjectives of every noun phrase of a clause."""
    for noun in frame.nouns():
        span = Span(start=noun.start, end=noun.end)
        for state in noun.states:
            for entity in frame.resolver.known(noun):
                done = (
                    _uav(frame, entity, state, span)
                    if entity.is_uav
                    else _agent(frame, entity, state, span)
                )
                if not done:
                    frame.flag(noun.start, noun.end)


def predicate_adjectives(frame: Frame) -> None:
    """`the bus is stationary`."""
    for mark in frame.free(AdjunctKind.MARK, AtomKind.STATE.value):
        agents = [e for e in frame.scene.clause.subjects if not e.is_uav]
        span = Span(start=mark.start, end=mark.end)
        if agents and all(_agent(frame, entity, mark.value, span) for entity in agents):
            mark.used = True
            frame.scene.became(*(e.id for e in agents))


def _uav(frame: Frame, entity: Entity, state: str, span: Span) -> bool:
    if state in _NO_NEWS:
        return True
    mode = _MODES.get(state)
    if mode is None:
        return False
    scene = frame.scene
    if any(m.mode is mode for m in scene.missions_of(entity)):
        return True
    draft = MissionDraft(
        id=scene.new_id('m'),
        uav=entity,
        mode=mode,
        clause=scene.clause_number,
        span=span,
        needs_target=mode is MissionMode.TRACK,
    )
    if mode is MissionMode.NAVIGATE:
        draft.pattern = Pattern.ORBIT if state == 'orbit' else Pattern.RECTANGLE
    scene.missions.append(draft)
    scene.clause.ids[draft.id] = None
    return True


def _agent(frame: Frame, entity: Entity, state: str, span: Span) -> bool:
    if state == 'oncoming':
        ego = frame.scene.ego
        if all(p.relation is not Relation.ONCOMING for p in entity.placements):
            add_placement(
                entity,
                Placement(
                    relation=Relation.ONCOMING,
                    of=ego.id if ego is not None else None,
                    distance_m=values.default('placement_distance'),
                    span=span,
                ),
            )
        return True
    if not is_behavior(state) or state not in set(BehaviorKind):
        return False
    kind = BehaviorKind(state)
    if all(b.kind is not kind for b in entity.behaviors):
        target = None
        if kind in (
            BehaviorKind.TAILGATE,
            BehaviorKind.FOLLOW,
            BehaviorKind.APPROACH,
            BehaviorKind.OVERTAKE,
        ):
            ego = frame.scene.ego
            target = ego.id if ego is not None and ego is not entity else None
        entity.behaviors.append(Behavior(kind=kind, target=target, span=span))
    return True
