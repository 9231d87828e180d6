# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Fronted particles: `off it goes`, `away drives the van`."""

from __future__ import annotations

from dataclasses import replace

from aurora_core.parsing.atom_runs import text_of
from aurora_core.parsing.atoms import Atom, AtomKind

_JOINTS = (AtomKind.COMMA, AtomKind.CONJUNCTION, AtomKind.THEN)
_ENDS = (AtomKind.STOP, *_JOINTS)
_AWAY = ('off', 'away')


def particles(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`off it goes`, `away drives the van`: it sets off."""
    for i in range(len(atoms) - 2):
        opens = i == 0 or atoms[i - 1].kind in _ENDS
        if not opens or text_of(atoms[i], prompt) not in _AWAY:
            continue
        one, other = atoms[i + 1], atoms[i + 2]
        who, verb = (one, other) if one.is_actor else (other, one)
        if who.is_actor and verb.kind is AtomKind.VERB and verb.key == 'drive':
            gone = replace(verb, key='start')
            atoms[i : i + 3] = [replace(atoms[i], kind=AtomKind.FILL, noun=None), who, gone]
    return atoms
