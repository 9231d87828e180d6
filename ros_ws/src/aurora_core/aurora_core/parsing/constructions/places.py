# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where ground agents are: relations, places, distances."""

from __future__ import annotations

import re

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import MUTUAL, Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, NounKind, NounPhrase
from aurora_core.parsing.criteria.criterion import Placed
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import LENGTH
from aurora_core.parsing.pronouns import ground
from aurora_core.parsing.resolver import Resolver
from aurora_core.parsing.scene import Entity, Unanchored
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import LaneSide, Relation, Role

_KEPT = frozenset(
    {
        Relation.AHEAD,
        Relation.BEHIND,
        Relation.LEFT,
        Relation.RIGHT,
        Relation.BESIDE,
        Relation.ADJACENT_LANE,
        Relation.SAME_LANE,
    }
)


# Relations that mean a distance; the others touch.
DISTANT = frozenset(
    {
        Relation.AHEAD,
        Relation.BEHIND,
        Relation.LEFT,
        Relation.RIGHT,
        Relation.NEAR,
        Relation.BEFORE,
        Relation.ONCOMING,
    }
)


_PHRASE_RELATIONS = {
    'at': Relation.AT,
    'on': Relation.ON,
    'in': Relation.AT,
    'before': Relation.BEFORE,
    'along': Relation.ON,
    'by': Relation.NEAR,
}


_THROUGHOUT = re.compile(
    r'\b(always|never|at (?:all times|no (?:time|point)|any (?:time|point))|'
    r'(?:all|the whole|the entire) (?:the )?time|throughout|all along|constant(?:ly)?|'
    r'permanently|keep(?:s|ing)?|stay(?:s|ing)?|remain(?:s|ing)?)\b'
)


def is_throughout(frame: Frame) -> bool:
    """Return whether a clause says that it holds all along: `always`, `stays`, `never more`."""
    return says_throughout(frame.scene.prompt[frame.piece.start : frame.piece.end])


def says_throughout(words: str) -> bool:
    """Return whether words of the prompt ask for something all along."""
    return _THROUGHOUT.search(words.lower()) is not None


def add_placement(entity: Entity, placement: Placement) -> None:
    """Add a placement; one that is there already gets the stated distance."""
    for i, known in enumerate(entity.placements):
        same = known.relation is placement.relation and known.of == placement.of
        if same and not _differ(known, placement):
            stated = [
                p
                for p in (placement.distance_m, known.distance_m)
                if p is not None and p.span is not None
            ]
            entity.placements[i] = Placement(
                relation=known.relation,
                of=known.of,
                distance_m=stated[0] if stated else known.distance_m or placement.distance_m,
                bearing_deg=known.bearing_deg or placement.bearing_deg,
                kept_in_motion=known.kept_in_motion or placement.kept_in_motion,
                throughout=known.throughout or placement.throughout,
                span=known.span,
            )
            return
    entity.placements.append(placement)


def _differ(one: Placement, other: Placement) -> bool:
    """Two stated distances: both stay, for the check of contradictions to see."""
    a, b = one.distance_m, other.distance_m
    return (
        a is not None
        and b is not None
        and a.span is not None
        and b.span is not None
        and a.value != b.value
    )


def named_reference(frame: Frame, adjunct: Adjunct) -> str | None:
    place = place_of(frame, adjunct)
    if place is not None:
        return place
    actors = [n for n in adjunct.nouns if n.kind in ACTORS or n.kind is NounKind.UNKNOWN]
    if not actors:
        return None
    found = frame.objects(actors, ground, fronted=_fronted(frame, adjunct))
    egos = [e for e in found if e.role is Role.EGO]
    if len(found) > 1 and adjunct.key == Relation.ONCOMING:
        return (egos or found)[0].id  # they all go the same way
    if len(found) > 1:
        frame.flag(adjunct.start, adjunct.end)
    return found[0].id if found else None


def _fronted(frame: Frame, adjunct: Adjunct) -> bool:
    """`behind the ego is a van, and behind it a bus`: behind whom the clause before is about."""
    new = frame.subject_nouns
    if not new or adjunct.start > new[0].start or len(frame.scene.clauses) < 2:
        return False
    told = frame.scene.clauses[-2].span  # `in front of it is a bus; behind it a van`: of the same
    return 'it' not in re.findall('[a-z]+', frame.scene.prompt[told.start : told.end].lower())


def place_of(frame: Frame, adjunct: Adjunct) -> str | None:
    for noun in adjunct.nouns:
        place = frame.resolver.place(noun)
        if place is not None:
            frame.scene.clause.places += (place,)
            return place
    return None


def gap(frame: Frame) -> Parameter | None:
    """`follows the ego at 15 m`, `with a gap of 12 m`."""
    adjunct = frame.attribute('gap', 'standoff', 'away') or frame.length(
        'at', 'by', 'with', 'from', ''
    )
    if adjunct is None or adjunct.measure is None:
        return None
    if not values.accepts('placement_distance', adjunct.measure) or adjunct.prep == 'within':
        return None
    adjunct.used = True
    return values.bounded(values.explicit('placement_distance', adjunct.measure), adjunct.prep)


