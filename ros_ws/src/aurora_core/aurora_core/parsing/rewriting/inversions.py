# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Word order of statements: `there comes a bus`, `only then does the car start`, `altitude: 30 m`.

Also what only says that a condition follows: `the run is successful if …`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.measures import COUNT, LENGTH, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.pieces import TRANSPARENT
from aurora_core.parsing.rewriting.nominal import act_nouns
from aurora_core.parsing.told_pieces import FLOWN

_STANDS = frozenset({'wait', 'be', 'hover', 'exist'})
_MOVES = frozenset({'come', 'drive', 'approach', 'walk', 'follow', 'cross'})
_DO = frozenset({'do', 'does', 'did'})
_BEHIND_DO = 6
# Between a colon and its number: `separation: never below 20 m`.
_BEFORE_VALUE = (AtomKind.FILL, AtomKind.NEGATION, AtomKind.PREPOSITION, AtomKind.UNKNOWN)


def straighten(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms of statements in the order subject, predicate."""
    told = _sides(_phases(_named(_applied(list(atoms), prompt))))
    return _presented(_asked(told, prompt), prompt)


def _named(atoms: list[Atom]) -> list[Atom]:
    """`altitude: 35 m`: a colon between a name and its number ends nothing."""
    changed = list(atoms)
    begin = 0
    for i in range(1, len(changed) - 1):
        begin = i if changed[i - 1].kind is AtomKind.STOP else begin
        named = changed[i - 1].kind is AtomKind.THING or _is_heading(changed[begin:i])
        value = skip(changed, i + 1, _BEFORE_VALUE)
        named = named and value < min(len(changed), i + 4) and changed[value].measure is not None
        if changed[i].kind is AtomKind.STOP and changed[i].key == ':' and named:
            changed[i] = replace(changed[i], kind=AtomKind.FILL)
    return changed


def _applied(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`the brakes are applied by the truck`: the truck brakes."""
    changed = list(atoms)
    for i in range(1, len(atoms) - 2):
        if text_of(atoms[i], prompt) != 'brakes' or text_of(atoms[i - 1], prompt) != 'the':
            continue
        by = next((k for k in range(i + 1, min(i + 5, len(atoms))) if atoms[k].key == 'by'), None)
        if by is None or by + 1 >= len(atoms) or not atoms[by + 1].is_actor:
            continue
        if not _is_be(atoms[i + 1], prompt):
            continue
        for k in range(i - 1, by + 1):
            changed[k] = replace(atoms[k], kind=AtomKind.FILL, noun=None)
        brake = replace(atoms[i], kind=AtomKind.VERB, key='brake', form=VerbForm.THIRD, noun=None)
        changed[by], changed[by + 1] = atoms[by + 1], brake
    return changed


def _is_be(atom: Atom, prompt: str) -> bool:
    return text_of(atom, prompt) in ('is', 'are', 'being', 'get', 'be')


def _is_heading(atoms: Sequence[Atom]) -> bool:
    """`Least spacing between any two drones: 8 m`, `Visibility of the bus: 70 %`."""
    names = (AtomKind.THING, AtomKind.WORLD_NOUN, AtomKind.IN_VIEW, AtomKind.MESSAGE)
    verbless = not any(a.kind in (AtomKind.VERB, AtomKind.MEASURE) for a in atoms)
    return verbless and any(a.kind in names for a in atoms)


def _asked(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`only then does the car start`: `does` says nothing before who acts."""
    kept: list[Atom] = []
    for i, atom in enumerate(atoms):
        does = text_of(atom, prompt) in _DO
        if does and i + 1 < len(atoms) and atoms[i + 1].is_actor:
            behind = atoms[i + 2 : i + 2 + _BEHIND_DO]
            acts = any(a.kind is AtomKind.VERB and a.form is VerbForm.BASE for a in behind)
            if acts or any(a.kind is AtomKind.AUXILIARY for a in behind):
                continue
        kept.append(atom)
    return kept


def _presented(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`behind us there comes a bus`, `at the junction there stands a roadside unit`."""
    changed = list(atoms)
    for i in range(len(changed) - 2):
        there, verb, new = changed[i : i + 3]
        is_there = text_of(there, prompt) == 'there'
        if not is_there or verb.kind is not AtomKind.VERB or new.noun is None:
            continue
        if not new.is_actor or verb.key == 'exist' or verb.form is VerbForm.ING:
            continue
        equipment = new.noun.kind is NounKind.AGENT and new.noun.key == 'rsu'
        if verb.key in _MOVES:
            key = 'drive' if verb.key in ('come', 'approach') else verb.key
        elif verb.key in _STANDS:
            key = 'be' if equipment or verb.key == 'exist' else verb.key
        else:
            continue
        changed[i] = replace(there, kind=AtomKind.FILL, noun=None)
        if verb.key == 'be':
            continue
        changed[i + 1], changed[i + 2] = new, replace(verb, key=key)
    return changed


def _phases(atoms: list[Atom]) -> list[Atom]:
    """`the hover phase should last 2 min`: `for 2 min`, of the phase that was told."""
    written: list[Atom] = []
    for atom in atoms:
        written.append(atom)
        if atom.key != TIME or atom.measure is None:
            continue
        k = len(written) - 2
        if k < 0 or written[k].kind is not AtomKind.VERB or written[k].key != 'last':
            continue
        last = written[k]
        while k and written[k - 1].kind in (*TRANSPARENT, AtomKind.ROUTE):
            k -= 1
        flown = k and _is_flown(written[k - 1])
        opens = k < 2 or written[k - 2].kind in (AtomKind.FILL, AtomKind.STOP, AtomKind.COMMA)
        if flown and opens:
            word = Atom(
                kind=AtomKind.PREPOSITION, key='for', start=written[k - 1].start, end=last.end
            )
            written[k - 1 :] = [word, atom]
    return written


def _is_flown(atom: Atom) -> bool:
    """`the hover`, `the pursuit`: a phase, as a noun."""
    if atom.kind is AtomKind.VERB:
        return atom.key in FLOWN
    unknown = atom.noun is not None and atom.noun.kind is NounKind.UNKNOWN
    return unknown and act_nouns().get(atom.noun.head_text if atom.noun else '') in FLOWN


def _size(sides: Sequence[Atom]) -> tuple[Atom | None, int]:
    """Return the one size of `120 m and 80 m`, `80 m`, and how many atoms tell it."""
    one = sides[0].measure if sides else None
    if one is None or one.second is not None or sides[0].key not in (LENGTH, COUNT):
        return None, 0
    other = sides[2].measure if len(sides) == 3 else None
    joined = len(sides) == 3 and sides[1].kind is AtomKind.CONJUNCTION
    if other is not None and joined and sides[2].key == LENGTH:
        second, last, count = other, sides[2], 3
    elif sides[0].key == LENGTH:
        second, last, count = one, sides[0], 1  # those of a square
    else:
        return None, 0
    size = replace(
        one,
        dimension=LENGTH,
        end=second.end,
        second=second.value,
        second_start=second.start,
    )
    return replace(sides[0], key=LENGTH, end=last.end, measure=size), count


def _sides(atoms: list[Atom]) -> list[Atom]:
    """`whose sides are 120 m and 80 m long`, `a square with sides of 80 m`: its size."""
    changed = list(atoms)
    i = 0
    while i < len(changed):
        if changed[i].kind is AtomKind.THING and changed[i].key == 'sides':
            k = i + 1
            while k < len(changed) and (
                changed[k].kind in (*TRANSPARENT, AtomKind.PREPOSITION) or changed[k].key == 'be'
            ):
                k += 1
            size, stop = _size(changed[k : k + 3])
            if size is not None:
                stop += k
                if stop < len(changed) and changed[stop].key == 'length':
                    stop += 1
                changed[i:stop] = [size]
        i += 1
    return changed
