# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""How far ground agents are apart, told beside where they are.

`three cars one behind the other, 10 m apart`; `the gap between them is 12 m`.
"""

from __future__ import annotations

import re
from itertools import pairwise

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import IN_A_ROW, Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, NounKind, NounPhrase
from aurora_core.parsing.constructions.places import DISTANT, add_placement, is_throughout
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.measures import LENGTH
from aurora_core.parsing.scene import Entity
from aurora_core.spec.parameter import Bound, Parameter
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import Relation

_APART = ('separation', 'gap', 'standoff', 'away')
_BETWEEN = ('between', 'from', 'to', 'of')
# `keeps a distance of 12 m`, `leaves a gap of 12 m`, `has a distance of 12 m to it`.
_HAVING = ('keep', 'start', 'contain')
_COLUMN = re.compile(r'\b(?:queue|line|row|column|convoy|platoon|string|procession|file) of\b')


def column(frame: Frame, subjects: tuple[Entity, ...], *, kept: bool) -> None:
    """`four trucks in a column with gaps of 12 m`: each behind the one that is named before."""
    if len(subjects) < 2 or any(e.is_uav for e in subjects):
        return
    word = next((a for a in frame.free(AdjunctKind.PLACE, 'behind') if _in_a_row(frame, a)), None)
    told = frame.scene.prompt[frame.piece.start : frame.piece.end].lower()
    if word is None and not _COLUMN.search(told):
        return
    distance = word.measure if word is not None else None
    spacing = None if distance is not None else _spacing(frame)
    if spacing is not None:
        distance = spacing.measure
    if word is None and distance is None:
        return
    if distance is not None and not values.accepts('placement_distance', distance):
        return
    apart = (
        values.default('placement_distance')
        if distance is None
        else values.explicit('placement_distance', distance)
    )
    for before, entity in pairwise(subjects):
        placement = Placement(
            relation=Relation.BEHIND,
            of=before.id,
            distance_m=apart,
            kept_in_motion=kept or is_throughout(frame),
            throughout=is_throughout(frame),
            span=frame.span,
        )
        add_placement(entity, placement)
    for adjunct in (word, spacing):
        if adjunct is not None:
            adjunct.used = True
    _between_them(frame)


def _in_a_row(frame: Frame, adjunct: Adjunct) -> bool:
    words = frame.scene.prompt[adjunct.start : adjunct.end].lower()
    return not adjunct.nouns and words.endswith(IN_A_ROW)


def _spacing(frame: Frame) -> Adjunct | None:
    found = frame.attribute(*_APART) or frame.length('', 'at', 'with', 'of')
    if found is None or found.measure is None or found.nouns:
        return None
    return found if found.measure.bound is Bound.EXACTLY else None


def _between_them(frame: Frame) -> None:
    """`12 m between each`: of whom the clause is."""
    for adjunct in frame.free(AdjunctKind.PHRASE, 'between'):
        adjunct.used = all(n.kind is NounKind.PRONOUN for n in adjunct.nouns)


def told_distance(frame: Frame) -> bool:
    """`the distance between them is 12 m`: how far whoever was placed is from the other."""
    if frame.negated or frame.key not in ('be', 'exist', '', *_HAVING):
        return False
    subjects = [n for n in frame.subject_nouns if n.key != 'there']
    value = frame.attribute(*_APART)
    words = next(
        (a for a in frame.free(AdjunctKind.MARK, 'thing') if a.value in _APART and a is not value),
        None,
    )
    between = frame.free(AdjunctKind.PHRASE, 'between')
    if value is None and (words is not None or between):
        value = frame.length('', 'of')
    if value is None or value.measure is None or value.measure.bound is not Bound.EXACTLY:
        return False
    if value.key == LENGTH and words is None and not between:
        return False
    if frame.key in _HAVING:
        return value.key != LENGTH and _is_kept(frame, value)
    if subjects and (value.key not in ('away', 'standoff') or value.nouns):
        return False
    if subjects and (frame.key != 'be' or frame.free(AdjunctKind.PLACE)):
        return False  # `the van behind it, at a distance of 15 m`
    if not values.accepts('placement_distance', value.measure):
        return False
    distance = values.explicit('placement_distance', value.measure)
    nouns = [*subjects, *value.nouns, *(words.nouns if words is not None else ())]
    phrases = frame.free(AdjunctKind.PHRASE, *_BETWEEN)
    for phrase in phrases:
        nouns += phrase.nouns
    ends = _ends(frame, nouns)
    if ends is None or not _set(frame, ends, distance):
        return False
    for adjunct in (value, words, *phrases):
        if adjunct is not None:
            adjunct.used = True
    return True


def _is_kept(frame: Frame, value: Adjunct) -> bool:
    """`the car keeps a distance of 22 m to the truck`: behind it, where nothing else is told."""
    assert value.measure is not None
    flying = any(n.kind is NounKind.UAV for n in frame.subject_nouns)
    if flying or value.prep not in ('', 'of', 'with'):
        return False
    if not values.accepts('placement_distance', value.measure):
        return False
    places = frame.free(AdjunctKind.PLACE)
    side = next((a for a in places if _is_side(a)), None)
    who = frame.subjects()
    if len(who) != 1 or who[0].is_uav or places != [a for a in (side,) if a is not None]:
        return False
    phrases = frame.free(AdjunctKind.PHRASE, 'to', 'from')
    others = frame.objects([*value.nouns, *(n for p in phrases for n in p.nouns)])
    if len(others) > 1 or any(e.is_uav for e in others) or (side is not None and not others):
        return False
    distance = values.explicit('placement_distance', value.measure)
    if others:
        relation = Relation.AHEAD if side is not None and side.key == 'behind' else Relation.BEHIND
        relation = Relation.NEAR if frame.key == 'contain' and side is None else relation
        _beside_whom(frame, who[0], others[0], relation)
    if not fill_in(who + others, {e.id for e in who + others} if others else None, distance):
        return False
    for adjunct in (value, side, *phrases):
        if adjunct is not None:
            adjunct.used = True
    frame.scene.became(who[0].id)
    return True


def _is_side(adjunct: Adjunct) -> bool:
    """`the bus in front`, `the van behind it`: a side and nothing more."""
    bare = all(n.kind is NounKind.PRONOUN for n in adjunct.nouns) and adjunct.measure is None
    return bare and adjunct.key in ('ahead', 'behind')


def _beside_whom(frame: Frame, one: Entity, other: Entity, relation: Relation) -> None:
    pairs = ((one, other), (other, one))
    if not any(p.of == b.id and p.relation in DISTANT for a, b in pairs for p in a.placements):
        kept = frame.key == 'keep'
        made = Placement(
            relation=relation,
            of=other.id,
            kept_in_motion=kept,
            throughout=kept or is_throughout(frame),
            span=frame.span,
        )
        one.placements.append(made)


def fill_in(about: tuple[Entity, ...], ids: set[str] | None, distance: Parameter) -> bool:
    """Give the distance to the first placement that has none; of a pair, if one is named."""
    for entity in about:
        for i, known in enumerate(entity.placements):
            open_end = known.distance_m is None or known.distance_m.span is None
            if known.relation in DISTANT and open_end and ids in (None, {entity.id, known.of}):
                told = known.model_dump() | {'distance_m': distance}
                entity.placements[i] = Placement.model_validate(told)
                return True
    return False


def _ends(frame: Frame, nouns: list[NounPhrase]) -> tuple[Entity, ...] | None:
    """Return whose distance it is; nobody when none is named, None when that is unknown."""
    if any(n.kind not in ACTORS for n in nouns):
        return None
    if all(n.kind is NounKind.PRONOUN for n in nouns):
        told = frame.resolver.actors(nouns[:1]) if len(nouns) == 1 and nouns[0].key == 'it' else ()
        return () if all(not e.is_uav for e in told) else None
    ends = frame.objects(nouns)
    if len(ends) == 1:
        ends = (*(e for e in frame.inherited() if e not in ends), *ends)[:2]
    return None if len(ends) != 2 or any(e.is_uav for e in ends) else ends


def _set(frame: Frame, ends: tuple[Entity, ...], distance: Parameter) -> bool:
    """Give the distance to the one placement that it can belong to."""
    beside = next((a for a in frame.free(AdjunctKind.PLACE) if a.key in ('ahead', 'behind')), None)
    pronoun = beside is not None and all(n.kind is NounKind.PRONOUN for n in beside.nouns)
    if ends and beside is not None and beside.measure is None and pronoun:
        beside.used = True
        first, second = ends  # `between the ego and the van ahead of it`
        relation = Relation(beside.key)
        made = Placement(relation=relation, of=first.id, distance_m=distance, span=frame.span)
        add_placement(second, made)
        frame.scene.became(second.id)
        return True
    ids = {e.id for e in ends} or None
    for clause in reversed(frame.scene.clauses[:-1]):
        for entity in (*clause.subjects, *clause.objects):
            if fill_in((entity,), ids, distance):
                frame.scene.became(entity.id)
                return True
        if not ids and clause.subjects:
            return False
    return False