def lane_side(frame: Frame) -> LaneSide | None:
    """Take the side of the lane that is changed to."""
    if frame.key != 'change_lane':
        return None
    words = '' if frame.verb is None else frame.verb.words
    for side in LaneSide:
        if side.value in words.split():
            return side
    for adjunct in frame.free(AdjunctKind.PLACE, *LaneSide):
        if not adjunct.nouns and adjunct.measure is None:
            adjunct.used = True
            return LaneSide(adjunct.key)
    return None


def placements_of(
    frame: Frame, subjects: tuple[Entity, ...], *, kept: bool
) -> tuple[Placement, ...]:
    """Take every stated place of the subjects."""
    made: list[Placement] = []
    for adjunct in frame.free(AdjunctKind.PLACE):
        if frame.key == 'overtake' and adjunct.key in ('left', 'right') and not adjunct.nouns:
            continue  # the side of an overtaking is not part of the vocabulary
        if frame.key == 'stop' and adjunct.key == 'before':
            continue  # where it will stop is not where it is at the start
        if _of_the_object(frame, adjunct):
            continue
        placement = _relation(frame, adjunct, subjects, kept)
        if placement is not None:
            adjunct.used = True
            made.append(placement)
    for adjunct in frame.free(AdjunctKind.PHRASE, *_PHRASE_RELATIONS):
        place = place_of(frame, adjunct)
        if place is not None:
            adjunct.used = True
            relation = _PHRASE_RELATIONS[adjunct.key]
            if frame.key == 'park':
                relation = Relation.PARKED_AT
            made.append(
                Placement(
                    relation=relation,
                    of=place,
                    distance_m=default_distance(relation),
                    span=adjunct.span,
                )
            )
    made += _far_from_place(frame)
    away = frame.attribute('away')
    if away is not None and away.nouns and away.measure is not None and away.prep in ('', 'at'):
        others = frame.objects(away.nouns, ground)
        if len(others) == 1 and values.accepts('placement_distance', away.measure):
            away.used = True
            made.append(
                Placement(
                    relation=Relation.NEAR,
                    of=others[0].id,
                    distance_m=values.explicit('placement_distance', away.measure),
                    span=away.span,
                )
            )
    return tuple(made)


