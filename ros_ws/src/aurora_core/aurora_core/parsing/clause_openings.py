# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Atoms before they are cut: words that only look like openings, commas left out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.criteria.causes import is_flight
from aurora_core.parsing.measures import TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import MARKERS, TRANSPARENT, first_solid, has_verb

_MAYBE_PREPOSITION = ('after', 'before', 'until')
# Predicates that need nothing behind them.
ALONE = frozenset(
    {'brake', 'stop', 'start', 'slow', 'accelerate', 'change_lane', 'yield', 'appear', 'vanish'}
)
# What is over in a moment.
MOMENTARY = frozenset(
    {
        *('reach', 'stop', 'brake', 'see', 'lose', 'appear', 'vanish', 'receive', 'step_onto'),
        *('start', 'exceed', 'fall_below', 'land', 'finish', 'alert'),
    }
)


def plain_prepositions(atoms: list[Atom]) -> list[Atom]:
    """`after 10 s`, `before the junction`, `as a test`: no clause follows."""
    changed = list(atoms)
    for i, atom in enumerate(atoms):
        if atom.kind is AtomKind.AUXILIARY and atom.key == 'should' and _inverted(atoms, i):
            changed[i] = atom = replace(atom, kind=AtomKind.SUBORDINATOR, key='when')
        if atom.kind is AtomKind.PREPOSITION and atom.key == 'with' and i and _absolute(atoms, i):
            changed[i] = replace(atom, kind=AtomKind.CONJUNCTION)
        if atom.kind is not AtomKind.SUBORDINATOR:
            continue
        ahead = _until_marker(atoms, i + 1)
        first = first_solid(ahead)
        timed = first is not None and first.key == TIME and atom.key in _MAYBE_PREPOSITION
        if (has_verb(ahead) and not timed) or is_flight(ahead, atom.key):
            continue
        if atom.key in _MAYBE_PREPOSITION:
            changed[i] = replace(atom, kind=AtomKind.PREPOSITION)
        elif atom.key == 'while' and not any(a.is_actor for a in ahead):
            changed[i] = replace(atom, kind=AtomKind.FILL)
    return changed


def _inverted(atoms: Sequence[Atom], i: int) -> bool:
    """`should it slow below 3 m/s, …`: the auxiliary opens the clause."""
    opens = i == 0 or atoms[i - 1].kind in (AtomKind.COMMA, AtomKind.CONJUNCTION)
    ahead = next((a for a in atoms[i + 1 :] if a.kind is not AtomKind.FILL), None)
    named = ahead is not None and (ahead.is_actor or ahead.kind is AtomKind.THING)
    return opens and named


def _absolute(atoms: Sequence[Atom], i: int) -> bool:
    """`with two cars driving around`: a clause of its own."""
    solid = [a for a in atoms[i + 1 : i + 6] if a.kind not in TRANSPARENT]
    if len(solid) < 2 or not solid[0].is_actor:
        return False
    if solid[1].kind is AtomKind.VERB:
        return solid[1].form is VerbForm.ING
    beside = next((a for a in solid[1:3] if a.kind is AtomKind.RELATION), None)
    if beside is None:
        return False
    behind = solid[solid.index(beside) + 1 :]  # `with a truck beside it`
    if behind and behind[0].kind is AtomKind.CONJUNCTION:
        return True  # `with a bus in front and a van behind`
    return not behind or (behind[0].noun is not None and behind[0].noun.kind is NounKind.PRONOUN)


def _until_marker(atoms: Sequence[Atom], start: int) -> list[Atom]:
    ahead: list[Atom] = []
    for atom in atoms[start:]:
        if atom.kind in MARKERS and not (
            atom.kind is AtomKind.CONJUNCTION and not has_verb(ahead)
        ):
            break
        ahead.append(atom)
    return ahead
