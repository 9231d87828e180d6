# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Places on the way: `rides along the main road`, `steps off the kerb and crosses`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind


def ways(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with those who are on a way as being on it."""
    written: list[Atom] = []
    for i, atom in enumerate(atoms):
        place = i + 1 < len(atoms) and atoms[i + 1].is_place
        if place and _goes_along(atom, prompt):
            cut = prompt.rindex(' ', atom.start, atom.end)
            on = Atom(kind=AtomKind.PREPOSITION, key='on', start=cut + 1, end=atom.end)
            written += [replace(atom, end=cut), on]
        elif place and _is_stepping_off(written, atom):
            written[-1] = replace(written[-1], key='be')
            written.append(replace(atom, kind=AtomKind.PREPOSITION, key='on'))
        else:
            written.append(atom)
    return written


def _goes_along(atom: Atom, prompt: str) -> bool:
    """`rides along the main road`: the last word of the verb governs the place."""
    last = text_of(atom, prompt).rpartition(' ')
    return atom.kind is AtomKind.VERB and atom.key == 'drive' and last[2] in ('along', 'down')


def _is_stepping_off(written: Sequence[Atom], off: Atom) -> bool:
    """`steps off the kerb and crosses`: where somebody stands who crosses."""
    before = written[-1] if written else None
    steps = before is not None and before.kind is AtomKind.VERB and before.key == 'come'
    return steps and off.words == 'off'
