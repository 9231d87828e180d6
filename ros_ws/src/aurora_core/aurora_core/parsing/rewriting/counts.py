# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Numbers of actors told behind their nouns, or twice.

`the number of cars is four`, `cars, four in number`, `a couple of cars, two of them`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, Determiner
from aurora_core.parsing.measures import COUNT

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)


def counted(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the number of cars is four`, `cars, four in number`, `cars: 4`: four cars."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        atom = atoms[i]
        noun = atom.noun
        plain = noun is not None and atom.is_actor and noun.plural and not noun.count
        value = _count_behind(atoms, i, prompt) if plain else None
        if noun is None or value is None:
            written.append(atom)
            i += 1
            continue
        at, stop = value
        measure = atoms[at].measure
        assert measure is not None
        counted = replace(noun, count=int(measure.value), determiner=Determiner.BARE)
        if len(written) > 1 and written[-1].key == 'of':
            del written[-2:]
            if written and written[-1].kind is AtomKind.FILL:
                written.pop()
        written.append(replace(atom, noun=counted))
        i = stop
    return written


def _count_behind(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[int, int] | None:
    """Return where the number of a noun stands behind it, and what follows."""
    number = i > 1 and text_of(atoms[i - 2], prompt).rpartition(' ')[2] in ('number', 'count')
    k = i + 1
    while k < len(atoms) and (
        atoms[k].kind in (*HELPERS, AtomKind.COMMA)
        or (atoms[k].key in ('be', ':') and (number or atoms[k].key == ':'))
    ):
        k += 1
    if k >= len(atoms) or k == i + 1:
        return None
    measure = atoms[k].measure
    whole = measure is not None and measure.dimension == COUNT and measure.value >= 1
    if not whole or measure is None or measure.value != int(measure.value):
        return None
    told = prompt[atoms[k].end :].lower().split()[:2]
    listed = [w.strip('.,;:') for w in told] == ['in', 'number']
    colon = any(a.key == ':' for a in atoms[i + 1 : k])
    ends = k + 1 == len(atoms) or atoms[k + 1].kind in (AtomKind.STOP, *_BREAKS)
    if listed:
        stop = k + 1
        limit = prompt.lower().index('number', atoms[k].end) + len('number')
        while stop < len(atoms) and atoms[stop].end <= limit:
            stop += 1
        if stop < len(atoms) and atoms[stop].kind is AtomKind.COMMA:
            stop += 1
        return k, stop
    return (k, k + 1) if (number or colon) and ends else None


def said_twice(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a couple of cars, two of them, …`: the number once more."""
    changed = list(atoms)
    for i in range(1, len(changed) - 2):
        measure = changed[i].measure
        them = text_of(changed[i + 2], prompt) in ('them', 'these', 'those')
        if measure is None or measure.dimension != COUNT or changed[i + 1].key != 'of' or not them:
            continue
        counted = next((a.noun for a in reversed(changed[:i]) if a.noun is not None), None)
        if counted is not None and counted.count == measure.value:
            for k in range(i, i + 3):
                changed[k] = replace(changed[k], kind=AtomKind.FILL, noun=None, measure=None)
    return changed
