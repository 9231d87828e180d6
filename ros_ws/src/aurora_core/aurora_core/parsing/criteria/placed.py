# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Where somebody is whom a condition names: `the gap between the ego and the van behind it`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
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
