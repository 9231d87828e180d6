# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""A verb said once for two: `one drone hovers at 30 m, the other at 50 m`."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.pieces import Link, Piece, first_solid, has_verb

_SHARED = frozenset(
    {
        'hover',
        'track',
        'follow',
        'observe',
        'orbit',
        'navigate',
        'fly',
        'trace',
        'ascend',
        'visit',
        'wait',
    }
)
_ONE_OF = ('one', 'other', 'another')


def opens_gap(current: Sequence[Atom], ahead: Sequence[Atom]) -> bool:
    """Return whether another UAV begins a clause that leaves its verb out."""
    first, second = first_solid(current), first_solid(ahead)
    if first is None or second is None or has_verb(ahead) or not _shared(current):
        return False
    told = [a for a in ahead if a.measure is not None or a.is_place or a.is_actor]
    return _is_flyer(first) and _is_flyer(second) and len(told) > 1


def fill_gaps(pieces: Sequence[Piece]) -> list[Piece]:
    """Give a clause of another UAV the verb of the clause before it."""
    filled: list[Piece] = []
    for piece in pieces:
        before = filled[-1] if filled else None
        if before is not None and piece.link is Link.MAIN:
            verb = _shared(before.atoms)
            if verb is not None and opens_gap(before.atoms, piece.atoms):
                piece = _with(piece, verb)
        filled.append(piece)
    return filled


def _with(piece: Piece, verb: Atom) -> Piece:
    """Put a verb that takes no characters behind the subject."""
    at = next(i for i, a in enumerate(piece.atoms) if a.is_actor)
    end = piece.atoms[at].end
    said = replace(verb, start=end, end=end)
    return replace(piece, atoms=(*piece.atoms[: at + 1], said, *piece.atoms[at + 1 :]))


def _shared(atoms: Sequence[Atom]) -> Atom | None:
    verb = next((a for a in atoms if a.kind is AtomKind.VERB), None)
    return verb if verb is not None and verb.key in _SHARED else None


def _is_flyer(atom: Atom) -> bool:
    noun = atom.noun
    if noun is None or noun.plural or noun.count > 1:
        return False
    if noun.kind is NounKind.PRONOUN:
        return noun.key in _ONE_OF or noun.key.startswith('nth')
    return noun.kind is NounKind.UAV
