# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Clauses: one predicate each, with the word that links it to its neighbours."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from aurora_core.parsing.atom_runs import runs
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.clause_openings import plain_prepositions
from aurora_core.parsing.clause_order import (
    attach_adjuncts,
    causes_first,
    causes_of_next,
    delays_to_causes,
    descriptions_first,
    names_others,
    of_a_cause,
)
from aurora_core.parsing.criteria.causes import cause_end
from aurora_core.parsing.criteria.spans import stretches
from aurora_core.parsing.gaps import fill_gaps
from aurora_core.parsing.measures import SPEED
from aurora_core.parsing.new_clauses import opened_clause
from aurora_core.parsing.pieces import MARKERS, TRANSPARENT, Link, Piece, has_verb
from aurora_core.parsing.predicates import cut_at_verbs

_OPENING, _CLOSING = '(', ')'


@dataclass(frozen=True, slots=True, kw_only=True)
class Aside:
    """`the truck (40 m in front)`: the words in brackets and the noun that they are about."""

    atoms: tuple[Atom, ...]
    head: Atom


def take_out(atoms: Sequence[Atom]) -> tuple[list[Atom], list[Aside]]:
    """Return a sentence without the brackets that are clauses, and those."""
    kept: list[Atom] = []
    asides: list[Aside] = []
    i = 0
    while i < len(atoms):
        stop = _closing(atoms, i)
        relative = None if stop is not None else _relative(atoms, i)
        if relative is not None:
            before = next((a for a in reversed(kept) if a.kind not in TRANSPARENT), None)
            assert before is not None
            asides.append(Aside(atoms=tuple(atoms[i + 2 : relative]), head=before))
            i = relative + 1
            continue
        if stop is None:
            kept.append(atoms[i])
            i += 1
            continue
        inner = tuple(atoms[i + 1 : stop])
        head = next((a for a in reversed(kept) if a.kind not in TRANSPARENT), None)
        if head is not None and head.is_actor and (_says_more(inner) or _speed_of(head, inner)):
            asides.append(Aside(atoms=inner, head=head))
        else:
            kept += [
                replace(a, kind=AtomKind.FILL) if a.kind is AtomKind.COMMA else a for a in inner
            ]
        i = stop + 1
    return kept, asides


def _closing(atoms: Sequence[Atom], i: int) -> int | None:
    if atoms[i].kind is not AtomKind.FILL or atoms[i].key != _OPENING:
        return None
    for j in range(i + 1, len(atoms)):
        if atoms[j].kind is AtomKind.FILL and atoms[j].key == _CLOSING:
            return j
    return None


def _relative(atoms: Sequence[Atom], i: int) -> int | None:
    """Return the comma that ends `, which drives at 8 m/s,` between a subject and its verb."""
    opens = atoms[i].kind is AtomKind.COMMA and 0 < i < len(atoms) - 2
    if not opens or atoms[i + 1].kind is not AtomKind.RELATIVE or not atoms[i - 1].is_actor:
        return None
    for j in range(i + 2, len(atoms) - 1):
        if atoms[j].kind is AtomKind.COMMA:
            goes_on = next((a for a in atoms[j + 1 :] if a.kind is not AtomKind.FILL), None)
            finite = goes_on is not None and goes_on.kind in (AtomKind.VERB, AtomKind.AUXILIARY)
            return j if finite and has_verb(atoms[i + 2 : j]) else None
    return None


def _says_more(inner: Sequence[Atom]) -> bool:
    """A predicate or a place; an actor of its own is told inside the sentence."""
    told = has_verb(inner) or any(a.kind is AtomKind.RELATION for a in inner)
    return told and not any(a.is_actor for a in inner[:1])


def _speed_of(head: Atom, inner: Sequence[Atom]) -> bool:
    """`a bus (8 m/s) and a pedestrian`: how fast the bus is."""
    ground = head.noun is not None and head.noun.kind in (NounKind.AGENT, NounKind.EGO)
    told = [a for a in inner if a.kind not in TRANSPARENT and a.kind is not AtomKind.PREPOSITION]
    return ground and len(told) == 1 and told[0].measure is not None and told[0].key == SPEED


_CAUSES = (Link.WHEN, Link.AFTER, Link.UNTIL)


