# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who acts: the nouns in front of a predicate that nothing governs."""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase

_SILENT = (AtomKind.FILL, AtomKind.AUXILIARY, AtomKind.CONJUNCTION, AtomKind.FRAME)
_GOVERNORS = (AtomKind.PREPOSITION, AtomKind.RELATION, AtomKind.COMPASS)
# Relations that take no noun of their own end so: `30 m ahead a van is parked`.
_LAST = frozenset(
    {'ahead', 'front', 'rear', 'back', 'left', 'right', 'side', 'lane', 'direction', 'carriageway'}
    | {'way', 'road', 'street', 'nearby'}
)
_WHOLE = frozenset({'further behind', 'farther behind', 'from behind'})


def is_complete(words: str) -> bool:
    """Return whether a relation needs no noun: `to the left`, `in the opposite direction`."""
    return words in _WHOLE or words.rpartition(' ')[2] in _LAST


def split_subject(
    before: Sequence[Atom], prompt: str
) -> tuple[tuple[NounPhrase, ...], list[Atom]]:
    """Take the nouns in front of the predicate that no preposition governs."""
    subjects: list[NounPhrase] = []
    rest: list[Atom] = []
    waiting = False  # a preposition waits for its noun
    governed = False  # the last noun belongs to a preposition
    conjunction = False
    told = [a for a in before if a.kind not in _SILENT]
    existential = told[-1] if told and told[-1].key == 'there' else None
    for i, atom in enumerate(before):
        if atom.kind is AtomKind.RELATIVE and not subjects:
            subjects, rest = _before_relative(rest)
            waiting = governed = conjunction = False
            continue
        if atom.kind is AtomKind.CAUSATIVE:  # `the mayor wants a drone to …`: who wants is nobody
            subjects = [s for s in subjects if s.kind is not NounKind.UNKNOWN]
        if atom.noun is not None and atom is existential:
            subjects.append(atom.noun)
            continue
        if atom.kind in _GOVERNORS:
            waiting, governed = not _stands_alone(before, i, prompt), False
        elif atom.noun is not None:
            shared = conjunction and governed  # `between the van and the ego`
            actor = atom.is_actor or atom.noun.kind is NounKind.UNKNOWN
            if actor and not waiting and not shared:
                subjects.append(atom.noun)
                governed = conjunction = False
                continue
            waiting, governed = False, True
        elif atom.kind not in _SILENT:
            waiting = False
        conjunction = atom.kind is AtomKind.CONJUNCTION
        rest.append(atom)
    return tuple(subjects), rest


def _before_relative(rest: list[Atom]) -> tuple[list[NounPhrase], list[Atom]]:
    """`footage of an ambulance that …`: the noun in front of `that` acts, whatever governs it."""
    for i in range(len(rest) - 1, -1, -1):
        atom = rest[i]
        if atom.is_actor and atom.noun is not None:
            keep = rest[: i - 1] if i and rest[i - 1].kind in _GOVERNORS else rest[:i]
            return [atom.noun], keep + rest[i + 1 :]
    return [], rest


def _stands_alone(before: Sequence[Atom], i: int, prompt: str) -> bool:
    """`to the rear there is`, `ahead a police car is`: who is new cannot be what it relates to."""
    word = before[i]
    if not is_complete(text_of(word, prompt)):
        return False
    noun = next((a.noun for a in before[i + 1 :] if a.kind not in _SILENT), None)
    new = (Determiner.INDEFINITE, Determiner.ONE)
    return noun is not None and (noun.determiner in new or noun.count > 0 or noun.key == 'there')
