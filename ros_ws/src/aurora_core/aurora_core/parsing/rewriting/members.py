# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Who is named together with others or before what is said of him.

`one of our three drones`, `of the two, one …`, `the van has a drone above it`, `the second drone:
it hovers`.
"""

from __future__ import annotations

from collections.abc import Sequence

from aurora_core.parsing.atom_runs import LOOSE, skip
from aurora_core.parsing.atoms import Atom, AtomKind


def members(atoms: Sequence[Atom]) -> list[Atom]:
    """Return the atoms with every group named before its members, which are one each."""
    return _named_first(list(atoms))


def _named_first(atoms: list[Atom]) -> list[Atom]:
    """`the second drone: it hovers`, `what is left is the third, and it hovers`: one actor."""
    written: list[Atom] = []
    alone: Atom | None = None  # the only thing that the sentence has told yet
    told = 0  # how many atoms there are up to it
    for i, atom in enumerate(atoms):
        written.append(atom)
        behind = skip(atoms, i + 1)
        acts = behind < len(atoms) and atoms[behind].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
        if alone is not None and atom.key in ('it', 'they') and atom.is_actor and acts:
            del written[told:]
        if atom.kind is AtomKind.STOP and atom.key != ':':
            alone = None
        elif atom.is_actor and not any(a.kind is not AtomKind.FRAME for a in _sentence(written)):
            alone, told = atom, len(written)
        elif atom.kind not in _JOINS and atom is not alone:
            alone = None
    return written


_JOINS = (*LOOSE, AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION)


def _sentence(atoms: Sequence[Atom]) -> list[Atom]:
    """Return what the last sentence tells in front of its last atom."""
    begin = len(atoms) - 1
    while begin and atoms[begin - 1].kind is not AtomKind.STOP:
        begin -= 1
    return [a for a in atoms[begin:-1] if a.kind is not AtomKind.FILL]