def cut_at_markers(atoms: list[Atom]) -> list[Piece]:
    """Cut at commas, conjunctions and subordinating words that open a clause."""
    pieces: list[Piece] = []
    current: list[Atom] = []
    state = Piece(atoms=(), opens=True)
    i = 0
    while i < len(atoms):
        if atoms[i].kind not in MARKERS:
            current.append(atoms[i])
            i += 1
            continue
        run = i
        while run < len(atoms) and (
            atoms[run].kind in MARKERS
            or (
                atoms[run].kind in (AtomKind.FILL, AtomKind.FRAME)
                and run + 1 < len(atoms)
                and atoms[run + 1].kind in MARKERS
            )
        ):
            run += 1
        markers = [a for a in atoms[i:run] if a.kind in MARKERS]
        following = _next_run(atoms, run)
        upcoming = opened_clause(current, markers, following)
        if upcoming is None:
            current += atoms[i:run]
        else:
            if current:
                pieces.append(replace(state, atoms=tuple(current)))
            opens = (
                not pieces or upcoming.then or any(m.kind is AtomKind.CONJUNCTION for m in markers)
            )
            comma = bool(markers) and markers[0].kind is AtomKind.COMMA
            state = replace(upcoming, opens=opens, paused=comma)
            current = []
            end = run + cause_end(atoms[run:]) if upcoming.link in _CAUSES else run
            # In front, only a pause can tell where the cause ends and the effect begins.
            if end > run and (pieces or end < len(atoms)):
                pieces.append(replace(state, atoms=tuple(atoms[run:end]), whole=True))
                state = Piece(atoms=())
                run = end + (end < len(atoms) and atoms[end].kind is AtomKind.COMMA)
        i = run
    if current:
        pieces.append(replace(state, atoms=tuple(current)))
    return pieces


def _next_run(atoms: Sequence[Atom], start: int) -> list[Atom]:
    ahead = []
    for atom in atoms[start:]:
        if atom.kind in MARKERS and atom.kind is not AtomKind.RELATIVE:
            break
        ahead.append(atom)
    return ahead


def cut_behind_comparison(piece: Piece) -> list[Piece]:
    """`if ego > 15 m/s drone warns it`: a cause without a verb ends with its number."""
    atoms = piece.atoms
    if piece.link is not Link.WHEN or piece.whole:
        return [piece]
    for i in range(1, len(atoms) - 2):
        solid = [a for a in atoms[i + 1 :] if a.kind not in TRANSPARENT]
        acts = len(solid) > 1 and solid[0].is_actor and solid[1].kind is AtomKind.VERB
        if atoms[i].kind is AtomKind.MEASURE and acts and not has_verb(atoms[:i]):
            return [replace(piece, atoms=atoms[: i + 1]), Piece(atoms=atoms[i + 1 :])]
    return [piece]


def segment(atoms: Sequence[Atom]) -> tuple[Piece, ...]:
    """Cut a prompt's atoms into clauses, in the order of the text."""
    pieces: list[Piece] = []
    sentences = [sentence for sentence, _ in runs(atoms, AtomKind.STOP) if sentence]
    for number, sentence in enumerate(sentences):
        pieces += _sentence(tuple(sentence), number)
    return tuple(pieces)


# A second look reads the other sentences of a prompt again and again.
@lru_cache(maxsize=64)
def _sentence(atoms: tuple[Atom, ...], number: int) -> tuple[Piece, ...]:
    """Cut out the conditions that a sentence states, then read what stands around them."""
    pieces: list[Piece] = []
    for stretch in stretches(atoms):
        if stretch.criterion is None:
            pieces += clauses(stretch.atoms, number)
        else:
            told = Piece(atoms=stretch.atoms, sentence=number, criterion=stretch.criterion)
            pieces.append(told)
    return tuple(pieces)


def clauses(atoms: Sequence[Atom], number: int) -> list[Piece]:
    """Cut a sentence, or a stretch of one, into clauses."""
    plain, asides = take_out(list(atoms))
    raw = cut_at_markers(plain_prepositions(plain))
    parts = [part for whole in raw for part in cut_behind_comparison(whole)]
    pieces = [p for part in parts for p in ([part] if part.whole else cut_at_verbs(part))]
    pieces = attach_adjuncts(delays_to_causes(fill_gaps(pieces)))
    pieces = causes_of_next(causes_first(pieces))
    told = [Piece(atoms=a.atoms, link=Link.RELATIVE, head=a.head) for a in asides]
    first = [p for p in told if names_others(p) or of_a_cause(p, pieces)]
    pieces = first + pieces + [p for p in told if p not in first]
    return [replace(p, sentence=number) for p in descriptions_first(pieces) if p.atoms]
