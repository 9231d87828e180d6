# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Conditions with words in them that nobody knows: `the distance, as logged, shall be …`.

Every word of a condition has its place; a word without one makes it unreadable. Unknown words and
asides that say no number are left out then, and admitted as not encoded.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import lru_cache

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.criteria.criterion import Criterion
from aurora_core.parsing.criteria.slots import criterion
from aurora_core.parsing.criteria.words import criteria_words
from aurora_core.spec.parameter import Span

_MOST_UNKNOWN = 4
_MOST_ASIDE = 8
# An aside of these and of unknown words asks for nothing: `as logged by the tracker`.
_SAYS_NOTHING = (
    *(AtomKind.COMMA, AtomKind.FILL, AtomKind.FRAME, AtomKind.PREPOSITION),
    *(AtomKind.SUBORDINATOR, AtomKind.AUXILIARY),
)


def loosely(atoms: Sequence[Atom]) -> Criterion | None:
    """Return the condition that a clause states but for words that nobody knows."""
    unknown = [a for a in atoms if _is_unknown(a)]
    if not unknown or len(unknown) > _MOST_UNKNOWN or any(_changes_meaning(a) for a in unknown):
        return None
    return _left(atoms, unknown) or without_aside(atoms, unknown)


def without_aside(atoms: Sequence[Atom], unknown: Sequence[Atom] = ()) -> Criterion | None:
    """Return the condition that is left without one aside, and without the unknown words."""
    for aside in _asides(atoms):
        found = _left(atoms, [*(a for a in unknown if a not in aside), *aside])
        if found is not None:
            return found
    return None


def _left(atoms: Sequence[Atom], left_out: Sequence[Atom]) -> Criterion | None:
    found = criterion([a for a in atoms if a not in left_out])
    if found is None or not found.topics or not (found.limits or found.share or found.hold):
        return None
    said = [a for a in left_out if a.kind not in _SAYS_NOTHING]
    return replace(found, unread=tuple(Span(start=a.start, end=a.end) for a in said))


def _is_unknown(atom: Atom) -> bool:
    noun = atom.noun is not None and atom.noun.kind is NounKind.UNKNOWN
    return (noun or atom.kind is AtomKind.UNKNOWN) and not _is_word(atom.words)


def _names(atom: Atom) -> bool:
    pronoun = atom.noun is not None and atom.noun.kind is NounKind.PRONOUN
    return atom.is_actor and not pronoun


def _changes_meaning(atom: Atom) -> bool:
    words = criteria_words()
    measured = any(
        one.search(atom.words) for one in (words['names_measured'], words.topics['drift'])
    )
    return measured or words['particular'].search(atom.words) is not None


@lru_cache(maxsize=1024)
def _is_word(text: str) -> bool:
    """Return whether a word stands in one of the lists."""
    words = criteria_words()
    lists = (*words.lists.values(), *words.topics.values(), *words.events.values())
    return any(one.fullmatch(text) for one in lists)


def _asides(atoms: Sequence[Atom]) -> Iterator[tuple[Atom, ...]]:
    """`…, as measured by the tracker, …`: between two commas, without a number or an actor."""
    commas = [i for i, a in enumerate(atoms) if a.kind is AtomKind.COMMA]
    for k, begin in enumerate(commas):
        for end in commas[k + 1 :]:
            inside = atoms[begin : end + 1]
            plain = all(
                a.measure is None and not _names(a) and a.kind is not AtomKind.NEGATION
                for a in inside
            )
            if plain and len(inside) <= _MOST_ASIDE and begin:
                yield tuple(inside)
