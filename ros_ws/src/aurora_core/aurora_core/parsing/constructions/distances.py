# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Distance as a cause: `comes within 20 m`, `the gap drops below 20 m`."""

from __future__ import annotations

from dataclasses import dataclass

from aurora_core.parsing import values
from aurora_core.parsing.adjuncts import Adjunct, AdjunctKind
from aurora_core.parsing.atoms import ACTORS, NounPhrase
from aurora_core.parsing.criteria.causes import who_moves
from aurora_core.parsing.frames import Frame
from aurora_core.parsing.scene import Entity
from aurora_core.spec.parameter import Parameter
from aurora_core.spec.scenario import Placement
from aurora_core.spec.vocabulary import Relation

_SIDES = ('ahead', 'behind')
_NEARING = frozenset(
    {'come', 'approach', 'be', 'keep', 'drive', 'fall_below', 'reach', 'walk', 'fly'}
)


@dataclass(frozen=True, slots=True, kw_only=True)
class DistanceCause:
    """A distance trigger whose other end may still be unknown."""

    below: bool
    a: Entity
    b: str | None
    value_m: Parameter


def distance_cause(frame: Frame) -> DistanceCause | None:
    gap = _gap(frame)
    if gap is not None:
        return gap
    if frame.key not in (*_NEARING, 'exceed', ''):
        return None
    found = _threshold(frame)
    if found is None:
        return None
    adjunct, below = found
    measure = adjunct.measure
    if measure is None or not values.accepts('trigger_distance', measure):
        return None
    subjects = frame.subjects()
    if not subjects:
        return None
    flown = subjects
    subjects = who_moves(frame, subjects)
    other: str | None = None
    if len(subjects) == 2:
        other = subjects[1].id
    else:
        nouns = adjunct.nouns or _other_nouns(frame)
        if nouns:
            other = reference(frame, nouns)
            if other is None:
                return None
    if other == subjects[0].id:
        subjects = flown  # `when it is within 30 m of the van`: whoever tracks the van
    if other == subjects[0].id:
        return None
    adjunct.used = True
    if adjunct.kind is AdjunctKind.PLACE:
        _on_that_side(frame, subjects[0], adjunct, other)
    return DistanceCause(
        below=below,
        a=subjects[0],
        b=other,
        value_m=values.explicit('trigger_distance', measure),
    )


def _on_that_side(frame: Frame, subject: Entity, adjunct: Adjunct, other: str | None) -> None:
    """`when a truck is less than 30 m behind me`: it is behind; a distance has no side."""
    if subject.is_uav or other is None or frame.scene.by_id(other) is None:
        frame.flag(adjunct.start, adjunct.end)
        return
    here = [p.relation for p in subject.placements if p.of == other]
    if not subject.placements:
        subject.placements.append(Placement(relation=Relation(adjunct.key), of=other))
    elif Relation(adjunct.key) not in here:
        frame.flag(adjunct.start, adjunct.end)


def _threshold(frame: Frame) -> tuple[Adjunct, bool] | None:
    for adjunct in frame.free(AdjunctKind.ATTRIBUTE, 'away', 'gap', 'standoff'):
        near = adjunct.prep in ('within', 'below', 'to')
        far = adjunct.prep == 'beyond' or (frame.key in ('exceed', 'come', 'drive') and not near)
        if near or far or frame.key in ('be', 'fall_below', 'approach', 'reach'):
            return adjunct, not far
    for place in frame.free(AdjunctKind.PLACE):
        if place.key in _SIDES and place.prep in ('within', 'below', 'beyond'):
            return place, place.prep != 'beyond'
    for prep, below in (('within', True), ('below', True), ('beyond', False)):
        length = frame.length(prep)
        if length is not None:
            return length, below
    if frame.key in ('approach', 'come', 'fall_below'):
        length = frame.length('to', '')
        if length is not None:
            return length, True
    for adjunct in frame.free(AdjunctKind.PLACE):
        if (
            adjunct.measure is not None
            and adjunct.key in ('near', 'behind', 'ahead')
            and adjunct.nouns
        ):
            return (adjunct, True) if adjunct.key == 'near' else None
    return None


def _gap(frame: Frame) -> DistanceCause | None:
    """`the gap between the van and the ego drops below 20 m`, `gap < 20 m`."""
    if frame.key not in ('be', 'fall_below', 'exceed', 'reach', 'come', 'approach', ''):
        return None
    found = _gap_words(frame)
    if found is None:
        return None
    words, length = found
    if length.measure is None or not values.accepts('trigger_distance', length.measure):
        return None
    below = frame.key != 'exceed' and length.prep != 'beyond'
    nouns = list(words.nouns)
    for adjunct in frame.free(AdjunctKind.PHRASE, 'between', 'to', 'from', 'of'):
        nouns += adjunct.nouns
        adjunct.used = True
    ends = frame.objects([n for n in nouns if n.kind in ACTORS]) or _watched(frame)
    if not ends:
        return None
    words.used = length.used = True
    frame.scene.clause.subjects = ends[:1]
    return DistanceCause(
        below=below,
        a=ends[0],
        b=ends[1].id if len(ends) > 1 else None,
        value_m=values.explicit('trigger_distance', length.measure),
    )


def _gap_words(frame: Frame) -> tuple[Adjunct, Adjunct] | None:
    """Return the word for the distance and the adjunct with its value (may be one)."""
    names = ('gap', 'standoff', 'separation')
    if not frame.subject_nouns:
        for adjunct in frame.free(AdjunctKind.ATTRIBUTE, *names):
            if adjunct.prep in ('within', 'below', 'beyond', 'of'):
                return adjunct, adjunct
    length = frame.length('', 'below', 'within', 'beyond', 'to', 'at')
    for mark in frame.free(AdjunctKind.MARK, 'thing'):
        if mark.value in names and length is not None and frame.verb is not None:
            return mark, length
    return None


def _watched(frame: Frame) -> tuple[Entity, ...]:
    """`when the gap drops below 20 m`: the gap of whom the UAV tracks, or of who acted last."""
    tracked = [m.target for m in frame.scene.missions if m.target is not None]
    entity = frame.scene.by_id(tracked[-1]) if tracked else None
    if entity is not None:
        return (entity,)
    for clause in reversed(frame.scene.clauses[:-1]):
        agents = tuple(e for e in clause.subjects if not e.is_uav)
        if agents:
            return agents[:1]
    return ()


def _other_nouns(frame: Frame) -> tuple[NounPhrase, ...]:
    for adjunct in frame.free(AdjunctKind.PHRASE, 'of', 'to', 'from') + frame.free(
        AdjunctKind.OBJECT
    ):
        adjunct.used = True
        return adjunct.nouns
    return ()


def reference(frame: Frame, nouns: tuple[NounPhrase, ...]) -> str | None:
    for noun in nouns:
        place = frame.resolver.place(noun)
        if place is not None:
            frame.scene.clause.places += (place,)
            return place
    found = frame.objects([n for n in nouns if n.kind in ACTORS])
    return found[0].id if found else None
