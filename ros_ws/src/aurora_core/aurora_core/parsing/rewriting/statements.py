# SPDX-FileCopyrightText: 2026 The AURORA authors
# SPDX-License-Identifier: Apache-2.0
"""Values told in sentences of their own, put in the one order that is read: name, verb, value.

`45 m is its altitude`, `a truck whose speed is 8 m/s`, `its latency 200 ms`, `the car has a speed
of 8 m/s`, `the number of retries is 2`, `after 180 s the scenario is over`, `traffic: medium`.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import replace

from aurora_core.parsing.adjunct_reader import fits
from aurora_core.parsing.atom_runs import HELPERS, skip, stop_at, text_of
from aurora_core.parsing.atoms import Atom, AtomKind, NounKind
from aurora_core.parsing.measures import LENGTH, SPEED, TIME
from aurora_core.parsing.morphology import VerbForm
from aurora_core.parsing.rewriting.world_statements import horizon, traffic

_BREAKS = (AtomKind.COMMA, AtomKind.CONJUNCTION)
_GROUND = (NounKind.AGENT, NounKind.EGO, NounKind.VEHICLE)
_SO = re.compile(
    r'(?:(?:which|that|this)(?: it| he| she| they)?(?: should| must| shall| will| has to)?'
    r' (?:do|does)'
    r'|(?:do|does|doing|done|did) (?:so|this|that)|this|that|all this|all of this|both)\b'
)


def value_statements(atoms: Sequence[Atom], prompt: str) -> list[Atom]:
    """Return the atoms with every stated value behind its name."""
    written = traffic(list(atoms), prompt)
    for turn in (_between, _of_ground, _lasting, _doing):
        written = turn(written, prompt)
    return horizon(_so(written, prompt))


def _at(atoms: Sequence[Atom], i: int) -> Atom | None:
    return atoms[i] if 0 <= i < len(atoms) else None


def _is_be(atom: Atom | None) -> bool:
    told = atom is not None and atom.kind in (AtomKind.VERB, AtomKind.AUXILIARY)
    return told and atom is not None and atom.key == 'be'


def _is_value(name: Atom | None, value: Atom | None) -> bool:
    told = name is not None and value is not None and name.kind is AtomKind.THING
    return bool(told and name and value and value.measure and fits(name.key, value.measure))


def _copula(at: Atom) -> Atom:
    return Atom(kind=AtomKind.VERB, key='be', start=at.start, end=at.end, form=VerbForm.THIRD)


def _of_ground(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`a truck, whose speed is 8 m/s, …`: a sentence of its own, behind this one."""
    written: list[Atom] = []
    later: list[Atom] = []
    i = 0
    while i < len(atoms):
        atom = atoms[i]
        if atom.kind is AtomKind.STOP:
            written += later
            later = []
        owner = next((a for a in reversed(written) if a.is_actor), None)
        span = _whose(atoms, i, prompt) if text_of(atom, prompt) == 'whose' else None
        ground = owner is not None and owner.noun is not None and owner.noun.kind in _GROUND
        if span is None or not ground or owner is None:
            written.append(atom)
            i += 1
            continue
        name, value = span
        of = Atom(kind=AtomKind.PREPOSITION, key='of', start=atom.start, end=atom.end)
        stop = stop_at(atom)
        later += [stop, atoms[name], of, owner, _copula(atom), atoms[value]]
        while written and written[-1].kind in _BREAKS:
            written.pop()
        i = value + 1
        if i < len(atoms) and atoms[i].kind is AtomKind.COMMA:
            i += 1
    return written + later


def _whose(atoms: Sequence[Atom], i: int, prompt: str) -> tuple[int, int] | None:
    name = skip(atoms, i + 1)
    told = _at(atoms, name)
    if told is None or told.kind is not AtomKind.THING or told.key != 'speed':
        return None
    value = name + 1
    while value < len(atoms) and (atoms[value].kind in HELPERS or _is_be(atoms[value])):
        value += 1
    return (name, value) if _is_value(told, _at(atoms, value)) else None


