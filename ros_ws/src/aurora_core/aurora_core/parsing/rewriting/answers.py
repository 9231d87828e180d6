# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Sentences that say with nouns what somebody does because of what.

`the bus reacts to the drone's warning by braking`, `the landing of the drone is the signal for the
bus to start`: written out as `in response to …, the bus brakes`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, by_sentence, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm

_MEANS = ('by', 'with', 'using')
_IS = ('is', 'was', 'will be', 'shall be', 'serves as', 'acts as')


def answers(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms of such sentences with the cause in front of the effect."""
    return by_sentence(
        atoms,
        lambda told: _reacts(told, prompt) or _signal(told, prompt) or _cleft(told, prompt),
    )


def _cleft(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`it is the warning that makes the bus brake`: the warning makes it brake."""
    first = skip(atoms, 0)
    if first + 2 >= len(atoms) or text_of(atoms[first], prompt) != 'it':
        return atoms
    that = next((k for k, a in enumerate(atoms) if a.kind is AtomKind.RELATIVE), None)
    if that is None or that + 1 >= len(atoms) or not _is(atoms[first + 1], prompt):
        return atoms
    makes = atoms[that + 1]
    if AtomKind.CAUSING not in (makes.kind, *makes.other_kinds):
        return atoms
    return [*atoms[:first], *atoms[first + 2 : that], *atoms[that + 1 :]]


def _reacts(atoms: list[Atom], prompt: str) -> list[Atom] | None:
    """`the bus reacts to the warning by braking`, `it responds by stopping`."""
    words = shipped_lexicon().turns['reacts']
    for i in range(1, len(atoms)):
        if text_of(atoms[i], prompt) not in words:
            continue
        who = i - 1
        while who and atoms[who].kind in HELPERS:
            who -= 1
        k = skip(atoms, i + 1)
        means = _means(atoms, k)
        if not atoms[who].is_actor or means is None:
            continue
        by, verb = means
        acts = replace(atoms[verb], kind=AtomKind.VERB, form=VerbForm.THIRD, noun=None)
        told = [atoms[who], acts, *atoms[verb + 1 :]]
        if by == k:  # `it reacts by braking`: to what was told before
            return [*atoms[:who], replace(atoms[i], kind=AtomKind.THEN, key='then'), *told]
        if text_of(atoms[k], prompt) != 'to':
            continue
        return [*atoms[:who], *_because(atoms[i], atoms[k + 1 : by]), *told]
    return None


def _means(atoms: Sequence[Atom], i: int) -> tuple[int, int] | None:
    """Return where `by braking`, `with a full stop` stands, and its verb."""
    for by in range(i, len(atoms)):
        if atoms[by].kind is not AtomKind.PREPOSITION or atoms[by].key not in _MEANS:
            continue
        verb = skip(atoms, by + 1)
        if verb >= len(atoms):
            return None
        gerund = atoms[verb].kind is AtomKind.VERB and atoms[verb].form is VerbForm.ING
        if gerund or atoms[verb].kind is AtomKind.HAPPENING:
            return by, verb
    return None


def _signal(atoms: list[Atom], prompt: str) -> list[Atom] | None:
    """`the bus's arrival is the cue for the drone to land`, in either order."""
    for i, atom in enumerate(atoms):
        if text_of(atom, prompt).removeprefix('the ') not in shipped_lexicon().turns['signals']:
            continue
        task = _task(atoms, skip(atoms, i + 1))
        if task is None:
            continue
        who, verb = task
        acts = [atoms[who], replace(atoms[verb], form=VerbForm.THIRD)]
        before = i
        while before and atoms[before - 1].kind in HELPERS and not _is(atoms[before - 1], prompt):
            before -= 1
        if before > 1 and _is(atoms[before - 1], prompt):
            cause, rest = atoms[: before - 1], atoms[verb + 1 :]
            return [*_because(atoms[before - 1], cause), *acts, *rest]
        be = next((k for k in range(verb + 1, len(atoms)) if _is(atoms[k], prompt)), None)
        if be is not None and not before and be + 1 < len(atoms):
            return [*_because(atoms[be], atoms[be + 1 :]), *acts, *atoms[verb + 1 : be]]
    return None


def _task(atoms: Sequence[Atom], i: int) -> tuple[int, int] | None:
    """Return who `for the bus to start` names, and what he does."""
    who = skip(atoms, i + 1)
    if who >= len(atoms) or atoms[i].key != 'for' or not atoms[who].is_actor:
        return None
    verb = skip(atoms, who + 1, (*HELPERS, AtomKind.PREPOSITION))
    told = verb < len(atoms) and atoms[verb].kind is AtomKind.VERB
    return (who, verb) if told and atoms[verb].form is VerbForm.BASE else None


def _is(atom: Atom, prompt: str) -> bool:
    return text_of(atom, prompt) in _IS


def _because(at: Atom, cause: Sequence[Atom]) -> list[Atom]:
    because = replace(at, kind=AtomKind.BECAUSE, key='in response to', other_kinds=frozenset())
    return [because, *cause, replace(at, kind=AtomKind.COMMA, key=',')]
