# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Causes and effects in one sentence that says only that one prompts the other.

`detection of a bus by the UAV triggers a message to the ego`, `what makes the drone report is the
van going faster than 60 km/h`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, LOOSE, by_sentence, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.rewriting.nominal_causes import told_event

_SIGHT = ('see', 'lose')


def prompted(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with such sentences as `when …, …`."""
    return by_sentence(
        _seen_by(list(atoms)),
        lambda told: _what_makes(told, prompt) or _message(told, prompt) or told,
    )


def _seen_by(atoms: list[Atom]) -> list[Atom]:
    """`detection of a bus by the UAV`: the UAV detecting a bus."""
    for i in range(len(atoms) - 4):
        sight, of = atoms[i], atoms[i + 1]
        if sight.kind is not AtomKind.HAPPENING or sight.key not in _SIGHT or of.key != 'of':
            continue
        seen = skip(atoms, i + 2)
        by = skip(atoms, seen + 1)
        who = skip(atoms, by + 1)
        if who >= len(atoms) or atoms[by].key != 'by' or not atoms[who].is_actor:
            continue
        if atoms[seen].noun is None:
            continue
        sees = replace(sight, kind=AtomKind.VERB, form=VerbForm.ING)
        return [*atoms[:i], atoms[who], sees, atoms[seen], *_seen_by(atoms[who + 1 :])]
    return atoms


def _causes(atom: Atom) -> bool:
    return AtomKind.CAUSING in (atom.kind, *atom.other_kinds)


def _message(atoms: list[Atom], prompt: str) -> list[Atom] | None:
    """`… leads to a message from the drone to the ego`: the drone sends it."""
    for i in range(1, len(atoms) - 1):
        if not _causes(atoms[i]):
            continue
        k = skip(atoms, i + 1)
        if k < len(atoms) and atoms[k].key in ('to', 'in', 'off'):
            k = skip(atoms, k + 1)
        if k >= len(atoms) or atoms[k].kind is not AtomKind.MESSAGE:
            continue
        ends = {}
        at = k + 1
        while at + 1 < len(atoms) and atoms[at + 1].is_actor:
            ends['from' if atoms[at].key in ('by', 'of') else atoms[at].key] = atoms[at + 1]
            at += 2
        cause = told_event(atoms[:i], prompt)
        if cause is None or 'to' not in ends or not {'from', 'to'}.issuperset(ends):
            continue
        comma = replace(atoms[i], kind=AtomKind.COMMA, key=',')
        send = replace(atoms[i], kind=AtomKind.VERB, key='send', form=VerbForm.BASE)
        sender = [ends['from']] if 'from' in ends else []
        if sender:
            send = replace(send, form=VerbForm.THIRD)
        to = replace(atoms[k], kind=AtomKind.PREPOSITION, key='to')
        return [*cause, comma, *sender, send, atoms[k], to, ends['to'], *atoms[at:]]
    return None


def _what_makes(atoms: list[Atom], prompt: str) -> list[Atom] | None:
    """`what makes the bus brake is a child crossing`: the bus brakes when a child crosses."""
    what = skip(atoms, 0)
    makes = skip(atoms, what + 1)
    who = skip(atoms, makes + 1)
    if who >= len(atoms) or text_of(atoms[what], prompt) != 'what' or not atoms[who].is_actor:
        return None
    verb = skip(atoms, who + 1, (*HELPERS, AtomKind.PREPOSITION))
    if not _causes(atoms[makes]) or verb >= len(atoms) or atoms[verb].kind is not AtomKind.VERB:
        return None
    be = next((k for k in range(verb + 1, len(atoms)) if _is_be(atoms[k], prompt)), None)
    cause = told_event(atoms[be + 1 :], prompt) if be is not None else None
    if be is None or cause is None:
        return None
    comma = replace(atoms[be], kind=AtomKind.COMMA, key=',')
    acts = replace(atoms[verb], form=VerbForm.THIRD)
    return [*atoms[:what], *cause, comma, atoms[who], acts, *atoms[verb + 1 : be]]


def _is_be(atom: Atom, prompt: str) -> bool:
    helps = atom.kind in (AtomKind.VERB, AtomKind.AUXILIARY, *LOOSE)
    return helps and text_of(atom, prompt) in ('is', 'was', 'will be', 'are')
