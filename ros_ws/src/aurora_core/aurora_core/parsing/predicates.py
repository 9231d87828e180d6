# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Several predicates without a separator: `a drone that tracks the van alerts the ego`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT, Link, Piece


def cut_at_verbs(piece: Piece) -> list[Piece]:
    atoms = piece.atoms
    verbs = [i for i, a in enumerate(atoms) if a.kind is AtomKind.VERB]
    if len(verbs) < 2:
        return [piece]
    pieces: list[Piece] = []
    begin = 0
    state = piece
    for previous, i in pairwise(verbs):
        cut, upcoming = _cut_before(atoms, begin, previous, i)
        if cut <= begin:
            continue
        if upcoming.link is Link.MAIN and upcoming.head is not None:
            # `a drone that tracks the van | alerts`: the first part only describes
            upcoming = replace(upcoming, link=state.link, opens=state.opens, then=state.then)
            state = replace(state, link=Link.RELATIVE)
        pieces.append(replace(state, atoms=atoms[begin:cut]))
        state = upcoming
        begin = cut
    pieces.append(replace(state, atoms=atoms[begin:]))
    return pieces


def _cut_before(atoms: tuple[Atom, ...], begin: int, previous: int, i: int) -> tuple[int, Piece]:
    verb = atoms[i]
    j = i
    while j - 1 > previous and atoms[j - 1].kind in (*TRANSPARENT, AtomKind.CAUSATIVE):
        j -= 1
    before = atoms[j - 1]
    if before.kind is AtomKind.PREPOSITION:
        if before.key == 'to' and verb.form is VerbForm.BASE:
            return j - 1, Piece(atoms=(), link=Link.INFINITIVE)
        if verb.form is VerbForm.ING:
            link = {
                'before': Link.MAIN,
                'after': Link.AFTER,
                'until': Link.UNTIL,
            }.get(before.key, Link.PARTICIPLE)
            return j - 1, Piece(atoms=(), link=link, then=before.key == 'before')
    if verb.key == 'be' and before.kind is AtomKind.THING and j - 1 > previous:
        return j - 1, Piece(atoms=())  # `a circle whose radius is 80 m`
    if before.is_actor and j - 1 > previous:
        opening = atoms[previous]
        hanging = any(a.kind is AtomKind.RELATIVE for a in atoms[begin:previous]) or (
            opening.form is VerbForm.ING and _no_auxiliary(atoms, begin, previous)
        )
        finite = verb.form in (VerbForm.THIRD, VerbForm.BASE) or _has_aux(atoms, j, i)
        head = next((a for a in atoms[begin:previous] if a.is_actor), None)
        if hanging and finite and head is not None:
            return j, Piece(atoms=(), head=head)
        of_noun = j >= 2 and atoms[j - 2].kind is AtomKind.PREPOSITION and atoms[j - 2].key == 'of'
        if verb.form is VerbForm.ING and verb.key in _OF_THE_SUBJECT and not of_noun:
            return j, Piece(atoms=(), link=Link.PARTICIPLE)
        asked = j >= 2 and atoms[j - 2].kind is AtomKind.RELATIVE and _has_aux(atoms, j, i)
        if asked:  # `the van that my car is following`
            return j - 1, Piece(atoms=())
        if verb.form is VerbForm.ING or (verb.form is VerbForm.PAST and not _has_aux(atoms, j, i)):
            return j, Piece(atoms=(), link=Link.RELATIVE, head=before)
        return j - 1, Piece(atoms=())
    if verb.form is VerbForm.ING:
        return j, Piece(atoms=(), link=Link.PARTICIPLE)
    told = any(
        a.kind is AtomKind.RELATIVE and a.key in ('which', 'who') for a in atoms[begin:previous]
    )
    if told and verb.form is VerbForm.THIRD:  # `the drone which tracked it | goes`
        head = next((a for a in atoms[begin:previous] if a.is_actor), None)
        return j, Piece(atoms=(), head=head)
    helped = atoms[j].kind is AtomKind.AUXILIARY
    finite = helped or verb.form is VerbForm.THIRD
    described = _described(atoms, begin, previous) if finite else None
    if described is not None:  # `a drone that is hovering there | can see the bus`
        return j, Piece(atoms=(), head=described)
    participle = atoms[previous].form in (VerbForm.ING, VerbForm.PAST)
    if finite and participle and _no_auxiliary(atoms, begin, previous):
        # `the drone watching the market from 70 m | has been there`
        head = next((a for a in atoms[begin:previous] if a.is_actor), None)
        return j, Piece(atoms=(), head=head)
    return j, Piece(atoms=())


def _described(atoms: tuple[Atom, ...], begin: int, previous: int) -> Atom | None:
    """Return the subject whose relative clause has the verb, None when the clause has none."""
    for k in range(begin, previous):
        if atoms[k].kind is AtomKind.VERB:
            return None
        if atoms[k].kind is AtomKind.RELATIVE:
            return atoms[k - 1] if k > begin and atoms[k - 1].is_actor else None
    return None


# Participles that speak about the subject even right behind another noun.
_OF_THE_SUBJECT = ('approach', 'keep')


def _no_auxiliary(atoms: Sequence[Atom], begin: int, stop: int) -> bool:
    return not any(a.kind is AtomKind.AUXILIARY for a in atoms[begin:stop])


def _has_aux(atoms: Sequence[Atom], begin: int, stop: int) -> bool:
    return any(a.kind is AtomKind.AUXILIARY for a in atoms[begin:stop])
