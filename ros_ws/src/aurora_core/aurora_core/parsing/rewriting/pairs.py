# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Two of them in few words: `distance ego - truck`, `one at 20 m other at 40 m`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind

_APART = ('standoff', 'gap', 'separation', 'radio_range')
_DASHES = ('-', '–', '/', '<->', '↔')


def pairs(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with `and` between the two, and with `the other` as a pronoun."""
    told = list(atoms)
    one = False
    i = 0
    while i < len(told):
        atom = told[i]
        if atom.kind is AtomKind.STOP:
            one = one and not _ends(atom)
        one = one or (atom.noun is not None and atom.key == 'one')
        one = one or (atom.kind is AtomKind.MEASURE and atom.words == 'one')
        if atom.kind is AtomKind.THING and atom.key in _APART:
            _join(told, i, prompt)
        i += 1
    return told


def _ends(stop: Atom) -> bool:
    return stop.key not in (';', ':')


def _join(told: list[Atom], i: int, prompt: str) -> None:
    """`distance bus - truck`: of the bus and the truck."""
    first = skip(told, i + 1, (AtomKind.FILL, AtomKind.PREPOSITION))
    if first + 2 >= len(told) or not (told[first].is_actor and told[first + 2].is_actor):
        return
    dash = told[first + 1]
    if text_of(dash, prompt) in _DASHES:
        told[first + 1] = replace(dash, kind=AtomKind.CONJUNCTION, key='and')
