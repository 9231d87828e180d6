# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Whether a new clause begins behind a comma or an `and`, and what it is."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind
from aurora_core.parsing.gaps import opens_gap
from aurora_core.parsing.measures import SPEED
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import (
    MARKERS,
    TRANSPARENT,
    Link,
    Piece,
    first_solid,
    flies,
    has_verb,
)
from aurora_core.parsing.subjects import is_complete

# What a UAV does next: `orbits it before it hovers over the park`.
_PHASES = frozenset({'hover', 'track', 'orbit', 'navigate', 'land'})


def opened_clause(
    current: Sequence[Atom], markers: Sequence[Atom], ahead: Sequence[Atom]
) -> Piece | None:
    """Return the shape of the clause that begins behind the markers, None when none begins."""
    then = any(m.kind is AtomKind.THEN for m in markers)
    for marker in markers:
        if marker.kind is AtomKind.SUBORDINATOR:
            first = first_solid(ahead)
            gerund = first is not None and first.form is VerbForm.ING
            if marker.key == 'before' and current and (gerund or _goes_on(ahead)):
                return Piece(atoms=(), then=True, lead=marker.start)
            return Piece(atoms=(), link=Link(marker.key), then=then, lead=marker.start)
    solid = first_solid(ahead)
    if solid is None:
        return None
    relative = any(m.kind is AtomKind.RELATIVE for m in markers)
    if relative:
        head = next((a for a in reversed(current) if a.is_actor), None)
        alone = sum(a.kind is AtomKind.VERB for a in ahead) == 1 and is_placed(current)
        listed = any(m.kind is AtomKind.CONJUNCTION for m in markers) and has_verb(current)
        if listed and has_verb(ahead) and solid.noun is not None and markers[-1].key == 'that':
            return Piece(atoms=())  # `make sure that … and that no bus comes`
        if solid.kind is not AtomKind.VERB or head is None:
            return None
        if not has_verb(current) and not (alone and head is current[-1]):
            return None
        return Piece(atoms=(), link=Link.RELATIVE, head=head)
    verb = has_verb(ahead)
    if then:
        return Piece(atoms=(), then=True) if verb or not current else None
    if not current:
        return None
    if verb:
        return _opened_predicate(current, markers, ahead, solid)
    if opens_gap(current, ahead) or _is_share(ahead) or is_inverted(ahead):
        return Piece(atoms=())
    actor_list = not has_verb(current) and _only_actors(current)
    comma = any(m.kind is AtomKind.COMMA for m in markers)
    refers = any(a.noun is not None and a.noun.kind is NounKind.PRONOUN for a in ahead)
    anchored = refers or _hangs(ahead)
    if _shares_place(current, ahead) and not comma and not anchored:
        return None
    if solid.is_actor and is_placed(ahead) and (not actor_list or (comma and anchored)):
        return Piece(atoms=())
    if comma and solid.kind is AtomKind.UNKNOWN and is_placed(ahead) and is_placed(current):
        return Piece(atoms=())  # whoever that is, it is nobody named before
    if comma and not actor_list and _has_speed(ahead):
        return Piece(atoms=())  # `…, truck 12 m/s`
    aerial = solid.noun is not None and solid.noun.kind is NounKind.UAV
    if aerial and comma and has_verb(current) and not _only_actors(ahead):
        return Piece(atoms=())  # `…, drone overhead at 30 m`
    if solid.is_actor and comma and not actor_list and _only_actors(ahead):
        last = next((a for a in reversed(current) if a.kind not in TRANSPARENT), None)
        if is_placed(current) or (last is not None and not last.is_actor):
            return Piece(atoms=())  # `…, two background cars`
    return None


def _goes_on(ahead: Sequence[Atom]) -> bool:
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    flown = len(solid) > 1 and solid[0].is_actor and flies(solid[0])
    return flown and solid[1].kind is AtomKind.VERB and solid[1].key in _PHASES