def _far_from_place(frame: Frame) -> tuple[Placement, ...]:
    """`stands 30 m from the crosswalk`, `is 30 m away from it`."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'from'):
        before = frame.scene.prompt[: adjunct.start].rstrip().removesuffix('away').rstrip()
        far = next((a for a in _lengths(frame) if a.end == len(before)), None)
        if far is None or far.measure is None:
            continue
        place = place_of(frame, adjunct)
        if place is not None and values.accepts('placement_distance', far.measure):
            adjunct.used = far.used = True
            distance = values.explicit('placement_distance', far.measure)
            span = adjunct.span
            made = Placement(relation=Relation.NEAR, of=place, distance_m=distance, span=span)
            return (made,)
    return ()


def _lengths(frame: Frame) -> list[Adjunct]:
    return [
        *frame.free(AdjunctKind.MEASURE, LENGTH),
        *frame.free(AdjunctKind.ATTRIBUTE, 'away', 'standoff'),
    ]


def _of_the_object(frame: Frame, adjunct: Adjunct) -> bool:
    """`follows the truck ahead of it`: where the truck is."""
    pronoun = bool(adjunct.nouns) and adjunct.nouns[0].kind is NounKind.PRONOUN
    if not pronoun or adjunct.measure is not None:
        return False
    return any(
        noun.kind in ACTORS
        and noun.kind is not NounKind.PRONOUN
        and noun.end <= adjunct.start
        and not frame.scene.prompt[noun.end : adjunct.start].strip()
        for other in frame.adjuncts
        if other.kind is AdjunctKind.OBJECT
        for noun in other.nouns
    )


def placement_at(frame: Frame, adjunct: Adjunct, entity: Entity) -> Placement | None:
    """Return the placement that one place word gives an agent, None when it gives none."""
    if adjunct.kind is AdjunctKind.PLACE:
        if not adjunct.nouns or adjunct.key == 'compass':
            return None
        if adjunct.nouns[0].kind is NounKind.PRONOUN:
            return _relation(frame, adjunct, (entity,), kept=False, owner=entity)
        return _relation(frame, adjunct, (entity,), kept=False)
    relation = _PHRASE_RELATIONS.get(adjunct.key)
    place = place_of(frame, adjunct) if relation is not None else None
    if relation is None or place is None:
        return None
    return Placement(
        relation=relation,
        of=place,
        distance_m=default_distance(relation),
        span=adjunct.span,
    )


def place_party(resolver: Resolver, told: Placed) -> None:
    """Place whom a condition names: `the gap between the ego and the van behind it`."""
    known = resolver.known(told.owner)
    owner = known[0] if len(known) == 1 and not known[0].is_uav else None
    if told.at_place:
        place = resolver.place(told.of)
        if owner is not None and place is not None:
            made = Placement(relation=told.relation, of=place, span=told.span)
            add_placement(owner, made)
        return
    others = resolver.actors((told.of,), accept=ground, exclude=known) if owner else ()
    if owner is not None and len(others) == 1 and others[0] is not owner:
        placement = Placement(
            relation=told.relation,
            of=others[0].id,
            distance_m=default_distance(told.relation),
            span=told.span,
        )
        add_placement(owner, placement)


def default_distance(relation: Relation) -> Parameter | None:
    """Return the distance of a relation that means one, None for those that touch."""
    return values.default('placement_distance') if relation in DISTANT else None


def _relation(
    frame: Frame,
    adjunct: Adjunct,
    subjects: tuple[Entity, ...],
    kept: bool,
    owner: Entity | None = None,
) -> Placement | None:
    if adjunct.key == 'compass':
        return _compass(frame, adjunct)
    relation = Relation(adjunct.key)
    each = None if owner is not None else _each_other(frame, adjunct, subjects)
    if owner is None:
        of = each if each is not None else _anchor(frame, adjunct, subjects)
    else:
        of = _beside(frame, adjunct, owner)
    if of is not None and [e.id for e in subjects] == [of]:
        return None  # nobody is beside himself
    if relation is Relation.ONCOMING and of is not None and frame.scene.by_id(of) is None:
        relation = Relation.NEAR  # `opposite the school`
    distance = default_distance(relation)
    loose = None if adjunct.measure is not None or each is not None else gap(frame)
    if adjunct.measure is not None:
        if not values.accepts('placement_distance', adjunct.measure):
            return None
        distance = values.explicit('placement_distance', adjunct.measure)
        distance = values.bounded(distance, adjunct.prep)
    elif loose is not None:
        distance = loose
    all_along = relation in _KEPT and is_throughout(frame)
    placement = Placement(
        relation=relation,
        of=of,
        distance_m=distance,
        kept_in_motion=all_along or (kept and relation in _KEPT),
        throughout=all_along,
        span=adjunct.span,
    )
    if of is None and relation is not Relation.ONCOMING:
        if adjunct.nouns:
            return None
        adjunct.used = True
        frame.scene.unanchored.append(
            Unanchored(entities=subjects, placement=placement, clause=frame.scene.clause)
        )
        return None
    return placement


def _anchor(frame: Frame, adjunct: Adjunct, subjects: tuple[Entity, ...]) -> str | None:
    """Return what a relation refers to: named, the ego, or the last one spoken of."""
    if adjunct.nouns:
        one = _is_one(adjunct.nouns) or adjunct.key == Relation.ONCOMING
        return named_reference(frame, adjunct) if one else None
    spoken_of = frame.scene.clause.objects
    if spoken_of:
        return spoken_of[0].id
    ego = frame.scene.ego
    if ego is not None and ego not in subjects:
        return ego.id
    alike = [u for u in frame.scene.unanchored if u.clause.sentence == frame.piece.sentence]
    if frame.verb is None and alike:
        return None  # `a bus is on the left, a van on the right`: of the same, told later
    if frame.verb is None:  # `a taxi, a bus 20 m ahead, a cyclist 15 m behind`: of the first one
        for clause in frame.scene.clauses[:-1]:
            first = [e for e in clause.subjects if not e.is_uav and e not in subjects]
            if clause.sentence == frame.piece.sentence and first:
                return first[0].id
    others = [e for e in frame.scene.agents if e not in subjects]
    return max(others, key=lambda e: e.seen).id if others else None


def _each_other(frame: Frame, adjunct: Adjunct, subjects: tuple[Entity, ...]) -> str | None:
    """`two vans side by side`, `a bus and a car next to each other`: of one of themselves."""
    words = frame.scene.prompt[adjunct.start : adjunct.end].lower().replace('-', ' ')
    mutual = adjunct.key in (Relation.ADJACENT_LANE, Relation.BESIDE) and words.endswith(MUTUAL)
    return subjects[1].id if mutual and not adjunct.nouns and len(subjects) > 1 else None


def _beside(frame: Frame, adjunct: Adjunct, owner: Entity) -> str | None:
    """`the ego warns the van behind it`: anybody but the van, even who acts."""
    found = frame.resolver.actors(adjunct.nouns, accept=ground, exclude=(owner,))
    return found[0].id if len(found) == 1 else None


def _is_one(nouns: tuple[NounPhrase, ...]) -> bool:
    return len(nouns) == 1


def _compass(frame: Frame, adjunct: Adjunct) -> Placement | None:
    of = named_reference(frame, adjunct) if adjunct.nouns else None
    if of is None:
        return None
    distance = values.default('placement_distance')
    if adjunct.measure is not None:
        if not values.accepts('placement_distance', adjunct.measure):
            return None
        distance = values.explicit('placement_distance', adjunct.measure)
    return Placement(
        relation=Relation.NEAR,
        of=of,
        distance_m=distance,
        bearing_deg=values.stated('bearing', float(adjunct.value), adjunct.start, adjunct.end),
        span=adjunct.span,
    )
