# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""People told instead of what they drive or fly: `the suspect rides a motorcycle`, `our bird`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind, NounPhrase
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.pieces import TRANSPARENT


def drivers(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with vehicles and UAVs where such people are named."""
    return _at_the_wheel(_birds(list(atoms)), prompt)


def _birds(atoms: list[Atom]) -> list[Atom]:
    """`our bird is up, and the bird sees …`: whoever owns a bird flies a UAV."""
    birds = [i for i, a in enumerate(atoms) if a.noun is not None and a.noun.key == 'bird']
    nouns = [atoms[i].noun for i in birds]
    if not any(n is not None and n.determiner is Determiner.MY for n in nouns):
        return atoms
    for i, noun in zip(birds, nouns, strict=True):
        assert noun is not None
        flown = replace(noun, kind=NounKind.UAV, key='drone', determiner=Determiner.DEFINITE)
        atoms[i] = replace(atoms[i], key='drone', noun=flown)
    return atoms


def _at_the_wheel(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the suspect rides a motorcycle`, `a woman is driving a van`: the vehicle drives."""
    driven: dict[str, NounPhrase] = {}
    told: list[Atom] = []
    i = 0
    while i < len(atoms):
        person, vehicle = atoms[i], _vehicle_of(atoms, i, prompt)
        noun = person.noun
        if noun is not None and vehicle is not None:
            at = atoms[vehicle]
            assert at.noun is not None
            driven[noun.head_text] = at.noun
            verb = next((a for a in atoms[i:vehicle] if a.kind is AtomKind.VERB), None)
            told.append(replace(at, start=person.start))
            if verb is not None and verb.key != 'be':
                told.append(replace(verb, key='drive'))
            i = vehicle + 1
            continue
        known = driven.get(noun.head_text) if noun is not None else None
        if known is not None and noun is not None and noun.determiner is Determiner.DEFINITE:
            again = replace(
                known, start=noun.start, end=noun.end, determiner=Determiner.DEFINITE, count=0
            )
            person = replace(person, key=known.key, noun=again)
        told.append(person)
        i += 1
    return told


def _vehicle_of(atoms: Sequence[Atom], i: int, prompt: str) -> int | None:
    """Return where the vehicle stands that the person at i drives."""
    noun = atoms[i].noun
    person = noun is not None and (noun.kind is NounKind.UNKNOWN or noun.key == 'pedestrian')
    if not person or noun is None or noun.plural:
        return None
    k = i + 1
    words = shipped_lexicon().turns['rides']
    rides = False
    while k < len(atoms) and k < i + 5 and atoms[k].noun is None:
        rides = rides or text_of(atoms[k], prompt) in words or _is_on(atoms, k)
        if atoms[k].kind not in (*TRANSPARENT, AtomKind.VERB, AtomKind.PREPOSITION):
            return None
        k += 1
    if k >= len(atoms) or not rides:
        return None
    told = atoms[k].noun
    new = told is not None and told.determiner in (Determiner.INDEFINITE, Determiner.BARE)
    driven = told is not None and told.kind is NounKind.AGENT and told.key not in _NOT_DRIVEN
    return k if new and driven else None


def _is_on(atoms: Sequence[Atom], i: int) -> bool:
    """`the suspect is on a motorcycle`."""
    on = atoms[i].kind is AtomKind.PREPOSITION and atoms[i].key == 'on'
    return on and i + 1 < len(atoms) and atoms[i + 1].key in ('motorcycle', 'bicycle')


_NOT_DRIVEN = ('pedestrian', 'rsu')
