# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Speeds told by comparison: `the taxi is just as fast`, `drives at the same speed`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import LOOSE
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.measures import SPEED

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.STOP)
_MOVES = frozenset({'be', 'drive', 'move', 'come'})


def as_fast(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """`the taxi is just as fast`, `… drives at the same speed`: the speed told last, once more."""
    told = shipped_lexicon().turns['as_fast']
    written: list[Atom] = []
    speed: Atom | None = None
    i = 0
    while i < len(atoms):
        atom = atoms[i]
        speed = atom if atom.key == SPEED and atom.measure is not None else speed
        written.append(atom)
        i += 1
        moves = atom.kind is AtomKind.VERB and atom.key in _MOVES
        if not moves or speed is None:
            continue
        end = i
        while end < len(atoms) and atoms[end].kind not in _BREAKS:
            end += 1
        said = prompt[atoms[i].start : atoms[end - 1].end].lower() if end > i else ''
        if said in told and all(a.kind in (*LOOSE, *_SMALL) for a in atoms[i:end]):
            first, last = atoms[i].start, atoms[end - 1].end
            at = Atom(kind=AtomKind.PREPOSITION, key='at', start=first, end=last)
            written[-1] = replace(atom, key='drive')
            written += [at, replace(speed, start=first, end=last)]
            i = end
    return written


_SMALL = (AtomKind.SUBORDINATOR, AtomKind.PREPOSITION, AtomKind.THING, AtomKind.UNKNOWN)
