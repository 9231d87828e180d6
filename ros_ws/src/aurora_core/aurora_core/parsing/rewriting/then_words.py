# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Words of sequence and of the way, moved to the front of the clause that they open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.atom_runs import HELPERS, skip, text_of
from aurora_core.parsing.atoms import Atom, AtomKind
from aurora_core.parsing.clause_openings import ALONE, MOMENTARY
from aurora_core.parsing.lexicon import shipped_lexicon
from aurora_core.parsing.morphology import VerbForm


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


_BREAKS = (AtomKind.COMMA, AtomKind.STOP, AtomKind.THEN, AtomKind.CONJUNCTION)
_OPENS_CLAUSE = (*_BREAKS, AtomKind.SUBORDINATOR, AtomKind.FRAME, AtomKind.RELATIVE)
_REACTING = ('thereupon', 'consequently', 'accordingly', 'subsequently', 'thereafter')


def in_front(atoms: list[Atom]) -> list[Atom]:
    """`and the ego then stops`: in sequence, wherever the word stands."""
    moved = _consequences(atoms)
    for i in range(1, len(moved)):
        if (
            _ends_clause(moved, i)
            and moved[i].kind is AtomKind.THEN
            and moved[i].key in shipped_lexicon().turns['at_the_end']
        ):
            begin = i
            while begin and moved[begin - 1].kind not in _BREAKS:
                begin -= 1
            moved.insert(begin, moved.pop(i))  # `the car brakes in response`
    for i in range(2, len(moved) - 1):
        reacts = moved[i].kind is AtomKind.THEN and moved[i - 1].kind is AtomKind.VERB
        if reacts and moved[i].key in _REACTING:  # `the drone informs thereupon the police`
            moved.insert(i - 2 if moved[i - 2].is_actor else i - 1, moved.pop(i))
    for i in range(1, len(moved) - 1):
        verbal = moved[i + 1].kind in (AtomKind.VERB, AtomKind.AUXILIARY)
        worded = moved[i].kind is AtomKind.THEN and moved[i].key != '→'
        if worded and moved[i - 1].is_actor and verbal and _acts_anew(moved, i - 1):
            moved[i - 1], moved[i] = moved[i], moved[i - 1]
    return moved


def _consequences(atoms: list[Atom]) -> list[Atom]:
    """`the van stopped, so the drone landed`, `…, and the drone at once told the bus`: then."""
    written: list[Atom] = []
    caused = happened = False  # in this sentence; in the clause in front
    for i, atom in enumerate(atoms):
        if atom.kind is AtomKind.STOP:
            caused = happened = False
        caused = caused or atom.kind is AtomKind.SUBORDINATOR
        joined = bool(written) and written[-1].kind in (AtomKind.COMMA, AtomKind.CONJUNCTION)
        if joined and happened and not caused and _follows(atoms, i):
            so = replace(atom, kind=AtomKind.THEN, key='then')
            written.append(so if atom.words == 'so' else replace(so, end=so.start + 1))
            if atom.words == 'so':
                continue
        if atom.kind is AtomKind.VERB:
            happened = atom.key in MOMENTARY and atom.form is not VerbForm.ING
        written.append(atom)
    return written


def _follows(atoms: list[Atom], i: int) -> bool:
    """Return whether a clause begins here that says that it follows from the one in front."""
    who = i + 1 if atoms[i].words == 'so' else i
    if who + 1 >= len(atoms) or not atoms[who].is_actor:
        return False
    verb = skip(atoms, who + 1, HELPERS)
    told = verb < len(atoms) and atoms[verb].kind is AtomKind.VERB
    at_once = shipped_lexicon().turns['at_once']
    return told and (who > i or any(a.words in at_once for a in atoms[who + 1 : verb + 3]))


def _ends_clause(atoms: Sequence[Atom], i: int) -> bool:
    """`the drone warns it after that | and the bus slows`: what follows is told of another."""
    if i + 1 == len(atoms) or atoms[i + 1].kind is AtomKind.STOP:
        return True
    if atoms[i - 1].kind in _BREAKS:
        return False
    after = skip(atoms, i + 1, (AtomKind.COMMA,))
    joined = after < len(atoms) and atoms[after].kind is AtomKind.CONJUNCTION
    who = skip(atoms, after + 1, (AtomKind.FILL,))
    named = (
        joined and who + 1 < len(atoms) and atoms[who].kind in (AtomKind.NOUN, AtomKind.MESSAGE)
    )
    return named and atoms[who + 1].kind in (AtomKind.VERB, AtomKind.AUXILIARY)


def _acts_anew(atoms: Sequence[Atom], i: int) -> bool:
    """Return whether the actor opens a clause; in `passes the bus and then brakes` it ends one."""
    before = i - 1
    while before >= 0 and atoms[before].kind is AtomKind.FILL:
        before -= 1
    if before < 0 or atoms[before].kind in _OPENS_CLAUSE:
        return True
    full = atoms[before].measure is not None or atoms[before].is_place
    full = full or (atoms[before].kind is AtomKind.VERB and atoms[before].key in ALONE)
    return full and atoms[i + 1].words == 'then'  # `when the bus stops the ego then brakes`
