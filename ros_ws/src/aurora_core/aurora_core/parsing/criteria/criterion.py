# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""What a clause that states a success condition says, before it is known of whom."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
from aurora_core.parsing.criteria.moments import Moment
from aurora_core.parsing.measures import Measure
from aurora_core.spec.parameter import Span
from aurora_core.spec.vocabulary import Relation

_OWNERS = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)
_AT = {'on': Relation.ON, 'at': Relation.AT, 'along': Relation.ON}
_RELATIONS = frozenset(
    {
        Relation.AHEAD,
        Relation.BEHIND,
        Relation.BESIDE,
        Relation.LEFT,
        Relation.RIGHT,
        Relation.ADJACENT_LANE,
        Relation.ONCOMING,
    }
)


@dataclass(frozen=True, slots=True, kw_only=True)
class Placed:
    """One actor of a condition, its relation, and the actor or place that the relation is to."""

    owner: NounPhrase
    relation: Relation
    of: NounPhrase
    span: Span
    at_place: bool = False


def take_places(atoms: Sequence[Atom]) -> tuple[list[Atom], tuple[Placed, ...]]:
    """Return the atoms without the places that stand right behind actors, and these places."""
    kept: list[Atom] = []
    found: list[Placed] = []
    i = 0
    while i < len(atoms):
        atom, owner = atoms[i], kept[-1].noun if kept else None
        stands = _stands_at(atoms, i) if owner is not None and owner.kind in _OWNERS else None
        if stands is not None and owner is not None:
            found.append(replace(stands, owner=owner))
            i += 2
            continue
        of = atoms[i + 1].noun if i + 1 < len(atoms) and atoms[i + 1].is_actor else None
        placed = owner is not None and owner.kind in _OWNERS and atom.key in _RELATIONS
        if atom.kind is AtomKind.RELATION and placed and owner is not None and of is not None:
            span = Span(start=atom.start, end=atoms[i + 1].end)
            found.append(Placed(owner=owner, relation=Relation(atom.key), of=of, span=span))
            i += 2
            continue
        kept.append(atom)
        i += 1
    return kept, tuple(found)


def _stands_at(atoms: Sequence[Atom], i: int) -> Placed | None:
    """`a motorbike on the main road must not exceed 40 km/h`: a place, no end of a distance."""
    place = atoms[i + 1].noun if i + 1 < len(atoms) and atoms[i + 1].is_place else None
    relation = _AT.get(atoms[i].key) if atoms[i].kind is AtomKind.PREPOSITION else None
    if place is None or relation is None or place.kind is NounKind.PRONOUN:
        return None
    span = Span(start=atoms[i].start, end=atoms[i + 1].end)
    return Placed(owner=place, relation=relation, of=place, span=span, at_place=True)


Op = Literal['<=', '<', '>=', '>', '==']


@dataclass(frozen=True, slots=True, kw_only=True)
class Limit:
    """A comparison with a number."""

    op: Op
    measure: Measure
    name: str  # letter and number in the line: `L0`

    @property
    def dimension(self) -> str:
        return self.name[0]


@dataclass(frozen=True, slots=True, kw_only=True)
class Criterion:
    """A condition.

    Attributes:
        limits: What is compared; none for `must have landed`.
        hold: How long it has to hold in one stretch, or in all.
        unbroken: The time of `hold` is one stretch.
        by: Deadline from the start of the run.
        share: Share of the time in which it has to hold.
        topics: Keys of `topics` in criteria.yaml whose words stand in the clause.
        nouns: Actors and places in the order of the text.
        event: What must happen then: `the crossing must not begin before 20 s`.
        owned: `its distance`: of somebody named before.
        others: The clause names only those whom somebody named before keeps off.
        placed: Where those are whom it names.
        unread: Words that were left out because nobody knows them.
    """

    limits: tuple[Limit, ...]
    hold: Limit | None = None
    unbroken: bool = False
    by: Measure | None = None
    share: Limit | None = None
    topics: frozenset[str] = frozenset()
    nouns: tuple[NounPhrase, ...] = ()
    event: Moment | None = None
    owned: bool = False
    others: bool = False
    placed: tuple[Placed, ...] = ()
    unread: tuple[Span, ...] = ()
    words: str = ''
