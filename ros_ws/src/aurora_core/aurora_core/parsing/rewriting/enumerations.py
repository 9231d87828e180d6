# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""One thing told twice: `two vehicles: a bus and a van`, `a taxi (the ego)`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import LOOSE
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner, NounKind

_GOVERNORS = (AtomKind.PREPOSITION, AtomKind.RELATION, AtomKind.COMPASS)
_NEW = (Determiner.INDEFINITE, Determiner.ONE, Determiner.BARE, Determiner.ANOTHER)
_LISTED = (NounKind.AGENT, NounKind.VEHICLE, NounKind.EGO)


def told_once(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms without sums of what is listed, and with one noun for the ego vehicle."""
    return _sums(_named_at_the_end(_names_of_ego(list(atoms))))


def _sums(atoms: list[Atom]) -> list[Atom]:
    """`there are two vehicles: a bus and a van`: there are a bus and a van."""
    told = list(atoms)
    for i in range(len(atoms) - 2):
        noun = atoms[i].noun
        link = atoms[i + 1]
        opens = link.key in (':', '(', ';', 'namely') or link.kind is AtomKind.COMMA
        if noun is None or noun.count < 2 or not opens:
            continue
        if noun.kind not in (NounKind.AGENT, NounKind.VEHICLE) or noun.states:
            continue
        if _adds_up(atoms, i, noun.count):
            told[i] = replace(atoms[i], kind=AtomKind.FILL, noun=None)
            told[i + 1] = replace(link, kind=AtomKind.FILL)
    return told


def _named_at_the_end(atoms: list[Atom]) -> list[Atom]:
    """`two vehicles wait there: a bus and a van`: a bus and a van wait there."""
    for i, atom in enumerate(atoms):
        noun = atom.noun
        if noun is None or noun.count < 2 or noun.kind is not NounKind.VEHICLE:
            continue
        colon = next((k for k in range(i + 1, len(atoms)) if atoms[k].kind is AtomKind.STOP), None)
        if colon is None or atoms[colon].key != ':' or colon == i + 1:
            continue
        end = colon + 1
        while end < len(atoms) and atoms[end].kind is not AtomKind.STOP:
            end += 1
        listed = atoms[colon + 1 : end]
        plain = all(a.noun is not None or a.kind in _JOINS for a in listed)
        if plain and _adds_up([atom, atoms[colon], *listed], 0, noun.count):
            joined = [_and(a) if a.kind is AtomKind.COMMA else a for a in listed]
            return [*atoms[:i], *joined, *atoms[i + 1 : colon], *atoms[end:]]
    return atoms


_JOINS = (AtomKind.COMMA, AtomKind.CONJUNCTION, *LOOSE)


def _and(comma: Atom) -> Atom:
    return replace(comma, kind=AtomKind.CONJUNCTION, key='and')


def _adds_up(atoms: Sequence[Atom], i: int, count: int) -> bool:
    """Return whether just as many are named behind the sum, each for the first time."""
    kind = atoms[i].noun
    found = 0
    governed = False
    for atom in atoms[i + 2 :]:
        noun = atom.noun
        if atom.kind in _GOVERNORS:
            governed = True
        elif noun is not None and not governed:
            fits = kind is not None and (kind.kind is NounKind.VEHICLE or noun.key == kind.key)
            ego = noun.kind is NounKind.EGO or noun.determiner is Determiner.MY
            walks = noun.key == 'pedestrian' and kind is not None and noun.key != kind.key
            if noun.kind not in _LISTED or not (fits or ego) or walks:
                return False
            if not ego and (noun.determiner not in _NEW or (noun.plural and not noun.count)):
                return False
            found += max(noun.count, 1)
            if found == count:
                return True
        elif noun is not None:
            governed = False
        elif atom.kind is AtomKind.VERB or (atom.kind is AtomKind.STOP and atom.key == '.'):
            return False
    return False


def _names_of_ego(atoms: list[Atom]) -> list[Atom]:
    """`a taxi (the ego)`, `the ego (a taxi)`, `a taxi, which is the ego, …`: one vehicle."""
    i = 0
    while i + 3 < len(atoms):
        j = i + 2
        apart = atoms[i + 1].kind is AtomKind.COMMA or atoms[i + 1].key in ('(', 'as')
        while j < len(atoms) and (
            atoms[j].kind in (AtomKind.RELATIVE, *LOOSE) or atoms[j].key == 'be'
        ):
            j += 1
        if apart and j + 1 < len(atoms) and _closes(atoms, j + 1):
            one = _ego_of_type(atoms[i], atoms[j]) or _ego_of_type(atoms[j], atoms[i])
            if one is not None:
                start, end = atoms[i].start, atoms[j].end
                assert one.noun is not None
                whole = replace(one.noun, start=start, end=end)
                atoms[i : j + 2] = [replace(one, start=start, end=end, noun=whole)]
        i += 1
    return atoms


def _closes(atoms: Sequence[Atom], i: int) -> bool:
    """In `the ego, a van, a taxi and a bus` the comma only goes on with the list."""
    behind = atoms[i + 1] if i + 1 < len(atoms) else None
    verbal = behind is not None and behind.kind in (AtomKind.VERB, AtomKind.AUXILIARY)
    return atoms[i].key == ')' or (atoms[i].key == ',' and verbal)


def _ego_of_type(ego: Atom, told: Atom) -> Atom | None:
    noun = told.noun
    own = ego.noun is not None and ego.key != 'i'
    mine = own and ego.noun is not None and ego.noun.determiner is Determiner.MY
    own = mine or (own and ego.noun is not None and ego.noun.kind is NounKind.EGO)
    if not own or noun is None or noun.kind is not NounKind.AGENT or noun.plural:
        return None
    if noun.key in ('pedestrian', 'rsu') or noun.count > 1 or noun.determiner not in _NEW:
        return None
    return replace(told, noun=replace(noun, determiner=Determiner.MY, count=0))