def _between(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`if less than 12 m remain between it and the bus`, `… separate it from the bus`."""
    changed = list(atoms)
    for i in range(1, len(changed) - 3):
        if changed[i].key != LENGTH or changed[i].measure is None:
            continue
        begin = i
        while begin and changed[begin - 1].key in _OPENS_BETWEEN:
            begin -= 1
        opener = changed[begin - 1] if begin else changed[0]
        asked = changed[begin].key == 'should' and (not begin or opener.kind in _STOPS)
        if not asked and (opener.kind is not AtomKind.SUBORDINATOR or opener.key != 'when'):
            continue
        k = next((k for k in range(i + 1, min(i + 5, len(changed))) if changed[k].is_actor), None)
        if k is None or k + 2 >= len(changed) or not changed[k + 2].is_actor:
            continue
        words = prompt[changed[i].end : changed[k].start].lower().split()
        told = bool(_APART.intersection(words)) or words == ['between']
        if not told or changed[k + 1].key not in ('and', '&', 'from', 'to'):
            continue
        at = changed[i]
        name = Atom(kind=AtomKind.THING, key='standoff', start=at.start, end=at.end)
        link = Atom(kind=AtomKind.PREPOSITION, key='between', start=at.start, end=at.end)
        both = replace(changed[k + 1], kind=AtomKind.CONJUNCTION, key='and')
        bound = [a for a in changed[begin:i] if a.key in ('within', 'beyond')]
        when = replace(changed[begin], kind=AtomKind.SUBORDINATOR, key='when', noun=None)
        told_now = [name, link, changed[k], both, changed[k + 2], _copula(at), *bound, at]
        changed[begin : k + 3] = [when, *told_now] if asked else told_now
        return _between(changed, prompt)
    return changed


_OPENS_BETWEEN = frozenset({'exist', 'there', 'be', 'within', 'beyond', 'should', 'only'})
_STOPS = (AtomKind.STOP, AtomKind.COMMA, AtomKind.CONJUNCTION)
_APART = frozenset(
    {'left', 'remain', 'remains', 'remaining', 'separate', 'separates', 'lie', 'lies'}
)


def _lasting(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`…, which lasts 40 s`, `… and this takes 40 s`: for 40 s."""
    changed = list(atoms)
    i = 1
    while i < len(changed) - 1:
        verb, value = changed[i], changed[i + 1]
        opener = changed[i - 1]
        refers = opener.kind is AtomKind.RELATIVE or text_of(opener, prompt) in ('this', 'that')
        if verb.kind is AtomKind.VERB and verb.key == 'last' and value.key == TIME and refers:
            begin = i - 1
            while begin and changed[begin - 1].kind in _BREAKS:
                begin -= 1
            about = _at(changed, begin - 1)
            if about is not None and about.kind is not AtomKind.SCENARIO:
                word = replace(verb, kind=AtomKind.PREPOSITION, key='for')
                changed[begin : i + 1] = [word]
                i = begin
        i += 1
    return changed


def _doing(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`doing 28 km/h, a car …`: it drives as fast as that."""
    changed = list(atoms)
    for i in range(len(changed) - 1):
        word = text_of(changed[i], prompt)
        value = changed[skip(changed, i + 1)] if skip(changed, i + 1) < len(changed) else None
        fast = value is not None and value.key == SPEED and value.measure is not None
        before = next((a.noun for a in reversed(changed[:i]) if a.noun is not None), None)
        ground = word == 'doing' or (before is not None and before.kind in _GROUND)
        if fast and ground and word in ('do', 'does', 'doing'):
            form = {'do': VerbForm.BASE, 'doing': VerbForm.ING}.get(word, VerbForm.THIRD)
            changed[i] = replace(changed[i], kind=AtomKind.VERB, key='drive', form=form)
    return changed


def _so(atoms: list[Atom], prompt: str) -> list[Atom]:
    """`approaches it and does so at 8 m/s`, `…, and this for 40 s`: goes on with the clause."""
    written: list[Atom] = []
    i = 0
    while i < len(atoms):
        written.append(atoms[i])
        i += 1
        if atoms[i - 1].kind not in _BREAKS:
            continue
        k = skip(atoms, i, (*_BREAKS, *HELPERS, AtomKind.RELATIVE, AtomKind.VERB, AtomKind.NOUN))
        if k >= len(atoms) or k == i or k > i + 5:
            continue
        told = prompt[atoms[i].start : atoms[k].start].lower().strip()
        told = re.sub(r'^(?:and|but)\s+', '', told)
        value = atoms[k + 1] if k + 1 < len(atoms) else None
        governed = atoms[k].kind is AtomKind.PREPOSITION and value is not None and value.measure
        if governed and _SO.fullmatch(told):
            written.pop()
            while written and written[-1].kind in _BREAKS:
                written.pop()
            i = k
    return written