def _opened_predicate(
    current: Sequence[Atom], markers: Sequence[Atom], ahead: Sequence[Atom], solid: Atom
) -> Piece | None:
    conjunction = any(m.kind is AtomKind.CONJUNCTION for m in markers)
    if solid.kind is AtomKind.VERB:
        if solid.form is VerbForm.ING and not conjunction:
            return Piece(atoms=(), link=Link.PARTICIPLE)
        by = any(a.kind is AtomKind.PREPOSITION and a.key == 'by' for a in ahead)
        if solid.form is VerbForm.PAST and by and not conjunction:
            head = next((a for a in reversed(current) if a.is_actor), None)
            return Piece(atoms=(), link=Link.RELATIVE, head=head)
        return Piece(atoms=())
    beside = any(m.key == 'with' for m in markers)  # `a bus with a van following it`
    if not has_verb(current) and conjunction and solid.is_actor and not beside:
        last = next((a for a in reversed(current) if a.kind not in TRANSPARENT), None)
        placed = is_placed(current) and not any(a.kind is AtomKind.THING for a in current)
        noun = solid.noun
        everyone = noun is not None and noun.kind is NounKind.PRONOUN and noun.key == 'both'
        if everyone and any(m.kind is AtomKind.COMMA for m in markers):
            return Piece(atoms=())  # `three cars and a bus, and all of them drive around`
        if last is not None and last.is_actor and not placed:
            return None  # coordinated subjects
    return Piece(atoms=())


def _only_actors(atoms: Sequence[Atom]) -> bool:
    return all(
        a.is_actor or a.kind in TRANSPARENT or a.kind in MARKERS or a.kind is AtomKind.CAUSATIVE
        for a in atoms
    )


def is_placed(atoms: Sequence[Atom]) -> bool:
    """`an ambulance behind it`, `a drone above the bus`: an actor with a place."""
    solid = [a for a in atoms if a.kind not in TRANSPARENT]
    if len(solid) < 2 or not (solid[0].is_actor or solid[0].kind is AtomKind.UNKNOWN):
        return False
    place_words = (AtomKind.RELATION, AtomKind.PREPOSITION, AtomKind.SIREN, AtomKind.STATE)
    return solid[1].kind in place_words or (
        solid[1].kind is AtomKind.MEASURE and len(solid) > 2 and solid[2].kind in place_words
    )


def _has_speed(atoms: Sequence[Atom]) -> bool:
    solid = [a for a in atoms if a.kind not in TRANSPARENT]
    agent = bool(solid) and solid[0].noun is not None and solid[0].noun.kind in _GROUND
    return agent and len(solid) > 1 and solid[1].measure is not None and solid[1].key == SPEED


_GROUND = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def _shares_place(current: Sequence[Atom], ahead: Sequence[Atom]) -> bool:
    """`put five bicycles and a bus on the main road`: the place is that of both."""
    told = [a for a in current if a.kind not in TRANSPARENT]
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    if len(told) < 2 or len(solid) < 3 or not told[-1].is_actor or not solid[0].is_actor:
        return False
    places = told[-2].kind is AtomKind.VERB and told[-2].key in ('put', 'exist', 'contain', 'be')
    flying = any(flies(a) for a in (told[-1], solid[0]))
    return places and not flying and solid[1].kind is AtomKind.PREPOSITION and solid[2].is_place


def _hangs(atoms: Sequence[Atom]) -> bool:
    """`van 30 m behind`: of whom it is said is named before."""
    solid = [a for a in atoms if a.kind not in TRANSPARENT]
    return solid[-1].kind is AtomKind.RELATION


def is_inverted(ahead: Sequence[Atom]) -> bool:
    """`…, and 15 m behind the van a car`: whoever is new is placed by whoever is known."""
    solid = [a for a in ahead if a.kind not in TRANSPARENT]
    solid = solid[1:] if solid and solid[0].measure is not None else solid
    if len(solid) > 2 and solid[2].measure is not None and solid[1].key == 'at':
        solid = [solid[0], *solid[3:]]  # `behind it at 18 m a motorcycle`
    if len(solid) > 3 and solid[3].measure is not None and solid[2].key == 'at':
        solid = [*solid[:2], *solid[4:]]
    if len(solid) == 2 and solid[0].kind is AtomKind.RELATION and solid[1].is_actor:
        return is_complete(solid[0].words) and _is_new(solid[1])  # `…, to the right a van`
    if len(solid) != 3 or solid[0].kind is not AtomKind.RELATION:
        return False
    known = solid[1].noun
    if known is None or not solid[1].is_actor or not solid[2].is_actor:
        return False
    told = known.determiner is Determiner.DEFINITE or known.kind is NounKind.PRONOUN
    return told and _is_new(solid[2])


def _is_new(atom: Atom) -> bool:
    noun = atom.noun
    return noun is not None and (noun.determiner is Determiner.INDEFINITE or noun.count > 0)


def _is_share(ahead: Sequence[Atom]) -> bool:
    """`two drones, one at 40 m, the other at 60 m`: what each of them has."""
    first = first_solid(ahead)
    member = first is not None and first.noun is not None and first.noun.kind is NounKind.PRONOUN
    told = any(a.measure is not None for a in ahead)
    named = first is not None and first.key in ('one', 'other', 'another')
    return member and told and (named or (first is not None and first.key.startswith('nth')))
