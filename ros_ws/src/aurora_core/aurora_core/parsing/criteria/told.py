# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A clause as one line of words in which actors, places and numbers are written as letters.

`N0 must never exceed L1`: N an actor or place, L a length, T a time, V a speed, P a share, C a
count. What a number's qualifier says stands in front of it: `atleast`, `atmost`, `nolater`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind, NounPhrase
from aurora_core.parsing.measure import UNBROKEN
from aurora_core.parsing.measures import COUNT, LENGTH, RATIO, SPEED, TIME, Measure
from aurora_core.parsing.morphology import VerbForm
from aurora_core.spec.parameter import Bound

_LETTERS = {LENGTH: 'L', TIME: 'T', SPEED: 'V', RATIO: 'P', COUNT: 'C'}
_NAMES = frozenset(
    {
        NounKind.AGENT,
        NounKind.VEHICLE,
        NounKind.UAV,
        NounKind.EGO,
        NounKind.PRONOUN,
        NounKind.PLACE,
        NounKind.LANDMARK,
    }
)
_LATE = ('late', 'soon')
# What a qualifier says of the quantity: `no nearer than 15 m` is about a distance.
_SAYS = {
    r'\b(?:near|clos|far)': 'apart',
    r'\b(?:low|high)': 'altitude',
}


@dataclass(frozen=True, slots=True, kw_only=True)
class Told:
    """The line, what its letters stand for, and whether it is without a verb."""

    text: str
    nouns: dict[str, NounPhrase]
    measures: dict[str, Measure]
    plain: bool = False


def told(atoms: Sequence[Atom]) -> Told:
    """Write atoms as a line."""
    words: list[str] = []
    nouns: dict[str, NounPhrase] = {}
    measures: dict[str, Measure] = {}
    for i, atom in enumerate(atoms):
        if atom.kind is AtomKind.COMMA:
            words.append(',')
        elif atom.noun is not None and _is_name(atom, atoms, i):
            name = f'N{len(nouns)}'
            nouns[name] = atom.noun
            words += [*_members(atom), name]
        elif _describes(atoms, i) or _is_repeated(atom, measures):
            continue  # `the tracked bus`, `two minutes (120 s)`
        elif atom.measure is not None and atom.measure.dimension in _LETTERS:
            if atom.measure.dimension == COUNT and atom.words == 'two':
                words.append('two')
                continue
            name = f'{_LETTERS[atom.measure.dimension]}{len(measures)}'
            measures[name] = atom.measure
            words += [*_qualifier(atom), name]
            words += ['consecutive'] if UNBROKEN & set(atom.words.split()) else []
        elif atom.kind is AtomKind.FRAME and atom.key == 'demand':
            words += ['required'] if words[-1:] != ['required'] else []
        elif atom.kind is AtomKind.PREPOSITION and atom.key == 'at':
            words.append('at')  # `at its top speed of` is how fast, not a limit
        else:
            words.append(atom.words)
    text = ' '.join(words).replace('( )', '')
    plain = not any(a.kind in (AtomKind.VERB, AtomKind.SUBORDINATOR) for a in atoms)
    return Told(text=f' {" ".join(text.split())} ', nouns=nouns, measures=measures, plain=plain)


def _is_name(atom: Atom, atoms: Sequence[Atom], i: int) -> bool:
    assert atom.noun is not None
    if atom.noun.kind not in _NAMES or atom.noun.key in ('there', 'one'):
        return False
    # `the crossing should not begin before 20 s`: what happens, not where
    governed = i > 0 and atoms[i - 1].kind in (AtomKind.PREPOSITION, AtomKind.RELATION)
    return governed or atom.noun.head_text != 'crossing'


def _describes(atoms: Sequence[Atom], i: int) -> bool:
    """`from the tracked bus`: which one, not what is done."""
    told = atoms[i].kind is AtomKind.VERB and atoms[i].key in ('track', 'follow', 'observe')
    which = told and atoms[i].form is VerbForm.PAST and i > 0 and atoms[i - 1].words == 'the'
    return which and i + 1 < len(atoms) and atoms[i + 1].is_actor


def _is_repeated(atom: Atom, before: dict[str, Measure]) -> bool:
    if atom.kind is AtomKind.FILL and any(c.isdigit() for c in atom.words):
        return True  # found out by the rewriting
    measure = atom.measure
    last = list(before.values())[-1:]
    return measure is not None and any(
        m.dimension == measure.dimension
        and m.value == measure.value
        and m.bound is measure.bound
        and m.upper is None
        and 0 <= atom.start - m.end <= 2
        for m in last
    )


def _members(atom: Atom) -> list[str]:
    """`each drone`, `any other`: the words in front of the noun that count."""
    words = atom.words.split()
    if atom.noun is not None and atom.noun.kind is NounKind.PRONOUN:
        return words if atom.noun.key in ('it', 'they') else []
    return [w for w in words if w in ('each', 'every', 'any', 'no', 'other')][:1]


def _qualifier(atom: Atom) -> list[str]:
    assert atom.measure is not None
    said = [meant for words, meant in _SAYS.items() if re.search(words, atom.words)][:1]
    if atom.measure.bound is Bound.AT_LEAST:
        return [*said, 'atleast']
    if atom.measure.bound is Bound.AT_MOST:
        late = any(word in atom.words for word in _LATE)
        return [*said, 'nolater' if late else 'atmost']
    return []
